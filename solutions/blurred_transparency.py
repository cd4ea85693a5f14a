"""blurred_transparency - frosted glass: what is seen through a surface that is clear, but not smooth.

Light that enters glass is bent, and a part of it is reflected instead: all of it where it comes from the inside at
too flat an angle. Smooth glass bends each ray in one direction. Frosted glass sends it into a whole lobe around that
direction, so what is behind it is blurred, the more so the farther behind it is.
"""

import numpy as np


def refract(direction, normal, eta):
    """Directions of travel beyond the boundary of two clear media, by Snell's law: sin_t = eta sin_i.

    Parameters
    ----------
    direction : (3, N) floating
        Unit vectors, the rays' own direction of travel.
    normal : (3, N) floating
        Unit vectors on the incoming side: dot(direction, normal) <= 0.
    eta : float, or (N,) floating, 0.1 to 10
        n_from / n_to, the index of refraction on the incoming side over that on the far side. An array has one for
        each ray, and is a batch argument; a float holds for all and never changes the dtype.

    Returns
    -------
    directions : (3, N) unit vectors, of the dtype of the batch arguments, or NumPy's promotion of them
        In the plane of direction and normal, on the far side; for total internal reflection, the mirrored direction,
        direction - 2 dot(direction, normal) normal.
    total : (N,) bool
        Where there is total internal reflection: eta sin_i > 1. Within 1e-5 of 1 either is right.

    Raises
    ------
    ValueError
        An argument has another shape, or eta is not from 0.1 to 10.

    Task: blurred_transparency.refract. Source: Glassner, "An introduction to ray tracing", 1989.
    """
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    ### BEGIN SOLUTION
    eta = _of_the_batch(eta, direction, normal)
    cos_i = -np.einsum("ij,ij->j", direction, normal)
    # What lies in the surface has the length sin_i; bent, it has sin_t.
    along = direction + cos_i * normal
    cos_t_squared = 1 - eta * eta * np.einsum("ij,ij->j", along, along)
    total = cos_t_squared < 0
    cos_t = np.sqrt(np.where(total, 0, cos_t_squared))
    return np.where(total, 1, eta) * along + np.where(total, cos_i, -cos_t) * normal, total
    ### END SOLUTION


def jitter_refraction(direction, normal, roughness, u):
    """Jitter refracted directions by a square, as glossy reflection does, and keep them on the far side.

    A direction is normalise(direction + roughness * ((u0 - 1/2) a + (u1 - 1/2) b)), a and b from an orthonormal basis
    about direction; how the square is turned or mirrored about the direction is free. Those that came back to the
    incoming side are mirrored in the surface: d - 2 dot(d, n) n where dot(d, n) > 0.

    Parameters
    ----------
    direction : (3, N) floating
        Unit vectors, already refracted: dot(direction, normal) < 0.
    normal : (3, N) floating
        Unit vectors on the incoming side, those that `refract` got.
    roughness : float >= 0
        Side of the square, at distance 1. With 0 the result is direction, to within 4 units in the last place.
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors, of the dtype of direction, normal and u, or NumPy's promotion of them
        dot(result, normal) < 0; within 1e-6 of the surface either side is right.

    Raises
    ------
    ValueError
        An argument has another shape, or roughness is not >= 0.

    Task: blurred_transparency.jitter_refraction. Source: Cook, Porter and Carpenter, "Distributed ray tracing", 1984.
    """
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    ### BEGIN SOLUTION
    a, b = float(roughness) * (u - 0.5)
    # Pythagoras: a and b are measured at right angles to the direction, whose length is 1.
    scale = 1 / np.sqrt(1 + a * a + b * b)
    jittered = _in_basis(direction, a * scale, b * scale, scale)
    above = np.maximum(np.einsum("ij,ij->j", jittered, normal), 0)
    return jittered - (2 * above) * normal
    ### END SOLUTION


def fresnel(cos_i, eta):
    """The share of unpolarised light that the smooth boundary of two clear media reflects.

    Parameters
    ----------
    cos_i : (N,) floating, 0 to 1
        Cosine of the angle between the ray and the normal, -dot(direction, normal). What rounding has put beyond
        0 or 1 counts as 0 or 1.
    eta : float, or (N,) floating, 0.1 to 10
        n_from / n_to, as for `refract`.

    Returns
    -------
    (N,) in [0, 1], of the dtype of the batch arguments, or NumPy's promotion of them
        The mean of the two polarisations. 1 for total internal reflection, and at cos_i = 0 whatever eta is.

    Raises
    ------
    ValueError
        An argument has another shape, or eta is not from 0.1 to 10.

    Task: blurred_transparency.fresnel. Source: Born and Wolf, "Principles of optics", Fresnel's formulae.
    """
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    ### BEGIN SOLUTION
    eta = _of_the_batch(eta, cos_i)
    cos_i = np.clip(cos_i, 0, 1)
    # 1 - sin_t^2, in a form that keeps its digits at the critical angle.
    sin_t = eta * np.sqrt((1 - cos_i) * (1 + cos_i))
    cos_t_squared = (1 - sin_t) * (1 + sin_t)
    total = cos_t_squared <= 0
    cos_t = np.sqrt(np.where(total, 0, cos_t_squared))
    # Without a cos_t both formulae give 1, whatever cos_i is, but for 0 / 0.
    cos_i = np.where(total, 1, cos_i)
    across = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    within = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return 0.5 * (across * across + within * within)
    ### END SOLUTION


### BEGIN SOLUTION
def _of_the_batch(eta, *arrays):
    """The number, or each ray's, in the dtype of the batch."""
    if np.ndim(eta):
        arrays = (*arrays, eta)
    return np.asarray(eta, np.result_type(*arrays))


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


def _check_numbers(name, array, columns=None):
    shape = np.shape(array)
    if len(shape) != 1 or (columns is not None and shape[0] != columns):
        expected = f"({'N' if columns is None else columns},)"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_not_negative(name, number):
    if not number >= 0:
        raise ValueError(f"{name} must be >= 0, got {number}")


def _check_eta(eta, columns):
    shape = np.shape(eta)
    if shape not in ((), (columns,)):
        raise ValueError(f"eta must be a number or have shape ({columns},), got {shape}")
    wrong = ~((np.asarray(eta) >= 0.1) & (np.asarray(eta) <= 10))
    if wrong.any():
        raise ValueError(f"eta must be from 0.1 to 10, got {np.asarray(eta)[wrong][0]}")
