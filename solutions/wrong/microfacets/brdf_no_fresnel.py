"""Fresnel's equations are left out: your metal is perfect."""

import numpy as np

FUNCTION = "brdf"
CAUGHT_BY = "values"
MISTAKE = "no-fresnel"
SAYS = "Fresnel's equations are left out: your metal is perfect."


def brdf(wo, wi, alpha, n, k):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wi=(wi, 3, "N"), n=(n, 3), k=(k, 3))
    dtype, wo, wi = np.result_type(wo, wi), wo.astype(np.float64), wi.astype(np.float64)
    above = (wo[2] > 0) & (wi[2] > 0)
    wm = (wo + wi) / np.maximum(np.linalg.norm(wo + wi, axis=0), 1e-30)
    share = ggx(wm[2], alpha) * smith_g2(wo[2], wi[2], alpha)
    share = share / np.where(above, 4 * wo[2] * wi[2], 1)
    return (share * np.ones((3, 1))).astype(dtype)
