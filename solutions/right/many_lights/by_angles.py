"""Angles by the arccosine, and walks that know the beginning and the end of their part of [0, 1)."""

import numpy as np


def importance(lo, hi, axis, angle, power, p, n):
    """With the angles themselves."""
    count = np.shape(power)[0] if np.ndim(power) == 1 else -1
    vectors = [np.shape(x) for x in (lo, hi, axis, p, n)]
    if vectors != [(3, count)] * 5 or np.shape(angle) != (count,):
        raise ValueError("arguments must have shapes (3, N) and (N,)")
    dtype = np.result_type(lo, hi, axis, angle, power, p, n)
    lo, hi, axis, p, n = (x.astype(np.float64) for x in (lo, hi, axis, p, n))
    radius = np.linalg.norm(hi - lo, axis=0) / 2
    to = (lo + hi) / 2 - p
    distance = np.linalg.norm(to, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        alpha = np.where(distance > radius, np.arcsin(radius / distance), np.pi)
        at_p = np.arccos(np.clip(np.einsum("ij,ij->j", n, to) / distance, -1, 1))
        at_lamp = np.arccos(np.clip(-np.einsum("ij,ij->j", axis, to) / distance, -1, 1))
        at_p, at_lamp = np.clip(at_p - alpha, 0, np.pi / 2), at_lamp - angle - alpha
        cosines = np.cos(at_p) * np.cos(np.clip(at_lamp, 0, np.pi / 2))
    # Half of pi has a cosine of 6e-17.
    cosines[(at_p >= np.pi / 2) | (at_lamp >= np.pi / 2)] = 0
    cosines[distance <= radius] = 1
    nearest = np.linalg.norm(np.minimum(np.maximum(lo, p), hi) - p, axis=0)
    product = np.maximum(distance, radius) * np.maximum(nearest, radius / 20)
    found = power * cosines / np.where(product > 0, product, np.inf)
    return found.astype(dtype)


def tree_choice(tree, p, n, u):
    """The number stays; the part of [0, 1) becomes smaller."""
    _look(tree, p, n, u)
    order, first = tree[5], len(tree[5]) - 1
    found = np.zeros(len(u), int)
    low, high = np.zeros(len(u)), np.ones(len(u))
    while (found < first).any():
        (now,) = np.nonzero(found < first)
        share = _share(tree, 2 * found[now] + 1, p[:, now], n[:, now])
        cut = low[now] + share * (high[now] - low[now])
        right = (u[now] >= cut) & (share < 1)
        low[now], high[now] = np.where(right, cut, low[now]), np.where(right, high[now], cut)
        found[now] = 2 * found[now] + 1 + right
    return order[found - first], (high - low).astype(np.result_type(p, n, u))


def tree_probability(tree, p, n, lamp):
    """By the bits of the leaf's number: the way from the root."""
    _look(tree, p, n, lamp)
    order = np.asarray(tree[5])
    leaf = np.empty_like(order)
    leaf[order] = np.arange(len(order))
    # Counted from 1, the children of k are 2 k and 2 k + 1: bits tell the way.
    place = leaf[lamp] + len(order)
    found = np.ones(len(place))
    for bit in range(int(2 * len(order)).bit_length()):
        child = place >> bit
        (now,) = np.nonzero(child > 1)
        left = child[now] & ~1
        share = _share(tree, left - 1, p[:, now], n[:, now])
        found[now] *= np.where(child[now] & 1, 1 - share, share)
    return found.astype(np.result_type(p, n))


def _share(tree, left, p, n):
    """Probability of left children."""
    a = importance(*[part[..., left] for part in tree[:5]], p, n).astype(float)
    b = importance(*[part[..., left + 1] for part in tree[:5]], p, n).astype(float)
    with np.errstate(invalid="ignore"):
        return np.nan_to_num(a / (a + b), nan=0.5)


def _look(tree, p, n, numbers):
    lo, hi, axis, angle, power, order = tree if len(tree) == 6 else (None,) * 6
    nodes = 2 * np.size(order) - 1
    if any(np.shape(part) != (3, nodes) for part in (lo, hi, axis)):
        raise ValueError("the tree's boxes and axes must have shape (3, M)")
    if any(np.shape(part) != (nodes,) for part in (angle, power)) or np.ndim(order) != 1:
        raise ValueError("the tree's angles and powers must have shape (M,)")
    if np.ndim(numbers) != 1 or np.shape(p) != (3, len(numbers)) or np.shape(n) != np.shape(p):
        raise ValueError("p and n must have shape (3, N), and numbers (N,)")
