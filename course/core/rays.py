"""Batches of rays, and the random numbers that their paths draw."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Protocol

import numpy as np

from course.core.counters import Counters
from course.core.samplers import Block, Sampler
from course.core.types import Floats32, Indices, Media

RAYS = 65536
"""Most camera rays in a batch."""

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
    medium : (n,) int16, material that the ray is in, or OPEN; None if nothing absorbs, and for camera rays
    time : (n,) float32 since the shutter opened, in exposures; None if nothing moves
    excluded : ``Surface.excluded_objects``, for the accelerator
    start : (3, n) float32, hit point that the ray leaves, next to its origin; None if ``medium`` is
    """

    origin: Floats32
    direction: Floats32
    throughput: Floats32 | None
    path: Indices | None
    medium: Media | None = None
    time: Floats32 | None = None
    excluded: Any = None
    start: Floats32 | None = None

    @property
    def size(self) -> int:
        """Number of rays."""
        return int(self.direction.shape[1])

    def halves(self) -> tuple[Rays, Rays]:
        """The second half and the first half as batches."""
        middle = self.size // 2
        rays = self if self.path is not None else replace(self, path=np.arange(self.size))
        return rays.part(slice(middle, None)), rays.part(slice(middle))

    def part(self, columns: slice) -> Rays:
        """Some of the rays. If ``path`` is None it stays None: one ray per path of the part."""
        arrays = {field.name: getattr(self, field.name) for field in fields(self)}
        # A shared origin has one column.
        kept = {
            name: array if array is None or array.shape[-1] != self.size else array[..., columns]
            for name, array in arrays.items()
        }
        return Rays(**kept)


def join_rays(batches: Sequence[Rays]) -> Rays:
    """Join batches: one costs less than several small ones. An attribute must be None in all batches or in none."""

    def columns(name: str) -> Any:
        arrays = [getattr(rays, name) for rays in batches]
        return None if arrays[0] is None else np.concatenate(arrays, axis=-1)

    return Rays(*(columns(field.name) for field in fields(Rays)))


class Dimensions:
    """Assigns dimensions of the sampler to names, such as "lens" or a light's; ``width`` says how many each has.

    A name of width 0 has no dimensions. Others have whole pairs (0, 1), (2, 3), ..., in which the sampler is best.
    A path draws numbers for ``of_path`` once, and for ``of_bounce`` at each depth. Both hold pairs (name, width).
    """

    def __init__(
        self, of_path: Iterable[tuple[str, int]], of_bounce: Iterable[tuple[str, int]]
    ) -> None:
        self.width: dict[str, int] = {}
        self._first: dict[str, int] = {}
        self._next = 0
        self._take(of_path)
        begin = self._next
        self._take(of_bounce)
        self._stride = self._next - begin

    def _take(self, wanted: Iterable[tuple[str, int]]) -> None:
        for name, width in wanted:
            if width:
                self.width[name], self._first[name] = width, self._next
                self._next += width + width % 2

    def first(self, name: str, depth: int) -> int:
        """First dimension of a name at a depth."""
        return self._first[name] + depth * self._stride


class PathCosts(Protocol):
    """What the paths of a block cost, for adaptive sampling."""

    def add(self, kind: str, path: Indices | None, cost: float | None = None) -> None:
        """Add the cost of rays of a kind, or of a "hit", to paths (n,) (None: all); ``cost`` None: that of the kind."""

    def part(self, paths: slice) -> PathCosts:
        """The costs of some of the paths."""

    def below(self, mean: Floats32, parts: int) -> Floats32:
        """Colours (3, n * parts) of n pixels, with a fourth row: the mean cost of each pixel's paths."""


@dataclass(frozen=True)
class Draws:
    """Draws random numbers for the paths of a block on demand, and counts them.

    Attributes
    ----------
    cancelled : whether the render has been cancelled
    costs : of the paths; None if nobody asks
    """

    sampler: Sampler
    dimensions: Dimensions
    block: Block
    counters: Counters
    cancelled: Callable[[], bool] = lambda: False
    costs: PathCosts | None = None

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
        name : one in ``dimensions``
        path : (n,) the paths; None for all of the block, in order
        depth : number of bounces so far
        width : None for the name's width
        skip : number of the name's first dimensions to skip
        """
        width = self.dimensions.width[name] if width is None else width
        dimension = self.dimensions.first(name, depth) + skip
        if path is None:
            u = self.sampler.draw(self.block, dimension, width)
        else:
            u = self.sampler.draw_some(self.block, dimension, width, path)
        self.counters.drew(name, u.size)
        return u

    def cast(
        self,
        kind: str,
        n: int,
        path: Indices | None,
        which: Indices | None = None,
        cost: float | None = None,
    ) -> None:
        """Count n rays that are cast.

        Parameters
        ----------
        path : of each hit; None for one hit per path, in order
        which : (n,) the hits that cast a ray; None for all
        cost : of each ray; None for that of its kind
        """
        self.counters.rays[kind] = self.counters.rays.get(kind, 0) + n
        if self.costs is not None:
            if which is not None:
                path = which if path is None else path.take(which)
            self.costs.add(kind, path, cost)
