"""The part beyond the top is squeezed by (1 + z) / 2, not by z."""

import numpy as np

FUNCTION = "sample_visible_normal"
CAUGHT_BY = "density"
MISTAKE = "squeezed-by-the-cosine"
SAYS = "The part beyond the top is squeezed by (1 + z) / 2, not by z."


def sample_visible_normal(wo, alpha, u):
    """With a mistake."""
    _check(alpha, wo=(wo, 3, "N"), u=(u, 2, "N"))
    stretch = np.array([[alpha], [alpha], [1.0]])
    view = stretch * wo / np.linalg.norm(stretch * wo, axis=0)
    ring = np.hypot(view[0], view[1])
    across = np.stack((-view[1], view[0], 0 * ring)) / np.maximum(ring, 1e-30)
    across[0] += ring < 1e-30
    r, phi, z = np.sqrt(u[0]), 2 * np.pi * u[1].astype(np.float64), view[2]
    a, b = r * np.cos(phi), r * np.sin(phi)
    b = (1 - z) * np.sqrt(1 - a * a) + z * b
    toward = np.sqrt(np.maximum(1 - a * a - b * b, 0))
    dome = a * across + b * np.cross(view, across, axis=0) + toward * view
    wm = stretch * np.maximum(dome, [[-1.0], [-1], [1e-12]])
    return (wm / np.linalg.norm(wm, axis=0)).astype(np.result_type(wo, u))
