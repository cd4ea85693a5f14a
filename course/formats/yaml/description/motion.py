"""`motion`: how objects, lights and the camera move while the shutter is open."""

from __future__ import annotations

from typing import Annotated

from course.formats.yaml.description.values import Map, Vector, about


class MotionDescription(Map, frozen=True, kw_only=True):
    """Straight and even motion; where things stand is where they are at time 0."""

    velocity: Annotated[Vector, about("How far it goes in a second.", "world unit/s")] = (
        0.0,
        0.0,
        0.0,
    )
