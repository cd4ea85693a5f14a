"""Light that arrives from the environment at a packet's hits, compiled by Numba; a part of the fused loop.

It does what ``course.engine.terms.environments.sky`` and ``ProductSampling.sample`` do, in the same order and so to
the same bits.
"""

import math
from typing import NamedTuple

import numpy as np

from course.engine.core.types import Floats32, Mask, Numbers
from course.engine.loops.clock_kernels import nanoseconds
from course.engine.loops.cube_kernels import look_up
from course.engine.loops.lanes import (
    ASKED,
    DIFFUSE,
    HIT,
    MATERIAL,
    NANOSECONDS,
    NEAR,
    NG,
    NS,
    OTHERS,
    PACKET,
    SHADOW,
    SHADOW_TFAR,
    SHADOW_TO,
    SIDE,
    SKY,
    TIME,
    A,
    U,
)
from course.engine.loops.number_kernels import draw
from course.engine.loops.occlusion_kernels import occlude
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import WIDTH
from course.engine.terms.environments.sky import FAR

_f32 = np.float32
_FAR, _NOTHING = np.float32(FAR), np.float32(0)
_Y, _Z = WIDTH, 2 * WIDTH


class Product(NamedTuple):
    """``ProductSampling.arrays``."""

    normals: int
    cells: int
    frames: Floats32
    rows: Floats32
    rows_guide: Numbers
    columns: Floats32
    columns_guide: Numbers
    texel_rows: Floats32
    texel_rows_guide: Numbers
    texel_columns: Floats32
    texel_columns_guide: Numbers


class FusedSky(NamedTuple):
    """A cube map that lights surfaces.

    Attributes
    ----------
    diffuses, refracts : (M,) of ``course.engine.terms.environments.sky.Sky``; (0,) if nothing is lit
    faces, seamless : of the cube map
    pair : pair of dimensions at depth 0
    """

    diffuses: Mask
    refracts: Mask
    faces: Floats32
    seamless: bool
    pair: int
    product: Product


@njit(**LEAN)
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


@njit(**LEAN)
def _nearest(x, y, z, normals):
    """Number of the table for a normal; see ``nearest_normal``."""
    half = _f32(normals / 2)
    scale = half / max(abs(x) + abs(y) + abs(z), _f32(1e-20))
    fold = abs(min(z, _f32(0)))
    most = _f32(normals - 1)
    column = min((x + _f32(math.copysign(fold, x))) * scale + half, most)
    row = min((y + _f32(math.copysign(fold, y))) * scale + half, most)
    return int(row) * normals + int(column)


@njit(**LEAN)
def directed(product, nx, ny, nz, u, w):
    """A direction for a normal and two numbers, and its weight; see ``ProductSampling.sample``."""
    split = product.texel_rows.shape[1] - 1
    size = product.cells * split
    step = _f32(2 / size)
    share = _f32(math.pi * size * size / 4)
    one = _f32(1)
    table = _nearest(nx, ny, nz, product.normals)
    row, v, density = _drawn(product.rows, product.rows_guide, table, u)
    column, h, probability = _drawn(
        product.columns, product.columns_guide, table * 6 * product.cells + row, w
    )
    density *= probability
    cell = row * product.cells + column
    texel_row, v, probability = _drawn(product.texel_rows, product.texel_rows_guide, cell, v)
    density *= probability
    texel_column, h, probability = _drawn(
        product.texel_columns, product.texel_columns_guide, cell * split + texel_row, h
    )
    density *= probability
    face = row // product.cells
    h = (h + _f32(column * split + texel_column)) * step - one
    v = (v + _f32(row * split + texel_row - face * size)) * step - one
    x = product.frames[face, 0] + product.frames[face, 3] * h + product.frames[face, 6] * v
    y = product.frames[face, 1] + product.frames[face, 4] * h + product.frames[face, 7] * v
    z = product.frames[face, 2] + product.frames[face, 5] * h + product.frames[face, 8] * v
    squared = x * x + y * y + z * z
    density = density * squared * squared * share
    # A sum that begins with 0, as NumPy's does, is never -0.
    weight = (_f32(0) + nx * x + ny * y + nz * z) / density
    scale = one / np.sqrt(squared)
    return x * scale, y * scale, z * scale, weight


@njit(**LEAN)
def shine(sky, scene, numbers, pair, same, timed, scratch, counts):
    """Add the environment's light at the hits to DIFFUSE; how many rays were cast for it, from the hits in ASKED."""
    s, whole = scratch.s, scratch.whole
    lit = 0
    for i in range(WIDTH):
        m = whole[MATERIAL + i]
        shows = whole[HIT + i] != 0 and sky.diffuses[m]
        shows = shows and (s[SIDE + i] > 0 or not sky.refracts[m])
        whole[ASKED + i] = -1 if shows else 0
        lit += shows
    if lit == 0:
        return 0
    counts[SKY] += lit
    draw(numbers, pair, 2, same, s, whole, U)
    cast = 0
    for i in range(WIDTH):
        if whole[ASKED + i] == 0:
            continue
        nx, ny, nz = s[NS + i], s[NS + _Y + i], s[NS + _Z + i]
        x, y, z, weight = directed(sky.product, nx, ny, nz, s[U + i], s[U + WIDTH + i])
        up = _NOTHING + x * s[NG + i] + y * s[NG + _Y + i] + z * s[NG + _Z + i]
        outwards = up > 0 and weight > 0
        whole[ASKED + i] = -1 if outwards else 0
        cast += outwards
        s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i] = x, y, z
        s[A + i], s[SHADOW_TFAR + i] = weight, _FAR
        for c in range(0, 3 * WIDTH, WIDTH):
            s[SHADOW + c + i] = s[NEAR + c + i]
    if cast == 0:
        return 0
    start = nanoseconds(scratch.call) if timed else 0
    occlude(
        scene.blockers,
        scene.velocity,
        scene.boxes,
        s[TIME : TIME + WIDTH],
        0,
        WIDTH,
        s[SHADOW : SHADOW + PACKET],
        whole[ASKED : ASKED + WIDTH],
        whole[OTHERS : OTHERS + WIDTH],
        scratch.arguments,
    )
    if timed:
        counts[NANOSECONDS] += nanoseconds(scratch.call) - start
    for i in range(WIDTH):
        if whole[ASKED + i] == 0 or not s[SHADOW_TFAR + i] >= 0:
            continue
        x, y, z = s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i]
        look_up(sky.faces, sky.seamless, x, y, z, scratch.weights, scratch.texels, scratch.color)
        for c in range(3):
            s[DIFFUSE + c * WIDTH + i] += scratch.color[c] * s[A + i]
    return cast
