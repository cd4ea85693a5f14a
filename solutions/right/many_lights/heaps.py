"""Leaves by a heap of nodes that wait, and axes by spherical interpolation."""

import numpy as np


def light_tree(lo, hi, axis, angle, power):
    """Leaves first, then one node after the other from below."""
    shapes = [np.shape(part) for part in (lo, hi, axis, angle, power)]
    lamps = shapes[-1][0] if len(shapes[-1]) == 1 else 0
    if lamps < 1 or shapes != [(3, lamps), (3, lamps), (3, lamps), (lamps,), (lamps,)]:
        raise ValueError("lamps must have shapes (3, L) and (L,), and L must be 1 at least")
    kind = np.result_type(lo, hi, axis, angle, power)
    parts = [
        np.empty((*np.shape(part)[:-1], 2 * lamps - 1), kind)
        for part in (lo, hi, axis, angle, power)
    ]
    own = np.lexsort((np.arange(lamps), _halved(0.5 * (lo + hi), lamps)))
    for into, part in zip(parts, (lo, hi, axis, angle, power), strict=True):
        into[..., lamps - 1 :] = part[..., own]
    for k in range(lamps - 2, -1, -1):
        pair = slice(2 * k + 1, 2 * k + 3)
        parts[0][:, k] = parts[0][:, pair].min(axis=1)
        parts[1][:, k] = parts[1][:, pair].max(axis=1)
        a, b = np.split(parts[2][:, pair], 2, axis=1)
        parts[2][:, [k]], parts[3][[k]] = merge_cones(
            a, parts[3][2 * k + 1 : 2 * k + 2], b, parts[3][2 * k + 2 : 2 * k + 3]
        )
        parts[4][k] = parts[4][pair].sum()
    return (*parts, own)


def _halved(centre, lamps):
    """Leaf of each lamp, by a stack of nodes."""
    leaf = np.empty(lamps, int)

    def weight(k):
        # Leaves of a heap below node k: level by level, as many as there are.
        total, low, high = 0, k, k
        while low < 2 * lamps - 1:
            last = min(high, 2 * lamps - 2)
            total += max(0, last - max(low, lamps - 1) + 1)
            low, high = 2 * low + 1, 2 * high + 2
        return total

    waiting = {0: np.arange(lamps)}
    while waiting:
        k, some = waiting.popitem()
        if len(some) == 1:
            leaf[some[0]] = k - (lamps - 1)
        else:
            spread = np.var(centre[:, some], axis=1)
            some = some[np.argsort(centre[int(np.argmax(spread)), some])]
            cut = weight(2 * k + 1)
            waiting[2 * k + 1], waiting[2 * k + 2] = some[:cut], some[cut:]
    return leaf


def merge_cones(axis_a, angle_a, axis_b, angle_b):
    """The axis as a weighted sum of both: spherical interpolation."""
    if np.ndim(axis_a) != 2 or len(axis_a) != 3 or np.shape(axis_a) != np.shape(axis_b):
        raise ValueError("axes must have shape (3, N)")
    if np.shape(angle_a) != np.shape(axis_a)[1:] or np.shape(angle_b) != np.shape(angle_a):
        raise ValueError("angles must have shape (N,)")
    kind = np.result_type(axis_a, angle_a, axis_b, angle_b)
    a, b, s, t = (np.array(x, float) for x in (axis_a, axis_b, angle_a, angle_b))
    gap = np.arctan2(np.linalg.norm(np.cross(a.T, b.T), axis=1), np.sum(a * b, axis=0))
    whole = np.clip((gap + s + t) / 2, 0, np.pi)
    keep_a, keep_b = np.minimum(gap + t, np.pi) <= s, np.minimum(gap + s, np.pi) <= t
    move = whole - s
    flat = np.sin(gap) < 1e-6
    with np.errstate(divide="ignore", invalid="ignore"):
        axis = (np.sin(gap - move) * a + np.sin(move) * b) / np.sin(gap)
    # Beside a there is always a vector at right angles; it serves where a and b are one line.
    beside = np.cross(a.T, np.eye(3)[np.abs(a).argmin(axis=0)]).T
    beside /= np.linalg.norm(beside, axis=0)
    axis = np.where(flat, np.cos(move) * a + np.sin(move) * beside, axis)
    axis = np.where(keep_b, b, axis)
    axis = np.where(keep_a | (whole >= np.pi) & ~keep_b, a, axis)
    angle = np.where(keep_a, s, np.where(keep_b, t, whole))
    axis = axis / np.linalg.norm(axis, axis=0)
    return axis.astype(kind), np.minimum(angle.astype(kind), kind.type(np.pi))


def power_choice(power, u):
    """With NumPy's digitize."""
    if np.ndim(power) != 1 or np.ndim(u) != 1 or not np.all(power >= 0) or not np.sum(power) > 0:
        raise ValueError("power must have shape (L,), be >= 0 and not all 0, and u shape (N,)")
    share = np.divide(power, power.sum(dtype=float), dtype=float)
    # Edges that end below 1 by rounding leave what is above them to the last lamp that shines.
    number = np.digitize(u, share.cumsum()).clip(0, np.flatnonzero(share)[-1])
    return number, share[number].astype(u.dtype)
