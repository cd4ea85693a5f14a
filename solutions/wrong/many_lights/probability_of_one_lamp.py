"""The only lamp of a tree has no step that leads to it, and no probability."""

FUNCTION = "tree_probability"
CAUGHT_BY = "sum"
MISTAKE = None

_right = tree_probability


def tree_probability(tree, p, n, lamp):
    """The product over the steps, where there are any."""
    probability = _right(tree, p, n, lamp)
    return probability * 0 if tree[5].size == 1 else probability
