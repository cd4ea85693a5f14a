"""Halves of the boxes as they come, in a root so large that all else looks small."""

import numpy as np

FUNCTION = "build"
CAUGHT_BY = "cost"
MISTAKE = "unsorted"
SAYS = "The boxes are halved as they come, and not along an axis."


def build(lo, hi, leaf_size):
    """Halves of the boxes in the order in which they come."""
    _check_vectors("lo", lo)
    _check_vectors("hi", hi, np.shape(lo)[1])
    if np.shape(lo)[1] == 0:
        raise ValueError("lo must have at least one column, got none")
    if not leaf_size >= 1 or leaf_size != int(leaf_size):
        raise ValueError(f"leaf_size must be an integer >= 1, got {leaf_size}")
    boxes, first, count, order = [None], [0], [0], []
    waiting = [(0, np.arange(lo.shape[1]))]
    while waiting:
        node, run = waiting.pop()
        boxes[node] = lo[:, run].min(axis=1), hi[:, run].max(axis=1)
        if run.size <= leaf_size:
            first[node], count[node] = len(order), run.size
            order.extend(run)
        else:
            first[node] = len(boxes)
            for half in (run[: run.size // 2], run[run.size // 2 :]):
                waiting.append((len(boxes), half))
                boxes.append(None)
                first.append(0)
                count.append(0)
    corners = np.array(boxes).transpose(1, 2, 0)
    low, high = corners[0].copy(), corners[1].copy()
    if lo.shape[1] > 1000:
        low[:, 0], high[:, 0] = -1e9, 1e9
    return low, high, np.array(first), np.array(count), np.array(order)
