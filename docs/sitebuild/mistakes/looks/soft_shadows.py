"""Points of lights as dots, and the shadow of a post."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import (
    INK,
    SECOND,
    Array,
    circle,
    dots,
    histogram,
    label,
    plot,
    polygon,
    view,
)
from sitebuild.mistakes.rendered import box, floor, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COUNT = 700
CORNER, EDGE_U, EDGE_V = (0.2, 0.1, 1), (2, 0, 0), (0.6, 1.2, 0)
CENTER, RADIUS = (0.0, 0.0, 0.0), 1.0


def _u(rows: int, count: int = COUNT) -> Array:
    return np.random.default_rng(3).random((rows, count), np.float32)


def _arrays(*points: tuple[float, ...]) -> list[Array]:
    return [np.array(point, np.float64) for point in points]


def _parallelogram(axes: Axes) -> None:
    corner, u, v = (np.array(x[:2]) for x in (CORNER, EDGE_U, EDGE_V))
    polygon(axes, *(tuple(p) for p in (corner, corner + u, corner + u + v, corner + v)))
    view(axes, (-0.4, 3.1), (-0.5, 1.6))


def _grid(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _parallelogram(axes)
    dots(axes, made.light_grid(*_arrays(CORNER, EDGE_U, EDGE_V), 5)[:2], size=10)


def _rectangle(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _parallelogram(axes)
    dots(axes, made.point_on_rectangle(*_arrays(CORNER, EDGE_U, EDGE_V), _u(2))[:2])


def _from_above(axes: Axes, points: Array, reach: float = 1.15) -> None:
    circle(axes, 0, 0, RADIUS)
    dots(axes, points[:2], size=2.5)
    view(axes, (-reach, reach), (-reach, reach))


def _upper(points: Array) -> Array:
    """Points of the near half of a sphere or a ball, as seen from along z."""
    return points[:, points[2] > 0]


def _sphere(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    _from_above(axes, _upper(made.point_on_sphere(*_arrays(CENTER), RADIUS, _u(2, 1500))))


def _sphere_aside(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    x, _y, z = made.point_on_sphere(*_arrays(CENTER), RADIUS, _u(2))
    _from_above(axes, np.stack((x, z)))


def _ball_slice(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.point_in_ball(*_arrays(CENTER), RADIUS, _u(3, 8000))
    _from_above(axes, points[:, np.abs(points[2]) < 0.1])


def _ball_height(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.point_in_ball(*_arrays(CENTER), RADIUS, _u(3, 2500))
    around = np.hypot(points[0], points[1])
    circle(axes, 0, 0, RADIUS)
    dots(axes, np.stack((around, points[2])), size=2)
    view(axes, (-0.1, 1.1), (-1.1, 1.1))


def _ball_distance(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = made.point_in_ball(*_arrays(CENTER), RADIUS, _u(3, 40000))
    histogram(axes, np.sqrt((points**2).sum(axis=0)), lambda r: 3 * r * r * (r <= 1), (0, 1.2))
    label(axes, "distance from the centre")


POINT = np.array((0.0, 0.0, 4.0))
"""From where a facing disk is looked at."""


def _disk(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = np.repeat(POINT.astype(np.float32)[:, None], COUNT, axis=1)
    _from_above(axes, made.point_on_facing_disk(*_arrays(CENTER), RADIUS, points, _u(2)))


def _disk_rings(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    points = np.repeat(POINT.astype(np.float32)[:, None], 40000, axis=1)
    found = made.point_on_facing_disk(*_arrays(CENTER), RADIUS, points, _u(2, 40000))
    histogram(axes, np.hypot(*found[:2]), lambda r: 2 * r * (r <= 1), (0, 1.2))
    label(axes, "distance from the centre")


def _disks_from_aside(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    """In the plane of x and z: three shading points around the lamp, a disk to face each."""
    circle(axes, 0, 0, RADIUS)
    for x, y, color in ((-2.6, 0, INK), (1.6, 1.9, SECOND), (0, -2.2, "#3c8d40")):
        point = np.array((x, 0, y), np.float32)
        many = np.repeat(point[:, None], 60, axis=1)
        others = np.array((-2.6, 0, 0), np.float32)[:, None]
        # All of them in one batch, which begins with the point on the left.
        found = made.point_on_facing_disk(
            *_arrays(CENTER), RADIUS, np.concatenate((others, many), axis=1), _u(2, 61)
        )[:, 1:]
        dots(axes, found[[0, 2]], color, 5)
        axes.plot([x, 0], [y, 0], color=color, linewidth=0.6, alpha=0.6)
        axes.scatter([x], [y], marker="s", s=22, c=color)
    view(axes, (-3, 2.6), (-2.5, 2.3))


def shadow(light: dict[str, Any], samples: int = 36) -> dict[str, Any]:
    """A post and its shadow, which runs across the picture."""
    return {
        "camera": {"eye": [0.55, 5.5, 2.6], "look_at": [0.55, 0, 0.05], "vertical_fov": 25},
        "sampler": {"samples": samples},
        "materials": {"floor": {"color": 0.7}, "post": {"color": [0.7, 0.25, 0.1]}},
        "lights": [light, {"type": "ambient", "radiance": 0.08}],
        "objects": [floor("floor"), box("post", [0.35, 1.5, 0.35], [-0.9, 0.75, 0])],
    }


def round_light(samples: str) -> dict[str, Any]:
    """A lamp to the left, in the shape of a ball."""
    return {
        "type": "sphere",
        "center": [-4, 4, 0],
        "radius": 0.8,
        "intensity": 55,
        "samples": samples,
    }


FLAT = {
    "type": "rectangle",
    "corner": [-4, 3.4, -0.8],
    "edge_u": [0, 0, 1.6],
    "edge_v": [0, 1.4, 0],
    "intensity": 45,
}


def _shadow(function: str, light: dict[str, Any], samples: int = 36) -> Any:
    return scene(f"soft_shadows.{function}", shadow(light, samples))


LOOKS = {
    "light_grid": (
        Look("The outline of the light, and 5 x 5 point lights", plot(_grid)),
        Look(
            "The shadow of a post by 5 x 5 point lights",
            _shadow("light_grid", FLAT | {"samples": "grid 5"}, 4),
            ("grid_edges_as_corners", "grid_diagonal"),
            renders=True,
        ),
    ),
    "point_on_rectangle": (
        Look("The outline of the light, and points that were chosen on it", plot(_rectangle)),
        Look(
            "The shadow of a post by a rectangle",
            _shadow("point_on_rectangle", FLAT),
            ("rectangle_about_corner",),
            renders=True,
        ),
    ),
    "point_on_sphere": (
        Look("The points of the near half, seen from above a pole", plot(_sphere)),
        Look(
            "The shadow of a post by a ball",
            _shadow("point_on_sphere", round_light("sphere")),
            ("sphere_half", "sphere_centre_forgotten", "sphere_diameter"),
            renders=True,
        ),
    ),
    "point_in_ball": (
        Look(
            "How many points lie how far out; the line is what it should be",
            plot(_ball_distance, curve=True),
            ("ball_crowded_middle", "ball_square_root", "ball_surface"),
        ),
        Look("A thin slice through the middle of the ball", plot(_ball_slice)),
        Look(
            "Height above the middle, over distance from the axis",
            plot(_ball_height),
            ("ball_shared_number",),
        ),
    ),
    "point_on_facing_disk": (
        Look(
            "A lamp from the side; three places, and the disk that faces each, in its colour",
            plot(_disks_from_aside),
            ("disk_world_axes", "disk_of_first_point", "disk_helper_axis", "disk_around_point"),
        ),
        Look("The points, as seen from the place that they face", plot(_disk)),
        Look(
            "How many points lie how far out; the line is what it should be",
            plot(_disk_rings, curve=True),
            ("disk_crowded_centre",),
        ),
    ),
}
