"""A Dask cluster as seen from here: the scheduler, which workers there are, and what they have done.

Whatever waits here looks at the workers meanwhile: where none is left, it would wait for ever.
"""

import asyncio
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor, wait
from contextlib import suppress
from importlib import import_module
from queue import Empty, SimpleQueue
from time import monotonic, sleep
from typing import Any

from course.base.errors import CourseError
from course.engine.render.threads import TICK

ANSWER_WITHIN = 10
"""Seconds in which a scheduler must answer, and a worker be there."""

ALONE = 60
"""Seconds without any worker after which work is given up: a lost one may be started again meanwhile."""

LOOK = 1.0
"""Seconds between two looks at which workers there are."""


class Connection:
    """To the scheduler of a cluster that has workers; close it in the end.

    Raises CourseError: ``distributed`` isn't installed, no scheduler answers, or it has no workers.
    ``address``: of the scheduler, such as tcp://127.0.0.1:8786.

    Attributes
    ----------
    client : of ``distributed``
    threads : of all workers together, when last looked at
    most_threads : that they ever had together
    """

    def __init__(self, address: str) -> None:
        self._address = address
        self._distributed, self.client = _connect(address)
        self.threads = self.most_threads = 0
        self._looked = self._seen = monotonic()
        try:
            self.look()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Leave the cluster; what it still holds for this client goes."""
        self.client.close(timeout=2)

    def look(self) -> None:
        """See now and then which workers there are; they may come and go.

        Raises CourseError: the scheduler has gone, or all workers have for ALONE seconds.
        """
        if self.client.status != "running":
            raise self.gone()
        now = monotonic()
        if self.threads and now < self._looked + LOOK:
            return
        self._looked = now
        try:
            self.threads = sum(self.client.nthreads().values())
        except OSError as error:
            raise self.gone() from error
        if self.threads:
            self._seen = now
            self.most_threads = max(self.most_threads, self.threads)
        elif now > self._seen + ALONE:
            raise CourseError(f"{self._address}: all workers have gone, for {ALONE} s now")

    def gone(self) -> CourseError:
        """The message if the scheduler has gone."""
        return CourseError(f"{self._address}: the scheduler has gone before the work was done")

    def gather(self, futures: Sequence[Any], ends: Callable[[], bool] = lambda: False) -> list[Any]:
        """Results of the futures, or the trouble that was met; waits for what isn't done yet.

        A worker that is lost takes with it what it has done, and another one must do that again. So even what has
        ended may have to be waited for.
        ``ends``: says when nothing is to be awaited any longer.
        Returns them in the order of the futures; empty if it ended before they were done.

        Raises
        ------
        CourseError
            As by ``look``; or workers were lost again and again over the same work.
        Exception
            What a worker raised.
        """
        for future in futures:
            while not future.done():
                if ends():
                    return []
                self.look()
                sleep(TICK)
            # Here rather than by the client's `gather`, which leaves the errors of the others to asyncio's log.
            if future.status == "error":
                raise self._told(future.exception())
        gathering = asyncio.run_coroutine_threadsafe(
            self.client.gather(futures, asynchronous=True), self.client.loop.asyncio_loop
        )
        try:
            while True:
                # TimeoutError, OSError and others can be what a worker raised.
                if wait([gathering], TICK).done:
                    results: list[Any] = gathering.result()
                    return results
                if ends():
                    return []
                self.look()
        except (CancelledError, self._distributed.comm.CommClosedError) as lost:
            # The client notices sooner or later, by what it is just doing.
            raise self.gone() from lost
        except self._distributed.scheduler.KilledWorker as killed:
            raise self._told(killed) from None
        finally:
            gathering.cancel()

    def cancel(self, futures: Sequence[Any]) -> None:
        """Have work that was handed out left undone; where the scheduler has gone, it has gone too."""
        if futures and self.client.status == "running":
            with suppress(OSError):
                self.client.cancel(futures, force=True)

    def _told(self, error: BaseException) -> BaseException:
        """The error to raise for an error of a worker, or for the loss of several workers."""
        if isinstance(error, self._distributed.scheduler.KilledWorker):
            return CourseError(
                f"{self._address}: workers were lost again and again over the same work; "
                "perhaps they have too little memory"
            )
        return error


def arrived(ended: SimpleQueue[Any]) -> Iterator[Any]:
    """All that have ended by now; where there is none, wait a moment for one."""
    try:
        yield ended.get(timeout=TICK)
        while True:
            yield ended.get_nowait()
    except Empty:
        return


def _connect(address: str) -> tuple[Any, Any]:
    """The module ``distributed``, and a client of the scheduler at an address."""
    try:
        distributed = import_module("distributed")
    except ImportError as error:
        raise CourseError(
            'the engine dask needs more: pip install "penumbra-course[dask]"'
        ) from error
    try:
        # Where somebody else listens, a client would wait for ever. The thread is for notebooks, which have a loop.
        with ThreadPoolExecutor(1) as thread:
            thread.submit(asyncio.run, _ask(distributed, address)).result()
        client = distributed.Client(address, timeout=ANSWER_WITHIN, set_as_default=False)
    except (OSError, ValueError) as error:
        raise CourseError(
            f"{address}: no dask scheduler answered within {ANSWER_WITHIN} s: {error}".removesuffix(
                ": "
            )
        ) from error
    try:
        client.wait_for_workers(1, timeout=ANSWER_WITHIN)
    except (OSError, TimeoutError) as error:
        client.close(timeout=2)
        raise CourseError(f"{address}: the scheduler has no workers; start some") from error
    return distributed, client


async def _ask(distributed: Any, address: str) -> None:
    """Raise OSError, TimeoutError among them, or ValueError where no scheduler answers."""
    async with (
        asyncio.timeout(ANSWER_WITHIN),
        distributed.rpc(address, timeout=ANSWER_WITHIN) as scheduler,
    ):
        await scheduler.identity()
