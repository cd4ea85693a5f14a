"""The product of two G1 takes them for independent: low microfacets are hidden from both directions."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "values"
MISTAKE = "uncorrelated"
SAYS = "The product of two G1 takes them for independent: low microfacets are hidden from both directions."


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check(alpha, cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    o, i = (smith_g1(cos.astype(np.float64), alpha) for cos in (cos_o, cos_i))
    return (o * i).astype(np.result_type(cos_o, cos_i))
