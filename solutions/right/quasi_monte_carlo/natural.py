"""The loop over digits that books have; lists of rows; columns taken one by one."""

import numpy as np


def radical_inverse(base, i):
    """Digit by digit, in double precision."""
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
    rest = np.array(i, dtype=np.int64)
    value, share = np.zeros(len(i)), 1.0
    while (rest > 0).any():
        share /= base
        value += share * (rest % base)
        rest //= base
    return value.astype(np.float32)


def halton(i, dims):
    """Points in rows, seen from the other side."""
    _check_indices("i", i)
    _check_dims(dims)
    points = np.zeros((len(i), dims), np.float32)
    prime = 2
    for d in range(dims):
        points[:, d] = radical_inverse(prime, i)
        prime += 1
        while any(prime % k == 0 for k in range(2, prime)):
            prime += 1
    return points.T


def hammersley(n, dims):
    """What counts, and Halton's points."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    i = np.arange(n)
    rows = [i / n if n else i, *(halton(i, dims - 1) if dims > 1 else [])]
    return np.array(rows, np.float32)


def chain(patterns, ids, rng):
    """Permutations are drawn as samples are asked for."""
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
    chained = []
    for pattern in patterns:
        left, taken = list(range(pattern.shape[1])), {}
        for one in ids.tolist():
            if one not in taken:
                taken[one] = left.pop(int(rng.integers(len(left))))
        chained.append(pattern[:, [taken[one] for one in ids.tolist()]])
    return tuple(chained)
