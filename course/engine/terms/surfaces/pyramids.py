"""Textures that are seen from afar: means of their pixels, again and again.

L. Williams, "Pyramidal parametrics", 1983.

A pixel of the picture that is rendered covers r pixels of the texture along an edge of a square of the same area. The
colour is that of the level log2 r, between two levels a mixture. A path's first segment counts as long as it is, and so
does each of the others by itself.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Floats64
from course.engine.core.vectors import cross, dot
from course.engine.terms.surfaces.normal_maps import NormalMap
from course.engine.terms.surfaces.textures import Texture


@dataclass(frozen=True)
class Pyramid:
    """A picture and smaller ones on a shape, as a ``ColorAt``.

    Attributes
    ----------
    levels : the picture itself, and each of the following half as wide and high
    places : where the surface has them
    """

    levels: tuple[Texture, ...]
    places: NormalMap

    def __call__(self, weights: Floats32, corners: Floats32) -> Floats32:
        """See ``ColorAt``: of the picture itself."""
        return self.levels[0](self.places.places(weights, corners))

    def at_size(
        self, weights: Floats32, corners: Floats32, size: Floats32, edges: Floats32
    ) -> Floats32:
        """Colours (3, n) where a pixel is as large as ``size`` (n,); edges as in ``NormalMap.normals``."""
        place, first, second = self.places.changes(weights, corners)
        # In double precision, for small triangles' products of lengths underflow.
        face = cross(edges[0:3].astype(np.float64), edges[3:6].astype(np.float64))
        of_picture = np.abs(first[0] * second[1] - first[1] * second[0])
        height, width = self.levels[0].image.shape[:2]
        pixels = width * height * self.levels[0].repeat.astype(np.float64).prod()
        covered = (
            size.astype(np.float64) ** 2
            * pixels
            * of_picture
            / np.maximum(np.sqrt(dot(face, face)), 1e-290)
        )
        level = np.clip(np.log2(np.maximum(covered, 1)) / 2, 0, len(self.levels) - 1)
        lower = np.minimum(level.astype(np.intp), max(len(self.levels) - 2, 0))
        colors = np.zeros((3, len(level)), np.float32)
        for k, texture in enumerate(self.levels):
            share = np.maximum(1 - np.abs(level - k), 0).astype(np.float32)
            which = np.flatnonzero(((lower == k) | (lower + 1 == k)) & (share > 0))
            if len(which):
                colors[:, which] += texture(place.take(which, axis=1)) * share.take(which)
        return colors


def make_levels(
    image: Floats32, repeat: Floats32, lookup: Callable[..., Floats32]
) -> tuple[Texture, ...]:
    """All levels of a picture (H, W, 3), down to one pixel."""
    levels = [Texture(image, repeat, lookup)]
    exact: Floats64 = image.astype(np.float64)
    while max(exact.shape[:2]) > 1:
        exact = _halved(_halved(exact).swapaxes(0, 1)).swapaxes(0, 1)
        small = np.ascontiguousarray(exact, np.float32)
        levels.append(Texture(small, repeat, lookup))
    return tuple(levels)


def _halved(values: Floats64) -> Floats64:
    """Means (max(n // 2, 1), ...) of rows (n, ...), each over as many of them, fractions included."""
    n = len(values)
    m = max(n // 2, 1)
    sums = np.concatenate((np.zeros_like(values[:1]), np.cumsum(values, axis=0), values[:1] * 0))
    sums[-1] = sums[-2]
    at = np.arange(m + 1) * (n / m)
    whole = at.astype(np.intp)
    share = (at - whole).reshape(-1, *(1,) * (values.ndim - 1))
    until = sums[whole] * (1 - share) + sums[whole + 1] * share
    means: Floats64 = np.diff(until, axis=0) * (m / n)
    return means
