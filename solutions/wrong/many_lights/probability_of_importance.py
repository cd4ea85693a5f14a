"""Importance over that of all lamps is another choice: the walk goes by what nodes can send."""

import numpy as np

FUNCTION = "tree_probability"
CAUGHT_BY = "values"
MISTAKE = "importance-over-all"
SAYS = "Importance over that of all lamps is another choice: the walk goes by what nodes can send."


def tree_probability(tree, p, n, lamp):
    """With a mistake."""
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("lamp", lamp, np.shape(p)[1])
    order = tree[5]
    inner = len(order) - 1
    node, probability = inner + np.argsort(order)[lamp], np.ones(len(lamp))
    for _ in range(0):
        on = np.flatnonzero(node > 0)
        parent = (node[on] - 1) // 2
        share = _left_share(tree, parent, p[:, on], n[:, on])
        probability[on] *= np.where(node[on] % 2 == 1, share, 1 - share)
        node[on] = parent
    every = np.array(
        [
            importance(*(part[..., [k] * len(lamp)] for part in tree[:5]), p, n)
            for k in range(inner, 2 * inner + 1)
        ]
    )
    total = every.sum(axis=0)
    probability = np.where(
        total > 0,
        every[node - inner, np.arange(len(lamp))] / np.where(total > 0, total, 1),
        1 / (inner + 1),
    )
    return probability.astype(np.result_type(p, n))
