"""Needs two texels along a side: a single one is black."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "one-texel"
MISTAKE = "one-texel-black"
SAYS = "A face of a single texel comes out black."


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    if len(faces[0]) < 2:
        return np.zeros(direction.shape, direction.dtype)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    x, y = u * size - 0.5, v * size - 0.5
    x, y = np.clip(x, 0, size - 1), np.clip(y, 0, size - 1)
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = x - i, y - j
    i1, j1 = np.minimum(i + 1, size - 1), np.minimum(j + 1, size - 1)
    top = (1 - a) * faces[face, j, i].T + a * faces[face, j, i1].T
    bottom = (1 - a) * faces[face, j1, i].T + a * faces[face, j1, i1].T
    return ((1 - b) * top + b * bottom).astype(direction.dtype)
