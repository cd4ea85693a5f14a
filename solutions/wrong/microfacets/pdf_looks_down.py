"""Normals that look down have the density of those that look up."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "hidden"
MISTAKE = None


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    dtype, wo, wm = np.result_type(wo, wm), wo.astype(np.float64), wm.astype(np.float64)
    area = ggx(np.abs(wm[2]), alpha) * np.maximum((wo * wm).sum(axis=0), 0)
    return (smith_g1(wo[2], alpha) / wo[2] * area).astype(dtype)
