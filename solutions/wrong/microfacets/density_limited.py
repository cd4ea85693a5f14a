"""Densities end at ten thousand, against bright dots."""

import numpy as np

FUNCTION = "visible_normal_pdf"
CAUGHT_BY = "sharp"
MISTAKE = None

_right = visible_normal_pdf


def visible_normal_pdf(wo, wm, alpha):
    """With a mistake."""
    return np.minimum(_right(wo, wm, alpha), 10_000)
