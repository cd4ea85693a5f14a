"""That is the density of mirrored directions: that of normals has no 4 dot(wo, wm) below."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "values"
MISTAKE = "density-of-mirrored"
SAYS = "That is the density of mirrored directions: that of normals has no 4 dot(wo, wm) below."


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    dtype, wo, wm = np.result_type(wo, wm), wo.astype(np.float64), wm.astype(np.float64)
    area = ggx(wm[2], alpha) * np.maximum((wo * wm).sum(axis=0), 0)
    return (smith_g1(wo[2], alpha) / wo[2] * np.where(area > 0, ggx(wm[2], alpha), 0) / 4).astype(
        dtype
    )
