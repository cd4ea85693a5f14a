"""Other ways to the same: sums of unit vectors, cosines from the other end, distances sorted."""

import numpy as np


def emit_cone(axis, cos_edge, intensity, count, u):
    """The cosine by a mean of the two ends, and the turn the other way round."""
    _check_arrays(axis=(axis, 3), intensity=(intensity, 3), u=(u, 2, "N"))
    _check_at_least_one(count)
    if not -1 <= cos_edge < 1:
        raise ValueError(f"cos_edge must be >= -1 and < 1, got {cos_edge}")
    v = u.astype(np.float64)
    w = np.asarray(axis, np.float64)
    other = np.array([0.0, 1.0, 0.0]) if abs(w[0]) > 0.5 else np.array([1.0, 0.0, 0.0])
    a = other - (other @ w) * w
    a /= np.sqrt(a @ a)
    b = np.cross(w, a)
    cos = v[1] * 1.0 + (1 - v[1]) * cos_edge
    sin, phi = np.sqrt(np.clip((1 - cos) * (1 + cos), 0, None)), -2 * np.pi * v[0]
    way = np.outer(w, cos) + np.outer(a, sin * np.cos(phi)) + np.outer(b, sin * np.sin(phi))
    share = np.full(u.shape[1], (2 - 2 * cos_edge) * np.pi / count)
    return way.astype(u.dtype), np.outer(intensity, share).astype(u.dtype)


def emit_area(normal, radiance, area, count, u):
    """The normal plus a uniform direction, normalised: it has the density of the cosine."""
    _check_arrays(normal=(normal, 3, "N"), radiance=(radiance, 3), u=(u, 2, "N"))
    _check_at_least_one(count)
    if not 0 < area < np.inf:
        raise ValueError(f"area must be > 0, got {area}")
    dtype = np.result_type(normal, u)
    z, phi = 1 - 2 * u[0].astype(np.float64), 2 * np.pi * u[1].astype(np.float64)
    r = np.sqrt(np.maximum(1 - z * z, 0))
    # Uniform over the sphere; the normal as its pole, so that the other pole is where both add up to nothing.
    n = normal.astype(np.float64)
    side = np.where(np.abs(n[:1]) > 0.6, [[0.0], [0], [1]], [[1.0], [0], [0]])
    a = side - (side * n).sum(axis=0) * n
    a = a / np.linalg.norm(a, axis=0)
    b = np.cross(n.T, a.T).T
    around = np.cos(phi) * a + np.sin(phi) * b
    way = r * around + (1 + z) * n
    length = np.linalg.norm(way, axis=0)
    flat = length < 1e-9
    way = np.where(flat, around, way / np.where(flat, 1, length))
    power = np.ones((3, u.shape[1])) * np.reshape(radiance, (3, 1)) * (area * np.pi) / count
    return way.astype(dtype), power.astype(dtype)


def emit_directional(direction, irradiance, center, radius, count, u):
    """A point of the disk in the plane of x and y, carried there by a reflection."""
    _check_arrays(
        direction=(direction, 3), irradiance=(irradiance, 3), center=(center, 3), u=(u, 2, "N")
    )
    _check_at_least_one(count)
    if not 0 <= radius < np.inf:
        raise ValueError(f"radius must be finite and >= 0, got {radius}")
    w = np.asarray(direction, np.float64)
    pole = np.array([0.0, 0.0, -1.0 if w[2] > 0 else 1.0])
    across = (pole - w) / np.linalg.norm(pole - w)
    v = u.astype(np.float64)
    turn = np.exp(2j * np.pi * v[0]) * np.sqrt(v[1])
    flat = np.stack((turn.real, turn.imag, np.full(len(turn), -pole[2])))
    place = flat - 2 * np.outer(across, across @ flat)
    origin = radius * place + np.reshape(center, (3, 1))
    share = np.pi * radius * radius / count
    return origin.astype(u.dtype), np.full(
        place.shape, share * np.reshape(irradiance, (3, 1)), u.dtype
    )


def density_estimate(power, direction, distance, normal):
    """What comes from behind is set to nothing."""
    _check_arrays(
        power=(power, 3, "K", "N"),
        direction=(direction, 3, "K", "N"),
        distance=(distance, "K", "N"),
        normal=(normal, 3, "N"),
    )
    kept = np.array(power, np.float64)
    behind = (direction.astype(np.float64) * normal[:, None]).sum(axis=0) >= 0
    kept[:, behind] = 0
    farthest = np.sort(distance.astype(np.float64), axis=0)[-1]
    found = kept.sum(axis=1) / np.pi / farthest / farthest
    return found.astype(np.result_type(power, direction, distance, normal))
