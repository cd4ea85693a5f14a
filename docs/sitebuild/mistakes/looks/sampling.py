"""Points as dots, and what a generator of random numbers makes."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import (
    INK,
    RIGHT,
    SECOND,
    Array,
    circle,
    dots,
    histogram,
    label,
    plot,
    view,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COUNT = 500


def _u(rows: int, count: int = 900) -> Array:
    return np.random.default_rng(3).random((rows, count), np.float32)


def _round(axes: Axes, points: Array, size: float = 3) -> None:
    circle(axes, 0, 0, 1)
    dots(axes, points, size=size)
    view(axes, (-1.1, 1.1), (-1.1, 1.1))


class Counting:
    """A generator that counts the numbers that it gives."""

    def __init__(self) -> None:
        self._rng = np.random.default_rng(3)
        self.count = 0

    def __getattr__(self, name: str) -> Any:
        def called(*arguments: Any, **named: Any) -> Any:
            value = getattr(self._rng, name)(*arguments, **named)
            self.count += np.size(value)
            return value

        return called


def _rejected(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    rng = Counting()
    points = made.disk_by_rejection(COUNT, rng)
    _round(axes, points)
    for y, text in ((0.8, f"{points.shape[1]} points"), (0.6, f"{rng.count} numbers")):
        axes.text(1.15, y, text, fontsize=7.5, ha="left", va="center", color="#333")
    view(axes, (-1.1, 2.2), (-1.1, 1.1))


def _twice(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    first, second = (made.disk_by_rejection(30, np.random.default_rng(3)) for _ in range(2))
    _round(axes, first, 9)
    axes.scatter(*second, s=50, facecolors="none", edgecolors=SECOND, linewidths=1)


def _disk(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _round(axes, made.disk_by_polar(_u(2)))


def _ball_distance(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    distance = np.sqrt((made.ball_by_polar(_u(3, 40000)) ** 2).sum(axis=0))
    histogram(axes, distance, lambda r: 3 * r * r * (r <= 1), (0, 1.2))
    label(axes, "distance from the centre")


def _ball_from_above(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.ball_by_polar(_u(3, 6000))
    _round(axes, points[:2, np.hypot(*points[:2]) < 1], 1.2)


def _ball_height(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.ball_by_polar(_u(3, 2500))
    circle(axes, 0, 0, 1)
    dots(axes, np.stack((np.hypot(points[0], points[1]), points[2])), size=2)
    view(axes, (-0.1, 1.1), (-1.1, 1.1))


def _sphere_from_above(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.sphere_by_polar(_u(2, 1800))
    _round(axes, points[:2, points[2] > 0])


def _sphere_aside(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.sphere_by_polar(_u(2))
    _round(axes, points[[0, 2]])


def _stream(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """Twelve random numbers in a row, from one start."""
    for module, right_one in ((right, True), (made, False)):
        state, numbers = np.array([2463534242], np.uint32), []
        for _ in range(12):
            state, number = module.xorshift32(state)
            # A state that is too wide stays so only within a step: the next one is given 32 bits again.
            numbers.append(float(number[0]))
            state = state.astype(np.uint32)
        x = np.arange(12)
        if right_one:
            axes.scatter(x, numbers, s=42, facecolors="none", edgecolors=RIGHT, linewidths=1.2)
        else:
            axes.vlines(x, 0, numbers, color=INK, linewidth=0.8)
            axes.scatter(x, numbers, s=9, c=INK, zorder=4)
    axes.axhline(1, color="#999", linewidth=0.8, linestyle="--")
    axes.set_ylim(bottom=0)
    label(axes, "step")


LOOKS = {
    "disk_by_rejection": (
        Look(
            "500 points are asked for: how many came, and how many random numbers they took",
            plot(_rejected),
        ),
        Look(
            "Points, as dots, and as rings from a second call with the same seed",
            plot(_twice),
            ("disk_own_generator",),
        ),
    ),
    "disk_by_polar": (Look("The unit circle, and points in it", plot(_disk)),),
    "ball_by_polar": (
        Look(
            "How many points lie how far out; the line is what it should be",
            plot(_ball_distance, curve=True),
        ),
        Look("All points, seen from above a pole", plot(_ball_from_above), ("ball_poles",)),
        Look(
            "Height above the middle, over distance from the axis",
            plot(_ball_height),
            ("ball_one_number",),
        ),
    ),
    "sphere_by_polar": (
        Look("The upper half, seen from above the pole", plot(_sphere_from_above)),
        Look("The sphere from the side", plot(_sphere_aside), ("sphere_half",)),
    ),
    "xorshift32": (
        Look("Twelve numbers in a row; rings show the right ones", plot(_stream, curve=True)),
    ),
}
