"""Work on the machines of a dask cluster, which the extra ``dask`` is for.

A worker that is lost costs nothing but time: the scheduler hands its work to another one, until as many have been lost
with the same item as its setting ``distributed.scheduler.allowed-failures`` says, 3 if nothing else is set.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from typing import Any, TypeVar

from course.grading.classes.outcome import Outcome, told
from course.rendering.cluster import connect

Item = TypeVar("Item")
Shared = TypeVar("Shared")
Value = TypeVar("Value")


def on_cluster(
    function: Callable[[Item, Shared], Value], items: Sequence[Item], shared: Shared, address: str
) -> Generator[Outcome[Item, Value], None, None]:
    """Call a function for each item on the workers of a dask cluster, which need the course installed.

    Parameters
    ----------
    function : one that can be imported
    shared : its second argument, which each worker gets once
    address : of the scheduler, such as tcp://127.0.0.1:8786

    Yields
    ------
    Outcome
        One for each item, as they end. Close the generator to cancel what is left.

    Raises
    ------
    CourseError
        ``distributed`` isn't installed, no scheduler answers, or it has no workers.
    """
    distributed, client = connect(address)
    futures: dict[str, Any] = {}
    try:
        # A task, not scattered data: that would be lost with the workers that hold it.
        everywhere = client.submit(_same, shared, pure=False)
        by_key: dict[str, Item] = {}
        for item in items:
            # Not pure: answers that an earlier run left on the cluster are not for this one.
            future = client.submit(function, item, everywhere, pure=False, retries=1)
            futures[future.key] = future
            by_key[future.key] = item
        for future in distributed.as_completed(
            [*futures.values()], loop=client.loop, raise_errors=False
        ):
            item = by_key[future.key]
            del futures[future.key]
            if future.status == "finished":
                yield Outcome(item, future.result())
            elif future.status == "error":
                yield Outcome(item, None, told(future.exception()))
            else:
                yield Outcome(item, None, f"the cluster gave it up ({future.status})")
    finally:
        if futures:
            client.cancel([*futures.values()], force=True)
        client.close(timeout=2)


def _same(value: Value) -> Value:
    return value
