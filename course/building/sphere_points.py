"""Where on a spherical light its points are: by functions of `soft_shadows`, or by those of `sampling`."""

from __future__ import annotations

from course.building.rejection import BALL

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
