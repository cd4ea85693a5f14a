"""Radiosities at the corners of patches, for a smooth picture and for finding where the light changes.

A patch's radiosity is that of its centre. Around a corner the patches' centres don't lie evenly, least of all at the
rim of a surface, so their mean belongs to another place. A plane through their radiosities tells the corner's own.
"""

from collections.abc import Callable

import numpy as np

from course.engine.core.types import Floats32, Floats64
from course.engine.radiosity.patches import Patches

RIDGE = 1e-6
"""Keeps slopes 0 in directions about which the patches of a corner say nothing, such as that of their normal."""

DARKEST = 0.25
"""Least radiosity of a corner, as a share of the mean of its patches. With less, all contrasts at shadows' edges would
be 1 and could not be compared."""


def at_corners(patches: Patches, radiosity: Floats32) -> Floats32:
    """Radiosity at each corner, from the patches of one smooth surface that meet there.

    By least squares, weighted by area, as a plane over the patches' centres; what the patches then lack of their own
    radiosities is given back to their corners, so that no light is lost. No farther from the
    patches' radiosities than they are apart, for light may also change abruptly, and never black among lit patches.
    ``radiosity``: (3, P) float32.
    Returns (3, 3, P) float32, channels, corners, patches.
    """
    corners, size = patches.triangles.corners, patches.size
    place = np.stack((corners, np.broadcast_to(patches.surface[:, None], corners.shape)), axis=2)
    points, point = np.unique(place.reshape(-1, 2), axis=0, return_inverse=True)
    point = point.ravel()
    vertices = patches.triangles.vertices.astype(np.float64)
    offset = (vertices[corners].mean(axis=1)[:, None] - vertices[corners]).reshape(-1, 3)
    weight = np.repeat(patches.triangles.areas(), 3).astype(np.float64)

    def summed(values: Floats64) -> Floats64:
        return np.asarray(np.bincount(point, values * weight, len(points)), np.float64)

    total = summed(np.ones(len(point)))
    value_at = _planes(offset, summed)
    order = np.argsort(point, kind="stable")
    starts = np.searchsorted(point[order], np.arange(len(points)))
    result = np.empty((3, 3, 2 * size), np.float32)
    for channel in range(3):
        for side in (slice(0, size), slice(size, 2 * size)):
            own = radiosity[channel, side].astype(np.float64)
            light = np.repeat(own, 3)
            low, high = (f.reduceat(light[order], starts) for f in (np.minimum, np.maximum))
            apart = high - low
            corner = value_at(light)
            lacking = own - corner[point].reshape(size, 3).mean(axis=1)
            corner += summed(np.repeat(lacking, 3)) / total
            darkest = np.maximum(low - apart, DARKEST * summed(light) / total)
            corner = np.clip(corner, darkest, high + apart)
            result[channel, :, side] = corner[point].reshape(size, 3).T
    return result


def _planes(
    offset: Floats64, summed: Callable[[Floats64], Floats64]
) -> Callable[[Floats64], Floats64]:
    """For light (n,) of the patches around all points, the heights (points,) of the fitted planes at the points.

    Parameters
    ----------
    offset : (n, 3) from the points to the centres of patches
    summed : weighted sums over the patches of each point, (n,) -> (points,)
    """
    terms = np.concatenate((np.ones((1, len(offset))), offset.T))
    moments = np.array([[summed(a * b) for b in terms] for a in terms])
    moments = np.moveaxis(moments, 2, 0)
    spread = np.trace(moments[:, 1:, 1:], axis1=1, axis2=2)
    moments[:, range(1, 4), range(1, 4)] += RIDGE * spread[:, None]
    # The first row of the inverse is all that the height at the point takes.
    first = np.linalg.solve(moments, np.broadcast_to(np.eye(4)[:, :1], (len(moments), 4, 1)))[
        ..., 0
    ]

    def value_at(light: Floats64) -> Floats64:
        sums = np.stack([summed(term * light) for term in terms], axis=1)
        heights: Floats64 = np.einsum("pk,pk->p", first, sums)
        return heights

    return value_at
