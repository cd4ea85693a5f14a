"""supersampling - antialiasing by more than one sample a pixel.

A pixel shows the light of a small square of the picture. One ray sees one point of it; many rays, averaged, see the
square. Where the points lie decides whether the error shows as staircases, as noise, or hardly at all.

Points are (2, n, s): axis 0 is x and y within the pixel in [0, 1), then the n pixels, then the s samples of each.
"""

import numpy as np


def regular(k, n):
    """Centres of a k x k grid of cells, the same in each of n pixels.

    Parameters
    ----------
    k : int >= 1
        Cells along each side of the pixel.
    n : int >= 0
        Number of pixels.

    Returns
    -------
    (2, n, k * k) float32
        Cells row by row, x fastest.

    Raises
    ------
    ValueError
        k < 1 or n < 0.

    Task: supersampling.regular. Source: uniform supersampling (any graphics text).
    """
    _check_counts(k, n)
    ### BEGIN SOLUTION
    centre = (np.arange(k, dtype=np.float32) + 0.5) / np.float32(k)
    points = np.empty((2, n, k, k), np.float32)
    points[0] = centre[None, :]
    points[1] = centre[:, None]
    return points.reshape(2, n, k * k)
    ### END SOLUTION


def random(k, n, rng):
    """Independent uniform points, k * k of them in each of n pixels.

    Parameters
    ----------
    k : int >= 1
    n : int >= 0
    rng : numpy.random.Generator

    Returns
    -------
    (2, n, k * k) float32 in [0, 1), or 1 by rounding alone

    Raises
    ------
    ValueError
        k < 1 or n < 0.

    Task: supersampling.random.
    """
    _check_counts(k, n)
    ### BEGIN SOLUTION
    return rng.random((2, n, k * k), np.float32)
    ### END SOLUTION


def jittered(k, n, rng):
    """Stratified points: one uniform point in each cell of a k x k grid, in each of n pixels.

    Parameters
    ----------
    k : int >= 1
    n : int >= 0
    rng : numpy.random.Generator

    Returns
    -------
    (2, n, k * k) float32 in [0, 1), or 1 by rounding alone
        Cells row by row, x fastest. A point may be rounded to its cell's border.

    Raises
    ------
    ValueError
        k < 1 or n < 0.

    Task: supersampling.jittered. Source: Cook, "Stochastic sampling in computer graphics", 1986.
    """
    _check_counts(k, n)
    ### BEGIN SOLUTION
    points = rng.random((2, n, k, k), np.float32)
    cell = np.arange(k, dtype=np.float32)
    points[0] += cell[None, :]
    points[1] += cell[:, None]
    points /= np.float32(k)
    return points.reshape(2, n, k * k)
    ### END SOLUTION


def gaussian_weights(offsets, sigma=1 / 6):
    """Weights exp(-r^2 / (2 sigma^2)), r the distance from the pixel's centre.

    Parameters
    ----------
    offsets : (2, n, s) floating
        Where the samples lie in their pixels, in [0, 1).
    sigma : float > 0 [pixels]
        The default puts the pixel's edge at 3 sigma.

    Returns
    -------
    (n, s), of the dtype of offsets

    Raises
    ------
    ValueError
        sigma is not > 0, or offsets is not (2, n, s).

    Task: supersampling.gaussian_weights.
    """
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    ### BEGIN SOLUTION
    x, y = (offsets - 0.5) * (1 / float(sigma))
    return np.exp(-0.5 * (x * x + y * y))
    ### END SOLUTION


def resolve(radiance, weights):
    """The colour of each pixel: the weighted mean of its samples.

    Parameters
    ----------
    radiance : (3, n, s) floating
    weights : (n, s) floating

    Returns
    -------
    (3, n), of the dtype of the arguments, or NumPy's promotion of the two
        Where a pixel's weights sum to exactly zero, the plain mean; 0 where there are no samples.

    Raises
    ------
    ValueError
        radiance is not (3, n, s), or weights don't match it.

    Task: supersampling.resolve.
    """
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(
            f"weights must have shape {np.shape(radiance)[1:]}, got {np.shape(weights)}"
        )
    ### BEGIN SOLUTION
    dtype = np.result_type(radiance, weights)
    total = np.einsum("ns->n", weights, dtype=dtype)
    unweighted = total == 0
    if unweighted.any():
        weights = np.where(unweighted[:, None], 1, weights)
        total = np.where(unweighted, weights.shape[1], total)
    # Shares of 1, not weights: a narrow gaussian's weights are so small that products with them would vanish.
    return np.einsum("cns,ns->cn", radiance, weights / total[:, None], dtype=dtype)
    ### END SOLUTION


def _check_counts(k, n):
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
