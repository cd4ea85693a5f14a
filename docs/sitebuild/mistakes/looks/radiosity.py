"""A hemicube's shares in grey, and the light of a few patches as bars."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import INK, RIGHT, Array, plot, square, view
from sitebuild.mistakes.swatches import swatches

if TYPE_CHECKING:
    from matplotlib.axes import Axes

K = 16


def _hemicube(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """The top from above, and below it a side; the brighter, the larger the share."""
    top, side = made.hemicube_form_factors(K)
    largest = float(right.hemicube_form_factors(K)[0].max())
    for shares, y in ((top, 0.12), (side[::-1], -1.0)):
        height = 2 * len(shares) / K
        extent = (-1, 1, y, y + height)
        axes.imshow(shares, extent=extent, cmap="magma", vmin=0, vmax=largest, aspect="auto")
        square(axes, -1, y, 1, y + height, color="#555")
    total = float(top.sum() + 4 * side.sum())
    axes.text(1.15, 1.1, "top", fontsize=8, color="#333", va="center")
    axes.text(1.15, -0.5, "side", fontsize=8, color="#333", va="center")
    axes.text(
        -1.15, 1.1, f"sum of all\n{total:.3g}", fontsize=8, color=INK, va="center", ha="right"
    )
    view(axes, (-1.9, 1.9), (-1.05, 2.2))


# Four patches: a lamp, a small bright one, a large grey one, a dark one. Areas times form factors are symmetric.
AREAS = np.array((1.0, 0.5, 2.0, 1.0))
EXCHANGE = np.array(
    ((0.0, 0.15, 0.5, 0.2), (0.15, 0.0, 0.2, 0.1), (0.5, 0.2, 0.4, 0.4), (0.2, 0.1, 0.4, 0.0))
)
FACTORS = EXCHANGE / AREAS[:, None]
EMISSION = np.array((1.0, 0.0, 0.0, 0.0)) * np.ones((3, 1))
REFLECTANCE = np.array((0.3, 0.9, 0.6, 0.15)) * np.ones((3, 1))
NAMES = ("lamp", "small", "large", "dark")


def _bars(axes: Axes, found: Array, expected: Array) -> None:
    x = np.arange(len(found))
    axes.bar(x, found, 0.5, color=INK)
    axes.bar(x, expected, 0.75, fill=False, edgecolor=RIGHT, linewidth=1.8)
    axes.set_xticks(x, NAMES)
    axes.set_ylim(0, 2.2)


def _gathered(module: ModuleType) -> Array:
    radiosity = EMISSION.copy()
    for _ in range(4):
        radiosity = np.asarray(module.gather(radiosity, EMISSION, REFLECTANCE, FACTORS))
    return radiosity.mean(axis=0)


def _gather(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    _bars(axes, _gathered(made), _gathered(right))


def _shot(module: ModuleType) -> Array:
    radiosity, unshot = EMISSION.copy(), EMISSION.copy()
    for _ in range(8):
        shooter = int((unshot.mean(axis=0) * AREAS).argmax())
        radiosity, unshot = module.shoot(
            radiosity, unshot, REFLECTANCE, AREAS, FACTORS[shooter], shooter
        )
    shown: Array = radiosity.mean(axis=0)
    return shown


def _shoot(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    _bars(axes, _shot(made), _shot(right))


def _patches() -> Array:
    """Corners (3, 4, n) of patches."""
    one = np.ones(3)
    red = np.array((0.8, 0.04, 0.04))
    corners = (
        (0.5 * one,) * 4,
        (0.9 * one, 0.9 * one, 0.2 * one, 0.2 * one),
        (1.0 * one, 0.8 * one, 1.0 * one, 0.8 * one),
        (0.08 * one, 0.08 * one, 0.01 * one, 0.01 * one),
        (red, red * (1, 2, 1), red, red * (1, 2, 1)),
        (0 * one,) * 4,
        (0.3 * one, 0.05 * one, 0.3 * one, 0.05 * one),
        (3.0 * one, 2.4 * one, 3.0 * one, 2.4 * one),
        (0.4 * one, 0.35 * one, 0.4 * one, 0.35 * one),
        (0.02 * one,) * 4,
    )
    return np.array(corners).transpose(2, 1, 0)


def _splits(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    patches = _patches()
    swatches(axes, patches, np.asarray(made.needs_split(patches, 0.4)).astype(bool))


LOOKS = {
    "hemicube_form_factors": (
        Look(
            "The shares of a top's cells and of a side's, the larger the brighter", plot(_hemicube)
        ),
    ),
    "gather": (
        Look(
            "The light of four patches after four iterations; outlines show the right one",
            plot(_gather, curve=True),
        ),
    ),
    "shoot": (
        Look(
            "The light of four patches after eight shots; outlines show the right one",
            plot(_shoot, curve=True),
        ),
    ),
    "needs_split": (
        Look(
            "Ten patches in the colours of their corners, threshold 0.4; a cross means: divide",
            plot(_splits),
        ),
    ),
}
