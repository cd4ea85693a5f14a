"""Negative cosines have to count as 0: two of them make a positive product."""

import numpy as np

FUNCTION = "importance"
CAUGHT_BY = "away"
MISTAKE = "negative-cosines"
SAYS = "Negative cosines have to count as 0: two of them make a positive product."


def importance(lo, hi, axis, angle, power, p, n):
    """With a mistake."""
    _check("lo", lo, 3, "N")
    count = np.shape(lo)[1]
    for name, array in (("hi", hi), ("axis", axis), ("p", p), ("n", n)):
        _check(name, array, 3, count)
    _check("angle", angle, count)
    _check("power", power, count)
    half = (hi - lo) / 2
    way = lo + half - p
    radius, distance = np.sqrt(_dot(half, half)), np.sqrt(_dot(way, way))
    inverse = 1 / np.where(distance > 0, distance, 1)
    sine = np.minimum(radius * inverse, 1)
    seen = (
        np.where(distance > radius, np.sqrt(1 - sine * sine), -1),
        np.where(distance > radius, sine, 0),
    )
    at_surface = _less(*_cos_sin(_dot(n, way) * inverse), *seen)
    cosine, sine = _cos_sin(-_dot(axis, way) * inverse)
    turned = _less(cosine, sine, *seen)
    sine = np.where(turned < 1, sine * seen[0] - cosine * seen[1], 0)
    at_lamps = _less(turned, sine, np.cos(angle), np.sin(angle))
    gap = np.maximum(np.abs(way) - half, 0)
    near = np.maximum(np.sqrt(_dot(gap, gap)), radius / 20)
    squared = np.maximum(distance, radius) * near
    sent = power * np.abs(at_surface) * np.abs(at_lamps)
    return np.where(squared > 0, sent / np.where(squared > 0, squared, 1), 0).astype(sent.dtype)
