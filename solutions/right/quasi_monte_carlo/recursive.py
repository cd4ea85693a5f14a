"""The last digit first, and the rest by itself; patterns copied and shuffled."""

import numpy as np


def radical_inverse(base, i):
    """(digit + inverse of the rest) / base."""
    _check_inverse(base, i)
    return np.asarray(_inverse(base, i.astype(np.int64)), np.float32)


def halton(i, dims):
    """With known primes."""
    _check_indices("i", i)
    _check_dims(dims)
    primes = [p for p in range(2, 30 * dims) if all(p % k for k in range(2, int(p**0.5) + 1))]
    return np.array([radical_inverse(base, i) for base in primes[:dims]])


def hammersley(n, dims):
    """Concatenated."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    first = np.linspace(0, 1, n, endpoint=False, dtype=np.float32)[None]
    if dims == 1:
        return first
    return np.concatenate((first, halton(np.arange(n), dims - 1)))


def chain(patterns, ids, rng):
    """Shuffled copies."""
    _check_chain(patterns, ids)
    chained = []
    for pattern in patterns:
        chained.append(rng.permutation(pattern, axis=1)[:, ids])
    return chained


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


def _inverse(base, i):
    if not i.any():
        return np.zeros(i.shape)
    return (i % base + _inverse(base, i // base)) / base
