"""Plain Python, one ray at a time."""

import math

import numpy as np


def transmittance(sigma_t, distance):
    """One number at a time."""
    _check_arrays(sigma_t=(sigma_t, 3), distance=(distance, "N"))
    _check_not_below_zero(sigma_t=sigma_t)
    result = np.empty((3, len(distance)), distance.dtype)
    for i in range(len(distance)):
        for k in range(3):
            result[k, i] = math.exp(-float(sigma_t[k]) * float(distance[i]))
    return result


def free_flight(sigma_t, weights, u):
    """The channel by subtraction of weights."""
    _check_arrays(sigma_t=(sigma_t, 3), weights=(weights, 3), u=(u, 2, "N"))
    _check_not_below_zero(sigma_t=sigma_t, weights=weights)
    result = np.empty(u.shape[1], u.dtype)
    for i in range(u.shape[1]):
        channel, rest = 0, float(u[0, i])
        while channel < 2 and rest >= weights[channel]:
            rest -= float(weights[channel])
            channel += 1
        sigma = float(sigma_t[channel])
        result[i] = -math.log(1 - float(u[1, i])) / sigma if sigma > 0 else math.inf
    return result


def free_flight_pdf(sigma_t, weights, distance):
    """A sum of three."""
    _check_arrays(sigma_t=(sigma_t, 3), weights=(weights, 3), distance=(distance, "N"))
    _check_not_below_zero(sigma_t=sigma_t, weights=weights)
    result = np.zeros(len(distance), distance.dtype)
    for i in range(len(distance)):
        found = 0.0
        for w, s in zip(weights, sigma_t, strict=True):
            found += float(w) * float(s) * math.exp(-float(s) * float(distance[i]))
        result[i] = found
    return result


def henyey_greenstein(cos, g):
    """As the formula is written."""
    _check_arrays(cos=(cos, "N"))
    _check_g(g)
    result = np.empty(len(cos), cos.dtype)
    for i in range(len(cos)):
        result[i] = (1 - g * g) / (4 * math.pi * (1 + g * g - 2 * g * float(cos[i])) ** 1.5)
    return result


def delta_tracking(grid, majorant, origin, direction, limit, u):
    """Each ray to its end."""
    _check_rays(origin, direction, limit, u, 2, "K", "N")
    _check_grid(grid, majorant)
    distance = np.zeros(len(limit), np.result_type(origin, direction, limit, u))
    collided = np.zeros(len(limit), bool)
    for i in range(len(limit)):
        t = 0.0
        for k in range(u.shape[1] if limit[i] > 0 else 0):
            t -= math.log(1 - float(u[0, k, i])) / majorant
            if t >= limit[i]:
                t = limit[i]
                break
            place = origin[:, i].astype(float) + t * direction[:, i]
            if u[1, k, i] < _density_at(grid, place[:, None])[0] / majorant:
                collided[i] = True
                break
        distance[i] = t
    return distance, collided


def ratio_tracking(grid, majorant, origin, direction, limit, u):
    """Each ray to its end."""
    _check_rays(origin, direction, limit, u, "K", "N")
    _check_grid(grid, majorant)
    dtype = np.result_type(origin, direction, limit, u)
    share, distance = np.ones(len(limit), dtype), np.zeros(len(limit), dtype)
    for i in range(len(limit)):
        t, left = 0.0, 1.0
        for k in range(len(u) if limit[i] > 0 else 0):
            t -= math.log(1 - float(u[k, i])) / majorant
            if t >= limit[i]:
                t = limit[i]
                break
            place = origin[:, i].astype(float) + t * direction[:, i]
            left *= 1 - _density_at(grid, place[:, None])[0] / majorant
        share[i], distance[i] = left, t
    return share, distance


def sample_henyey_greenstein(direction, g, u):
    """One direction after the other, turned about the light's way."""
    _check_arrays(direction=(direction, 3, "N"), u=(u, 2, "N"))
    _check_g(g)
    dtype = np.result_type(direction, u)
    ways, densities = np.empty(direction.shape, dtype), np.empty(u.shape[1], dtype)
    for i in range(u.shape[1]):
        d = direction[:, i].astype(float)
        xi = float(u[0, i])
        if abs(g) < 1e-5:
            cos = 2 * xi - 1
        else:
            inner = (1 - g * g) / (1 - g + 2 * g * xi)
            cos = min(max((1 + g * g - inner**2) / (2 * g), -1.0), 1.0)
        sin, turn = math.sqrt((1 - cos) * (1 + cos)), 2 * math.pi * float(u[1, i])
        # The axis that is farthest from the way, made perpendicular to it.
        axis = np.zeros(3)
        axis[np.argmin(np.abs(d))] = 1
        across = np.cross(d, axis)
        across /= np.linalg.norm(across)
        along = np.cross(d, across)
        way = cos * d + sin * (math.cos(turn) * across + math.sin(turn) * along)
        ways[:, i] = way / np.linalg.norm(way)
        densities[i] = (1 - g * g) / (4 * math.pi * (1 + g * g - 2 * g * cos) ** 1.5)
    return ways, densities


def equiangular(origin, direction, light, limit, u):
    """The angle at the lamp, ray by ray."""
    _check_rays(origin, direction, limit, u, "N")
    _check_arrays(origin=(origin, 3, "N"), light=(light, 3, "N"))
    dtype = np.result_type(origin, direction, light, limit, u)
    distances, densities = np.empty(len(limit), dtype), np.empty(len(limit), dtype)
    for i in range(len(limit)):
        way, end = direction[:, i].astype(float), float(limit[i])
        lamp = light[:, i].astype(float) - origin[:, i].astype(float)
        foot = float(np.dot(lamp, way))
        height = max(float(np.linalg.norm(lamp - foot * way)), 1e-6 * end)
        low, high = math.atan2(-foot, height), math.atan2(end - foot, height)
        angle = low + (high - low) * float(u[i])
        distances[i] = min(max(foot + height * math.tan(angle), 0.0), end)
        densities[i] = math.cos(angle) ** 2 / (height * (high - low))
    return distances, densities
