"""The one ray by which a path goes on from a hit, for a packet's hits, compiled by Numba; a part of the fused loop.

See ``course.engine.terms.paths.bounce``; the functions of ``path_tracing`` keep their order of arithmetic here.
"""

import math
from typing import NamedTuple

import numpy as np

from course.engine.core.types import Floats32, Mask
from course.engine.loops.bounce_kernels import (
    above,
    append,
    bend,
    jitter,
    meet_boundary,
    mirror_image,
)
from course.engine.loops.lanes import (
    AFTER,
    BOUNCES,
    CHOICES,
    DIRECTION,
    HIT,
    KEPT,
    MATERIAL,
    NG,
    NS,
    PATHS,
    SIDE,
    THROUGHPUT,
    TINT,
    WAY,
    A,
    B,
    U,
)
from course.engine.loops.number_kernels import circle, draw
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import WIDTH
from course.engine.terms.paths.bounce import DIFFUSE, LEAST, MIRRORED, REFRACTED

_NOTHING, _ONE = np.float32(0), np.float32(1)
_Y, _Z = WIDTH, 2 * WIDTH
_ENDS = -1


class FusedPaths(NamedTuple):
    """How paths go on.

    Attributes
    ----------
    albedo : (3, M) float32, share of the light that diffuse reflection returns
    optical : (M,) which materials mirror or refract
    roulette : bounces before Russian roulette, -1 for never
    bounce_pair, choice_pair : pairs of dimensions at depth 0
    """

    albedo: Floats32
    optical: Mask
    roulette: int
    bounce_pair: int
    choice_pair: int


@njit(**LEAN)
def _choose(scattering, m, i, s, whole):
    """Choose one of the ways that hit i may take; see ``PathBounce._chosen``."""
    boundaries = len(scattering.refraction_index) > 0
    more = through = _NOTHING
    if boundaries and scattering.refraction_index[m] > 0:
        more = meet_boundary(scattering.refraction_index[m], i, s)
        through = _ONE - more
    diffuse = back = bent = _NOTHING
    for c in range(3):
        beta = s[THROUGHPUT + c * WIDTH + i]
        diffuse = max(diffuse, s[AFTER + c * WIDTH + i])
        back = max(back, (scattering.mirror[c, m] + more) * beta)
        bent = max(bent, through * beta)
    reach = diffuse + back
    total = reach + bent
    level = s[U + i] * total
    if level < diffuse:
        scale = _ONE / max(diffuse, LEAST)
        for c in range(3):
            row = c * WIDTH + i
            s[AFTER + row] = s[AFTER + row] * scale * total
        whole[WAY + i] = DIFFUSE
    elif level < reach or not boundaries:
        scale = _ONE / max(back, LEAST)
        for c in range(3):
            row = c * WIDTH + i
            way = (scattering.mirror[c, m] + more) * s[THROUGHPUT + row]
            s[AFTER + row] = way * scale * total
        whole[WAY + i] = MIRRORED
    else:
        scale = _ONE / max(bent, LEAST)
        for c in range(3):
            row = c * WIDTH + i
            s[AFTER + row] = through * s[THROUGHPUT + row] * scale * total
        whole[WAY + i] = REFRACTED


@njit(**LEAN)
def _end(plays, s, whole):
    """End paths that carry nothing, or by ``russian_roulette``."""
    for i in range(WIDTH):
        q = max(s[AFTER + i], s[AFTER + _Y + i], s[AFTER + _Z + i])
        goes_on = q > 0
        if plays:
            q = min(q, _ONE)
            goes_on = s[U + WIDTH + i] < q
            for c in range(0, 3 * WIDTH, WIDTH):
                s[AFTER + c + i] = s[AFTER + c + i] / q
        whole[WAY + i] = whole[WAY + i] if goes_on else _ENDS


@njit(**LEAN)
def _bounce(smooth, call, s):
    """Directions of ``diffuse_bounce``, of two rows of numbers."""
    circle(call, s, U + WIDTH)
    for i in range(WIDTH):
        u = s[U + i]
        r = np.sqrt(u)
        a, b, c = r * s[A + i], r * s[B + i], np.sqrt(_ONE - u)
        x, y, z = s[NS + i], s[NS + _Y + i], s[NS + _Z + i]
        sign = np.float32(math.copysign(_ONE, z))
        lean = sign * x * a + y * b
        rest = c - lean / (sign + z)
        x, y, z = x * rest + a, y * rest + sign * b, c * z - lean
        if smooth:
            x, y, z = above(x, y, z, s[NG + i], s[NG + _Y + i], s[NG + _Z + i])
        s[DIRECTION + i], s[DIRECTION + _Y + i], s[DIRECTION + _Z + i] = x, y, z


@njit(**LEAN)
def bounce(
    paths,
    scattering,
    dark_inside,
    smooth,
    painted,
    numbers,
    depth,
    stride,
    same,
    call,
    s,
    whole,
    scattered,
    others,
    counts,
):
    """Append the rays by which paths leave a packet's hits to two lists; how many each has got.

    Parameters
    ----------
    dark_inside : (M,), (0,) where no dielectric is dark inside
    smooth, painted : true if the scene has normals that aren't those of its triangles, and if it has textures
    stride : pairs of dimensions that a bounce draws
    scattered, others : (k, 16) float32, from the place on where the next rays go; those of mirrors and glass are others
    """
    optical, hits = False, 0
    for i in range(WIDTH):
        m = np.uint64(whole[MATERIAL + i])
        hit = whole[HIT + i] != 0
        whole[WAY + i] = DIFFUSE if hit else _ENDS
        dark = len(dark_inside) > 0 and dark_inside[m] and not s[SIDE + i] > 0
        for c in range(3):
            row = c * WIDTH + i
            albedo = _NOTHING if dark else paths.albedo[c, m]
            albedo *= s[TINT + row] if painted else _ONE
            s[AFTER + row] = s[THROUGHPUT + row] * albedo
        optical |= hit & paths.optical[m]
        hits += hit
    plays = paths.roulette >= 0 and depth >= paths.roulette
    if plays or optical:
        # One pair for both: which way the light takes, and whether the path survives.
        counts[CHOICES] += 2 * hits if optical else hits
        draw(numbers, paths.choice_pair + depth * stride, 2, same, s, whole, U)
    if optical:
        for i in range(WIDTH):
            m = whole[MATERIAL + i]
            if whole[HIT + i] != 0 and paths.optical[m]:
                _choose(scattering, m, i, s, whole)
    _end(plays, s, whole)
    diffuse = mirrored = refracted = 0
    for i in range(WIDTH):
        diffuse += whole[WAY + i] == DIFFUSE
        mirrored += whole[WAY + i] == MIRRORED
        refracted += whole[WAY + i] == REFRACTED
        whole[KEPT + i] = -1 if whole[WAY + i] == MIRRORED else 0
    counts[PATHS] += diffuse + mirrored + refracted
    if diffuse:
        counts[BOUNCES] += diffuse
        draw(numbers, paths.bounce_pair + depth * stride, 2, same, s, whole, U)
        _bounce(smooth, call, s)
    if mirrored:
        for i in range(WIDTH):
            if whole[KEPT + i]:
                mirror_image(i, s)
        pair = scattering.lobe_pair + depth * stride
        jitter(scattering, numbers, pair, same, call, s, whole, counts)
    near = far = 0
    for i in range(WIDTH):
        way = whole[WAY + i]
        if way == DIFFUSE:
            ray = scattered[near]
            append(scattering, False, ray, ray.view(np.int32), i, s, whole)
            near += 1
        elif way != _ENDS:
            if way == REFRACTED:
                bend(i, s)
            ray = others[far]
            append(scattering, way == REFRACTED, ray, ray.view(np.int32), i, s, whole)
            far += 1
    return near, far
