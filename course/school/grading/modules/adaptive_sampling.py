"""adaptive_sampling declared: which cells are divided, and into what.

Colours and thresholds are multiples of a power of two, so that differences are exact in any precision, and one just
above the threshold can be told from the threshold itself.
"""

from collections.abc import Mapping
from functools import partial
from itertools import combinations
from math import inf, nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure
from course.school.grading.checks.declare import Arguments, Made, function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import told_apart, where
from course.school.grading.checks.laws import close, holds, law, over_threshold

DIM, BRIGHT = (1.0, 2.0**-10), (1.0, 2.0**10)
"""Factors of all colours and thresholds, which keep differences exact."""

PAIRS = np.array([*combinations(range(4), 2)])
"""Of corners."""

# ---------------------------------------------------------------- needs_subdivision


def _step(draw: Draw) -> float:
    """Between two neighbouring colours."""
    return draw.scale * (0.25 if draw.simple else 2.0**-10)


def _numbers(draw: Draw, *shape: int) -> Array:
    """Numbers of steps, from 0 to 1."""
    return draw.rng.integers(0, 5 if draw.simple else 1024, shape)


def _colours(draw: Draw) -> Mapping[str, Any]:
    """Cells of any colours from 0 to 1; no difference is the threshold."""
    step = _step(draw)
    # Many cells' contrasts are over it, and many aren't.
    threshold = 2 if draw.simple else int(draw.rng.integers(600, 950))
    return {"corners": _numbers(draw, 3, 4, draw.n) * step, "threshold": (threshold + 0.5) * step}


def _plain(draw: Draw) -> Mapping[str, Any]:
    """Cells of one colour each; in every second one corner is a step brighter in one channel."""
    corners = np.repeat(_numbers(draw, 3, 1, draw.n), 4, axis=1)
    odd = np.arange(1, draw.n, 2)
    rng = draw.rng
    corners[rng.integers(0, 3, odd.size), rng.integers(0, 4, odd.size), odd] += 1
    return {"corners": corners * _step(draw), "threshold": 0.0}


def _at_threshold(draw: Draw) -> Mapping[str, Any]:
    """Plain cells but for a pair of corners, which differ by the threshold, or a step more or less, in one channel."""
    n, rng = draw.n, draw.rng
    threshold = 2 if draw.simple else int(rng.integers(20, 200))
    corners = np.repeat(rng.integers(300, 600, (3, 1, n)) // (100 if draw.simple else 1), 4, axis=1)
    difference = threshold + rng.integers(-1, 2, n)
    channel, column, sign = rng.integers(0, 3, n), np.arange(n), rng.choice((-1, 1), n)
    one, other = PAIRS[rng.integers(0, len(PAIRS), n)].T
    # Half up and half down, so that the pair's difference is the cell's largest.
    half = difference // 2
    corners[channel, one, column] += sign * half
    corners[channel, other, column] -= sign * (difference - half)
    return {"corners": corners * _step(draw), "threshold": threshold * _step(draw)}


def _just_over(draw: Draw) -> Mapping[str, Any]:
    """Plain cells but for one corner, which differs by the threshold, or by 2^-23 more: single precision has both."""
    corners = np.full((3, 4, draw.n), 0.25)
    over = draw.rng.integers(0, 2, draw.n) * 2.0**-23
    corners[draw.rng.integers(0, 3, draw.n), 3, np.arange(draw.n)] += 0.25 + over
    return {"corners": corners, "threshold": 0.25}


def _bright(draw: Draw) -> Mapping[str, Any]:
    """Colours far over 1 and below 0; every second cell is of one colour."""
    step = 64 * _step(draw)
    corners = _numbers(draw, 3, 4, draw.n) - (2 if draw.simple else 512)
    corners[:, :, 1::2] = corners[:, :1, 1::2]
    threshold = 1 if draw.simple else int(draw.rng.integers(300, 600))
    return {"corners": corners * step, "threshold": (threshold + 0.5) * step}


def _contrast(a: Arguments) -> Array:
    """The largest difference of two corners, pair by pair."""
    differences = [np.abs(a.corners[:, i] - a.corners[:, j]).max(axis=0) for i, j in PAIRS]
    return np.asarray(np.max(differences, axis=0))


_divided = partial(over_threshold, value=_contrast, what="the largest difference")


NEEDS_SUBDIVISION = function(
    "adaptive_sampling.needs_subdivision",
    {
        "corners": Made(lambda d: d.uniform(0, 1, 3, 4, d.n)),
        "threshold": Made(lambda d: d.scale / 2, (-0.5, -1e-9, nan)),
    },
    (
        _divided(
            "plain",
            "Cells of one colour are left alone",
            hint="Cells of one colour are smooth, and red need not be as bright as green; "
            "with threshold 0 the smallest difference counts.",
            case=_plain,
            scales=DIM,
        ),
        _divided(
            "threshold",
            "Every pair of corners counts in every channel, just above the threshold and not at it",
            hint="A difference has to be over the threshold: as large is not enough. All pairs count.",
            case=_at_threshold,
            scales=DIM,
        ),
        _divided(
            "just_over",
            "A difference that is over the threshold by its last digit is over it",
            hint="More than the threshold, however little: that is a plain >.",
            case=_just_over,
        ),
        _divided(
            "bright",
            "Radiance may have any size and sign",
            hint="Radiance may be larger than 1; each cell is decided on its own.",
            case=_bright,
            scales=BRIGHT,
            points=0.5,
            role="core",
        ),
        _divided(
            "any",
            "Cells are divided where the largest difference is over the threshold",
            hint="Any two corners, in any channel, are enough.",
            scales=DIM,
            role="core",
        ),
    ),
    case=_colours,
    corners=(lambda _: {"threshold": 0.0}, lambda _: {"threshold": inf}),
)

# ---------------------------------------------------------------- subdivide

NAMES = ("x0", "y0", "x1", "y1")
CORNERS = ("lower x, lower y", "upper x, lower y", "lower x, upper y", "upper x, upper y")
"""Where the children lie."""

LENGTHS = (1.0, 1e-3, 1e3)


def _cells(draw: Draw) -> Mapping[str, Any]:
    """Cells of any place and size, some without width."""
    low = draw.lengths(-100, 100, 2, draw.n)
    size = draw.scale * 10.0 ** draw.rng.uniform(-3, 2, (2, draw.n))
    if draw.simple:
        low, size = draw.lengths(-4, 4, 2, draw.n), draw.lengths(1, 4, 2, draw.n)
    size[0, 5::17] = 0
    return dict(zip(NAMES, (*low, *(low + size)), strict=True))


def _wide(draw: Draw) -> Mapping[str, Any]:
    """Cells about as wide as they are far from the origin."""
    low, size = draw.lengths(-1, 1, 2, draw.n), draw.lengths(0.25, 2, 2, draw.n)
    return dict(zip(NAMES, (*low, *(low + size)), strict=True))


def _of(a: Arguments) -> Array:
    """(4, N): x0, y0, x1, y1."""
    return np.stack([*a.values()])


def _middles(a: Arguments) -> tuple[Array, Array]:
    return a.x0 + (a.x1 - a.x0) / 2, a.y0 + (a.y1 - a.y0) / 2


def _quarters(a: Arguments) -> Array:
    """(4, 4, N): x0, y0, x1, y1 of the four children."""
    x, y = _middles(a)
    quarters = [(a.x0, a.y0, x, y), (x, a.y0, a.x1, y), (a.x0, y, x, a.y1), (x, y, a.x1, a.y1)]
    return np.stack([np.stack(quarter) for quarter in quarters], axis=1)


def _outermost(_: Arguments, r: Any) -> Array:
    x0, y0, x1, y1 = r
    return np.stack((x0.min(axis=0), y0.min(axis=0), x1.max(axis=0), y1.max(axis=0)))


def _inner(r: Any, axis: int) -> Array:
    """The four numbers (4, N) that the edges in a cell's middle have along an axis, however children are ordered."""
    return np.concatenate((np.sort(r[axis], axis=0)[2:], np.sort(r[axis + 2], axis=0)[:2]))


def _shared(a: Arguments, r: Any) -> Array:
    """Whether the edges in the middle are one edge, which lies in the cell."""
    right = np.ones(a.x0.shape, bool)
    for axis in (0, 1):
        inner = _inner(r, axis)
        low, high = _of(a)[axis], _of(a)[axis + 2]
        right &= (inner == inner[0]).all(axis=0) & (inner[0] >= low) & (inner[0] <= high)
    return right


def _covered(a: Arguments, r: Any) -> Array:
    """(36, N): in how many children each of some points of a cell lies."""
    x0, y0, x1, y1 = (side[:, None] for side in r)
    u, v = np.stack(np.meshgrid(*[[0.02, 0.2, 0.45, 0.55, 0.8, 0.98]] * 2)).reshape(2, -1, 1)
    x, y = a.x0 + u * (a.x1 - a.x0), a.y0 + v * (a.y1 - a.y0)
    return np.asarray(((x0 <= x) & (x < x1) & (y0 <= y) & (y < y1)).sum(axis=0))


def _in_order(a: Arguments, r: Any) -> None:
    found, expected = np.stack(r), _quarters(a)
    off = np.abs(found - expected) / np.maximum(np.abs(_of(a)).max(axis=0), 1e-30)
    number, child, column = (int(i) for i in np.unravel_index(int(off.argmax()), off.shape))
    if off[number, child, column] > 1e-6:
        asked, came = told_apart(expected[number, child, column], found[number, child, column])
        raise Failure(
            f"{NAMES[number]} of child {child} ({CORNERS[child]}): {asked}",
            came,
            where(a, (column,), a.x0.shape),
            "Row by row, x fastest: the children's order tells which corners they share.",
        )


SUBDIVIDE = function(
    "adaptive_sampling.subdivide",
    {},
    (
        close(
            "outside",
            "The children's outer edges are the cell's, bit for bit",
            lambda a, r: (_outermost(a, r), _of(a)),
            "The children cover their cell exactly.",
            what="the children's outermost x0, y0, x1, y1 are the cell's own: ",
            within=0,
            scales=LENGTHS,
        ),
        holds(
            "shared",
            "The edges that children share are equal bit for bit",
            _shared,
            "the edges in a cell's middle, bit for bit the same for all four children, and in the cell",
            "Shared corners are the same numbers, so that one ray serves all.",
            scales=LENGTHS,
        ),
        holds(
            "area",
            "The children cover the cell without gap or overlap",
            lambda a, r: (_covered(a, r) == 1).all(axis=0),
            "every point of a cell in one of its children",
            "Four children, each a quarter of the area.",
            shows=lambda a, r: np.abs(_covered(a, r) - 1).max(axis=0) + 1,
            case=_wide,
        ),
        close(
            "halves",
            "Cells are divided in their middle",
            lambda a, r: (
                np.stack([_inner(r, axis) for axis in (0, 1)]),
                np.stack(_middles(a))[:, None],
                np.abs(_of(a)).max(axis=0),
            ),
            "A cell is divided in the middle of both sides.",
            what="where the halves of a cell begin and end, its middle: ",
            within=8,
            scales=LENGTHS,
            points=0.5,
            role="core",
        ),
        law(
            "order",
            "The children come row by row, x fastest",
            _in_order,
            case=_cells,
            scales=LENGTHS,
            role="core",
        ),
    ),
    case=_cells,
)

FUNCTIONS = (NEEDS_SUBDIVISION, SUBDIVIDE)
