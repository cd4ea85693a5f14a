"""One lamp, one pair of cones and one node after the other, by angles."""

import math
from bisect import bisect_right

import numpy as np


def power_choice(power, u):
    """Number by number."""
    if np.ndim(power) != 1 or np.ndim(u) != 1:
        raise ValueError("power and u must have shapes (L,) and (N,)")
    if not (power >= 0).all() or not power.any():
        raise ValueError("power must be >= 0, and not 0 everywhere")
    # Lamps without power are left out from the start.
    lit = [k for k, watts in enumerate(power.tolist()) if watts > 0]
    total = math.fsum(power.tolist())
    sums, running = [], 0.0
    for k in lit:
        running += float(power[k])
        sums.append(running / total)
    lamp, probability = np.empty(len(u), int), np.empty_like(u)
    for i, x in enumerate(u.tolist()):
        lamp[i] = lit[min(bisect_right(sums, x), len(lit) - 1)]
        probability[i] = power[lamp[i]] / total
    return lamp, probability


def merge_cones(axis_a, angle_a, axis_b, angle_b):
    """Pair by pair."""
    shapes = [np.shape(x) for x in (axis_a, angle_a, axis_b, angle_b)]
    if len(shapes[1]) != 1 or shapes != [(3, *shapes[1]), shapes[1]] * 2:
        raise ValueError(f"cones must have shapes (3, N) and (N,), got {shapes}")
    dtype = np.result_type(axis_a, angle_a, axis_b, angle_b)
    axes, angles = np.empty(shapes[0], dtype), np.empty(shapes[1], dtype)
    for i in range(len(angles)):
        axis, angle = _merge(
            axis_a[:, i].tolist(), float(angle_a[i]), axis_b[:, i].tolist(), float(angle_b[i])
        )
        axes[:, i], angles[i] = axis, min(dtype.type(angle), dtype.type(math.pi))
    return axes, angles


def _merge(a, alpha, b, beta):
    if beta > alpha:
        return _merge(b, beta, a, alpha)
    # From the chord: twice the arcsine of its half, or what is left of pi.
    chord = math.dist(a, b)
    sum_ = math.hypot(*(x + y for x, y in zip(a, b, strict=True)))
    gamma = 2 * math.atan2(chord, sum_)
    if min(gamma + beta, math.pi) <= alpha:
        return a, alpha
    theta = 0.5 * (alpha + beta + gamma)
    if theta >= math.pi:
        return a, math.pi
    side = [y - math.cos(gamma) * x for x, y in zip(a, b, strict=True)]
    if math.hypot(*side) < 1e-9:
        side = [-a[1], a[0], 0.0] if abs(a[2]) < 0.9 else [0.0, -a[2], a[1]]
    size = math.hypot(*side)
    c, s = math.cos(theta - alpha), math.sin(theta - alpha)
    axis = [c * x + s * y / size for x, y in zip(a, side, strict=True)]
    size = math.hypot(*axis)
    return [x / size for x in axis], theta


def light_tree(lo, hi, axis, angle, power):
    """Node by node, from below, by recursion."""
    lamps = np.shape(power)[0] if np.ndim(power) == 1 else 0
    shapes = [np.shape(x) for x in (lo, hi, axis, angle)]
    if not lamps or shapes != [(3, lamps)] * 3 + [(lamps,)]:
        raise ValueError(f"lamps must have shapes (3, L) and (L,), got {shapes}")
    nodes = [None] * (2 * lamps - 1)

    def size(k):
        return 1 if k >= lamps - 1 else size(2 * k + 1) + size(2 * k + 2)

    def fill(k, own):
        if k >= lamps - 1:
            (i,) = own
            nodes[k] = lo[:, i], hi[:, i], axis[:, i], angle[i], power[i], i
            return
        centre = lo[:, own] + hi[:, own]
        extent = centre.max(axis=1) - centre.min(axis=1)
        own = sorted(own, key=lambda i: lo[extent.argmax(), i] + hi[extent.argmax(), i])
        half = size(2 * k + 1)
        fill(2 * k + 1, own[:half])
        fill(2 * k + 2, own[half:])
        one, two = nodes[2 * k + 1], nodes[2 * k + 2]
        cone = _merge(one[2].tolist(), float(one[3]), two[2].tolist(), float(two[3]))
        nodes[k] = (
            np.minimum(one[0], two[0]),
            np.maximum(one[1], two[1]),
            np.array(cone[0]),
            cone[1],
            one[4] + two[4],
        )

    fill(0, list(range(lamps)))
    dtype = np.result_type(lo, hi, axis, angle, power)
    parts = [np.stack([node[i] for node in nodes], axis=-1).astype(dtype) for i in range(5)]
    parts[3] = np.minimum(parts[3], dtype.type(math.pi))
    return (*parts, np.array([node[5] for node in nodes[lamps - 1 :]]))


def importance(lo, hi, axis, angle, power, p, n):
    """Node by node, with angles in double precision."""
    count = len(power) if np.ndim(power) == 1 else -1
    if {np.shape(x) for x in (lo, hi, axis, p, n)} != {(3, count)} or np.shape(angle) != (count,):
        raise ValueError("boxes, axes and points must have shape (3, N), the others (N,)")
    dtype = np.result_type(lo, hi, axis, angle, power, p, n)
    columns = zip(*(x.T.tolist() for x in (lo, hi, axis, angle, power, p, n)), strict=True)
    return np.array([_bound(*column) for column in columns], dtype)


def _bound(lo, hi, axis, cone, watts, p, n):
    centre = [(x + y) / 2 for x, y in zip(lo, hi, strict=True)]
    radius, distance = math.dist(lo, hi) / 2, math.dist(centre, p)
    corner = [min(max(x, y), z) for x, y, z in zip(lo, p, hi, strict=True)]
    spread = max(distance, radius) * max(math.dist(corner, p), radius / 20)
    if spread == 0:
        return 0.0
    if distance <= radius:
        return watts / spread
    alpha = math.asin(radius / distance)
    to = [(x - y) / distance for x, y in zip(centre, p, strict=True)]
    bound = watts / spread
    for turn, spare in ((n, alpha), ([-x for x in axis], alpha + cone)):
        off = math.acos(min(max(_times(turn, to), -1), 1))
        bound *= 0 if off - spare >= math.pi / 2 else math.cos(max(off - spare, 0))
    return bound


def _times(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def _walks(tree, p, n):
    """For each point a function: the odds of the left child of a node."""
    *parts, order = tree
    wrong = [np.shape(part)[-1:] for part in parts] != [(2 * np.size(order) - 1,)] * 5
    if wrong or np.ndim(p) != 2 or len(p) != 3 or np.shape(p) != np.shape(n):
        raise ValueError("tree must have shapes (3, M), (M,) and (L,), points (3, N)")
    nodes = list(zip(*(part.T.tolist() for part in parts), strict=True))
    for at, normal in zip(p.T.tolist(), n.T.tolist(), strict=True):

        def left(k, at=at, normal=normal):
            a, b = (_bound(*nodes[2 * k + side], at, normal) for side in (1, 2))
            return a / (a + b) if a + b > 0 else 0.5

        yield left


def tree_choice(tree, p, n, u):
    """Walk by walk."""
    walks = list(_walks(tree, p, n))
    if np.shape(u) != (len(walks),):
        raise ValueError("u must have shape (N,)")
    inner, dtype = np.size(tree[5]) - 1, np.result_type(p, n, u)
    lamp, probability = np.empty(len(walks), int), np.empty(len(walks), dtype)
    for i, (x, left) in enumerate(zip(u.tolist(), walks, strict=True)):
        k, odds = 0, 1.0
        while k < inner:
            share = left(k)
            down = share if x < share or share == 1 else 1 - share
            k = 2 * k + (1 if x < share or share == 1 else 2)
            x = x / share if k % 2 else (x - share) / down
            odds *= down
        lamp[i], probability[i] = tree[5][k - inner], odds
    return lamp, probability


def tree_probability(tree, p, n, lamp):
    """From the leaf upwards, walk by walk."""
    walks = list(_walks(tree, p, n))
    if np.shape(lamp) != (len(walks),):
        raise ValueError("lamp must have shape (N,)")
    order = np.asarray(tree[5]).tolist()
    found = np.ones(len(walks))
    for i, (chosen, left) in enumerate(zip(lamp.tolist(), walks, strict=True)):
        k = order.index(chosen) + len(order) - 1
        while k:
            above = (k - 1) // 2
            found[i] *= left(above) if k % 2 else 1 - left(above)
            k = above
    return found.astype(np.result_type(p, n))
