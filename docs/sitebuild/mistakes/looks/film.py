"""Curves over a value, and swatches of three colours."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import curves, label, plot, steps

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

COLORS = np.array([(1, 0.1, 0.1), (0.1, 1, 0.1), (0.1, 0.1, 1), (1, 1, 1), (1.6, 1.2, 0.4)]).T
"""Red, green, blue, white and what is brighter than white."""

REC2020 = np.array([(0.708, 0.292), (0.170, 0.797), (0.131, 0.046), (0.3127, 0.3290)]).T
SRGB = np.array([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.3127, 0.3290)]).T


NAMES = ("red", "green", "blue", "white", "bright")


def _of_colors(axes: Axes, made: Array, right: Array) -> None:
    """What comes of each colour, one value or three, as steps."""
    steps(axes, np.ravel(made), np.ravel(right))
    each = right.size / len(NAMES)
    axes.set_xticks((np.arange(len(NAMES)) + 0.5) * each - 0.5, NAMES)


def _exposed(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    stops = np.linspace(-2, 2, 41)
    one = np.full((3, 1), 0.6)
    found = [[float(m.expose(one, s)[0, 0]) for s in stops] for m in (made, right)]
    curves(axes, stops, *map(np.array, found))
    label(axes, "stops")


def _luminances(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    _of_colors(axes, made.luminance(COLORS), right.luminance(COLORS))


def _converted(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    found = (m.convert_gamut(COLORS, REC2020, SRGB).T for m in (made, right))
    _of_colors(axes, *found)
    label(axes, "red, green and blue of each")


def _wedge(black: float = 0) -> Array:
    """Five powers of ten; the first part of its pixels is black."""
    y = 10.0 ** np.linspace(-3, 2, 200)
    y[: int(200 * black)] = 0
    return y


def _dim() -> Array:
    """Two powers of ten, and more dark pixels than bright ones: no mean of any kind is in the middle."""
    y: Array = 10.0 ** (2 * np.linspace(0, 1, 200) ** 2)
    return y


def _toned(luminances: Array, row: int, burn: float, saturation: float) -> Any:
    """A picture in orange light."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        picture = np.array([[1.3], [1.0], [0.5]]) * luminances
        with np.errstate(all="ignore"):
            found = [
                np.asarray(m.photographic(picture, 0.4, burn, saturation))[row]
                for m in (made, right)
            ]
        curves(axes, np.arange(200), *found)
        label(axes, "pixels, from dark to bright")

    return draw


def _encoded(low: float, high: float) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        x = np.tile(np.linspace(low, high, 200), (3, 1))
        curves(axes, x[0], *(np.asarray(m.encode_srgb(x))[0] for m in (made, right)))
        label(axes, "linear value")

    return draw


def _codes(first: float, last: float, row: int = 0) -> Any:
    """Codes of a slow ramp, with the same numbers for both."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        ramp = np.tile(np.linspace(first, last, 60) / 255, (3, 1))
        u = np.random.default_rng(0).random(ramp.shape)
        curves(
            axes,
            255 * ramp[0],
            *(np.asarray(m.quantize(ramp, u), float)[row] for m in (made, right)),
            drawstyle="steps-mid",
        )
        label(axes, "255 e")

    return draw


def _whites(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    ramp = np.tile(np.minimum(np.linspace(0, 1.5, 60), 1), (3, 1))
    u = np.full_like(ramp, 1 - 1e-7)
    found = (np.asarray(m.quantize(ramp, u), float)[0] for m in (made, right))
    steps(axes, *found)
    label(axes, "pixels, from black to white")


LOOKS = {
    "expose": (Look("A radiance of 0.6 over stops", plot(_exposed, curve=True)),),
    "luminance": (Look("Luminances of five colours", plot(_luminances, curve=True)),),
    "photographic": (
        Look("Red of a wedge of five powers of ten", plot(_toned(_wedge(), 0, 5, 0.6), curve=True)),
        Look(
            "Red of more dark pixels than bright ones; a quarter may burn out",
            plot(_toned(_dim(), 0, 25, 0.6), curve=True),
            (
                "tone_median",
                "tone_simple",
                "tone_white_unscaled",
                "tone_burn_ignored",
                "tone_burn_fraction",
            ),
        ),
        Look(
            "Green of a wedge, a third of it black",
            plot(_toned(_wedge(0.3), 1, 30, 1), curve=True),
            ("tone_black_counted", "tone_no_number", "tone_percentile_of_lit"),
        ),
    ),
    "encode_srgb": (
        Look("The curve from below 0 to above 1", plot(_encoded(-0.2, 1.3), curve=True)),
        Look(
            "The curve next to black",
            plot(_encoded(0, 0.04), curve=True),
            ("srgb_gamma", "srgb_knee"),
        ),
        Look(
            "The line next to black",
            plot(_encoded(0, 0.006), curve=True),
            ("srgb_line_forgotten",),
        ),
    ),
    "convert_gamut": (Look("Channels of five colours", plot(_converted, curve=True)),),
    "quantize": (
        Look("Codes of a ramp", plot(_codes(3, 7), curve=True)),
        Look("Green codes of a ramp", plot(_codes(3, 7, 1), curve=True), ("codes_one_u",)),
        Look("Codes up to white", plot(_codes(252, 255), curve=True), ("codes_256",)),
        Look(
            "Codes up to white where u is nearly 1; a third of the pixels is white",
            plot(_whites, curve=True),
            ("codes_wrap",),
        ),
    ),
}
