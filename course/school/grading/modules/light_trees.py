"""Light trees for checks: cones, bounds by angles, and walks down a tree, in double precision.

Nodes of trees that are made here lie as they come, so that they aren't sorted as a student's may be.
"""

from typing import Any

import numpy as np

from course.school.grading.checks.check import Array
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.vectors import dot, unit_vectors

Tree = tuple[Array, Array, Array, Array, Array, Array]
"""lo, hi, axis (3, M), angle, power (M,) and order (L,), as the module's ``light_tree`` describes them."""

ALL = float(np.pi)
"""Angle of a cone of all directions."""

CLEAR = 1e-2
"""Distance from a jump, as an angle or a share of a radius, within which nothing is asked for."""


def apart(a: Array, b: Array) -> Array:
    """Angles (N,) between unit vectors."""
    return np.asarray(np.arctan2(np.linalg.norm(np.cross(a, b, axis=0), axis=0), dot(a, b)))


def merged(
    axis_a: Array, angle_a: Array, axis_b: Array, angle_b: Array
) -> tuple[Array, Array, Array]:
    """Axes and angles of the narrowest cones around two, and which of the axes (N,) are no matter of choice."""
    between = apart(axis_a, axis_b)
    angle = (between + angle_a + angle_b) / 2
    # As seen from a: how far the axis is turned to b. Outside of 0 to between, one cone holds the other.
    turn = angle - angle_a
    told = np.sin(between) > CLEAR
    sine = np.where(told, np.sin(between), 1)
    axis = (np.sin(between - turn) * axis_a + np.sin(turn) * axis_b) / sine
    in_a, in_b = between + angle_b <= angle_a, between + angle_a <= angle_b
    axis = np.where(in_a, axis_a, np.where(in_b, axis_b, axis))
    angle = np.where(in_a, angle_a, np.where(in_b, angle_b, np.minimum(angle, ALL)))
    return axis, angle, (told | in_a | in_b) & (angle < ALL)


def bounded(parts: tuple[Array, ...], p: Array, n: Array, more: float = 0.0) -> Array:
    """Two cosines (N,) of what the lamps in boxes send at most; angles are smaller by what is said."""
    lo, hi, axis, angle = parts[:4]
    radius = np.linalg.norm(hi - lo, axis=0) / 2
    way = lo / 2 + hi / 2 - p
    distance = np.linalg.norm(way, axis=0)
    outside = distance > radius
    size = np.where(outside, np.arcsin(radius / np.where(outside, distance, np.inf)), ALL) + more
    to_lamps = way / np.where(distance > 0, distance, 1)
    surface = np.maximum(apart(n, to_lamps) - size, 0)
    lamps = np.maximum(apart(axis, -to_lamps) - angle - size, 0)
    return np.asarray(np.maximum(np.cos(surface), 0) * np.maximum(np.cos(lamps), 0))


def squared(parts: tuple[Array, ...], p: Array) -> Array:
    """Product (N,) of points' distances from boxes' centres and from their nearest points, both with their least."""
    lo, hi = parts[:2]
    least = np.sqrt(((hi - lo) ** 2).sum(axis=0)) / 2
    centre = np.sqrt(((lo / 2 + hi / 2 - p) ** 2).sum(axis=0))
    nearest = np.sqrt(((p - np.clip(p, lo, hi)) ** 2).sum(axis=0))
    return np.asarray(np.maximum(centre, least) * np.maximum(nearest, 0.05 * least))


def important(parts: tuple[Array, ...], p: Array, n: Array) -> Array:
    """Importance (N,) of nodes (each its own), 0 at a distance of 0."""
    far = squared(parts, p)
    return np.asarray(parts[4] * bounded(parts, p, n) / np.where(far > 0, far, np.inf))


def shares(tree: Tree, p: Array, n: Array) -> Array:
    """Probability (L - 1, N) of the left child at each inner node."""
    every = important(*_of_all(tree, p, n))
    left, both = every[1::2], every[1::2] + every[2::2]
    return np.where(both > 0, left / np.where(both > 0, both, 1), 0.5)


def intervals(tree: Tree, p: Array, n: Array) -> tuple[Array, Array]:
    """Beginning and length (L, N) of the part of [0, 1) that chooses each lamp."""
    first = tree[5].size - 1
    low, length = np.zeros((2, 2 * first + 1, p.shape[1]))
    length[0] = 1
    for k, share in enumerate(shares(tree, p, n)):
        low[2 * k + 1], length[2 * k + 1] = low[k], length[k] * share
        low[2 * k + 2], length[2 * k + 2] = low[k] + length[2 * k + 1], length[k] * (1 - share)
    where = np.argsort(tree[5])
    return low[first:][where], length[first:][where]


def clear(tree: Tree, p: Array, n: Array) -> Array:
    """Which points (N,) are far from jumps: from spheres around boxes, and from where a pair of nodes goes dark."""
    parts, p, n = _of_all(tree, p, n)
    radius = np.linalg.norm(parts[1] - parts[0], axis=0) / 2
    distance = np.linalg.norm(parts[0] / 2 + parts[1] / 2 - p, axis=0)
    fine = (np.abs(distance - radius) > CLEAR * (distance + radius)).all(axis=0)
    bright = (bounded(parts, p, n) > CLEAR)[1:]
    dark = (bounded(parts, p, n, CLEAR) == 0)[1:]
    # A pair in which both are dark is halved; one in which something is bright, and power, isn't.
    told = bright[::2] | bright[1::2] | (dark[::2] & dark[1::2])
    return np.asarray(fine & told.all(axis=0))


def _of_all(tree: Tree, p: Array, n: Array) -> tuple[tuple[Array, ...], Array, Array]:
    """Nodes, points and normals, with axes for each node and each point behind that of the coordinates."""
    return tuple(part[..., None] for part in tree[:5]), p[:, None], n[:, None]


# ---------------------------------------------------------------- lamps and trees


def narrowed(draw: Draw, angle: Array) -> Array:
    """Angles, of some calls a hundredth of them."""
    return angle * float(draw.rng.choice((1.0, 1.0, 0.01)))


def lamps(draw: Draw, count: int) -> dict[str, Array]:
    """Small lamps anywhere: some shine to all sides, some along one normal, some along several."""
    middle = draw.lengths(-2, 2, 3, count)
    half = draw.scale * draw.rng.uniform(0.01, 0.05, (3, count))
    return {
        "lo": (middle - half).astype(draw.dtype),
        "hi": (middle + half).astype(draw.dtype),
        "axis": draw.directions(count),
        "angle": narrowed(draw, draw.rng.choice((0.0, 0.3, ALL), count)),
        "power": draw.number(0.02, 50) * draw.uniform(0.5, 4, count),
    }


def grown(draw: Draw, order: Array | None = None, **own: Array) -> Tree:
    """A tree over lamps, in no order at all if none is given; numbers of the batches' dtype."""
    count = own["power"].size
    order = draw.rng.permutation(count) if order is None else order
    nodes: dict[int, tuple[Any, ...]] = {
        count - 1 + leaf: tuple(own[name][..., lamp] for name in own)
        for leaf, lamp in enumerate(order.tolist())
    }
    for k in reversed(range(count - 1)):
        (lo, hi, axis, angle, power), other = nodes[2 * k + 1], nodes[2 * k + 2]
        cone = merged(axis[:, None], angle, other[2][:, None], other[3])
        around = (cone[0][:, 0], cone[1][0]) if cone[2].all() else (axis, cone[1][0] * 0 + ALL)
        nodes[k] = (
            np.minimum(lo, other[0]),
            np.maximum(hi, other[1]),
            around[0] / np.linalg.norm(around[0]),
            around[1],
            power + other[4],
        )
    parts = [np.stack([nodes[k][i] for k in range(2 * count - 1)], axis=-1) for i in range(5)]
    lo, hi, *cones = (np.ascontiguousarray(part, draw.dtype) for part in parts)
    return lo, hi, cones[0], cones[1], cones[2], order


def seen(draw: Draw, tree: Tree) -> tuple[Array, Array]:
    """Points and normals (3, N) far from all jumps, of the batches' dtype."""
    found_p, found_n = np.zeros((3, 0)), np.zeros((3, 0))
    n = max(2 * draw.n, 50)
    exact: Any = tuple(x.astype(np.float64) for x in tree[:5]) + tree[5:]
    while found_p.shape[1] < draw.n:
        p = (draw.scale * draw.rng.uniform(-3, 3, (3, n))).astype(draw.dtype).astype(np.float64)
        normal = unit_vectors(draw.rng, n, draw.dtype).astype(np.float64)
        fine = clear(exact, p, normal)
        found_p = np.concatenate((found_p, p[:, fine]), axis=1)
        found_n = np.concatenate((found_n, normal[:, fine]), axis=1)
    return found_p[:, : draw.n], found_n[:, : draw.n]
