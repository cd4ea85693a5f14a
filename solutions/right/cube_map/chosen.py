"""Chooses among all six faces' formulas; beyond an edge asks for the texel's own direction."""

import numpy as np


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    x, y, z = direction
    ax, ay, az = np.abs(direction)
    axis = np.where(np.maximum(ay, az) <= ax, 0, np.where(az <= ay, 1, 2))
    negative = np.choose(axis, (x, y, z)) < 0
    face = axis * 2 + negative
    scale = np.choose(axis, (ax, ay, az))
    s = np.choose(face, (-z, z, x, x, x, -x)) / scale
    t = np.choose(face, (-y, -y, z, -z, -y, -y)) / scale
    return face, (s + 1) / 2, (t + 1) / 2


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    face, u, v = face_and_uv(direction)
    x, y = u * size - 0.5, v * size - 0.5
    x, y = np.clip(x, 0, size - 1), np.clip(y, 0, size - 1)
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = x - i, y - j
    i1, j1 = np.minimum(i + 1, size - 1), np.minimum(j + 1, size - 1)
    top = (1 - a) * faces[face, j, i].T + a * faces[face, j, i1].T
    bottom = (1 - a) * faces[face, j1, i].T + a * faces[face, j1, i1].T
    return ((1 - b) * top + b * bottom).astype(direction.dtype)


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    face, column, row = _in_texels(faces, direction)
    i, j = np.floor(column).astype(int), np.floor(row).astype(int)
    total, weights = np.zeros(direction.shape), 0
    for di in (0, 1):
        for dj in (0, 1):
            ci, cj = i + di, j + dj
            weight = (1 - abs(column - ci)) * (1 - abs(row - cj))
            out_i, out_j = (ci < 0) | (ci >= size), (cj < 0) | (cj >= size)
            weight = np.where(out_i & out_j, 0, weight)
            weights = weights + weight
            total += weight * _texel(faces, face, ci, cj)
    total /= weights
    return total.astype(direction.dtype)


def _texel(faces, face, i, j):
    """A texel's colour; one beyond an edge is the neighbouring face's."""
    size = len(faces[0])
    out = ((i < 0) | (i >= size)) | ((j < 0) | (j >= size))
    s, t = np.clip((2 * i + 1) / size - 1, -1, 1), np.clip((2 * j + 1) / size - 1, -1, 1)
    m = np.where(out, 1 - 1 / size, 1.0)
    center = np.stack(
        (
            np.choose(face, (m, -m, s, s, s, -s)),
            np.choose(face, (-t, -t, m, -m, -t, -t)),
            np.choose(face, (-s, s, t, -t, m, -m)),
        )
    )
    other, u, v = face_and_uv(center)
    i2 = np.clip((u * size).astype(int), 0, size - 1)
    j2 = np.clip((v * size).astype(int), 0, size - 1)
    return faces[other, j2, i2].T
