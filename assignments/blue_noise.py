"""blue_noise - where the error of a picture goes, at one to sixteen samples a pixel.

Neighbouring pixels that take their samples without knowing of each other have errors that are white noise: every
frequency has the same power. The eye averages over neighbours. If their samples complement each other, errors are as
large as before, but they alternate, and the eye averages them out: the power has moved to high frequencies, as in blue
noise. Here are two ways to get there, a curve through all pixels and a mask, and two ways to measure it.
"""

import numpy as np


def z_order(x, y):
    """Number of each pixel along Morton's curve, which goes through a square quadrant by quadrant.

    Parameters
    ----------
    x, y : (N,) integer in [0, 2^16)
        Column and row of each pixel.

    Returns
    -------
    (N,) integer in [0, 2^32)
        Bit k of x is bit 2k, and bit k of y is bit 2k + 1.

    Raises
    ------
    ValueError
        x or y has another shape, is not integer or is out of range.

    Task: blue_noise.z_order. Source: Morton, "A computer oriented geodetic data base", 1966.
    """
    _check_pixels(x, y, 1 << 16)
    # TODO blue_noise.z_order: write your solution here
    raise NotImplementedError("blue_noise.z_order: not written yet")


def shuffled_z_order(x, y, levels, seed):
    """Number of each pixel along a curve whose quadrants are shuffled: all four parts of each, on every level.

    A Z-order has a digit from 0 to 3 for each level, the highest for the largest quadrants. Here each digit is replaced
    by its image under a permutation of the four. Which one is hashed from the seed, the level and the digits of the
    Z-order above: all pixels in a quadrant have the same for its parts, those of two quadrants are independent, and
    each of the 24 is equally probable. ``chosen`` makes numbers for that; any other good hash does, too.

    Parameters
    ----------
    x, y : (N,) integer in [0, 2^levels)
        Column and row of each pixel.
    levels : int from 0 to 15
        The square has 2^levels pixels a side.
    seed : int in [0, 2^32)

    Returns
    -------
    (N,) integer in [0, 4^levels)

    Raises
    ------
    ValueError
        levels or seed is out of range, or x or y has another shape, is not integer or is out of range.

    Task: blue_noise.shuffled_z_order. Source: Ahmed and Wonka, "Screen-space blue-noise diffusion of Monte Carlo
    sampling error via hierarchical ordering of pixels", 2020.
    """
    if not 0 <= levels <= 15 or levels != int(levels):
        raise ValueError(f"levels must be an integer from 0 to 15, got {levels}")
    if not 0 <= seed < 1 << 32:
        raise ValueError(f"seed must be from 0 to 2^32 - 1, got {seed}")
    _check_pixels(x, y, 1 << levels)

    def chosen(level, above):
        """A number from 0 to 23 (N,) for each quadrant: its level, and its digits above that level as a number (N,)."""
        return _hashed(above, 32 * seed + level) % 24

    # TODO blue_noise.shuffled_z_order: write your solution here
    raise NotImplementedError("blue_noise.shuffled_z_order: not written yet")


def void_and_cluster(u, sigma):
    """Ranks of a mask: for every n, the pixels with ranks below n are spread evenly, the mask's edges joined.

    How crowded a place is tells the sum of exp(-d^2 / (2 sigma^2)) over all points, the one at the place itself among
    them; d^2 = dx^2 + dy^2, and dx and dy are the shortest distances on the torus, where column 0 is the right
    neighbour of the last one, and row 0 that of the last row below. The tightest cluster is the point at the most
    crowded place, the largest void the least crowded place without a point.

    1. The max(1, H W // 10) pixels with the smallest u have a point. Move the point of the tightest cluster to the
       largest void, which may be the place that it has just left; stop when it is no less crowded than that place.
    2. Take the point of the tightest cluster away, again and again: the last of all gets rank 0.
    3. From the pattern of step 1 on, fill the largest void, again and again: the last one gets rank H W - 1.

    Parameters
    ----------
    u : (H, W) floating
        Of two equal ones either is smaller.
    sigma : float > 0
        Width of a point [pixels]; 1.5 to 1.9 for masks.

    Returns
    -------
    (H, W) integer, each from 0 to H W - 1 once
        Of two places that are equally crowded either may be taken.

    Raises
    ------
    ValueError
        u has another shape or is empty, or sigma is out of range.

    Task: blue_noise.void_and_cluster. Source: Ulichney, "The void-and-cluster method for dither array generation",
    1993.
    """
    _check_picture("u", u)
    _check_sigma(sigma)
    # TODO blue_noise.void_and_cluster: write your solution here
    raise NotImplementedError("blue_noise.void_and_cluster: not written yet")


def dithered_points(points, masks, x, y):
    """One pattern of points for all pixels, moved by what a mask has for the pixel, modulo 1.

    Parameters
    ----------
    points : (2, s) floating in [0, 1)
        A pattern of s samples in two dimensions.
    masks : (2, H, W) integer, each of 0 to H W - 1 once
        Ranks for each dimension; the mask is repeated over the picture, beside itself and below.
    x, y : (N,) integer >= 0
        Column and row of each pixel.

    Returns
    -------
    (2, N, s) in [0, 1), or 1 by rounding alone, of the dtype of points
        Rank r moves a coordinate by (r + 1/2) / (H W): the middle of the part of [0, 1) that it stands for.

    Raises
    ------
    ValueError
        points or masks has another shape, or x or y has another shape, is not integer or is negative.

    Task: blue_noise.dithered_points. Source: Georgiev and Fajardo, "Blue-noise dithered sampling", 2016; moving by
    Cranley and Patterson, "Randomization of number theoretic methods for multiple integration", 1976.
    """
    if np.ndim(points) != 2 or len(points) != 2:
        raise ValueError(f"points must have shape (2, s), got {np.shape(points)}")
    if np.ndim(masks) != 3 or len(masks) != 2 or not np.size(masks):
        raise ValueError(f"masks must have shape (2, H, W), got {np.shape(masks)}")
    _check_pixels(x, y, 1 << 62)
    # TODO blue_noise.dithered_points: write your solution here
    raise NotImplementedError("blue_noise.dithered_points: not written yet")


def radial_spectrum(error, bins):
    """Power of an error over its frequency, averaged over all directions.

    The power of a frequency is |F|^2 / (H W), F being the discrete Fourier transform of the error. Its two coordinates
    are in cycles per pixel, from -1/2 to 1/2; its distance from 0 says in which bin it falls. Bin k has those above
    k / (2 bins) up to (k + 1) / (2 bins), the latter included. So the mean of the error, at 0, is in none, and neither
    are the corners beyond 1/2.

    Parameters
    ----------
    error : (H, W) floating
        Difference of a picture and a better one.
    bins : int from 1 to min(H, W) // 2

    Returns
    -------
    (bins,), of the dtype of error
        Means of the power. White noise of variance v has v in each.

    Raises
    ------
    ValueError
        error has another shape or is empty, or bins is out of range.

    Task: blue_noise.radial_spectrum. Source: Ulichney, "Dithering with blue noise", 1988.
    """
    _check_picture("error", error)
    if not 1 <= bins <= min(np.shape(error)) // 2 or bins != int(bins):
        raise ValueError(f"bins must be an integer from 1 to min(H, W) // 2, got {bins}")
    # TODO blue_noise.radial_spectrum: write your solution here
    raise NotImplementedError("blue_noise.radial_spectrum: not written yet")


def perceptual_rmse(error, sigma):
    """Root of the mean square of an error as it is seen from afar: blurred by a Gaussian before it is squared.

    Parameters
    ----------
    error : (H, W) floating
        Difference of a picture and a better one.
    sigma : float > 0
        Width of the blur [pixels]. A neighbour counts exp(-d^2 / (2 sigma^2)), d^2 = dx^2 + dy^2, over the sum of all
        weights; dx and dy are the shortest distances on the torus, on which the picture's edges are joined.

    Returns
    -------
    (), of the dtype of error

    Raises
    ------
    ValueError
        error has another shape or is empty, or sigma is out of range.

    Task: blue_noise.perceptual_rmse. Source: Chizhov, Georgiev, Myszkowski and Singh, "Perceptual error optimization
    for Monte Carlo rendering", 2022.
    """
    _check_picture("error", error)
    _check_sigma(sigma)
    # TODO blue_noise.perceptual_rmse: write your solution here
    raise NotImplementedError("blue_noise.perceptual_rmse: not written yet")


def _hashed(keys, seed):
    """Words (N,), int64 in [0, 2^31), that look random. They depend on keys (N,) and seed alone, all of them >= 0."""
    word = np.asarray(keys).astype(np.uint64) ^ np.uint64(seed * 0xD1342543DE82EF95 % 2**64)
    for shift in (32, 29, 31):
        word = (word ^ (word >> np.uint64(shift))) * np.uint64(0xD6E8FEB86659FD93)
    return (word >> np.uint64(33)).astype(np.int64)


def _check_pixels(x, y, end):
    for name, array in (("x", x), ("y", y)):
        if np.ndim(array) != 1 or np.shape(array) != np.shape(x):
            raise ValueError(
                f"{name} must have shape {np.shape(x) if name == 'y' else '(N,)'}, got {np.shape(array)}"
            )
        if getattr(array, "dtype", np.dtype(object)).kind not in "iu":
            raise ValueError(f"{name} must be an array of integers")
        if not ((array >= 0) & (array < end)).all():
            raise ValueError(f"{name} must be in [0, {end}), got {array.min()} to {array.max()}")


def _check_picture(name, array):
    if np.ndim(array) != 2 or not np.size(array):
        raise ValueError(f"{name} must have shape (H, W), got {np.shape(array)}")


def _check_sigma(sigma):
    if not 0 < sigma < np.inf:
        raise ValueError(f"sigma must be > 0, got {sigma}")
