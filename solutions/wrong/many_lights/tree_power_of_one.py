"""The power of your nodes is that of the stronger child: it has to be the sum."""

import numpy as np

FUNCTION = "light_tree"
CAUGHT_BY = "sums"
MISTAKE = "power-of-one-child"
SAYS = "The power of your nodes is that of the stronger child: it has to be the sum."


def light_tree(lo, hi, axis, angle, power):
    """With a mistake."""
    _check("lo", lo, 3, "L")
    lamps = np.shape(lo)[1]
    if lamps == 0:
        raise ValueError("there must be at least one lamp, got none")
    _check("hi", hi, 3, lamps)
    _check("axis", axis, 3, lamps)
    _check("angle", angle, lamps)
    _check("power", power, lamps)
    dtype = np.result_type(lo, hi, axis, angle, power)
    inner = lamps - 1
    leaves = np.ones(inner + lamps, int)
    for k in reversed(range(inner)):
        leaves[k] = leaves[2 * k + 1] + leaves[2 * k + 2]
    middle, order = (lo + hi) / 2, np.empty(lamps, int)
    todo = [(0, np.arange(lamps))]
    while todo:
        k, own = todo.pop()
        if k >= inner:
            order[k - inner] = own[0]
            continue
        longest = np.ptp(middle[:, own], axis=1).argmax()
        own = own[middle[longest, own].argsort(kind="stable")]
        cut = leaves[2 * k + 1]
        todo += [(2 * k + 1, own[:cut]), (2 * k + 2, own[cut:])]
    places = np.concatenate((order[:1].repeat(inner), order))
    lo, hi, axis, angle, power = (
        x[..., places].astype(dtype) for x in (lo, hi, axis, angle, power)
    )
    for level in reversed(range(inner.bit_length())):
        k = np.arange(2**level - 1, min(2 ** (level + 1) - 1, inner))
        one, two = 2 * k + 1, 2 * k + 2
        lo[:, k] = np.minimum(lo[:, one], lo[:, two])
        hi[:, k] = np.maximum(hi[:, one], hi[:, two])
        axis[:, k], angle[k] = merge_cones(axis[:, one], angle[one], axis[:, two], angle[two])
        power[k] = np.maximum(power[one], power[two])
    return lo, hi, axis, angle, power, order
