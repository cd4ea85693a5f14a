"""Curves over numbers, distances and nodes, cones as arcs, and lamps that are chosen along a street."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import INK, LINE, RIGHT, curves, label, plot, square, steps, view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

POWER = np.array([0.0, 2, 0, 3, 1, 0])
ALL = float(np.pi)
LAMP = 1
"""Whose probability is drawn: neither its leaf has its number, nor the other way round."""


def street(count: int = 12) -> dict[str, Array]:
    """Lamps along x that shine to all sides, in another order than along it; count is no multiple of 5."""
    # The same in every trial: other lamps would pass for noise.
    x = np.arange(count) * 5 % count - (count - 1) / 2
    place = np.stack((x, 0 * x + 1, 2 * np.cos(3 * x)))
    return {
        "lo": place - 0.05,
        "hi": place + 0.05,
        "axis": np.repeat([[0.0], [-1.0], [0.0]], count, axis=1),
        "angle": np.full(count, ALL),
        "power": np.ones(count),
    }


def walkers(n: int) -> tuple[Array, Array, Array]:
    """Points along the street, normals and numbers."""
    x = np.linspace(-7, 7, n)
    up = np.repeat([[0.0], [1.0], [0.0]], n, axis=1)
    return np.stack((x, 0 * x, 0 * x)), up, (np.arange(n) * 0.618034) % 1


def _choice(result: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        u = np.append(np.linspace(0, 1, 600, endpoint=False), (1 / 3, 5 / 6))
        u.sort()
        found = [np.asarray(m.power_choice(POWER, u)[result], float) for m in (made, right)]
        curves(axes, u, *found, drawstyle="steps-mid")
        label(axes, "u")

    return draw


CONES = (
    (np.array([0.35, 0.94, 0.0]), 0.7, np.array([0.94, -0.35, 0.0]), 0.2),
    (np.array([0.0, 1.0, 0.0]), 0.2, np.array([0.2, 0.98, 0.0]), 0.9),
    (np.array([0.0, 1.0, 0.0]), 0.5, np.array([0.0, -1.0, 0.0]), 0.3),
)


def _cones(which: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        a, alpha, b, beta = CONES[which]
        given = [a[:, None], np.array([alpha]), b[:, None], np.array([beta])]
        for axis, angle in ((a, alpha), (b, beta)):
            _fan(axes, axis, angle, 0.75, LINE, 5)
        for module, color, size in ((right, RIGHT, 0.88), (made, INK, 1.0)):
            axis, angle = module.merge_cones(*given)
            _fan(axes, axis[:, 0], float(angle[0]), size, color, 1.6)
        view(axes, (-1.05, 1.05), (-1.05, 1.05))

    return draw


def _fan(axes: Axes, axis: Array, angle: float, size: float, color: str, width: float) -> None:
    middle = np.arctan2(axis[1], axis[0])
    turn = np.concatenate(([0.0], middle + np.linspace(-angle, angle, 90), [0.0]))
    reach = np.full(92, size)
    reach[[0, -1]] = 0
    axes.plot(reach * np.cos(turn), reach * np.sin(turn), color=color, linewidth=width)


def _boxes(axes: Axes, made: ModuleType, _right: ModuleType) -> None:
    """Of the street's lamps in a square, so that no axis is the longest everywhere."""
    own = street()
    place = np.arange(12) * 5 % 12
    x, z = place % 4 - 1.5, place // 4 - 1.0
    middle = np.stack((2 * x + 0.5 * z, 0 * x + 1, 2 * z - 0.5 * x))
    own |= {"lo": middle - 0.05, "hi": middle + 0.05}
    lo, hi = made.light_tree(*own.values())[:2]
    for k in range(1, 11):
        style = {"color": INK, "linewidth": 0.9}
        square(axes, lo[0, k] - 0.1, lo[2, k] - 0.1, hi[0, k] + 0.1, hi[2, k] + 0.1, **style)
    axes.scatter(middle[0], middle[2], s=14, c="#333333", linewidths=0, zorder=3)
    view(axes, (-3.8, 3.8), (-3.2, 3.2))


def _nodes(part: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        own = street()
        own["angle"] = np.full(12, 0.3)
        own["axis"] = np.stack((np.sin(np.arange(12.0)), -np.cos(np.arange(12.0)), np.zeros(12)))
        found = [np.asarray(m.light_tree(*own.values())[part], float) for m in (made, right)]
        found = [values[0] if values.ndim == 2 else values for values in found]
        steps(axes, *found)
        label(axes, "leaf, from left to right" if part == 5 else "node, from the root")

    return draw


def _passing(lo: tuple[float, ...], hi: tuple[float, ...]) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        n = 400
        x = np.linspace(-4, 4, n)
        column = np.ones((1, n))
        given = (
            np.array(lo)[:, None] * column,
            np.array(hi)[:, None] * column,
            np.array([[0.6], [-0.8], [0.0]]) * column,
            np.full(n, 0.3),
            np.full(n, 2.0),
            np.stack((x, np.full(n, -0.05), np.zeros(n))),
            np.array([[0.0], [1.0], [0.0]]) * column,
        )
        with np.errstate(all="ignore"):
            found = [np.asarray(m.importance(*given), float) for m in (made, right)]
        curves(axes, x, *(np.minimum(values, 3 * found[1].max()) for values in found))
        label(axes, "place of the point")

    return draw


def _walk(result: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        p, n, u = walkers(240)
        tree = right.light_tree(*street().values())
        place = (street()["lo"][0] + street()["hi"][0]) / 2
        for module, color, size in ((right, RIGHT, 9), (made, INK, 4)):
            lamp, probability = module.tree_choice(tree, p, n, u)
            seen = place[np.clip(lamp, 0, 11)] if result == 0 else probability
            axes.scatter(p[0], seen, s=size, c=color, linewidths=0)
        label(axes, "place of the point")

    return draw


def _probable(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    p, n, _ = walkers(240)
    tree = right.light_tree(*street().values())
    lamp = np.full(240, LAMP)
    curves(axes, p[0], *(m.tree_probability(tree, p, n, lamp) for m in (made, right)))
    label(axes, "place of the point")


LOOKS = {
    "power_choice": (
        Look("Probability of the lamp that a number chooses", plot(_choice(1), curve=True)),
        Look(
            "Lamp that a number chooses; 0, 2 and 5 have no power",
            plot(_choice(0), curve=True),
            ("power_at_the_border",),
        ),
    ),
    "merge_cones": (
        Look("Two cones in the plane, and the cone around them", plot(_cones(0))),
        Look(
            "A cone in a cone",
            plot(_cones(1)),
            ("cones_second_wide",),
        ),
        Look("Two opposite cones", plot(_cones(2)), ("cones_opposite",)),
    ),
    "light_tree": (
        Look("Twelve lamps and the boxes of the inner nodes, from above", plot(_boxes)),
        Look(
            "Lamp of each leaf",
            plot(_nodes(5), curve=True),
            ("tree_order_inverse",),
        ),
        Look(
            "Left end of each node's box",
            plot(_nodes(0), curve=True),
            ("tree_top_down",),
        ),
    ),
    "importance": (
        Look(
            "Importance of a node above the point's way",
            plot(_passing((-0.25, 0.2, -0.1), (0.25, 0.4, 0.1)), curve=True),
        ),
        Look(
            "Importance of a node that the point passes through",
            plot(_passing((-0.8, -0.3, -0.5), (0.8, 0.5, 0.5)), curve=True),
            (
                "importance_no_least_distance",
                "importance_nearest_without_least",
            ),
        ),
    ),
    "tree_choice": (
        Look("Places of the lamps that points along a street choose", plot(_walk(0), curve=True)),
        Look(
            "Probability of the lamp that is chosen",
            plot(_walk(1), curve=True),
            ("walk_last_probability",),
        ),
    ),
    "tree_probability": (
        Look("Probability of one lamp, from along the street", plot(_probable, curve=True)),
    ),
}
