"""environment_light declared: weights of texels, their inversion, the density in closed form, and alias tables.

Pictures are small and have suns, black texels and black rows. Values are asked for within texels, for at their borders
a right function may take either side.
"""

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from math import nan, pi
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Made, function
from course.school.grading.checks.distributions import uniform
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, holds, unit_length

INSIDE = 0.05
"""Share of a texel next to its border where nothing is asked for."""

SCALES = (1.0, 1e-6, 1e6)

FAINT = (1e-15,)
"""Brightness of pictures whose weights are small; what sums to 0 alone is nothing."""


def _size(draw: Draw) -> tuple[int, int]:
    return (2, 3) if draw.simple else (int(draw.rng.integers(2, 9)), int(draw.rng.integers(2, 12)))


def _weights(draw: Draw) -> Array:
    """Weights (H, W) with a sun, black texels, and a black row where there are three or more."""
    weights = draw.lengths(0.2, 2, *_size(draw))
    weights[draw.rng.random(weights.shape) < 0.25] = 0
    weights.flat[draw.rng.integers(weights.size)] = 30 * draw.scale
    if len(weights) > 2:
        row = int(draw.rng.integers(len(weights)))
        weights[row] *= float(weights.sum() == weights[row].sum())
    return weights


def _solid_angles(height: int, width: int) -> Array:
    """(H, 1) of each row's texels [sr]."""
    edge = np.cos(pi * np.arange(height + 1) / height)
    return np.asarray(2 * pi / width * -np.diff(edge)[:, None])


def _negative(*shape: int) -> tuple[Array, ...]:
    """Arrays that no weights are."""
    found = []
    for wrong in (-1.0, nan):
        array = np.ones(shape, np.float32)
        array.flat[1] = wrong
        found.append(array)
    return tuple(found)


# ---------------------------------------------------------------- texel_weights


def _picture(draw: Draw) -> Array:
    return draw.lengths(0, 4, *_size(draw), 3)


def _power(a: Arguments, r: Array) -> tuple[Any, ...]:
    expected = a.image.mean(axis=2) * _solid_angles(*a.image.shape[:2])
    return r, expected


def _tall(draw: Draw) -> Mapping[str, Any]:
    """Many rows: the first and the last are a thousandth of those in the middle."""
    return {"image": draw.lengths(0.5, 4, 1000, 2, 3)}


TEXEL_WEIGHTS = function(
    "environment_light.texel_weights",
    {"image": Made(_picture, (*_negative(2, 3, 3), np.ones((2, 3, 4), np.float32)))},
    (
        close(
            "sphere",
            "A white picture's weights add up to the whole sphere",
            lambda _, r: (r.sum(), 4 * pi),
            "All directions together are 4 pi steradian.",
            what="a sum of",
            case=lambda d: {"image": np.ones((*_size(d), 3))},
        ),
        close(
            "poles",
            "Rows next to the poles have small texels, but not none",
            lambda a, r: (r, _power(a, r)[1], _power(a, r)[1]),
            "A row lies between two angles; what it covers is the difference of their cosines.",
            what="a weight of",
            within=400,
            case=_tall,
        ),
        close(
            "values",
            "Weights are radiance times solid angle",
            _power,
            "The mean of three channels, and how much of the sphere does a texel of this row cover?",
            what="a weight of",
            scales=SCALES,
            whole=True,
        ),
    ),
    columns=False,
    scales=SCALES,
    speed=0,
)

# ---------------------------------------------------------------- cumulate


def _shares(weights: Array) -> tuple[Array, Array]:
    """Rows (H,) and columns (H, W), cumulated."""
    of_rows = weights.sum(axis=1)
    filled = np.where(of_rows[:, None] > 0, weights, 1)
    rows, columns = np.cumsum(of_rows), np.cumsum(filled, axis=1)
    return np.divide(rows, rows[-1]), np.divide(columns, columns[:, -1:])


def _none_for_black_texels(a: Arguments, r: Any) -> Array:
    """How much black rows, and black texels of other rows, add to the sums."""
    rows = np.where(a.weights.any(axis=1), 0, np.diff(r[0], prepend=0))
    columns = np.diff(r[1], prepend=0, axis=1)
    black = a.weights.any(axis=1)[:, None] & (a.weights == 0)
    return np.concatenate((rows, columns[black]))


def _dark_sky(draw: Draw) -> Mapping[str, Any]:
    """Weights with black texels in all rows, at both ends of some, and a black row."""
    weights = draw.lengths(0.2, 2, 5, 6)
    weights[:, 1::3] = weights[1, 0] = weights[3, -1] = 0
    weights[int(draw.rng.integers(5))] = 0
    return {"weights": weights}


def _ends(_: Arguments, r: Any) -> Array:
    return np.array([r[0][-1] == 1, *(r[1][:, -1] == 1)])


def _black_row(draw: Draw) -> Mapping[str, Any]:
    weights = draw.lengths(0.2, 2, 4, 5)
    weights[int(draw.rng.integers(4))] = 0
    return {"weights": weights}


def _many(draw: Draw) -> Mapping[str, Any]:
    """So many texels that single precision loses some of them."""
    return {"weights": draw.lengths(0.9, 1.1, 3, 200_000)}


CUMULATE = function(
    "environment_light.cumulate",
    {"weights": Made(_weights, (*_negative(2, 3), np.zeros((2, 3), np.float32)))},
    (
        holds(
            "ends",
            "The last sums are exactly 1",
            _ends,
            "the last of the rows and of each row's columns to be 1",
            "A number next to 1 finds no texel behind a sum that rounding has left below 1.",
            shows=lambda _, r: np.array([r[0][-1], *r[1][:, -1]]),
            n=1,
        ),
        close(
            "black_row",
            "A row without weight counts its texels alike",
            lambda a, r: (r[1], _shares(a.weights)[1]),
            "It is never chosen, but it must not hold 0 / 0.",
            what="a column's sum of",
            case=_black_row,
        ),
        close(
            "black",
            "A row without weight adds nothing, and neither does such a texel in another row",
            lambda a, r: (_none_for_black_texels(a, r), 0.0),
            "What is added to weights, so that no sum is 0, is drawn where nothing is.",
            what="a step of",
            within=0,
            floor=1e-14,
            case=_dark_sky,
            scales=(1.0, 1e-6),
        ),
        close(
            "faint",
            "Shares of a dark picture are those of a bright one",
            lambda a, r: tuple(
                np.concatenate((x[0], x[1].ravel())) for x in (r, _shares(a.weights))
            ),
            "Only a sum of 0 can't be divided by.",
            what="of a dark picture, a sum of",
            scales=FAINT,
        ),
        close(
            "many",
            "Sums of many small weights lose none of them",
            lambda a, r: (r[1], _shares(a.weights)[1]),
            "A sum of single precision swallows small summands.",
            what="a column's sum of",
            floor=1e-9,
            case=_many,
        ),
        close(
            "values",
            "Both are cumulative shares",
            lambda a, r: tuple(
                np.concatenate((x[0], x[1].ravel())) for x in (r, _shares(a.weights))
            ),
            "Each row has a distribution of its own, and the rows have one together.",
            what="a sum of",
            scales=SCALES,
            whole=True,
        ),
        close(
            "rows",
            "Rows are cumulative shares of the whole",
            lambda a, r: (r[0], _shares(a.weights)[0]),
            what="a row's sum of",
            scales=SCALES,
            role="core",
        ),
        close(
            "columns",
            "Columns are cumulative shares of their row",
            lambda a, r: (r[1], _shares(a.weights)[1]),
            "Each row has a distribution of its own.",
            what="a column's sum of",
            scales=SCALES,
            role="core",
        ),
    ),
    columns=False,
    scales=SCALES,
    speed=0,
)

# ---------------------------------------------------------------- sample_direction


def _inverted(draw: Draw) -> Mapping[str, Any]:
    """Distributions as cumulate gives them, and any numbers."""
    rows, columns = _shares(_weights(draw))
    return {"rows": rows, "columns": columns}


def _inside(draw: Draw) -> Mapping[str, Any]:
    """Numbers that choose a texel, and lie within it."""
    return _inside_of(_weights(draw), draw)


def _inside_dim(draw: Draw) -> Mapping[str, Any]:
    """The same in a picture of a high dynamic range."""
    height, width = _size(draw)
    rows, columns = (_unlike(count, draw) for count in (height, width))
    return _inside_of(rows[:, None] * columns, draw)


def _unlike(count: int, draw: Draw) -> Array:
    """Numbers from 3e-8 to 1, in any order."""
    return np.asarray(10 ** -draw.rng.permutation(np.linspace(0, 7.5, count)))


def _inside_of(weights: Array, draw: Draw) -> Mapping[str, Any]:
    rows, columns = _shares(weights)
    texel = draw.rng.choice(np.flatnonzero(weights), draw.n)
    row, column = np.divmod(texel, weights.shape[1])
    place = INSIDE + (1 - 2 * INSIDE) * draw.rng.random((2, draw.n))
    low = np.concatenate(([0], rows))[row]
    left = np.concatenate((np.zeros((len(rows), 1)), columns), axis=1)[row, column]
    return {
        "rows": rows,
        "columns": columns,
        "u": np.stack(
            (low + place[0] * (rows[row] - low), left + place[1] * (columns[row, column] - left))
        ),
    }


def _texel(a: Arguments, u: Array) -> tuple[Array, Array]:
    """Row and column (N,) that the numbers choose."""
    row = np.searchsorted(a.rows, u[0], side="right")
    column = (a.columns[row] <= u[1][:, None]).sum(axis=1)
    return row, np.minimum(column, a.columns.shape[1] - 1)


def _expected(a: Arguments) -> Array:
    """The directions in float64."""
    height, width = a.columns.shape
    row, column = _texel(a, a.u)
    low = np.concatenate(([0], a.rows))[row]
    left = np.concatenate((np.zeros((height, 1)), a.columns), axis=1)[row, column]
    down = (a.u[0] - low) / (a.rows[row] - low)
    along = (a.u[1] - left) / (a.columns[row, column] - left)
    edge = np.cos(pi * np.arange(height + 1) / height)
    y = edge[row] + down * (edge[row + 1] - edge[row])
    phi = 2 * pi * ((column + along) / width - 0.5)
    ring = np.sqrt(1 - y * y)
    return np.stack((ring * np.sin(phi), y, -ring * np.cos(phi)))


def _cumulated(a: Arguments, r: Array) -> Array:
    """The numbers that the directions come from: uniform, where their density is right."""
    height, width = a.columns.shape
    x, y, z = r
    edge = np.cos(pi * np.arange(height + 1) / height)
    row = np.clip(np.searchsorted(-edge, -y, side="right") - 1, 0, height - 1)
    place = (np.arctan2(x, -z) / (2 * pi) + 0.5) * width
    column = np.clip(place.astype(np.intp), 0, width - 1)
    low = np.concatenate(([0], a.rows))[row]
    left = np.concatenate((np.zeros((height, 1)), a.columns), axis=1)[row, column]
    down = (edge[row] - y) / (edge[row] - edge[row + 1])
    return np.stack(
        (
            low + down * (a.rows[row] - low),
            left + (place - column) * (a.columns[row, column] - left),
        )
    )


def _bright(a: Arguments, r: Array) -> Array:
    """True for directions in texels that have weight, or at the border of one."""
    height, width = a.columns.shape
    row = np.arctan2(np.hypot(r[0], r[2]), r[1]) / pi * height
    column = (np.arctan2(r[0], -r[2]) / (2 * pi) + 0.5) * width
    step = np.diff(np.concatenate((np.zeros((height, 1)), a.columns), axis=1), axis=1)
    weight = step * np.diff(a.rows, prepend=0)[:, None]
    # A pole has a row on one side only; the first column is next to the last.
    sides = [
        weight[
            np.clip(np.floor(row + down).astype(np.intp), 0, height - 1),
            np.floor(column + right).astype(np.intp) % width,
        ]
        for down, right in product((-1e-3, 1e-3), repeat=2)
    ]
    return np.asarray(np.max(sides, axis=0) > 0)


def _borders(draw: Draw) -> Mapping[str, Any]:
    """Numbers that are sums themselves, and 0: the texel behind them counts."""
    bright = ([0, 0, 1, 3, 0, 0], [0, 2, 0, 2, 0, 0])
    rows, columns = _shares(np.array([6 * [0], bright[0], 6 * [0], bright[1]], float))
    return {"rows": rows, "columns": columns, "u": draw.rng.choice([0.0, 0.25, 0.5], (2, draw.n))}


CUMULATED = Made(batch=False)

SAMPLE_DIRECTION = function(
    "environment_light.sample_direction",
    {"rows": CUMULATED, "columns": CUMULATED},
    (
        unit_length(),
        holds(
            "black",
            "No direction lies in a texel without weight",
            _bright,
            "a direction in a texel that has weight",
            "A number that is equal to a sum belongs to the texel behind it.",
            case=_borders,
        ),
        close(
            "texel",
            "Directions lie in the texel that their numbers choose",
            lambda a, r: (r, _expected(a)),
            "u[0] chooses the row, u[1] the column; what is left of each says where in the texel.",
            floor=2e-5,
            case=_inside,
            whole=True,
        ),
        close(
            "dim",
            "In dim texels directions lie where their numbers say, too",
            lambda a, r: (r, _expected(a)),
            "A dim texel's share of [0, 1) is small; what is left of a number is divided by it all the same.",
            floor=1e-3,
            case=_inside_dim,
            dtypes=(np.float64,),
        ),
        uniform(
            "density",
            "Directions are as dense as the picture is bright",
            _cumulated,
            (16, 16),
            "Within a texel all directions are alike: along y, not along the angle.",
            what="shares above and to the left of the directions",
            draws=2,
            picture=lambda _, r: r[::2],
        ),
    ),
    case=_inverted,
    scales=(),
)

# ---------------------------------------------------------------- density


def _in_texels(draw: Draw) -> Mapping[str, Any]:
    """Directions within texels of weights, black ones too."""
    weights = _weights(draw)
    height, width = np.shape(weights)
    row, column = draw.rng.integers(0, height, draw.n), draw.rng.integers(0, width, draw.n)
    place = INSIDE + (1 - 2 * INSIDE) * draw.rng.random((2, draw.n))
    theta, phi = pi * (row + place[0]) / height, 2 * pi * ((column + place[1]) / width - 0.5)
    direction = (np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi))
    return {"weights": weights, "direction": np.stack(direction)}


def _dense(a: Arguments, r: Array) -> tuple[Any, ...]:
    height, width = a.weights.shape
    x, y, z = a.direction
    row = np.minimum((np.arctan2(np.hypot(x, z), y) / pi * height).astype(np.intp), height - 1)
    column = np.minimum(((np.arctan2(x, -z) / (2 * pi) + 0.5) * width).astype(np.intp), width - 1)
    angle = _solid_angles(height, width)[row, 0]
    return r, a.weights[row, column] / a.weights.sum() / angle


def _at_poles(draw: Draw) -> Mapping[str, Any]:
    """Straight up and down, where the column doesn't matter."""
    weights = np.repeat(draw.uniform(0.2, 2, 5, 1), 4, axis=1)
    return {"weights": weights, "direction": np.array([[0.0, 0], [1, -1], [0, 0]])}


def _poles(a: Arguments, r: Array) -> tuple[Any, ...]:
    angle = _solid_angles(*a.weights.shape)
    return r, (a.weights / a.weights.sum() / angle)[[0, -1], 0]


DENSITY = function(
    "environment_light.density",
    {
        "weights": replace(
            Made(_weights, (*_negative(2, 3), np.zeros((2, 3), np.float32))), batch=False
        )
    },
    (
        close(
            "poles",
            "At the poles the density is that of the first and the last row",
            _poles,
            "The last row ends at -y, and no row comes after it.",
            what="a density of",
            case=_at_poles,
        ),
        close(
            "faint",
            "Densities of a dark picture are those of a bright one",
            _dense,
            "The sum of the weights may be small: they are not all 0.",
            what="of a dark picture, a density of",
            within=64,
            case=_in_texels,
            scales=FAINT,
        ),
        close(
            "values",
            "The density is the texel's share of the weights over its solid angle",
            _dense,
            "Its integral over all directions is 1.",
            what="a density of",
            within=64,
            case=_in_texels,
            scales=SCALES,
            whole=True,
        ),
    ),
    case=lambda d: {"weights": _weights(d), "direction": d.directions()},
    scales=SCALES,
)

# ---------------------------------------------------------------- alias tables


def _several(draw: Draw) -> Array:
    """Weights (K,) with some that are 0 and one that is large."""
    weights = draw.lengths(0.1, 2, 4 if draw.simple else int(draw.rng.integers(1, 40)))
    weights[draw.rng.random(weights.shape) < 0.2] = 0
    weights[int(draw.rng.integers(weights.size))] = 9 * draw.scale
    return weights


def _given(probability: Array, alias: Array) -> Array:
    """What each outcome gets of all columns, (K,)."""
    own = probability.copy()
    np.add.at(own, np.clip(alias, 0, len(own) - 1).astype(np.intp), 1 - probability)
    return np.asarray(own / len(own))


def _legal(a: Arguments, r: Any) -> Array:
    probability, alias = r
    return np.asarray(
        (probability >= 0) & (probability <= 1) & (alias >= 0) & (alias < len(a.weights))
    )


def _none_for_black(a: Arguments, r: Any) -> Array:
    return np.asarray((a.weights > 0) | (_given(*r) == 0))


ALIAS_TABLE = function(
    "environment_light.alias_table",
    {"weights": Made(_several, (*_negative(4), np.zeros(4, np.float32)))},
    (
        holds(
            "legal",
            "Probabilities lie from 0 to 1, and aliases are outcomes",
            _legal,
            "a probability from 0 to 1 and an alias from 0 to K - 1",
            shows=lambda _, r: r[0],
            scales=SCALES,
        ),
        holds(
            "black",
            "Outcomes without weight get nothing at all",
            _none_for_black,
            "a share of 0",
            "Rounding may leave such a column over at the end.",
            shows=lambda _, r: _given(*r),
            scales=SCALES * 4,
        ),
        close(
            "faint",
            "Small weights are shared out as large ones are",
            lambda a, r: (_given(*r), a.weights / a.weights.sum()),
            "Only a sum of 0 can't be divided by.",
            what="of small weights, a share of",
            scales=FAINT,
        ),
        close(
            "shares",
            "Each outcome gets its share of the weights",
            lambda a, r: (_given(*r), a.weights / a.weights.sum()),
            "A column is as high as the mean weight: what an outcome has above that fills the columns of others.",
            what="a share of",
            scales=SCALES,
            whole=True,
        ),
    ),
    columns=False,
    unique=False,
    scales=SCALES,
    speed=0,
)


def _table(draw: Draw) -> tuple[Array, Array]:
    count = 4 if draw.simple else int(draw.rng.integers(2, 90))
    probability = draw.uniform(0.1, 0.9, count)
    probability[draw.rng.random(count) < 0.2] = 1
    return probability, draw.rng.permutation(count)


def _any_table(draw: Draw) -> Mapping[str, Any]:
    probability, alias = _table(draw)
    return {"probability": probability, "alias": alias}


def _within_parts(draw: Draw) -> Mapping[str, Any]:
    """Numbers within a column's two parts."""
    return _parts_of(*_table(draw), draw)


def _narrow_parts(draw: Draw) -> Mapping[str, Any]:
    """The same in columns of which one of the two has hardly any."""
    _, alias = _table(draw)
    small = 0.1 * _unlike(len(alias), draw)
    return _parts_of(np.where(np.arange(len(alias)) % 2 == 0, small, 1 - small), alias, draw)


def _parts_of(probability: Array, alias: Array, draw: Draw) -> Mapping[str, Any]:
    column = draw.rng.integers(0, len(alias), draw.n)
    own, kept = probability[column], draw.rng.random(draw.n) < 0.5
    kept |= own == 1
    place = INSIDE + (1 - 2 * INSIDE) * draw.rng.random(draw.n)
    fraction = np.where(kept, place * own, own + place * (1 - own))
    return {"probability": probability, "alias": alias, "u": (column + fraction) / len(alias)}


def _drawn(a: Arguments) -> tuple[Array, Array]:
    """Outcomes and what is left of the numbers, in float64."""
    place = a.u * len(a.alias)
    column = np.minimum(place.astype(np.intp), len(a.alias) - 1)
    fraction, own = place - column, a.probability[column]
    kept = fraction < own
    rest = np.where(kept, fraction / own, (fraction - own) / np.where(kept, 1, 1 - own))
    return np.where(kept, column, a.alias[column]), rest


def _never(draw: Draw) -> Mapping[str, Any]:
    """Columns that keep nothing, and numbers at their beginnings."""
    return {
        "probability": np.array([0.0, 1, 0, 1]),
        "alias": np.array([1, 1, 3, 3]),
        "u": draw.rng.choice([0.0, 0.25, 0.5, 0.75], draw.n),
    }


DRAW_ALIAS = function(
    "environment_light.draw_alias",
    {"probability": CUMULATED, "alias": Made()},
    (
        holds(
            "black",
            "An outcome of probability 0 is never drawn, not even at a column's beginning",
            lambda _, r: (r[0] == 1) | (r[0] == 3),
            "outcome 1 or 3",
            "A fraction that is equal to the probability belongs to the alias.",
            shows=lambda _, r: r[0],
            case=_never,
        ),
        holds(
            "whole",
            "What is left of a number lies from 0 to 1",
            lambda _, r: (r[1] >= 0) & (r[1] <= 1),
            "a number from 0 to 1",
            shows=lambda _, r: r[1],
        ),
        close(
            "narrow",
            "Narrow parts of a column are stretched, too",
            lambda a, r: (np.stack(r), np.stack(_drawn(a)), 1.0),
            "Only a part of width 0 can't be divided by, and nothing lies in it.",
            what="an outcome or a rest of",
            floor=2e-3,
            case=_narrow_parts,
            dtypes=(np.float64,),
        ),
        close(
            "rest",
            "What is left says where in its part of the column the number lies",
            lambda a, r: (r[1], _drawn(a)[1], 1.0),
            "Each part of a column is stretched to [0, 1).",
            what="a rest of",
            floor=2e-3,
            case=_within_parts,
            role="core",
        ),
        close(
            "values",
            "Outcomes and what is left of the numbers are right together",
            lambda a, r: (np.stack(r), np.stack(_drawn(a)), 1.0),
            "K u says the column, and its fraction the outcome.",
            what="an outcome or a rest of",
            floor=2e-3,
            case=_within_parts,
            whole=True,
        ),
        holds(
            "outcome",
            "Outcomes are those of the column and its fraction",
            lambda a, r: r[0] == _drawn(a)[0],
            "the column's own outcome below its probability, and its alias above",
            shows=lambda _, r: r[0],
            case=_within_parts,
            role="core",
        ),
    ),
    case=_any_table,
    scales=(),
)

FUNCTIONS = (TEXEL_WEIGHTS, CUMULATE, SAMPLE_DIRECTION, DENSITY, ALIAS_TABLE, DRAW_ALIAS)
