"""Tiles on the workers of a Dask cluster, which the extra ``dask`` is for.

The scheduler and every worker need the course installed, as it is here; workers that run another edition of its
sources, of NumPy or of Embree refuse. They need neither the scene nor its meshes, pictures and functions: those are
sent (``parcel``). A picture is then the same, bit for bit, as one rendered here, wherever processors have the same
vector instructions: NumPy chooses by them how it works out sines and powers, whose last bits may differ.

A worker that is lost costs nothing but time: the scheduler hands its work to another one.
"""

from collections.abc import Iterator
from importlib import import_module
from itertools import islice
from queue import SimpleQueue
from time import monotonic
from typing import Any

from course.base.errors import CourseError
from course.engine.core.counters import Counters
from course.engine.core.tiles import Work
from course.engine.core.types import Floats32
from course.engine.render.cluster.connection import Connection, arrived
from course.engine.render.cluster.parcel import KeptScenes, Parcel, WorkOrder, edition, pack
from course.engine.render.threads import Execution, InOrder, ThreadedExecutor
from course.engine.scene.scene import Scene, SceneSettings

PIECE = 0.3
"""Seconds of work in a task: a hundred times what it costs to hand it over, and little to wait for in the end."""

MOST_TILES = 16
"""In a task: what it brings back may be a megabyte a tile."""

AHEAD = 2
"""Tasks handed out for each thread of a worker, so that the next is there when one is done."""

GRACE = 1.0
"""Seconds after a deadline in which tasks that were handed out before may still end."""

RETRIES = 2
"""Number of retries of a task that failed on a worker, perhaps for want of memory."""

Result = tuple[Floats32, Floats32 | float]

_kept = KeptScenes()


class Cluster(ThreadedExecutor):
    """The workers of a cluster; close it in the end.

    Raises CourseError: ``distributed`` isn't installed, no scheduler answers, it has no workers, or a file of the scene
    has gone.

    Parameters
    ----------
    address : of the scheduler, such as tcp://127.0.0.1:8786
    packets : whether workers shall use compiled loops where they have them
    """

    def __init__(self, address: str, scene: Scene, settings: SceneSettings, packets: bool) -> None:
        # A thread of its own, so that Ctrl-C can't come in the middle of adding to the film.
        super().__init__(servers=1, grace=GRACE)
        self._order = WorkOrder(settings, packets, edition())
        try:
            parcel = pack(scene)
        except OSError as error:
            raise CourseError(f"{scene.path}: a file that it names has gone: {error}") from error
        self._connection = Connection(address)
        self._seconds_a_ray = 0.0
        try:
            # A task, not scattered data: that would be lost with the workers that hold it.
            with import_module("dask").config.set(
                {"distributed.admin.large-graph-warning-threshold": "1TB"}
            ):
                self._parcel = self._connection.client.submit(_same, parcel, pure=False)
        except BaseException:
            self.close()
            raise

    @property
    def threads(self) -> int:
        """The most that all workers had together."""
        return self._connection.most_threads

    def prepare(self) -> float:
        """Wait until the workers have the scene; raises what ``Connection.gather`` does."""
        try:
            workers = self._connection.client.nthreads()
            self._connection.gather([self._submit([], worker) for worker in workers])
        except OSError as error:
            raise self._connection.gone() from error
        return monotonic()

    def close(self) -> None:
        """Leave the cluster, and nothing on it."""
        self._connection.close()

    def serve(self, run: Execution) -> None:
        """See ``ThreadedExecutor``."""
        pending: dict[str, tuple[Any, list[Work]]] = {}
        ended: SimpleQueue[Any] = SimpleQueue()
        more = True
        try:
            while not run.stop:
                most = AHEAD * max(self._connection.threads, 1)
                while more and self.seconds_left >= 0 and len(pending) < most:
                    piece = next_piece(run.work, self._seconds_a_ray)
                    if more := bool(piece):
                        future = self._submit(piece)
                        pending[future.key] = future, piece
                        future.add_done_callback(ended.put)
                if not pending or self.seconds_left < -GRACE:
                    run.complete = not more and not pending
                    break
                ready = [pending.pop(future.key) for future in arrived(ended)]
                found = self._connection.gather(
                    [future for future, _ in ready], lambda: run.stop or self.seconds_left < -GRACE
                )
                if len(found) < len(ready):
                    break
                for (_, piece), (results, counters) in zip(ready, found, strict=True):
                    if not run.stop:
                        self._take_in(run.film, piece, results, counters)
                self._connection.look()
        except BaseException as error:
            if self._connection.client.status != "running":
                raise self._connection.gone() from error
            raise
        finally:
            self._connection.cancel([future for future, _ in pending.values()])

    def _submit(self, piece: list[Work], worker: str | None = None) -> Any:
        where = {} if worker is None else {"workers": [worker], "allow_other_workers": True}
        # Not pure: what an earlier render left on the cluster is not for this one.
        return self._connection.client.submit(
            render_piece, self._parcel, self._order, piece, pure=False, retries=RETRIES, **where
        )

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


def render_piece(
    parcel: Parcel, order: WorkOrder, piece: list[Work]
) -> tuple[list[Result], Counters]:
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


def next_piece(work: Iterator[Work], seconds_a_ray: float) -> list[Work]:
    """Work of about PIECE seconds; a single tile as long as nothing is known, nothing when there is none left."""
    piece: list[Work] = []
    seconds = 0.0
    for item in islice(work, MOST_TILES if seconds_a_ray else 1):
        piece.append(item)
        seconds += seconds_a_ray * item.tile.size * item.samples
        if seconds >= PIECE:
            break
    return piece
