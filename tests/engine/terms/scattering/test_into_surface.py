"""Directions into the surface that they leave: mirrored out of it, or kept, and then they meet it again.

In a white environment a black surface sends back 1 for each ray that leaves it, and nothing for one that meets it
again where that was the last bounce. Means are compared as in tests/estimates.py, ten of them.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.engine.formats.meshes.files import save_ply
from course.engine.loops import embree_device
from course.engine.shapes.mesh import Mesh
from tests.conftest import MakeScene
from tests.estimates import estimate, fresnel
from tests.forms import in_both_forms

TRACERS = ["distribution", "path"]
WHITE = {"type": "constant", "radiance": 1}
PLATE = {"shape": "quad", "material": "plate", "width": 200, "depth": 200}


def seen_at(degrees: float, size: int = 16) -> dict[str, Any]:
    """A camera that sees the origin from so many degrees off +y, towards -x."""
    angle = math.radians(degrees)
    eye = [-2 * math.sin(angle), 2 * math.cos(angle), 0]
    return {
        "camera": {"eye": eye, "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 1e-3},
        "film": {"width": size, "height": size},
        "environment": WHITE,
    }


def one_bounce(kind: str, into_surface: str) -> dict[str, Any]:
    return {"integrator": {"type": kind, "max_depth": 1, "into_surface": into_surface}}


def expect_mean(scene: Scene, expected: float) -> None:
    mean, tolerance = estimate(scene)
    assert (np.abs(mean - expected) <= tolerance + 1e-5).all()


@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize(("into_surface", "share"), [("mirror", 1), ("keep", 1 - 60 / 180)])
def test_of_a_hemisphere_about_a_direction_the_tilt_is_below(
    make_scene: MakeScene, kind: str, into_surface: str, share: float
) -> None:
    """A uniform hemisphere about a direction at 60 degrees: the lune below the surface is 60/180 of it."""
    plate = {"color": 0, "mirror": 1, "gloss": {"lobe": "phong", "exponent": 0}}
    scene = make_scene(
        **seen_at(60), **one_bounce(kind, into_surface), materials={"plate": plate}, objects=[PLATE]
    )
    expect_mean(scene, share)
    called = render(scene, spp=1).receipt.to_dict()["effects"]["called"]
    assert ("glossy.keep_above" in called) == (into_surface == "mirror")


def test_what_is_kept_meets_the_same_surface_as_another_bounce(make_scene: MakeScene) -> None:
    """The next bounce mirrors it out at the angle at which it came, and scatters again: 60 degrees once more.

    For each direction r below, at an angle a from the surface's normal, the mirrored one is at 180 - a, and of its
    hemisphere (180 - a)/180 is below. The mean over the lune is taken by numbers.
    """
    plate = {"color": 0, "mirror": 1, "gloss": {"lobe": "phong", "exponent": 0}}
    parts = seen_at(60) | {"materials": {"plate": plate}, "objects": [PLATE]}
    integrator = {"max_depth": 2, "into_surface": "keep", "cutoff": 0}
    z, phi = np.meshgrid((np.arange(2000) + 0.5) / 2000, (np.arange(2000) + 0.5) * np.pi / 1000)
    # Heights over the surface of directions that are uniform in the hemisphere about 60 degrees.
    height = z * 0.5 + np.sqrt(1 - z * z) * np.cos(phi) * math.sqrt(0.75)
    below = height < 0
    again = 1 - np.arccos(np.clip(-height, -1, 1)) / np.pi
    expected = 1 - below.mean() + (below * again).mean()
    expect_mean(make_scene(**parts, integrator=integrator), expected)


def tilted(folder: Path, normal: tuple[float, float, float]) -> dict[str, Any]:
    """A large triangle in the plane y = 0 that looks up, whose normals say otherwise."""
    corners = np.array([[-9, 0, -9], [0, 0, 18], [9, 0, -9]], float)
    save_ply(Mesh(corners, np.array([[0, 1, 2]]), np.array([normal] * 3)), folder / "tilted.ply")
    return {"shape": "mesh", "file": "tilted.ply", "material": "plate"}


@in_both_forms
@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize(("into_surface", "share"), [("mirror", 1), ("keep", 0)])
def test_a_mirror_by_interpolated_normals(
    make_scene: MakeScene,
    tmp_path: Path,
    kind: str,
    into_surface: str,
    share: float,
    compiled: bool,
) -> None:
    """Seen from 60 degrees on the one side, with a normal 30 degrees on the other: mirrored to 120 degrees."""
    normal = (math.sin(math.radians(30)), math.cos(math.radians(30)), 0.0)
    scene = make_scene(
        **seen_at(60, 4),
        **one_bounce(kind, into_surface),
        materials={"plate": {"color": 0, "mirror": 1}},
        objects=[tilted(tmp_path, normal)],
    )
    np.testing.assert_allclose(render(scene, spp=4, compiled=compiled).linear, share, atol=1e-6)


@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize("into_surface", ["mirror", "keep"])
def test_glass_by_interpolated_normals(
    make_scene: MakeScene, tmp_path: Path, kind: str, into_surface: str
) -> None:
    """Into a thinner medium, at 40 degrees to a normal that is 20 degrees off: refracted to 94.6 degrees.

    Mirrored to the far side it leaves, and nothing is lost; kept it is, and what was reflected is all there is.
    """
    angle = math.radians(20)
    plate = {"color": 0, "dielectric": {"refraction_index": 1 / 1.5}}
    scene = make_scene(
        **seen_at(60),
        **one_bounce(kind, into_surface),
        materials={"plate": plate},
        objects=[tilted(tmp_path, (-math.sin(angle), math.cos(angle), 0.0))],
    )
    reflected = float(fresnel(math.cos(math.radians(40)), 1.5)[0])
    expect_mean(scene, 1 if into_surface == "mirror" else reflected)


@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize("into_surface", ["mirror", "keep"])
def test_rough_glass(make_scene: MakeScene, kind: str, into_surface: str) -> None:
    """So rough that directions lie in the plane at right angles to the refracted one: half of them point back."""
    plate = {"color": 0, "dielectric": {"refraction_index": 1.5, "roughness": 1e30}}
    scene = make_scene(
        **seen_at(60), **one_bounce(kind, into_surface), materials={"plate": plate}, objects=[PLATE]
    )
    reflected = float(fresnel(0.5, 1 / 1.5)[0])
    expect_mean(scene, 1 if into_surface == "mirror" else reflected + (1 - reflected) / 2)


@pytest.mark.usefixtures("each_form")
@pytest.mark.parametrize("terminator", ["round", "facets"])
def test_a_facet_that_turns_from_a_light_is_dark_unless_the_surface_is_round(
    make_scene: MakeScene, terminator: str
) -> None:
    """A coarse ball, lit from one side. It is convex: a flat facet is lit where it faces the light, and only there."""

    def lit(shading: str) -> np.ndarray:
        ball = {"shape": "sphere", "material": "ball", "segments": 8, "shading": shading}
        scene = make_scene(
            camera={"eye": [0, 0, 8], "look_at": [0, 0, 0], "vertical_fov": 20},
            materials={"ball": {"color": 1}},
            objects=[ball | {"transform": [{"rotate": {"axis": [1, 2, 0], "degrees": 20}}]}],
            lights=[{"type": "directional", "direction": [-1, 0, 0], "irradiance": 1}],
            integrator={"terminator": terminator},
        )
        return np.asarray(render(scene, spp=1, size=(96, 96)).linear[..., 0] > 0)

    smooth, flat = lit("smooth"), lit("flat")
    assert smooth.sum() > 500
    assert (smooth & ~flat).any() == (terminator == "round")


def test_compiled_loops_keep_what_points_out_of_a_ball_too(make_scene: MakeScene) -> None:
    """Such a ray starts within the ball and meets it again, though its direction says that it has left."""
    if not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    scene = make_scene(
        camera={"eye": [0, 2, 5], "look_at": [0, 0, 0], "vertical_fov": 15},
        film={"width": 8, "height": 6},
        sampler={"samples": 16},
        integrator={"max_depth": 6, "into_surface": "keep"},
        environment={"type": "constant", "radiance": 1},
        materials={
            "glass": {"color": 0, "dielectric": {}, "bump": {"noise": {"scale": 3}, "height": 0.5}}
        },
        objects=[{"shape": "sphere", "material": "glass"}],
    )
    numpy, compiled = (render(scene, compiled=each).linear for each in (False, True))
    assert numpy.mean() < 0.7
    np.testing.assert_allclose(compiled, numpy, atol=1e-5)
