"""What is told of fog to a watcher, if one listens."""

from dataclasses import replace
from typing import Any, Protocol, cast

import numpy as np

from course.engine.core.rays import Draws, Rays
from course.engine.core.types import Floats32, Indices
from course.engine.core.watching import Watcher
from course.engine.terms.media.lamps import ArrivingLight


class FogWatcher(Watcher, Protocol):
    """A watcher that is told of fog, too."""

    def stopped(self, path: Indices, points: Floats32, throughput: Floats32) -> None:
        """Rays ``path`` (n,) end at points (3, n) between surfaces, with this throughput (3, n)."""

    def sought(
        self, path: Indices, light: str, ways: tuple[Any, Any], ends: tuple[Any, Any], value: Any
    ) -> None:
        """Rays ``path`` (n,) have asked a light by its name, "" for the environment, from places between surfaces.

        ``ways`` : where shadow rays start and where they go, (3, n) each
        ``ends`` : what blocks them, (n,) triangles or -1, and how far away in lengths of their ways, or else the limit
        ``value`` : radiance (3, n) that they bring, before the throughput of rays at their ends
        """


def watcher_of(draws: Draws) -> FogWatcher | None:
    """Who listens; None if nobody does."""
    return cast("FogWatcher | None", draws.watcher)


class _Begun:
    """A watcher that has been told already that rays begin."""

    def __init__(self, watcher: Any) -> None:
        self._watcher = watcher

    def begins(self, rays: Any, _depth: int) -> Any:
        """The rays have their numbers."""
        return rays

    def __getattr__(self, name: str) -> Any:
        return getattr(self._watcher, name)


def begun(draws: Draws) -> Draws:
    """The draws, for rays that have begun before they came to fog."""
    return draws if draws.watcher is None else replace(draws, watcher=_Begun(draws.watcher))


def numbered(rays: Rays, depth: int, draws: Draws) -> Rays:
    """The rays with the numbers that a watcher gives them, or with their paths."""
    if draws.watcher is not None:
        numbered_rays: Rays = draws.watcher.begins(rays, depth)
        return numbered_rays
    return rays if rays.path is not None else replace(rays, path=np.arange(rays.size))


def tell(
    draws: Draws, lit: ArrivingLight, points: Floats32, path: Indices, value: Floats32 | None
) -> None:
    """Tell of shadow rays from points (3, n) of paths (n,): radiance (3, m) of those that are free."""
    watcher = watcher_of(draws)
    if watcher is None:
        return
    which = lit.which
    if len(which):
        endless = np.isinf(lit.distance)
        reach = np.where(endless, np.float32(1), lit.distance)
        ends = np.full(len(which), -1), np.where(endless, np.float32(1e30), np.float32(1))
        ways = points.take(which, axis=1), lit.toward * reach
        shown = np.zeros((3, len(which)), np.float32) if value is None else value
        watcher.sought(path.take(which), lit.light, ways, ends, shown)
    if lit.blocked is not None:
        which, way, triangle, far = lit.blocked
        black = np.zeros((3, len(which)), np.float32)
        ways = points.take(which, axis=1), way
        watcher.sought(path.take(which), lit.light, ways, (triangle, far), black)
