"""The arithmetic of an adaptive film in one pass for each thing, compiled by Numba; used by ``compiled_film``.

In the same order of additions as ``film`` and ``smoothing``, and so to the same bits.
"""

import numpy as np
from numba import njit

from course.engine.loops.options import OPTIONS
from course.engine.render.adaptive.film import FARTHEST_APART, NEARLY_NOTHING, PARTS
from course.engine.render.adaptive.smoothing import BLIND, LEAK, NO_NOISE, NOISE, PAIRS

_THIRD, _HALF, _ONE, _TWO, _FOUR = map(np.float32, (1 / 3, 0.5, 1, 2, 4))
_SIXTEENTH, _THREE, _BLIND, _NOISE = map(np.float32, (1 / 16, 3, BLIND, NOISE))
_PARTS = np.uint64(PARTS)


@njit(inline="always")
def _apart(a, b):
    """``film._apart`` of one pixel."""
    red, green, blue = (
        a[0] / a[3] - b[0] / b[3],
        a[1] / a[3] - b[1] / b[3],
        a[2] / a[3] - b[2] / b[3],
    )
    squared = (red * red + green * green + blue * blue) * _THIRD
    return FARTHEST_APART if squared > FARTHEST_APART else squared


@njit(inline="always")
def _sum(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]


@njit(inline="always")
def _part(mean, weight, i):
    """Weighted colours and weight of a part."""
    w = weight[i] if len(weight) > 1 else weight[0]
    w = w if w > NEARLY_NOTHING else NEARLY_NOTHING
    return mean[0, i] * w, mean[1, i] * w, mean[2, i] * w, w


@njit(**OPTIONS)
def add_stretch(which, mean, weight, samples, shares, share, film):
    """``AdaptiveFilm._add_stretch``.

    Parameters
    ----------
    weight : (n * PARTS,) or (1,) float32
    shares : see ``film.shares_of``
    share : float32, the stretch's share of the samples; 1 for a first one
    film : its arrays, see ``CompiledFilm``
    """
    sums, halves, quarters, linear, variance, cost, have = film
    red, green, blue = linear[0], linear[1], linear[2]
    for i in range(len(which)):
        k, first = np.uint64(which[i]), np.uint64(i) * _PARTS
        one, two = _part(mean, weight, first), _part(mean, weight, first + np.uint64(1))
        three = _part(mean, weight, first + np.uint64(2))
        four = _part(mean, weight, first + np.uint64(3))
        front, back = _sum(one, two), _sum(three, four)
        of_quarters = (_apart(one, two) + _apart(three, four)) * _HALF
        of_halves = _apart(front, back)
        stretch = _sum(front, back)
        halves[k], quarters[k] = of_halves, of_quarters
        estimate = of_quarters * shares[0] + of_halves * shares[1]
        own = sums[k]
        if share < _ONE:
            earlier = np.float32(own[0]), np.float32(own[1]), np.float32(own[2]), np.float32(own[3])
            estimate = estimate + _apart(earlier, stretch) * shares[2] + variance[k] * shares[3]
        variance[k] = estimate * shares[4]
        cost[k] += share * (mean[3, first] - cost[k])
        r, g, b = own[0] + stretch[0], own[1] + stretch[1], own[2] + stretch[2]
        w = own[3] + stretch[3]
        own[0], own[1], own[2], own[3] = r, g, b, w
        red[k], green[k], blue[k] = r / w, g / w, b / w
        have[k] = samples


@njit(**OPTIONS)
def _noise(above, here, below, noise):
    """``smoothing._binomial`` of a row of variances, times NOISE."""
    last = len(here) - 1
    for x in range(len(here)):
        noise[x] = above[x] + below[x] + _TWO * here[x]
    left = noise[0]
    for x in range(len(here)):
        middle, right = noise[x], noise[x + 1 if x < last else last]
        noise[x] = _NOISE * ((left + right + _TWO * middle) * _SIXTEENTH)
        left = middle


@njit(**OPTIONS)
def _likeness(red, green, blue, noise, red_2, green_2, blue_2, noise_2, result):
    for x in range(len(result)):
        r, g, b = red[x] - red_2[x], green[x] - green_2[x], blue[x] - blue_2[x]
        result[x] = (r * r + g * g + b * b) / (-_THREE * (noise[x] + noise_2[x] + NO_NOISE))


@njit(**OPTIONS)
def _add_product(sums, weights, values):
    for x in range(len(sums)):
        sums[x] += weights[x] * values[x]


@njit(**OPTIONS)
def _scale_and_add(weights, alike, always, sums):
    for x in range(len(weights)):
        weights[x] = weights[x] * alike + always
        sums[x] += weights[x]


@njit(**OPTIONS)
def _add(sums, weights):
    for x in range(len(sums)):
        sums[x] += weights[x]


@njit(**OPTIONS)
def _ends(pair, width):
    """Rows and columns to the neighbour, and the columns where there are both."""
    dy, dx, _ = PAIRS[pair]
    begin, end = max(-dx, 0), width - max(dx, 0)
    return dy, begin, end, begin + dx, end + dx


@njit(**OPTIONS)
def likeness(colours, variance, noise, weights):
    """Logarithms of how alike neighbours are, (4, H, W); 0 where a pixel has no such neighbour."""
    height, width = variance.shape
    for y in range(height):
        above, below = max(y - 1, 0), min(y + 1, height - 1)
        _noise(variance[above], variance[y], variance[below], noise[y])
    weights[:] = 0
    for pair in range(4):
        dy, begin, end, begin_2, end_2 = _ends(pair, width)
        for y in range(height - dy):
            _likeness(
                colours[0, y, begin:end],
                colours[1, y, begin:end],
                colours[2, y, begin:end],
                noise[y, begin:end],
                colours[0, y + dy, begin_2:end_2],
                colours[1, y + dy, begin_2:end_2],
                colours[2, y + dy, begin_2:end_2],
                noise[y + dy, begin_2:end_2],
                weights[pair, y, begin:end],
            )


@njit(**OPTIONS)
def weigh(weights, total):
    """Weights from how alike neighbours are, and the sums (H, W) of each pixel's."""
    height, width = total.shape
    total[:] = _FOUR
    for pair in range(4):
        binomial = PAIRS[pair][2]
        alike, always = np.float32(binomial * (1 - LEAK)), np.float32(binomial * LEAK)
        dy, begin, end, begin_2, end_2 = _ends(pair, width)
        for y in range(height - dy):
            _scale_and_add(weights[pair, y, begin:end], alike, always, total[y, begin:end])
        for y in range(height - dy):
            _add(total[y + dy, begin_2:end_2], weights[pair, y, begin:end])


@njit(**OPTIONS)
def smooth(values, scale, samples, weights, total, own, mixed):
    """``smoothing.smoothed``, into ``mixed``; ``scale`` (H, W) are the samples to the power of twice the order."""
    height, width = values.shape
    own[:] = values * scale
    mixed[:] = own * _FOUR
    for pair in range(4):
        dy, begin, end, begin_2, end_2 = _ends(pair, width)
        for y in range(height - dy):
            weight, there = weights[pair, y, begin:end], own[y + dy, begin_2:end_2]
            _add_product(mixed[y, begin:end], weight, there)
        for y in range(height - dy):
            weight, here = weights[pair, y, begin:end], own[y, begin:end]
            _add_product(mixed[y + dy, begin_2:end_2], weight, here)
    for y in range(height):
        _settle(mixed[y], total[y], own[y], samples[y], scale[y])


@njit(**OPTIONS)
def _settle(mixed, total, own, samples, scale):
    """The less weight for the neighbours' mean, the more samples a pixel has."""
    for x in range(len(mixed)):
        less = min(_BLIND / np.float32(samples[x]), _ONE)
        mixed[x] = ((mixed[x] / total[x] - own[x]) * less + own[x]) / scale[x]
