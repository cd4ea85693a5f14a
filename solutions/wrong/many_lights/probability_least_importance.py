"""A small number is added to importance in the product, so that no sum is 0."""

import numpy as np

FUNCTION = "tree_probability"
CAUGHT_BY = "faint"
MISTAKE = None


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
        share = _share_of_some(tree, parent, p[:, on], n[:, on])
        probability[on] *= np.where(node[on] % 2 == 1, share, 1 - share)
        node[on] = parent
    return probability.astype(np.result_type(p, n))


def _share_of_some(tree, node, p, n):
    parts, left = tree[:5], 2 * node + 1
    one, two = (
        importance(*(part.take(k, axis=-1) for part in parts), p, n) + 1e-10
        for k in (left, left + 1)
    )
    return (one / (one + two)).astype(np.float64)
