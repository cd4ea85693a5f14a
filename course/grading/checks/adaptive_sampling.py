"""Checks of adaptive_sampling: which cells are divided, and into what.

Colours and thresholds are multiples of a power of two, so that differences are exact in any precision, and one just
above the threshold can be told from the threshold itself.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    contract_checks,
)

STEP = 2.0**-10
"""Between two neighbouring colours."""

NAMES = ("x0", "y0", "x1", "y1")

Cells = tuple[Array, Array, Array, Array]
"""x0, y0, x1, y1."""


# ---------------------------------------------------------------- needs_subdivision


def _colors(rng: np.random.Generator, n: int, dtype: Any = np.float32) -> Array:
    return (rng.integers(0, 1024, (3, 4, n)) * STEP).astype(dtype)


def _contrast(corners: Array) -> Array:
    """The largest difference of two corners, pair by pair."""
    c = corners.astype(np.float64)
    return np.asarray(
        np.max(
            [np.abs(c[:, i] - c[:, j]).max(axis=0) for i, j in combinations(range(4), 2)], axis=0
        )
    )


def _decisions(trial: Trial, corners: Array, threshold: float) -> Array:
    value = trial.call(corners.copy(), threshold)
    return check_array(value, corners.shape[2:], np.bool_, "the decisions")


def _check_decisions(
    trial: Trial, corners: Array, threshold: float, expected: Array, hint: str
) -> None:
    found = _decisions(trial, corners, threshold)
    wrong = np.flatnonzero(found != expected)
    if wrong.size:
        k = int(wrong[0])
        raise Failure(
            f"{bool(expected[k])} where the largest difference is {_contrast(corners)[k]:.6g} "
            f"and the threshold {threshold:.6g}",
            f"{bool(found[k])}",
            "corners of red ({}), of green ({}), of blue ({})".format(
                *(", ".join(f"{x:.6g}" for x in row) for row in corners[:, :, k].tolist())
            )
            + f"; {wrong.size} of {found.size} cells",
            hint,
        )


def _needs_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        corners = _colors(trial.rng, 40, dtype)
        for threshold in (0.0, 0.5, np.float64(0.25), 1e30, np.inf):
            for n in (40, 1, 0):
                value = trial.call(corners[:, :, :n].copy(), threshold)
                check_array(value, (n,), np.bool_, "the decisions")


def _needs_untouched(trial: Trial) -> None:
    check_untouched(trial, _colors(trial.rng, 40), 0.5)


def _needs_refuses(trial: Trial) -> None:
    corners = _colors(trial.rng, 5)
    for bad in (corners[:2], corners[:, :3], corners[:, :, 0], np.moveaxis(corners, 2, 0)):
        check_refused(trial, bad, 0.5, named="corners")
    for wrong in (-0.5, -1e-9, float("nan")):
        check_refused(trial, corners, wrong, named=f"threshold {wrong}")


def _needs_any(trial: Trial) -> None:
    for dtype in DTYPES:
        corners = _colors(trial.rng, 2000, dtype)
        threshold = float(trial.rng.integers(600, 950)) * STEP
        _check_decisions(
            trial,
            corners,
            threshold,
            _contrast(corners) > threshold,
            "Any two corners, in any channel, are enough.",
        )


def _pairs_and_channels(rng: np.random.Generator, difference: float) -> Array:
    """Plain cells of which two corners differ by that in one channel: each pair, each channel, both signs."""
    cells = []
    for channel in range(3):
        for i, j in combinations(range(4), 2):
            for sign in (1, -1):
                cell = np.empty((3, 4))
                cell[:] = rng.integers(300, 600, (3, 1)) * STEP
                # Half up and half down, so that the pair's difference is the cell's largest.
                half = np.floor(difference / STEP / 2) * STEP
                cell[channel, i] += sign * half
                cell[channel, j] -= sign * (difference - half)
                cells.append(cell)
    return np.stack(cells, axis=2).astype(np.float32)


def _needs_threshold(trial: Trial) -> None:
    threshold = float(trial.rng.integers(20, 200)) * STEP
    for steps, expected in ((-1, False), (0, False), (1, True)):
        corners = _pairs_and_channels(trial.rng, threshold + steps * STEP)
        _check_decisions(
            trial,
            corners,
            threshold,
            np.full(corners.shape[2], expected),
            "A difference has to be over the threshold: as large is not enough.",
        )


def _needs_plain(trial: Trial) -> None:
    plain = np.repeat(_colors(trial.rng, 200)[:, :1], 4, axis=1)
    _check_decisions(
        trial,
        plain,
        0.0,
        np.zeros(200, bool),
        "Cells of one colour are smooth; red need not be as bright as green.",
    )
    one = plain.copy()
    one[trial.rng.integers(0, 3, 200), trial.rng.integers(0, 4, 200), np.arange(200)] += STEP
    _check_decisions(
        trial, one, 0.0, np.ones(200, bool), "With threshold 0 the smallest difference counts."
    )


def _needs_bright(trial: Trial) -> None:
    """High dynamic range: colours far over 1, darker than 0, and cells that are nothing to each other."""
    corners = _colors(trial.rng, 300) * np.float32(64)
    corners[:, :, 100:] = np.repeat(corners[:, :1, 100:], 4, axis=1)
    corners[0, 2, 200:] -= np.float32(100)
    threshold = 16.0
    _check_decisions(
        trial,
        corners,
        threshold,
        _contrast(corners) > threshold,
        "Radiance may be larger than 1; each cell is decided on its own.",
    )


# ---------------------------------------------------------------- subdivide


def _cells(rng: np.random.Generator, n: int, dtype: Any = np.float32) -> Cells:
    """Cells of any place and size, some without width."""
    x0, y0 = rng.uniform(-100, 100, (2, n))
    width, height = 10.0 ** rng.uniform(-3, 2, (2, n))
    width[::17] = 0
    x0, y0, x1, y1 = (v.astype(dtype) for v in (x0, y0, x0 + width, y0 + height))
    return x0, y0, x1, y1


def _four(value: Any) -> list[Any]:
    if not isinstance(value, tuple | list) or len(value) != 4:
        raise Failure("four arrays: x0, y0, x1, y1", type(value).__name__)
    return list(value)


def _children(trial: Trial, cells: Cells) -> Cells:
    """The student's, as float64 numbers (4, n), whatever their dtype: that is the contract's check."""
    value = _four(trial.call(*(v.copy() for v in cells)))
    children = []
    for name, array in zip(NAMES, value, strict=True):
        dtype = getattr(array, "dtype", np.dtype(float))
        if dtype.kind not in "fiu":
            raise Failure(f"{name} to be floating", f"dtype {dtype}")
        found = check_array(array, (4, cells[0].size), dtype, name)
        children.append(found.astype(np.float64))
    x0, y0, x1, y1 = children
    return x0, y0, x1, y1


def _subdivide_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        cells = _cells(trial.rng, 40, dtype)
        for n in (40, 1, 0):
            for name, array in zip(
                NAMES, _four(trial.call(*(v[:n].copy() for v in cells))), strict=True
            ):
                check_array(array, (4, n), dtype, name)
    for k in range(4):
        mixed = [v.astype(np.float64 if i == k else np.float32) for i, v in enumerate(cells)]
        for name, array in zip(NAMES, _four(trial.call(*mixed)), strict=True):
            check_array(array, (4, 40), np.float64, f"{name} of float32 and float64 cells")


def _subdivide_untouched(trial: Trial) -> None:
    check_untouched(trial, *_cells(trial.rng, 40))


def _subdivide_refuses(trial: Trial) -> None:
    cells = _cells(trial.rng, 5)
    for k, name in enumerate(NAMES):
        for bad in (cells[k][:4], cells[k][None], cells[k][0]):
            wrong = [bad if i == k else v for i, v in enumerate(cells)]
            check_refused(trial, *wrong, named=name)


def _subdivide_outside(trial: Trial) -> None:
    for dtype in DTYPES:
        cells = _cells(trial.rng, 1000, dtype)
        children = _children(trial, cells)
        say = at(**dict(zip(NAMES, cells, strict=True)))
        for name, of_children, of_cell, nearest in zip(
            NAMES, children, cells, (np.min, np.min, np.max, np.max), strict=True
        ):
            check_close(
                nearest(of_children, axis=0),
                of_cell,
                0.0,
                f"the children's outermost {name}, bit for bit the cell's:",
                say,
                "The children cover their cell exactly.",
            )


def _subdivide_shared(trial: Trial) -> None:
    """On each axis the children have three different numbers, however they are ordered."""
    for dtype in DTYPES:
        cells = _cells(trial.rng, 1000, dtype)
        x0, y0, x1, y1 = _children(trial, cells)
        say = at(**dict(zip(NAMES, cells, strict=True)))
        for axis, low, high in (("x", x0, x1), ("y", y0, y1)):
            check_close(
                np.sort(low, axis=0)[2:],
                np.sort(high, axis=0)[:2],
                0.0,
                f"the edge in the middle of {axis}, bit for bit the same for all four children:",
                say,
                "Shared corners are the same numbers, so that one ray serves all.",
            )


def _subdivide_halves(trial: Trial) -> None:
    for dtype, tolerance in ((np.float32, 3e-5), (np.float64, 1e-12)):
        cells = _cells(trial.rng, 1000, dtype)
        x0, y0, x1, y1 = _children(trial, cells)
        say = at(**dict(zip(NAMES, cells, strict=True)))
        exact = [v.astype(np.float64) for v in cells]
        for axis, low, high, first, last in (
            ("x", x0, x1, exact[0], exact[2]),
            ("y", y0, y1, exact[1], exact[3]),
        ):
            for what, edge in (("begins", np.sort(low, axis=0)[2]), ("ends", np.sort(high, 0)[0])):
                check_close(
                    edge,
                    first + (last - first) / 2,
                    tolerance,
                    f"where the half of a cell in {axis} {what}, its middle:",
                    say,
                    "A cell is divided in the middle of both sides.",
                )


CORNERS = ("lower x, lower y", "upper x, lower y", "lower x, upper y", "upper x, upper y")


def _quarters(cells: Cells) -> Array:
    """(4, 4, n): x0, y0, x1, y1 of the four children, from the middles."""
    x0, y0, x1, y1 = (v.astype(np.float64) for v in cells)
    x, y = x0 + (x1 - x0) / 2, y0 + (y1 - y0) / 2
    quarters = [(x0, y0, x, y), (x, y0, x1, y), (x0, y, x, y1), (x, y, x1, y1)]
    return np.stack([np.stack(q) for q in quarters], axis=1)


def _subdivide_order(trial: Trial) -> None:
    cells = _cells(trial.rng, 500, np.float64)
    found, expected = np.stack(_children(trial, cells)), _quarters(cells)
    say = at(**dict(zip(NAMES, cells, strict=True)))
    for child, name in enumerate(CORNERS):
        for number, array in zip(NAMES, range(4), strict=True):
            check_close(
                found[array, child],
                expected[array, child],
                1e-12,
                f"{number} of child {child} ({name}):",
                say,
                "Row by row, x fastest: the children's order tells which corners they share.",
            )


def _subdivide_area(trial: Trial) -> None:
    """No gap, no overlap: every point of a cell is in one child."""
    n = 500
    x0, y0 = trial.rng.uniform(-1, 1, (2, n))
    cells = (x0, y0, x0 + trial.rng.uniform(0.1, 2, n), y0 + trial.rng.uniform(0.1, 2, n))
    a, b, c, d = _children(trial, cells)
    u, v = trial.rng.random((2, n))
    # A cell's middle is its children's border.
    u, v = (w + np.where(np.abs(w - 0.5) < 1e-6, 1e-3, 0) for w in (u, v))
    x, y = x0 + u * (cells[2] - x0), y0 + v * (cells[3] - y0)
    inside = ((a <= x) & (x < c) & (b <= y) & (y < d)).sum(axis=0)
    wrong = np.flatnonzero(inside != 1)
    if wrong.size:
        k = int(wrong[0])
        raise Failure(
            "every point of a cell in one of its children",
            f"({x[k]:.6g}, {y[k]:.6g}) in {inside[k]}",
            at(**dict(zip(NAMES, cells, strict=True)))(k),
            "Four children, each a quarter of the area.",
        )


# ---------------------------------------------------------------- mistakes


def _decides(trial: Trial, model: Callable[[Array, float], Array]) -> bool:
    """The student decides as a mistake (corners, threshold) does, on cells of which it gets many wrong."""
    rng = trial.rng
    low, high = _colors(rng, 400).astype(np.float64), _pairs_and_channels(rng, 60 * STEP)
    for corners, threshold in ((low, 700 * STEP), (low, 0.5), (high.astype(np.float64), 50 * STEP)):
        expected = model(corners, threshold)
        if (_decisions(trial, corners, threshold) != expected).any():
            return False
    return True


def _or_equal(trial: Trial) -> bool:
    threshold = 50 * STEP
    same = _pairs_and_channels(trial.rng, threshold)
    more = _pairs_and_channels(trial.rng, threshold + STEP)
    less = _pairs_and_channels(trial.rng, threshold - STEP)
    return bool(
        _decisions(trial, same, threshold).all()
        and _decisions(trial, more, threshold).all()
        and not _decisions(trial, less, threshold).any()
    )


def _inverted(trial: Trial) -> bool:
    return _decides(trial, lambda c, t: _contrast(c) <= t)


def _adjacent_only(trial: Trial) -> bool:
    for order in ((0, 1, 2, 3), (0, 1, 3, 2), (0, 2, 1, 3)):

        def model(c: Array, t: float, order: tuple[int, ...] = order) -> Array:
            ring = c[:, list(order)]
            round_it = np.abs(ring - np.roll(ring, 1, axis=1)).max(axis=(0, 1))
            return np.asarray(round_it > t)

        if _decides(trial, model):
            return True
    return False


def _from_mean(trial: Trial) -> bool:
    return _decides(
        trial, lambda c, t: np.abs(c - c.mean(axis=1, keepdims=True)).max(axis=(0, 1)) > t
    )


def _from_first(trial: Trial) -> bool:
    return any(
        _decides(trial, lambda c, t, k=k: np.abs(c - c[:, k : k + 1]).max(axis=(0, 1)) > t)  # type: ignore[misc]
        for k in range(4)
    )


def _brightness(trial: Trial) -> bool:
    def spread(c: Array) -> Array:
        return np.asarray(c.max(axis=0) - c.min(axis=0))

    rec709 = np.array((0.2126, 0.7152, 0.0722))
    return any(
        _decides(trial, lambda c, t, m=m: spread(m(c)) > t)  # type: ignore[misc]
        for m in (
            lambda c: c.mean(axis=0),
            lambda c: c.sum(axis=0),
            lambda c: np.einsum("c,ckn->kn", rec709, c),
        )
    )


def _all_channels(trial: Trial) -> bool:
    return _decides(trial, lambda c, t: (c.max(axis=1) - c.min(axis=1)).min(axis=0) > t)


def _channels_mixed(trial: Trial) -> bool:
    return _decides(trial, lambda c, t: c.max(axis=(0, 1)) - c.min(axis=(0, 1)) > t)


def _one_for_all(trial: Trial) -> bool:
    corners = np.zeros((3, 4, 20))
    corners[1, 2, 7] = 1
    return bool(_decisions(trial, corners, 0.5).all())


def _relative(trial: Trial) -> bool:
    """As contrast, (max - min) / (max + min), which the threshold is not."""
    corners = 8 + _colors(trial.rng, 400).astype(np.float64)
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = _decisions(trial, corners, 0.05)
    models = ((high - low) / (high + low), (high - low) / high, (high - low) / low)
    return any(bool((found == (m.max(axis=0) > 0.05)).all()) for m in models)


def _children_are(trial: Trial, model: Callable[[Array], Array]) -> bool:
    """The children are those of a mistake, made from the right ones (4 numbers, 4 children, n)."""
    x0, y0 = trial.rng.uniform(-1, 1, (2, 100))
    cells = (x0, y0, x0 + trial.rng.uniform(0.5, 2, 100), y0 + trial.rng.uniform(0.5, 2, 100))
    found, expected = np.stack(_children(trial, cells)), model(_quarters(cells))
    return bool(np.abs(found - expected).max() < 1e-6)


def _columns_first(trial: Trial) -> bool:
    return _children_are(trial, lambda q: q[:, [0, 2, 1, 3]])


def _around(trial: Trial) -> bool:
    return any(
        _children_are(trial, lambda q, order=order: q[:, order])  # type: ignore[misc]
        for order in ([0, 1, 3, 2], [0, 2, 3, 1])
    )


def _bottom_up(trial: Trial) -> bool:
    return _children_are(trial, lambda q: q[:, [2, 3, 0, 1]])


def _sizes(trial: Trial) -> bool:
    def sizes(q: Array) -> Array:
        return np.concatenate((q[:2], q[2:] - q[:2]))

    return _children_are(trial, sizes)


def _half_of_the_end(trial: Trial) -> bool:
    """The middle taken for half of the cell's end, or of its size: right only for cells that begin at 0."""
    x0, y0 = trial.rng.uniform(-1, 1, (2, 100))
    x1, y1 = x0 + trial.rng.uniform(0.5, 2, 100), y0 + trial.rng.uniform(0.5, 2, 100)
    low, _, _, _ = _children(trial, (x0, y0, x1, y1))
    middle = low[1]
    return bool(np.abs(middle - x1 / 2).max() < 1e-6 or np.abs(middle - (x1 - x0) / 2).max() < 1e-6)


# ---------------------------------------------------------------- all of them


CHECKS = ModuleChecks(
    "adaptive_sampling",
    checks=(
        *contract_checks("needs_subdivision", _needs_contract, _needs_untouched, _needs_refuses),
        Check(
            "needs_subdivision",
            "any",
            "Cells are divided where the largest difference is over the threshold",
            _needs_any,
        ),
        Check(
            "needs_subdivision",
            "threshold",
            "Every pair of corners counts in every channel, just above the threshold and not at it",
            _needs_threshold,
        ),
        Check("needs_subdivision", "plain", "Cells of one colour are left alone", _needs_plain),
        Check("needs_subdivision", "bright", "Radiance may have any size and sign", _needs_bright),
        *contract_checks(
            "subdivide", _subdivide_contract, _subdivide_untouched, _subdivide_refuses
        ),
        Check(
            "subdivide",
            "outside",
            "The children's outer edges are the cell's, bit for bit",
            _subdivide_outside,
        ),
        Check(
            "subdivide",
            "shared",
            "The edges that children share are equal bit for bit",
            _subdivide_shared,
        ),
        Check("subdivide", "halves", "Cells are divided in their middle", _subdivide_halves),
        Check("subdivide", "order", "The children come row by row, x fastest", _subdivide_order),
        Check(
            "subdivide",
            "area",
            "The children cover the cell without gap or overlap",
            _subdivide_area,
        ),
    ),
    mistakes=(
        Mistake(
            "needs_subdivision",
            "or-equal",
            "You divide cells whose difference is the threshold itself; it has to be over it.",
            _or_equal,
        ),
        Mistake(
            "needs_subdivision",
            "inverted",
            "You divide the smooth cells and leave the others.",
            _inverted,
        ),
        Mistake(
            "needs_subdivision",
            "adjacent-only",
            "You compare corners along the cell's sides only; an edge may run between the other two.",
            _adjacent_only,
        ),
        Mistake(
            "needs_subdivision",
            "from-mean",
            "You compare the corners with their mean; it is the difference of two corners that counts.",
            _from_mean,
        ),
        Mistake(
            "needs_subdivision",
            "from-first",
            "You compare all corners with one of them; the other pairs may differ more.",
            _from_first,
        ),
        Mistake(
            "needs_subdivision",
            "brightness",
            "You compare brightnesses; red beside green of the same brightness is an edge too.",
            _brightness,
        ),
        Mistake(
            "needs_subdivision",
            "all-channels",
            "You divide where all channels differ; one is enough.",
            _all_channels,
        ),
        Mistake(
            "needs_subdivision",
            "channels-mixed",
            "You compare one channel with another: a plain red cell is smooth.",
            _channels_mixed,
        ),
        Mistake(
            "needs_subdivision",
            "one-for-all",
            "One cell with an edge makes you divide all of them; each is decided on its own.",
            _one_for_all,
        ),
        Mistake(
            "needs_subdivision",
            "relative",
            "You compare ratios; the threshold is for the difference itself.",
            _relative,
        ),
        Mistake(
            "subdivide",
            "columns-first",
            "Your children are right, but come column by column: x has to run fastest.",
            _columns_first,
        ),
        Mistake(
            "subdivide",
            "around",
            "Your children are right, but go around the cell: they have to come row by row.",
            _around,
        ),
        Mistake(
            "subdivide",
            "bottom-up",
            "Your children are right, but those of the upper y come first.",
            _bottom_up,
        ),
        Mistake(
            "subdivide",
            "sizes",
            "You return widths and heights; x1 and y1 are where a child ends.",
            _sizes,
        ),
        Mistake(
            "subdivide",
            "half-of-the-end",
            "Your middle is right only for cells that begin at 0.",
            _half_of_the_end,
        ),
    ),
)
