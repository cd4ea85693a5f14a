"""The shutter: which motions there are while it is open, and where things stand when it opens.

Times are counted from the opening, in float32, in exposures: the shutter closes at 1. A velocity is then how far
something goes while the shutter is open, which float32 can carry however short an exposure is. What moved before is
part of the positions, in float64. A closed shutter freezes everything at one time, and then nothing moves at all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.building.frame import Frame
from course.core.types import Floats64
from course.formats.yaml import description as d
from course.formats.yaml.loading import Loaded

STILL = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Shutter:
    """When light is let in, in seconds."""

    open: float
    duration: float

    def start(self, motion: d.MotionDescription) -> Floats64:
        """(3,) how far something has gone when the shutter opens, in units of the scene file."""
        return np.array(motion.velocity) * self.open

    def sweep(self, motion: d.MotionDescription) -> Floats64:
        """(3,) how far it goes until the shutter closes."""
        return np.array(motion.velocity) * self.duration

    def moves(self, motion: d.MotionDescription) -> bool:
        """Whether it moves while the shutter is open."""
        return bool(self.sweep(motion).any())

    def velocity(self, motion: d.MotionDescription, frame: Frame) -> tuple[float, float, float]:
        """Velocity in units of the compiled scene an exposure; zero where nothing moves."""
        if not self.moves(motion):
            return STILL
        x, y, z = (float(v) for v in frame.vector(self.sweep(motion)))
        return (x, y, z)


def shutter_of(loaded: Loaded) -> Shutter:
    """The camera's shutter; SceneError if it closes before it opens."""
    shutter = loaded.description.camera.shutter
    if shutter.close < shutter.open:
        raise loaded.document.unexpected(
            ("camera", "shutter", "close"),
            f"a time not before camera.shutter.open, {shutter.open:g}",
        )
    return Shutter(shutter.open, shutter.close - shutter.open)
