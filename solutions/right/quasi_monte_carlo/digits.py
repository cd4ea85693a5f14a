"""All digits at once; orders by sorting random numbers."""

import numpy as np


def radical_inverse(base, i):
    """A table of the digits."""
    _check_inverse(base, i)
    digits = 1
    while base**digits <= int(i.max(initial=0)):
        digits += 1
    places = np.arange(digits)
    table = i.astype(np.int64)[:, None] // np.power(base, places, dtype=np.int64) % base
    return (table @ (float(base) ** -(places + 1.0))).astype(np.float32)


def halton(i, dims):
    """With the first primes from a sieve."""
    _check_indices("i", i)
    _check_dims(dims)
    sieve = np.ones(100 + dims * dims * 2, bool)
    for k in range(2, len(sieve)):
        sieve[2 * k :: k] = False
    primes = np.flatnonzero(sieve)[2 : dims + 2].tolist()
    return np.array([radical_inverse(base, i) for base in primes], np.float32)


def hammersley(n, dims):
    """One of Halton's points longer, with the first coordinate replaced."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    points = np.roll(halton(np.arange(n), dims), 1, axis=0)
    points[0] = np.arange(n) / max(n, 1)
    return points


def chain(patterns, ids, rng):
    """The order of random numbers."""
    _check_chain(patterns, ids)
    orders = [np.argsort(rng.random(pattern.shape[1])) for pattern in patterns]
    return tuple(pattern.take(o, axis=1).take(ids, axis=1) for pattern, o in zip(patterns, orders))


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)


def _check_chain(patterns, ids):
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
