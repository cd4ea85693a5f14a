"""Computes in float64, in faces with a border of the neighbours' texels."""

import numpy as np


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    d = direction.astype(np.float64)
    d = d / np.abs(d).max(axis=0)
    axis = np.argmax(np.abs(d) == 1, axis=0)
    ray = np.arange(d.shape[1])
    face = 2 * axis + (d[axis, ray] < 0)
    # Rows of a matrix for each face: what u and v are made of.
    along = np.array([(0, 0, -1), (0, 0, 1), (1, 0, 0), (1, 0, 0), (1, 0, 0), (-1, 0, 0)])
    down = np.array([(0, -1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (0, -1, 0), (0, -1, 0)])
    u = ((along[face].T * d).sum(axis=0) + 1) / 2
    v = ((down[face].T * d).sum(axis=0) + 1) / 2
    return face, u.astype(direction.dtype), v.astype(direction.dtype)


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    padded = np.pad(faces.astype(np.float64), ((0, 0), (1, 1), (1, 1), (0, 0)), mode="edge")
    return _in_padded(padded, np.ones(padded.shape[:3]), direction)


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    padded = np.zeros((6, size + 2, size + 2, 3))
    padded[:, 1:-1, 1:-1] = faces
    # Each face's top, right, bottom and left: the neighbour's border row, read in which sense.
    top, bottom = np.s_[0, :], np.s_[-1, :]
    left, right = np.s_[:, 0], np.s_[:, -1]
    neighbours = (
        ((2, right, -1), (5, left, 1), (3, right, 1), (4, right, 1)),
        ((2, left, 1), (4, left, 1), (3, left, -1), (5, right, 1)),
        ((5, top, -1), (0, top, -1), (4, top, 1), (1, top, 1)),
        ((4, bottom, 1), (0, bottom, 1), (5, bottom, -1), (1, bottom, -1)),
        ((2, bottom, 1), (0, left, 1), (3, top, 1), (1, right, 1)),
        ((2, top, -1), (1, left, 1), (3, bottom, -1), (0, right, 1)),
    )
    places = (np.s_[0, 1:-1], np.s_[1:-1, -1], np.s_[-1, 1:-1], np.s_[1:-1, 0])
    for face, four in enumerate(neighbours):
        for place, (other, side, sense) in zip(places, four, strict=True):
            padded[face][place] = faces[other][side][::sense]
    there = np.ones(padded.shape[:3])
    there[:, [0, 0, -1, -1], [0, -1, 0, -1]] = 0
    return _in_padded(padded, there, direction)


def _in_padded(padded, there, direction):
    """Bilinear in faces with a border of one texel, of which some texels may not be there."""
    size = padded.shape[1] - 2
    face, u, v = face_and_uv(direction.astype(np.float64))
    x, y = u * size + 0.5, v * size + 0.5
    i, j = np.minimum(x.astype(int), size), np.minimum(y.astype(int), size)
    a, b = x - i, y - j
    total, weights = np.zeros((3, len(u))), np.zeros(len(u))
    for di, wi in ((0, 1 - a), (1, a)):
        for dj, wj in ((0, 1 - b), (1, b)):
            weight = wi * wj * there[face, j + dj, i + di]
            total += weight * padded[face, j + dj, i + di].T
            weights += weight
    return (total / weights).astype(direction.dtype)
