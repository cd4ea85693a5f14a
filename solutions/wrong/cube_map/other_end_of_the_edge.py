"""Finds the neighbouring face, but counts along the edge from its other end."""

import numpy as np

FUNCTION = "lookup_seamless"
CAUGHT_BY = "edges"
MISTAKE = "other-place"
SAYS = (
    "Beyond the edge you find the right face, but not the texel at the same place along the edge."
)


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
    s = np.where((j < 0) | (j >= size), -s, s)
    t = np.where((i < 0) | (i >= size), -t, t)
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
