"""What is told of fog to a watcher, if one listens."""

from dataclasses import replace
from typing import Any

import numpy as np

from course.engine.core.rays import Draws, Rays
from course.engine.core.types import Floats32, Indices
from course.engine.terms.media.lamps import ArrivingLight


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
    if draws.watcher is None:
        return
    which = lit.which
    if len(which):
        endless = np.isinf(lit.distance)
        reach = np.where(endless, np.float32(1), lit.distance)
        ends = np.full(len(which), -1), np.where(endless, np.float32(1e30), np.float32(1))
        ways = points.take(which, axis=1), lit.toward * reach
        shown = np.zeros((3, len(which)), np.float32) if value is None else value
        draws.watcher.sought(path.take(which), lit.light, ways, ends, shown)
    if lit.blocked is not None:
        which, way, triangle, far = lit.blocked
        black = np.zeros((3, len(which)), np.float32)
        ways = points.take(which, axis=1), way
        draws.watcher.sought(path.take(which), lit.light, ways, (triangle, far), black)
