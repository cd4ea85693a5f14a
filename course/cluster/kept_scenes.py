"""The scenes that a worker of a cluster keeps, so that it compiles each once and not once for every piece of work."""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from course import __version__
from course.cluster.parcel import Parcel, unpack
from course.compiled.packets import available as packets_available
from course.core.tracer import Tracer
from course.errors import CourseError
from course.rendering.binding import bind
from course.rendering.memory import keep_freed_memory
from course.scene.scene import Scene, Settings

MOST = 2
"""Scenes that a worker keeps: those of two people who render at the same time."""

PROJECT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Order:
    """What is to be done with the scene of a parcel.

    Attributes
    ----------
    settings : of the render
    packets : whether compiled loops shall be used where they are installed
    edition : of the course that gave the order; see `edition`
    """

    settings: Settings
    packets: bool
    edition: str


@cache
def edition() -> str:
    """What decides the bits of a picture beside the scene: the course's sources, NumPy and Embree."""
    digest = sha256()
    for path in sorted((PROJECT / "course").rglob("*.py")):
        name = path.relative_to(PROJECT)
        # Whoever works at the command line or the grading doesn't change a picture.
        if name.parts[1] not in ("benchmarking", "cli", "grading"):
            digest.update(f"{name.as_posix()}\n".encode())
            # A checkout on Windows may have other line ends.
            digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return (
        f"course {__version__} ({digest.hexdigest()[:8]}), NumPy {version('numpy')}, "
        f"Embree {version('embreex')}"
    )


class KeptScenes:
    """Scenes by the digest of their parcels; all threads of a process share them."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._kept: OrderedDict[str, _Kept] = OrderedDict()

    def tracer(self, parcel: Parcel, order: Order) -> Tracer:
        """The scene of a parcel bound to these settings; compiled if this is the first time.

        Raises CourseError when this process runs another edition of the course than who gave the order.
        """
        if order.edition != edition():
            raise CourseError(
                f"a worker runs {edition()}, and here is {order.edition}: "
                "their pictures might differ; install the same on both"
            )
        # One thread compiles, the others wait for what it makes.
        with self._lock:
            kept = self._kept.get(parcel.digest)
            if kept is None:
                self._drop_all_but(MOST - 1)
                kept = self._kept[parcel.digest] = _Kept(parcel)
            self._kept.move_to_end(parcel.digest)
            return kept.tracer(order)

    def close(self) -> None:
        """Forget all scenes and delete what was written for them."""
        with self._lock:
            self._drop_all_but(0)

    def _drop_all_but(self, count: int) -> None:
        """Drop those that were used longest ago."""
        while len(self._kept) > count:
            self._kept.popitem(last=False)[1].folder.cleanup()


class _Kept:
    """One scene, and the tracer that was asked for last."""

    def __init__(self, parcel: Parcel) -> None:
        keep_freed_memory()
        # Modules of functions are imported when a render needs them, so the folder stays.
        self.folder = TemporaryDirectory(prefix="course-", ignore_cleanup_errors=True)
        self._scene: Scene = unpack(parcel.content, Path(self.folder.name))
        self._last: tuple[Order, Tracer] | None = None

    def tracer(self, order: Order) -> Tracer:
        if self._last is None or self._last[0] != order:
            compiled = order.packets and packets_available()
            self._last = order, bind(self._scene, order.settings, compiled=compiled)
        return self._last[1]
