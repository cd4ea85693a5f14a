"""1 / G1 is 1 + Lambda: the sum of two of them holds 1 twice."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "values"
MISTAKE = "one-too-many"
SAYS = "1 / G1 is 1 + Lambda: the sum of two of them holds 1 twice."


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check(alpha, cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    o, i = (smith_g1(cos.astype(np.float64), alpha) for cos in (cos_o, cos_i))
    seen = np.where(o + i > 0, o + i, 1)
    return (o * i / seen).astype(np.result_type(cos_o, cos_i))
