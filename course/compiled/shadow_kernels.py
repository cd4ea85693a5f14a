"""Direct light of one light, sixteen hits at a time, compiled by Numba; imported by ``course.compiled.direct``.

From the point on the light to the reflected irradiance a packet stays in the processor's nearest cache: its shadow
rays are made where Embree reads them. The batches of ``course.core.direct`` do the same arithmetic in the same order.

Layout of ``s``: a packet of Embree's (``packet_kernels``), then rows of sixteen numbers of our own.
"""

import numpy as np
from numba import njit, types

from course.compiled.clock_kernels import nanoseconds
from course.compiled.occlusion_kernels import BOXES, ROWS, SCENES, occlude
from course.compiled.options import COLUMNS, OPTIONS, ROW
from course.compiled.packet_kernels import TFAR, WIDTH, aligned, arguments_of, begin
from course.core.lights.sample import CLOSEST, TO_THE_LIGHT

_ORIGIN, _TO_LIGHT = 0, 4 * WIDTH
_NORMAL, _POINT, _INVERSE, _FACTOR, _COSINE, _IRRADIANCE = (
    (ROWS + row) * WIDTH for row in (0, 3, 6, 7, 8, 9)
)
_ALL_ROWS = ROWS + 10
_X, _Y, _Z = 0, WIDTH, 2 * WIDTH

_NOTHING, _ONE = np.float32(0), np.float32(1)
_LEAST = np.float32(CLOSEST * CLOSEST)
_TO_THE_LIGHT = np.float32(TO_THE_LIGHT)

TIMED = 16
"""One packet of this many is timed: looking at the clock costs as much as a ray."""


@njit(**OPTIONS)
def _copy(s, row, columns, first, count):
    """Columns of a (3, n) array into three rows; of a (3, 1) array into all places."""
    for c in range(3):
        if columns.shape[1] == 1:
            for i in range(WIDTH):
                s[row + c * WIDTH + i] = columns[c, 0]
        else:
            for i in range(count):
                s[row + c * WIDTH + i] = columns[c, first + i]


@njit(**OPTIONS)
def _copy_row(s, row, values, first, count):
    if len(values) == 1:
        for i in range(WIDTH):
            s[row + i] = values[0]
    else:
        for i in range(count):
            s[row + i] = values[first + i]


@njit(**OPTIONS)
def _towards(s, normal, two_sided):
    """``towards``: ``_TO_LIGHT`` holds points on the light, and then the vectors to them."""
    for i in range(WIDTH):
        x = s[_TO_LIGHT + _X + i] - s[_POINT + _X + i]
        y = s[_TO_LIGHT + _Y + i] - s[_POINT + _Y + i]
        z = s[_TO_LIGHT + _Z + i] - s[_POINT + _Z + i]
        factor = _ONE / max(x * x + y * y + z * z, _LEAST)
        s[_TO_LIGHT + _X + i], s[_TO_LIGHT + _Y + i], s[_TO_LIGHT + _Z + i] = x, y, z
        s[_INVERSE + i], s[_FACTOR + i] = np.sqrt(factor), factor
    if len(normal):
        nx, ny, nz = normal[0], normal[1], normal[2]
        for i in range(WIDTH):
            x, y, z = s[_TO_LIGHT + _X + i], s[_TO_LIGHT + _Y + i], s[_TO_LIGHT + _Z + i]
            cosine = -s[_INVERSE + i] * (nx * x + ny * y + nz * z)
            s[_FACTOR + i] *= abs(cosine) if two_sided else (cosine if cosine > 0 else _NOTHING)


@njit(**OPTIONS)
def _illuminated(s):
    """Cosine and irradiance of a packet's hits, as if nothing were in the way."""
    for i in range(WIDTH):
        cosine = (
            _NOTHING
            + s[_NORMAL + _X + i] * s[_TO_LIGHT + _X + i]
            + s[_NORMAL + _Y + i] * s[_TO_LIGHT + _Y + i]
            + s[_NORMAL + _Z + i] * s[_TO_LIGHT + _Z + i]
        )
        cosine *= s[_INVERSE + i]
        s[_COSINE + i] = cosine
        s[_IRRADIANCE + i] = cosine * s[_FACTOR + i]


@njit(**OPTIONS)
def _height(s, i, j, ng, triangle, u, v, side, bulge):
    """Height of the round surface above a hit whose facet turns away from the light, else 0; see ``bulge``."""
    facing = (
        ng[0, j] * s[_TO_LIGHT + _X + i]
        + ng[1, j] * s[_TO_LIGHT + _Y + i]
        + ng[2, j] * s[_TO_LIGHT + _Z + i]
    )
    if not facing <= 0:
        return _NOTHING
    k, w = triangle[j], _ONE - u[j] - v[j]
    height = (
        _NOTHING + bulge[k, 0] * (w * u[j]) + bulge[k, 1] * (w * v[j]) + bulge[k, 2] * (u[j] * v[j])
    )
    height *= side[j]
    return height if height > 0 else _NOTHING


@njit(
    types.void(
        *(SCENES, COLUMNS, BOXES, ROW, COLUMNS, COLUMNS, COLUMNS, COLUMNS),
        *(types.uint16[::1], ROW, types.int32[::1], ROW, ROW),
        *(COLUMNS, ROW, ROW, ROW, types.boolean),
        *(types.boolean[:, ::1], COLUMNS, types.float32, types.float32),
        *(types.boolean[::1], ROW, types.int64[::1], COLUMNS, types.boolean[::1], types.int64[::1]),
    ),
    **OPTIONS,
)
def illuminate(
    scenes,
    velocity,
    boxes,
    time,
    origin,
    points,
    ns,
    ng,
    material,
    side,
    triangle,
    u,
    v,
    on_light,
    inverse_length,
    factor,
    normal,
    two_sided,
    shaded,
    bulge,
    most,
    limit,
    shiny,
    irradiance,
    which,
    towards,
    asked,
    counts,
):
    """Irradiance (n,) of hits from one light, past all that is in the way.

    Parameters
    ----------
    scenes, velocity, boxes, time : of the shadow rays, see ``occlusion_kernels.occlude``
    origin, ns, ng, material, side, triangle, u, v : of the ``Hits``
    points : (3, n) for which the light is sampled
    on_light : (3, n) or (3, 1) points on the light; the ``to_light`` of a ``Sample`` if the next two are not empty
    inverse_length, factor : of that ``Sample``; (0,) if they are to be worked out
    normal, two_sided : see ``towards``; normal is (0,) for a light by intensity
    shaded : (1 or 2, M) which materials show light, from the back too where there are two rows; (0, 0) for all
    bulge : (T, 3) of ``Triangles``; (0, 3) if no triangle has one
    most : cosine up to which a facet may turn away from a light that its shading normal faces
    limit : length of the shadow rays, in lengths of ``to_light``
    irradiance : (n,) filled, 0 where the light isn't seen
    shiny : (M,) which materials have highlights; (0,) for none
    which, towards : (n,) and (6, n), of those hits that the light reaches on shiny materials: irradiance, cosine,
        ``inverse_length`` and ``to_light``; filled from the beginning
    asked : (n,) filled, hits that cast a shadow ray; (0,) if nobody asks
    counts : (4,) hits that cast a ray, second rays above facets, nanoseconds inside Embree of one packet in TIMED,
        hits in ``which``
    """
    n = len(material)
    memory = aligned(_ALL_ROWS + ROWS + 3).reshape((_ALL_ROWS + ROWS + 3) * WIDTH)
    s, above = memory[: _ALL_ROWS * WIDTH], memory[_ALL_ROWS * WIDTH : (_ALL_ROWS + ROWS) * WIDTH]
    masks = memory[(_ALL_ROWS + ROWS) * WIDTH :].view(np.int32)
    asked_above, valid, others = masks[:WIDTH], masks[WIDTH : 2 * WIDTH], masks[2 * WIDTH :]
    begin(s, s.view(np.int32))
    begin(above, above.view(np.int32))
    arguments, moment = arguments_of(0), np.empty(2, np.int64)
    sampled, apart = len(inverse_length) > 0, points.ctypes.data != origin.ctypes.data
    for number in range((n + WIDTH - 1) // WIDTH):
        first = number * WIDTH
        count = min(WIDTH, n - first)
        # ---- the point on the light
        _copy(s, _ORIGIN, origin, first, count)
        _copy(s, _NORMAL, ns, first, count)
        _copy(s, _TO_LIGHT, on_light, first, count)
        if sampled:
            _copy_row(s, _INVERSE, inverse_length, first, count)
            _copy_row(s, _FACTOR, factor, first, count)
        else:
            if apart:
                _copy(s, _POINT, points, first, count)
            else:
                for i in range(3 * WIDTH):
                    s[_POINT + i] = s[_ORIGIN + i]
            _towards(s, normal, two_sided)
        _illuminated(s)
        # ---- candidates
        candidates = 0
        for i in range(count):
            j = first + i
            face = s[_IRRADIANCE + i] > 0
            if len(shaded):
                row = 1 if len(shaded) > 1 and not side[j] > 0 else 0
                face &= shaded[row, material[j]]
            valid[i] = -1 if face else 0
            candidates += face
            if len(asked):
                asked[j] = face
        for i in range(count, WIDTH):
            valid[i] = 0
        if candidates == 0:
            irradiance[first : first + count] = 0
            continue
        counts[0] += candidates
        # ---- facets that turn away
        raised = 0
        if len(bulge):
            for i in range(WIDTH):
                asked_above[i] = 0
            for i in range(count):
                if valid[i] != 0 and s[_COSINE + i] <= most:
                    height = _height(s, i, first + i, ng, triangle, u, v, side, bulge)
                    if height > 0:
                        raised += 1
                        asked_above[i] = -1
                        above[TFAR + i] = _ONE
                        for c in range(0, 3 * WIDTH, WIDTH):
                            # The highlight looks at the light from the facet.
                            s[_POINT + c + i] = s[_TO_LIGHT + c + i]
                            up = s[_NORMAL + c + i] * height
                            above[_ORIGIN + c + i] = s[_ORIGIN + c + i]
                            above[_TO_LIGHT + c + i] = up
                            s[_ORIGIN + c + i] += up
                            if limit <= _TO_THE_LIGHT:
                                s[_TO_LIGHT + c + i] -= up
            counts[1] += raised
        # ---- shadow rays
        for i in range(WIDTH):
            s[TFAR + i] = limit
        if number % TIMED == 0:
            counts[2] -= nanoseconds(moment)
        if raised:
            occlude(
                scenes, velocity, boxes, time, first, count, above, asked_above, others, arguments
            )
        occlude(scenes, velocity, boxes, time, first, count, s, valid, others, arguments)
        if number % TIMED == 0:
            counts[2] += nanoseconds(moment)
        # Embree sets tfar to minus infinity where something is in the way.
        for i in range(WIDTH):
            free = (valid[i] != 0) & (s[TFAR + i] >= 0)
            s[_IRRADIANCE + i] = s[_IRRADIANCE + i] if free else _NOTHING
        if raised:
            for i in range(count):
                if asked_above[i] != 0 and not above[TFAR + i] >= 0:
                    s[_IRRADIANCE + i] = _NOTHING
        for i in range(count):
            irradiance[first + i] = s[_IRRADIANCE + i]
        if len(shiny):
            for i in range(count):
                if s[_IRRADIANCE + i] > 0 and shiny[material[first + i]]:
                    k = counts[3]
                    to_light = _POINT if raised and asked_above[i] != 0 else _TO_LIGHT
                    which[k] = first + i
                    towards[0, k] = s[_IRRADIANCE + i]
                    towards[1, k] = s[_COSINE + i]
                    towards[2, k] = s[_INVERSE + i]
                    towards[3, k] = s[to_light + _X + i]
                    towards[4, k] = s[to_light + _Y + i]
                    towards[5, k] = s[to_light + _Z + i]
                    counts[3] += 1
