"""The other column's whole weight is taken off, in place of what it lacks."""

import numpy as np

FUNCTION = "alias_table"
CAUGHT_BY = "shares"
MISTAKE = "taken-off-too-much"
SAYS = "You took the other column's whole weight off, in place of what it lacks."


def alias_table(weights):
    """With a mistake."""
    _check_weights(weights, "(K,)", 1)
    count = len(weights)
    scaled = np.asarray(weights, np.float64)
    filled = (scaled / scaled.max() / (scaled / scaled.max()).mean()).tolist()
    probability, alias = [1.0] * count, list(range(count))
    small = [k for k in range(count) if filled[k] < 1]
    large = [k for k in range(count) if filled[k] >= 1]
    while small and large:
        poor, rich = small.pop(), large[-1]
        probability[poor], alias[poor] = filled[poor], rich
        filled[rich] -= filled[poor]
        if filled[rich] < 1:
            small.append(large.pop())
    for k in small:
        if weights[k] == 0:
            probability[k], alias[k] = 0.0, int(np.argmax(weights))
    return np.array(probability), np.array(alias)
