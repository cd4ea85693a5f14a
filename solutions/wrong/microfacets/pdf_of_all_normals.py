"""That is the density of all normals, D times their cosine."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "values"
MISTAKE = "density-of-all"
SAYS = "That is the density of all normals, D times their cosine."


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    dtype, wo, wm = np.result_type(wo, wm), wo.astype(np.float64), wm.astype(np.float64)
    area = ggx(wm[2], alpha) * np.maximum((wo * wm).sum(axis=0), 0)
    return np.where(area > 0, ggx(wm[2], alpha) * wm[2], 0).astype(dtype)
