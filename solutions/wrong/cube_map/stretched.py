"""Puts the outermost texels' centres on the face's edges."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "centres"
MISTAKE = "lookup-stretched"
SAYS = "You stretch the face so that the outermost texels' centres lie on its edges; they should lie half a texel inside."


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    x, y = u * (size - 1), v * (size - 1)
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = x - i, y - j
    i1, j1 = np.minimum(i + 1, size - 1), np.minimum(j + 1, size - 1)
    top = (1 - a) * faces[face, j, i].T + a * faces[face, j, i1].T
    bottom = (1 - a) * faces[face, j1, i].T + a * faces[face, j1, i1].T
    return ((1 - b) * top + b * bottom).astype(direction.dtype)
