"""quasi_monte_carlo - points that are spread evenly by design, and patterns chained by a ray's id.

Random points clump and leave gaps. Sequences of low discrepancy put each new point where there is room, so that
errors fall with nearly 1 / N instead of 1 / sqrt(N). A ray needs such points several times over, for the lens, the
light, the time and the gloss; chaining gives each effect a pattern made beforehand, without tying one to another.
"""

import numpy as np


def radical_inverse(base, i):
    """Mirror the digits of i at the point: 6 is 110 in base 2, and becomes 0.011 = 3/8.

    Parameters
    ----------
    base : int >= 2
    i : (N,) integer >= 0

    Returns
    -------
    (N,) float32 in [0, 1); what lies nearer to 1 than float32 tells may be 1

    Raises
    ------
    ValueError
        base is not an integer >= 2, or i has another shape, is not integer or is negative.

    Task: quasi_monte_carlo.radical_inverse. Source: van der Corput, "Verteilungsfunktionen", 1935.
    """
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
    ### BEGIN SOLUTION
    return _mirrored(base, i)
    ### END SOLUTION


def halton(i, dims):
    """Points of Halton's sequence: coordinate d is the radical inverse of i in the d-th prime, 2, 3, 5, ...

    Parameters
    ----------
    i : (N,) integer >= 0
        Which points: the sequence has no end, and any of them can be had at once.
    dims : int >= 1

    Returns
    -------
    (dims, N) float32 in [0, 1); what lies nearer to 1 than float32 tells may be 1

    Raises
    ------
    ValueError
        i has another shape, is not integer or is negative, or dims < 1.

    Task: quasi_monte_carlo.halton. Source: Halton, "On the efficiency of certain quasi-random sequences of points in
    evaluating multi-dimensional integrals", 1960.
    """
    _check_indices("i", i)
    _check_dims(dims)
    ### BEGIN SOLUTION
    return np.stack([_mirrored(base, i) for base in _primes(dims)])
    ### END SOLUTION


def hammersley(n, dims):
    """A set of n points: coordinate 0 of point i is i / n, the others are Halton's coordinates of i.

    Parameters
    ----------
    n : int >= 0
        More even than Halton's first n points, but n has to be known beforehand.
    dims : int >= 1

    Returns
    -------
    (dims, n) float32 in [0, 1); what lies nearer to 1 than float32 tells may be 1

    Raises
    ------
    ValueError
        n < 0 or dims < 1.

    Task: quasi_monte_carlo.hammersley. Source: Hammersley, "Monte Carlo methods for solving multivariable problems",
    1960.
    """
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    ### BEGIN SOLUTION
    i = np.arange(n)
    return np.stack([_below_1(i / max(n, 1)), *(_mirrored(base, i) for base in _primes(dims - 1))])
    ### END SOLUTION


def chain(patterns, ids, rng):
    """The samples of each ray for each effect, by the ray's id within its pixel.

    A pattern holds the samples of one effect, as many as a pixel has rays. Were ray 3 to take sample 3 of each, then
    the left of the lens would always see the left of the light. So each pattern gets a permutation of its own, drawn
    from rng: ray id takes sample permutation[id], a permutation for each pattern and call. Each pattern stays as even
    as it was, for the rays of a pixel take each sample once.

    Parameters
    ----------
    patterns : sequence of K arrays (d, s) floating
        Such as lens (2, s), light (2, s), time (1, s) and gloss (2, s); d may differ, s may not.
    ids : (N,) integer in [0, s)
        Any number of rays, in any order. Equal ids take equal samples.
    rng : numpy.random.Generator
        All permutations of each pattern are equally probable, and those of two patterns independent.

    Returns
    -------
    tuple of K arrays (d, N), each of the dtype of its pattern
        The d coordinates of a sample stay together; values are the pattern's, bit for bit.

    Raises
    ------
    ValueError
        A pattern is not (d, s), or ids is not (N,) or integer or in [0, s).

    Task: quasi_monte_carlo.chain. Source: Cook, Porter and Carpenter, "Distributed ray tracing", 1984.
    """
    for k, pattern in enumerate(patterns):
        shape, s = np.shape(pattern), np.shape(patterns[0])[-1:]
        if len(shape) != 2 or shape[1:] != s:
            expected = f"(d, {s[0]})" if k and s else "(d, s)"
            raise ValueError(f"patterns[{k}] must have shape {expected}, got {shape}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError(f"ids must be < {np.shape(patterns[0])[1]}, got {ids.max()}")
    ### BEGIN SOLUTION
    return tuple(pattern[:, rng.permutation(pattern.shape[1])[ids]] for pattern in patterns)
    ### END SOLUTION


### BEGIN SOLUTION
def _mirrored(base, i):
    """The radical inverse, digit by digit from the last."""
    rest = i.astype(np.uint64)
    value, weight = np.zeros(i.shape), 1 / base
    while rest.any():
        rest, digit = np.divmod(rest, np.uint64(base))
        value += digit * weight
        weight /= base
    return _below_1(value)


def _below_1(value):
    """In single precision, where the last numbers below 1 must not be rounded to it."""
    return np.minimum(value.astype(np.float32), np.float32(1 - 2**-24))


def _primes(count):
    primes = []
    number = 2
    while len(primes) < count:
        if all(number % prime for prime in primes):
            primes.append(number)
        number += 1
    return primes


### END SOLUTION


def _check_indices(name, array):
    if np.ndim(array) != 1:
        raise ValueError(f"{name} must have shape (N,), got {np.shape(array)}")
    if getattr(array, "dtype", np.dtype(object)).kind not in "iu":
        raise ValueError(f"{name} must be an array of integers")
    if not (array >= 0).all():
        raise ValueError(f"{name} must be >= 0, got {array.min()}")


def _check_dims(dims):
    if not dims >= 1:
        raise ValueError(f"dims must be >= 1, got {dims}")
