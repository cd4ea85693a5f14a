"""Work on the machines of a dask cluster, which the extra ``dask`` is for.

A worker that is lost costs nothing but time: the scheduler hands its work to another one, until as many have been lost
with the same item as its setting ``distributed.scheduler.allowed-failures`` says, 3 if nothing else is set.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from queue import SimpleQueue
from typing import Any, TypeVar

from course.cluster.connection import Connection, arrived
from course.grading.classes.outcome import Outcome, told

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
        ``distributed`` isn't installed, no scheduler answers, it has no workers, or it or all of them have gone.
    """
    cluster = Connection(address)
    ended: SimpleQueue[Any] = SimpleQueue()
    pending: dict[str, tuple[Any, Item]] = {}
    try:
        # A task, not scattered data: that would be lost with the workers that hold it.
        everywhere = cluster.client.submit(_same, shared, pure=False)
        for item in items:
            # Not pure: answers that an earlier run left on the cluster are not for this one.
            future = cluster.client.submit(function, item, everywhere, pure=False, retries=1)
            pending[future.key] = future, item
            future.add_done_callback(ended.put)
        while pending:
            cluster.look()
            for ready in arrived(ended):
                future, item = pending.pop(ready.key)
                yield _outcome(cluster, item, future)
    finally:
        cluster.cancel([future for future, _ in pending.values()])
        cluster.close()


def _outcome(cluster: Connection, item: Item, future: Any) -> Outcome[Item, Any]:
    if future.cancelled():
        # If the scheduler has gone, that is to be told.
        cluster.look()
        return Outcome(item, None, f"the cluster gave it up ({future.status})")
    try:
        (value,) = cluster.gather([future])
    except Exception as error:
        if future.status != "error":
            raise
        return Outcome(item, None, told(error))
    return Outcome(item, value)


def _same(value: Value) -> Value:
    return value
