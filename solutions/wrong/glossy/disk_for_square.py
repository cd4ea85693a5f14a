"""A disk of that diameter."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = "disk-for-square"
SAYS = "Your jitter fills a disk; here it is a square."


def jitter_on_plane(direction, roughness, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    a, b = orthonormal_basis(direction)
    r, phi = roughness / 2 * np.sqrt(u[0]), 2 * np.pi * u[1]
    jittered = direction + r * np.cos(phi) * a + r * np.sin(phi) * b
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
