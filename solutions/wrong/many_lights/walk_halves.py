"""Your steps take both children alike, whatever they can send."""

import numpy as np

FUNCTION = "tree_choice"
CAUGHT_BY = "values"
MISTAKE = "children-alike"
SAYS = "Your steps take both children alike, whatever they can send."


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
        share = np.full(len(on), 0.5)
        v = u[on]
        left = v < share
        taken = np.full(len(v), 0.5)
        u[on] = np.minimum(np.where(left, v, v - share) / taken, 1 - 2.0**-53)
        probability[on] *= taken
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)
