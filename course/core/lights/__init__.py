"""Lights, one kind per file."""

from course.core.lights.point import DirectionalLight, PointLight
from course.core.lights.rectangle import RectangleLight
from course.core.lights.sample import Light, Sample
from course.core.lights.sphere import SphereLight

__all__ = ["DirectionalLight", "Light", "PointLight", "RectangleLight", "Sample", "SphereLight"]
