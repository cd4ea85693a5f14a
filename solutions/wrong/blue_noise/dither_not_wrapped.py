"""Your points leave [0, 1): what goes out on one side has to come in on the other."""

import numpy as np

FUNCTION = "dithered_points"
CAUGHT_BY = "unit"
MISTAKE = "not-modulo-1"
SAYS = "Your points leave [0, 1): what goes out on one side has to come in on the other."


def dithered_points(points, masks, x, y):
    """With a mistake."""
    if np.ndim(points) != 2 or len(points) != 2:
        raise ValueError(f"points must have shape (2, s), got {np.shape(points)}")
    if np.ndim(masks) != 3 or len(masks) != 2 or not np.size(masks):
        raise ValueError(f"masks must have shape (2, H, W), got {np.shape(masks)}")
    _check_pixels(x, y, 1 << 62)
    height, width = masks.shape[1:]
    shift = (masks[:, y % height, x % width] + 0.5) / (height * width)
    moved = points[:, None, :] + shift[:, :, None]
    return moved.astype(points.dtype)
