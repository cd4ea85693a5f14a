"""Tiles on the workers of a Dask cluster, which the extra ``dask`` is for.

The scheduler and every worker need the course installed, as it is here; workers that run another edition of its
sources, of NumPy or of Embree refuse. They need neither the scene nor its meshes, pictures and functions: those are
sent (``parcel``). A picture is then the same, bit for bit, as one rendered here, wherever processors have the same
vector instructions: NumPy chooses by them how it works out sines and powers, whose last bits may differ.

A worker that is lost costs nothing but time: the scheduler hands its work to another one.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import CancelledError, ThreadPoolExecutor
from contextlib import suppress
from importlib import import_module
from itertools import islice
from queue import Empty, SimpleQueue
from time import monotonic
from typing import Any

from course.core.types import Floats32
from course.errors import CourseError
from course.rendering.kept_scenes import KeptScenes, Order, edition
from course.rendering.parcel import Parcel, pack
from course.rendering.passes import Work
from course.rendering.pool import TICK, InOrder, Run, Runner, Sink, Tick
from course.scene.scene import Scene
from course.scene.world import Settings
from course.transport.counters import Counters

PATIENCE = 10
"""Seconds in which a scheduler must answer, and a worker be there."""

ALONE = 60
"""Seconds without any worker after which a render is given up: a lost one may be started again meanwhile."""

LOOK = 1.0
"""Seconds between two looks at which workers there are."""

PIECE = 0.3
"""Seconds of work in a task: a hundred times what it costs to hand it over, and little to wait for in the end."""

MOST_TILES = 16
"""In a task: what it brings back may be a megabyte a tile."""

AHEAD = 2
"""Tasks handed out for each thread of a worker, so that the next is there when one is done."""

GRACE = 1.0
"""Seconds after a deadline in which tasks that were handed out before may still end."""

RETRIES = 2
"""How often a task that failed on a worker, for want of memory say, is tried again."""

Result = tuple[Floats32, Floats32 | float]

_kept = KeptScenes()


class Cluster(Runner):
    """Runs work as ``Pool`` does, on the workers of a cluster; close it in the end.

    Parameters
    ----------
    address : of the scheduler, such as tcp://127.0.0.1:8786
    packets : whether workers shall use compiled loops where they have them

    Attributes
    ----------
    threads : the most that all workers had together

    Raises
    ------
    CourseError
        ``distributed`` isn't installed, no scheduler answers, it has no workers, or a file of the scene has gone.
    """

    def __init__(
        self, address: str, scene: Scene, settings: Settings, film: Sink, packets: bool
    ) -> None:
        super().__init__()
        self._address = address
        self._film = film
        self._order = Order(settings, packets, edition())
        try:
            parcel = pack(scene)
        except OSError as error:
            raise CourseError(f"{scene.path}: a file that it names has gone: {error}") from error
        self._distributed, self._client = connect(address)
        self.threads = 0
        self._seconds_a_ray = 0.0
        self._workers = 0
        self._looked = self._seen = monotonic()
        try:
            self._look()
            # A task, not scattered data: that would be lost with the workers that hold it.
            with import_module("dask").config.set(
                {"distributed.admin.large-graph-warning-threshold": "1TB"}
            ):
                self._parcel = self._client.submit(_same, parcel, pure=False)
        except BaseException:
            self.close()
            raise

    def prepare(self, _began: float) -> float:
        """Wait until the workers have the scene; a time limit counts from then [``time.monotonic()``].

        Raises
        ------
        CourseError, Exception
            As by ``run``.
        """
        try:
            self._fetch([self._submit([], worker) for worker in self._client.nthreads()])
        except OSError as error:
            raise self._gone() from error
        return monotonic()

    def run(
        self,
        work: Iterable[Work],
        deadline: float | None,
        tick: Tick | None,
    ) -> bool:
        """Do the work; whether all of it was done.

        Parameters
        ----------
        deadline : ``time.monotonic()`` after which nothing is handed out, and soon after which nothing is awaited
        tick : called now and then from this thread

        Raises
        ------
        CourseError
            The scheduler or all workers have gone, or workers were lost again and again over the same work.
        Exception
            What a worker raised.
        """
        run = _ClusterRun(work, self._film, deadline)
        # A thread of its own, so that Ctrl-C can't come in the middle of adding to the film.
        thread = threading.Thread(target=self._serve, args=(run,), name="cluster", daemon=True)
        self._attend(run, [thread], tick, GRACE)
        if run.error is not None and not self.interrupted:
            raise run.error
        return run.whole and not self.interrupted

    def close(self) -> None:
        """Leave the cluster, and nothing on it."""
        self._client.close(timeout=2)

    def _serve(self, run: _ClusterRun) -> None:
        """Hand out the work of a run and take in what comes back."""
        pending: dict[str, tuple[Any, list[Work]]] = {}
        ended: SimpleQueue[Any] = SimpleQueue()
        try:
            while not run.stop:
                late = 0.0 if run.deadline is None else monotonic() - run.deadline
                while late <= 0 and len(pending) < AHEAD * max(self._workers, 1):
                    if not (piece := run.rest.take(self._seconds_a_ray)):
                        break
                    future = self._submit(piece)
                    pending[future.key] = future, piece
                    future.add_done_callback(ended.put)
                if not pending or late > GRACE:
                    run.whole = run.rest.exhausted and not pending
                    break
                ready = [pending.pop(future.key) for future in _arrived(ended)]
                found = self._fetch([future for future, _ in ready])
                for (_, piece), (results, counters) in zip(ready, found, strict=True):
                    if not run.stop:
                        self._take_in(run.film, piece, results, counters)
                self._look()
        except BaseException as error:  # noqa: BLE001 - handed to the thread that waits
            run.error = error if self._client.status == "running" else self._gone()
        finally:
            self._cancel([future for future, _ in pending.values()])
            run.finished.set()

    def _submit(self, piece: list[Work], worker: str | None = None) -> Any:
        where = {} if worker is None else {"workers": [worker], "allow_other_workers": True}
        # Not pure: what an earlier render left on the cluster is not for this one.
        return self._client.submit(
            render_piece, self._parcel, self._order, piece, pure=False, retries=RETRIES, **where
        )

    def _fetch(self, futures: list[Any]) -> list[tuple[list[Result], Counters]]:
        """What has been done, or the trouble that was met; waits where something isn't done yet."""
        try:
            for future in futures:
                error = future.exception()
                if error is not None:
                    raise self._told(error)
            # Where a worker is lost with what it has done, this waits for another to do it again.
            results: list[tuple[list[Result], Counters]] = self._client.gather(futures)
        except CancelledError as cancelled:
            raise self._gone() from cancelled
        return results

    def _told(self, error: BaseException) -> BaseException:
        """What to raise for what a worker raised, or for the loss of several."""
        if isinstance(error, self._distributed.scheduler.KilledWorker):
            return CourseError(
                f"{self._address}: workers were lost again and again over the same tiles; "
                "perhaps they have too little memory"
            )
        return error

    def _gone(self) -> CourseError:
        return CourseError(f"{self._address}: the scheduler has gone before the picture was ready")

    def _take_in(
        self, film: InOrder, piece: list[Work], results: list[Result], counters: Counters
    ) -> None:
        rays = sum(item.tile.size * item.samples for item in piece)
        seconds = sum(counters.seconds.values()) / rays
        # Parts of a picture differ: what was seen last counts for half.
        self._seconds_a_ray = (self._seconds_a_ray + seconds) / (2 if self._seconds_a_ray else 1)
        self.counters.add(counters)
        self.counters.start()
        for item, (pixels, weight) in zip(piece, results, strict=True):
            film.add(item, pixels, weight)
        self.counters.lap("film")

    def _look(self) -> None:
        """See now and then which workers there are; they may come and go."""
        if self._client.status != "running":
            raise self._gone()
        now = monotonic()
        if self._workers and now < self._looked + LOOK:
            return
        self._looked = now
        try:
            self._workers = sum(self._client.nthreads().values())
        except OSError as error:
            raise self._gone() from error
        if self._workers:
            self._seen = now
            self.threads = max(self.threads, self._workers)
        elif now > self._seen + ALONE:
            raise CourseError(f"{self._address}: all workers have gone, for {ALONE} s now")

    def _cancel(self, futures: list[Any]) -> None:
        # Where the scheduler has gone, the work has gone with it.
        if futures and self._client.status == "running":
            with suppress(OSError):
                self._client.cancel(futures, force=True)


def connect(address: str) -> tuple[Any, Any]:
    """The module ``distributed``, and a client of the scheduler at an address.

    Raises
    ------
    CourseError
        ``distributed`` isn't installed, no scheduler answers, or it has no workers.
    """
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
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise CourseError(
            f"{address}: no dask scheduler answered within {PATIENCE} s: {error}".removesuffix(": ")
        ) from error
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except (OSError, TimeoutError) as error:
        client.close(timeout=2)
        raise CourseError(f"{address}: the scheduler has no workers; start some") from error
    return distributed, client


async def _ask(distributed: Any, address: str) -> None:
    """Raise OSError, TimeoutError among them, or ValueError where no scheduler answers."""
    async with asyncio.timeout(PATIENCE), distributed.rpc(address, timeout=PATIENCE) as scheduler:
        await scheduler.identity()


def render_piece(parcel: Parcel, order: Order, piece: list[Work]) -> tuple[list[Result], Counters]:
    """On a worker: colours and weights of each tile of a piece, and what they have cost."""
    tracer = _kept.tracer(parcel, order)
    counters = Counters()
    results = [
        tracer.render_tile(item.tile, item.first, item.samples, counters, parts=item.parts)
        for item in piece
    ]
    return results, counters


def _same(parcel: Parcel) -> Parcel:
    return parcel


def _arrived(ended: SimpleQueue[Any]) -> Iterator[Any]:
    """All that have ended by now; where there is none, wait a moment for one."""
    try:
        yield ended.get(timeout=TICK)
        while True:
            yield ended.get_nowait()
    except Empty:
        return


class _ClusterRun(Run):
    """Work that is handed out until it is exhausted or the time is up."""

    def __init__(self, work: Iterable[Work], film: Sink, deadline: float | None) -> None:
        super().__init__(film)
        self.rest = _Rest(work)
        self.deadline = deadline
        self.whole = False


class _Rest:
    """Work that has not been handed out, taken in pieces."""

    def __init__(self, work: Iterable[Work]) -> None:
        self._work = iter(work)
        self.exhausted = False

    def take(self, seconds_a_ray: float) -> list[Work]:
        """The next piece of about PIECE seconds; a single tile as long as nothing is known."""
        piece: list[Work] = []
        seconds = 0.0
        for item in islice(self._work, MOST_TILES if seconds_a_ray else 1):
            piece.append(item)
            seconds += seconds_a_ray * item.tile.size * item.samples
            if seconds >= PIECE:
                break
        self.exhausted = not piece
        return piece
