"""You multiply by the left child's share, also where the right one is taken."""

import numpy as np

FUNCTION = "tree_choice"
CAUGHT_BY = "probability"
MISTAKE = "share-of-the-left-child"
SAYS = "You multiply by the left child's share, also where the right one is taken."


def tree_choice(tree, p, n, u):
    """With a mistake."""
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("u", u, np.shape(p)[1])
    dtype, order = np.result_type(p, n, u), tree[5]
    inner = len(order) - 1
    node, probability = np.zeros(len(u), int), np.ones(len(u))
    u = u.astype(np.float64)
    for level in reversed(range(inner.bit_length())):
        on = slice(None) if level else np.flatnonzero(node < inner)
        share = _left_share(tree, node[on], p[:, on], n[:, on])
        v = u[on]
        left = v < share
        taken = np.where(left, share, 1 - share)
        u[on] = np.minimum(np.where(left, v, v - share) / taken, 1 - 2.0**-53)
        probability[on] *= share
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)
