"""Masking is missing: the density is too large, the more the flatter the view."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "values"
MISTAKE = "not-masked"
SAYS = "Masking is missing: the density is too large, the more the flatter the view."


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    dtype, wo, wm = np.result_type(wo, wm), wo.astype(np.float64), wm.astype(np.float64)
    area = ggx(wm[2], alpha) * np.maximum((wo * wm).sum(axis=0), 0)
    return (1 / wo[2] * area).astype(dtype)
