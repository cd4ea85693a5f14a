"""Wraps around on the same face instead of going on to the next."""

import numpy as np

FUNCTION = "lookup_seamless"
CAUGHT_BY = "edges"
MISTAKE = "lookup_seamless-wraps"
SAYS = "Near its edge your face is mixed with its own opposite edge; the texel beyond the edge is not the one at the other end."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    x, y = u * size - 0.5, v * size - 0.5
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = x - i, y - j
    i1, j1 = (i + 1) % size, (j + 1) % size
    top = (1 - a) * faces[face, j, i].T + a * faces[face, j, i1].T
    bottom = (1 - a) * faces[face, j1, i].T + a * faces[face, j1, i1].T
    return ((1 - b) * top + b * bottom).astype(direction.dtype)
