"""Numbers of its own in place of those given."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "not-by-its-column"


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    z, turn = np.random.default_rng().random((2, u.shape[1]))
    ring, phi = np.sqrt(1 - z * z), 2 * np.pi * turn
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), z)).astype(u.dtype)
