"""The cosine itself."""

import numpy as np

FUNCTION = "cosine_hemisphere_pdf"
CAUGHT_BY = "values"
MISTAKE = "cosine-not-normalised"
SAYS = "Your density is the cosine itself, whose integral over the hemisphere is pi."


def cosine_hemisphere_pdf(cos):
    """With a mistake."""
    _check_numbers("cos", cos)
    return np.maximum(cos, 0)
