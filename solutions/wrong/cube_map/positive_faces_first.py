"""Numbers the three positive faces before the negative ones."""

import numpy as np

FUNCTION = "face_and_uv"
CAUGHT_BY = "middles"
MISTAKE = "other-order"
SAYS = "Your faces are numbered in another order; it is +x, -x, +y, -y, +z, -z."


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    x, y, z = direction
    ax, ay, az = np.abs(direction)
    x_face = (ax >= ay) & (ax >= az)
    y_face = ~x_face & (ay >= az)
    true_face = np.where(
        x_face,
        np.where(x > 0, 0, 1),
        np.where(y_face, np.where(y > 0, 2, 3), np.where(z > 0, 4, 5)),
    )
    face = np.where(
        x_face,
        np.where(x > 0, 0, 3),
        np.where(y_face, np.where(y > 0, 1, 4), np.where(z > 0, 2, 5)),
    )
    s = np.choose(true_face, (-z, z, x, x, x, -x))
    t = np.choose(true_face, (-y, -y, z, -z, -y, -y))
    size = np.abs(direction).max(axis=0)
    return face, (s / size + 1) / 2, (t / size + 1) / 2
