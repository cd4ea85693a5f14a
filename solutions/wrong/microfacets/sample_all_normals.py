"""You drew all normals of the surface by their area seen from above: which of them the viewer sees has no part in it."""

import numpy as np

FUNCTION = "sample_visible_normal"
CAUGHT_BY = "density"
MISTAKE = "all-normals"
SAYS = "You drew all normals of the surface by their area seen from above: which of them the viewer sees has no part in it."


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
    toward = np.sqrt(np.maximum(1 - a * a - b * b, 0))
    dome = np.stack((a, b, toward + 0 * z + 0 * across[0]))
    wm = stretch * np.maximum(dome, [[-1.0], [-1], [1e-12]])
    return (wm / np.linalg.norm(wm, axis=0)).astype(np.result_type(wo, u))
