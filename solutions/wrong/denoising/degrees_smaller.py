"""You take the smaller number of samples, less one: that is only the least that it can be."""

import numpy as np

FUNCTION = "degrees_of_freedom"
CAUGHT_BY = "values"
MISTAKE = "smaller-count"
SAYS = "You take the smaller number of samples, less one: that is only the least that it can be."


def degrees_of_freedom(variance_a, count_a, variance_b, count_b):
    """With a mistake."""
    _check("variance_a", variance_a, 3, "N")
    pixels = np.shape(variance_a)[1]
    _check("count_a", count_a, pixels)
    _check("variance_b", variance_b, 3, pixels)
    _check("count_b", count_b, pixels)
    a, b = variance_a / count_a, variance_b / count_b
    squares = a**2 / (count_a - 1) + b**2 / (count_b - 1)
    unknown = squares == 0
    degrees = np.where(unknown, count_a + count_b - 2, (a + b) ** 2 / np.where(unknown, 1, squares))
    degrees = np.where(unknown, degrees, np.minimum(count_a, count_b) - 1)
    return degrees.astype(_dtype(variance_a, count_a, variance_b, count_b))
