"""glossy - reflections of surfaces that are no perfect mirrors.

A mirror sends each ray in one direction. Most surfaces are rough at a scale too small to see and send light into a
whole lobe around that direction, so what they reflect is blurred, the more so the farther away it is. Each ray takes
one random direction of the lobe; the average over a pixel's rays is the blur.
"""

import numpy as np


def orthonormal_basis(w):
    """Two unit vectors that make a right-handed orthonormal basis with each w: cross(u, v) = w.

    Parameters
    ----------
    w : (3, N) floating
        Unit vectors, any of them: the poles and their surroundings too.

    Returns
    -------
    u, v : (3, N) each, of the dtype of w

    Raises
    ------
    ValueError
        w has another shape.

    Task: glossy.orthonormal_basis. Source: Duff et al., "Building an orthonormal basis, revisited", 2017.
    """
    _check_batch("w", w, 3)
    ### BEGIN SOLUTION
    x, y, z = w
    # -1 below the equator: sign + z stays away from 0, which it would meet at one of the poles.
    sign = np.copysign(1.0, z)
    a = -1 / (sign + z)
    b = x * y * a
    return (
        np.stack((1 + sign * x * x * a, sign * b, -sign * x)),
        np.stack((b, sign + y * y * a, -y)),
    )
    ### END SOLUTION


def jitter_on_plane(direction, roughness, u):
    """Jitter directions by a square: normalise(direction + roughness * ((u0 - 1/2) a + (u1 - 1/2) b)).

    Parameters
    ----------
    direction : (3, N) floating
        Unit vectors; a and b are the orthonormal basis about each.
    roughness : float >= 0
        Side of the square, at distance 1. With 0 the result is direction, to within 4 units in the last place.
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors, of the dtype of direction and u, or NumPy's promotion of the two

    Raises
    ------
    ValueError
        An argument has another shape, or roughness is not >= 0.

    Task: glossy.jitter_on_plane. Source: Marschner and Shirley, "Fundamentals of computer graphics".
    """
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    ### BEGIN SOLUTION
    a, b = float(roughness) * (u - 0.5)
    # Pythagoras: a and b are measured at right angles to the direction, whose length is 1.
    scale = 1 / np.sqrt(1 + a * a + b * b)
    return _in_basis(direction, a * scale, b * scale, scale)
    ### END SOLUTION


def jitter_in_ball(direction, glossiness, u):
    """Jitter directions by a ball: normalise(direction + glossiness * a uniform point of the unit ball).

    Parameters
    ----------
    direction : (3, N) floating
        Unit vectors.
    glossiness : float in [0, 1)
        Radius of the ball, at distance 1. With 0 the result is direction, to within 4 units in the last place.
    u : (3, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors, of the dtype of direction and u, or NumPy's promotion of the two

    Raises
    ------
    ValueError
        An argument has another shape, or glossiness is not >= 0 and < 1.

    Task: glossy.jitter_in_ball.
    """
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    ### BEGIN SOLUTION
    # The volume inside radius r grows with r^3; on a sphere, the height is uniform.
    radius = _within_1(glossiness, u.dtype) * np.cbrt(u[2])
    ring = radius * (2 * np.sqrt(u[0] * (1 - u[0])))
    phi = 2 * np.pi * u[1]
    x, y, z = direction
    jittered = np.stack(
        (x + ring * np.cos(phi), y + ring * np.sin(phi), z + radius * (1 - 2 * u[0]))
    )
    jittered /= np.sqrt(np.einsum("ij,ij->j", jittered, jittered))
    return jittered
    ### END SOLUTION


def sample_phong_lobe(direction, exponent, u):
    """Importance-sample the lobe of Phong: density (exponent + 1) / (2 pi) * cos(alpha)^exponent [1/sr].

    Parameters
    ----------
    direction : (3, N) floating
        Unit vectors, the axis of each lobe; alpha is the angle to it.
    exponent : float >= 0
        0 is the uniform hemisphere; the larger, the closer to a mirror.
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors, of the dtype of direction and u, or NumPy's promotion of the two

    Raises
    ------
    ValueError
        An argument has another shape, or exponent is not >= 0.

    Task: glossy.sample_phong_lobe. Source: Lafortune and Willems, "Using the modified Phong reflectance model for
    physically based rendering", 1994.
    """
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    ### BEGIN SOLUTION
    # The share of the lobe within alpha is 1 - cos(alpha)^(exponent + 1). Solved for the logarithm of cos(alpha),
    # since the sines of a narrow lobe would drown in the rounding of 1 - cos^2.
    with np.errstate(divide="ignore"):  # u may have been rounded to 1, where cos(alpha) is 0
        log_cos = np.log1p(-u[0]) * (1 / (float(exponent) + 1))
    sin = np.sqrt(-np.expm1(2 * log_cos))
    phi = 2 * np.pi * u[1]
    return _in_basis(direction, sin * np.cos(phi), sin * np.sin(phi), np.exp(log_cos))
    ### END SOLUTION


def keep_above(direction, normal):
    """Mirror the directions that fell below the surface: d - 2 dot(d, n) n where dot(d, n) < 0.

    Parameters
    ----------
    direction, normal : (3, N) floating
        Unit vectors.

    Returns
    -------
    (3, N) unit vectors, of the dtype of direction and normal, or NumPy's promotion of the two
        The directions that were above come back as they were.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: glossy.keep_above.
    """
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    ### BEGIN SOLUTION
    below = np.minimum(np.einsum("ij,ij->j", direction, normal), 0)
    kept = normal * (-2 * below)
    kept += direction
    return kept
    ### END SOLUTION


### BEGIN SOLUTION
def _within_1(radius, dtype):
    """A radius < 1 that rounding does not make 1: a ball of radius 1 would reach the point that has no direction."""
    return min(float(radius), 1 - 4 * float(np.finfo(dtype).eps))


def _in_basis(w, a, b, c):
    """Take a u + b v + c w in the basis about w (Duff et al., 2017), without u and v ever being in memory."""
    x, y, z = w
    sign = np.copysign(1.0, z)
    sunk = sign * x * a + y * b
    rest = c - sunk / (sign + z)
    return np.stack((x * rest + a, y * rest + sign * b, c * z - sunk))


### END SOLUTION


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_not_negative(name, number):
    if not number >= 0:
        raise ValueError(f"{name} must be >= 0, got {number}")
