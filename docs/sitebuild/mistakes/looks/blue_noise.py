"""Curves through pixels, masks and moved points as dots, spectra as lines."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import (
    INK,
    RIGHT,
    Array,
    Plot,
    curves,
    dots,
    label,
    plot,
    square,
    view,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _pixels(side: int) -> tuple[Array, Array]:
    y, x = np.divmod(np.arange(side * side), side)
    return x, y


def _line(axes: Axes, order: Array, side: int) -> None:
    """From pixel to pixel, as they come."""
    x, y = (k[np.argsort(order, kind="stable")] for k in _pixels(side))
    axes.plot(x, -y, color=INK, linewidth=1.1)
    axes.scatter(x[:1], -y[:1], s=22, c="#d1495b", zorder=4)
    square(axes, -0.5, 0.5, side - 0.5, 0.5 - side)
    view(axes, (-0.7, side - 0.3), (0.3 - side, 0.7))


def _curve(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _line(axes, np.asarray(made.z_order(*_pixels(8))), 8)


def _far(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    x = np.arange(0, 2000, 8)
    curves(axes, x, *(np.asarray(m.z_order(x, x), float) for m in (made, right)))
    label(axes, "column and row")


def _shuffled(levels: int, seed: int = 6) -> Plot:
    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        x, y = _pixels(2**levels)
        _line(axes, np.asarray(made.shuffled_z_order(x, y, levels, seed)), 2**levels)

    return draw


def _mask(count: int) -> Plot:
    """The lowest ranks of a mask, which is drawn four times, side by side."""

    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        u = np.random.default_rng(3).random((16, 24))
        ranks = np.tile(np.asarray(made.void_and_cluster(u, 1.5)), (2, 2))
        y, x = np.nonzero(ranks < count)
        dots(axes, np.stack((x, -y)), size=5)
        axes.axhline(-15.5, color="#bbb", linewidth=0.7)
        axes.axvline(23.5, color="#bbb", linewidth=0.7)
        view(axes, (-1, 48), (-32, 1))

    return draw


def _power(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """Power of a mask's numbers, white ones have a twelfth."""
    u = np.random.default_rng(3).random((32, 48))
    masks = (np.asarray(m.void_and_cluster(u, 1.5), float) / u.size for m in (made, right))
    x = (np.arange(12) + 0.5) / 24
    curves(axes, x, *(np.asarray(right.radial_spectrum(mask, 12)) for mask in masks))
    label(axes, "cycles per pixel")


def _moved(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """Two points in two dimensions, moved for the pixels of a small mask and beyond it."""
    rng = np.random.default_rng(2)
    masks = np.stack([rng.permutation(12).reshape(3, 4) for _ in range(2)])
    points = np.array([[0.1, 0.7], [0.3, 0.8]])
    x, y = np.array([0, 1, 3, 5, 6, 2]), np.array([0, 2, 1, 4, 0, 5])
    expected = np.asarray(right.dithered_points(points, masks, x, y)).reshape(2, -1)
    axes.scatter(*expected, s=42, facecolors="none", edgecolors=RIGHT, linewidths=1.2)
    dots(axes, np.asarray(made.dithered_points(points, masks, x, y)).reshape(2, -1), size=9)
    square(axes, 0, 0, 1, 1)
    view(axes, (-0.04, 1.04), (-0.04, 1.04))


def _spectrum(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """An error that has a mean, a wave and noise, in a picture that isn't square."""
    rng = np.random.default_rng(1)
    error = rng.normal(size=(32, 64)) + 0.4 + 0.5 * np.cos(np.pi / 2 * np.arange(64))
    error += (np.add.outer(np.arange(32), np.arange(64)) % 2 - 0.5) * 0.8
    x = (np.arange(16) + 0.5) / 32
    found = (np.asarray(m.radial_spectrum(error, 16), float) for m in (made, right))
    curves(axes, x, *found)
    label(axes, "cycles per pixel")


def _seen(mean: float) -> Plot:
    """White noise about a mean, and a light edge, over the width of the blur."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        error = np.random.default_rng(7).normal(size=(12, 16)) + mean
        error[:, 0] += 1.5
        sigma = np.linspace(0.3, 4, 24)
        found = ([float(m.perceptual_rmse(error, s)) for s in sigma] for m in (made, right))
        curves(axes, sigma, *map(np.array, found))
        if mean:
            axes.set_ylim(0, 1.2 * mean)
        label(axes, "sigma")

    return draw


LOOKS = {
    "z_order": (
        Look("The curve through 8 by 8 pixels", plot(_curve)),
        Look("Numbers along the diagonal", plot(_far, curve=True), ("z_narrow",)),
    ),
    "shuffled_z_order": (
        Look("The curve through 8 by 8 pixels, from the dot on", plot(_shuffled(3))),
    ),
    "void_and_cluster": (
        Look("A fifth of a mask, four times side by side", plot(_mask(77))),
        Look(
            "The first pattern of a mask, four times side by side",
            plot(_mask(38)),
            ("mask_not_settled",),
        ),
        Look(
            "Half of the first pattern of a mask",
            plot(_mask(19)),
            ("mask_clusters_upwards",),
        ),
        Look("Power of a mask", plot(_power, curve=True), ("mask_white",)),
    ),
    "dithered_points": (Look("Two points, moved for six pixels", plot(_moved)),),
    "radial_spectrum": (Look("The spectrum of noise and a wave", plot(_spectrum, curve=True)),),
    "perceptual_rmse": (
        Look("An error over the width of the blur", plot(_seen(0), curve=True)),
        Look(
            "An error that is nearly even, over the width of the blur",
            plot(_seen(3), curve=True),
            ("seen_dark_edges",),
        ),
    ),
}
