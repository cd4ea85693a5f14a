"""You always take the more important child: the others never get a turn."""

import numpy as np

FUNCTION = "tree_choice"
CAUGHT_BY = "values"
MISTAKE = "more-important-child-always"
SAYS = "You always take the more important child: the others never get a turn."


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
        left = share >= 0.5
        taken = np.where(left, share, 1 - share)
        u[on] = np.minimum(v, 1 - 2.0**-53)
        probability[on] *= taken
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)
