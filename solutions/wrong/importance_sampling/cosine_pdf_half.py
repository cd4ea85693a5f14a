"""Over 2 pi."""

import numpy as np

FUNCTION = "cosine_hemisphere_pdf"
CAUGHT_BY = "values"
MISTAKE = "cosine-over-2-pi"
SAYS = "You divide by the hemisphere's solid angle; the integral of the cosine over it is half of that."


def cosine_hemisphere_pdf(cos):
    """With a mistake."""
    _check_numbers("cos", cos)
    return np.maximum(cos, 0) / cos.dtype.type(2 * np.pi)
