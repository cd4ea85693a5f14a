"""Streaks: of a ball that crosses a ruler, and of a shadow."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import curves, label, plot
from sitebuild.mistakes.rendered import ball, box, floor, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHUTTER = {"open": 0.3, "close": 0.7}


def _description(shutter: dict[str, float]) -> dict[str, Any]:
    return {
        "camera": {
            "eye": [0, 4.2, 6.5],
            "look_at": [0, 0.25, 0.1],
            "vertical_fov": 21,
            "shutter": shutter,
        },
        "sampler": {"samples": 49},
        "materials": {
            "floor": {"color": [0.22, 0.24, 0.27]},
            "mark": {"color": [0.8, 0.8, 0.75]},
            "ball": {"color": [0.85, 0.35, 0.05], "ambient": 0.5},
            "blue": {"color": [0.1, 0.25, 0.8], "ambient": 0.5},
            "post": {"color": [0.7, 0.7, 0.65]},
        },
        "lights": [
            {"type": "directional", "direction": [0.1, -1, -0.35], "irradiance": 2},
            {"type": "ambient", "radiance": 0.4},
        ],
    }


def _marks(z: float, first: int) -> list[dict[str, Any]]:
    """A ruler on the floor, a mark each metre; the one at the start is long."""
    return [
        box("mark", [0.04, 0.02, 1.1 if i == first else 0.35], [-2 + i, 0.01, z]) for i in range(5)
    ]


def _crossing(shutter: dict[str, float], first: int) -> dict[str, Any]:
    """A ball that at time 0 is at the long mark, which is one of five."""
    moving = ball("ball", 0.4, [-2.0 + first, 0.42, 0])
    return _description(shutter) | {
        "objects": [
            floor("floor"),
            *_marks(0.75, first),
            moving | {"motion": {"velocity": [4.5, 0, 0]}},
        ]
    }


def _lamp(velocity: list[float]) -> dict[str, Any]:
    """A post, lit by a lamp that moves."""
    light = {"type": "point", "position": [0, 3.4, 2.4], "intensity": 55}
    return _description({"open": 0, "close": 0.5}) | {
        "camera": {
            "eye": [-0.4, 5.5, 3.6],
            "look_at": [-0.4, 0.2, -0.5],
            "vertical_fov": 20,
            "shutter": {"open": 0, "close": 0.5},
        },
        "lights": [
            light | {"motion": {"velocity": velocity}},
            {"type": "ambient", "radiance": 0.25},
        ],
        "objects": [floor("floor"), box("post", [0.2, 1.3, 0.2], [0, 0.65, 0])],
    }


def _times(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    u = np.linspace(0, 0.999, 50, dtype=np.float32)
    curves(axes, u, made.shutter_times(0.3, 0.7, u), right.shutter_times(0.3, 0.7, u))
    axes.set_ylim(-0.05, 1.05)
    label(axes, "u, and the time [s] that it becomes")


def _gone(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    time = np.linspace(-0.5, 1, 50, dtype=np.float32)
    for speed in (3.0, 0.5):
        velocity = np.array((speed, 0, 0))
        curves(
            axes, time, made.displacement(velocity, time)[0], right.displacement(velocity, time)[0]
        )
    label(axes, "time [s]")


LOOKS = {
    "shutter_times": (
        Look(
            "A ball that starts at the long mark, seen from 0.3 s to 0.7 s",
            scene("motion_blur.shutter_times", _crossing(SHUTTER, 0)),
            renders=True,
        ),
        Look(
            "The time for each u, shutter open from 0.3 s to 0.7 s; grey below: the right line",
            plot(_times, curve=True),
            ("unit_time", "open_ignored", "close_as_length", "backwards"),
        ),
    ),
    "displacement": (
        Look(
            "The shadow of a post by a lamp that moves to the right",
            scene("motion_blur.displacement", _lamp([3.0, 0, 0])),
            renders=True,
        ),
        Look(
            "How far a fast and a slow thing have gone; grey below: the right lines",
            plot(_gone, curve=True),
            ("unit_speed", "accelerated"),
        ),
    ),
    "to_object_space": (
        Look(
            "A ball that starts at the long mark, seen from 0 s to 0.4 s",
            scene("motion_blur.to_object_space", _crossing({"open": 0, "close": 0.4}, 2)),
            renders=True,
        ),
    ),
}
