"""Lights, one kind a file.

Each compiled light has

- ``name``: for receipts and error messages,
- ``color`` (3,) float32: what one unit of the factor below means, already divided by pi for the reflected radiance,
- ``width``: how many numbers one sample takes (0 for lights without extent),
- ``velocity`` (3,) float32 or None: how it moves,
- ``limit``: how far along ``to_light`` a blocker counts, and
- ``sample(points, u, compiled) -> Sample``, by compiled loops where there are any and they are wanted.
"""

from __future__ import annotations

from course.appearance.lights.directional import DirectionalLight
from course.appearance.lights.mesh import MeshLight
from course.appearance.lights.point import PointLight
from course.appearance.lights.rectangle import RectangleLight
from course.appearance.lights.sample import Sample
from course.appearance.lights.sphere import SphereLight
from course.appearance.lights.visible_sphere import VisibleSphereLight

Light = (
    PointLight | DirectionalLight | RectangleLight | SphereLight | VisibleSphereLight | MeshLight
)

__all__ = [
    "DirectionalLight",
    "Light",
    "MeshLight",
    "PointLight",
    "RectangleLight",
    "Sample",
    "SphereLight",
    "VisibleSphereLight",
]
