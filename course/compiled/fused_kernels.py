"""The fused loop: sixteen paths from their random numbers to their radiance, compiled by Numba.

It does what ``course.core.integrator`` and its stages do, in the same order of arithmetic and so to the same bits; but
what the stages hand on in arrays stays in the processor's nearest cache, and no step waits for the interpreter's lock.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from course.compiled.clock_kernels import nanoseconds
from course.compiled.lamp_kernels import TIMED, illuminate
from course.compiled.lanes import (
    ABOVE,
    ASKED,
    DIFFUSE,
    HIT,
    HITS,
    JITTER,
    MATERIAL,
    NANOSECONDS,
    NEAR,
    NG,
    NS,
    OFFSET,
    PACKET,
    PATH,
    SHADOW,
    SHADOW_RAYS,
    SIDE,
    SPECULAR,
    TRIANGLE,
    P,
)
from course.compiled.number_kernels import find_pixels, look
from course.compiled.options import LEAN
from course.compiled.packet_kernels import (
    GEOMETRY,
    PRIMITIVE,
    TFAR,
    TO,
    WIDTH,
    U,
    V,
    begin,
    intersect16,
)
from course.compiled.point_kernels import interpolated, place
from course.core.embree import NO_HIT
from course.core.types import Floats32, Indices, Mask, Materials

_NOTHING, _ONE = np.float32(0), np.float32(1)
_FAR = np.float32(NO_HIT)
_X, _Y, _Z = 0, WIDTH, 2 * WIDTH


class Scene(NamedTuple):
    """All triangles; see ``course.core.triangles`` and ``accelerator.SceneTables``."""

    scenes: NDArray[np.uintp]
    velocity: Floats32
    boxes: Floats32
    first: Indices
    planes: Floats32
    edges: Floats32
    inset: Floats32
    corner_normals: Floats32
    bulge: Floats32
    material: Materials
    most: np.float32


class Reflectances(NamedTuple):
    """M materials; see ``course.core.materials`` and ``course.core.integrator``. Without columns where none has one.

    Attributes
    ----------
    given : (3, M) radiance that both sides give off
    emission : (3, M) that of the fronts of lights
    """

    diffuse: Floats32
    specular: Floats32
    exponent: Floats32
    shaded: Mask
    ambient: Floats32
    dark_inside: Mask
    glow: Floats32
    emission: Floats32


@njit(**LEAN)
def _intersect(scene, hint, count, timed, call, arguments, s, whole, counts):
    """Nearest hits of the rays; ``HIT`` masks the rays that have one."""
    for i in range(WIDTH):
        whole[HIT + i] = -1 if i < count else 0
        s[TFAR + i] = _FAR
    lanes = s.view(np.int32)
    for i in range(WIDTH):
        lanes[GEOMETRY + i] = -1
    arguments[0] = hint
    start = nanoseconds(call) if timed else 0
    if scene.scenes[0]:
        intersect16(whole.ctypes.data, scene.scenes[0], s.ctypes.data, arguments.ctypes.data)
    if timed:
        counts[NANOSECONDS] += nanoseconds(call) - start
    arguments[0] = 0
    hits = 0
    for i in range(WIDTH):
        hit = (whole[HIT + i] != 0) & (lanes[GEOMETRY + i] >= 0)
        whole[HIT + i] = -1 if hit else 0
        whole[TRIANGLE + i] = lanes[PRIMITIVE + i] if hit else 0
        hits += hit
    return hits


@njit(**LEAN)
def _find(scene, s, whole):
    """Points, normals and origins of the hits; see ``Surface.hits``."""
    smooth = len(scene.corner_normals) > 0
    planes = scene.planes
    for i in range(WIDTH):
        if whole[HIT + i] == 0:
            continue
        k = np.int64(whole[TRIANGLE + i])
        whole[MATERIAL + i] = scene.material[k]
        a, b = s[U + i], s[V + i]
        dx, dy, dz = s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
        x, y, z = place(k, a, b, planes, scene.edges, scene.inset)
        nx, ny, nz, far = planes[k, 3], planes[k, 4], planes[k, 5], planes[k, 6]
        # A sum that begins with 0, as NumPy's does, is never -0.
        side = np.float32(math.copysign(_ONE, -(_NOTHING + nx * dx + ny * dy + nz * dz)))
        nx, ny, nz = nx * side, ny * side, nz * side
        s[P + i], s[P + _Y + i], s[P + _Z + i] = x, y, z
        s[NG + i], s[NG + _Y + i], s[NG + _Z + i] = nx, ny, nz
        s[NEAR + i], s[NEAR + _Y + i], s[NEAR + _Z + i] = x + nx * far, y + ny * far, z + nz * far
        s[OFFSET + i], s[SIDE + i] = far, side
        if smooth and not planes[k, 7] > 0:
            nx, ny, nz = interpolated(k, a, b, side, dx, dy, dz, scene.corner_normals, True)
        s[NS + i], s[NS + _Y + i], s[NS + _Z + i] = nx, ny, nz


@njit(**LEAN)
def _reflect(materials, s, whole):
    """What the hits send to the viewer into ``DIFFUSE``; see ``DirectLight._reflected`` and ``Integrator._shade``."""
    for c in range(3):
        row = c * WIDTH
        for i in range(WIDTH):
            m = whole[MATERIAL + i]
            light = s[DIFFUSE + row + i] * materials.diffuse[c, m]
            if len(materials.exponent):
                light += s[SPECULAR + row + i] * materials.specular[c, m]
            if materials.ambient.shape[1]:
                dark = len(materials.dark_inside) and materials.dark_inside[m] and s[SIDE + i] < 0
                light += _NOTHING if dark else materials.ambient[c, m]
            if materials.glow.shape[1]:
                light += materials.glow[c, m]
            if materials.emission.shape[1]:
                light += materials.emission[c, m] * (_ONE if s[SIDE + i] > 0 else _NOTHING)
            s[DIFFUSE + row + i] = light


@njit(**LEAN)
def follow(
    numbers,
    eye,
    scene,
    materials,
    lights,
    sky,
    hint,
    radiance,
    offsets,
    cost,
    costs,
    counts,
    s,
    whole,
    arguments,
    call,
):
    """Radiance (3, n) of a block's paths.

    Parameters
    ----------
    sky : (3,) or (0,) of the rays that hit nothing
    hint : of camera rays, for Embree
    radiance : (3, n) filled
    offsets : (2, n) filled with the samples' positions in their pixels; (2, 0) if nobody asks
    cost : (n,) what each path has cost, to be added to; (0,) if nobody asks
    costs : (3,) float32 of a hit, a shadow ray and a further ray
    counts : (COUNTS,) int64, added to
    """
    n = radiance.shape[1]
    for packet in (0, SHADOW, ABOVE):
        part = s[packet : packet + PACKET]
        begin(part, part.view(np.int32))
    for number in range((n + WIDTH - 1) // WIDTH):
        first, timed = number * WIDTH, number % TIMED == 0
        count = min(WIDTH, n - first)
        for i in range(WIDTH):
            whole[PATH + i] = first + min(i, count - 1)
        same = find_pixels(whole, numbers.samples)
        look(numbers, eye, same, call, s, whole)
        if offsets.shape[1]:
            for c in range(2):
                for i in range(count):
                    offsets[c, first + i] = s[JITTER + c * WIDTH + i]
        hits = _intersect(scene, hint, count, timed, call, arguments, s, whole, counts)
        if len(sky) and hits < count:
            for c in range(3):
                for i in range(count):
                    radiance[c, first + i] = _NOTHING if whole[HIT + i] else sky[c]
        else:
            radiance[:, first : first + count] = 0
        if hits == 0:
            continue
        counts[HITS] += hits
        _find(scene, s, whole)
        for i in range(3 * WIDTH):
            s[DIFFUSE + i] = s[SPECULAR + i] = _NOTHING
        if len(cost):
            for i in range(count):
                if whole[HIT + i]:
                    cost[first + i] += costs[0]
        for k in range(len(lights.kind)):
            pair = lights.pair[k]
            shadows = illuminate(
                *(lights, k, scene, materials, numbers, pair, same, timed),
                *(call, arguments, s, whole, counts),
            )
            counts[SHADOW_RAYS] += shadows
            if len(cost) and shadows:
                for i in range(count):
                    if whole[ASKED + i]:
                        cost[first + i] += costs[1]
        _reflect(materials, s, whole)
        for c in range(3):
            for i in range(count):
                if whole[HIT + i]:
                    radiance[c, first + i] += s[DIFFUSE + c * WIDTH + i]
