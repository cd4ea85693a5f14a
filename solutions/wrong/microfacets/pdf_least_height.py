"""The view is kept a thousandth above the surface."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "grazing"
MISTAKE = None


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    dtype, wo, wm = np.result_type(wo, wm), wo.astype(np.float64), wm.astype(np.float64)
    area = ggx(wm[2], alpha) * np.maximum((wo * wm).sum(axis=0), 0)
    return (smith_g1(wo[2], alpha) / np.maximum(wo[2], 1e-3) * area).astype(dtype)
