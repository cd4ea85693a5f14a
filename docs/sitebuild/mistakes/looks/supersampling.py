"""Places in pixels as dots, a filter as a curve, and what becomes of a pixel's colour."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from course.school.grading.pictures import scenes
from sitebuild.mistakes.look import SIZE, Draw, Look
from sitebuild.mistakes.plots import INK, SECOND, Array, curves, dots, label, plot, square, view
from sitebuild.mistakes.rendered import checked, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

K = 4
"""Points along a pixel's side."""

ACROSS, DOWN = 3, 2
"""Pixels that are shown."""

SIGMA = 0.25

LARGE = 10
"""Pixels of the figure along the side of a pixel that is shown large."""


def _pixels(axes: Axes, points: Array, k: int = 0) -> None:
    """Points (2, n, s) of neighbouring pixels, in two colours by turns, with cells if there are k along a side."""
    for pixel in range(ACROSS * DOWN):
        x, y = pixel % ACROSS, pixel // ACROSS
        for line in range(1, k):
            for at in (([x + line / k] * 2, [y, y + 1]), ([x, x + 1], [y + line / k] * 2)):
                axes.plot(*at, color="#e2e2e2", linewidth=0.6, zorder=1)
        square(axes, x, y, x + 1, y + 1, color="#777", zorder=2)
        color = (INK, SECOND)[(x + y) % 2]
        dots(axes, points[:, pixel] + np.array([[x], [y]]), color, 6)
    view(axes, (-0.12, ACROSS + 0.12), (-0.12, DOWN + 0.12))
    axes.invert_yaxis()


def _regular(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _pixels(axes, made.regular(K, ACROSS * DOWN), K)


def _numbered(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    square(axes, 0, 0, 1, 1, color="#777")
    for number, (x, y) in enumerate(made.regular(K, 1)[:, 0].T):
        axes.text(x, y, str(number), color=INK, fontsize=10, ha="center", va="center")
    view(axes, (-0.02, 1.02), (-0.02, 1.02))
    axes.invert_yaxis()


def _random(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _pixels(axes, made.random(K, ACROSS * DOWN, np.random.default_rng(5)))


def _twice(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    first, second = (made.random(K, 1, np.random.default_rng(5))[:, 0] for _ in range(2))
    square(axes, 0, 0, 1, 1, color="#777")
    dots(axes, first, size=9)
    axes.scatter(*second, s=50, facecolors="none", edgecolors=SECOND, linewidths=1)
    view(axes, (-0.05, 1.05), (-0.05, 1.05))


def _jittered(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _pixels(axes, made.jittered(K, ACROSS * DOWN, np.random.default_rng(5)), K)


def _filter(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    x = np.linspace(0, 1, 101)
    offsets = np.stack((x, np.full_like(x, 0.5)))[:, None]
    curves(
        axes,
        x,
        made.gaussian_weights(offsets, SIGMA)[0],
        right.gaussian_weights(offsets, SIGMA)[0],
    )
    axes.set_ylim(bottom=0)
    label(axes, "x across the pixel, y = 0.5")


def _edge(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    at, s = np.linspace(0, 1, 61), 64
    offsets = right.regular(s, len(at))
    radiance = np.broadcast_to(offsets[0] < at[:, None], (3, *offsets.shape[1:])).astype(np.float32)
    weights = right.gaussian_weights(offsets, SIGMA)
    curves(axes, at, made.resolve(radiance, weights)[0], right.resolve(radiance, weights)[0])
    label(axes, "how far a bright edge has come in")


def _bars(sigma: float) -> Draw:
    film = {"filter": "gaussian", "sigma": sigma}
    return checked("supersampling.resolve", lambda rng: scenes.edges(rng, "regular", 4, **film))


def _starved(made: ModuleType, right: ModuleType) -> Image.Image:
    """Slanted bars, in pixels whose samples all weigh 0: so narrow a filter is refused in scenes."""
    across, down = SIZE[0] // LARGE, SIZE[1] // LARGE
    offsets = right.regular(K, across * down)
    row, column = np.divmod(np.arange(across * down), across)
    bright = (column[:, None] + offsets[0] + 2 * (row[:, None] + offsets[1])) % 6 < 2.5
    # In a colour, so that channels that are exchanged are seen.
    radiance = np.multiply.outer(np.array((1, 0.7, 0.3), np.float32), bright)
    picture = made.resolve(radiance, right.gaussian_weights(offsets, np.float32(0.005)))
    return shown(picture.reshape(3, down, across).repeat(LARGE, axis=1).repeat(LARGE, axis=2))


LOOKS = {
    "regular": (
        Look("Six pixels, with the cells of each, and the points in it", plot(_regular)),
        Look("The points of a pixel, by their number", plot(_numbered), ("regular_columns",)),
    ),
    "random": (
        Look(
            "A pixel's points, as dots, and as rings from a second call with the same seed",
            plot(_twice),
            ("random_own_generator", "random_global_state"),
        ),
        Look("The points of six pixels", plot(_random)),
    ),
    "jittered": (
        Look("Six pixels, with the cells of each; its points have its colour", plot(_jittered)),
    ),
    "gaussian_weights": (
        Look(
            "The weight from the pixel's left edge to its right one; grey lines below show the right one",
            plot(_filter, curve=True),
        ),
    ),
    "resolve": (
        Look(
            "Bright bars, with a Gaussian filter",
            _bars(0.3),
            renders=True,
        ),
        Look(
            "A pixel's brightness, with a Gaussian filter, as an edge comes in; grey lines below show the right one",
            plot(_edge, curve=True),
            ("resolve_weights_ignored",),
        ),
        Look(
            "The bars with a filter so narrow that the weights are nearly 0",
            _bars(0.06),
            ("resolve_epsilon",),
            renders=True,
        ),
        Look(
            "Large pixels with bars, with a filter so narrow that all weights are 0; what is no number is magenta here",
            _starved,
            ("resolve_zero_weights_nan", "resolve_zero_weights_black"),
        ),
    ),
}
