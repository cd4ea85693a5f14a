"""The fused loop: from the random numbers of paths to their radiance, a packet at a time, compiled by Numba.

It does what ``course.engine.core.integrator`` and its stages do, in the same order of arithmetic and so to the same
bits; but what the stages hand on in arrays stays in the processor's nearest cache, and no step waits for the
interpreter's lock.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from course.engine.core.accelerator import NO_HIT
from course.engine.core.ray_offset import OFFSET as LEAST_OFFSET
from course.engine.core.types import Floats32, Floats64, Indices, Mask, Materials
from course.engine.loops import numpy_kernels
from course.engine.loops.bounce_kernels import RAY, scatter
from course.engine.loops.clock_kernels import nanoseconds
from course.engine.loops.cube_kernels import look_up
from course.engine.loops.daylight_kernels import shine
from course.engine.loops.lamp_kernels import TIMED, choose, illuminate
from course.engine.loops.lanes import (
    ABOVE,
    ASKED,
    CORNERS,
    DIFFUSE,
    EDGES,
    HIT,
    HITS,
    JITTER,
    LEFT,
    LIT,
    MATERIAL,
    MEDIUM,
    NANOSECONDS,
    NEAR,
    NG,
    NS,
    OFFSET,
    OTHERS,
    PACKET,
    PATH,
    PLANE,
    SHADOW,
    SHADOW_RAYS,
    SIDE,
    SPECULAR,
    START,
    THROUGHPUT,
    TIME,
    TINT,
    TRIANGLE,
    A,
    B,
    C,
    D,
    P,
)
from course.engine.loops.number_kernels import (
    alike,
    ask_for_next,
    consecutive,
    find_pixels,
    look,
)
from course.engine.loops.occlusion_kernels import keep, shift, unshift
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import (
    GEOMETRY,
    PRIMITIVE,
    TFAR,
    TO,
    WIDTH,
    U,
    V,
    begin,
    intersect,
)
from course.engine.loops.packets import COHERENT
from course.engine.loops.paint_kernels import FusedPainting, paint
from course.engine.loops.path_kernels import bounce
from course.engine.loops.point_kernels import pull, to_viewer
from course.engine.loops.relief_kernels import carve
from course.engine.loops.shaft_kernels import find_cells

CHUNK = 1024
"""Paths that are followed together: so many that packets stay full after a bounce, so few that their rays stay in the
second-level cache."""

PATH_CHUNK = 2048
"""The same of paths that send one ray on: many end at each depth, so more of them go together."""

LARGEST = 16 * CHUNK
"""Rays of one depth that are followed together. Glass may double them, so longer lists are halved, as batches are."""

NOTHING, MISSED, MET = range(3)
"""What has become of a ray."""

_NOTHING, _ONE = np.float32(0), np.float32(1)
_FAR, _LEAST, _STEP = np.float32(NO_HIT), np.float32(1e-20), np.float32(LEAST_OFFSET)
_LESS, _MORE = np.float32(1 - 1e-6), np.float32(1 + 1e-6)
_Y, _Z = WIDTH, 2 * WIDTH
_EDGE_2 = 3 * WIDTH


class FusedScene(NamedTuple):
    """All triangles; see ``course.engine.core.triangles``, ``accelerator.SceneTables`` and ``convex.ConvexObjects``.

    Attributes
    ----------
    scenes, blockers : (1 + K,) addresses, of the latter shadow rays are asked
    first : (1 + K,) the first triangle of what stands still and of each mover
    objects : (2 K, 3) boxes of objects of which some are convex; (0, 3) where none is left out
    painting, relief : textures, and what bends normals
    """

    scenes: NDArray[np.uintp]
    blockers: NDArray[np.uintp]
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
    objects: Floats32
    painting: FusedPainting
    relief: FusedPainting


class Reflectances(NamedTuple):
    """M materials; see ``materials`` and ``integrator`` of ``course.engine.core``. Without columns where none has one.

    ``objects``: radiance from both sides that shadow rays sample, as paths show it
    """

    diffuse: Floats32
    specular: Floats32
    exponent: Floats32
    shaded: Mask
    ambient: Floats32
    dark_inside: Mask
    glow: Floats32
    emission: Floats32
    objects: Floats32
    absorption: Floats32
    dielectric: Mask


class Surroundings(NamedTuple):
    """What rays see that hit nothing.

    Attributes
    ----------
    color : (3,) of a constant environment, else of no meaning
    faces : (6, S, S, 3) of a cube map, else (6, 0, 0, 3)
    seamless : see ``CubeEnvironment``
    depth : see ``Integrator.environment_depth``
    """

    color: Floats32
    faces: Floats32
    seamless: bool
    depth: int


class Depths(NamedTuple):
    """Most bounces, depth up to which neighbours go together, and pairs of dimensions that a bounce draws.

    ``seen`` : pairs that camera rays and what they see draw
    """

    bounces: int
    coherent: int
    pairs: int
    seen: int


class FusedFilm(NamedTuple):
    """What is filled.

    Attributes
    ----------
    radiance : (3, n) of each path
    offsets : (2, n) positions of the samples in their pixels; (2, 0) if nobody asks
    cost : (n,) what each path has cost, to be added to; (0,) if nobody asks
    prices : (4,) of a hit, a shadow ray, a further ray, and a ray to the environment for its light
    counts : (COUNTS,) int64, added to
    """

    radiance: Floats32
    offsets: Floats32
    cost: Floats32
    prices: Floats32
    counts: Indices


class Scratch(NamedTuple):
    """Memory of the loop.

    Attributes
    ----------
    s, whole : rows of lanes (``lanes``)
    arguments, call : of Embree and of NumPy's loops
    stack : (k, 16) float32, rays that wait
    refracted : (k, 16), those of the list that is followed
    brought : (k, 5), what each ray of that list has brought, its path, and NOTHING, MISSED or MET; (0, 5) if no path
        has two rays
    pile : (k, 4) int64, depth, beginning and length of each list in the stack, and how many of its rays aren't lit
    told : (rows, 3) int64, of each light with shafts the halves of the last cell's key, and what its shaft is
    walk, boxes : memory for a shaft
    color, weights, texels : (3,), (4,) float32 and (4, 3) int64, of a cube map's lookup
    """

    s: Floats32
    whole: NDArray[np.int32]
    arguments: NDArray[np.uint32]
    call: Indices
    stack: Floats32
    refracted: Floats32
    brought: Floats32
    pile: Indices
    told: Indices
    walk: Floats64
    boxes: Indices
    color: Floats32
    weights: Floats32
    texels: Indices


@njit(**LEAN)
def _query(scene, mask, arguments, s, whole):
    """Nearest hits of the rays in a mask, into TFAR, U, V and TRIANGLE; ``HIT`` masks the rays that have one."""
    lanes = s[:PACKET].view(np.int32)
    for i in range(WIDTH):
        s[TFAR + i] = _FAR if whole[mask + i] else s[TFAR + i]
        lanes[GEOMETRY + i] = -1
    if scene.scenes[0]:
        intersect(whole[mask:].ctypes.data, scene.scenes[0], s.ctypes.data, arguments.ctypes.data)
    for i in range(WIDTH):
        if whole[mask + i]:
            hit = lanes[GEOMETRY + i] >= 0
            whole[HIT + i] = -1 if hit else 0
            whole[TRIANGLE + i] = lanes[PRIMITIVE + i] if hit else 0
    if len(scene.velocity) == 0:
        return
    ray, asked, others = s[:PACKET], whole[mask : mask + WIDTH], whole[OTHERS : OTHERS + WIDTH]
    keep(ray, s[TIME : TIME + WIDTH], 0, WIDTH)
    for k in range(len(scene.velocity)):
        if not shift(ray, scene.velocity[k], scene.boxes[k], asked, others):
            continue
        for i in range(WIDTH):
            lanes[GEOMETRY + i] = -1
        intersect(others.ctypes.data, scene.scenes[1 + k], s.ctypes.data, arguments.ctypes.data)
        for i in range(WIDTH):
            if lanes[GEOMETRY + i] >= 0 and whole[OTHERS + i]:
                whole[HIT + i] = -1
                whole[TRIANGLE + i] = lanes[PRIMITIVE + i] + np.int32(scene.first[1 + k])
    unshift(ray)


@njit(**LEAN)
def _unspared(objects, s, whole):
    """Of the rays in ASKED leave those that may meet anything: none meets the convex object that it leaves."""
    some = False
    for i in range(WIDTH):
        some |= (whole[ASKED + i] != 0) & (whole[LEFT + i] >= 0)
    if not some:
        return
    for c in range(3):
        for i in range(WIDTH):
            s[A + c * WIDTH + i] = _ONE / s[TO + c * WIDTH + i]
    for i in range(WIDTH):
        whole[OTHERS + i] = -1 if whole[LEFT + i] < 0 else 0
    for k in range(len(objects) // 2):
        x0, y0, z0 = objects[2 * k, 0], objects[2 * k, 1], objects[2 * k, 2]
        x1, y1, z1 = objects[2 * k + 1, 0], objects[2 * k + 1, 1], objects[2 * k + 1, 2]
        for i in range(WIDTH):
            near, far = _NOTHING, _FAR
            a, b = (x0 - s[i]) * s[A + i], (x1 - s[i]) * s[A + i]
            low, high = a if a < b else b, b if a < b else a
            near, far = low if low > near else near, high if high < far else far
            a, b = (y0 - s[_Y + i]) * s[B + i], (y1 - s[_Y + i]) * s[B + i]
            low, high = a if a < b else b, b if a < b else a
            near, far = low if low > near else near, high if high < far else far
            a, b = (z0 - s[_Z + i]) * s[C + i], (z1 - s[_Z + i]) * s[C + i]
            low, high = a if a < b else b, b if a < b else a
            near, far = low if low > near else near, high if high < far else far
            meets = (not near * _LESS > far * _MORE) & (whole[LEFT + i] != k)
            whole[OTHERS + i] = -1 if meets else whole[OTHERS + i]
    for i in range(WIDTH):
        whole[ASKED + i] &= whole[OTHERS + i]


@njit(**LEAN)
def _intersect(scene, of_camera, coherent, count, timed, scratch, counts):
    """Nearest hits of a packet's rays; how many there are."""
    s, whole, arguments, call = scratch.s, scratch.whole, scratch.arguments, scratch.call
    for i in range(WIDTH):
        whole[ASKED + i] = -1 if i < count else 0
        whole[HIT + i] = 0
        s[TFAR + i] = _FAR
    if len(scene.objects) and not of_camera:
        _unspared(scene.objects, s, whole)
    arguments[0] = COHERENT if coherent else 0
    start = nanoseconds(call) if timed else 0
    _query(scene, ASKED, arguments, s, whole)
    arguments[0] = 0
    if of_camera:
        stuck = False
        for i in range(WIDTH):
            again = (whole[HIT + i] != 0) & (s[TFAR + i] <= 0)
            whole[ASKED + i] = -1 if again else 0
            stuck |= again
        if stuck:
            # A camera ray that starts on a surface hits it at distance 0. It starts again, one offset farther on.
            for i in range(WIDTH):
                if whole[ASKED + i]:
                    step = max(scene.planes[whole[TRIANGLE + i], 6], _STEP)
                    for c in range(0, 3 * WIDTH, WIDTH):
                        s[c + i] += s[TO + c + i] * step
            _query(scene, ASKED, arguments, s, whole)
    if timed:
        counts[NANOSECONDS] += nanoseconds(call) - start
    hits = 0
    for i in range(WIDTH):
        hits += whole[HIT + i] != 0
    return hits


@njit(**LEAN)
def _spread(table, k, count, row, s):
    """One row of a table into the columns of all lanes."""
    for c in range(count):
        value = table[k, c]
        for i in range(WIDTH):
            s[row + c * WIDTH + i] = value


@njit(**LEAN)
def _gather(scene, s, whole):
    """Materials of the hits, and the rows of their triangles, into the columns of PLANE, EDGES and CORNERS."""
    k = np.uint64(whole[TRIANGLE])
    if alike(TRIANGLE, whole):
        material, smooth = scene.material[k], not scene.planes[k, 7] > 0
        for i in range(WIDTH):
            whole[MATERIAL + i] = material
        _spread(scene.planes, k, 8, PLANE, s)
        _spread(scene.edges, k, 7, EDGES, s)
        if not smooth or len(scene.corner_normals) == 0:
            return False
        _spread(scene.corner_normals, k, 9, CORNERS, s)
        return True
    smooth = False
    for i in range(WIDTH):
        k = np.uint64(whole[TRIANGLE + i])
        whole[MATERIAL + i] = scene.material[k]
        for c in range(8):
            s[PLANE + c * WIDTH + i] = scene.planes[k, c]
        for c in range(7):
            s[EDGES + c * WIDTH + i] = scene.edges[k, c]
        smooth |= not scene.planes[k, 7] > 0
    if not smooth or len(scene.corner_normals) == 0:
        return False
    for i in range(WIDTH):
        k = np.uint64(whole[TRIANGLE + i])
        for c in range(9):
            s[CORNERS + c * WIDTH + i] = scene.corner_normals[k, c]
    return True


@njit(**LEAN)
def _find(scene, s, whole):
    """Points, normals and origins of the hits; see ``Surface.hits``. Loops without branches do many lanes at once."""
    smooth = _gather(scene, s, whole)
    for i in range(WIDTH):
        a, b = s[U + i], s[V + i]
        for c in range(0, 3 * WIDTH, WIDTH):
            s[P + c + i] = s[EDGES + c + i] * a + s[EDGES + _EDGE_2 + c + i] * b + s[PLANE + c + i]
        s[A + i] = min(a, b, _ONE - a - b) - s[EDGES + 6 * WIDTH + i]
    for i in range(WIDTH):
        dx, dy, dz = s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
        nx, ny, nz = s[PLANE + 3 * WIDTH + i], s[PLANE + 4 * WIDTH + i], s[PLANE + 5 * WIDTH + i]
        # The sum begins with 0, as NumPy's does: it is never -0.
        side = _ONE if _NOTHING + nx * dx + ny * dy + nz * dz < 0 else -_ONE
        nx, ny, nz, far = nx * side, ny * side, nz * side, s[PLANE + 6 * WIDTH + i]
        s[NG + i], s[NG + _Y + i], s[NG + _Z + i] = nx, ny, nz
        s[NS + i], s[NS + _Y + i], s[NS + _Z + i] = nx, ny, nz
        s[NEAR + i] = s[P + i] + nx * far
        s[NEAR + _Y + i] = s[P + _Y + i] + ny * far
        s[NEAR + _Z + i] = s[P + _Z + i] + nz * far
        s[OFFSET + i], s[SIDE + i] = far, side
    for i in range(WIDTH):
        if s[A + i] < 0 and whole[HIT + i]:
            s[NEAR + i], s[NEAR + _Y + i], s[NEAR + _Z + i] = pull(
                np.uint64(whole[TRIANGLE + i]),
                *(s[U + i], s[V + i], s[NEAR + i], s[NEAR + _Y + i], s[NEAR + _Z + i]),
                *(scene.planes, scene.edges, scene.inset),
            )
    if len(scene.velocity):
        for i in range(WIDTH):
            mover = -1
            for j in range(1, len(scene.first)):
                mover += whole[TRIANGLE + i] >= scene.first[j]
            if mover >= 0:
                for c in range(3):
                    moved = scene.velocity[mover, c] * s[TIME + i]
                    s[P + c * WIDTH + i] += moved
                    s[NEAR + c * WIDTH + i] += moved
    if not smooth:
        return
    for i in range(WIDTH):
        a, b, side = s[U + i], s[V + i], s[SIDE + i]
        dx, dy, dz = s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
        nx = s[CORNERS + 3 * WIDTH + i] * a + s[CORNERS + 6 * WIDTH + i] * b + s[CORNERS + i]
        ny = s[CORNERS + 4 * WIDTH + i] * a + s[CORNERS + 7 * WIDTH + i] * b + s[CORNERS + _Y + i]
        nz = s[CORNERS + 5 * WIDTH + i] * a + s[CORNERS + 8 * WIDTH + i] * b + s[CORNERS + _Z + i]
        nx, ny, nz = to_viewer(nx, ny, nz, side, dx, dy, dz)
        flat = s[PLANE + 7 * WIDTH + i] > 0
        s[NS + i] = s[NS + i] if flat else nx
        s[NS + _Y + i] = s[NS + _Y + i] if flat else ny
        s[NS + _Z + i] = s[NS + _Z + i] if flat else nz


@njit(**LEAN)
def _absorb(materials, outside, eye, of_camera, call, s, whole):
    """Attenuate the throughput along rays in dielectrics; see ``course.engine.terms.scattering.absorption``."""
    some = False
    for i in range(WIDTH):
        whole[OTHERS + i], s[D + i] = -1, _NOTHING
        if whole[HIT + i] == 0:
            continue
        m, through = whole[MATERIAL + i], np.int32(-1)
        enters = s[SIDE + i] > 0
        if not enters and materials.dielectric[m]:
            through = m
        if len(outside) and enters:
            through = np.int32(outside[m])
        through = whole[MEDIUM + i] if through < 0 else through
        if through < 0:
            continue
        some, whole[OTHERS + i] = True, through
        length, dx, dy, dz = s[TFAR + i], s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
        if not of_camera:
            nx, ny, nz = s[NG + i], s[NG + _Y + i], s[NG + _Z + i]
            x, y, z = (
                s[i] - s[START + i],
                s[_Y + i] - s[START + _Y + i],
                s[_Z + i] - s[START + _Z + i],
            )
            # Negative: ng is on the incoming side.
            facing = min(_NOTHING + nx * dx + ny * dy + nz * dz, -_LEAST)
            beside = (_NOTHING + nx * x + ny * y + nz * z) / facing
            length += min(max(beside, -length), length)
        elif eye.lens[2] != 0:
            frame = eye.frame
            forwards = _NOTHING + frame[3, 0] * dx + frame[3, 1] * dy + frame[3, 2] * dz
            length += eye.lens[2] / max(forwards, np.float32(1e-12))
        s[D + i] = length
    if not some:
        return
    for c in range(3):
        for i in range(WIDTH):
            m = max(whole[OTHERS + i], 0)
            s[A + i] = -materials.absorption[c, m] * s[D + i]
        numpy_kernels.exp(call, s[A : A + WIDTH], s[B : B + WIDTH])
        for i in range(WIDTH):
            share = s[B + i] if whole[OTHERS + i] >= 0 else _ONE
            s[THROUGHPUT + c * WIDTH + i] *= share


@njit(**LEAN)
def _reflect(materials, painted, s, whole):
    """What the hits send to the viewer into ``DIFFUSE``; see ``BlinnPhong.reflected`` and ``Integrator.shade``."""
    dark_sides, one = len(materials.dark_inside) > 0, alike(MATERIAL, whole)
    for i in range(WIDTH):
        dark = dark_sides and materials.dark_inside[np.uint64(whole[MATERIAL + i])]
        s[A + i] = _NOTHING if dark and s[SIDE + i] < 0 else _ONE
        s[B + i] = _ONE if s[SIDE + i] > 0 and whole[LIT + i] != 0 else _NOTHING
    for c in range(3):
        row = DIFFUSE + c * WIDTH
        _of_material(materials.diffuse[c], one, s, whole)
        for i in range(WIDTH):
            s[row + i] *= s[C + i]
        if painted:
            for i in range(WIDTH):
                s[row + i] *= s[TINT + c * WIDTH + i]
        if len(materials.exponent):
            _of_material(materials.specular[c], one, s, whole)
            for i in range(WIDTH):
                s[SPECULAR + c * WIDTH + i] *= s[C + i]
                s[row + i] += s[SPECULAR + c * WIDTH + i]
        if materials.ambient.shape[1]:
            _of_material(materials.ambient[c], one, s, whole)
            for i in range(WIDTH):
                light = s[C + i] * (s[TINT + c * WIDTH + i] if painted else _ONE)
                s[row + i] += light if s[A + i] > 0 else _NOTHING
        if materials.glow.shape[1]:
            _of_material(materials.glow[c], one, s, whole)
            for i in range(WIDTH):
                s[row + i] += s[C + i]
        if materials.emission.shape[1]:
            _of_material(materials.emission[c], one, s, whole)
            for i in range(WIDTH):
                s[row + i] += s[C + i] * s[B + i]
        if materials.objects.shape[1]:
            _of_material(materials.objects[c], one, s, whole)
            for i in range(WIDTH):
                s[row + i] += s[C + i] if whole[LIT + i] != 0 else _NOTHING


@njit(**LEAN)
def _of_material(values, one, s, whole):
    """A value of each hit's material, into C; ``one`` tells that all have the same."""
    if one:
        value = values[np.uint64(whole[MATERIAL])]
        for i in range(WIDTH):
            s[C + i] = value
        return
    for i in range(WIDTH):
        s[C + i] = values[np.uint64(whole[MATERIAL + i])]


@njit(**LEAN)
def _load(rays, first, count, lit, s, whole):
    """Rays that waited, into a packet, from number ``lit`` on lit ones; places without a ray repeat the last one."""
    integers = rays.view(np.int32)
    for i in range(WIDTH):
        j = first + min(i, count - 1)
        for c in range(3):
            row = c * WIDTH + i
            s[row], s[TO + row] = rays[j, c], rays[j, 3 + c]
            s[THROUGHPUT + row], s[START + row] = rays[j, 6 + c], rays[j, 13 + c]
        s[TIME + i] = rays[j, 10]
        whole[PATH + i], whole[LEFT + i] = integers[j, 9], integers[j, 11]
        whole[MEDIUM + i] = integers[j, 12]
        whole[LIT + i] = -1 if j >= lit else 0


@njit(**LEAN)
def _miss(surroundings, count, s, whole, scratch):
    """Radiance of the lit rays that hit nothing, into DIFFUSE."""
    faces, color = surroundings.faces, scratch.color
    for i in range(count):
        if whole[HIT + i] or whole[LIT + i] == 0:
            continue
        if faces.shape[1]:
            x, y, z = s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
            look_up(faces, surroundings.seamless, x, y, z, scratch.weights, scratch.texels, color)
        for c in range(3):
            light = color[c] if faces.shape[1] else surroundings.color[c]
            s[DIFFUSE + c * WIDTH + i] = light * s[THROUGHPUT + c * WIDTH + i]


@njit(**LEAN)
def _shade(
    scene,
    shafts,
    materials,
    lights,
    sky,
    numbers,
    depth,
    stride,
    same,
    timed,
    film,
    scratch,
    count,
):
    """Direct, ambient and own light of the hits, into DIFFUSE."""
    s, whole, counts = scratch.s, scratch.whole, film.counts
    for i in range(3 * WIDTH):
        s[DIFFUSE + i] = s[SPECULAR + i] = _NOTHING
    if len(shafts.slot):
        find_cells(shafts, s, whole)
    for k in range(len(lights.kind)):
        choose(lights, k, numbers, depth, stride, same, s, whole)
        shadows = illuminate(lights, k, scene, shafts, materials, timed, scratch, counts)
        counts[SHADOW_RAYS] += shadows
        if len(film.cost) and shadows:
            _charge(film, film.prices[1], ASKED, count, whole)
    if len(sky.diffuses):
        pair = sky.pair + depth * stride
        shadows = shine(sky, scene, numbers, pair, same, timed, scratch, counts)
        counts[SHADOW_RAYS] += shadows
        if len(film.cost) and shadows:
            _charge(film, film.prices[3], ASKED, count, whole)
    _reflect(materials, len(scene.painting.row) > 0, s, whole)


@njit(**LEAN)
def _charge(film, price, mask, count, whole):
    for i in range(count):
        if whole[mask + i]:
            film.cost[np.uint64(whole[PATH + i])] += price


@njit(**LEAN)
def _brings(missed, i, whole):
    """True for the rays that hit something, or for those that missed and are lit."""
    return (whole[HIT + i] == 0) & (whole[LIT + i] != 0) if missed else whole[HIT + i] != 0


@njit(**LEAN)
def _add(film, brought, first, missed, count, s, whole):
    """Add what a packet's rays have brought to their paths: those that hit something, or those that missed.

    Paths may have several rays, if ``brought`` has room: then what these bring waits until ``_add_list``.
    """
    integers = brought.view(np.int32)
    if len(brought) == 0 and count == WIDTH and consecutive(PATH, whole):
        begin = np.uint64(whole[PATH])
        for i in range(WIDTH):
            s[A + i] = _ONE if _brings(missed, i, whole) else _NOTHING
        for c in range(3):
            radiance = film.radiance[c, begin : begin + np.uint64(WIDTH)]
            for i in range(WIDTH):
                radiance[i] += s[DIFFUSE + c * WIDTH + i] if s[A + i] > 0 else _NOTHING
        return
    for i in range(count):
        if not _brings(missed, i, whole):
            continue
        for c in range(3):
            light = s[DIFFUSE + c * WIDTH + i]
            if len(brought):
                brought[first + i, c] = light
                integers[first + i, 4] = MISSED if missed else MET
            else:
                film.radiance[c, np.uint64(whole[PATH + i])] += light


@njit(**LEAN)
def _expect(brought, first, count, whole):
    """Note the paths of a packet's rays, which have brought nothing yet."""
    integers = brought.view(np.int32)
    for i in range(count):
        integers[first + i, 3], integers[first + i, 4] = whole[PATH + i], NOTHING


@njit(**LEAN)
def _add_list(film, brought, length):
    """Add what the rays of a list have brought: first those that missed, as batches do."""
    integers = brought.view(np.int32)
    for state in (MISSED, MET):
        for j in range(length):
            if integers[j, 4] == state:
                for c in range(3):
                    film.radiance[c, integers[j, 3]] += brought[j, c]


@njit(**LEAN)
def _charge_rays(film, rays, first, count):
    integers = rays.view(np.int32)
    for j in range(first, first + count):
        film.cost[integers[j, 9]] += film.prices[2]


@njit(nogil=True, cache=True, error_model="numpy", _nrt=False)
def follow(
    numbers,
    eye,
    scene,
    shafts,
    materials,
    lights,
    sky,
    scattering,
    paths,
    surroundings,
    depths,
    film,
    scratch,
):
    """Fill the radiance of a block's paths: depth by depth for some paths, then for the next.

    ``paths`` is None, or a ``Paths`` where each hit sends one ray on. Each of the two is compiled by itself.
    """
    chunk = CHUNK if paths is None else PATH_CHUNK
    s, whole, counts, radiance = scratch.s, scratch.whole, film.counts, film.radiance
    stack, refracted, pile = scratch.stack, scratch.refracted, scratch.pile
    n, scatters = radiance.shape[1], scattering.mirror.shape[1] > 0
    absorbs = materials.absorption.shape[1] > 0
    for packet in (0, SHADOW, ABOVE):
        part = s[packet : packet + PACKET]
        begin(part, part.view(np.int32))
    packets = 0
    for first_path in range(0, n, chunk):
        # Chunk by chunk, so that it is in the nearest cache when light is added to it.
        for c in range(3):
            for i in range(first_path, min(first_path + chunk, n)):
                radiance[c, i] = _NOTHING
        pile[0, 0], pile[0, 1], pile[0, 2], pile[0, 3] = 0, 0, min(chunk, n - first_path), 0
        lists = 1
        while lists:
            lists -= 1
            depth, start, length = pile[lists, 0], pile[lists, 1], pile[lists, 2]
            lit = start + pile[lists, 3]
            if length > LARGEST:
                half = length // 2
                pile[lists, 1], pile[lists, 2] = start + half, length - half
                pile[lists + 1, 0], pile[lists + 1, 1], pile[lists + 1, 2] = depth, start, half
                pile[lists + 1, 3] = 0
                lists += 2
                continue
            back = through = 0
            # No path has two rays before the first bounce.
            brought = scratch.brought[: len(scratch.brought) if depth else 0]
            for first in range(0, length, WIDTH):
                timed, count = packets % TIMED == 0, min(WIDTH, length - first)
                packets += 1
                # ---- rays
                if depth:
                    _load(stack, start + first, count, lit, s, whole)
                    same = find_pixels(whole, numbers.samples)
                    if len(brought):
                        _expect(brought, first, count, whole)
                else:
                    for i in range(WIDTH):
                        whole[PATH + i] = first_path + first + min(i, count - 1)
                        whole[MEDIUM + i] = whole[LIT + i] = -1
                    same = find_pixels(whole, numbers.samples)
                    if len(numbers.drawn) == 0:
                        ask_for_next(numbers, first_path + first + WIDTH, depths.seen)
                    look(numbers, eye, same, scratch.call, s, whole)
                    for i in range(3 * WIDTH):
                        s[THROUGHPUT + i] = _ONE
                    if film.offsets.shape[1]:
                        for c in range(2):
                            for i in range(count):
                                film.offsets[c, whole[PATH + i]] = s[JITTER + c * WIDTH + i]
                # ---- intersection, environment, absorption
                coherent = depth <= depths.coherent
                hits = _intersect(scene, depth == 0, coherent, count, timed, scratch, counts)
                if hits < count and depth <= surroundings.depth:
                    _miss(surroundings, count, s, whole, scratch)
                    _add(film, brought, first, True, count, s, whole)
                if hits == 0:
                    continue
                counts[HITS] += hits
                if len(film.cost):
                    _charge(film, film.prices[0], HIT, count, whole)
                _find(scene, s, whole)
                if len(scene.relief.row):
                    carve(scene.relief, scratch.call, s, whole)
                if len(scene.painting.row):
                    paint(scene.painting, scratch.call, s, whole)
                if absorbs:
                    outside = scattering.outside
                    _absorb(materials, outside, eye, depth == 0, scratch.call, s, whole)
                # ---- direct light, ambient light, emission
                pairs = depths.pairs
                _shade(
                    scene,
                    shafts,
                    materials,
                    lights,
                    sky,
                    numbers,
                    depth,
                    pairs,
                    same,
                    timed,
                    film,
                    scratch,
                    count,
                )
                for i in range(3 * WIDTH):
                    s[DIFFUSE + i] *= s[THROUGHPUT + i]
                _add(film, brought, first, False, count, s, whole)
                # ---- reflection, gloss, refraction
                if paths is not None:
                    if depth < depths.bounces:
                        more, further = bounce(
                            paths,
                            scattering,
                            materials.dark_inside,
                            len(scene.corner_normals) > 0 or len(scene.relief.row) > 0,
                            len(scene.painting.row) > 0,
                            numbers,
                            depth,
                            pairs,
                            same,
                            scratch.call,
                            s,
                            whole,
                            stack[start + back :],
                            refracted[through:],
                            counts,
                        )
                        if len(film.cost):
                            _charge_rays(film, stack, start + back, more)
                            _charge_rays(film, refracted, through, further)
                        back += more
                        through += further
                elif scatters and depth < depths.bounces:
                    pair = scattering.lobe_pair + depth * pairs
                    more, further = scatter(
                        scattering,
                        numbers,
                        pair,
                        same,
                        scratch.call,
                        s,
                        whole,
                        stack[start + back :],
                        refracted[through:],
                        counts,
                    )
                    if len(film.cost):
                        _charge_rays(film, stack, start + back, more)
                        _charge_rays(film, refracted, through, further)
                    back += more
                    through += further
            if len(brought):
                _add_list(film, brought, length)
            if back + through:
                for j in range(through):
                    for c in range(RAY):
                        stack[start + back + j, c] = refracted[j, c]
                pile[lists, 0], pile[lists, 1], pile[lists, 2] = depth + 1, start, back + through
                pile[lists, 3] = 0 if paths is None else back
                lists += 1
