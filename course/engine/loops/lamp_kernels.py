"""Direct light at a packet's hits, compiled by Numba; a part of the fused loop.

The functions of ``soft_shadows`` place points on lights here, in the same order of arithmetic; see
``course.engine.core.direct`` and ``course.engine.core.lights``.
"""

import math
from typing import NamedTuple

import numpy as np

from course.engine.core.lights.sample import CLOSEST, TO_THE_LIGHT
from course.engine.core.lights.sample import RAISED as END
from course.engine.core.types import Floats32, Floats64, Indices, Mask
from course.engine.loops import numpy_kernels
from course.engine.loops.cap_kernels import towards_cap
from course.engine.loops.clock_kernels import nanoseconds
from course.engine.loops.lanes import (
    ABOVE,
    ASKED,
    CLEAR,
    COSINE,
    CUT_OFF,
    DIFFUSE,
    FACTOR,
    HIT,
    INVERSE,
    IRRADIANCE,
    MATERIAL,
    NANOSECONDS,
    NEAR,
    NG,
    NS,
    OTHERS,
    PACKET,
    POINT,
    RAISED,
    SECOND_RAYS,
    SENT,
    SHADOW,
    SHADOW_TFAR,
    SHADOW_TO,
    SIDE,
    SPECULAR,
    TIME,
    TRIANGLE,
    A,
    B,
    C,
    D,
    E,
    P,
    U,
)
from course.engine.loops.mesh_kernels import Meshes, towards_triangles
from course.engine.loops.number_kernels import circle, draw, take
from course.engine.loops.occlusion_kernels import occlude
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import TFAR, TO, WIDTH
from course.engine.loops.packet_kernels import U as HIT_U
from course.engine.loops.packet_kernels import V as HIT_V
from course.engine.loops.shaft_kernels import spare

AT_A_POINT, FAR_AWAY, RECTANGLE, SPHERE, BALL, FACING_DISK, VISIBLE, TRIANGLES, SPOT = range(9)
"""Kinds of lights."""

_NOTHING, _ONE, _TWO = np.float32(0), np.float32(1), np.float32(2)
_LEAST = np.float32(CLOSEST * CLOSEST)
_LEAST_HALF, _LEAST_COSINE = np.float32(1e-12), np.float32(1e-6)
_TO_THE_LIGHT = np.float32(TO_THE_LIGHT)
_Y, _Z = WIDTH, 2 * WIDTH

TIMED = 16
"""One packet of this many is timed: looking at the clock costs as much as a ray."""


class Lights(NamedTuple):
    """L lights.

    Attributes
    ----------
    kind : (L,) AT_A_POINT ... SPOT
    emitter : (L,) 0 for a light by intensity, 1 for one by radiance, 2 if both its sides shine
    place : (L, 3, 3) float32: position, centre, corner or direction to the light; edges, or the axis of a cone and its
        ``SpotLight.falloff``
    normal : (L, 3) float64 of flat emitters
    radius : (L, 4) float32, the radius, its double, -1 / radius, and its square
    color : (L, 3) float32
    limit : (L,) float32 length of the shadow rays, in lengths of the vector to the light
    velocity : (L, 3) float32; of no meaning where ``moves`` (L,) is false
    pair, width : (L,) first pair of dimensions at depth 0, and the number of dimensions
    placed : (L,) the first row in ``Numbers.placed`` at depth 0; -1 where the loop places points
    meshes : of those that are made of triangles
    """

    kind: Indices
    emitter: Indices
    place: Floats32
    normal: Floats64
    radius: Floats32
    color: Floats32
    limit: Floats32
    velocity: Floats32
    moves: Mask
    pair: Indices
    width: Indices
    placed: Indices
    meshes: Meshes


@njit(**LEAN)
def _on_sphere(call, s, radius, twice):
    """``point_on_sphere`` around the origin, from two rows of numbers."""
    circle(call, s, U + WIDTH)
    for i in range(WIDTH):
        u = s[U + i]
        r = twice * np.sqrt(u * (_ONE - u))
        s[SHADOW_TO + i] = r * s[A + i]
        s[SHADOW_TO + _Y + i] = r * s[B + i]
        s[SHADOW_TO + _Z + i] = radius * (_ONE - _TWO * u)


@njit(**LEAN)
def _within_cone(axis, falloff, s):
    """What of its intensity a ``SpotLight`` sends to each hit, into ``FACTOR``."""
    outer, edge = falloff[0], falloff[1]
    for i in range(WIDTH):
        inverse = s[INVERSE + i]
        x = -s[SHADOW_TO + i] * inverse - axis[0]
        y = -s[SHADOW_TO + _Y + i] * inverse - axis[1]
        z = -s[SHADOW_TO + _Z + i] * inverse - axis[2]
        share = (outer - (_NOTHING + x * x + y * y + z * z) / _TWO) / edge
        share = min(max(share, _NOTHING), _ONE)
        share *= share
        s[FACTOR + i] *= share * share


@njit(**LEAN)
def _on_rectangle(lights, k, s):
    """``point_on_rectangle``."""
    for c in range(3):
        corner, along, down = lights.place[k, 0, c], lights.place[k, 1, c], lights.place[k, 2, c]
        for i in range(WIDTH):
            s[SHADOW_TO + c * WIDTH + i] = along * s[U + i] + corner + down * s[U + WIDTH + i]


@njit(**LEAN)
def _on_facing_disk(call, s, radius, x0, y0, z0):
    """``point_on_facing_disk``."""
    circle(call, s, U + WIDTH)
    for i in range(WIDTH):
        x, y, z = x0 - s[POINT + i], y0 - s[POINT + _Y + i], z0 - s[POINT + _Z + i]
        length = np.sqrt(x * x + y * y + z * z)
        length = length if length > 0 else _ONE
        x, y, z = x / length, y / length, z / length
        r = radius * np.sqrt(s[U + i])
        a, b = r * s[A + i], r * s[B + i]
        sign = np.float32(math.copysign(_ONE, z))
        projected = y * b + a * x * sign
        along = projected / (sign + z)
        s[SHADOW_TO + i] = a - x * along + x0
        s[SHADOW_TO + _Y + i] = sign * b - y * along + y0
        s[SHADOW_TO + _Z + i] = -projected + z0


@njit(**LEAN)
def _towards_visible(call, s, squared_radius, x0, y0, z0):
    """``VisibleSphereLight.sample``: fill ``SHADOW_TO``, ``INVERSE`` and ``FACTOR``."""
    circle(call, s, U + WIDTH)
    for i in range(WIDTH):
        x, y, z = x0 - s[POINT + i], y0 - s[POINT + _Y + i], z0 - s[POINT + _Z + i]
        squared = _NOTHING + x * x + y * y + z * z
        x, y, z, s[INVERSE + i], s[FACTOR + i] = towards_cap(
            x, y, z, squared, squared_radius, s[U + i], s[A + i], s[B + i]
        )
        s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i] = x, y, z


@njit(**LEAN)
def choose(lights, k, numbers, depth, stride, same, s, whole):
    """What each path needs for a point on light k: numbers, or in ``SHADOW_TO`` the point, if it is placed before."""
    if lights.placed[k] >= 0:
        take(numbers.placed, lights.placed[k] + 3 * depth, 3, s, whole, SHADOW_TO)
    elif lights.width[k]:
        pair = lights.pair[k] + depth * stride
        draw(numbers, pair, 2, same, s, whole, U)
        if lights.width[k] > 2:
            draw(numbers, pair + 1, 1, same, s, whole, U + 2 * WIDTH)


@njit(**LEAN)
def _sample(lights, k, call, s):
    """A point on light k for each hit: fill ``SHADOW_TO``, ``INVERSE`` and ``FACTOR`` as ``Light.sample`` does."""
    kind, emitter, placed = lights.kind[k], lights.emitter[k], lights.placed[k] >= 0
    x0, y0, z0 = lights.place[k, 0, 0], lights.place[k, 0, 1], lights.place[k, 0, 2]
    if kind == FAR_AWAY:
        for i in range(WIDTH):
            s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i] = x0, y0, z0
            s[INVERSE + i] = s[FACTOR + i] = _ONE
        return
    if kind == VISIBLE:
        _towards_visible(call, s, lights.radius[k, 3], x0, y0, z0)
        return
    if kind == TRIANGLES:
        towards_triangles(lights.meshes, k, s)
        return
    radius, twice, inward = lights.radius[k, 0], lights.radius[k, 1], lights.radius[k, 2]
    if kind in (AT_A_POINT, SPOT):
        for i in range(WIDTH):
            s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i] = x0, y0, z0
    elif kind == RECTANGLE:
        if not placed:
            _on_rectangle(lights, k, s)
    elif kind == FACING_DISK:
        _on_facing_disk(call, s, radius, x0, y0, z0)
    else:
        if kind == BALL and not placed:
            _on_sphere(call, s, _ONE, _TWO)
            third = U + 2 * WIDTH
            numpy_kernels.cbrt(call, s[third : third + WIDTH], s[C : C + WIDTH])
            for i in range(WIDTH):
                far = radius * s[C + i]
                for c in range(3):
                    s[SHADOW_TO + c * WIDTH + i] *= far
        elif not placed:
            _on_sphere(call, s, radius, twice)
        if emitter:
            for c in range(3):
                for i in range(WIDTH):
                    # Adding 0, as the function does to its points around the origin, makes a 0 of -0.
                    s[SHADOW_TO + c * WIDTH + i] += _NOTHING
                    s[D + c * WIDTH + i] = s[SHADOW_TO + c * WIDTH + i]
        if emitter or not placed:
            for i in range(WIDTH):
                s[SHADOW_TO + i] += x0
                s[SHADOW_TO + _Y + i] += y0
                s[SHADOW_TO + _Z + i] += z0
    for i in range(WIDTH):
        x = s[SHADOW_TO + i] - s[POINT + i]
        y = s[SHADOW_TO + _Y + i] - s[POINT + _Y + i]
        z = s[SHADOW_TO + _Z + i] - s[POINT + _Z + i]
        factor = _ONE / max(x * x + y * y + z * z, _LEAST)
        s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i] = x, y, z
        s[INVERSE + i], s[FACTOR + i] = np.sqrt(factor), factor
    if kind == SPOT:
        _within_cone(lights.place[k, 1], lights.place[k, 2], s)
    if not emitter:
        return
    if kind == SPHERE:
        for i in range(WIDTH):
            cosine = (
                _NOTHING
                + s[D + i] * s[SHADOW_TO + i]
                + s[D + _Y + i] * s[SHADOW_TO + _Y + i]
                + s[D + _Z + i] * s[SHADOW_TO + _Z + i]
            )
            cosine = cosine * s[INVERSE + i] * inward
            s[FACTOR + i] *= cosine if cosine > 0 else _NOTHING
        return
    nx, ny, nz = lights.normal[k, 0], lights.normal[k, 1], lights.normal[k, 2]
    for i in range(WIDTH):
        height = nx * (np.float64(s[POINT + i]) - np.float64(x0))
        height += ny * (np.float64(s[POINT + _Y + i]) - np.float64(y0))
        height += nz * (np.float64(s[POINT + _Z + i]) - np.float64(z0))
        cosine = np.float32(height) * s[INVERSE + i]
        s[FACTOR + i] *= abs(cosine) if emitter > 1 else (cosine if cosine > 0 else _NOTHING)


@njit(**LEAN)
def _bulge(bulge, k, u, v):
    """Height of the round surface above a triangle's point; see ``course.engine.core.ray_offset``."""
    w = _ONE - u - v
    return _NOTHING + bulge[k, 0] * (w * u) + bulge[k, 1] * (w * v) + bulge[k, 2] * (u * v)


@njit(**LEAN)
def _raise(bulge, most, limit, s, whole):
    """Raise the origins of shadow rays from facets that face away from the light; how many.

    See ``DirectLight.visible``.
    """
    raised = 0
    for i in range(WIDTH):
        whole[RAISED + i] = 0
    for i in range(WIDTH):
        if whole[ASKED + i] == 0 or not s[COSINE + i] <= most:
            continue
        facing = (
            s[NG + i] * s[SHADOW_TO + i]
            + s[NG + _Y + i] * s[SHADOW_TO + _Y + i]
            + s[NG + _Z + i] * s[SHADOW_TO + _Z + i]
        )
        if not facing <= 0:
            continue
        height = _bulge(bulge, whole[TRIANGLE + i], s[HIT_U + i], s[HIT_V + i]) * s[SIDE + i]
        if not height > 0:
            continue
        raised += 1
        whole[RAISED + i] = -1
        s[ABOVE + TFAR + i] = _ONE
        for c in range(0, 3 * WIDTH, WIDTH):
            up = s[NS + c + i] * height
            s[ABOVE + c + i] = s[SHADOW + c + i]
            s[ABOVE + TO + c + i] = up
            s[SHADOW + c + i] += up
            if limit <= _TO_THE_LIGHT:
                s[SHADOW_TO + c + i] -= up
    return raised


@njit(**LEAN)
def _short_of(normal, s):
    """``FlatLight.short_of``."""
    nx, ny, nz = np.float32(normal[0]), np.float32(normal[1]), np.float32(normal[2])
    for i in range(WIDTH):
        x, y, z = s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i]
        half = (_NOTHING + nx * x + ny * y + nz * z) / -_TWO
        half = min(max(half, -END), END)
        s[SHADOW_TO + i], s[SHADOW_TO + _Y + i] = x + nx * half, y + ny * half
        s[SHADOW_TO + _Z + i] = z + nz * half


@njit(**LEAN)
def _highlight(exponent, color, call, s, whole):
    """Add a light's highlights to ``SPECULAR``; see ``blinn_phong_highlight``. Matt materials have the exponent -1."""
    some = False
    for i in range(WIDTH):
        s[D + i] = exponent[np.uint64(whole[MATERIAL + i])]
        shines = (s[IRRADIANCE + i] > 0) & (s[D + i] >= 0)
        whole[OTHERS + i] = -1 if shines else 0
        some |= shines
    if not some:
        return
    for i in range(WIDTH):
        scale = s[INVERSE + i]
        x = s[POINT + i] * scale - s[TO + i]
        y = s[POINT + _Y + i] * scale - s[TO + _Y + i]
        z = s[POINT + _Z + i] * scale - s[TO + _Z + i]
        squared = _NOTHING + x * x + y * y + z * z
        cosine = _NOTHING + x * s[NS + i] + y * s[NS + _Y + i] + z * s[NS + _Z + i]
        cosine /= np.sqrt(max(squared, _LEAST_HALF))
        cosine = min(max(cosine, _LEAST_COSINE), _ONE)
        s[C + i] = cosine if whole[OTHERS + i] else _ONE
    numpy_kernels.log(call, s[C : C + WIDTH], s[E : E + WIDTH])
    for i in range(WIDTH):
        s[D + i] *= s[E + i]
    numpy_kernels.exp(call, s[D : D + WIDTH], s[E : E + WIDTH])
    for c in range(3):
        for i in range(WIDTH):
            light = s[E + i] * s[IRRADIANCE + i] * color[c]
            s[SPECULAR + c * WIDTH + i] += light if whole[OTHERS + i] else _NOTHING


@njit(**LEAN)
def _block(lights, k, scene, sent, timed, scratch, counts):
    """Send the shadow rays in a mask; how many begin above their facets.

    Nanoseconds and second rays above facets are added to ``counts``.
    """
    call, arguments, s, whole = scratch.call, scratch.arguments, scratch.s, scratch.whole
    limit, raised = lights.limit[k], 0
    if limit <= _TO_THE_LIGHT:
        for i in range(3 * WIDTH):
            s[SHADOW_TO + i] = s[SHADOW_TO + i] + s[P + i] - s[NEAR + i]
    if lights.emitter[k] and (lights.kind[k] == AT_A_POINT or lights.kind[k] == RECTANGLE):
        _short_of(lights.normal[k], s)
    if len(scene.bulge):
        raised = _raise(scene.bulge, scene.most, limit, s, whole)
        counts[SECOND_RAYS] += raised
    start = nanoseconds(call) if timed else 0
    time, others = s[TIME : TIME + WIDTH], whole[OTHERS : OTHERS + WIDTH]
    scenes, velocity, boxes = scene.blockers, scene.velocity, scene.boxes
    if raised:
        above, mask = s[ABOVE : ABOVE + PACKET], whole[RAISED : RAISED + WIDTH]
        occlude(scenes, velocity, boxes, time, 0, WIDTH, above, mask, others, arguments)
    packet, mask = s[SHADOW : SHADOW + PACKET], whole[sent : sent + WIDTH]
    occlude(scenes, velocity, boxes, time, 0, WIDTH, packet, mask, others, arguments)
    if timed:
        counts[NANOSECONDS] += nanoseconds(call) - start
    return raised


@njit(**LEAN)
def illuminate(lights, k, scene, shafts, materials, timed, scratch, counts):
    """Add what hits reflect of light k, but for the reflectances, to ``DIFFUSE`` and ``SPECULAR``; how many may be lit.

    ``choose`` comes first. ``ASKED`` are the hits that cast a shadow ray. Nanoseconds and second rays above facets are
    added to ``counts``.
    """
    call, s, whole = scratch.call, scratch.s, scratch.whole
    for i in range(3 * WIDTH):
        s[SHADOW + i], s[POINT + i] = s[NEAR + i], s[P + i]
    if lights.moves[k]:
        for c in range(3):
            for i in range(WIDTH):
                s[POINT + c * WIDTH + i] -= lights.velocity[k, c] * s[TIME + i]
    _sample(lights, k, call, s)
    for i in range(WIDTH):
        cosine = (
            _NOTHING
            + s[NS + i] * s[SHADOW_TO + i]
            + s[NS + _Y + i] * s[SHADOW_TO + _Y + i]
            + s[NS + _Z + i] * s[SHADOW_TO + _Z + i]
        )
        cosine *= s[INVERSE + i]
        s[COSINE + i] = cosine
        s[IRRADIANCE + i] = cosine * s[FACTOR + i]
    candidates = 0
    shaded = materials.shaded
    for i in range(WIDTH):
        faces = (whole[HIT + i] != 0) & (s[IRRADIANCE + i] > 0)
        if len(shaded) and faces:
            row = 1 if len(shaded) > 1 and not s[SIDE + i] > 0 else 0
            faces = shaded[row, whole[MATERIAL + i]]
        whole[ASKED + i] = -1 if faces else 0
        candidates += faces
    if candidates == 0:
        return 0
    limit, sends, sent, raised = lights.limit[k], True, ASKED, 0
    for i in range(WIDTH):
        s[SHADOW_TFAR + i] = limit
    for i in range(3 * WIDTH):
        # The light is looked at from the hit, and the shadow ray begins above it.
        s[POINT + i] = s[SHADOW_TO + i]
    if len(shafts.slot) and shafts.slot[k] >= 0:
        clear, cut = spare(shafts, k, s, whole, scratch)
        counts[CLEAR] += clear
        counts[CUT_OFF] += cut
        sends, sent = clear + cut < candidates, SENT
    if sends:
        raised = _block(lights, k, scene, sent, timed, scratch, counts)
    # Embree sets tfar to minus infinity where something is in the way.
    for i in range(WIDTH):
        free = (whole[ASKED + i] != 0) & (s[SHADOW_TFAR + i] >= 0)
        if raised:
            free &= (whole[RAISED + i] == 0) | (s[ABOVE + TFAR + i] >= 0)
        s[IRRADIANCE + i] = s[IRRADIANCE + i] if free else _NOTHING
    for c in range(3):
        color = lights.color[k, c]
        for i in range(WIDTH):
            s[DIFFUSE + c * WIDTH + i] += s[IRRADIANCE + i] * color
    if len(materials.exponent):
        color = lights.color[k]
        _highlight(materials.exponent, color, call, s, whole)
    return candidates
