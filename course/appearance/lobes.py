"""Glossy lobes: how a material scatters about the mirrored direction, through the `glossy` module."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.core.types import Floats32


@dataclass(frozen=True)
class Lobe:
    """One glossy material.

    Attributes
    ----------
    material : its number
    width : numbers that one direction takes
    parameter : roughness, glossiness or exponent, as ``jitter`` wants it
    jitter : (direction, parameter, u) -> (3, N)
    keep_above : (direction, normal) -> (3, N)
    """

    material: int
    width: int
    parameter: float
    jitter: Callable[[Floats32, float, Floats32], Floats32]
    keep_above: Callable[[Floats32, Floats32], Floats32]
