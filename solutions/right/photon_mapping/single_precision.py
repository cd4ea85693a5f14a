"""In the precision that comes in, as far as that goes."""

import numpy as np


def emit_directional(direction, irradiance, center, radius, count, u):
    """A basis by cross products."""
    _check_arrays(
        direction=(direction, 3), irradiance=(irradiance, 3), center=(center, 3), u=(u, 2, "N")
    )
    _check_at_least_one(count)
    if not 0 <= radius < np.inf:
        raise ValueError(f"radius must be finite and >= 0, got {radius}")
    # The rows of the last factor: the way itself, and two that are at right angles to it.
    rows = np.linalg.svd(np.reshape(np.asarray(direction, np.float64), (1, 3)))[2]
    angle, reach = u[0] * u.dtype.type(2 * np.pi), np.sqrt(u.dtype.type(1) - u[1])
    places = np.array([reach * np.sin(angle), reach * np.cos(angle)]) * u.dtype.type(radius)
    result = np.einsum("kc,kn->cn", rows[1:], places)
    for c in range(3):
        result[c] += float(center[c]) - radius * float(direction[c])
    shared = [np.pi * float(e) * radius**2 / count for e in irradiance]
    return result.astype(u.dtype), np.array([shared] * u.shape[1], u.dtype).reshape(-1, 3).T.copy()


def roulette(power, albedo, u):
    """Everything in the dtype of the batch."""
    _check_arrays(power=(power, 3, "N"), albedo=(albedo, 3, "N"), u=(u, "N"))
    left = power * albedo
    rest = np.zeros(left.shape, np.result_type(left, u))
    most = np.max(left, axis=0)
    q = np.divide(most, power.max(axis=0), out=np.zeros_like(most), where=power.max(axis=0) > 0)
    survives = u < q
    np.divide(left, q, out=rest, where=survives)
    return survives, rest


def stored(matte, specular, diffuse):
    """By what it isn't."""
    _check_arrays(matte=(matte, "N"), specular=(specular, "N"), diffuse=(diffuse, "N"))
    straight = (specular == 0) & (diffuse == 0)
    indirect = np.logical_and(matte, ~straight)
    return np.logical_and(indirect, diffuse == 0), indirect


def cone_weights(distance, radius, k):
    """Masked."""
    _check_arrays(distance=(distance, "N"), radius=(radius, "N"))
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    share = distance / radius
    inside = share <= 1
    kind = share.dtype.type
    return inside * (1 - share / kind(k)) / (kind(np.pi * (1 - 2 / (3 * k))) * radius * radius)


def final_gather(albedo, seen, irradiance):
    """An einsum."""
    _check_arrays(
        albedo=(albedo, 3, "N"), seen=(seen, 3, "M", "N"), irradiance=(irradiance, 3, "M", "N")
    )
    total = np.einsum("cn,cmn,cmn->cn", albedo, seen, irradiance)
    return total / total.dtype.type(np.pi * seen.shape[1])


def shrunk_radius(radius, i, alpha):
    """One less the share that is lost."""
    _check_arrays(radius=(radius, "N"), i=(i, "N"))
    if not 0.001 <= alpha <= 1:
        raise ValueError(f"alpha must be from 0.001 to 1, got {alpha}")
    return radius * np.sqrt(1 - (1 - alpha) / (np.asarray(i) + 1.0)).astype(radius.dtype)
