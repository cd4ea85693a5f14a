"""Face after face with masks, and the four texels by interpolation along rows first."""

import numpy as np


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    dtype = direction.dtype
    n = direction.shape[1]
    face, u, v = np.full(n, -1, np.int32), np.empty(n, dtype), np.empty(n, dtype)
    largest = np.abs(direction).max(axis=0)
    table = (
        (0, 1, 2, -1, 1, -1),
        (0, -1, 2, 1, 1, -1),
        (1, 1, 0, 1, 2, 1),
        (1, -1, 0, 1, 2, -1),
        (2, 1, 0, 1, 1, -1),
        (2, -1, 0, -1, 1, -1),
    )
    for number, (axis, side, s_axis, s_sign, t_axis, t_sign) in enumerate(table):
        on = (direction[axis] * side == largest) & (face < 0)
        # Of any length: what is divided by the largest can't leave the numbers' range.
        face[on] = number
        u[on] = 0.5 + 0.5 * s_sign * (direction[s_axis, on] / largest[on])
        v[on] = 0.5 + 0.5 * t_sign * (direction[t_axis, on] / largest[on])
    return face, u, v


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    return _rows_first(faces, direction, np.ones((6, len(faces[0]) + 2, len(faces[0]) + 2)), None)


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    there = np.ones((6, size + 2, size + 2))
    there[:, :: size + 1, :: size + 1] = 0
    # The border's texels, by the direction that leads a little beyond the edge: far enough to leave the face.
    k = (np.arange(size) + 0.5) / size
    beyond = np.full((6, size + 2, size + 2, 3), 0.0)
    beyond[:, 1:-1, 1:-1] = faces
    tiny = 1e-6
    places = (
        (np.s_[0, 1:-1], k, np.full(size, -tiny)),
        (np.s_[-1, 1:-1], k, np.full(size, 1 + tiny)),
        (np.s_[1:-1, 0], np.full(size, -tiny), k),
        (np.s_[1:-1, -1], np.full(size, 1 + tiny), k),
    )
    one = np.ones(size)
    for number in range(6):
        for place, a, b in places:
            s, t = 2 * a - 1, 2 * b - 1
            toward = (
                (one, -t, -s),
                (-one, -t, s),
                (s, one, t),
                (s, -one, -t),
                (s, -t, one),
                (-s, -t, -one),
            )[number]
            f, u, v = face_and_uv(np.stack(toward))
            row, column = (np.clip((x * size).astype(int), 0, size - 1) for x in (v, u))
            beyond[number][place] = faces[f, row, column]
    return _rows_first(faces, direction, there, beyond)


def _rows_first(faces, direction, there, bordered):
    """Bilinear: along two rows, then between them."""
    if bordered is None:
        bordered = np.pad(faces, ((0, 0), (1, 1), (1, 1), (0, 0)), mode="edge")
    size = len(faces[0])
    face, u, v = face_and_uv(direction)
    x, y = u.astype(float) * size + 0.5, v.astype(float) * size + 0.5
    i, j = np.minimum(x.astype(int), size), np.minimum(y.astype(int), size)
    a, b = x - i, y - j
    color = np.concatenate((bordered * there[..., None], there[..., None]), axis=3)
    upper = color[face, j, i].T + a * (color[face, j, i + 1] - color[face, j, i]).T
    lower = color[face, j + 1, i].T + a * (color[face, j + 1, i + 1] - color[face, j + 1, i]).T
    mixed = upper + b * (lower - upper)
    return (mixed[:3] / mixed[3]).astype(direction.dtype)
