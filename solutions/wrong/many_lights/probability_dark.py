"""Where no child has importance your probability is 0: both are as probable there."""

import numpy as np

FUNCTION = "tree_probability"
CAUGHT_BY = "dark"
MISTAKE = "nothing-in-the-dark"
SAYS = "Where no child has importance your probability is 0: both are as probable there."


def tree_probability(tree, p, n, lamp):
    """With a mistake."""
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("lamp", lamp, np.shape(p)[1])
    order = tree[5]
    inner = len(order) - 1
    node, probability = inner + np.argsort(order)[lamp], np.ones(len(lamp))
    for _ in range(inner.bit_length()):
        on = np.flatnonzero(node > 0)
        parent = (node[on] - 1) // 2
        share = _left_share_wrong(tree, parent, p[:, on], n[:, on])
        probability[on] *= np.where(node[on] % 2 == 1, share, np.where(share > 0, 1 - share, 0))
        node[on] = parent
    return probability.astype(np.result_type(p, n))


def _left_share_wrong(tree, node, p, n):
    """Probability of the left child, for walks that are at inner nodes."""
    parts, left = tree[:5], 2 * node + 1
    one, two = (
        importance(*(part.take(k, axis=-1) for part in parts), p, n) for k in (left, left + 1)
    )
    both = one + two
    return np.where(both > 0, one / np.where(both > 0, both, 1), 0.0).astype(np.float64)
