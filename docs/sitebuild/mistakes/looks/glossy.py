"""Directions of a lobe as the direction itself sees them, and a floor that mirrors."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from course.school.grading.pictures import scenes
from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import (
    INK,
    RIGHT,
    SECOND,
    Array,
    Plot,
    circle,
    dots,
    histogram,
    label,
    plot,
    square,
    view,
)
from sitebuild.mistakes.rendered import checked

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DIRECTION = np.array((0.36, 0.48, 0.8), np.float32)


def _u(rows: int, count: int = 700) -> Array:
    return np.random.default_rng(3).random((rows, count), np.float32)


def _along(count: int) -> Array:
    return np.repeat(DIRECTION[:, None], count, axis=1)


def _across(right: ModuleType, found: Array) -> Array:
    """Directions as places (2, N) on a plane at distance 1, at right angles to DIRECTION."""
    a, b = (axis[:, 0] for axis in right.orthonormal_basis(DIRECTION[:, None]))
    return np.stack((a @ found, b @ found)) / (DIRECTION @ found)


def _arrows(around: tuple[float, float, float], reach: float) -> Plot:
    """Draw u and v of directions about an axis, as seen along it."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        axis = np.array(around, np.float32)[:, None]
        s, t = (each.astype(np.float64) for each in right.orthonormal_basis(axis))
        x, y = (c.ravel() for c in np.meshgrid(np.arange(-2, 3), np.arange(-1, 2)))
        w = axis + reach * (x * s + y * t)
        w = (w / np.linalg.norm(w, axis=0)).astype(np.float32)
        u, v = made.orthonormal_basis(w)
        for at in zip(x, y, strict=True):
            circle(axes, *at, 1 / 2.4, color="#dddddd")
        for vectors, color in ((u, INK), (v, SECOND)):
            along = np.stack((s[:, 0] @ vectors, t[:, 0] @ vectors))
            axes.quiver(x, y, *along, color=color, scale=2.4, units="xy", width=0.05, headwidth=4)
        lost = ~(np.linalg.norm(u, axis=0) > 0.5) | ~(np.linalg.norm(v, axis=0) > 0.5)
        axes.scatter(x[lost], y[lost], marker="x", s=120, c="#d01010", linewidths=2.5, zorder=5)
        view(axes, (-2.45, 2.45), (-1.45, 1.45))

    return draw


ROUGHNESS = 0.6


def _plane(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    found = made.jitter_on_plane(_along(700), ROUGHNESS, _u(2))
    half = ROUGHNESS / 2
    square(axes, -half, -half, half, half)
    axes.plot([0], [0], "+", color="#333", markersize=9)
    dots(axes, _across(right, found))
    view(axes, (-0.65, 0.65), (-0.65, 0.65))


def _from_aside(axes: Axes, found: Array) -> None:
    """Arrows from one point, in the plane of DIRECTION and of what the first number moves."""
    angle = np.linspace(-0.85, 0.85, 50)
    axes.plot(np.sin(angle), np.cos(angle), color=RIGHT, linewidth=3, alpha=0.5)
    for x, y in found.T:
        axes.annotate(
            "",
            (x, y),
            (0, 0),
            arrowprops={"arrowstyle": "->", "color": INK, "shrinkA": 0, "shrinkB": 0},
        )
    view(axes, (-1.05, 1.05), (-0.02, 1.12))


def _length(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    direction = np.repeat(np.array([[0], [0], [1]], np.float32), 7, axis=1)
    u = np.full((2, 7), 0.5, np.float32)
    u[0] = np.linspace(0, 1, 7)
    x, _y, z = made.jitter_on_plane(direction, 2.0, u)
    _from_aside(axes, np.stack((x, z)))


def _cone(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    found = made.jitter_in_ball(_along(900), 0.5, _u(3, 900))
    circle(axes, 0, 0, float(np.tan(np.arcsin(0.5))))
    dots(axes, _across(right, found))
    view(axes, (-0.8, 0.8), (-0.8, 0.8))


def _angles(make: Callable[[ModuleType, int], Array], reach: float) -> Plot:
    """Draw how many directions are how far from DIRECTION [degrees], over those that should be."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        def degrees(module: ModuleType) -> Array:
            cosine = DIRECTION @ make(module, 60000)
            return np.degrees(np.arccos(np.clip(cosine, -1, 1)))

        count, edges = np.histogram(degrees(right), 40, (0, reach), density=True)
        middle = (edges[1:] + edges[:-1]) / 2
        histogram(axes, degrees(made), lambda x: np.interp(x, middle, count), (0, reach))
        label(axes, "degrees from the middle")

    return draw


def _in_ball(made: ModuleType, count: int) -> Array:
    found: Array = made.jitter_in_ball(_along(count), 0.5, _u(3, count))
    return found


def _lobe(exponent: float) -> Callable[[ModuleType, int], Array]:
    def make(made: ModuleType, count: int) -> Array:
        found: Array = made.sample_phong_lobe(_along(count), exponent, _u(2, count))
        return found

    return make


def _lobe_ahead(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    found = made.sample_phong_lobe(_along(700), 40.0, _u(2))
    axes.plot([0], [0], "+", color="#333", markersize=9, zorder=4)
    dots(axes, _across(right, found[:, DIRECTION @ found > 0.1]))
    view(axes, (-0.7, 0.7), (-0.6, 0.6))


def _kept(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    """Directions in the plane of the picture: those that came in dashed, those that came back as arrows."""
    angle = np.radians([150, 120, 75, 40, 12, -12, -30, -52], dtype=np.float32)
    direction = np.stack((np.cos(angle), np.sin(angle), np.zeros_like(angle)))
    normal = np.zeros_like(direction)
    normal[1] = 1
    found = made.keep_above(direction, normal)
    axes.axhspan(-2, 0, color="#ececec", zorder=0)
    axes.axhline(0, color="#777", linewidth=1.2)
    for number, (before, after) in enumerate(zip(direction.T, found.T, strict=True)):
        color = SECOND if before[1] < 0 else INK
        axes.plot([0, before[0]], [0, before[1]], color=color, linestyle=":", linewidth=1)
        if np.hypot(*after[:2]) > 0.05:
            axes.annotate(
                "",
                after[:2],
                (0, 0),
                arrowprops={"arrowstyle": "->", "color": color, "linewidth": 1.3, "shrinkB": 0},
                zorder=3 + number,
            )
    view(axes, (-1.1, 1.1), (-0.85, 1.1))


def _mirrored(rng: np.random.Generator) -> scenes.Scene:
    return scenes.reflections(rng, {"lobe": "phong", "exponent": 80}, 36)


LOOKS = {
    "orthonormal_basis": (
        Look(
            "The first vector (brown) and the second (blue) for directions next to +y; rings show length 1",
            plot(_arrows((0, 1, 0), 0.12)),
            ("fixed_helper",),
        ),
        Look(
            "The first vector (brown) and the second (blue) for directions all but at -z; rings show length 1",
            plot(_arrows((0, 0, -1), 2e-4)),
            ("frisvad",),
        ),
        Look(
            "The first vector (brown) and the second (blue) for directions around one; rings show length 1",
            plot(_arrows((0.36, 0.8, 0.48), 0.12)),
        ),
    ),
    "jitter_on_plane": (
        Look(
            "Where the directions pierce the square, and the square",
            plot(_plane),
            ("one_sided", "twice_as_wide", "one_number", "world_axes"),
        ),
        Look(
            "Directions as arrows, and all that are of length 1",
            plot(_length),
            ("plane_not_normalised",),
        ),
    ),
    "jitter_in_ball": (
        Look(
            "Directions on a plane across the middle one, and the cone that holds them",
            plot(_cone),
            ("cube",),
        ),
        Look(
            "How many directions are how far from the middle; the line is what it should be",
            plot(_angles(_in_ball, 33), curve=True),
        ),
    ),
    "sample_phong_lobe": (
        Look(
            "How many directions are how far from the middle, for exponent 2; the line is what it should be",
            plot(_angles(_lobe(2), 90), curve=True),
            ("exponent_off_by_one",),
        ),
        Look(
            "Directions around the one that is asked for (+), for exponent 40",
            plot(_lobe_ahead),
            ("half_turn",),
        ),
        Look(
            "Bright posts, mirrored by a floor, for exponent 80",
            checked("glossy.sample_phong_lobe", _mirrored),
            renders=True,
        ),
    ),
    "keep_above": (
        Look(
            "Dotted, what came in, above the surface or below it; arrows, what came back",
            plot(_kept),
        ),
    ),
}
