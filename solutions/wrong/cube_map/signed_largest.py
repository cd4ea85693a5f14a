"""The largest component, sign and all."""

import numpy as np

FUNCTION = "face_and_uv"
CAUGHT_BY = "middles"
MISTAKE = "signed-largest"
SAYS = (
    "You look for the largest component with its sign, so -3 counts less than 1; its size decides."
)


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    x, y, z = direction
    axis = np.argmax(direction, axis=0)
    m = np.choose(axis, (x, y, z))
    face = 2 * axis + (m < 0)
    s = np.choose(face, (-z, z, x, x, x, -x))
    t = np.choose(face, (-y, -y, z, -z, -y, -y))
    size = np.abs(m) + (m == 0)
    return face, (s / size + 1) / 2, (t / size + 1) / 2
