"""denoising - the mean over neighbours that may have the same radiance, by Welch's test.

A pixel is known by the mean m, the sample variance s^2 and the number n of its samples. The samples of a pixel vary by
s^2, its mean by v = s^2 / n. Two pixels whose means differ by no more than that explains are averaged. The mean over
them is less noisy, and biased where they were not equal after all.
"""

import numpy as np


def welch_t(mean_a, variance_a, count_a, mean_b, variance_b, count_b):
    """Welch's statistic: the difference of two means in standard errors.

    Parameters
    ----------
    mean_a, mean_b : (3, N) floating [radiance]
    variance_a, variance_b : (3, N) floating >= 0 [radiance^2]
        Sample variances s^2, with n - 1 in the denominator.
    count_a, count_b : (N,) floating, whole numbers >= 2
        Samples of each pixel.

    Returns
    -------
    (3, N), of the dtype of the arguments, or NumPy's promotion of them
        (m_a - m_b) / sqrt(s_a^2 / n_a + s_b^2 / n_b). Where both variances are 0: 0 for equal means, and else an
        infinity with the sign of the difference.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: denoising.welch_t. Source: Welch, "The generalization of Student's problem when several different population
    variances are involved", 1947.
    """
    _check("mean_a", mean_a, 3, "N")
    pixels = np.shape(mean_a)[1]
    _check("variance_a", variance_a, 3, pixels)
    _check("count_a", count_a, pixels)
    _check("mean_b", mean_b, 3, pixels)
    _check("variance_b", variance_b, 3, pixels)
    _check("count_b", count_b, pixels)
    # TODO denoising.welch_t: write your solution here
    raise NotImplementedError("denoising.welch_t: not written yet")


def degrees_of_freedom(variance_a, count_a, variance_b, count_b):
    """Degrees of freedom of Welch's statistic, by Welch and Satterthwaite.

    Parameters
    ----------
    variance_a, variance_b : (3, N) floating >= 0 [radiance^2]
        Sample variances s^2.
    count_a, count_b : (N,) floating, whole numbers >= 2

    Returns
    -------
    (3, N), of the dtype of the arguments, or NumPy's promotion of them
        (v_a + v_b)^2 / (v_a^2 / (n_a - 1) + v_b^2 / (n_b - 1)) with v = s^2 / n. Where both variances are 0:
        n_a + n_b - 2.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: denoising.degrees_of_freedom. Source: Satterthwaite, "An approximate distribution of estimates of variance
    components", 1946.
    """
    _check("variance_a", variance_a, 3, "N")
    pixels = np.shape(variance_a)[1]
    _check("count_a", count_a, pixels)
    _check("variance_b", variance_b, 3, pixels)
    _check("count_b", count_b, pixels)
    # TODO denoising.degrees_of_freedom: write your solution here
    raise NotImplementedError("denoising.degrees_of_freedom: not written yet")


def critical_value(degrees, level):
    """What the magnitude of Student's t exceeds with the probability ``level``.

    Any method of NumPy and Python's own library will do that is within 0.5 % of the exact value for levels from 0.001
    to 0.5.

    Parameters
    ----------
    degrees : (N,) floating >= 1
        Degrees of freedom, not necessarily whole.
    level : float, 0 < level < 1
        Probability that the test separates two equal pixels.

    Returns
    -------
    (N,), of the dtype of degrees

    Raises
    ------
    ValueError
        degrees has another shape, or level is out of range.

    Task: denoising.critical_value. Source: Student, "The probable error of a mean", 1908.
    """
    _check("degrees", degrees, "N")
    if not 0 < level < 1:
        raise ValueError(f"level must be > 0 and < 1, got {level}")
    # TODO denoising.critical_value: write your solution here
    raise NotImplementedError("denoising.critical_value: not written yet")


def pair_weights(t, critical, distance, sigma):
    """Weights of pairs of pixels: a Gaussian of their distance where no channel separates them, and else 0.

    Parameters
    ----------
    t : (3, N) floating, infinite ones included
        Welch's statistics.
    critical : (3, N) floating > 0
        Their critical values. A channel separates two pixels if the magnitude of t is over it.
    distance : (N,) floating >= 0 [pixels]
        Between the two pixels.
    sigma : float > 0 [pixels]

    Returns
    -------
    (N,) from 0 to 1, of the dtype of the arguments, or NumPy's promotion of them
        exp(-distance^2 / (2 sigma^2)), or 0.

    Raises
    ------
    ValueError
        An argument has another shape, or sigma isn't over 0.

    Task: denoising.pair_weights. Source: Sakai et al., "A statistical approach to Monte Carlo denoising", 2024.
    """
    _check("t", t, 3, "N")
    pixels = np.shape(t)[1]
    _check("critical", critical, 3, pixels)
    _check("distance", distance, pixels)
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    # TODO denoising.pair_weights: write your solution here
    raise NotImplementedError("denoising.pair_weights: not written yet")


def weighted_mean(means, variances, weights):
    """Weighted means over neighbours, and their variances.

    Parameters
    ----------
    means : (3, N, k) floating [radiance]
        Means of the k neighbours of N pixels, each pixel itself among them.
    variances : (3, N, k) floating >= 0 [radiance^2]
        Of these means: s^2 / n. They are independent of each other.
    weights : (N, k) floating >= 0, in each row not all 0

    Returns
    -------
    mean : (3, N), of the dtype of the arguments, or NumPy's promotion of them
        The weights of a pixel, divided by their sum, times the means.
    variance : (3, N), of the same dtype
        Of this mean, as if the weights did not depend on the samples.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: denoising.weighted_mean.
    """
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    # TODO denoising.weighted_mean: write your solution here
    raise NotImplementedError("denoising.weighted_mean: not written yet")


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """Estimate of the squared bias: how much farther a pixel was moved than noise explains.

    The difference d of the filtered and the unfiltered mean has the variance v_f + v - 2 share v, for the two have the
    pixel's own samples in common. So the expected value of d^2, less that, is the squared bias.

    Parameters
    ----------
    filtered, filtered_variance : (3, N) floating
        As ``weighted_mean`` returns them [radiance], [radiance^2].
    mean, variance : (3, N) floating
        Of the pixels before: m and s^2 / n.
    share : (N,) floating from 0 to 1
        Of its own mean in each filtered pixel: its weight by the sum of the weights.

    Returns
    -------
    (3, N) [radiance^2], of the dtype of the arguments, or NumPy's promotion of them
        Negative where a pixel was moved by less than expected: only the mean over many pixels tells.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: denoising.squared_bias. Source: Stein, "Estimation of the mean of a multivariate normal distribution", 1981.
    """
    _check("filtered", filtered, 3, "N")
    pixels = np.shape(filtered)[1]
    _check("filtered_variance", filtered_variance, 3, pixels)
    _check("mean", mean, 3, pixels)
    _check("variance", variance, 3, pixels)
    _check("share", share, pixels)
    # TODO denoising.squared_bias: write your solution here
    raise NotImplementedError("denoising.squared_bias: not written yet")


def _check(name, array, *sizes):
    """The array has the shape; a letter stands for any size."""
    shape = np.shape(array)
    if len(shape) != len(sizes) or any(
        isinstance(size, int) and own != size for own, size in zip(shape, sizes, strict=False)
    ):
        expected = ", ".join(map(str, sizes)) + ("," if len(sizes) == 1 else "")
        raise ValueError(f"{name} must have shape ({expected}), got {shape}")
