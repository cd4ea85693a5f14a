"""Radiosities at the corners of patches, for a smooth picture and for finding where the light changes."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32
from course.radiosity.patches import Patches


def at_corners(patches: Patches, radiosity: Floats32) -> Floats32:
    """Means over the patches that meet at each corner and belong to one smooth surface, weighted by area.

    Parameters
    ----------
    radiosity : (3, P) float32

    Returns
    -------
    (3, 3, P) float32, channels, corners, patches
    """
    corners, size = patches.triangles.corners, patches.size
    place = np.stack((corners, np.broadcast_to(patches.surface[:, None], corners.shape)), axis=2)
    points, point = np.unique(place.reshape(-1, 2), axis=0, return_inverse=True)
    point = point.ravel()
    weight = np.repeat(patches.triangles.areas(), 3)
    total = np.bincount(point, weight, len(points))
    result = np.empty((3, 3, 2 * size), np.float32)
    for channel in range(3):
        for side in (slice(0, size), slice(size, 2 * size)):
            light = np.repeat(radiosity[channel, side], 3) * weight
            mean = np.bincount(point, light, len(points)) / total
            result[channel, :, side] = mean[point].reshape(size, 3).T
    return result
