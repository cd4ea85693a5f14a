"""A room by few paths, the directions in which paths go on, and what roulette makes of their throughput."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import INK, SECOND, Array, Plot, curves, histogram, label, plot, view
from sitebuild.mistakes.rendered import ball, box, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _wall(material: str, at: list[float], *turn: Any) -> dict[str, Any]:
    """A square of 2 x 2; without a turn it looks up."""
    turned = [{"rotate": {"axis": turn[0], "degrees": turn[1]}}] if turn else []
    transform = [*turned, {"translate": at}]
    return {"shape": "quad", "material": material, "width": 2, "depth": 2, "transform": transform}


ROOM: dict[str, Any] = {
    "camera": {"eye": [0, 1, 3.7], "look_at": [0, 1, 0], "vertical_fov": 40},
    "film": {"width": 150, "height": 100},
    "sampler": {"samples": 64},
    "integrator": {"type": "path", "max_depth": 10},
    "materials": {
        "white": {"color": 0.73},
        "red": {"color": [0.63, 0.06, 0.05]},
        "green": {"color": [0.12, 0.45, 0.09]},
    },
    "lights": [
        {
            "type": "rectangle",
            "corner": [-0.5, 1.7, -0.5],
            "edge_u": [0, 0, 1],
            "edge_v": [1, 0, 0],
            "radiance": [26, 24, 22],
        }
    ],
    "objects": [
        _wall("white", [0, 0, 0]),
        _wall("white", [0, 2, 0], [1, 0, 0], 180),
        _wall("white", [0, 1, -1], [1, 0, 0], 90),
        _wall("red", [-1, 1, 0], [0, 0, 1], -90),
        _wall("green", [1, 1, 0], [0, 0, 1], 90),
        box("white", [0.5, 0.9, 0.5], [-0.45, 0.45, -0.3], ("y", 20.0)),
        ball("white", 0.35, [0.45, 0.35, 0.2]),
    ],
}
"""Its lamp shines at the ceiling, so that nearly all light is reflected light."""


def _leaving(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    """Three places of a surface, seen along x: their normals, and forty directions of paths from each."""
    u = np.random.default_rng(5).random((2, 40), np.float32)
    for at, (y, z) in (
        ((-1.6, 0.0), (0.0, 1.0)),
        ((0.5, 0.0), (1.0, 0.0)),
        ((3.0, 0.4), (-0.6, -0.8)),
    ):
        normal = np.repeat(np.array([[0], [y], [z]], np.float32), 40, axis=1)
        for way in np.asarray(made.diffuse_bounce(normal, u)).T:
            axes.plot([at[0], at[0] + way[1]], [at[1], at[1] + way[2]], color=INK, linewidth=0.7)
        axes.plot(
            [at[0] - 0.7 * z, at[0] + 0.7 * z],
            [at[1] + 0.7 * y, at[1] - 0.7 * y],
            color="#777",
            linewidth=3,
        )
        axes.annotate(
            "",
            (at[0] + 1.2 * y, at[1] + 1.2 * z),
            at,
            arrowprops={"arrowstyle": "->", "color": SECOND, "linewidth": 1.5, "shrinkA": 0},
            zorder=5,
        )
    view(axes, (-2.6, 3.9), (-1.6, 1.4))


def _heights(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    normal = np.repeat(np.array([[0], [0], [1]], np.float32), 60000, axis=1)
    u = np.random.default_rng(3).random((2, 60000), np.float32)
    histogram(axes, made.diffuse_bounce(normal, u)[2], lambda c: 2 * c * (c <= 1), (0, 1.2))
    label(axes, "cosine: 0 the surface, 1 the normal")


def _roulette(module: ModuleType, red: float) -> tuple[Array, Array]:
    """Which of many paths survive, and their red, of paths that are red above all."""
    count = 4000
    beta = np.array([red, red / 3, red / 6], np.float64)[:, None] * np.ones(count)
    survives, after = module.russian_roulette(beta, (np.arange(count) + 0.5) / count)
    return np.asarray(survives).astype(bool), after[0]


def _over(summary: Any, x: str, most: float) -> Plot:
    """Draw a number that sums many paths up, over their red before."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        red = np.linspace(0.02, most, 50)
        found = [
            np.array([summary(*_roulette(module, float(r))) for r in red])
            for module in (made, right)
        ]
        curves(axes, red, *found)
        axes.set_ylim(0, 1.15 * max(most, float(np.nanmax(found[0]))))
        label(axes, x)

    return draw


def _mean(_: Array, red: Array) -> float:
    return float(red.mean())


def _brightest(survives: Array, red: Array) -> float:
    return float(red[survives].max()) if survives.any() else np.nan


_SHOWN = "A room whose lamp shines at the ceiling, by 64 paths a pixel"

LOOKS = {
    "diffuse_bounce": (
        Look(
            "Three places of surfaces, their normals in blue, and forty paths from each",
            plot(_leaving),
        ),
        Look(
            "How many directions are how steep; the line is what it should be",
            plot(_heights, curve=True),
            ("bounce_uniform", "bounce_crowded", "bounce_by_angle"),
        ),
    ),
    "throughput": (Look(_SHOWN, scene("path_tracing.throughput", ROOM), renders=True),),
    "russian_roulette": (
        Look(
            "The mean of many paths afterwards; grey below: the right one, which is what it was",
            plot(_over(_mean, "red before, and its mean afterwards", 2), curve=True),
        ),
        Look(
            "The red of the paths that survive; grey below: the right one",
            plot(_over(_brightest, "red before, and that of survivors", 1), curve=True),
            ("roulette_by_mean", "roulette_by_smallest"),
        ),
    ),
}
