"""Walks down a light tree, sixteen at a time, compiled by Numba; imported by ``course.engine.loops.light_tree``.

It is ``many_lights.tree_choice`` with the course's ``importance``, in the same order of arithmetic and so to the same
bits. What hangs on a node alone, such as its radius and the cosine of its cone, comes in a table.
"""

import numpy as np
from numba import types

from course.engine.loops.options import COLUMNS, LEAN, ROW, njit

WIDTH = 16
"""Walks that go together."""

COLUMNS_OF_NODE = 14
"""Of the table: three of the box's middle, three of its half size, three of the cone's axis; the radius of the sphere
around the box, and a twentieth of it; cosine and sine of the cone's angle; the power."""

Y, Z, HX, HY, HZ, AX, AY, AZ, RADIUS, LEAST, COSINE, SINE, POWER = (
    WIDTH * column for column in range(1, COLUMNS_OF_NODE)
)
LEFT, RIGHT = 0, COLUMNS_OF_NODE * WIDTH
"""Rows of one array: columns of sixteen left nodes, and of the right ones; then points, normals and importances."""

PX, PY, PZ, NX, NY, NZ, ONE, TWO = (WIDTH * (2 * COLUMNS_OF_NODE + number) for number in range(8))
ALL_ROWS = 2 * COLUMNS_OF_NODE + 8

_NOTHING, _HALF, _ONE = np.float32(0), np.float32(0.5), np.float32(1)
_NEXT = np.uint64(1)
_BELOW_ONE = 1 - 2.0**-53


@njit(**LEAN)
def _is_less(cos_a, sin_a, cos_b, sin_b):
    return _ONE if cos_a >= cos_b else cos_a * cos_b + sin_a * sin_b


@njit(**LEAN)
def _importance(s, node, into):
    """``many_lights.importance`` of sixteen nodes, whose columns are in rows from ``node`` on."""
    for i in range(WIDTH):
        hx, hy, hz = s[node + HX + i], s[node + HY + i], s[node + HZ + i]
        x, y, z = s[node + i] - s[PX + i], s[node + Y + i] - s[PY + i], s[node + Z + i] - s[PZ + i]
        radius = s[node + RADIUS + i]
        distance = np.sqrt(x * x + y * y + z * z)
        inverse = _ONE / (distance if distance > 0 else _ONE)
        sine = min(radius * inverse, _ONE)
        outside = distance > radius
        seen_cos = np.sqrt(_ONE - sine * sine)
        seen_cos, seen_sin = seen_cos if outside else -_ONE, sine if outside else _NOTHING
        cosine = (s[NX + i] * x + s[NY + i] * y + s[NZ + i] * z) * inverse
        sine = np.sqrt(max(_ONE - cosine * cosine, _NOTHING))
        at_surface = _is_less(cosine, sine, seen_cos, seen_sin)
        cosine = s[node + AX + i] * x + s[node + AY + i] * y + s[node + AZ + i] * z
        cosine = -cosine * inverse
        sine = np.sqrt(max(_ONE - cosine * cosine, _NOTHING))
        turned = _is_less(cosine, sine, seen_cos, seen_sin)
        sine = sine * seen_cos - cosine * seen_sin if turned < 1 else _NOTHING
        at_lamps = _is_less(turned, sine, s[node + COSINE + i], s[node + SINE + i])
        x, y, z = abs(x) - hx, abs(y) - hy, abs(z) - hz
        x, y, z = max(x, _NOTHING), max(y, _NOTHING), max(z, _NOTHING)
        near = max(np.sqrt(x * x + y * y + z * z), s[node + LEAST + i])
        squared = max(distance, radius) * near
        sent = s[node + POWER + i] * max(at_surface, _NOTHING) * max(at_lamps, _NOTHING)
        found = sent / (squared if squared > 0 else _ONE)
        s[into + i] = found if squared > 0 else _NOTHING


@njit(
    types.void(COLUMNS, types.int64[::1], COLUMNS, COLUMNS, ROW, types.int64[::1], ROW),
    nogil=True,
    cache=True,
    error_model="numpy",
)
def walk(table, order, p, n, u, lamp, probability):
    """Fill the lamp and the probability of its choice for each of N points.

    Parameters
    ----------
    table : (M, COLUMNS_OF_NODE) of the nodes
    order : (L,) lamps of the leaves
    p, n : (3, N) points and normals
    u : (N,) in [0, 1)
    lamp, probability : (N,), filled
    """
    inner = order.size - 1
    s, node = np.zeros(ALL_ROWS * WIDTH, np.float32), np.zeros(WIDTH, np.int64)
    v, product = np.zeros(WIDTH), np.zeros(WIDTH)
    levels, rest = 0, inner
    while rest:
        levels, rest = levels + 1, rest // 2
    for first in range(0, len(u), WIDTH):
        count = min(WIDTH, len(u) - first)
        for i in range(WIDTH):
            j = first + min(i, count - 1)
            for c in range(3):
                s[PX + c * WIDTH + i], s[NX + c * WIDTH + i] = p[c, j], n[c, j]
            v[i], product[i], node[i] = min(np.float64(u[j]), _BELOW_ONE), 1.0, 0
        for _ in range(levels):
            for i in range(WIDTH):
                # Walks that end a step before the others look at some node, and stay where they are.
                k = np.uint64(2 * node[i] + 1 if node[i] < inner else 1)
                for c in range(COLUMNS_OF_NODE):
                    s[LEFT + c * WIDTH + i] = table[k, c]
                    s[RIGHT + c * WIDTH + i] = table[k + _NEXT, c]
            _importance(s, LEFT, ONE)
            _importance(s, RIGHT, TWO)
            for i in range(WIDTH):
                both = s[ONE + i] + s[TWO + i]
                share = s[ONE + i] / (both if both > 0 else _ONE)
                part = np.float64(share if both > 0 else _HALF)
                on, goes = node[i] < inner, v[i] < part
                taken = part if goes else 1 - part
                place = (v[i] if goes else v[i] - part) / taken
                v[i] = min(place, _BELOW_ONE) if on else v[i]
                product[i] *= taken if on else 1.0
                node[i] = (2 * node[i] + (1 if goes else 2)) if on else node[i]
        for i in range(count):
            lamp[first + i], probability[first + i] = order[node[i] - inner], product[i]
