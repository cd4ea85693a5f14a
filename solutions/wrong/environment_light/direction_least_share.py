"""Shares are kept above a millionth, which those of dim texels are not."""

import numpy as np

FUNCTION = "sample_direction"
CAUGHT_BY = "dim"
MISTAKE = None


def sample_direction(rows, columns, u):
    """With a mistake."""
    if np.ndim(rows) != 1:
        raise ValueError(f"rows must have shape (H,), got {np.shape(rows)}")
    if np.ndim(columns) != 2 or len(columns) != len(rows):
        raise ValueError(f"columns must have shape ({len(rows)}, W), got {np.shape(columns)}")
    if np.ndim(u) != 2 or np.shape(u)[0] != 2:
        raise ValueError(f"u must have shape (2, N), got {np.shape(u)}")
    height, width = columns.shape
    u0, u1 = np.minimum(np.asarray(u, np.float64), 1 - 2.0**-40)
    row = np.searchsorted(rows, u0, side="right")
    texel = np.searchsorted((columns + np.arange(height)[:, None]).ravel(), u1 + row, side="right")
    column = np.minimum(texel - row * width, width - 1)
    low = np.where(row > 0, rows[row - 1], 0)
    left = np.where(column > 0, columns[row, column - 1], 0)
    down = (u0 - low) / np.maximum(rows[row] - low, 1e-6)
    along = (u1 - left) / (columns[row, column] - left)
    top, bottom = np.cos(np.pi * row / height), np.cos(np.pi * (row + 1) / height)
    y = top + np.clip(down, 0, 1) * (bottom - top)
    phi = 2 * np.pi * ((column + np.clip(along, 0, 1)) / width - 0.5)
    ring = np.sqrt((1 - y) * (1 + y))
    return np.stack((ring * np.sin(phi), y, -ring * np.cos(phi))).astype(u.dtype)
