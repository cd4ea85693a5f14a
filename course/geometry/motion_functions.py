"""The functions of the `motion_blur` module, as the engine calls them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.core.types import Floats32


@dataclass(frozen=True)
class MotionFunctions:
    """What moving scenes need.

    Attributes
    ----------
    shutter_times : (open, close, u) -> (N,)
    displacement : (velocity, time) -> (3, N)
    to_object_space : (origins, velocity, time) -> (3, N); None where nothing moves that rays meet
    """

    shutter_times: Callable[[float, float, Floats32], Floats32]
    displacement: Callable[[Floats32, Floats32], Floats32]
    to_object_space: Callable[[Floats32, Floats32, Floats32], Floats32] | None
