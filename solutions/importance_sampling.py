"""importance_sampling - random directions where the light is, and what an estimate gains by it.

An integral over the hemisphere is the mean of f / pdf over random directions, whatever density pdf they have where f
isn't zero. The closer pdf follows f, the less f / pdf varies, and the less noise the picture has: none at all if the
two are proportional. Directions are about the axis +z; cos is the cosine of the angle to it.
"""

import numpy as np


def uniform_hemisphere(u):
    """Directions of the hemisphere about +z, all equally probable: pdf 1 / (2 pi) [1/sr].

    Parameters
    ----------
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors with z >= 0, of the dtype of u

    Raises
    ------
    ValueError
        u has another shape.

    Task: importance_sampling.uniform_hemisphere.
    """
    _check_rows("u", u, 2)
    ### BEGIN SOLUTION
    # Archimedes: on a sphere the height is uniform.
    z = u[0]
    ring = np.sqrt((1 - z) * (1 + z))
    phi = 2 * np.pi * u[1]
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
    ### END SOLUTION


def cosine_hemisphere(u):
    """Directions of the hemisphere about +z, as probable as their cosine is large: pdf cos / pi [1/sr].

    Parameters
    ----------
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors with z >= 0, of the dtype of u

    Raises
    ------
    ValueError
        u has another shape.

    Task: importance_sampling.cosine_hemisphere. Source: Malley's method: points of the disk, lifted to the hemisphere.
    """
    _check_rows("u", u, 2)
    ### BEGIN SOLUTION
    r = np.sqrt(u[0])
    phi = 2 * np.pi * u[1]
    return np.stack((r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[0])))
    ### END SOLUTION


def cosine_hemisphere_pdf(cos):
    """The density of cosine_hemisphere: cos / pi, and 0 below the horizon.

    Parameters
    ----------
    cos : (N,) floating in [-1, 1]

    Returns
    -------
    (N,) [1/sr], of the dtype of cos

    Raises
    ------
    ValueError
        cos has another shape.

    Task: importance_sampling.cosine_hemisphere_pdf.
    """
    _check_numbers("cos", cos)
    ### BEGIN SOLUTION
    return np.maximum(cos, 0) / np.pi
    ### END SOLUTION


def phong_lobe_pdf(cos, exponent):
    """The density of a Phong lobe: (exponent + 1) / (2 pi) * cos^exponent, and 0 below the horizon.

    Parameters
    ----------
    cos : (N,) floating in [-1, 1]
        Of the angle to the lobe's axis.
    exponent : float >= 0
        0 is the uniform hemisphere, with 0^0 = 1 on the horizon itself.

    Returns
    -------
    (N,) [1/sr], of the dtype of cos

    Raises
    ------
    ValueError
        cos has another shape, or exponent is not >= 0.

    Task: importance_sampling.phong_lobe_pdf. Source: Lafortune and Willems, "Using the modified Phong reflectance
    model for physically based rendering", 1994.
    """
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    ### BEGIN SOLUTION
    exponent = float(exponent)
    lobe = (exponent + 1) / (2 * np.pi) * np.maximum(cos, 0) ** exponent
    return np.where(cos < 0, 0, lobe)
    ### END SOLUTION


def estimate(f, pdf):
    """The integral of f by random samples of density pdf, and the variance that the estimate has.

    Parameters
    ----------
    f : (N,) or (C, N) floating
        The integrand at each of N independent samples, in each of C channels.
    pdf : (N,) floating >= 0
        The density that the samples were drawn with, at each of them. Where it is 0, f must be 0 as well, and the
        sample counts 0.

    Returns
    -------
    mean : () or (C,)
        The mean of f / pdf: the estimate.
    variance : () or (C,)
        Of that mean, without bias: sum((f / pdf - mean)^2) / (N - 1) / N. A fourth of it is left with four times
        the samples; its square root is the error to be expected.
        Both of the dtype of f and pdf, or NumPy's promotion of the two. The mean of no samples is 0, and so is the
        variance of fewer than two.

    Raises
    ------
    ValueError
        f is neither (N,) nor (C, N), pdf is not (N,), pdf is negative, or 0 where f is not.

    Task: importance_sampling.estimate. Source: Kahn and Marshall, "Methods of reducing sample size in Monte Carlo
    computations", 1953.
    """
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_none_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
    ### BEGIN SOLUTION
    dtype = np.result_type(f, pdf)
    n = len(pdf)
    value = f / np.where(pdf == 0, 1, pdf).astype(np.float64)
    mean = value.sum(axis=-1) / max(n, 1)
    off = value - mean[..., None]
    variance = (off * off).sum(axis=-1) / max(n - 1, 1) / max(n, 1)
    return mean.astype(dtype), variance.astype(dtype)
    ### END SOLUTION


def power_heuristic(a, b):
    """Weight of a sample drawn with density a that could have been drawn with density b: a^2 / (a^2 + b^2).

    Parameters
    ----------
    a, b : (N,) floating >= 0

    Returns
    -------
    (N,) in [0, 1], of the dtype of a and b, or NumPy's promotion of the two
        0 where a is 0. With a and b the other way round the weights are what is left to 1, unless both are 0.

    Raises
    ------
    ValueError
        An argument has another shape, or is negative.

    Task: importance_sampling.power_heuristic. Source: Veach and Guibas, "Optimally combining sampling techniques for
    Monte Carlo rendering", 1995.
    """
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_none_negative("a", a)
    _check_none_negative("b", b)
    ### BEGIN SOLUTION
    a, b = a * a, b * b
    both = a + b
    return a / np.where(both > 0, both, 1)
    ### END SOLUTION


def _check_rows(name, array, rows):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows:
        raise ValueError(f"{name} must have shape ({rows}, N), got {shape}")


def _check_numbers(name, array, columns=None):
    shape = np.shape(array)
    if len(shape) != 1 or (columns is not None and shape[0] != columns):
        expected = f"({'N' if columns is None else columns},)"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_none_negative(name, array):
    if not (array >= 0).all():
        raise ValueError(f"{name} must be >= 0, got {array.min()}")
