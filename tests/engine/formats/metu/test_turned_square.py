"""The square of rough mirrors that the smallest component of the direction turns."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.terms.scattering.turned_square import jitter_on_turned_square

MakeScene = Callable[..., Scene]
EDGE = 0.5


def edges(r: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The directions of the square's edges, for one direction."""
    t = r.copy()
    t[int(np.argmin(np.abs(r)))] = 1
    a = np.cross(t, r)
    a /= np.linalg.norm(a)
    return a, np.cross(r, a)


def test_every_point_of_the_square_is_where_the_definition_puts_it() -> None:
    rng = np.random.default_rng(7)
    r = rng.normal(size=(3, 200))
    r /= np.linalg.norm(r, axis=0)
    r[:, 0], r[:, 1], r[:, 2] = (0, 0, -1), (0, 1, 0), (-1, 0, 0)
    u = rng.random((2, 200))
    u[:, 3:7] = [[0, 0, 1, 1], [0, 1, 0, 1]]
    got = jitter_on_turned_square(r.astype(np.float32), 0.8, u.astype(np.float32))
    assert got.dtype == np.float32
    for column in range(200):
        a, b = edges(r[:, column])
        moved = r[:, column] + 0.8 * ((u[0, column] - 0.5) * a + (u[1, column] - 0.5) * b)
        np.testing.assert_allclose(got[:, column], moved / np.linalg.norm(moved), atol=5e-7)


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("tilt", [0.2, 0.9])
def test_a_lamp_of_its_shape_is_met_by_all_rays_and_by_no_others(
    make_scene: MakeScene, tilt: float, kind: str, compiled: bool
) -> None:
    """At distance 1 the lamp is as large as the square. A smaller one is met by its share of the area.

    The mean of 64 x 64 samples is beyond 6 standard errors of the share by chance once in 5 x 10^8 times.
    """
    way = np.array([0.4, -0.8, tilt])
    way /= np.linalg.norm(way)
    r = way * [1, -1, 1]
    a, _ = edges(r)

    def mean(size: float, basis: str) -> float:
        # What is along x, y and z of a quad goes along the columns.
        matrix = np.eye(4)
        matrix[:3, :3] = np.stack((a, r, np.cross(a, r)), axis=1)
        matrix[:3, 3] = r
        lamp = {"shape": "quad", "material": "lamp", "width": EDGE * size, "depth": EDGE * size}
        gloss = {"lobe": "plane", "roughness": EDGE, "basis": basis}
        scene = make_scene(
            camera={"eye": (-2 * way).tolist(), "look_at": [0, 0, 0], "vertical_fov": 1e-3},
            film={"width": 8, "height": 8},
            sampler={"type": "random", "samples": 64},
            materials={
                "mirror": {"color": 0, "mirror": 1, "gloss": gloss},
                "lamp": {"color": 0, "emission": 1},
            },
            objects=[
                {"shape": "quad", "material": "mirror", "width": 0.01, "depth": 0.01},
                lamp | {"transform": [{"matrix": matrix.tolist()}]},
            ],
            integrator={"type": kind, "max_depth": 1},
        )
        picture = render(scene, compiled=compiled)
        called = set(picture.receipt.to_dict()["effects"]["called"])
        assert ("glossy.jitter_on_plane" in called) == (basis == "module")
        return float(picture.linear.astype(float).mean())

    assert mean(1.0005, "smallest") == pytest.approx(1, abs=1e-6)
    share = 0.8**2
    error = math.sqrt(share * (1 - share)) / 64
    assert abs(mean(0.8, "smallest") - share) < 6 * error
    assert mean(1.0005, "module") < 0.99
