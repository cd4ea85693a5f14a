"""Takes for granted that the direction is a point on the cube."""

import numpy as np

FUNCTION = "face_and_uv"
CAUGHT_BY = "length"
MISTAKE = "not-projected"
SAYS = "The direction is taken for a point of the cube: its largest component must become 1 first."


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    x, y, z = direction
    ax, ay, az = np.abs(direction)
    x_face = (ax >= ay) & (ax >= az)
    y_face = ~x_face & (ay >= az)
    face = np.where(
        x_face,
        np.where(x > 0, 0, 1),
        np.where(y_face, np.where(y > 0, 2, 3), np.where(z > 0, 4, 5)),
    )
    s = np.choose(face, (-z, z, x, x, x, -x))
    t = np.choose(face, (-y, -y, z, -z, -y, -y))
    return face, (s + 1) / 2, (t + 1) / 2
