"""Rooms whose light is known, and patches without a scene file."""

import math
from typing import Any

import numpy as np

from course.engine import shapes
from course.engine.functions.effects import PROJECT, Effects
from course.engine.radiosity.patches import Patches, RadiosityFunctions
from course.engine.scene.building.cutting import undivided

FUNCTIONS = RadiosityFunctions(Effects(PROJECT / "solutions"))

CAMERA = {"eye": [0, 0.5, 5], "look_at": [0, 0.5, 0]}


def plates(reflectance: float, radiance: float = 2.0, distance: float = 1.0) -> dict[str, Any]:
    """A lamp of 1 x 1 over a plate of 1 x 1; the two look at each other."""
    return {
        "camera": CAMERA,
        "materials": {"grey": {"color": reflectance}},
        "lights": [
            {
                "type": "rectangle",
                "corner": [-0.5, distance, -0.5],
                "edge_u": [1, 0, 0],
                "edge_v": [0, 0, 1],
                "radiance": radiance,
            }
        ],
        "objects": [{"shape": "quad", "material": "grey", "width": 1, "depth": 1}],
    }


def between_plates(distance: float) -> float:
    """Form factor of two directly opposed squares of side 1 (Siegel and Howell's catalogue, C-11)."""
    x = 1 / distance
    a = math.sqrt(1 + x * x)
    return (
        2
        / (math.pi * x * x)
        * (
            math.log(math.sqrt(a**4 / (1 + 2 * x * x)))
            + 2 * x * a * math.atan(x / a)
            - 2 * x * math.atan(x)
        )
    )


def hollow_sphere(segments: int, emission: float, reflectance: float) -> Patches:
    """A sphere whose fronts look inwards; all of it emits and reflects."""
    ball = shapes.sphere(1.0, segments)
    _, first, number = np.unique(
        np.round(ball.vertices, 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    corners = number.ravel()[ball.triangles[:, ::-1]].astype(np.intp)
    count = len(corners)
    return Patches(
        undivided(ball.vertices[first], corners),
        np.full((3, count), reflectance, np.float32),
        np.full((3, count), emission, np.float32),
        np.zeros(count, np.intp),
    )
