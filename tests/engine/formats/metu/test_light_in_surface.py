"""A point light that lies in a surface: seen from both sides, or hidden by it."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from tests.lengths import fewer

MakeScene = Callable[..., Scene]
AXIS = np.array([0.2, 1, 0.1]) / math.sqrt(1.05)


def turned(v: np.ndarray, degrees: float) -> np.ndarray:
    """Rodrigues' formula."""
    angle = math.radians(degrees)
    along = AXIS * (AXIS @ v) * (1 - math.cos(angle))
    return np.asarray(v * math.cos(angle) + np.cross(AXIS, v) * math.sin(angle) + along)


def lit_floor(
    make_scene: MakeScene, turn: float, shift: list[float], gap: float, rays: str, offset: float
) -> Scene:
    """A floor, and above it a wall with a light that is ``gap`` before the wall or, below 0, behind it."""
    steps = [
        {"rotate": {"axis": [1, 0, 0], "degrees": 90}},
        {"rotate": {"axis": AXIS.tolist(), "degrees": turn}},
        {"translate": shift},
    ]
    place = turned(np.array([0.31, 0.17, gap]), turn) + np.array(shift)
    light: dict[str, Any] = {"type": "point", "position": place.tolist(), "intensity": math.pi}
    return make_scene(
        camera={"eye": [0, 6, 0], "look_at": [0, 0, 0], "up": [0, 0, -1], "vertical_fov": 60},
        film={"width": 24, "height": 24},
        sampler={"type": "regular", "samples": 1},
        materials={"floor": {"color": 1}, "wall": {"color": 0}},
        objects=[
            {"shape": "quad", "material": "floor", "width": 8, "depth": 8},
            {"shape": "quad", "material": "wall", "width": 2, "depth": 1, "transform": steps},
        ],
        lights=[light | {"shadow_rays": rays}],
        integrator={"max_depth": 0, "surface_offset": offset},
    )


PLACES = [(10.0, [0.1, 1.3, 0.2]), (77.0, [-0.7, 0.9, 0.4]), (203.0, [0.123, 2.1, -0.777])]


@fewer
@pytest.mark.parametrize("offset", [0.0, 1e-3])
@pytest.mark.parametrize(("turn", "shift"), PLACES)
def test_a_surface_hides_the_light_that_lies_in_it_where_shadow_rays_are_whole(
    make_scene: MakeScene, turn: float, shift: list[float], offset: float, compiled: bool
) -> None:
    """At every point of the floor, on both sides of the wall; else most of the floor is lit."""

    def shown(gap: float, rays: str) -> np.ndarray:
        scene = lit_floor(make_scene, turn, shift, gap, rays, offset)
        return np.asarray(render(scene, compiled=compiled).linear[..., 0])

    assert not shown(0, "whole").any()
    assert (shown(0, "short") > 0).mean() > 0.5
    # A hundredth of the wall's width from it the light shines on what is on its side, and not on the rest.
    for gap in (0.02, -0.02):
        lit = shown(gap, "whole")
        assert 0.2 < (lit > 0).mean() < 0.8
        assert np.array_equal(lit, shown(gap, "short"))
