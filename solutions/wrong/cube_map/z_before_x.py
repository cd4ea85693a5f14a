"""Gives edges and corners to z, then y, then x."""

import numpy as np

FUNCTION = "face_and_uv"
CAUGHT_BY = "ties"
MISTAKE = "other-ties"
SAYS = "Inside the faces you are right, but on edges and corners another face than agreed gets the direction: x comes first, then y."


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    x, y, z = direction
    ax, ay, az = np.abs(direction)
    z_face = (az >= ax) & (az >= ay)
    y_face = ~z_face & (ay >= ax)
    x_face = ~z_face & ~y_face
    face = np.where(
        x_face,
        np.where(x > 0, 0, 1),
        np.where(y_face, np.where(y > 0, 2, 3), np.where(z > 0, 4, 5)),
    )
    s = np.choose(face, (-z, z, x, x, x, -x))
    t = np.choose(face, (-y, -y, z, -z, -y, -y))
    size = np.abs(direction).max(axis=0)
    return face, (s / size + 1) / 2, (t / size + 1) / 2
