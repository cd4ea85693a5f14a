"""Boxes a little larger, to be on the safe side."""

import numpy as np

FUNCTION = "build"
CAUGHT_BY = "contains"
MISTAKE = "padded-boxes"
SAYS = "The boxes are larger than what they hold."


def build(lo, hi, leaf_size):
    """Halves, and halves of these."""
    _check_vectors("lo", lo)
    _check_vectors("hi", hi, np.shape(lo)[1])
    if np.shape(lo)[1] == 0:
        raise ValueError("lo must have at least one column, got none")
    if not leaf_size >= 1 or leaf_size != int(leaf_size):
        raise ValueError(f"leaf_size must be an integer >= 1, got {leaf_size}")
    dtype = np.result_type(lo, hi)
    lo, hi = lo.astype(dtype), hi.astype(dtype)
    middle = lo / 2 + hi / 2
    low, high = lo - dtype.type(1e-4), hi + dtype.type(1e-4)
    boxes, first, count, order = [None], [0], [0], []
    waiting = [(0, np.arange(lo.shape[1]))]
    while waiting:
        node, run = waiting.pop()
        boxes[node] = low[:, run].min(axis=1), high[:, run].max(axis=1)
        if run.size <= leaf_size:
            first[node], count[node] = len(order), run.size
            order.extend(run)
        else:
            key = middle[np.ptp(middle[:, run], axis=1).argmax()]
            run = run[np.argsort(key[run])]
            first[node] = len(boxes)
            for half in (run[: run.size // 2], run[run.size // 2 :]):
                waiting.append((len(boxes), half))
                boxes.append(None)
                first.append(0)
                count.append(0)
    corners = np.array(boxes).transpose(1, 2, 0)
    return corners[0].copy(), corners[1].copy(), np.array(first), np.array(count), np.array(order)
