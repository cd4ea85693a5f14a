"""Normals that look away from the viewer are bent, or left as they are."""

import numpy as np
import pytest

from course import Scene, render
from tests.conftest import MakeScene

pytestmark = pytest.mark.usefixtures("each_form")


def ball(make_scene: MakeScene, normals: str, **parts: object) -> Scene:
    """A very coarse ball, lit from behind and the side."""
    return make_scene(
        **{
            "camera": {"eye": [0, 0, 8], "look_at": [0, 0, 0], "vertical_fov": 20},
            "film": {"width": 64, "height": 64},
            "materials": {"ball": {"color": 1}},
            "objects": [{"shape": "sphere", "material": "ball", "segments": 6}],
            "lights": [{"type": "directional", "direction": [-1, 0, 1], "irradiance": np.pi}],
            "integrator": {"shading_normals": normals, "terminator": "facets"},
        }
        | parts
    )


def test_what_is_lit_from_behind_shows_less_where_its_normals_are_bent(
    make_scene: MakeScene,
) -> None:
    bent, plain = (
        render(ball(make_scene, normals)).linear[..., 0] for normals in ("bent", "interpolated")
    )
    assert (bent != plain).sum() > 10
    # Turned to the viewer is turned from the light.
    assert (plain - bent).min() > -1e-5
    assert np.array_equal(plain > 0, (plain > 0) | (bent > 0))


@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_pictures_stay_finite_whatever_the_material(make_scene: MakeScene, kind: str) -> None:
    for material in (
        {"color": 0.5, "mirror": 0.5},
        {"color": 0, "mirror": 1, "conductor": {"refraction_index": 0.4, "absorption_index": 3}},
        {"color": 0, "mirror": 0.9, "gloss": {"lobe": "plane", "roughness": 0.3}},
        {"color": 0, "dielectric": {"refraction_index": 1.5, "absorption": 0.1}},
        {"color": 0, "dielectric": {"refraction_index": 1.5, "roughness": 0.3}},
    ):
        scene = ball(
            make_scene,
            "interpolated",
            materials={"ball": material},
            environment={"type": "constant", "radiance": 1, "lights": True},
            lights=[],
            integrator={"type": kind, "shading_normals": "interpolated", "max_depth": 8},
        )
        picture = render(scene).linear
        assert np.isfinite(picture).all()
        assert picture.min() >= 0
        # A path brings up to twice as much where it chooses between two ways, but not on average.
        assert picture.mean() < 1 + 1e-4
