"""A small number is added to importance in the walk, so that no sum is 0."""

import numpy as np

FUNCTION = "tree_choice"
CAUGHT_BY = "faint"
MISTAKE = None


def tree_choice(tree, p, n, u):
    """With a mistake."""
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("u", u, np.shape(p)[1])
    dtype, order = np.result_type(p, n, u), tree[5]
    inner = len(order) - 1
    node, probability = np.zeros(len(u), int), np.ones(len(u))
    u = np.minimum(u.astype(np.float64), 1 - 2.0**-53)
    for level in reversed(range(inner.bit_length())):
        on = slice(None) if level else np.flatnonzero(node < inner)
        share = _share_of_some(tree, node[on], p[:, on], n[:, on])
        v = u[on]
        left = v < share
        taken = np.where(left, share, 1 - share)
        u[on] = np.minimum(np.where(left, v, v - share) / taken, 1 - 2.0**-53)
        probability[on] *= taken
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)


def _share_of_some(tree, node, p, n):
    parts, left = tree[:5], 2 * node + 1
    one, two = (
        importance(*(part.take(k, axis=-1) for part in parts), p, n) + 1e-10
        for k in (left, left + 1)
    )
    return (one / (one + two)).astype(np.float64)
