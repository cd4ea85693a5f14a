"""Pictures that a lens makes, points on it, and two formulas as curves."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from course.engine.functions.effects import PROJECT
from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import INK, RIGHT, circle, curves, dots, label, plot, view
from sitebuild.mistakes.rendered import ball, box, floor, glow, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TILES = PROJECT / "scenes" / "textures" / "tiles.png"


def _disk(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    circle(axes, 0, 0, 1)
    dots(axes, made.point_on_disk(np.random.default_rng(3).random((2, 900), np.float32)))
    view(axes, (-1.1, 1.1), (-1.1, 1.1))


def _lamps(lens: dict[str, Any], samples: int) -> dict[str, Any]:
    """Small lamps, far behind what is in focus."""
    colors = {
        "warm": (1.0, 0.5, 0.15),
        "white": (0.9, 0.85, 0.7),
        "blue": (0.2, 0.35, 1.0),
        "red": (1.0, 0.1, 0.06),
    }
    at = [
        (-2.6, 1.3),
        (-0.5, 1.5),
        (1.9, 1.2),
        (-1.7, -0.4),
        (0.5, -0.2),
        (2.9, -0.9),
        (-0.6, -1.6),
    ]
    return {
        "camera": {
            "eye": [0, 0, 4],
            "look_at": [0, 0, 0],
            "vertical_fov": 32,
            "lens": {"aperture_radius": 0.22, "focus_distance": 3} | lens,
        },
        "sampler": {"samples": samples},
        "integrator": {"max_depth": 0},
        "environment": {"type": "constant", "radiance": [0.01, 0.013, 0.03]},
        "materials": {name: glow(*color) for name, color in colors.items()},
        "lights": [{"type": "ambient", "radiance": 12}],
        "objects": [
            ball(tuple(colors)[i % 4], 0.14, [x * 1.15, y * 1.15, -5.0])
            for i, (x, y) in enumerate(at)
        ],
    }


WALL = {
    "camera": {
        "eye": [0, 0, 2.2],
        "look_at": [0, 0, 0],
        "vertical_fov": 80,
        "lens": {"aperture_radius": 0.12, "focus_distance": 2.2},
    },
    "sampler": {"samples": 36},
    "materials": {"wall": {"texture": {"image": str(TILES), "repeat": [6, 4]}, "ambient": 1}},
    "lights": [{"type": "ambient", "radiance": 1.3}],
    "objects": [
        {
            "shape": "quad",
            "material": "wall",
            "width": 6,
            "depth": 4,
            "transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}],
        }
    ],
}
"""A flat wall, in focus all over."""


def _pieces() -> dict[str, Any]:
    """Posts before, in and behind the plane in focus."""
    colors = {
        "amber": (0.85, 0.4, 0.05),
        "white": (0.8, 0.8, 0.75),
        "blue": (0.1, 0.25, 0.75),
        "green": (0.1, 0.5, 0.15),
        "red": (0.8, 0.08, 0.05),
    }
    return {
        "camera": {
            "eye": [5, 1.5, 1.2],
            "look_at": [0, 0.62, 0],
            "vertical_fov": 24,
            "lens": {"aperture_radius": 0.4, "focus_point": [0, 0.6, 0]},
        },
        "sampler": {"samples": 36},
        "environment": {"type": "constant", "radiance": [0.3, 0.34, 0.4]},
        "materials": {"floor": {"color": [0.3, 0.28, 0.25]}}
        | {name: {"color": list(color)} for name, color in colors.items()},
        "lights": [
            {"type": "directional", "direction": [-0.5, -1, -0.7], "irradiance": 2.4},
            {"type": "ambient", "radiance": 0.35},
        ],
        "objects": [
            floor("floor"),
            *(
                box(name, [0.34, 1.2, 0.34], [2.2 - 1.1 * i, 0.6, -1.0 + 0.5 * i], ("y", 20.0))
                for i, name in enumerate(colors)
            ),
        ],
    }


def _arrows(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    """Rays from the lens, at their own length, to a point in focus ahead."""
    count = 7
    lens = np.zeros((2, count), np.float32)
    lens[1] = np.linspace(-1, 1, count)
    pinhole = np.repeat(np.array([[0], [0], [-1]], np.float32), count, axis=1)
    axes_of = [np.array(each, np.float64) for each in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, -1))]
    origins, directions = made.lens_rays(*axes_of, pinhole, lens, 3.0)
    axes.plot([0, 0], [-1.15, 1.15], color=RIGHT, linewidth=3, alpha=0.6)
    axes.plot([3], [0], "o", color="#333", markersize=4)
    for (_x, y, _z), (_dx, dy, dz) in zip(origins.T, directions.T, strict=True):
        axes.plot([0, 3], [y, 0], color="#dddddd", linewidth=0.7, zorder=0)
        axes.annotate(
            "",
            (-dz, y + dy),
            (0, y),
            arrowprops={
                "arrowstyle": "->",
                "color": INK,
                "linewidth": 1.3,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
    view(axes, (-0.2, 3.4), (-1.2, 1.2))


def _image(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    x = np.concatenate((np.linspace(0.1, 0.99, 60), [np.nan], np.linspace(1.01, 4, 90)))

    def distances(of: Callable[..., float]) -> list[float]:
        return [np.nan if np.isnan(d) else float(of(1.0, float(d))) for d in x]

    axes.axhline(0, color="#bbb", linewidth=0.7)
    curves(
        axes, x, np.array(distances(made.image_distance)), np.array(distances(right.image_distance))
    )
    axes.set_ylim(-5, 5)
    label(axes, "object distance, focal length 1")


LIMITS = (("f", 1.0), ("infinity", np.inf), ("2 f", 2.0))


def _limits(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    for row, (name, distance) in enumerate(LIMITS):
        try:
            value = f"{float(made.image_distance(1.0, distance)):g}"
        except ArithmeticError as error:
            value = type(error).__name__
        axes.text(
            0.02, 0.8 - 0.3 * row, f"object at {name}:", fontsize=8.5, va="center", color="#333"
        )
        axes.text(0.48, 0.8 - 0.3 * row, value, fontsize=8.5, va="center", color=INK, weight="bold")
    axes.set_xlim(0, 1)
    axes.set_ylim(0, 1)


def _circle(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    z = np.linspace(0.4, 8, 200)
    axes.axhline(0, color="#bbb", linewidth=0.7)
    curves(axes, z, made.circle_of_confusion(z, 0.5, 2.0), right.circle_of_confusion(z, 0.5, 2.0))
    axes.set_ylim(-1, 2.5)
    label(axes, "depth; in focus at 2, aperture 0.5")


LOOKS = {
    "point_on_disk": (
        Look(
            "The outline of the lens, and points on it",
            plot(_disk),
            ("crowded_disk", "radius_squared"),
        ),
        Look(
            "Small lamps far behind what is in focus",
            scene("thin_lens.point_on_disk", _lamps({}, 64)),
            renders=True,
        ),
    ),
    "lens_rays": (
        Look(
            "A flat wall in focus, by a wide lens",
            scene("thin_lens.lens_rays", WALL),
            ("sphere", "wrong_cosine"),
            renders=True,
            files=(TILES,),
        ),
        Look(
            "Posts, the one in the middle in focus",
            scene("thin_lens.lens_rays", _pieces()),
            renders=True,
        ),
        Look(
            "Small lamps out of focus, by a lens with three blades",
            scene("thin_lens.lens_rays", _lamps({"shape": "polygon", "blades": 3}, 64)),
            ("swapped",),
            renders=True,
        ),
        Look(
            "Directions from the lens towards a point in focus, each as long as it is",
            plot(_arrows),
            ("lens_not_normalised",),
        ),
    ),
    "image_distance": (
        Look(
            "Where the image is, over the object's distance; grey below: the right curve",
            plot(_image, curve=True),
        ),
        Look(
            "The image's distance for a lens of focal length f = 1",
            plot(_limits),
            ("image_limits",),
        ),
    ),
    "circle_of_confusion": (
        Look(
            "How wide a point becomes, over its depth; grey below: the right curve",
            plot(_circle, curve=True),
        ),
    ),
}
