"""Reflected and refracted rays of a packet's hits, compiled by Numba; a part of the fused loop.

See ``course.engine.core.scatter`` and ``course.engine.core.gloss``; the functions of ``glossy`` keep their order of
arithmetic here.
"""

import math
from typing import NamedTuple

import numpy as np

from course.engine.core.types import Floats32, Indices, Mask, Media, Numbers
from course.engine.loops import numpy_kernels
from course.engine.loops.lanes import (
    AFTER,
    BENT,
    COSINE,
    DIRECTION,
    ETA,
    GLOSSY,
    HIT,
    KEPT,
    MATERIAL,
    MEDIUM,
    NEAR,
    NG,
    NS,
    OFFSET,
    PATH,
    REFLECTIONS,
    REFRACTIONS,
    SHARE,
    SIDE,
    THROUGHPUT,
    TIME,
    TRIANGLE,
    WAY,
    A,
    B,
    D,
    E,
    F,
    P,
    U,
)
from course.engine.loops.number_kernels import circle, draw
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import TO, WIDTH

PLANE, IN_BALL, PHONG = range(3)
"""Kinds of lobes."""

RAY = 16
"""Numbers of a ray that waits: origin, direction, throughput, path, time, object left, medium, starting point."""

_NOTHING, _HALF, _ONE, _TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
_LEAST = np.float32(1e-20)
_Y, _Z = WIDTH, 2 * WIDTH


class FusedScattering(NamedTuple):
    """What mirrors and refracts; see ``course.engine.core.scatter.Scatter``.

    Attributes
    ----------
    mirror : (3, M); without columns if nothing is scattered
    refraction_index : (M,), (0,) if nothing refracts
    outside : (M,) int16, (0,) if vacuum is around all dielectrics
    lobe_material, lobe_kind, lobe_parameter : (K,) of the lobes; the parameter is what the functions multiply by
    lobe_width : (K,) random numbers
    lobe_shift : (K,) pairs by which a lobe's numbers stand behind those of the widest, where they are drawn before
    lobe_pair : pair of dimensions at depth 0, of the widest lobe
    first, worth : of ``ConvexObjects``; (0,) where no ray is spared
    """

    mirror: Floats32
    refraction_index: Floats32
    outside: Media
    lobe_material: Indices
    lobe_kind: Indices
    lobe_parameter: Floats32
    lobe_width: Indices
    lobe_shift: Indices
    lobe_pair: int
    first: Numbers
    worth: Mask
    cutoff: np.float32


@njit(**LEAN)
def fresnel(index, side, cosine):
    """Reflectance, cosine of the refracted ray and ratio of indices; see ``course.engine.core.fresnel_refraction``."""
    eta = _ONE / index if side > 0 else index
    sine = np.sqrt((_ONE - cosine) * (_ONE + cosine)) * eta
    squared = (_ONE - sine) * (_ONE + sine)
    if not squared > 0:
        return _ONE, _NOTHING, eta
    bent = np.sqrt(squared)
    s = (eta * cosine - bent) / max(eta * cosine + bent, _LEAST)
    p = (cosine - eta * bent) / max(cosine + eta * bent, _LEAST)
    return min((s * s + p * p) * _HALF, _ONE), bent, eta


@njit(**LEAN)
def above(x, y, z, nx, ny, nz):
    """A direction, mirrored to the side of the normal; see ``kept_above``."""
    below = x * nx + y * ny + z * nz
    if below < 0:
        below += below
        return x - below * nx, y - below * ny, z - below * nz
    return x, y, z


@njit(**LEAN)
def _leave(scattering, i, s, whole):
    """The convex object that a ray leaves outwards, or -1; see ``excluded_objects``."""
    first = scattering.first
    if len(first) == 0:
        return -1
    up = (
        s[DIRECTION + i] * s[NG + i]
        + s[DIRECTION + _Y + i] * s[NG + _Y + i]
        + s[DIRECTION + _Z + i] * s[NG + _Z + i]
    )
    if not up * s[SIDE + i] > 0:
        return -1
    number = 0
    for k in range(1, len(scattering.worth)):
        number += whole[TRIANGLE + i] >= first[k]
    return number if scattering.worth[number] else -1


@njit(**LEAN)
def append(scattering, through, ray, integers, i, s, whole):
    """Write a ray that leaves hit i, whose throughput is in AFTER, into (16,) numbers."""
    for c in range(3):
        row = c * WIDTH + i
        origin = s[NEAR + row]
        if through:
            origin -= s[NG + row] * (s[OFFSET + i] + s[OFFSET + i])
        ray[c], ray[3 + c], ray[6 + c] = origin, s[DIRECTION + row], s[AFTER + row]
        ray[13 + c] = s[P + row]
    ray[10] = s[TIME + i]
    medium, m = whole[MEDIUM + i], whole[MATERIAL + i]
    if through:
        outside = np.int32(scattering.outside[m]) if len(scattering.outside) else np.int32(-1)
        medium = m if s[SIDE + i] > 0 else outside
    integers[9], integers[11], integers[12] = (
        whole[PATH + i],
        _leave(scattering, i, s, whole),
        medium,
    )


@njit(**LEAN)
def _jitter(scattering, k, call, s, whole):
    """Jitter the mirrored directions of lobe k's material by the functions of ``glossy``."""
    kind, parameter = scattering.lobe_kind[k], scattering.lobe_parameter[k]
    if kind == PLANE:
        for i in range(WIDTH):
            a, b = parameter * (s[U + i] - _HALF), parameter * (s[U + WIDTH + i] - _HALF)
            scale = _ONE / np.sqrt(_ONE + a * a + b * b)
            s[D + i], s[E + i], s[F + i] = a * scale, b * scale, scale
    elif kind == PHONG:
        for i in range(WIDTH):
            s[E + i] = -s[U + i]
        numpy_kernels.log1p(call, s[E : E + WIDTH], s[D : D + WIDTH])
        for i in range(WIDTH):
            s[D + i] *= parameter
            s[E + i] = _TWO * s[D + i]
        numpy_kernels.expm1(call, s[E : E + WIDTH], s[F : F + WIDTH])
        for i in range(WIDTH):
            s[U + i] = np.sqrt(-s[F + i])
        numpy_kernels.exp(call, s[D : D + WIDTH], s[F : F + WIDTH])
        _angle(call, s)
        for i in range(WIDTH):
            s[D + i] *= s[U + i]
            s[E + i] *= s[U + i]
    else:
        third = U + 2 * WIDTH
        numpy_kernels.cbrt(call, s[third : third + WIDTH], s[F : F + WIDTH])
        _angle(call, s)
        for i in range(WIDTH):
            u, radius = s[U + i], parameter * s[F + i]
            ring = radius * (_TWO * np.sqrt(u * (_ONE - u)))
            s[D + i] *= ring
            s[E + i] *= ring
            s[F + i] = radius * (_ONE - _TWO * u)
    for i in range(WIDTH):
        if whole[KEPT + i] == 0 or whole[MATERIAL + i] != scattering.lobe_material[k]:
            continue
        x, y, z = s[DIRECTION + i], s[DIRECTION + _Y + i], s[DIRECTION + _Z + i]
        a, b, c = s[D + i], s[E + i], s[F + i]
        if kind == IN_BALL:
            x, y, z = x + a, y + b, z + c
            length = np.sqrt(_NOTHING + x * x + y * y + z * z)
            x, y, z = x / length, y / length, z / length
        else:
            sign = np.float32(math.copysign(_ONE, z))
            projected = y * b + a * x * sign
            along = c - projected / (sign + z)
            x, y, z = x * along + a, y * along + sign * b, c * z - projected
        nx, ny, nz = s[NG + i], s[NG + _Y + i], s[NG + _Z + i]
        below = min(_NOTHING + x * nx + y * ny + z * nz, _NOTHING)
        below = -_TWO * below
        s[DIRECTION + i] = nx * below + x
        s[DIRECTION + _Y + i] = ny * below + y
        s[DIRECTION + _Z + i] = nz * below + z


@njit(**LEAN)
def _angle(call, s):
    """Cosine and sine of the second row of numbers, as shares of a turn, into D and E."""
    circle(call, s, U + WIDTH)
    for i in range(WIDTH):
        s[D + i], s[E + i] = s[A + i], s[B + i]


@njit(**LEAN)
def mirror_image(i, s):
    """Direction of the ray that hit i reflects."""
    dx, dy, dz = s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
    nx, ny, nz = s[NS + i], s[NS + _Y + i], s[NS + _Z + i]
    twice = dx * nx + dy * ny + dz * nz
    twice += twice
    x, y, z = above(
        dx - twice * nx,
        dy - twice * ny,
        dz - twice * nz,
        s[NG + i],
        s[NG + _Y + i],
        s[NG + _Z + i],
    )
    s[DIRECTION + i], s[DIRECTION + _Y + i], s[DIRECTION + _Z + i] = x, y, z


@njit(**LEAN)
def bend(i, s):
    """Direction of the ray that hit i refracts."""
    eta = s[ETA + i]
    along = eta * s[COSINE + i] - s[BENT + i]
    x, y, z = above(
        s[TO + i] * eta + s[NS + i] * along,
        s[TO + _Y + i] * eta + s[NS + _Y + i] * along,
        s[TO + _Z + i] * eta + s[NS + _Z + i] * along,
        -s[NG + i],
        -s[NG + _Y + i],
        -s[NG + _Z + i],
    )
    s[DIRECTION + i], s[DIRECTION + _Y + i], s[DIRECTION + _Z + i] = x, y, z


@njit(**LEAN)
def meet_boundary(index, i, s):
    """Reflectance at hit i of a material with an index of refraction, which SHARE, BENT, ETA and COSINE keep."""
    cosine = -(
        _NOTHING
        + s[TO + i] * s[NS + i]
        + s[TO + _Y + i] * s[NS + _Y + i]
        + s[TO + _Z + i] * s[NS + _Z + i]
    )
    cosine = min(_NOTHING if cosine < 0 else cosine, _ONE)
    share, bent, eta = fresnel(index, s[SIDE + i], cosine)
    s[SHARE + i], s[BENT + i], s[ETA + i], s[COSINE + i] = share, bent, eta, cosine
    return share


@njit(**LEAN)
def _mirror(scattering, s, whole):
    """Throughput and direction of the reflected rays, into AFTER and DIRECTION, and which there are, into KEPT.

    Of dielectrics also what refraction needs: COSINE of the incoming ray, and SHARE, BENT and ETA of ``fresnel``.
    """
    kept = 0
    for i in range(WIDTH):
        whole[KEPT + i] = 0
        if whole[HIT + i] == 0:
            continue
        m, share = whole[MATERIAL + i], _NOTHING
        s[SHARE + i] = _ONE
        if len(scattering.refraction_index) and scattering.refraction_index[m] > 0:
            share = meet_boundary(scattering.refraction_index[m], i, s)
        whole[WAY + i] = 0
        most = passed = _NOTHING
        for c in range(3):
            weight = (scattering.mirror[c, m] + share) * s[THROUGHPUT + c * WIDTH + i]
            s[AFTER + c * WIDTH + i] = weight
            most = max(most, weight)
            if s[SHARE + i] < 1:
                passed = max(passed, (_ONE - share) * s[THROUGHPUT + c * WIDTH + i])
        if s[SHARE + i] < 1 and not min(most, passed) > scattering.cutoff:
            # All light takes the stronger way; see ``course.engine.core.scatter``.
            if most < passed:
                whole[WAY + i] = -1
                continue
            most = _NOTHING
            for c in range(3):
                s[AFTER + c * WIDTH + i] += (_ONE - share) * s[THROUGHPUT + c * WIDTH + i]
                most = max(most, s[AFTER + c * WIDTH + i])
            s[SHARE + i] = _ONE
        if not most > scattering.cutoff:
            continue
        kept += 1
        whole[KEPT + i] = -1
        mirror_image(i, s)
    return kept


@njit(**LEAN)
def _refract(scattering, s, whole):
    """The same of the refracted rays."""
    kept = 0
    for i in range(WIDTH):
        whole[KEPT + i] = 0
        if whole[HIT + i] == 0 or not s[SHARE + i] < 1:
            continue
        passed, most = _ONE - s[SHARE + i], _NOTHING
        for c in range(3):
            weight = passed * s[THROUGHPUT + c * WIDTH + i]
            if whole[WAY + i]:
                share = scattering.mirror[c, whole[MATERIAL + i]] + s[SHARE + i]
                weight = share * s[THROUGHPUT + c * WIDTH + i] + weight
            s[AFTER + c * WIDTH + i] = weight
            most = max(most, weight)
        if not most > scattering.cutoff:
            continue
        kept += 1
        whole[KEPT + i] = -1
        bend(i, s)
    return kept


@njit(**LEAN)
def jitter(scattering, numbers, pair, same, call, s, whole, counts):
    """Jitter the mirrored directions of the glossy hits in KEPT."""
    for k in range(len(scattering.lobe_material)):
        found = 0
        for i in range(WIDTH):
            kept, m = whole[KEPT + i] != 0, whole[MATERIAL + i]
            found += kept & (m == scattering.lobe_material[k])
        if found == 0:
            continue
        first = pair + scattering.lobe_shift[k]
        draw(numbers, first, 2, same, s, whole, U)
        if scattering.lobe_width[k] > 2:
            draw(numbers, first + 1, 1, same, s, whole, U + 2 * WIDTH)
        counts[GLOSSY] += scattering.lobe_width[k] * found
        _jitter(scattering, k, call, s, whole)


@njit(**LEAN)
def scatter(scattering, numbers, pair, same, call, s, whole, reflected, refracted, counts):
    """Append the rays that leave a packet's hits to two lists; how many each has got.

    Parameters
    ----------
    pair : of the gloss's numbers at this depth
    reflected, refracted : (k, 16) float32, from the place on where the next rays go
    """
    back = through = 0
    if _mirror(scattering, s, whole):
        jitter(scattering, numbers, pair, same, call, s, whole, counts)
        for i in range(WIDTH):
            if whole[KEPT + i]:
                ray = reflected[back]
                append(scattering, False, ray, ray.view(np.int32), i, s, whole)
                back += 1
        counts[REFLECTIONS] += back
    if len(scattering.refraction_index) and _refract(scattering, s, whole):
        for i in range(WIDTH):
            if whole[KEPT + i]:
                ray = refracted[through]
                append(scattering, True, ray, ray.view(np.int32), i, s, whole)
                through += 1
        counts[REFRACTIONS] += through
    return back, through
