"""One ray at a time, in plain Python numbers."""

import numpy as np


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    columns = [_one(*map(float, column)) for column in direction.T]
    face, u, v = zip(*columns, strict=True) if columns else ((), (), ())
    dtype = direction.dtype
    return np.array(face, int), np.array(u, dtype), np.array(v, dtype)


def _one(x, y, z):
    """Face, u and v of one direction."""
    largest = max(abs(x), abs(y), abs(z))
    if abs(x) == largest:
        face, s, t = (0, -z, -y) if x > 0 else (1, z, -y)
    elif abs(y) == largest:
        face, s, t = (2, x, z) if y > 0 else (3, x, -z)
    else:
        face, s, t = (4, x, -y) if z > 0 else (5, -x, -y)
    return face, (s / largest + 1) / 2, (t / largest + 1) / 2


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    return _all(faces, direction, seamless=False)


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    return _all(faces, direction, seamless=True)


def _all(faces, direction, seamless):
    size = faces.shape[1]
    colors = np.empty(direction.shape, direction.dtype)
    texels = faces.astype(float).tolist()
    for ray, column in enumerate(direction.T):
        face, u, v = _one(*map(float, column))
        x, y = u * size - 0.5, v * size - 0.5
        i, j = int(x // 1), int(y // 1)
        total, weights = [0.0, 0.0, 0.0], 0.0
        for ci, cj in ((i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)):
            weight = (1 - abs(x - ci)) * (1 - abs(y - cj))
            out_i, out_j = not 0 <= ci < size, not 0 <= cj < size
            if weight == 0 or (seamless and out_i and out_j):
                continue
            if seamless and (out_i or out_j):
                f, cj, ci = _across(face, ci, cj, size)
            else:
                f, cj, ci = face, min(max(cj, 0), size - 1), min(max(ci, 0), size - 1)
            weights += weight
            for channel in range(3):
                total[channel] += weight * texels[f][cj][ci][channel]
        colors[:, ray] = [channel / weights for channel in total]
    return colors


def _across(face, i, j, size):
    """Face, row and column of a texel one beyond an edge."""
    s, t = (2 * i + 1) / size - 1, (2 * j + 1) / size - 1
    # As far beyond the edge as it is allowed to be low on the neighbour.
    s, t, m = min(max(s, -1), 1), min(max(t, -1), 1), 1 - 1 / size
    x, y, z = (
        (m, -t, -s),
        (-m, -t, s),
        (s, m, t),
        (s, -m, -t),
        (s, -t, m),
        (-s, -t, -m),
    )[face]
    f, u, v = _one(x, y, z)
    return f, min(int(v * size), size - 1), min(int(u * size), size - 1)
