"""Where on a spherical light its points are: by functions of `soft_shadows`, or by those of `sampling` moved there."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from course.core.types import Floats32
from course.effects import Bound
from course.scene.rejection import BALL, by_rejection

SPHERES = {
    "sphere": ("soft_shadows", "point_on_sphere"),
    "ball": ("soft_shadows", "point_in_ball"),
    "facing disk": ("soft_shadows", "point_on_facing_disk"),
    "sphere by polar": ("sampling", "sphere_by_polar"),
    "ball by polar": ("sampling", "ball_by_polar"),
    BALL: ("sampling", "ball_by_rejection"),
}
"""The module and name of the function that each value of ``samples`` asks for; the visible part needs none."""

NUMBERS = {"ball": 3, "ball by polar": 3}
"""How many numbers a point takes where they are not 2; those of rejection only choose its generator."""

Place = Callable[..., Floats32]
"""(center, radius, u) -> (3, N) points; of a facing disk (center, radius, points, u)."""


def sphere_points(samples: str, bound: Bound, asked_by: tuple[str | int, ...]) -> Place:
    """The function that places points on a spherical light.

    Raises
    ------
    EffectError
        It isn't there.
    """
    module, name = SPHERES[samples]
    function = bound.function(module, name, asked_by)
    if module == "soft_shadows":
        return function
    unit = by_rejection(function) if samples == BALL else function

    def place(center: Floats32, radius: float, u: Floats32) -> Floats32:
        moved: Floats32 = np.float32(radius) * unit(u)
        moved += center[:, None]
        return moved

    return place
