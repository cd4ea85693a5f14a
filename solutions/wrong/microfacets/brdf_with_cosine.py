"""You multiplied by the cosine of the light: that belongs to the integral, not to the value."""

import numpy as np

FUNCTION = "brdf"
CAUGHT_BY = "reciprocal"
MISTAKE = "cosine-in-the-value"
SAYS = "You multiplied by the cosine of the light: that belongs to the integral, not to the value."


def brdf(wo, wi, alpha, n, k):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wi=(wi, 3, "N"), n=(n, 3), k=(k, 3))
    dtype, wo, wi = np.result_type(wo, wi), wo.astype(np.float64), wi.astype(np.float64)
    above = (wo[2] > 0) & (wi[2] > 0)
    wm = (wo + wi) / np.maximum(np.linalg.norm(wo + wi, axis=0), 1e-30)
    share = ggx(wm[2], alpha) * smith_g2(wo[2], wi[2], alpha)
    share = share / np.where(above, 4 * wo[2], 1)
    return (share * fresnel_complex((wo * wm).sum(axis=0), n, k)).astype(dtype)
