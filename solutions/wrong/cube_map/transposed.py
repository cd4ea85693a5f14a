"""Takes u for the row."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "centres"
MISTAKE = "lookup-transposed"
SAYS = "Rows and columns are mixed up: u counts columns, v counts rows, and rows come first in the array."


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    x, y = u * size - 0.5, v * size - 0.5
    x, y = np.clip(x, 0, size - 1), np.clip(y, 0, size - 1)
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = x - i, y - j
    i1, j1 = np.minimum(i + 1, size - 1), np.minimum(j + 1, size - 1)
    top = (1 - a) * faces[face, i, j].T + a * faces[face, i1, j].T
    bottom = (1 - a) * faces[face, i, j1].T + a * faces[face, i1, j1].T
    return ((1 - b) * top + b * bottom).astype(direction.dtype)
