"""Batches of rays, and the random numbers that their paths draw."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from course.engine.core.counters import Counters
from course.engine.core.samplers import Block, Sampler
from course.engine.core.types import Floats32, Indices, Media
from course.engine.core.watching import Watcher

RAYS = 65536
"""Maximum number of camera rays in a batch.

A batch shares the cost of Python among its rays: the longer each call of NumPy or Embree runs, the less time threads
spend waiting for the interpreter's lock. With 32 thousand rays a render took 1.85 times as long as Embree alone, with
64 thousand 1.53 to 1.64 times, and with 128 thousand 1.59 times (medians of five, on two cores with 1 MB of
second-level cache each).
"""

OPEN = np.int16(-1)
"""Medium of rays outside all dielectrics."""


@dataclass(frozen=True)
class Rays:
    """A batch of rays, one column per ray.

    Attributes
    ----------
    origin : (3, n) float32, or (3, 1) if shared
    direction : (3, n) float32, unit length
    throughput : (3, n) float32, share of a ray's radiance that reaches the picture; None for 1
    path : (n,) number of the path in the block; None for one ray per path, in order
    medium : (n,) int16, material that the ray travels in, or OPEN; None if nothing absorbs, and for camera rays
    time : (n,) float32, time since the shutter opened, as a fraction of the exposure; None if nothing moves
    start : (3, n) float32, the hit points that the rays leave, without the offset of ``origin``; None without a medium
    """

    origin: Floats32
    direction: Floats32
    throughput: Floats32 | None
    path: Indices | None
    medium: Media | None = None
    time: Floats32 | None = None
    start: Floats32 | None = None

    @property
    def size(self) -> int:
        """Number of rays."""
        return int(self.direction.shape[1])

    def halves(self) -> "tuple[Rays, Rays]":
        """Two batches: the second half of the rays, then the first, so that a stack returns the first half first."""
        middle = self.size // 2
        rays = self if self.path is not None else replace(self, path=np.arange(self.size))
        return rays.part(slice(middle, None)), rays.part(slice(middle))

    def part(self, columns: slice) -> "Rays":
        """The rays in some columns. ``path`` must be set: in the part, None would mean the block's first paths."""
        arrays = [getattr(self, field.name) for field in fields(self)]
        # A shared origin has one column.
        whole = [array is None or array.shape[-1] != self.size for array in arrays]
        return type(self)(
            *(a if keep else a[..., columns] for a, keep in zip(arrays, whole, strict=True))
        )


def join_rays(batches: Sequence[Rays]) -> Rays:
    """Join batches: a large one costs less than several small ones. They have the same attributes."""

    def columns(name: str) -> Any:
        arrays = [getattr(rays, name) for rays in batches]
        return None if arrays[0] is None else np.concatenate(arrays, axis=-1)

    return type(batches[0])(*(columns(field.name) for field in fields(batches[0])))


class Dimensions:
    """Assigns dimensions of the sampler to names, such as "lens" or the name of a light.

    Samplers stratify pairs of dimensions (0, 1), (2, 3), ..., so every name begins a new pair. A path draws ``of_path``
    once and ``of_bounce`` at each depth. Both are sequences of (name, number of dimensions); the number may be 0.
    """

    def __init__(
        self, of_path: Iterable[tuple[str, int]], of_bounce: Iterable[tuple[str, int]]
    ) -> None:
        self.width: dict[str, int] = {}
        self._first: dict[str, int] = {}
        begin = self._assign(of_path, 0)
        self.of_path = frozenset(self.width)
        self._stride = self._assign(of_bounce, begin) - begin

    def _assign(self, wanted: Iterable[tuple[str, int]], dimension: int) -> int:
        """Assign dimensions from the given one on; return the next free one."""
        for name, width in wanted:
            if width:
                self.width[name], self._first[name] = width, dimension
                dimension += width + width % 2
        return dimension

    def first(self, name: str, depth: int) -> int:
        """First dimension of a name at a depth."""
        return self._first[name] + depth * self._stride


@dataclass(frozen=True)
class Draws:
    """Draws random numbers for the paths of a block on demand; counts the numbers, and the rays of the paths.

    ``cancelled`` returns true if the render has been cancelled; ``costs`` are the paths' costs
    (``course.engine.render.adaptive.costs``), None without adaptive sampling; ``watcher`` listens, None if nobody does.
    """

    sampler: Sampler
    dimensions: Dimensions
    block: Block
    counters: Counters
    cancelled: Callable[[], bool] = lambda: False
    costs: Any = None
    watcher: Watcher | None = None

    def __call__(
        self,
        name: str,
        path: Indices | None = None,
        depth: int = 0,
        width: int | None = None,
        skip: int = 0,
    ) -> Floats32:
        """Random numbers (width, n) in [0, 1).

        Parameters
        ----------
        path : (n,); None for all paths of the block, in order
        depth : number of bounces so far
        width : number of dimensions; None for all that ``name`` has
        skip : number of the name's dimensions to skip
        """
        width = self.dimensions.width[name] if width is None else width
        dimension = self.dimensions.first(name, depth) + skip
        if path is None:
            u = self.sampler.draw(self.block, dimension, width)
        else:
            u = self.sampler.draw_some(self.block, dimension, width, path)
        self.counters.numbers[name] += u.size
        return u

    def cast(
        self,
        kind: str,
        n: int,
        path: Indices | None,
        which: Indices | None = None,
        cost: float | None = None,
    ) -> None:
        """Count n rays of a kind, and add what they cost to their paths.

        Parameters
        ----------
        path : the path of each hit; None for one hit per path, in order
        which : (n,) the hits that cast the rays; None for all hits
        cost : the cost of each ray; None for the cost of its kind
        """
        self.counters.rays[kind] += n
        if self.costs is not None:
            if which is not None:
                path = which if path is None else path.take(which)
            self.costs.add(kind, path, cost)
