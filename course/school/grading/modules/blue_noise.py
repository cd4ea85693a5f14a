"""blue_noise declared: orders of pixels, masks, moved points, spectra and what is left of an error after a blur.

A shuffled order and a mask may be right in many ways. So orders are asked for quadrants and for the frequency of each
permutation, and masks step by step, each from the ranks before it.
"""

from collections.abc import Mapping
from math import factorial, nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import WHOLE, Arguments, Function, Law, Made, function
from course.school.grading.checks.distributions import FALSE_FAIL, chi_squared
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, holds, law

SCALES = (1.0, 1e-6, 1e6)

NO_INDICES = (np.array([0.0, 1, 2, 3], np.float32), np.array([0, 1, -1, 2]))


def _curve(x: Array, y: Array) -> Array:
    """Numbers along Morton's curve, a bit of each coordinate at a time from the highest on."""
    found = np.zeros(np.shape(x), np.int64)
    for bit in reversed(range(16)):
        found = 4 * found + 2 * (np.asarray(y, np.int64) // 2**bit % 2)
        found += np.asarray(x, np.int64) // 2**bit % 2
    return found


# ---------------------------------------------------------------- z_order


def _below(end: int) -> Made:
    def make(draw: Draw) -> Array:
        return draw.rng.integers(0, 4 if draw.simple else end, draw.n)

    return Made(make, (*NO_INDICES, np.array([0, 1 << 16, 1, 2])))


def _far(draw: Draw) -> Mapping[str, Any]:
    """Pixels with high bits."""
    far = [(1 << 16) - 1 - draw.rng.integers(0, 1000, draw.n) for _ in range(2)]
    return dict(zip("xy", far, strict=True))


def _numbers(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, _curve(a.x, a.y)


OTHER_PIXELS: Any = (
    lambda _: {"x": np.arange(16, dtype=np.int32), "y": np.full(16, 200, np.int32)},
    lambda _: {"x": np.arange(16, dtype=np.uint8), "y": np.full(16, 255, np.uint8)},
)

Z_ORDER = function(
    "blue_noise.z_order",
    {"x": _below(3000), "y": _below(3000)},
    (
        close(
            "far",
            "Pixels far from the corner have all their bits",
            _numbers,
            "Sixteen bits of each make a number of 32.",
            what="a number of",
            within=0,
            case=_far,
            dtypes=(np.float32,),
        ),
        holds(
            "quadrant",
            "The first 4^k numbers are those of the first 2^k rows and columns",
            lambda a, r: r < 4 ** np.ceil(np.log2(np.maximum(np.maximum(a.x, a.y), 0.5) + 1)),
            "a number below 4^k for a pixel whose column and row are below 2^k",
            "A quadrant comes as a whole, before the curve goes on to the next.",
            dtypes=(np.float32,),
        ),
        close(
            "values",
            "Bits of column and row take turns",
            _numbers,
            "The lowest bit of the number is the lowest of x, the next one the lowest of y.",
            what="a number of",
            within=0,
            whole=True,
            dtypes=(np.float32,),
        ),
    ),
    contract="x: N, y: N -> the numbers: whole N",
    corners=OTHER_PIXELS,
)

# ---------------------------------------------------------------- shuffled_z_order

DEEP = 4
"""Levels of the squares whose permutations are counted."""

SEEDS = 120

ORDERS = factorial(4)


def _seed(draw: Draw) -> int:
    return int(draw.rng.integers(0, 8 if draw.simple else 1 << 32))


def _square(draw: Draw) -> Mapping[str, Any]:
    """All pixels of a square, in any order."""
    levels = 1 if draw.simple else int(draw.rng.integers(2, 6))
    y, x = np.divmod(draw.rng.permutation(4**levels), 2**levels)
    return {"x": x, "y": y, "levels": levels, "seed": _seed(draw)}


def _anywhere(draw: Draw) -> Mapping[str, Any]:
    levels = 2 if draw.simple else int(draw.rng.integers(1, 16))
    pixels = draw.rng.integers(0, 2**levels, (2, draw.n))
    return {"x": pixels[0], "y": pixels[1], "levels": levels, "seed": _seed(draw)}


def _check_numbers(a: Arguments, r: Array) -> None:
    """Each number of the square once."""
    if not np.array_equal(np.sort(r), np.arange(r.size)):
        raise Failure(
            f"each number from 0 to {r.size - 1} once",
            f"{np.unique(r).size} different numbers from {r.min()} to {r.max()}",
            f"a square of {2**a.levels} x {2**a.levels} pixels",
            "A digit is replaced by its image under a permutation: no two get the same.",
        )


def _check_nested(a: Arguments, r: Array) -> None:
    """Pixels of a quadrant follow each other."""
    _check_numbers(a, r)
    along = _curve(a.x, a.y)
    for level in range(1, a.levels):
        own = np.asarray(r)[np.argsort(along)].reshape(-1, 4**level)
        span = own.max(axis=1) - own.min(axis=1)
        if (span >= 4**level).any():
            k = int(span.argmax())
            raise Failure(
                f"the pixels of a quadrant of {2**level} x {2**level} to follow each other: "
                f"{4**level} numbers in a row",
                f"numbers from {own[k].min()} to {own[k].max()}",
                f"levels = {a.levels}, quadrant {k} of the Z-order",
                "Large quadrants have the high digits, and their parts the next lower ones.",
            )


def _shuffles(function: Function, trial: Trial) -> list[Array]:
    """Permutations (SEEDS, 4^k, 4) of the quadrants of each level, the lowest first."""
    y, x = np.divmod(np.arange(4**DEEP), 2**DEEP)
    first = np.argsort(_curve(x, y))
    found = []
    for seed in trial.rng.integers(0, 1 << 32, SEEDS):
        a = Arguments(x=x, y=y, levels=DEEP, seed=int(seed))
        r = function.call(trial, a)
        _check_nested(a, r)
        found.append(np.asarray(r, np.int64)[first])
    orders = np.array(found)
    return [(orders[:, :: 4**level] // 4**level % 4).reshape(SEEDS, -1, 4) for level in range(DEEP)]


def _smallest(function: Function, trial: Trial, levels: int, seed: int, z: Array) -> Array:
    """Permutations (n, 4) of the smallest quadrants that have those digits above them."""
    inside = (4 * z[:, None] + np.arange(4)).ravel()
    bits = [(inside[:, None] >> 2 * np.arange(levels) + axis & 1) for axis in range(2)]
    x, y = (axis @ (1 << np.arange(levels)) for axis in bits)
    a = Arguments(x=x, y=y, levels=levels, seed=seed)
    return np.asarray(function.call(trial, a), np.int64).reshape(-1, 4) % 4


def _check_all_counts(function: Function, trial: Trial) -> None:
    """Every digit above decides, and every bit of the seed."""
    rng, pairs = trial.rng, []
    for _ in range(8):
        levels = int(rng.integers(8, 16))
        seed, z = int(rng.integers(1 << 32)), rng.integers(0, 4 ** (levels - 1), 80)
        # One digit above is another, of those that the other checks never change alone.
        other = z ^ rng.integers(1, 4, z.size) << 2 * rng.integers(DEEP - 1, levels - 1, z.size)
        pairs.append([_smallest(function, trial, levels, seed, k) for k in (z, other)])
    _check_pairs(
        pairs,
        "from the permutation of one quadrant to that of another, whose digits differ in a high one alone",
        "All digits above count, up to that of the largest quadrants.",
    )
    pairs = []
    for bit in range(32):
        seed, z = int(rng.integers(1 << 32)), rng.integers(0, 4**5, 20)
        pairs.append([_smallest(function, trial, 6, k, z) for k in (seed, seed ^ 1 << bit)])
    _check_pairs(
        pairs,
        "from the permutation of one seed to that of another, which differs in a bit",
        "All 32 bits of the seed count.",
    )


def _check_pairs(pairs: list[list[Array]], what: str, hint: str) -> None:
    _check_counts(np.concatenate([_apart(*pair) for pair in pairs]), what, hint)


def _named(orders: Array) -> Array:
    """A number from 0 to 23 for permutations (..., 4)."""
    found = np.zeros(orders.shape[:-1], np.int64)
    for k in range(4):
        found = found * (4 - k) + (orders[..., k + 1 :] < orders[..., k : k + 1]).sum(axis=-1)
    return found


def _apart(one: Array, other: Array) -> Array:
    """The permutation from one to the other: uniform if they are independent."""
    return np.take_along_axis(other, np.argsort(one, axis=-1), axis=-1)


def _check_counts(orders: Array, what: str, hint: str) -> None:
    named = np.bincount(_named(orders).ravel(), minlength=ORDERS)
    chi_squared(named, np.full(ORDERS, named.sum() / ORDERS), what, hint)


def _check_shuffles(function: Function, trial: Trial) -> None:
    levels = _shuffles(function, trial)
    # Each independent of the others: what falls out of it is told by the pairs below.
    _check_counts(
        np.concatenate([level[:, 0] for level in levels[-1:]]),
        "permutations of the whole square's quadrants, for many seeds",
        "All 24 permutations are equally probable, and the seed decides.",
    )
    _check_counts(
        levels[0],
        "permutations of the smallest quadrants",
        "All 24 permutations are equally probable, for each quadrant anew.",
    )
    pairs = (
        ("of two quadrants side by side", levels[0][:, ::2], levels[0][:, 1::2]),
        ("of a quadrant and of its first part", levels[1], levels[0][:, ::4]),
        ("of quadrants of two levels", levels[1], levels[0][:, :16]),
        ("of two seeds", levels[0][::2], levels[0][1::2]),
    )
    for what, one, other in pairs:
        _check_counts(
            _apart(one, other),
            f"from the permutation of one to that of the other, {what}",
            "The permutation hangs on the seed, the level and all digits above.",
        )


def _law(name: str, title: str, run: Any, **how: Any) -> Law:
    return Law(name, title, run, "core", "distribution", false_fail=6 * FALSE_FAIL, **how)


def _nested_and_shuffled(function: Function, trial: Trial) -> None:
    for _ in range(6):
        a = function.make(Draw(trial.rng, 1), _square)
        _check_nested(a, function.call(trial, a))
    _check_shuffles(function, trial)


SHUFFLED_Z_ORDER = function(
    "blue_noise.shuffled_z_order",
    {
        "x": Made(None, NO_INDICES),
        "y": Made(None, NO_INDICES),
        "levels": Made(None, (-1, 16, 2.5, nan)),
        "seed": Made(None, (-1, 1 << 32)),
    },
    (
        law(
            "numbers",
            "Each number of the square comes once",
            _check_numbers,
            case=_square,
            scales=SCALES,
            dtypes=(np.float32,),
        ),
        law(
            "quadrants",
            "The pixels of a quadrant follow each other, on every level",
            _check_nested,
            case=_square,
            scales=SCALES,
            dtypes=(np.float32,),
        ),
        _law(
            "shuffled",
            "Quadrants are shuffled, each in an order of its own",
            _nested_and_shuffled,
            points=WHOLE,
        ),
        Law(
            "all_of_it",
            "Orders hang on every digit above, and on every bit of the seed",
            _check_all_counts,
            "corner",
            "distribution",
            false_fail=2 * FALSE_FAIL,
        ),
    ),
    case=_anywhere,
    scales=(),
    unique=False,
)

# ---------------------------------------------------------------- void_and_cluster

TIE = 1e-5
"""Places whose crowds differ by less are as crowded as each other: either may be taken."""


def _start(draw: Draw) -> Mapping[str, Any]:
    """Small pictures, neither of them square, and points as wide as in masks."""
    low, high = (2, 4) if draw.simple else (5, 11)
    height, width = draw.rng.integers(low, high, 2)
    u = draw.rng.permutation(height * width).reshape(height, width) / (height * width)
    return {"u": u, "sigma": 1.5 if draw.simple else float(draw.rng.uniform(1, 2))}


def _crowding(shape: tuple[int, ...], sigma: float) -> Array:
    """(H W, H W): how much each place crowds each other."""
    height, width = shape
    place = np.arange(height * width)
    rows, columns = (np.abs(k[:, None] - k) for k in np.divmod(place, width))
    rows, columns = np.minimum(rows, height - rows), np.minimum(columns, width - columns)
    return np.asarray(np.exp((rows**2 + columns**2) / (-2 * sigma**2)))


def _firsts(a: Arguments) -> int:
    return max(1, int(a.u.size) // 10)


def _check_ranks(a: Arguments, r: Array) -> None:
    """Each rank once."""
    if not np.array_equal(np.sort(r, axis=None), np.arange(a.u.size)):
        raise Failure(
            f"each rank from 0 to {a.u.size - 1} once",
            f"{np.unique(r).size} different ranks from {r.min()} to {r.max()}",
            f"a mask of {a.u.shape[0]} x {a.u.shape[1]}",
        )


def _check_voids(a: Arguments, r: Array) -> None:
    """From the first pattern on each rank fills the largest void."""
    _check_ranks(a, r)
    pairs, places = _crowding(a.u.shape, a.sigma), np.argsort(r, axis=None)
    crowd = pairs[places[: _firsts(a)]].sum(axis=0)
    for rank in range(_firsts(a), a.u.size):
        least = crowd[places[rank:]].min()
        if crowd[places[rank]] > least + TIE:
            raise _step(a, rank, places[rank], crowd, least, "in the largest void")
        crowd += pairs[places[rank]]


def _check_clusters(a: Arguments, r: Array) -> None:
    """Below, each rank is the tightest cluster of what is left."""
    _check_ranks(a, r)
    pairs, places = _crowding(a.u.shape, a.sigma), np.argsort(r, axis=None)
    crowd = pairs[places[: _firsts(a)]].sum(axis=0)
    for rank in reversed(range(_firsts(a))):
        most = crowd[places[: rank + 1]].max()
        if crowd[places[rank]] < most - TIE:
            raise _step(a, rank, places[rank], crowd, most, "of the tightest cluster")
        crowd -= pairs[places[rank]]


def _step(a: Arguments, rank: int, place: int, crowd: Array, asked: float, which: str) -> Failure:
    row, column = divmod(int(place), a.u.shape[1])
    return Failure(
        f"rank {rank} {which}, where the sum is {asked:.5g}",
        f"{crowd[place]:.5g} in row {row}, column {column}",
        f"a mask of {a.u.shape[0]} x {a.u.shape[1]}, sigma = {a.sigma:.3g}",
        "Distances go the shorter way round the torus, and all points add up.",
    )


def _settled(a: Arguments) -> Array | None:
    """The pattern (H W,) at the end of step 1; None if it hangs on a choice between equals."""
    pairs = _crowding(a.u.shape, a.sigma)
    points = np.argsort(np.argsort(a.u, axis=None)) < _firsts(a)
    while True:
        crowd = pairs @ points
        taken = np.flatnonzero(points)
        order = taken[np.argsort(-crowd[taken])]
        if order.size > 1 and crowd[order[0]] - crowd[order[1]] < TIE:
            return None
        points[order[0]] = False
        crowd = pairs @ points
        free = np.flatnonzero(~points)
        void = free[np.argsort(crowd[free])]
        if crowd[void[0]] > crowd[order[0]] - TIE:
            # Rounding may move the point once more, to another place that is as empty as the one just left.
            if (crowd[void] < crowd[order[0]] + TIE).sum() > 1:
                return None
            points[order[0]] = True
            return points
        if void.size > 1 and crowd[void[1]] - crowd[void[0]] < TIE:
            return None
        points[void[0]] = True


def _check_start(a: Arguments, r: Array) -> None:
    """The first ranks are those of the settled pattern."""
    _check_ranks(a, r)
    points = _settled(a)
    if points is None:
        return
    wrong = np.flatnonzero((np.ravel(r) < _firsts(a)) != points)
    if wrong.size:
        row, column = divmod(int(wrong[0]), a.u.shape[1])
        has = "a" if points[wrong[0]] else "no"
        raise Failure(
            f"{has} point in row {row}, column {column}, of the {_firsts(a)} at the end of step 1",
            f"rank {np.ravel(r)[wrong[0]]}",
            f"a mask of {a.u.shape[0]} x {a.u.shape[1]}, sigma = {a.sigma:.3g}",
            "Begin where u is smallest; move until the largest void is the place just left.",
        )


def _check_mask(a: Arguments, r: Array) -> None:
    for check in (_check_start, _check_clusters, _check_voids):
        check(a, r)


def _mask_law(name: str, title: str, look: Any, **how: Any) -> Law:
    scales = (1.0,) * 8
    return law(name, title, look, scales=scales, dtypes=(np.float32,), **how)


VOID_AND_CLUSTER = function(
    "blue_noise.void_and_cluster",
    {
        "u": Made(None, (np.zeros((0, 3), np.float32), np.zeros(4, np.float32)), batch=False),
        "sigma": Made(None, (0.0, -1.0, nan)),
    },
    (
        _mask_law("ranks", "Each rank comes once", _check_ranks),
        _mask_law("start", "The first ranks are those of the settled pattern", _check_start),
        _mask_law("clusters", "The tightest cluster has the highest rank left", _check_clusters),
        _mask_law("voids", "The next rank fills the largest void", _check_voids),
        _mask_law("steps", "Every rank is what its step gives", _check_mask, whole=True),
    ),
    case=_start,
    columns=False,
    scales=(),
    speed=0,
    unique=False,
)

# ---------------------------------------------------------------- dithered_points


def _pattern(draw: Draw) -> Mapping[str, Any]:
    """Points, masks of any size, and pixels beyond them."""
    s = 1 if draw.simple else int(draw.rng.integers(1, 5))
    height, width = (2, 2) if draw.simple else draw.rng.integers(1, 14, 2)
    masks = [draw.rng.permutation(height * width).reshape(height, width) for _ in range(2)]
    return {
        "points": draw.units(2, s),
        "masks": np.stack(masks),
        "x": draw.rng.integers(0, 60, draw.n),
        "y": draw.rng.integers(0, 60, draw.n),
    }


def _within_mask(draw: Draw) -> Mapping[str, Any]:
    a = dict(_pattern(draw))
    _, height, width = a["masks"].shape
    return a | {
        "points": np.zeros((2, 1)),
        "x": draw.rng.integers(0, width, draw.n),
        "y": draw.rng.integers(0, height, draw.n),
    }


def _moved(a: Arguments, r: Array) -> tuple[Any, ...]:
    """By how much each number is off, against none: the shorter way round, for what lies in [0, 1]."""
    _, height, width = a.masks.shape
    ranks = a.masks.reshape(2, -1)[:, (a.y % height) * width + a.x % width]
    expected = np.asarray(a.points)[:, None] + ((2 * ranks + 1) / (2 * height * width))[..., None]
    off = np.where((r >= 0) & (r <= 1), (r - expected + 0.5) % 1 - 0.5, r - expected % 1)
    return np.moveaxis(off, 1, 2).reshape(-1, len(a.x)), 0.0, 1.0


DITHERED_POINTS = function(
    "blue_noise.dithered_points",
    {
        "points": Made(),
        "masks": Made(batch=False),
        "x": Made(None, NO_INDICES),
        "y": Made(None, NO_INDICES),
    },
    (
        holds(
            "unit",
            "Points stay in [0, 1)",
            lambda _, r: (r >= 0) & (r <= 1),
            "a number in [0, 1)",
            "What leaves on one side comes in on the other.",
        ),
        close(
            "middle",
            "Rank r moves 0 to the middle of the part of [0, 1) that it stands for",
            _moved,
            "Ranks from 0 to H W - 1 divide [0, 1) into H W parts.",
            what="a difference of",
            case=_within_mask,
        ),
        close(
            "values",
            "Points are moved by the mask's rank at the pixel, which the mask is repeated over",
            _moved,
            "Row y of the mask, column x, and each dimension has a mask of its own.",
            what="a difference of",
            whole=True,
        ),
    ),
    case=_pattern,
    scales=(),
)

# ---------------------------------------------------------------- radial_spectrum


def _powers_of_2(draw: Draw) -> tuple[int, int]:
    if draw.simple:
        return 2, 4
    height, width = 2 ** draw.rng.integers(2, 6, 2)
    return int(height), int(width)


def _error(draw: Draw) -> Mapping[str, Any]:
    """Errors whose frequencies lie at no border of a bin by rounding."""
    size = _powers_of_2(draw)
    bins = int(draw.rng.integers(1, min(size) // 2 + 1))
    return {"error": draw.lengths(-1, 1, *size), "bins": bins}


def _biased(draw: Draw) -> Mapping[str, Any]:
    a = dict(_error(draw))
    return a | {"error": a["error"] + 8 * draw.scale}


def _wave(draw: Draw) -> Mapping[str, Any]:
    """A wave along an axis: all power is in one bin."""
    side = 4 if draw.simple else 32
    k = int(draw.rng.integers(1, side // 2))
    wave = np.cos(2 * np.pi * k * np.arange(side) / side) * draw.scale
    error = np.broadcast_to(wave, (side, side))
    error = error if draw.rng.random() < 0.5 else error.T
    return {"error": np.ascontiguousarray(error), "bins": side // 2}


def _board(draw: Draw) -> Mapping[str, Any]:
    """A chessboard has the highest frequency of both axes, beyond all bins."""
    side = 4 if draw.simple else 16
    fields = (np.arange(side)[:, None] + np.arange(side)) % 2 - 0.5
    return {"error": fields * draw.scale, "bins": side // 2}


def _spectrum(a: Arguments, r: Array) -> tuple[Any, ...]:
    """Bin by bin, over whole numbers of waves."""
    height, width = a.error.shape
    power = np.abs(np.fft.fft2(a.error)) ** 2 / a.error.size
    down, along = np.arange(height), np.arange(width)
    down, along = np.minimum(down, height - down) / height, np.minimum(along, width - along) / width
    squared = down[:, None] ** 2 + along**2
    means = []
    for k in range(a.bins):
        ring = (squared > (k / (2 * a.bins)) ** 2) & (squared <= ((k + 1) / (2 * a.bins)) ** 2)
        ring |= squared == ((k + 1) / (2 * a.bins)) ** 2
        means.append(power[ring].mean())
    # A single wave leaves rounding in the other bins, and so does a mean.
    return r, np.array(means), max(float(power.max()), 1e-300)


RADIAL_SPECTRUM = function(
    "blue_noise.radial_spectrum",
    {"error": Made(), "bins": Made(None, (0, -1, 100, nan))},
    (
        close(
            "mean",
            "The mean of the error is in no bin",
            _spectrum,
            "Frequency 0 is above no border.",
            what="a power of",
            case=_biased,
            scales=SCALES,
        ),
        close(
            "board",
            "Corners beyond half a cycle per pixel are in no bin",
            _spectrum,
            "A chessboard's frequency is (1/2, 1/2), farther from 0 than 1/2.",
            what="a power of",
            case=_board,
            scales=SCALES,
        ),
        close(
            "wave",
            "A wave has all its power in the bin of its frequency",
            _spectrum,
            "k waves over W pixels are k / W cycles per pixel; a border counts to the bin below.",
            what="a power of",
            case=_wave,
            scales=SCALES,
        ),
        close(
            "values",
            "Bins are means of the power over all directions",
            _spectrum,
            "The mean over the frequencies of a ring, each |F|^2 / (H W).",
            what="a power of",
            scales=SCALES * 3,
            whole=True,
        ),
    ),
    case=_error,
    contract="error: H W, bins -> the spectrum: bins",
    columns=False,
    scales=SCALES,
    speed=0,
)

# ---------------------------------------------------------------- perceptual_rmse


def _size(draw: Draw) -> tuple[int, int]:
    return (1, 3) if draw.simple else tuple(draw.rng.integers(1, 14, 2).tolist())


def _any_error(draw: Draw) -> Mapping[str, Any]:
    return {"error": draw.lengths(-1, 1, *_size(draw)), "sigma": draw.number(0.4, 4)}


def _even_error(draw: Draw) -> Mapping[str, Any]:
    value = draw.scale * draw.number(0.5, 3) * draw.rng.choice((-1.0, 1.0))
    return {"error": np.full(_size(draw), value), "sigma": draw.number(0.4, 4)}


def _spike(draw: Draw) -> Mapping[str, Any]:
    """One wrong pixel at a corner, whose blur goes on at the opposite one."""
    error = np.zeros((3, 4) if draw.simple else (9, 12))
    error[-int(draw.rng.integers(2)), -int(draw.rng.integers(2))] = draw.scale
    return {"error": error, "sigma": draw.number(0.6, 2)}


def _blurred(a: Arguments, r: Array) -> tuple[Any, ...]:
    weights = _crowding(a.error.shape, a.sigma)
    seen = weights @ np.ravel(a.error) / weights[0].sum()
    # What cancels leaves rounding in the scale of the error itself.
    return r, np.sqrt((seen**2).mean()), np.abs(a.error).max()


PERCEPTUAL_RMSE = function(
    "blue_noise.perceptual_rmse",
    {"error": Made(), "sigma": Made(None, (0.0, -1.0, nan))},
    (
        close(
            "even",
            "An error that is the same everywhere stays as large",
            _blurred,
            "Weights add up to 1.",
            what="an error of",
            case=_even_error,
            scales=SCALES,
        ),
        close(
            "edges",
            "A blur goes on at the opposite edge",
            _blurred,
            "The picture is a torus: no pixel has fewer neighbours than another.",
            what="an error of",
            case=_spike,
            scales=SCALES,
        ),
        close(
            "values",
            "The error is blurred, then squared, averaged and its root taken",
            _blurred,
            "Neighbours of opposite sign cancel before anything is squared.",
            what="an error of",
            scales=SCALES * 4,
            whole=True,
        ),
    ),
    case=_any_error,
    contract="error: H W, sigma -> the error",
    columns=False,
    scales=SCALES,
    speed=0,
)

FUNCTIONS = (
    Z_ORDER,
    SHUFFLED_Z_ORDER,
    VOID_AND_CLUSTER,
    DITHERED_POINTS,
    RADIAL_SPECTRUM,
    PERCEPTUAL_RMSE,
)
