"""Round lamps in Phong's lobes, compiled by Numba; imported by ``course.compiled.lamps_and_lobes``.

Densities and weights are those of ``course.extras.lamps_and_lobes``, in the same order of arithmetic and so to the same
bits; so are the course's ``cone_density`` and ``heuristic_weights``.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from course.compiled import numpy_kernels
from course.compiled.cap_kernels import towards_cap
from course.compiled.options import LEAN, OPTIONS
from course.core.types import Floats32

ROW = 64
"""Hits that are worked on together: so many that a call of NumPy's loops is worth it."""

U, V, SINE, COSINE, ABOVE, BELOW, HELD, INVERSE, IRRADIANCE, FACING, LAMP, WAY, TO, ALL = (
    ROW * number for number in (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 14, 17)
)
"""Rows of numbers; WAY and TO have three each."""

DELTA = np.float32(np.inf)
_NOTHING, _ONE, _TWO = np.float32(0), np.float32(1), np.float32(2)
_SHORT, _MOST, _TURN = np.float32(1e-30), np.float32(1 - 1e-7), np.float32(2 * np.pi)


class Ball(NamedTuple):
    """A lamp; see ``RoundLamp`` and ``VisibleSphereLight``.

    Attributes
    ----------
    center : (3,) float32
    radius : in double precision
    squared : of the radius, float32
    sent : pi over the area, float32
    """

    center: Floats32
    radius: float
    squared: np.float32
    sent: np.float32


class Lobes(NamedTuple):
    """M materials; see ``Combining``.

    Attributes
    ----------
    exponents, reach : (M,) float32
    mirror : (3, M) float32, reflectance
    power : 0 where lamps are looked for by their points alone, else 1 or 2
    alone : see ``ALONE``, float32
    """

    exponents: Floats32
    reach: Floats32
    mirror: Floats32
    power: int
    alone: np.float32


@njit(**LEAN)
def _cone_density(radius, distance):
    if not distance > radius:
        return _NOTHING
    sine = radius / np.float64(distance)
    return np.float32((1 + np.sqrt(1 - sine * sine)) / (2 * np.pi) / (sine * sine))


@njit(**LEAN)
def _weight(lobes, lamp, lobe, peak, of_lobe):
    """Weight of a point on the lamp, or of a direction of the lobe."""
    if lobes.power == 0:
        return _ONE if (lamp > 0) != of_lobe else _NOTHING
    if peak >= lobes.alone * lamp:
        return _ONE if of_lobe else _NOTHING
    one, two = np.float64(lamp), np.float64(lobe)
    largest = max(one, two)
    if not largest > 0:
        return _NOTHING
    one, two = one / largest, two / largest
    if lobes.power == 2:
        one, two = one * one, two * two
    return np.float32((two if of_lobe else one) / (one + two))


@njit(**LEAN)
def _mirrored(direction, ns, ng, j):
    dx, dy, dz = direction[0, j], direction[1, j], direction[2, j]
    nx, ny, nz = ns[0, j], ns[1, j], ns[2, j]
    twice = _NOTHING + dx * nx + dy * ny + dz * nz
    twice += twice
    x, y, z = dx - twice * nx, dy - twice * ny, dz - twice * nz
    nx, ny, nz = ng[0, j], ng[1, j], ng[2, j]
    below = _NOTHING + x * nx + y * ny + z * nz
    if below < 0:
        below += below
        return x - below * nx, y - below * ny, z - below * nz
    return x, y, z


@njit(**LEAN)
def _sunk(direction, ns, ng, j, s, i):
    """How far a way lies off a lobe's axis, and off its mirror image below the surface: 1 - cos, into two rows."""
    x, y, z = s[WAY + i], s[WAY + ROW + i], s[WAY + 2 * ROW + i]
    ax, ay, az = _mirrored(direction, ns, ng, j)
    nx, ny, nz = ng[0, j], ng[1, j], ng[2, j]
    height = _NOTHING + x * nx + y * ny + z * nz
    along = _NOTHING + ax * nx + ay * ny + az * nz
    x, y, z = x - ax, y - ay, z - az
    above = (_NOTHING + x * x + y * y + z * z) / _TWO
    s[ABOVE + i], s[BELOW + i] = above, above + _TWO * height * along
    s[HELD + i] = height


@njit(**LEAN)
def _dense(exponents, material, which, first, count, call, s):
    """``Combining.lobe_density`` of some hits, from ABOVE, BELOW and the height in HELD, into HELD."""
    some = False
    for i in range(count):
        s[U + i], s[V + i] = -min(s[ABOVE + i], _MOST), -min(s[BELOW + i], _MOST)
        some |= s[BELOW + i] < 1
    numpy_kernels.log1p(call, s[U : U + count], s[SINE : SINE + count])
    for i in range(count):
        s[SINE + i] = exponents[material[which[first + i]]] * s[SINE + i]
    numpy_kernels.exp(call, s[SINE : SINE + count], s[U : U + count])
    if some:
        numpy_kernels.log1p(call, s[V : V + count], s[COSINE : COSINE + count])
        for i in range(count):
            s[COSINE + i] = exponents[material[which[first + i]]] * s[COSINE + i]
        numpy_kernels.exp(call, s[COSINE : COSINE + count], s[V : V + count])
    for i in range(count):
        dense = _NOTHING
        dense += s[U + i] if s[ABOVE + i] < 1 else _NOTHING
        dense += s[V + i] if s[BELOW + i] < 1 else _NOTHING
        dense *= (exponents[material[which[first + i]]] + _ONE) / _TURN
        s[HELD + i] = dense * (_ONE if s[HELD + i] > 0 else _NOTHING)


@njit(**OPTIONS)
def ask(ball, lobes, near_origin, direction, ns, ng, material, beta, cutoff, found):
    """How many hits look for points on a lamp; see ``LampsAndLobes.light`` and ``Combining.asks``.

    Parameters
    ----------
    near_origin, direction, ns, ng, material : of ``Hits``
    beta : (3, n) throughput, (3, 0) for 1
    found : (n,) int64, filled from the beginning
    """
    count = 0
    for j in range(len(material)):
        m = np.uint64(material[j])
        exponent = lobes.exponents[m]
        if not exponent >= 0:
            continue
        most = _NOTHING
        for c in range(3):
            arriving = lobes.mirror[c, m]
            if beta.shape[1]:
                arriving *= beta[c, j]
            most = max(most, arriving)
        if not most > cutoff:
            continue
        x, y, z = (
            ball.center[0] - near_origin[0, j],
            ball.center[1] - near_origin[1, j],
            ball.center[2] - near_origin[2, j],
        )
        distance = max(np.sqrt(_NOTHING + x * x + y * y + z * z), _SHORT)
        if lobes.power:
            peak = (exponent + _ONE) / _TURN
            if not peak < lobes.alone * _cone_density(ball.radius, distance):
                continue
        inverse = _ONE / distance
        sine = np.float32(ball.radius) * inverse
        ax, ay, az = _mirrored(direction, ns, ng, j)
        between = _NOTHING + ax * (x * inverse) + ay * (y * inverse) + az * (z * inverse)
        cosine = np.sqrt(max(_ONE - sine * sine, _NOTHING))
        across = np.sqrt(max(_ONE - between * between, _NOTHING))
        if between * cosine + across * sine > lobes.reach[m] or between >= cosine:
            found[count] = j
            count += 1
    return count


@njit(**LEAN)
def _towards(ball, near_origin, which, first, count, u, call, s):
    """``VisibleSphereLight.sample`` of some hits: vectors to the lamp, 1 / their lengths, and FACING, the factor."""
    for i in range(count):
        s[V + i] = _TURN * u[1, first + i]
    numpy_kernels.cos(call, s[V : V + count], s[COSINE : COSINE + count])
    numpy_kernels.sin(call, s[V : V + count], s[SINE : SINE + count])
    for i in range(count):
        j = which[first + i]
        x, y, z = (
            ball.center[0] - near_origin[0, j],
            ball.center[1] - near_origin[1, j],
            ball.center[2] - near_origin[2, j],
        )
        squared = _NOTHING + x * x + y * y + z * z
        s[LAMP + i] = _cone_density(ball.radius, np.sqrt(squared))
        x, y, z, s[INVERSE + i], s[FACING + i] = towards_cap(
            x, y, z, squared, ball.squared, u[0, first + i], s[COSINE + i], s[SINE + i]
        )
        s[TO + i], s[TO + ROW + i], s[TO + 2 * ROW + i] = x, y, z


@njit(**OPTIONS)
def look(
    ball,
    lobes,
    near_origin,
    direction,
    ns,
    ng,
    material,
    u,
    call,
    which,
    light,
    cosine,
    origin,
    to_light,
    near,
):
    """How many shadow rays go to points on a lamp, and what they bring; see ``LobeLight``.

    Parameters
    ----------
    near_origin, direction, ns, ng, material : of ``Hits``
    u : (2, m) in [0, 1)
    which : (m,) int64, the hits that look for points; then those of the rays, from the beginning
    light, cosine, origin, to_light, near : (m,) and (3, m) filled from the beginning
    """
    s, kept = np.empty(ALL, np.float32), 0
    for first in range(0, len(which), ROW):
        count = min(ROW, len(which) - first)
        _towards(ball, near_origin, which, first, count, u, call, s)
        for i in range(count):
            j = which[first + i]
            x, y, z = s[TO + i], s[TO + ROW + i], s[TO + 2 * ROW + i]
            inverse = s[INVERSE + i]
            facing = (_NOTHING + ns[0, j] * x + ns[1, j] * y + ns[2, j] * z) * inverse
            s[IRRADIANCE + i], s[FACING + i] = facing * s[FACING + i], facing
            s[WAY + i], s[WAY + ROW + i], s[WAY + 2 * ROW + i] = (
                x * inverse,
                y * inverse,
                z * inverse,
            )
            _sunk(direction, ns, ng, j, s, i)
        _dense(lobes.exponents, material, which, first, count, call, s)
        for i in range(count):
            j = which[first + i]
            lamp, lobe = s[LAMP + i], s[HELD + i]
            if not (s[IRRADIANCE + i] > 0 and lamp > 0):
                continue
            peak = (lobes.exponents[material[j]] + _ONE) / _TURN
            sent = ball.sent * lobe * _weight(lobes, lamp, lobe, peak, False) / lamp
            if sent == 0:
                continue
            which[kept], light[kept], cosine[kept] = j, sent, s[FACING + i]
            for c in range(3):
                origin[c, kept] = near_origin[c, j]
                to_light[c, kept] = s[TO + c * ROW + i]
            near[kept] = s[INVERSE + i]
            kept += 1
    return kept


@njit(**OPTIONS)
def carry(exponents, which, way, direction, ns, ng, material, call, density, peak):
    """Fill the densities of rays (m,), and those in the middle of their lobes; see ``LampsAndLobes.carried``.

    Parameters
    ----------
    which : (m,) int64, the hits that the rays leave
    way : (3, m) directions of the rays
    direction, ns, ng, material : of ``Hits``
    """
    s = np.empty(ALL, np.float32)
    for first in range(0, len(which), ROW):
        count = min(ROW, len(which) - first)
        for i in range(count):
            j = which[first + i]
            for c in range(3):
                s[WAY + c * ROW + i] = way[c, first + i]
            _sunk(direction, ns, ng, j, s, i)
        _dense(exponents, material, which, first, count, call, s)
        for i in range(count):
            j = which[first + i]
            exponent = exponents[material[j]]
            x, y, z = way[0, first + i], way[1, first + i], way[2, first + i]
            up = _NOTHING + x * ns[0, j] + y * ns[1, j] + z * ns[2, j]
            held = exponent >= 0 and up > 0
            density[first + i] = s[HELD + i] if held else DELTA
            peak[first + i] = (exponent + _ONE) / _TURN


@njit(**OPTIONS)
def share(ball, lobes, lamp, which, material, side, origin, density, peak, found):
    """Multiply by the lobes' weights where rays meet a lamp; see ``LampsAndLobes.share``.

    Parameters
    ----------
    lamp : its material
    which : (n,) int64, the rays that hit; (0,) if all do
    material, side : of ``Hits``
    origin, density, peak : (3, k) and (k,) of the rays
    found : (n,) filled at those hits
    """
    for i in range(len(material)):
        if material[i] != lamp or not side[i] > 0:
            continue
        j = which[i] if len(which) else i
        if not density[j] < DELTA:
            continue
        x, y, z = (
            ball.center[0] - origin[0, j],
            ball.center[1] - origin[1, j],
            ball.center[2] - origin[2, j],
        )
        of_lamp = _cone_density(ball.radius, np.sqrt(_NOTHING + x * x + y * y + z * z))
        found[i] = _weight(lobes, of_lamp, density[j], peak[j], True)
