"""multiple_importance - one integral by several strategies of sampling, each where it is good.

A small lamp is met best by points on the lamp, a sharp lobe by directions of the lobe. Samples of both are combined by
weights that add up to 1 and look at the densities of all strategies, in the same measure: solid angle.
"""

import numpy as np


def area_density(area, distance, cos):
    """Density over directions of points that are uniform over a flat lamp: distance^2 / (area cos).

    Parameters
    ----------
    area : float > 0 [m^2]
    distance : (N,) floating > 0 [m], from the shading point to the point on the lamp
    cos : (N,) floating in [-1, 1], between the lamp's normal and the direction from the lamp to the shading point

    Returns
    -------
    (N,) [1/sr], of the dtype of distance and cos, or NumPy's promotion of the two
        0 where cos <= 0: the lamp's back sends nothing.

    Raises
    ------
    ValueError
        An argument has another shape, or area is not > 0.

    Task: multiple_importance.area_density. Source: Shirley, Wang and Zimmerman, "Monte Carlo techniques for direct
    lighting calculations", 1996.
    """
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    ### BEGIN SOLUTION
    faces = cos > 0
    # Divided before it is squared: the square of a distance may overflow, and that of a short one underflow.
    seen = distance / distance.dtype.type(np.sqrt(area))
    return np.where(faces, seen * seen / np.where(faces, cos, 1), 0)
    ### END SOLUTION


def cone_density(radius, distance):
    """Density of directions that are uniform over the cone that a spherical lamp fills: 1 / (2 pi (1 - cos)).

    The sine of the angle between the cone's axis and its rim is radius / distance, and cos its cosine. For a small lamp
    far away cos is rounded to 1.

    Parameters
    ----------
    radius : float > 0 [m]
    distance : (N,) floating >= 0 [m], from the shading point to the lamp's centre

    Returns
    -------
    (N,) [1/sr], of the dtype of distance
        0 where distance <= radius: the lamp shines outwards.

    Raises
    ------
    ValueError
        distance has another shape, or radius is not > 0.

    Task: multiple_importance.cone_density. Source: Shirley, Wang and Zimmerman, 1996.
    """
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    ### BEGIN SOLUTION
    beyond = distance > radius
    sine = float(radius) / np.where(beyond, distance, np.inf).astype(np.float64)
    # 1 - cos is sin^2 / (1 + cos), in which no digits are lost.
    found = (1 + np.sqrt(1 - sine * sine)) / (2 * np.pi) / np.where(beyond, sine, 1) ** 2
    return np.where(beyond, found, 0).astype(distance.dtype)
    ### END SOLUTION


def heuristic_weights(counts, densities, exponent):
    """Weights of each strategy for each sample: (n_s p_s)^exponent / sum_k (n_k p_k)^exponent.

    Exponent 1 is the balance heuristic. With 2, the power heuristic, the densest strategy gets more.

    Parameters
    ----------
    counts : (S,) whole >= 0, samples that each of S strategies takes
    densities : (S, N) floating >= 0, of each strategy, at each of N samples, whichever strategy has drawn it
    exponent : float >= 1

    Returns
    -------
    (S, N) in [0, 1], of the dtype of densities
        Of any exponent and of densities of any size. 0 where no strategy draws a sample.

    Raises
    ------
    ValueError
        An argument has another shape, or is negative, or exponent is not >= 1.

    Task: multiple_importance.heuristic_weights. Source: Veach and Guibas, "Optimally combining sampling techniques for
    Monte Carlo rendering", 1995.
    """
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    ### BEGIN SOLUTION
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    # Over the largest, so that powers neither overflow nor vanish all.
    largest = drawn.max(axis=0)
    power = (drawn / np.where(largest > 0, largest, 1)) ** float(exponent)
    return (power / np.where(largest > 0, power.sum(axis=0), 1)).astype(densities.dtype)
    ### END SOLUTION


def delta_weights(counts, densities, delta):
    """Balance weights where some strategies draw a sample with a probability, and not with a density.

    A mirror has one direction, and a point light one place. What they draw, a density meets with probability 0: where
    any strategy is a delta, deltas share the weight, by counts times probabilities, and densities get 0.

    Parameters
    ----------
    counts : (S,) whole >= 0
    densities : (S, N) floating >= 0, as for heuristic_weights; where delta is true, the probability of the sample
    delta : (S, N) bool, whether a strategy draws this sample with a probability
        A delta whose probability or count is 0 does not draw the sample, and takes nothing from the others.

    Returns
    -------
    (S, N) in [0, 1], of the dtype of densities
        0 where no strategy draws a sample.

    Raises
    ------
    ValueError
        An argument has another shape, or is negative.

    Task: multiple_importance.delta_weights. Source: Veach, "Robust Monte Carlo methods for light transport simulation",
    1997.
    """
    _check_strategies("counts", counts, densities)
    _check("delta", delta, *np.shape(densities))
    ### BEGIN SOLUTION
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    certain = delta & (drawn > 0)
    drawn = np.where(certain.any(axis=0) & ~certain, 0, drawn)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 0, total, 1)).astype(densities.dtype)
    ### END SOLUTION


def multi_sample(counts, strategy, f, densities, weights):
    """The multi-sample estimator: the sum over all samples of w f / (n p), of the strategy that has drawn each.

    Parameters
    ----------
    counts : (S,) whole > 0, samples of each strategy
    strategy : (N,) whole from 0 to S - 1, which has drawn each of the N samples
    f : (3, N) floating, the integrand at each sample
    densities, weights : (N,) floating >= 0, p and w of the sample's own strategy
        A density may be as small as it likes; with density 0 a sample counts 0.

    Returns
    -------
    (3,), of the dtype of f, densities and weights, or NumPy's promotion of them

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: multiple_importance.multi_sample. Source: Veach and Guibas, 1995.
    """
    _check("counts", counts, "S")
    _check("f", f, 3, "N")
    for name, each in (("strategy", strategy), ("densities", densities), ("weights", weights)):
        _check(name, each, np.shape(f)[1])
    ### BEGIN SOLUTION
    drawn = np.asarray(counts)[strategy] * np.asarray(densities, np.float64)
    share = np.where(drawn > 0, weights, 0) / np.where(drawn > 0, drawn, 1)
    return (f @ share).astype(np.result_type(f, densities, weights))
    ### END SOLUTION


def one_sample(odds, f, densities):
    """The one-sample form, by balance weights: f / sum_k (c_k p_k), where chance has chosen the strategy.

    Parameters
    ----------
    odds : (S,) floating >= 0, the probability c_k of each strategy; they add up to 1
    f : (3, N) floating, the integrand at each of N samples
    densities : (S, N) floating >= 0, of each strategy, at each sample, whichever strategy has drawn it

    Returns
    -------
    (3, N), of the dtype of f and densities, or NumPy's promotion of the two
        N estimates, of one sample each, by densities however small; 0 where no strategy draws the sample.

    Raises
    ------
    ValueError
        An argument has another shape, or odds or densities are negative.

    Task: multiple_importance.one_sample. Source: Veach and Guibas, 1995.
    """
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    ### BEGIN SOLUTION
    drawn = np.asarray(odds, np.float64) @ densities
    found = np.where(drawn > 0, f, 0) / np.where(drawn > 0, drawn, 1)
    return found.astype(np.result_type(f, densities))
    ### END SOLUTION


def _check(name, array, *sizes):
    """The array has the shape; a letter stands for any size."""
    shape = np.shape(array)
    if len(shape) != len(sizes) or any(
        isinstance(size, int) and own != size for own, size in zip(shape, sizes, strict=False)
    ):
        expected = ", ".join(map(str, sizes)) + ("," if len(sizes) == 1 else "")
        raise ValueError(f"{name} must have shape ({expected}), got {shape}")


def _check_strategies(name, counts, densities):
    _check("densities", densities, "S", "N")
    _check(name, counts, np.shape(densities)[0])
    for each, values in ((name, counts), ("densities", densities)):
        if not (np.asarray(values) >= 0).all():
            raise ValueError(f"{each} must be >= 0, got {np.min(values)}")


def _check_positive(name, number):
    if not number > 0:
        raise ValueError(f"{name} must be > 0, got {number}")
