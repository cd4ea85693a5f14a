"""Lights, one kind per file."""

from __future__ import annotations

from typing import Protocol

from course.core.lights.point import DirectionalLight, PointLight
from course.core.lights.rectangle import RectangleLight
from course.core.lights.sample import Sample, Towards
from course.core.lights.sphere import SphereLight
from course.core.types import Floats32

__all__ = ["DirectionalLight", "Light", "PointLight", "RectangleLight", "Sample", "SphereLight"]


class Light(Protocol):
    """The interface of a light."""

    @property
    def name(self) -> str:
        """For receipts and error messages."""

    @property
    def color(self) -> Floats32:
        """(3,) float32, irradiance / pi where a sample's ``factor`` is 1. The BRDF contributes the 1 / pi."""

    @property
    def width(self) -> int:
        """Random numbers per sample, 0 for lights without extent."""

    @property
    def velocity(self) -> Floats32 | None:
        """(3,) float32, displacement while the shutter is open; None at rest."""

    @property
    def limit(self) -> float:
        """Length of the shadow rays, in lengths of ``to_light``."""

    def sample(self, points: Floats32, u: Floats32 | None, towards: Towards) -> Sample:
        """One point on the light for each shading point.

        Parameters
        ----------
        points : (3, n) float32
        u : (width, n) float32 in [0, 1), None where the width is 0
        towards : makes the sample from points on the light
        """
