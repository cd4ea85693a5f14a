"""A basis from one helper axis, which is no help to normals along it."""

import numpy as np

FUNCTION = "diffuse_bounce"
CAUGHT_BY = "contract"
MISTAKE = "bounce-helper-axis"
SAYS = "The basis comes from one fixed axis, and there is none for normals along it."


def diffuse_bounce(normal, u):
    """With a mistake."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    helper = np.array([[0], [1], [0]], normal.dtype)
    s = np.cross(normal.T, helper.T).T
    s /= np.sqrt(np.einsum("ij,ij->j", s, s))
    t = np.cross(normal.T, s.T).T
    phi = u.dtype.type(2 * np.pi) * u[1]
    r = np.sqrt(u[0])
    return r * np.cos(phi) * s + r * np.sin(phi) * t + np.sqrt(1 - u[0]) * normal
