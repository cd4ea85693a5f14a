"""One leaf for all."""

import numpy as np

FUNCTION = "build"
CAUGHT_BY = "cost"
MISTAKE = "one-leaf"
SAYS = "You put all boxes into one leaf; then every ray is tested with everything."


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
    order = np.arange(lo.shape[1])
    root = lo.min(axis=1, keepdims=True), hi.max(axis=1, keepdims=True)
    return *root, np.zeros(1, int), np.array([order.size]), order
