"""How slanted the viewer sees the microfacet is left out."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "values"
MISTAKE = "slant-left-out"
SAYS = "How slanted the viewer sees the microfacet is left out."


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    dtype, wo, wm = np.result_type(wo, wm), wo.astype(np.float64), wm.astype(np.float64)
    area = ggx(wm[2], alpha) * ((wo * wm).sum(axis=0) > 0)
    return (smith_g1(wo[2], alpha) / wo[2] * area).astype(dtype)
