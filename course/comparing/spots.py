"""Looks for one spot of a few pixels that differs, while the rest of two pictures is the same but for noise.

How much three pixels of a square of 2 x 2 agree to differ is divided by the differences around them. So one bright
pixel, a firefly, is no spot. What noise makes of that number nobody knows: its tail depends on the scene. But the
picture itself shows that tail. Where the largest numbers Z1 > Z2 > ... fall off as a power or faster, the spacings
i log(Zi / Zi+1) are at most exponential, and the first of them is larger than the mean of m others as often as Fisher's
F(2, 2m) says, or less often (Hill, "A simple general approach to inference about the tail of a distribution", 1975).
"""

import numpy as np

from course.core.types import Floats64, Mask

AROUND, OWN = 9, 3
"""Pixels along the side of the square whose differences a spot's are divided by, and of its middle, left out."""

APART = 4
"""Pixels between spots at least."""

TAIL, FEWEST = 32, 8
"""Spacings of the largest numbers that are compared, and how many there must be."""

BRIGHTEST = 99.0
"""Percentile of the values, at twice which brighter ones are cut off: bright fireflies have longer tails."""

STEP = 0.15
"""Mean spacing that is assumed at least: where few samples bring light, numbers jump by whole samples."""


def most_different_spot(a: Floats64, b: Floats64, usable: Mask) -> tuple[float, int, int]:
    """The p-value of the spot that stands out most, corrected for the number of all, and its column and row.

    ``a``, ``b``: pictures (H, W, 3); ``usable``: (H, W) pixels that count.
    """
    z = np.zeros(usable.shape)
    top = 2 * np.percentile(np.stack((a, b))[:, usable], BRIGHTEST)
    for channel in range(3):
        d = (np.minimum(a[..., channel], top) - np.minimum(b[..., channel], top)) * usable
        np.maximum(z[:-1, :-1], _standing_out(d), out=z[:-1, :-1])
    largest = []
    for _ in range(TAIL + 1):
        row, column = map(int, np.unravel_index(int(z.argmax()), z.shape))
        if z[row, column] <= 0:
            break
        largest.append((float(z[row, column]), column, row))
        z[max(row - APART, 0) : row + APART + 1, max(column - APART, 0) : column + APART + 1] = 0
    if len(largest) <= FEWEST:
        return 1.0, 0, 0
    from scipy.stats import f

    logs = np.log([size for size, _, _ in largest])
    spacings = np.arange(1, len(logs)) * (logs[:-1] - logs[1:])
    others = spacings[1:]
    ratio = spacings[0] / max(float(others.mean()), STEP)
    return float(f.sf(ratio, 2, 2 * len(others))), *largest[0][1:]


def _standing_out(d: Floats64) -> Floats64:
    """How much each square of 2 x 2 differences (H, W) stands out, (H - 1, W - 1): at least 0."""
    from scipy.ndimage import uniform_filter

    upper, lower = (way(d[:-1], d[1:]) for way in (np.maximum, np.minimum))
    # Of the four, the two in the middle: three are at least as large as the lower of them, three at most as the higher.
    one = np.maximum(lower[:, :-1], lower[:, 1:])
    other = np.minimum(upper[:, :-1], upper[:, 1:])
    size = np.maximum(np.minimum(one, other), -np.maximum(one, other))
    squares = [uniform_filter(d * d, side) * side**2 for side in (AROUND, OWN)]
    around = np.sqrt(np.maximum(squares[0] - squares[1], 0) / (AROUND**2 - OWN**2))
    # Where all is even the noise of elsewhere counts, by its median.
    least = float(np.median(around[around > 0])) if (around > 0).any() else 1.0
    result: Floats64 = np.maximum(size, 0) / np.maximum(around[:-1, :-1], least)
    return result
