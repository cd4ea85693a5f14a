"""You took the smaller of both: that is right only where both directions are one."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "values"
MISTAKE = "the-smaller"
SAYS = "You took the smaller of both: that is right only where both directions are one."


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check(alpha, cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    o, i = (smith_g1(cos.astype(np.float64), alpha) for cos in (cos_o, cos_i))
    return np.minimum(o, i).astype(np.result_type(cos_o, cos_i))
