"""Rays leave surfaces at a distance that the scene sets, and lights are looked at from the surface itself.

What a picture should be is worked out in float64 by a tracer of horizontal rectangles that knows nothing of the engine.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render

MakeScene = Callable[..., Scene]
PixelRays = Callable[[Scene], tuple[NDArray[np.float64], NDArray[np.float64]]]

FLOOR, BELOW, ABOVE = ((0.0, (-2, 2, -2, 2)), (0.06, (-1, -0.3, -1, 1)), (0.16, (0.3, 1, -1, 1)))
"""Height and extent of a floor, and of two lids: one lower than rays start, and one higher."""

LIGHT = np.array([0.4, 1.5, -2.6])


def quad(height: float, extent: tuple[float, ...], material: str) -> dict[str, Any]:
    x0, x1, z0, z1 = extent
    middle = [(x0 + x1) / 2, height, (z0 + z1) / 2]
    return {
        "shape": "quad",
        "material": material,
        "width": x1 - x0,
        "depth": z1 - z0,
        "transform": [{"translate": middle}],
    }


def met(origin: NDArray[np.float64], way: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of rays (3, ...), how far along them the first rectangle is, infinity for none."""
    first = np.full(np.broadcast_shapes(origin.shape, way.shape)[1:], np.inf)
    for height, (x0, x1, z0, z1) in (FLOOR, BELOW, ABOVE):
        t = (height - origin[1]) / way[1]
        x, z = origin[0] + t * way[0], origin[2] + t * way[2]
        inside = (t > 1e-9) & (x > x0) & (x < x1) & (z > z0) & (z < z1)
        first = np.where(inside, np.minimum(first, t), first)
    return first


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("offset", [0.1, 0.0])
def test_shadow_rays_start_off_the_surface_and_light_is_that_of_the_surface(
    make_scene: MakeScene, pixel_rays: PixelRays, offset: float, kind: str, compiled: bool
) -> None:
    scene = make_scene(
        camera={"eye": [0, 3, 3], "look_at": [0, 0, 0], "vertical_fov": 50},
        film={"width": 96, "height": 64},
        sampler={"type": "regular", "samples": 1},
        materials={"grey": {"color": 1}},
        objects=[quad(*each, "grey") for each in (FLOOR, BELOW, ABOVE)],
        lights=[{"type": "point", "position": LIGHT.tolist(), "intensity": math.pi}],
        integrator={"type": kind, "max_depth": 0, "surface_offset": offset},
    )
    eye, way = pixel_rays(scene)
    t = met(eye[:, None, None], way)
    there = np.isfinite(t)
    point = eye[:, None, None] + np.where(there, t, 1) * way
    to_light = LIGHT[:, None, None] - point
    length = np.linalg.norm(to_light, axis=0)
    start = point + np.array([0, offset, 0])[:, None, None]
    free = met(start, LIGHT[:, None, None] - start) > 1
    expected = np.where(there & free, to_light[1] / length**3, 0)
    got = render(scene, compiled=compiled).linear[..., 0]
    # Pixels next to an edge of a shadow fall to either side of it by rounding.
    wrong = ~np.isclose(got, expected, rtol=3e-5, atol=1e-7)
    assert wrong.sum() <= 4
    # The low lid casts a shadow by the engine's own offset alone.
    beside = there & (point[1] < 1e-6) & (point[0] < -0.3) & (np.abs(point[2]) < 1) & ~free
    assert (beside.sum() > 0) == (offset == 0)


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize(("offset", "seen"), [(0.0, 0.25), (0.04, 0.25), (0.06, 1)])
def test_mirrored_rays_start_there_too(
    make_scene: MakeScene, offset: float, seen: float, kind: str, compiled: bool
) -> None:
    """From between a mirror and a lamp 0.05 above it: a ray that starts higher than the lamp sees the sky."""
    scene = make_scene(
        camera={"eye": [0, 0.03, 0], "look_at": [1, -0.5, 0], "vertical_fov": 1},
        film={"width": 8, "height": 8},
        environment={"type": "constant", "radiance": 1},
        materials={"mirror": {"color": 0, "mirror": 1}, "lamp": {"color": 0, "emission": 0.25}},
        objects=[quad(0, (-2, 2, -2, 2), "mirror"), quad(0.05, (-2, 2, -2, 2), "lamp")],
        integrator={"type": kind, "max_depth": 1, "surface_offset": offset},
    )
    got = render(scene, compiled=compiled).linear
    np.testing.assert_allclose(got, seen, rtol=1e-6)


@pytest.mark.parametrize(("offset", "faces"), [(0.0, 2), (0.04, 2), (0.06, 1)])
def test_refracted_rays_start_on_the_far_side(
    make_scene: MakeScene, offset: float, faces: int, compiled: bool
) -> None:
    """Straight through a plate 0.05 thick: a ray that starts behind it passes no second boundary."""
    scene = make_scene(
        camera={"eye": [0, 2, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.1},
        film={"width": 8, "height": 8},
        materials={
            "glass": {"dielectric": {"refraction_index": 2}},
            "lamp": {"color": 0, "emission": 1},
        },
        objects=[
            {"shape": "box", "material": "glass", "size": [2, 0.05, 2]},
            quad(-1, (-2, 2, -2, 2), "lamp"),
        ],
        # Two bounces reach the lamp through two boundaries, and bring nothing that was mirrored between.
        integrator={"max_depth": 2, "surface_offset": offset},
    )
    got = render(scene, compiled=compiled).linear
    np.testing.assert_allclose(got, (8 / 9) ** faces, rtol=1e-5)
