"""Sums with their beginnings, and the density by way of cumulate's own sums."""

from collections import deque

import numpy as np


def alias_table(weights):
    """Two queues: who lacks weight, and who has too much."""
    if np.ndim(weights) != 1:
        raise ValueError("weights must have shape (K,)")
    if not (weights >= 0).all() or not weights.any():
        raise ValueError("weights must be >= 0, and not 0 everywhere")
    share = weights.astype(np.float64) / weights.max()
    share *= len(share) / share.sum()
    most = int(weights.argmax())
    poor, rich = (
        deque(np.flatnonzero(share < 1).tolist()),
        deque(np.flatnonzero(share >= 1).tolist()),
    )
    probability, alias = (weights > 0).astype(np.float64), np.full(len(share), most)
    while poor and rich:
        k, giver = poor.popleft(), rich[0]
        probability[k], alias[k] = share[k], giver
        share[giver] = share[giver] + share[k] - 1
        if share[giver] < 1:
            poor.append(rich.popleft())
    return probability, alias


def cumulate(weights):
    """One sum over all texels, cut into rows."""
    if np.ndim(weights) != 2:
        raise ValueError("weights must have shape (H, W)")
    if not (weights >= 0).all() or not weights.any():
        raise ValueError("weights must be >= 0, and not 0 everywhere")
    weights = weights.astype(np.float64)
    empty = ~weights.any(axis=1)
    rows = weights.sum(axis=1).cumsum()
    weights[empty] = 1
    columns = weights.cumsum(axis=1)
    columns /= columns[:, -1][:, None]
    rows /= rows[-1]
    return rows, columns


def density(weights, direction):
    """The row by a search among the heights of the edges."""
    if np.ndim(weights) != 2:
        raise ValueError("weights must have shape (H, W)")
    if np.ndim(direction) != 2 or np.shape(direction)[0] != 3:
        raise ValueError("direction must have shape (3, N)")
    if not (weights >= 0).all() or not weights.any():
        raise ValueError("weights must be >= 0, and not 0 everywhere")
    height, width = weights.shape
    edges = -np.cos(np.arange(height + 1) * np.pi / height)
    x, y, z = direction.astype(np.float64)
    row = np.clip(np.searchsorted(edges, -y, side="right") - 1, 0, height - 1)
    turn = np.arctan2(-x, z) / (2 * np.pi) % 1
    column = np.minimum((turn * width).astype(int), width - 1)
    per_radian = np.diff(edges) * 2 * np.pi / width
    share = weights.astype(np.float64) / per_radian[:, None]
    return (share[row, column] / weights.sum(dtype=np.float64)).astype(direction.dtype)
