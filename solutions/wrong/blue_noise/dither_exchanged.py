"""Rows and columns of the mask are exchanged."""

import numpy as np

FUNCTION = "dithered_points"
CAUGHT_BY = "values"
MISTAKE = "rows-and-columns-of-the-mask"
SAYS = "Rows and columns of the mask are exchanged."


def dithered_points(points, masks, x, y):
    """With a mistake."""
    if np.ndim(points) != 2 or len(points) != 2:
        raise ValueError(f"points must have shape (2, s), got {np.shape(points)}")
    if np.ndim(masks) != 3 or len(masks) != 2 or not np.size(masks):
        raise ValueError(f"masks must have shape (2, H, W), got {np.shape(masks)}")
    _check_pixels(x, y, 1 << 62)
    height, width = masks.shape[1:]
    shift = (masks[:, x % height, y % width] + 0.5) / (height * width)
    moved = (points[:, None, :] + shift[:, :, None]) % 1
    return moved.astype(points.dtype)
