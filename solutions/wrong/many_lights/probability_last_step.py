"""Your probability is that of one step: go on up to the root."""

import numpy as np

FUNCTION = "tree_probability"
CAUGHT_BY = "values"
MISTAKE = "last-step-alone"
SAYS = "Your probability is that of one step: go on up to the root."


def tree_probability(tree, p, n, lamp):
    """With a mistake."""
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("lamp", lamp, np.shape(p)[1])
    order = tree[5]
    inner = len(order) - 1
    node, probability = inner + np.argsort(order)[lamp], np.ones(len(lamp))
    for _ in range(min(inner, 1)):
        on = np.flatnonzero(node > 0)
        parent = (node[on] - 1) // 2
        share = _left_share(tree, parent, p[:, on], n[:, on])
        probability[on] *= np.where(node[on] % 2 == 1, share, 1 - share)
        node[on] = parent
    return probability.astype(np.result_type(p, n))
