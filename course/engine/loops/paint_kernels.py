"""Textures at a packet's hits, compiled by Numba; a part of the fused loop.

See ``course.engine.terms.surfaces.painting`` and ``textures``; the functions of the ``textures`` module keep their
order of arithmetic here.
"""

from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numpy.typing import NDArray

from course.engine.core.types import Floats32, Floats64, Indices, Mask, Numbers
from course.engine.loops import numpy_kernels
from course.engine.loops.lanes import (
    HIT,
    OTHERS,
    PLACE,
    TINT,
    TRIANGLE,
    WEIGHTS,
    A,
    B,
    C,
    D,
    E,
    F,
)
from course.engine.loops.noise_kernels import grey
from course.engine.loops.options import APART, LEAN, njit
from course.engine.loops.packet_kernels import WIDTH, U, V
from course.engine.terms.surfaces.normal_maps import STEP

NOISE, RECTANGLE, SPHERE, MESH = range(4)
"""What a texture is: noise, or a picture on such a shape."""

_NOTHING, _HALF, _ONE = np.float32(0), np.float32(0.5), np.float32(1)
_PI, _TURN = np.float32(np.pi), np.float32(2 * np.pi)
_Y, _Z = WIDTH, 2 * WIDTH


class FusedPainting(NamedTuple):
    """K textures or reliefs on R of T triangles; see ``Painting``. Without triangles where there are none.

    Attributes
    ----------
    row, corners, number : of ``Painting``
    kind : (K,) NOISE ... MESH
    frame : (K, 9) float32 of a rectangle: its corner, and what to multiply a way from there by for u and for v
    address : (K,) of pictures (H, W, 3) float32
    size : (K, 2) width and height
    repeat : (K, 2) float32
    nearest, absolute : (K,) of ``Texture``, and of noise whose amount counts
    raises : (K,) reliefs that are heights; the others are pictures of normals
    wraps : (K,) of ``NormalMap``
    height, step : (K,) float64 and (K, 2) float32, of ``BumpMap`` and ``PictureHeights``
    """

    row: Numbers
    corners: Floats32
    number: NDArray[np.uint16]
    kind: Indices
    frame: Floats32
    address: NDArray[np.uintp]
    size: Indices
    repeat: Floats32
    nearest: Mask
    absolute: Mask
    raises: Mask
    wraps: Mask
    height: Floats64
    step: Floats32


@intrinsic
def _number_at(_context: Any, _address: Any, _place: Any) -> Any:
    """The float32 that stands so many numbers behind an address: pictures differ in size, and none is copied."""

    def generate(_target: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        begin = builder.inttoptr(arguments[0], ir.PointerType(ir.FloatType()))
        return builder.load(builder.gep(begin, [arguments[1]]))

    return types.float32(types.uintp, types.int64), generate


@njit(**LEAN)
def find_rows(painting, whole):
    """Rows of paint of the hits into OTHERS, -1 without one; whether there is any."""
    some = False
    for i in range(WIDTH):
        row = painting.row[np.uint64(whole[TRIANGLE + i])] if whole[HIT + i] else np.int32(-1)
        whole[OTHERS + i] = row
        if row >= 0:
            some = True
    return some


@njit(**LEAN)
def weigh(corner, s):
    """Barycentrics of the hits into WEIGHTS, or of places ``STEP`` nearer to corner 1 or 2; 0 for the hits' own."""
    for i in range(WIDTH):
        p, q = s[U + i], s[V + i]
        s[WEIGHTS + i], s[WEIGHTS + _Y + i], s[WEIGHTS + _Z + i] = _ONE - p - q, p, q
        if corner:
            s[WEIGHTS + i] -= STEP
            s[WEIGHTS + corner * WIDTH + i] += STEP


@njit(**LEAN)
def between(painting, row, i, s):
    """What a row's corners carry, weighed by lane i's WEIGHTS."""
    corners = painting.corners
    a, b, c = s[WEIGHTS + i], s[WEIGHTS + _Y + i], s[WEIGHTS + _Z + i]
    return (
        a * corners[row, 0] + b * corners[row, 3] + c * corners[row, 6],
        a * corners[row, 1] + b * corners[row, 4] + c * corners[row, 7],
        a * corners[row, 2] + b * corners[row, 5] + c * corners[row, 8],
    )


@njit(**APART)
def find_places(painting, place, call, s, whole):
    """Places u and v in the pictures, into two rows; see ``Places``."""
    rounds = False
    for i in range(WIDTH):
        row = whole[OTHERS + i]
        s[A + i] = s[B + i] = s[C + i] = _ONE
        if row < 0:
            continue
        k = painting.number[row]
        kind = painting.kind[k]
        if kind == NOISE:
            continue
        x, y, z = between(painting, row, i, s)
        if kind == SPHERE:
            rounds = True
            s[A + i], s[B + i], s[C + i] = x, y, z
        elif kind == RECTANGLE:
            frame = painting.frame
            x, y, z = x - frame[k, 0], y - frame[k, 1], z - frame[k, 2]
            s[place + i] = frame[k, 3] * x + frame[k, 4] * y + frame[k, 5] * z
            s[place + _Y + i] = frame[k, 6] * x + frame[k, 7] * y + frame[k, 8] * z
        else:
            s[place + i], s[place + _Y + i] = x, y
    if not rounds:
        return
    for i in range(WIDTH):
        s[D + i] = -s[C + i]
    x, y, z = s[A : A + WIDTH], s[B : B + WIDTH], s[C : C + WIDTH]
    numpy_kernels.arctan2(call, s[D : D + WIDTH], x, s[E : E + WIDTH])
    numpy_kernels.hypot(call, x, z, s[F : F + WIDTH])
    numpy_kernels.arctan2(call, y, s[F : F + WIDTH], s[D : D + WIDTH])
    for i in range(WIDTH):
        row = whole[OTHERS + i]
        if row >= 0 and painting.kind[painting.number[row]] == SPHERE:
            u = s[E + i] / _TURN
            s[place + i] = u + (_ONE if u < 0 else _NOTHING)
            s[place + _Y + i] = s[D + i] / _PI + _HALF


@njit(**LEAN)
def _texels(place, size):
    """The texels on both sides of a place among so many, and how far it is behind the first."""
    first = np.floor(place)
    share = place - first
    # Places that are no numbers take some texel. The neighbour beyond an edge is at the opposite one.
    i = np.int64(first) if -_ONE <= first < np.float32(size) else np.int64(0)
    i = i + size if i < 0 else i
    return i, (i + 1 if i + 1 < size else np.int64(0)), share


@njit(**LEAN)
def _mixed(address, channel, texels, shares):
    """A channel of four texels."""
    return (
        _number_at(address, texels[0] + channel) * shares[0]
        + _number_at(address, texels[1] + channel) * shares[1]
        + _number_at(address, texels[2] + channel) * shares[2]
        + _number_at(address, texels[3] + channel) * shares[3]
    )


@njit(**APART)
def look_up(painting, k, u, v):
    """Colours of picture k at a place; see ``Texture`` and ``texture_lookup``."""
    width, height = painting.size[k, 0], painting.size[k, 1]
    wide, high = np.float32(width), np.float32(height)
    u, v = u * painting.repeat[k, 0], v * painting.repeat[k, 1]
    if painting.nearest[k]:
        u, v = (np.floor(u * wide) + _HALF) / wide, (np.floor(v * high) + _HALF) / high
    u, v = u - np.floor(u), v - np.floor(v)
    left, right, a = _texels(u * wide - _HALF, width)
    top, below, b = _texels((_ONE - v) * high - _HALF, height)
    first, second = (_ONE - a) * (_ONE - b), a * (_ONE - b)
    third, fourth = (_ONE - a) * b, a * b
    address = painting.address[k]
    top_left, top_right = 3 * (top * width + left), 3 * (top * width + right)
    low_left, low_right = 3 * (below * width + left), 3 * (below * width + right)
    texels, shares = (top_left, top_right, low_left, low_right), (first, second, third, fourth)
    return (
        _mixed(address, 0, texels, shares),
        _mixed(address, 1, texels, shares),
        _mixed(address, 2, texels, shares),
    )


@njit(**APART)
def paint(painting, call, s, whole):
    """Colours of the hits into TINT, 1 where there is no texture; see ``Painting.tint``."""
    for i in range(3 * WIDTH):
        s[TINT + i] = _ONE
    if not find_rows(painting, whole):
        return
    weigh(0, s)
    find_places(painting, PLACE, call, s, whole)
    for i in range(WIDTH):
        row = whole[OTHERS + i]
        if row < 0:
            continue
        k = painting.number[row]
        if painting.kind[k] == NOISE:
            x, y, z = between(painting, row, i, s)
            red = green = blue = grey(painting.absolute[k], x, y, z)
        else:
            red, green, blue = look_up(painting, k, s[PLACE + i], s[PLACE + _Y + i])
        s[TINT + i], s[TINT + _Y + i], s[TINT + _Z + i] = red, green, blue
