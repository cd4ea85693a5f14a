"""Rays at a surface as arrows, a lobe as dots, and how much is reflected as a curve."""

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
    circle,
    curves,
    dots,
    histogram,
    label,
    plot,
    square,
    view,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

GLASS = "#e2edf2"


def _rays(degrees: Array) -> tuple[Array, Array]:
    """Directions that go down at those angles from the vertical, and the normal that they meet."""
    angle = np.radians(degrees)
    direction = np.stack((np.sin(angle), -np.cos(angle), np.zeros_like(angle)))
    normal = np.zeros_like(direction)
    normal[1] = 1
    return direction, normal


def _bent(degrees: tuple[float, ...], eta: float, *, into_glass: bool) -> Plot:
    """Draw rays from above: thin what comes, arrows what goes on, blue if the mask says total reflection."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        direction, normal = _rays(np.array(degrees))
        axes.axhspan(*((-2, 0) if into_glass else (0, 2)), color=GLASS, zorder=0)
        axes.axhline(0, color="#777", linewidth=1.2)
        expected, _ = right.refract(direction, normal, eta)
        found, total = made.refract(direction, normal, eta)
        for before, after, out, masked in zip(direction.T, expected.T, found.T, total, strict=True):
            color = SECOND if masked else INK
            axes.plot([-before[0], 0], [-before[1], 0], color="#555", linewidth=0.9)
            axes.plot([0, after[0]], [0, after[1]], color=RIGHT, linewidth=3, alpha=0.45)
            if np.isfinite(out).all() and np.hypot(*out[:2]) > 0.05:
                axes.annotate(
                    "",
                    out[:2],
                    (0, 0),
                    annotation_clip=False,
                    arrowprops={
                        "arrowstyle": "->",
                        "color": color,
                        "linewidth": 1.3,
                        "shrinkA": 0,
                        "shrinkB": 0,
                    },
                    zorder=4,
                )
        view(axes, (-1.2, 1.2), (-1.1, 1.1))

    return draw


def _u(count: int) -> Array:
    return np.random.default_rng(3).random((2, count))


def _aside(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    direction, normal = _rays(np.full(500, 74.0))
    found = made.jitter_refraction(direction, normal, 1.2, _u(500))
    axes.axhspan(-3, 0, color=GLASS, zorder=0)
    axes.axhline(0, color="#777", linewidth=1.2)
    circle(axes, 0, 0, 1)
    axes.annotate(
        "", direction[:2, 0], (0, 0), arrowprops={"arrowstyle": "->", "color": "#333"}, zorder=5
    )
    dots(axes, found[:2])
    view(axes, (-1.1, 1.3), (-1.1, 0.8))


def _depths(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    direction, normal = _rays(np.full(20000, 74.0))

    def degrees(module: ModuleType) -> Array:
        found = module.jitter_refraction(direction, normal, 1.2, _u(20000))
        return np.degrees(np.arcsin(np.clip(-found[1], -1, 1)))

    count, edges = np.histogram(degrees(right), 48, (0, 60), density=True)
    middle = (edges[1:] + edges[:-1]) / 2
    histogram(axes, degrees(made), lambda x: np.interp(x, middle, count), (0, 60))
    label(axes, "degrees below the surface")


def _across(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """Where directions pierce a plane at right angles to the refracted one."""
    direction, normal = _rays(np.full(500, 20.0))
    corners = right.jitter_refraction(
        direction[:, :5], normal[:, :5], 0.6, np.array([[0.5, 0.0, 1, 0, 1], [0.5, 0, 0, 1, 1]])
    )
    d = direction[:, 0]
    a = corners[:, 2] / (d @ corners[:, 2]) - corners[:, 1] / (d @ corners[:, 1])
    b = corners[:, 3] / (d @ corners[:, 3]) - corners[:, 1] / (d @ corners[:, 1])
    found = made.jitter_refraction(direction, normal, 0.6, _u(500))
    x, y = (axis / np.linalg.norm(axis) for axis in (a, b))
    square(axes, -0.3, -0.3, 0.3, 0.3)
    axes.plot([0], [0], "+", color="#333", markersize=9)
    dots(axes, np.stack((x @ found, y @ found)) / (d @ found))
    view(axes, (-0.65, 0.65), (-0.65, 0.65))


def _reflected(eta: float) -> Plot:
    """Draw the share that is reflected over the angle."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        angle = np.linspace(0, 90, 361)
        cos = np.cos(np.radians(angle))
        curves(axes, angle, made.fresnel(cos, eta), right.fresnel(cos, eta))
        axes.set_ylim(-0.02, 1.05)
        label(axes, "degrees from the normal")

    return draw


LOOKS = {
    "refract": (
        Look(
            "Rays from air into glass; grey below: where they should go",
            plot(_bent((0, 25, 50, 70), 1 / 1.5, into_glass=True)),
        ),
        Look(
            "Rays from glass into air; blue ones are marked as totally reflected; grey below: where they should go",
            plot(_bent((10, 30, 50, 70), 1.5, into_glass=False)),
            (
                "straight_through",
                "clamped_root",
                "turned_back",
                "zero_where_total",
                "mask_inverted",
            ),
        ),
    ),
    "jitter_refraction": (
        Look(
            "Directions that a rough surface makes of one (the arrow), from the side; glass is below",
            plot(_aside),
        ),
        Look(
            "How far below the surface those directions go",
            plot(_depths, curve=True),
            ("clamped",),
        ),
        Look(
            "Directions on a plane across the refracted one, and the square",
            plot(_across),
            ("one_sided", "twice_as_wide", "one_number"),
        ),
    ),
    "fresnel": (
        Look(
            "The share that silicon reflects, with a refraction index of 4; grey below: the right one",
            plot(_reflected(1 / 4), curve=True),
            ("schlick",),
        ),
        Look(
            "The share that glass reflects; grey below: the right one",
            plot(_reflected(1 / 1.5), curve=True),
        ),
    ),
}
