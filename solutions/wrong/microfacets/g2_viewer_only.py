"""You looked at the viewer alone: light is kept away, too."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "values"
MISTAKE = "no-shadowing"
SAYS = "You looked at the viewer alone: light is kept away, too."


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check(alpha, cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    o, i = (smith_g1(cos.astype(np.float64), alpha) for cos in (cos_o, cos_i))
    return np.where(i > 0, o, 0).astype(np.result_type(cos_o, cos_i))
