"""Drawing directions towards a cube map's light, compiled by Numba; imported where it is used, and only then.

It does what ``ProductSampling.sample`` does, in the same order and so to the same bits.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit, types

from course.compiled.options import COLUMNS, OPTIONS, ROW

_guide = types.int32[:, ::1]
_f32 = np.float32


@njit(**OPTIONS)
def _drawn(edges, guide, table, u):
    """One outcome of a table of ``Tables``, what is left of its number, and its probability."""
    part = int(u * _f32(guide.shape[1]))
    first = table * edges.shape[1]
    flat = edges.reshape(-1)
    position = np.int64(guide[table, part])
    while flat[position + 1] <= u:
        position += 1
    low = flat[position]
    probability = flat[position + 1] - low
    return position - first, (u - low) / probability, probability


@njit(**OPTIONS)
def _nearest(x, y, z, normals):
    """Number of the table for a normal; see ``nearest_normal``."""
    half = _f32(normals / 2)
    scale = half / max(abs(x) + abs(y) + abs(z), _f32(1e-20))
    fold = abs(min(z, _f32(0)))
    most = _f32(normals - 1)
    column = min((x + _f32(math.copysign(fold, x))) * scale + half, most)
    row = min((y + _f32(math.copysign(fold, y))) * scale + half, most)
    return int(row) * normals + int(column)


@njit(
    types.void(
        *(COLUMNS, COLUMNS, types.int64, types.int64, COLUMNS),
        *(COLUMNS, _guide) * 4,
        *(COLUMNS, ROW),
    ),
    **OPTIONS,
)
def sample(
    normal,
    u,
    normals,
    cells,
    frames,
    rows,
    rows_guide,
    columns,
    columns_guide,
    texel_rows,
    texel_rows_guide,
    texel_columns,
    texel_columns_guide,
    direction,
    weight,
):
    """Fill directions (3, n) and weights (n,); see ``ProductSampling.sample``.

    Parameters
    ----------
    normal, u : (3, n) and (2, n)
    normals, cells : along the edges of the octahedron's square, and of a face
    frames : (6, 9) of the faces, the middle and the ways along rows and down columns
    rows ... texel_columns_guide : edges and guide of each table
    """
    split = texel_rows.shape[1] - 1
    size = cells * split
    step = _f32(2 / size)
    share = _f32(math.pi * size * size / 4)
    one = _f32(1)
    for i in range(normal.shape[1]):
        nx, ny, nz = normal[0, i], normal[1, i], normal[2, i]
        table = _nearest(nx, ny, nz, normals)
        row, v, density = _drawn(rows, rows_guide, table, u[0, i])
        column, h, probability = _drawn(columns, columns_guide, table * 6 * cells + row, u[1, i])
        density *= probability
        cell = row * cells + column
        texel_row, v, probability = _drawn(texel_rows, texel_rows_guide, cell, v)
        density *= probability
        texel_column, h, probability = _drawn(
            texel_columns, texel_columns_guide, cell * split + texel_row, h
        )
        density *= probability
        face = row // cells
        h = (h + _f32(column * split + texel_column)) * step - one
        v = (v + _f32(row * split + texel_row - face * size)) * step - one
        x = frames[face, 0] + frames[face, 3] * h + frames[face, 6] * v
        y = frames[face, 1] + frames[face, 4] * h + frames[face, 7] * v
        z = frames[face, 2] + frames[face, 5] * h + frames[face, 8] * v
        squared = x * x + y * y + z * z
        density = density * squared * squared * share
        # A sum that begins with 0, as NumPy's does, is never -0.
        weight[i] = (_f32(0) + nx * x + ny * y + nz * z) / density
        scale = one / np.sqrt(squared)
        direction[0, i], direction[1, i], direction[2, i] = x * scale, y * scale, z * scale
