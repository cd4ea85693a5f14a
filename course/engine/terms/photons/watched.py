"""What is told of photons to a watcher, if one listens: from where the light came that hits have gathered."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol, cast

import numpy as np

from course.engine.core.rays import Draws, Rays
from course.engine.core.types import Floats32, Indices
from course.engine.core.watching import Watcher
from course.engine.terms.photons.maps import PhotonMap

PHOTONS = "photons"
"""What their light is called."""

GATHERED = "gathered light"
"""What is called that rays have found where photons are."""

TOLD = 8
"""Photons that are told of for a hit: the strongest, which stand for all."""


class PhotonWatcher(Watcher, Protocol):
    """A watcher that is told of photons, too.

    Attributes
    ----------
    path : of each ray that has a number, its path in the block
    asking : while it is ``muted``, calls of functions are none of the recorded rays'
    """

    path: Indices
    asking: Any

    def sought(
        self, path: Indices, light: str, ways: tuple[Any, Any], ends: tuple[Any, Any], value: Any
    ) -> None:
        """See ``FogWatcher`` in ``course.engine.terms.media.watched``."""


def watcher_of(draws: Draws) -> PhotonWatcher | None:
    """Who listens; None if nobody does."""
    return cast("PhotonWatcher | None", draws.watcher)


def paths_of(draws: Draws, path: Indices) -> Indices:
    """Paths (n,) of rays, which have numbers of their own where somebody listens."""
    watcher = watcher_of(draws)
    return path if watcher is None else watcher.path.take(path)


@contextmanager
def unheard(draws: Draws) -> Iterator[None]:
    """Calls of functions for photons, which are none for rays from the eye."""
    watcher = watcher_of(draws)
    if watcher is None or watcher.asking is None:
        yield
        return
    watcher.asking.muted = True
    try:
        yield
    finally:
        watcher.asking.muted = False


def tell(
    draws: Draws,
    photons: PhotonMap,
    near: tuple[Indices, Indices, Floats32],
    path: Indices,
    points: Floats32,
    shown: Floats32,
    away: float,
) -> None:
    """Tell of the photons that some hits have gathered.

    Parameters
    ----------
    near : points and photons (m,) of pairs, and what each photon brings (3, m)
    path : (n,) of the hits
    points : (3, n) where they are
    shown : (3, n) radiance that they send to the eye for it
    away : how long the ways of photons are shown
    """
    watcher = watcher_of(draws)
    if watcher is None:
        return
    point, photon, brought = near
    order = np.lexsort((-brought.sum(axis=0), point))
    point, photon, brought = point[order], photon[order], brought[:, order]
    first = np.searchsorted(point, point, side="left")
    strongest = np.flatnonzero(np.arange(len(point)) - first < TOLD)
    point, photon, brought = point[strongest], photon[strongest], brought[:, strongest]
    whole = np.stack([np.bincount(point, row, len(path)) for row in brought])
    share = brought / np.maximum(whole.take(point, axis=1), 1e-30)
    came = photons.photons.direction.take(photon, axis=1) * np.float32(-away)
    ways = points.take(point, axis=1), (came + photons.photons.position.take(photon, axis=1))
    ways = ways[0], ways[1] - ways[0]
    ends = np.full(len(point), -1), np.ones(len(point), np.float32)
    value = (shown.take(point, axis=1) * share).astype(np.float32)
    watcher.sought(path.take(point), PHOTONS, ways, ends, value)


def tell_gathered(
    draws: Draws, rays: Rays, reach: Floats32, path: Indices, shown: Floats32, brought: Floats32
) -> None:
    """Tell of the rays that some hits have sent to where photons are.

    Parameters
    ----------
    rays : those of a hit after those of the other
    reach : (rays,) how far each goes
    path : (n,) of the hits
    shown : (3, n) radiance that they send to the eye for it
    brought : (3, rays) what each ray has found
    """
    watcher = watcher_of(draws)
    if watcher is None:
        return
    count = rays.size // len(path)
    whole = brought.reshape(3, -1, count).sum(axis=2)
    share = brought / np.maximum(np.repeat(whole, count, axis=1), 1e-30)
    value = (np.repeat(shown, count, axis=1) * share).astype(np.float32)
    lands = np.isfinite(reach)
    ways = rays.origin, rays.direction * np.where(lands, reach, np.float32(1))
    ends = np.full(rays.size, -1), np.where(lands, np.float32(1), np.float32(1e30))
    watcher.sought(np.repeat(path, count), GATHERED, ways, ends, value)
