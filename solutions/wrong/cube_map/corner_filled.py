"""Fills the gap in a corner with the face's own corner texel."""

import numpy as np

FUNCTION = "lookup_seamless"
CAUGHT_BY = "corners"
MISTAKE = "corner-filled"
SAYS = "You fill the gap in the cube's corner with some texel, but there are only three; they share its weight."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    face, column, row = _in_texels(faces, direction)
    i, j = np.floor(column).astype(int), np.floor(row).astype(int)
    total = np.zeros(direction.shape)
    for di in (0, 1):
        for dj in (0, 1):
            ci, cj = i + di, j + dj
            weight = (1 - abs(column - ci)) * (1 - abs(row - cj))
            out_i, out_j = (ci < 0) | (ci >= size), (cj < 0) | (cj >= size)
            # There is no fourth texel in a corner: stay on the own face.
            both = out_i & out_j
            ci = np.where(both, np.clip(ci, 0, size - 1), ci)
            cj = np.where(both, np.clip(cj, 0, size - 1), cj)
            total += weight * _texel(faces, face, ci, cj)
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
