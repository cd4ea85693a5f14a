"""Curves over rows, texels and numbers, and directions on the map of the sky."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import curves, dots, label, plot, square, steps, view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

WEIGHTS = np.array([[0.3, 0.3, 0.3, 0.3], [0, 2, 0, 6], [0, 0, 0, 0], [0.5, 0.5, 1, 0.5]])
SOME = np.array([4.0, 1, 0, 0.5, 2, 1])


def _weighed(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    image = np.tile(np.array([0.1, 1.0, 0.4]), (24, 12, 1))
    found = [np.asarray(m.texel_weights(image))[:, 0] for m in (made, right)]
    curves(axes, np.arange(24), *found)
    label(axes, "row, from the top down")


def _cumulated(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    with np.errstate(all="ignore"):
        found = [np.concatenate([np.ravel(x) for x in m.cumulate(WEIGHTS)]) for m in (made, right)]
    steps(axes, *found)
    label(axes, "rows, and then the texels of each")


def _on_the_map(weights: Array, first: float) -> Any:
    """Directions by random numbers; the first number of some is given."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        rows, columns = right.cumulate(weights)
        u = np.random.default_rng(2).random((2, 900))
        u[0, :40] = first
        x, y, z = made.sample_direction(rows, columns, u)
        longitude, latitude = np.arctan2(x, -z) / np.pi, np.arcsin(np.clip(y, -1, 1)) / np.pi
        for row, column in np.ndindex(weights.shape):
            left, top = column / 2 - 1, 0.5 - row / 4
            square(axes, left, top - 0.25, left + 0.5, top)
        dots(axes, np.stack((longitude, latitude)), size=2)
        view(axes, (-1.05, 1.05), (-0.55, 0.55))

    return draw


def _densities(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    theta = np.linspace(0.02, np.pi - 0.02, 400)
    phi = np.linspace(-2.9, 2.9, 400)
    way = (np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi))
    curves(axes, theta, *(m.density(WEIGHTS, np.stack(way)) for m in (made, right)))
    label(axes, "angle from +y, along a spiral")


def _shared(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    found = []
    for module in (made, right):
        probability, alias = module.alias_table(SOME)
        own = np.array(probability, float)
        np.add.at(own, np.clip(alias, 0, 5), 1 - np.asarray(probability))
        found.append(own / 6)
    steps(axes, *found)
    label(axes, "outcome")


def _drawn(result: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        probability, alias = right.alias_table(SOME)
        u = np.linspace(0, 1, 600, endpoint=False)
        found = [np.asarray(m.draw_alias(probability, alias, u)[result]) for m in (made, right)]
        curves(axes, u, *found)
        label(axes, "u")

    return draw


LOOKS = {
    "texel_weights": (
        Look("Weights of a column of an evenly green sky", plot(_weighed, curve=True)),
    ),
    "cumulate": (Look("Sums of four rows of four texels", plot(_cumulated, curve=True)),),
    "sample_direction": (
        Look("The map of the sky, and directions drawn from it", plot(_on_the_map(WEIGHTS, 0.5))),
        Look(
            "Directions drawn from a sky whose upper row is black; some numbers are 0",
            plot(_on_the_map(np.roll(WEIGHTS, 2, axis=0), 0)),
            ("direction_black_texel",),
        ),
    ),
    "density": (Look("Densities along a spiral from pole to pole", plot(_densities, curve=True)),),
    "alias_table": (Look("What each of six outcomes gets", plot(_shared, curve=True)),),
    "draw_alias": (
        Look("Outcomes over the number", plot(_drawn(0), curve=True)),
        Look(
            "What is left of the number",
            plot(_drawn(1), curve=True),
            ("draw_rest_is_fraction",),
        ),
    ),
}
