"""Curves over angle, distance and place: densities, weights and estimates."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import curves, label, plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

X = np.linspace(-1, 1, 400)
DENSITIES = np.stack(
    (
        np.exp(-((X + 0.4) ** 2) / 0.06),
        3 * np.exp(-((X - 0.1) ** 2) / 0.01),
        0.5 * np.exp(-((X - 0.5) ** 2) / 0.2),
    )
)
COUNTS = np.array([4, 1, 2])


def _slanted(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    angle = np.linspace(-150, 150, 400)
    distance = np.full(400, 2.0)
    curves(
        axes,
        angle,
        *(
            m.area_density(0.5, distance, np.cos(np.radians(angle))).clip(-60, 60)
            for m in (made, right)
        ),
    )
    label(axes, "angle to the lamp's normal [degrees]")


def _away(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    distance = np.linspace(0.2, 4, 400)
    curves(axes, distance, *(m.cone_density(1.0, distance) for m in (made, right)))
    label(axes, "distance in radii")


def _far_away(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    distance = (10 ** np.linspace(1, 4, 300)).astype(np.float32)
    found = [m.cone_density(1.0, distance) / distance**2 for m in (made, right)]
    curves(axes, np.log10(distance), *(np.minimum(x, 1) for x in found))
    axes.set_ylim(0, 1.05)
    label(axes, "logarithm of the distance")


def _weighed(exponent: float, row: int, scale: float = 1.0, kind: Any = np.float64) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        densities = (scale * DENSITIES).astype(kind)
        found = [m.heuristic_weights(COUNTS, densities, exponent)[row] for m in (made, right)]
        curves(axes, X, *found)
        label(axes, "direction")

    return draw


def _nobody(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    densities = np.where(np.abs(X) < 0.3, 0, DENSITIES)
    curves(axes, X, *(m.heuristic_weights(COUNTS, densities, 2.0)[2] for m in (made, right)))
    label(axes, "direction")


def _deltas(row: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        densities = DENSITIES.copy()
        delta = np.zeros(DENSITIES.shape, bool)
        delta[0] = True
        densities[0] = np.where(np.abs(X + 0.4) < 0.15, 0.6, 0)
        densities[1] += 0.5
        delta[2] = np.abs(X + 0.32) < 0.1
        densities[2] = np.where(delta[2], 0.9, densities[2])
        curves(axes, X, *(m.delta_weights(COUNTS, densities, delta)[row] for m in (made, right)))
        label(axes, "direction; deltas in the left third")

    return draw


def _drawn(counts: Array) -> tuple[Array, Array, Array]:
    strategy = np.repeat(np.arange(3), counts)
    place = np.concatenate([(np.arange(k) + 0.5) / k for k in counts])
    x = place ** (1 / (strategy + 1))
    powers = np.arange(3)[:, None]
    return strategy, x, (powers + 1) * x**powers


def _summed(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    counts = np.array([40, 10, 90])
    strategy, x, densities = _drawn(counts)
    weights = right.heuristic_weights(counts, densities, 1.0)
    own = strategy, np.arange(x.size)
    powers = np.linspace(0.2, 4, 40)
    found = []
    for module in (made, right):
        sums = [
            module.multi_sample(
                counts, strategy, np.stack((x**p,) * 3), densities[own], weights[own]
            )[0]
            for p in powers
        ]
        found.append(np.array(sums))
    curves(axes, powers, *found)
    label(axes, "power of x; its integral from 0 to 1")


def _one_each(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    odds = np.array([0.3, 0.6, 0.1])
    _, x, densities = _drawn(np.array([30, 60, 10]))
    order = np.argsort(x)
    f = np.stack((x**2,) * 3)[:, order]
    curves(axes, x[order], *(m.one_sample(odds, f, densities[:, order])[0] for m in (made, right)))
    label(axes, "x")


LOOKS = {
    "area_density": (Look("A lamp, turned away", plot(_slanted, curve=True)),),
    "cone_density": (
        Look("A ball, from its centre outwards", plot(_away, curve=True)),
        Look(
            "A ball far away, in single precision: density over the square of the distance",
            plot(_far_away, curve=True),
            ("cone_cancelled",),
        ),
    ),
    "heuristic_weights": (
        Look("The weight of one of three strategies", plot(_weighed(2.0, 0), curve=True)),
        Look(
            "The balance heuristic's weight of one of three strategies",
            plot(_weighed(1.0, 0), curve=True),
            ("weights_always_squared",),
        ),
        Look(
            "The weight of one of three strategies of small densities",
            plot(_weighed(2.0, 0, 1e-12, np.float32), curve=True),
            ("weights_enlarged",),
        ),
        Look(
            "The weight of one of three strategies of densities near 1e20, in single precision",
            plot(_weighed(2.0, 0, 1e20, np.float32), curve=True),
            ("weights_overflow",),
        ),
        Look(
            "The weight where nobody draws the middle",
            plot(_nobody, curve=True),
            ("weights_not_a_number",),
        ),
    ),
    "delta_weights": (
        Look("The weight of a delta", plot(_deltas(0), curve=True)),
        Look(
            "The weight of a density beside deltas",
            plot(_deltas(1), curve=True),
            ("delta_always",),
        ),
    ),
    "multi_sample": (Look("Integrals by three strategies", plot(_summed, curve=True)),),
    "one_sample": (
        Look("A hundred estimates of the integral of the square of x", plot(_one_each, curve=True)),
    ),
}
