"""v is the arcus cosine of a height in float32, which has half of the digits next to the poles."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "poles"
MISTAKE = None


def sphere_uv(p, center):
    """With a mistake."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    d = p - np.asarray(center, p.dtype)[:, None]
    d = d / np.sqrt((d * d).sum(axis=0))
    u = np.arctan2(-d[2], d[0]) / (2 * np.pi)
    v = np.arccos(np.clip(-d[1], -1, 1)) / np.pi
    return np.stack((u + (u < 0), v)).astype(p.dtype)
