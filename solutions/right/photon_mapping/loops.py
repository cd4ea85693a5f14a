"""Plain Python, one photon at a time."""

import math

import numpy as np


def emit_cone(axis, cos_edge, intensity, count, u):
    """Each direction turned about the axis."""
    _check_arrays(axis=(axis, 3), intensity=(intensity, 3), u=(u, 2, "N"))
    _check_at_least_one(count)
    if not -1 <= cos_edge < 1:
        raise ValueError(f"cos_edge must be >= -1 and < 1, got {cos_edge}")
    directions, powers = np.empty((3, u.shape[1]), u.dtype), np.empty((3, u.shape[1]), u.dtype)
    for i in range(u.shape[1]):
        directions[:, i] = _around(axis, cos_edge + (1 - cos_edge) * float(u[0, i]), float(u[1, i]))
        for c in range(3):
            powers[c, i] = float(intensity[c]) * 2 * math.pi * (1 - cos_edge) / count
    return directions, powers


def emit_area(normal, radiance, area, count, u):
    """By the root of the first number."""
    _check_arrays(normal=(normal, 3, "N"), radiance=(radiance, 3), u=(u, 2, "N"))
    _check_at_least_one(count)
    if not 0 < area < math.inf:
        raise ValueError(f"area must be > 0, got {area}")
    dtype = np.result_type(normal, u)
    directions, powers = np.empty((3, u.shape[1]), dtype), np.empty((3, u.shape[1]), dtype)
    for i in range(u.shape[1]):
        directions[:, i] = _around(normal[:, i], math.sqrt(1 - float(u[1, i])), float(u[0, i]))
        for c in range(3):
            powers[c, i] = math.pi * area * float(radiance[c]) / count
    return directions, powers


def roulette(power, albedo, u):
    """The largest of three numbers, twice."""
    _check_arrays(power=(power, 3, "N"), albedo=(albedo, 3, "N"), u=(u, "N"))
    survives = np.zeros(len(u), bool)
    rest = np.zeros(power.shape, np.result_type(power, albedo, u))
    for i in range(len(u)):
        before = max(float(p) for p in power[:, i])
        left = [float(p) * float(a) for p, a in zip(power[:, i], albedo[:, i], strict=True)]
        if before > 0 and float(u[i]) < max(left) / before:
            survives[i] = True
            rest[:, i] = [x * before / max(left) for x in left]
    return survives, rest


def stored(matte, specular, diffuse):
    """As the words say."""
    _check_arrays(matte=(matte, "N"), specular=(specular, "N"), diffuse=(diffuse, "N"))
    caustic, indirect = np.zeros(len(matte), bool), np.zeros(len(matte), bool)
    for i in range(len(matte)):
        if not matte[i]:
            continue
        if diffuse[i] == 0 and specular[i] >= 1:
            caustic[i] = True
        if diffuse[i] >= 1 or specular[i] >= 1:
            indirect[i] = True
    return caustic, indirect


def density_estimate(power, direction, distance, normal):
    """One photon after the other."""
    _check_arrays(
        power=(power, 3, "K", "N"),
        direction=(direction, 3, "K", "N"),
        distance=(distance, "K", "N"),
        normal=(normal, 3, "N"),
    )
    result = np.zeros(normal.shape, np.result_type(power, direction, distance, normal))
    for i in range(normal.shape[1]):
        total, reach = np.zeros(3), 0.0
        for k in range(len(distance)):
            reach = max(reach, float(distance[k, i]))
            if np.dot(direction[:, k, i].astype(float), normal[:, i].astype(float)) < 0:
                total += power[:, k, i]
        result[:, i] = total / (math.pi * reach * reach)
    return result


def cone_weights(distance, radius, k):
    """One height after the other."""
    _check_arrays(distance=(distance, "N"), radius=(radius, "N"))
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    result = np.zeros(len(distance), np.result_type(distance, radius))
    for i in range(len(distance)):
        d, r = float(distance[i]), float(radius[i])
        if d <= r:
            result[i] = 3 * (k * r - d) / (math.pi * r**3 * (3 * k - 2))
    return result


def final_gather(albedo, seen, irradiance):
    """Ray after ray."""
    _check_arrays(
        albedo=(albedo, 3, "N"), seen=(seen, 3, "M", "N"), irradiance=(irradiance, 3, "M", "N")
    )
    result = np.zeros(albedo.shape, np.result_type(albedo, seen, irradiance))
    rays = seen.shape[1]
    for i in range(albedo.shape[1]):
        for c in range(3):
            total = 0.0
            for m in range(rays):
                total += float(seen[c, m, i]) * float(irradiance[c, m, i])
            result[c, i] = float(albedo[c, i]) * total / (rays * math.pi)
    return result


def shrunk_radius(radius, i, alpha):
    """Areas, and then their roots."""
    _check_arrays(radius=(radius, "N"), i=(i, "N"))
    if not 0.001 <= alpha <= 1:
        raise ValueError(f"alpha must be from 0.001 to 1, got {alpha}")
    result = np.empty(len(radius), radius.dtype)
    for column in range(len(radius)):
        share = (float(i[column]) + alpha) / (float(i[column]) + 1)
        result[column] = float(radius[column]) * math.sqrt(share)
    return result


def _around(axis, cos, turn):
    axis = np.asarray(axis, float)
    side = np.zeros(3)
    side[np.argmin(np.abs(axis))] = 1
    across = np.cross(axis, side)
    across /= np.linalg.norm(across)
    sin, phi = math.sqrt(max(1 - cos * cos, 0.0)), 2 * math.pi * turn
    way = cos * axis + sin * (math.cos(phi) * across + math.sin(phi) * np.cross(axis, across))
    return way / np.linalg.norm(way)
