"""Results are views: rows of one array, transposed colours; the face is a small integer."""

import numpy as np


def face_and_uv(direction):
    """The face, and the place on it."""
    _check_batch("direction", direction, 3)
    size = np.abs(direction)
    axis = size.argmax(axis=0)
    columns = np.arange(direction.shape[1])
    largest = direction[axis, columns]
    face = (2 * axis + np.signbit(largest)).astype(np.int8)
    x, y, z = direction.astype(float) / np.abs(largest)
    s = np.choose(face, (-z, z, x, x, x, -x))
    t = np.choose(face, (-y, -y, z, -z, -y, -y))
    place = np.empty((direction.shape[1], 2), direction.dtype)
    place[:, 0], place[:, 1] = (s + 1) / 2, (t + 1) / 2
    return face, *place.T


def lookup(faces, direction):
    """A border of the outermost texels all around, in double precision."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = faces.shape[1]
    padded = np.pad(faces.astype(float), ((0, 0), (1, 1), (1, 1), (0, 0)), mode="edge")
    face, u, v = face_and_uv(direction.astype(float))
    x, y = u * size + 0.5, v * size + 0.5
    i, j = x.astype(int).clip(0, size), y.astype(int).clip(0, size)
    a, b = (x - i)[:, None], (y - j)[:, None]
    top = padded[face, j, i] * (1 - a) + padded[face, j, i + 1] * a
    bottom = padded[face, j + 1, i] * (1 - a) + padded[face, j + 1, i + 1] * a
    return (top * (1 - b) + bottom * b).T.astype(direction.dtype)
