"""Shows the nearest texel alone."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "all-around"
MISTAKE = "lookup-nearest"
SAYS = "You show the nearest texel alone, so the sky is made of squares; mix the four around the place."


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    column = np.minimum((u * size).astype(int), size - 1)
    row = np.minimum((v * size).astype(int), size - 1)
    return faces[face, row, column].T.astype(direction.dtype)
