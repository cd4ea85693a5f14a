"""Shows the nearest texel alone: without mixing there is nothing to be seamless."""

import numpy as np

FUNCTION = "lookup_seamless"
CAUGHT_BY = "all-around"
MISTAKE = "lookup_seamless-nearest"
SAYS = "You show the nearest texel alone, so the sky is made of squares; mix the four around the place."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    column = np.minimum((u * size).astype(int), size - 1)
    row = np.minimum((v * size).astype(int), size - 1)
    return faces[face, row, column].T.astype(direction.dtype)
