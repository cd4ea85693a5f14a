"""The largest weight is kept above a millionth."""

import numpy as np

FUNCTION = "alias_table"
CAUGHT_BY = "faint"
MISTAKE = None


def alias_table(weights):
    """With a mistake."""
    _check_weights(weights, "(K,)", 1)
    count = len(weights)
    scaled = np.asarray(weights, np.float64)
    filled = (scaled / np.maximum(scaled.mean(), 1e-9)).tolist()
    probability, alias = [1.0] * count, list(range(count))
    small = [k for k in range(count) if filled[k] < 1]
    large = [k for k in range(count) if filled[k] >= 1]
    while small and large:
        poor, rich = small.pop(), large[-1]
        probability[poor], alias[poor] = filled[poor], rich
        filled[rich] -= 1 - filled[poor]
        if filled[rich] < 1:
            small.append(large.pop())
    for k in small:
        if weights[k] == 0:
            probability[k], alias[k] = 0.0, int(np.argmax(weights))
    return np.array(probability), np.array(alias)
