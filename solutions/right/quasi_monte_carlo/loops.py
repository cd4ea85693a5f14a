"""Plain Python, one number at a time."""

import numpy as np


def radical_inverse(base, i):
    """The mirrored number, as a whole one."""
    _check_inverse(base, i)
    value = np.empty(len(i), np.float32)
    for k, rest in enumerate(i.tolist()):
        mirrored, size = 0, 1
        while rest:
            rest, digit = divmod(rest, base)
            mirrored, size = mirrored * base + digit, size * base
        value[k] = mirrored / size
    return value


def halton(i, dims):
    """Coordinate by coordinate."""
    _check_indices("i", i)
    _check_dims(dims)
    points = np.empty((dims, len(i)), np.float32)
    base = 1
    for d in range(dims):
        base += 1
        while any(base % k == 0 for k in range(2, base)):
            base += 1
        points[d] = radical_inverse(base, i)
    return points


def hammersley(n, dims):
    """Point by point in the first coordinate."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    points = np.empty((dims, n), np.float32)
    points[0] = [k / n for k in range(n)]
    if dims > 1:
        points[1:] = halton(np.arange(n), dims - 1)
    return points


def chain(patterns, ids, rng):
    """Fisher and Yates's shuffle."""
    _check_chain(patterns, ids)
    chained = []
    for pattern in patterns:
        order = list(range(pattern.shape[1]))
        for last in range(len(order) - 1, 0, -1):
            k = int(rng.integers(last + 1))
            order[k], order[last] = order[last], order[k]
        samples = np.empty((len(pattern), len(ids)), pattern.dtype)
        for ray, one in enumerate(ids.tolist()):
            samples[:, ray] = pattern[:, order[one]]
        chained.append(samples)
    return tuple(chained)


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
