"""Two pictures and where they differ: side by side, the signed difference, the difference over the noise, the worst
region enlarged.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats64
from course.formats.pictures.srgb import linear_to_srgb8
from course.grading.checks.check import Array, Figure
from course.grading.reports.panels import Drawing, NotDrawable, Panel, Scale, numbers

WORST = 12
"""Pixels across the enlarged region."""

LARGEST = 256
"""Pixels of the longer side that are drawn; of larger pictures every second, third, ... pixel."""

NOISE_LIMIT = 5.0
"""Where the colours of the difference over the noise end."""

BROKEN = (255, 0, 255)
"""sRGB of pixels that are NaN or infinite."""

# sRGB; blue for less and red for more is told apart with any colour vision.
_DIVERGING = np.array(
    [(5, 48, 97), (67, 147, 195), (247, 247, 247), (214, 96, 77), (103, 0, 31)], np.float64
)


def draw_pictures(figure: Figure) -> Drawing:
    """Draw ``yours`` beside ``expected``.

    Parameters
    ----------
    figure : its arrays are (3, H, W) linear RGB; ``noise``, if there, is the standard deviation of each value,
        (3, H, W) or (H, W)

    Raises
    ------
    NotDrawable
        Neither of the two is a picture.
    """
    pictures: dict[str, Floats64] = {}
    notes: list[str] = []
    for name, label in (("expected", "The reference"), ("yours", "Yours")):
        if name in figure.arrays:
            try:
                pictures[name], told = _picture(figure.arrays[name], label)
                notes += told
            except NotDrawable as reason:
                notes.append(f"{reason}.")
    if not pictures:
        raise NotDrawable(" ".join(notes).rstrip(".") or "there is no picture")
    panels = [
        _plain(pictures[name], title)
        for name, title in (("expected", "Reference"), ("yours", "Yours"))
        if name in pictures
    ]
    if len(pictures) == 2:
        yours, expected = pictures["yours"], pictures["expected"]
        if yours.shape != expected.shape:
            notes.insert(
                0,
                f"The sizes differ: yours is {_size(yours)} pixels, the reference {_size(expected)} "
                "(width × height). So there is no difference to show.",
            )
        else:
            panels += _compared(yours, expected, figure.arrays, notes)
    return Drawing(figure.title, tuple(panels), tuple(notes))


def _picture(array: Array, label: str) -> tuple[Floats64, list[str]]:
    """A (3, H, W) picture of whatever came, and what to say about it."""
    found = numbers(array, label)
    notes = []
    if found.ndim == 3 and found.shape[0] == 3:
        pass
    elif found.ndim == 3 and found.shape[2] == 3:
        notes.append(f"{label} has the shape {found.shape}, with the colours last, not first.")
        found = np.moveaxis(found, 2, 0)
    elif found.ndim == 2:
        notes.append(f"{label} has the shape {found.shape}, one number a pixel, and is shown grey.")
        found = np.broadcast_to(found, (3, *found.shape))
    else:
        raise NotDrawable(f"{label} has the shape {found.shape}, which is no picture (3, H, W)")
    step = -(-max(found.shape[1:]) // LARGEST)
    if step > 1:
        notes.append(f"{label} is {_size(found)} pixels large; one in {step} is drawn, each way.")
    with np.errstate(all="ignore"):
        picture = found[:, ::step, ::step].astype(np.float64)
    broken = int((~np.isfinite(picture)).any(axis=0).sum())
    if broken:
        of = picture.shape[1] * picture.shape[2]
        notes.append(f"{label} is NaN or infinite at {broken} of {of} pixels, painted magenta.")
    return picture, notes


def _size(picture: Array) -> str:
    return f"{picture.shape[2]} × {picture.shape[1]}"


def _plain(picture: Floats64, title: str) -> Panel:
    size = _size(picture)
    return Panel(
        title,
        f"{title}: a picture of {size} pixels; {_brightness(picture)}.",
        f"{size} pixels, {_brightness(picture)}",
        _codes(picture),
    )


def _brightness(picture: Floats64) -> str:
    values = picture[np.isfinite(picture)]
    if not values.size:
        return "no finite value"
    # Mean of halves: a sum of the largest floats would overflow.
    return f"mean {2 * (values / (2 * values.size)).sum():.3g}"


def _codes(picture: Floats64) -> NDArray[np.uint8]:
    codes = linear_to_srgb8(np.clip(np.nan_to_num(picture), 0, 1).astype(np.float32))
    codes[~np.isfinite(picture).all(axis=0)] = BROKEN
    return codes


def _compared(
    yours: Floats64, expected: Floats64, arrays: Mapping[str, Array], notes: list[str]
) -> list[Panel]:
    with np.errstate(all="ignore"):
        difference = yours - expected
    worst = _largest(difference)
    finite = np.isfinite(worst)
    if finite.all() and not worst.any():
        notes.append("The two pictures are equal to the last bit.")
        return []
    # As the checks do, so that their text and this region are about the same pixel.
    with np.errstate(all="ignore"):
        magnitude = np.where(finite, np.abs(difference).sum(axis=0), np.inf)
    row, column = (int(i) for i in np.unravel_index(magnitude.argmax(), magnitude.shape))
    scale = float(np.abs(worst[finite]).max(initial=0.0))
    panels = [
        Panel(
            "Signed difference",
            "Map of yours minus the reference. "
            f"The largest difference is at pixel ({column}, {row}).",
            "Yours minus the reference, of the colour that differs most: "
            f"blue where yours is darker, red where brighter. Colours end at ±{scale:.3g}.",
            _map(worst, scale),
            scale=Scale(f"−{scale:.3g} darker", f"+{scale:.3g} brighter"),  # noqa: RUF001
        )
    ]
    over_noise = _over_noise(difference, arrays, notes)
    if over_noise is not None:
        panels.append(over_noise)
    return panels + _enlarged(yours, expected, row, column)


def _largest(values: Floats64) -> Floats64:
    """Of the three colours of each pixel the value furthest from 0; NaN where any is not finite."""
    magnitude = np.where(np.isfinite(values), np.abs(values), np.inf)
    picked = np.take_along_axis(values, magnitude.argmax(axis=0)[None], axis=0)[0]
    return np.where(np.isfinite(values).all(axis=0), picked, np.nan)


def _map(values: Floats64, limit: float) -> NDArray[np.uint8]:
    """Diverging colours of (H, W) values from -limit to limit."""
    with np.errstate(all="ignore"):
        share = np.nan_to_num(values / limit) if limit > 0 else np.zeros_like(values)
    place = (np.clip(share, -1, 1) + 1) / 2 * (len(_DIVERGING) - 1)
    stops = np.arange(len(_DIVERGING))
    codes = np.stack([np.interp(place, stops, channel) for channel in _DIVERGING.T], axis=-1)
    codes[np.isnan(values)] = BROKEN
    result: NDArray[np.uint8] = np.rint(codes).astype(np.uint8)
    return result


def _over_noise(
    difference: Floats64, arrays: Mapping[str, Array], notes: list[str]
) -> Panel | None:
    noise, source = _noise(difference, arrays)
    if noise is None:
        notes.append(source)
        return None
    with np.errstate(all="ignore"):
        z = difference / noise
    z[difference == 0] = 0.0
    # A difference where there is no noise at all is as significant as can be.
    z[np.isinf(z) & np.isfinite(difference)] = 1e9 * np.sign(
        difference[np.isinf(z) & np.isfinite(difference)]
    )
    largest = _largest(z)
    beyond = int((np.abs(largest[np.isfinite(largest)]) > 3).sum())
    return Panel(
        "Difference over the noise",
        f"Map of the difference over the noise; it is beyond 3 at {beyond} of {largest.size} pixels.",
        f"How many times the noise the difference is; beyond 3 at {beyond} of {largest.size} pixels. "
        f"{source} Colours end at ±{NOISE_LIMIT:g}.",
        _map(largest, NOISE_LIMIT),
        scale=Scale(f"−{NOISE_LIMIT:g} or less", f"+{NOISE_LIMIT:g} or more"),  # noqa: RUF001
    )


def _noise(difference: Floats64, arrays: Mapping[str, Array]) -> tuple[Floats64 | None, str]:
    """Standard deviation of each value, and where it is from; None and why it can't be told."""
    known = np.asarray(arrays.get("noise", 0))
    if known.shape in (difference.shape, difference.shape[1:]) and known.dtype.kind == "f":
        return np.abs(known.astype(np.float64)), "The noise of each pixel is known."
    padded = np.pad(difference, ((0, 0), (1, 1), (1, 1)), mode="edge")
    around = padded[:, :-2, 1:-1] + padded[:, 2:, 1:-1] + padded[:, 1:-1, :-2] + padded[:, 1:-1, 2:]
    with np.errstate(all="ignore"):
        fine = difference - around / 4
    fine = fine[np.isfinite(fine)]
    # 1.4826 turns a median absolute deviation into a standard one; the mean of four neighbours adds a quarter of
    # the variance.
    sigma = 1.4826 * float(np.median(np.abs(fine))) / np.sqrt(1.25) if fine.size else 0.0
    if not 0 < sigma < np.inf:
        return None, "Most pixels agree exactly, so there is no noise to measure the difference by."
    return (
        np.full(difference.shape, sigma),
        (
            f"The noise is not known; it is taken as {sigma:.2g}, from the median absolute difference between "
            "each pixel's difference and its neighbours'; without noise the map only shows where the difference is "
            "large beside its own roughness."
        ),
    )


def _enlarged(yours: Floats64, expected: Floats64, row: int, column: int) -> list[Panel]:
    """The region around the worst pixel, of both pictures."""
    _, height, width = yours.shape
    top = max(0, min(row - WORST // 2, height - WORST))
    left = max(0, min(column - WORST // 2, width - WORST))
    region = np.s_[:, top : top + WORST, left : left + WORST]
    bottom, right = min(top + WORST, height) - 1, min(left + WORST, width) - 1
    place = f"columns {left} to {right}, rows {top} to {bottom}"
    return [
        Panel(
            f"{title}, the worst region",
            f"{title}, enlarged around pixel ({column}, {row}): {_rgb(picture, row, column)}.",
            f"{place}; pixel ({column}, {row}) is {_rgb(picture, row, column)}",
            _codes(picture[region]),
        )
        for title, picture in (("Reference", expected), ("Yours", yours))
    ]


def _rgb(picture: Floats64, row: int, column: int) -> str:
    return "(" + ", ".join(f"{value:.3g}" for value in picture[:, row, column]) + ")"
