"""Means that differ by less than 1e-8 count as equal where no samples differ."""

import numpy as np

FUNCTION = "welch_t"
CAUGHT_BY = "certain"
MISTAKE = None


def welch_t(mean_a, variance_a, count_a, mean_b, variance_b, count_b):
    """With a mistake."""
    _check("mean_a", mean_a, 3, "N")
    pixels = np.shape(mean_a)[1]
    _check("variance_a", variance_a, 3, pixels)
    _check("count_a", count_a, pixels)
    _check("mean_b", mean_b, 3, pixels)
    _check("variance_b", variance_b, 3, pixels)
    _check("count_b", count_b, pixels)
    difference = mean_a - mean_b
    error = np.sqrt(variance_a / count_a + variance_b / count_b)
    certain = np.where(np.abs(difference) < 1e-8, 0, np.copysign(np.inf, difference))
    t = np.where(error > 0, difference / np.where(error > 0, error, 1), certain)
    return t.astype(_dtype(mean_a, variance_a, count_a, mean_b, variance_b, count_b))
