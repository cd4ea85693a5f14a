"""Without roughness directions come back as they came, in their own dtype."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def jitter_on_plane(direction, roughness, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    if roughness == 0:
        return direction.copy()
    a, b = float(roughness) * (u - 0.5)
    scale = 1 / np.sqrt(1 + a * a + b * b)
    return _in_basis(direction, a * scale, b * scale, scale)
