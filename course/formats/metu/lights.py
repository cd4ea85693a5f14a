"""`Lights`: ambient, point and area lights.

The engine's reflected radiance is reflectance times irradiance over pi, a METU scene's is without the pi: its lights
are pi times as strong here. The ambient term has no pi in either.
"""

import math
from typing import Any

import numpy as np

from course.core.types import Floats64
from course.formats.metu.element import Element
from course.formats.metu.transformations import matrix_of, point
from course.formats.metu.transformations import normal as transformed_normal


def read_lights(scene: Element, steps: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """The lights of a scene.

    ``steps``: of `Transformations`, by letter and id.
    """
    parent = scene.maybe("Lights")
    if parent is None:
        return []
    return [
        *({"type": "ambient", "radiance": list(e.color())} for e in parent.all("AmbientLight")),
        *(_point(e, matrix_of(e, steps)) for e in parent.all("PointLight")),
        *(_area(e, matrix_of(e, steps)) for e in parent.all("AreaLight")),
    ]


def _point(element: Element, matrix: Floats64) -> dict[str, Any]:
    element.attribute("id")
    position = np.array(element.child("Position", "such as 0 5 0").vector())
    return {
        "type": "point",
        "position": point(matrix, position).tolist(),
        "intensity": _times_pi(element.child("Intensity", "such as 1000 1000 1000")),
        "shadow_rays": "whole",
    }


def _area(element: Element, matrix: Floats64) -> dict[str, Any]:
    element.attribute("id")
    position = np.array(element.child("Position", "such as 0 5 0").vector())
    normal = element.child("Normal", "such as 0 -1 0").direction()
    size = element.child("Size", "such as 2").number(0, above=True)
    # Some files call it an intensity.
    radiance = element.maybe("Radiance") or element.child(
        "Intensity", "or Radiance, such as 10 10 10"
    )
    center = point(matrix, position)
    # Its size is in the world: no step changes it.
    u, v = tangents(transformed_normal(matrix, normal))
    return {
        "type": "rectangle",
        "corner": (center - (u + v) * (size / 2)).tolist(),
        "edge_u": (u * size).tolist(),
        "edge_v": (v * size).tolist(),
        "radiance": _times_pi(radiance),
        "two_sided": True,
        "visible": False,
    }


def tangents(normal: Floats64) -> tuple[Floats64, Floats64]:
    """Two unit vectors with cross(u, v) along the normal; its smallest component, set to 1, gives the plane of u."""
    n = normal / np.abs(normal).max()
    n /= np.linalg.norm(n)
    tilted = n.copy()
    tilted[np.argmin(np.abs(n))] = 1.0
    u = np.cross(tilted, n)
    u /= np.linalg.norm(u)
    return u, np.cross(n, u)


def _times_pi(element: Element) -> list[float]:
    return [math.pi * value for value in element.color()]
