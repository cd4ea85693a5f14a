"""path_tracing - light that goes from wall to wall: colour bleeding, caustics, and rooms that light themselves.

A path is one ray that is followed from surface to surface. At each diffuse surface the lamps are looked for by shadow
rays, and the path goes on in a random direction with the share of the light that it will bring back, its throughput
beta. Many paths a pixel estimate the whole of the light, however often it was reflected.
"""

import numpy as np


def diffuse_bounce(normal, u):
    """Directions in which paths leave a diffuse surface, as probable as their cosine is large: pdf cos / pi [1/sr].

    Parameters
    ----------
    normal : (3, N) floating
        Unit vectors on the side that the light comes from.
    u : (2, N) floating in [0, 1)
        Which number drives what is free, and so is the turn about the normal.

    Returns
    -------
    (3, N) unit vectors, of the dtype of normal and u, or NumPy's promotion of the two
        dot(result, normal) >= 0, to rounding.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: path_tracing.diffuse_bounce. Source: Kajiya, "The rendering equation", 1986; Malley's method, by Shirley,
    "Physically based lighting calculations for computer graphics", 1991.
    """
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    # TODO path_tracing.diffuse_bounce: write your solution here
    raise NotImplementedError("path_tracing.diffuse_bounce: not written yet")


def throughput(beta, albedo):
    """The throughput of paths after a diffuse bounce, where diffuse_bounce has chosen the direction.

    The light of a direction counts f cos / pdf times: f = albedo / pi is the surface's reflectance distribution, cos
    the cosine between the direction and the normal, and pdf the density of the directions.

    Parameters
    ----------
    beta : (3, N) floating >= 0
        The throughput before the bounce, in each channel.
    albedo : (3, N) floating >= 0
        The share of the light that the surface returns.

    Returns
    -------
    (3, N), of the dtype of beta and albedo, or NumPy's promotion of the two

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: path_tracing.throughput. Source: Kajiya, "The rendering equation", 1986.
    """
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    # TODO path_tracing.throughput: write your solution here
    raise NotImplementedError("path_tracing.throughput: not written yet")


def russian_roulette(beta, u):
    """End paths that bring little by chance, and let the others stand for them: the mean stays what it was.

    A path survives with probability q, the largest channel of its beta, but 1 at most: where u < q.

    Parameters
    ----------
    beta : (3, N) floating >= 0
        Throughput, in each channel.
    u : (N,) floating in [0, 1)

    Returns
    -------
    survives : (N,) bool
    beta : (3, N), of the dtype of beta and u, or NumPy's promotion of the two
        beta / q where a path survives, and 0 where it ends. A path without throughput ends.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: path_tracing.russian_roulette. Source: Arvo and Kirk, "Particle transport and image synthesis", 1990.
    """
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    # TODO path_tracing.russian_roulette: write your solution here
    raise NotImplementedError("path_tracing.russian_roulette: not written yet")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_numbers(name, array, columns=None):
    shape = np.shape(array)
    if len(shape) != 1 or (columns is not None and shape[0] != columns):
        expected = f"({'N' if columns is None else columns},)"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")
