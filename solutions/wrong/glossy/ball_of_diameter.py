"""Glossiness as the ball's diameter."""

import numpy as np

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "half-as-wide"
SAYS = "Your ball is half as wide: glossiness is its radius."


def jitter_in_ball(direction, glossiness, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    dtype = np.result_type(direction, u)
    z = 1 - 2 * u[0]
    ring = np.sqrt(np.maximum(1 - z * z, 0))
    phi = 2 * np.pi * u[1]
    point = np.cbrt(u[2]) * np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
    jittered = direction + glossiness / 2 * point
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
