"""After a step to the right the left share has to be taken off the number before it is stretched."""

import numpy as np

FUNCTION = "tree_choice"
CAUGHT_BY = "reuse"
MISTAKE = "share-not-taken-off"
SAYS = "After a step to the right the left share has to be taken off the number before it is stretched."


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
        u[on] = np.minimum(v / np.where(left, taken, 1), 1 - 2.0**-53)
        probability[on] *= taken
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)
