"""Takes the components' sizes in place."""

import numpy as np

FUNCTION = "face_and_uv"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    x, y, z = direction.copy()
    size = np.abs(direction, out=direction)
    axis = np.argmax(size, axis=0)
    face = 2 * axis + (np.choose(axis, (x, y, z)) < 0)
    s = np.choose(face, (-z, z, x, x, x, -x))
    t = np.choose(face, (-y, -y, z, -z, -y, -y))
    largest = size.max(axis=0)
    return face, (s / largest + 1) / 2, (t / largest + 1) / 2
