"""Points as dots, and samples of one effect over those of another."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import (
    INK,
    RIGHT,
    SECOND,
    Array,
    Plot,
    dots,
    label,
    plot,
    square,
    view,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _stems(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    i = np.arange(18)
    found = made.radical_inverse(3, i.copy())
    axes.scatter(
        i, right.radical_inverse(3, i), s=42, facecolors="none", edgecolors=RIGHT, linewidths=1.2
    )
    axes.vlines(i, 0, found, color=INK, linewidth=0.8)
    axes.scatter(i, found, s=9, c=INK, zorder=4)
    axes.axhline(1, color="#999", linewidth=0.8, linestyle="--")
    axes.set_ylim(bottom=0)
    label(axes, "i, base 3")


def _unit(axes: Axes, points: Array, expected: Array | None = None) -> None:
    square(axes, 0, 0, 1, 1)
    if expected is not None:
        axes.scatter(*expected, s=42, facecolors="none", edgecolors=RIGHT, linewidths=1.2)
    dots(axes, points, size=5 if expected is None else 9)
    view(axes, (-0.04, 1.04), (-0.04, 1.04))


def _halton(first: int, second: int) -> Plot:
    """Draw two coordinates of the first points."""

    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        points = np.asarray(made.halton(np.arange(200), 5))
        _unit(axes, points[[first, second]])

    return draw


def _few(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    i = np.arange(12)
    _unit(axes, np.asarray(made.halton(i, 2)), right.halton(i, 2))


def _hammersley(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    _unit(axes, np.asarray(made.hammersley(16, 2)), right.hammersley(16, 2))


def _patterns(right: ModuleType, count: int = 64) -> tuple[Array, Array]:
    return right.hammersley(count, 2), right.hammersley(count, 2)


def _hand_in_hand(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """The place on the light over the place on the lens, of 64 rays."""
    lens, light = made.chain(_patterns(right), np.arange(64), np.random.default_rng(4))
    square(axes, 0, 0, 1, 1)
    axes.scatter(lens[0], light[0], s=9, c=INK, linewidths=0)
    view(axes, (-0.04, 1.04), (-0.04, 1.04))


def _one_pattern(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    patterns = _patterns(right)
    found = made.chain(patterns, np.arange(64), np.random.default_rng(4))[0]
    _unit(axes, found, patterns[0])


def _same_ids(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    ids = np.tile(np.arange(16), 2)
    found = made.chain(_patterns(right, 16), ids, np.random.default_rng(4))[0]
    _unit(axes, found[:, :16])
    axes.scatter(*found[:, 16:], s=50, facecolors="none", edgecolors=SECOND, linewidths=1)
    for first, second in zip(found[:, :16].T, found[:, 16:].T, strict=True):
        axes.plot(*np.stack((first, second), axis=1), color="#bbb", linewidth=0.7, zorder=1)


LOOKS = {
    "radical_inverse": (
        Look("The numbers of 0 to 17; rings show the right ones", plot(_stems, curve=True)),
    ),
    "halton": (
        Look(
            "200 points: coordinate 2 over coordinate 0", plot(_halton(0, 2)), ("halton_all_bases",)
        ),
        Look(
            "200 points: coordinate 4 over coordinate 1", plot(_halton(1, 4)), ("halton_odd_bases",)
        ),
        Look(
            "200 points: coordinate 1 over coordinate 0", plot(_halton(0, 1)), ("halton_one_base",)
        ),
        Look("The first 12 points; rings show the right ones", plot(_few)),
    ),
    "hammersley": (Look("16 points; rings show the right ones", plot(_hammersley)),),
    "chain": (
        Look("64 rays: the place on the light over the place on the lens", plot(_hand_in_hand)),
        Look(
            "The samples that 64 rays take of a pattern; rings show the pattern",
            plot(_one_pattern),
            ("chain_torn", "chain_repeats"),
        ),
        Look(
            "Sixteen ids, each of two rays: a dot and a ring, with a line between the two",
            plot(_same_ids),
            ("chain_ids_ignored",),
        ),
    ),
}
