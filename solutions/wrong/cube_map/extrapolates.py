"""Clamps the texels but not the weights."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "clamped"
MISTAKE = "lookup-extrapolates"
SAYS = "Near its edge your face goes on as a ramp, beyond the colours of its texels; the weights must stay between 0 and 1."


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    x, y = u * size - 0.5, v * size - 0.5
    i = np.clip(np.floor(x).astype(int), 0, max(size - 2, 0))
    j = np.clip(np.floor(y).astype(int), 0, max(size - 2, 0))
    a, b = x - i, y - j
    i1, j1 = np.minimum(i + 1, size - 1), np.minimum(j + 1, size - 1)
    top = (1 - a) * faces[face, j, i].T + a * faces[face, j, i1].T
    bottom = (1 - a) * faces[face, j1, i].T + a * faces[face, j1, i1].T
    return ((1 - b) * top + b * bottom).astype(direction.dtype)
