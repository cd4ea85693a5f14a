"""Other ways to the same: a basis by cross products, angles by arctan, the lobe from its other end."""

import numpy as np


def sample_henyey_greenstein(direction, g, u):
    """The first number turned around, and a basis from the axis that is farthest."""
    _check_arrays(direction=(direction, 3, "N"), u=(u, 2, "N"))
    _check_g(g)
    dtype = np.result_type(direction, u)
    d, u = direction.astype(np.float64), u.astype(np.float64)
    if g == 0:
        cos = 1 - 2 * u[1]
    else:
        part = (1 - g**2) / (1 + g - 2 * g * u[1])
        cos = (1 + g**2 - part**2) / (2 * g)
    cos = np.clip(cos, -1, 1)
    axis = np.zeros_like(d)
    axis[np.abs(d).argmin(axis=0), np.arange(d.shape[1])] = 1
    a = np.cross(d, axis, axis=0)
    a /= np.linalg.norm(a, axis=0)
    b = np.cross(d, a, axis=0)
    sin, phi = np.sqrt(1 - cos**2), -2 * np.pi * u[0]
    way = sin * (np.cos(phi) * a + np.sin(phi) * b) + cos * d
    way = way / np.linalg.norm(way, axis=0)
    return way.astype(dtype), henyey_greenstein(cos, g).astype(dtype)


def equiangular(origin, direction, light, limit, u):
    """Angles by arctan of ratios, and the density from the distance itself."""
    _check_rays(origin, direction, limit, u, "N")
    _check_arrays(origin=(origin, 3, "N"), light=(light, 3, "N"))
    dtype = np.result_type(origin, direction, light, limit, u)
    o, d, p, end, u = (a.astype(np.float64) for a in (origin, direction, light, limit, u))
    foot = ((p - o) * d).sum(axis=0)
    side = np.sqrt((np.cross(p - o, d, axis=0) ** 2).sum(axis=0))
    side = np.where(side < 1e-6 * end, 1e-6 * end, side)
    first, last = np.arctan(-foot / side), np.arctan((end - foot) / side)
    t = np.tan(first + u * (last - first)) * side
    density = side / (side**2 + t**2) / (last - first)
    return np.minimum(np.maximum(foot + t, 0), end).astype(dtype), density.astype(dtype)
