"""Radiance of one direction in a cube map, compiled by Numba; the functions of ``cube_map``, in their order."""

import numpy as np

from course.engine.loops.options import LEAN, njit

_NOTHING, _HALF, _ONE = np.float32(0), np.float32(0.5), np.float32(1)


@njit(**LEAN)
def on_face(x, y, z, side):
    """The face that a direction leaves the cube through, and the place on it in texels, column and row."""
    if abs(x) >= abs(y) and abs(x) >= abs(z):
        m, face = x, 0
        s, t = -z / m, -y / abs(m)
    elif abs(y) >= abs(z):
        m, face = y, 2
        s, t = x / abs(m), z / m
    else:
        m, face = z, 4
        s, t = x / m, -y / abs(m)
    face += m < 0
    return face, (_HALF * s + _HALF) * side - _HALF, (_HALF * t + _HALF) * side - _HALF


@njit(**LEAN)
def bilinear(faces, face, column, row, c):
    """Channel c of the radiance there, clamped at the face's edges."""
    last = np.float32(faces.shape[1] - 1)
    column, row = min(max(column, _NOTHING), last), min(max(row, _NOTHING), last)
    i, j = int(column), int(row)
    a, b = column - np.float32(i), row - np.float32(j)
    right, down = i + (column < last), j + (row < last)
    top_left, top_right = (_ONE - a) * (_ONE - b), a * (_ONE - b)
    low_left, low_right = (_ONE - a) * b, a * b
    return (
        faces[face, j, i, c] * top_left
        + faces[face, j, right, c] * top_right
        + faces[face, down, i, c] * low_left
        + faces[face, down, right, c] * low_right
    )


@njit(**LEAN)
def _neighbour(face, i, j, size):
    """Face, column and row of the texel that a place beyond an edge of a face is folded to."""
    s, t = 2 * i - (size - 1), 2 * j - (size - 1)
    m = size - (1 if abs(s) > size or abs(t) > size else 0)
    s, t = min(max(s, -size), size), min(max(t, -size), size)
    sign = -1 if face % 2 else 1
    if face < 2:
        x, y, z = sign * m, -t, -sign * s
    elif face < 4:
        x, y, z = s, sign * m, sign * t
    else:
        x, y, z = sign * s, -t, sign * m
    side = np.float64(size)
    # The place is that of a texel's centre, which no rounding takes to another texel.
    face, column, row = on_face(np.float64(x), np.float64(y), np.float64(z), side)
    last = size - 1
    return face, min(max(int(column + 0.5), 0), last), min(max(int(row + 0.5), 0), last)


@njit(**LEAN)
def across(faces, face, column, row, weights, texels):
    """Fill weights (4,) and texels (4, 3) of a place within half a texel of an edge; see ``lookup_seamless``."""
    size = faces.shape[1]
    left, top = np.floor(np.float64(column)), np.floor(np.float64(row))
    w0 = w1 = w2 = w3 = 0.0
    for k in range(4):
        i, j = left + (k & 1), top + (k >> 1)
        weight = (1 - abs(np.float64(column) - i)) * (1 - abs(np.float64(row) - j))
        s, t = 2 * int(i) + 1 - size, 2 * int(j) + 1 - size
        if abs(s) > size and abs(t) > size:
            weight = 0.0
        texels[k, 0], texels[k, 1], texels[k, 2] = _neighbour(face, int(i), int(j), size)
        if k == 0:
            w0 = weight
        elif k == 1:
            w1 = weight
        elif k == 2:
            w2 = weight
        else:
            w3 = weight
    total = w0 + w1 + w2 + w3
    weights[0], weights[1] = np.float32(w0 / total), np.float32(w1 / total)
    weights[2], weights[3] = np.float32(w2 / total), np.float32(w3 / total)


@njit(**LEAN)
def look_up(faces, seamless, x, y, z, weights, texels, color):
    """Radiance from a direction into ``color`` (3,)."""
    side = np.float32(faces.shape[1])
    face, column, row = on_face(x, y, z, side)
    if seamless and (min(column, row) < 0 or max(column, row) > side - _ONE):
        across(faces, face, column, row, weights, texels)
        for c in range(3):
            light = _NOTHING
            for k in range(4):
                light += faces[texels[k, 0], texels[k, 2], texels[k, 1], c] * weights[k]
            color[c] = light
        return
    for c in range(3):
        color[c] = bilinear(faces, face, column, row, c)
