"""Streaks: of a ball and a bar, and of a shadow."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from course.school.grading.pictures import scenes
from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import curves, label, plot
from sitebuild.mistakes.rendered import box, checked, floor, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LAMP: dict[str, Any] = {
    "camera": {
        "eye": [-0.4, 5.5, 3.6],
        "look_at": [-0.4, 0.2, -0.5],
        "vertical_fov": 20,
        "shutter": {"open": 0, "close": 0.5},
    },
    "sampler": {"samples": 49},
    "materials": {"floor": {"color": [0.22, 0.24, 0.27]}, "post": {"color": [0.7, 0.7, 0.65]}},
    "lights": [
        {
            "type": "point",
            "position": [0, 3.4, 2.4],
            "intensity": 55,
            "motion": {"velocity": [3.0, 0, 0]},
        },
        {"type": "ambient", "radiance": 0.25},
    ],
    "objects": [floor("floor"), box("post", [0.2, 1.3, 0.2], [0, 0.65, 0])],
}
"""A post, lit by a lamp that moves: its shadow alone tells how far the lamp has gone."""


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
            "A ball and a bar that move while the shutter is open",
            checked("motion_blur.shutter_times", scenes.moving),
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
            scene("motion_blur.displacement", LAMP),
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
            "A ball and a bar that move while the shutter is open",
            checked("motion_blur.to_object_space", scenes.moving),
            renders=True,
        ),
    ),
}
