"""A floor under a square lamp, which may be an object or a light of type rectangle; and means of independent pixels."""

import math
from typing import Any

import numpy as np
import pytest

from course import Picture, Scene
from tests.conftest import MakeScene
from tests.engine.terms.environments import skies

POINT = np.array([0.6, 0, 0.1])
"""Where the camera looks, on the floor."""

DISTRIBUTION = {"type": "distribution"}
PATHS = {"type": "path", "max_depth": 20, "roulette": None}
both = pytest.mark.parametrize("integrator", [DISTRIBUTION, PATHS], ids=["distribution", "path"])

UP = {"translate": [0.7, 1, 0]}
DOWN = {"rotate": {"axis": [1, 0, 0], "degrees": 180}}
PANEL = {"shape": "quad", "name": "panel", "material": "panel"}
FLOOR = {"shape": "quad", "material": "floor", "width": 60, "depth": 60}
WALL = FLOOR | {
    "material": "mirror",
    "transform": [{"rotate": {"axis": [0, 0, 1], "degrees": -90}}],
}
"""A mirror in the plane x = 0."""

RECTANGLE = {
    "type": "rectangle",
    "corner": [0.2, 1, -0.5],
    "edge_u": [1, 0, 0],
    "edge_v": [0, 0, 1],
}
"""The same square as a light, which shines down."""

LISTED = {"type": "object", "object": "panel"}


def panel(*steps: dict[str, Any], **keys: Any) -> dict[str, Any]:
    return PANEL | {"transform": [*steps, UP]} | keys


# The lamp as objects and lights: by paths all three bring the same.
lamps = pytest.mark.parametrize(
    ("objects", "lights"),
    [([panel()], [LISTED]), ([panel()], []), ([], [RECTANGLE | {"radiance": 3}])],
    ids=["an object", "glowing", "a rectangle"],
)


def share(x: float = 0.2, y: float = 1.0, edge: float = 1.0) -> float:
    """Form factor of a level square, as the floor sees it."""
    z = -edge / 2
    square = [[x, y, z], [x + edge, y, z], [x + edge, y, z + edge], [x, y, z + edge]]
    return skies.form_factor(np.array(square) - POINT, np.array([0.0, 1.0, 0.0]))


def over_a_floor(
    make_scene: MakeScene,
    above: list[dict[str, Any]],
    lights: list[dict[str, Any]],
    integrator: dict[str, Any],
    **parts: Any,
) -> Scene:
    """A floor that reflects a half, under objects that send out 3."""
    description: dict[str, Any] = {
        "camera": {"eye": [2.5, 0.8, 0.1], "look_at": POINT.tolist(), "vertical_fov": 0.01},
        "film": {"width": 64, "height": 64},
        "materials": {
            "floor": {"color": 0.5},
            "panel": {"color": 0, "emission": 3},
            "mirror": {"color": 0, "mirror": 0.8},
        },
        "objects": [FLOOR, *above],
        "lights": lights,
        "sampler": {"type": "random", "samples": 16},
        "integrator": integrator,
    }
    return make_scene(**(description | parts))


def assert_mean(picture: Picture, expected: Any, offset: float = 1e-4) -> None:
    """The mean over the pixels, each an independent estimate, is what is expected: a number, or one for each channel.

    5.33 standard errors have a false-fail rate of 1e-7. ``offset`` is the part by which flat triangles and float32 may
    move the mean.
    """
    pixels = picture.linear.reshape(-1, 3).astype(np.float64)
    error = pixels.std(axis=0, ddof=1) / math.sqrt(len(pixels))
    expected = np.broadcast_to(expected, 3)
    off = np.abs(pixels.mean(axis=0) - expected)
    assert (off <= 5.33 * error + offset * expected).all(), (pixels.mean(axis=0), expected, error)
    # A test that anything would pass is none.
    assert (error < 0.02 * expected).all()
