"""A third has two digits."""

import numpy as np

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "order"
MISTAKE = None


def jitter_in_ball(direction, glossiness, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    a, b = orthonormal_basis(direction)
    z = 1 - 2 * u[1]
    length, ring, turn = glossiness * u[0] ** 0.33, np.sqrt(1 - z * z), 2 * np.pi * u[2]
    x, y = length * ring * np.cos(turn), length * ring * np.sin(turn)
    result = (1 + length * z) * direction + x * a + y * b
    result /= np.linalg.norm(result, axis=0)
    return result.astype(np.result_type(direction, u))
