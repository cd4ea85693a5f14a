"""The sum of the weights is kept above a millionth."""

import numpy as np

FUNCTION = "density"
CAUGHT_BY = "faint"
MISTAKE = None


def density(weights, direction):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    if np.ndim(direction) != 2 or np.shape(direction)[0] != 3:
        raise ValueError(f"direction must have shape (3, N), got {np.shape(direction)}")
    height, width = weights.shape
    weights = np.asarray(weights, np.float64)
    x, y, z = np.asarray(direction, np.float64)
    row = np.arctan2(np.hypot(x, z), y) / np.pi * height
    column = (0.5 + np.arctan2(x, -z) / (2 * np.pi)) * width
    row = np.clip(row.astype(np.intp), 0, height - 1)
    column = np.clip(column.astype(np.intp), 0, width - 1)
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = 2 * np.pi / width * (edge[:-1] - edge[1:])
    found = weights[row, column] / (np.maximum(weights.sum(), 1e-6) * solid_angle[row])
    return found.astype(direction.dtype)
