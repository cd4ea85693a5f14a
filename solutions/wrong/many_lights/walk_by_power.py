"""Your steps go by power alone: distance and normals do not count."""

import numpy as np

FUNCTION = "tree_choice"
CAUGHT_BY = "values"
MISTAKE = "steps-by-power"
SAYS = "Your steps go by power alone: distance and normals do not count."


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
        share = _left_share_wrong(tree, node[on], p[:, on], n[:, on])
        v = u[on]
        left = v < share
        taken = np.where(left, share, 1 - share)
        u[on] = np.minimum(np.where(left, v, v - share) / taken, 1 - 2.0**-53)
        probability[on] *= taken
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)


def _left_share_wrong(tree, node, p, n):
    """Probability of the left child, for walks that are at inner nodes."""
    parts, left = tree[:5], 2 * node + 1
    one, two = (parts[4][k] for k in (left, left + 1))
    both = one + two
    return np.where(both > 0, one / np.where(both > 0, both, 1), 0.5).astype(np.float64)
