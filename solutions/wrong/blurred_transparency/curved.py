"""The square is bent around the direction."""

import numpy as np

FUNCTION = "jitter_refraction"
CAUGHT_BY = "square"
MISTAKE = "refraction-curved-square"
SAYS = "The square is bent around the direction; it is flat, at distance 1."


def jitter_refraction(direction, normal, roughness, u):
    """Jitter by a square."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, normal, u)
    if roughness == 0:
        return direction.astype(dtype)
    w = direction.astype(float)
    helper = np.zeros_like(w)
    helper[np.abs(w).argmin(axis=0), np.arange(w.shape[1])] = 1
    a = np.cross(helper, w, axis=0)
    a /= np.linalg.norm(a, axis=0)
    b = np.cross(w, a, axis=0)
    x, y = np.tan(roughness * (u.astype(float) - 0.5))
    jittered = w + x * a + y * b
    jittered /= np.linalg.norm(jittered, axis=0)
    dot = (jittered * normal).sum(axis=0)
    kept = np.where(dot > 0, jittered - 2 * dot * normal, jittered)
    return kept.astype(dtype)
