"""Rough metals and glass by the functions of the module microfacets: the white furnace, limits, and what is called.

What is seen is one point of a sheet under an even sky of radiance 1. A mean of 1024 pixels is within 5 of its standard
errors with a false-fail rate of 6e-7 each; nine are tested.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import SceneError, render
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import Scene, load_variant
from course.school.grading.known import known
from tests.conftest import MakeScene
from tests.engine.terms.environments.test_hemisphere_directions import FLOOR, check_mean, estimates

SIXTY = [3.0, 3.0**0.5, 0.0]
"""Where the eye stands, at 60 degrees to the floor's normal."""


def metal(roughness: float, **keys: Any) -> dict[str, Any]:
    """A perfect metal, which mirrors all light."""
    index = {"refraction_index": 0, "absorption_index": 1}
    return {"color": 0, "mirror": 1, "conductor": index | {"roughness": roughness} | keys}


def glass(roughness: float) -> dict[str, Any]:
    return {"dielectric": {"roughness": roughness, "distribution": "ggx"}}


def sheet(
    make_scene: MakeScene, material: dict[str, Any], integrator: str = "distribution"
) -> Scene:
    return make_scene(
        camera={"eye": SIXTY, "look_at": [0, 0, 0], "vertical_fov": 1e-4},
        sampler={"type": "random", "samples": 64},
        environment={"type": "constant", "radiance": 1},
        materials={"white": material},
        objects=[FLOOR],
        integrator={"type": integrator, "max_depth": 1},
    )


@pytest.mark.parametrize("integrator", ["distribution", "path"])
@pytest.mark.parametrize(("alpha", "share"), [(0.5, 0.698251), (1.0, 0.450694)])
def test_the_white_furnace_loses_what_meets_a_second_microfacet(
    make_scene: MakeScene, integrator: str, alpha: float, share: float
) -> None:
    check_mean(estimates(sheet(make_scene, metal(alpha), integrator)), share, 1e-5)


@pytest.mark.parametrize("integrator", ["distribution", "path"])
def test_hardly_anything_is_lost_at_a_small_roughness(
    make_scene: MakeScene, integrator: str
) -> None:
    check_mean(estimates(sheet(make_scene, metal(0.02), integrator)), 1.0, 1e-3)


def test_rough_glass_shares_the_light_out_alike_by_both_integrators(make_scene: MakeScene) -> None:
    """Mirrored and refracted light come from the same sky, so most of it is there again."""
    one, other = (
        estimates(sheet(make_scene, glass(0.5), kind)) for kind in ("distribution", "path")
    )
    spread = np.hypot(*(x.std(ddof=1) / np.sqrt(x.size) for x in (one, other)))
    assert abs(one.mean() - other.mean()) <= 5 * spread
    check_mean(estimates(sheet(make_scene, glass(0.02))), 1.0, 2e-3)
    assert 0.7 < one.mean() < 0.99


@pytest.mark.parametrize(("alpha", "share"), [(0.1, 0.952), (0.3, 0.760), (0.5, 0.593), (1, 0.358)])
def test_a_ball_of_rough_glass_loses_as_much_as_another_renderer_s(
    make_scene: MakeScene, alpha: float, share: float
) -> None:
    """In even light: the shares are those of Mitsuba 3.9.1's `roughdielectric` in the same picture.

    Mitsuba's masking is a product of two, so the shares are alike to .01 only.
    """
    scene = make_scene(
        camera={"eye": [0, 0, 5], "look_at": [0, 0, 0], "vertical_fov": 20},
        film={"width": 24, "height": 24},
        environment={"type": "constant", "radiance": 1},
        materials={"white": glass(alpha) | {"color": 0}},
        objects=[{"shape": "sphere", "radius": 1, "segments": 128, "material": "white"}],
        integrator={"max_depth": 60},
    )
    assert abs(render(scene, spp=64).linear.mean() - share) < 0.012


def test_from_the_inside_rough_glass_refracts_what_is_not_totally_reflected(
    make_scene: MakeScene,
) -> None:
    """At 60 degrees the smooth surface reflects all; the mean is that of four million microfacets, by NumPy alone."""
    scene = sheet(make_scene, glass(0.5))
    below = load_variant(scene.path, {("camera", "eye", 1): -(3.0**0.5)})
    check_mean(estimates(below), 0.6519, 2e-3)


@pytest.mark.parametrize("roughness", [0.1, 0.4, 1.0])
def test_no_path_through_rough_glass_brings_more_than_the_sky_has(
    make_scene: MakeScene, roughness: float
) -> None:
    """Where a microfacet reflects everything and the smooth surface little, paths would bring several times as much."""
    scene = make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 30},
        film={"width": 64, "height": 64},
        sampler={"type": "random", "samples": 1},
        environment={"type": "constant", "radiance": 1},
        materials={"glass": {"color": 0} | glass(roughness)},
        objects=[{"shape": "sphere", "material": "glass"}],
        integrator={"type": "path", "max_depth": 12},
    )
    assert render(scene).linear.max() <= 1 + 1e-5


def test_compiled_stages_draw_the_same_microfacets(make_scene: MakeScene) -> None:
    for material in (metal(0.3), glass(0.3)):
        scene = sheet(make_scene, material)
        plain, fast = (render(scene, spp=4, compiled=kind).linear for kind in (False, True))
        np.testing.assert_allclose(plain, fast, atol=2e-3)


@pytest.mark.parametrize("name", ["microfacets", "before/microfacets"])
def test_it_says_which_functions_are_called(name: str) -> None:
    scene = load_variant(PROJECT / "scenes" / f"{name}.yaml")
    effects = render(scene, size=(12, 8), spp=1).receipt.effects
    called = {each.partition(".")[2] for each in effects["called"] if "microfacets." in each}
    if name == "microfacets":
        assert called == {"sample_visible_normal", "smith_g1", "smith_g2", "fresnel_complex"}
    else:
        assert not called
        assert "no metal is rough" in effects["skipped"]["microfacets"]
        assert "microfacets" not in scene.effects.imported


GLOSS = {"lobe": "plane", "roughness": 0.1}


@pytest.mark.parametrize(
    ("material", "told"),
    [
        (metal(0.2) | {"gloss": GLOSS}, "materials.white: both gloss and a roughness"),
        (glass(0.2) | {"mirror": 0.2, "gloss": GLOSS}, "materials.white: both gloss and"),
        (glass(1.5), "materials.white.dielectric.roughness.*at most 1 with distribution ggx"),
        (metal(0.2, fresnel="approximate"), "has the exact Fresnel equations"),
        (metal(0.2, distribution="beckmann"), "distribution"),
    ],
)
def test_what_does_not_go_together_is_refused(
    make_scene: MakeScene, material: dict[str, Any], told: str
) -> None:
    with pytest.raises(SceneError, match=told):
        sheet(make_scene, material)


def test_the_product_of_two_g1_in_place_of_g2_returns_less(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    """The student's function is called."""
    mine = tmp_path / "mine"
    mine.mkdir()
    (wrong,) = (one for one in known("microfacets") if one.name == "g2_product")
    for file in (PROJECT / "solutions").glob("*.py"):
        (mine / file.name).write_bytes(file.read_bytes())
    (mine / "microfacets.py").write_text(wrong.source, "utf-8")
    scene = sheet(make_scene, metal(1.0))
    found = estimates(load_variant(scene.path, None, mine))
    assert found.mean() < estimates(scene).mean() - 0.02
