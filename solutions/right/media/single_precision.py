"""In the precision that comes in, as far as that goes."""

import numpy as np


def transmittance(sigma_t, distance):
    """A power of 1 / e."""
    _check_arrays(sigma_t=(sigma_t, 3), distance=(distance, "N"))
    _check_not_below_zero(sigma_t=sigma_t)
    sigma = np.asarray(sigma_t).astype(distance.dtype)[:, None]
    return np.exp(-sigma * distance)


def free_flight(sigma_t, weights, u):
    """Channels by np.searchsorted."""
    _check_arrays(sigma_t=(sigma_t, 3), weights=(weights, 3), u=(u, 2, "N"))
    _check_not_below_zero(sigma_t=sigma_t, weights=weights)
    channel = np.searchsorted(np.cumsum(weights), u[0], side="right").clip(0, 2)
    sigma = np.asarray(sigma_t).astype(u.dtype)[channel]
    result = np.full(u.shape[1], np.inf, u.dtype)
    np.divide(-np.log1p(-u[1]), sigma, out=result, where=sigma > 0)
    return result


def free_flight_pdf(sigma_t, weights, distance):
    """Columns of channels."""
    _check_arrays(sigma_t=(sigma_t, 3), weights=(weights, 3), distance=(distance, "N"))
    _check_not_below_zero(sigma_t=sigma_t, weights=weights)
    sigma = np.asarray(sigma_t).astype(distance.dtype)[:, None]
    share = np.asarray(weights).astype(distance.dtype)[:, None]
    return (share * sigma * np.exp(-sigma * distance)).sum(axis=0)


def henyey_greenstein(cos, g):
    """As the formula is written."""
    _check_arrays(cos=(cos, "N"))
    _check_g(g)
    g = cos.dtype.type(g)
    below = 1 + g * g - 2 * g * cos
    return (1 - g * g) / (cos.dtype.type(4 * np.pi) * below * np.sqrt(below))


def in_scattering(sigma_s, sigma_t, distance, beyond, phase, density):
    """Two exponentials."""
    _check_arrays(
        sigma_s=(sigma_s, 3),
        sigma_t=(sigma_t, 3),
        distance=(distance, "N"),
        beyond=(beyond, "N"),
        phase=(phase, "N"),
        density=(density, "N"),
    )
    _check_not_below_zero(sigma_s=sigma_s, sigma_t=sigma_t)
    dtype = np.result_type(distance, beyond, phase, density)
    extinction = np.asarray(sigma_t).astype(dtype)[:, None]
    left = np.exp(-extinction * distance) * np.exp(-extinction * beyond)
    return (np.asarray(sigma_s).astype(dtype)[:, None] * left * phase / density).astype(dtype)
