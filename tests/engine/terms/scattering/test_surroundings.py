"""Glass in water: bent by the ratio of the indices, and the water goes on behind it."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import render
from course.base.errors import CourseWarning, SceneError
from tests.conftest import MakeScene, PixelRays
from tests.estimates import fresnel

pytestmark = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]

WATER, GLASS = np.array([0.1, 0.4, 0.9]), np.array([0.5, 0.2, 1.5])
"""Absorption."""

EXACT = {"max_depth": 30, "cutoff": 1e-7}
WHITE = {"type": "constant", "radiance": 1}


def media(water: float, glass: float, **more: Any) -> dict[str, Any]:
    around = {"surrounded_by": "water"} | more
    return {
        "water": {"dielectric": {"refraction_index": water, "absorption": WATER.tolist()}},
        "glass": {"dielectric": {"refraction_index": glass, "absorption": GLASS.tolist()} | around},
    }


def slab(material: str, thickness: float, across: float = 50) -> dict[str, Any]:
    return {"shape": "box", "material": material, "size": [across, thickness, across]}


@pytest.mark.parametrize(("water", "glass"), [(1.33, 1.5), (1.5, 1.33), (1.33, 2.4)])
def test_layers_seen_head_on_add_up(make_scene: MakeScene, water: float, glass: float) -> None:
    scene = make_scene(
        camera={"eye": [0, 4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.1},
        film={"width": 4, "height": 4},
        objects=[slab("water", 1.0), slab("glass", 0.4, 40)],
        materials=media(water, glass),
        environment=WHITE,
        integrator=EXACT,
    )
    left = [np.exp(-WATER * 0.3), np.exp(-GLASS * 0.4), np.exp(-WATER * 0.3)]
    outer, inner = fresnel(1.0, 1.0 / water)[0], fresnel(1.0, water / glass)[0]
    # From below: each boundary and the layer under it are put on top of what there is (adding of layers).
    back, through = np.full(3, outer), np.full(3, 1 - outer)
    for r, a in zip((inner, inner, outer), left[::-1], strict=True):
        back, through = (
            r + (1 - r) ** 2 * a * a * back / (1 - r * a * a * back),
            (1 - r) * a * through / (1 - r * a * a * back),
        )
    assert np.allclose(render(scene).linear, back + through, rtol=0, atol=1e-5)


@pytest.mark.parametrize(("water", "glass"), [(1.33, 1.5), (1.6, 1.33)])
def test_a_slab_in_water_bends_by_the_ratio(
    make_scene: MakeScene, pixel_rays: PixelRays, water: float, glass: float
) -> None:
    """The camera stands in the water, beyond the slab a sheet shines: how much glass a ray crosses tells its way."""
    scene = make_scene(
        camera={"eye": [0, 2, 1.5], "look_at": [0, 0, 0], "vertical_fov": 20},
        sampler={"type": "regular", "samples": 1},
        objects=[
            # So large that nothing comes back from its surface.
            slab("water", 400, 400),
            slab("glass", 0.5),
            {"shape": "quad", "material": "sheet", "width": 30, "depth": 30}
            | {"transform": [{"translate": [0, -1, 0]}]},
        ],
        materials=media(water, glass) | {"sheet": {"color": 0, "emission": 1}},
        integrator=EXACT,
    )
    cosine = np.abs(pixel_rays(scene)[1][1])[..., None]
    r, bent = fresnel(cosine, water / glass)
    a = np.exp(-GLASS * 0.5 / bent)
    slab_lets_through = (1 - r) ** 2 * a / (1 - r * r * a * a)
    expected = np.exp(-WATER * (1.75 + 0.75) / cosine) * slab_lets_through
    assert np.allclose(render(scene).linear, expected, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_each_way_is_absorbed_by_its_own_medium(
    make_scene: MakeScene, pixel_rays: PixelRays, kind: str
) -> None:
    """A pane in glass in water, all of index 1, seen from within the water and from outside."""
    materials = media(1, 1) | {
        "pane": {"dielectric": {"refraction_index": 1, "absorption": 3, "surrounded_by": "glass"}}
    }
    for eye, water in ((4.0, 1.0), (0.9, 0.5 + 0.4)):
        scene = make_scene(
            camera={"eye": [0, eye, 0.1], "look_at": [0, 0, 0], "vertical_fov": 50},
            sampler={"type": "regular", "samples": 1},
            objects=[slab("water", 2), slab("glass", 1, 40), slab("pane", 0.2, 30)],
            materials=materials,
            environment=WHITE,
            integrator={"type": kind, "max_depth": 12}
            | ({"roulette": None} if kind == "path" else {"cutoff": 0}),
        )
        cosine = np.abs(pixel_rays(scene)[1][1])[..., None]
        depth = WATER * water + GLASS * 0.8 + 3 * 0.2
        assert np.allclose(render(scene).linear, np.exp(-depth / cosine), rtol=0, atol=2e-5)


def test_glass_of_the_index_of_its_water_cannot_be_seen(make_scene: MakeScene) -> None:
    materials = media(1.33, 1.33, absorption=WATER.tolist())
    ball = {"shape": "sphere", "material": "glass", "radius": 0.4}
    pictures = [
        render(
            make_scene(
                camera={"eye": [1, 2, 3], "look_at": [0, 0, 0], "vertical_fov": 30},
                objects=[slab("water", 1.0), *inner],
                materials=materials,
                environment=WHITE,
                integrator=EXACT,
            )
        ).linear
        for inner in ([ball], [])
    ]
    # At the ball's rim shading normals send rays to the wrong side of a facet, and they are mirrored.
    assert np.allclose(*pictures, rtol=0, atol=1e-4)


def test_rough_glass_in_water_loses_no_light(make_scene: MakeScene) -> None:
    scene = make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 25},
        objects=[
            {"shape": "sphere", "material": "water"},
            {"shape": "sphere", "material": "glass", "radius": 0.6},
        ],
        materials=media(1.33, 1.33, absorption=0, roughness=0.3)
        | {"water": {"dielectric": {"refraction_index": 1.33}}},
        environment=WHITE,
        integrator={"type": "path", "max_depth": 64, "roulette": None},
    )
    assert render(scene).linear.mean() > 0.995


@pytest.mark.parametrize(
    ("surrounded_by", "message"),
    [
        (
            "watr",
            r"surrounded_by is .?watr.?: expected the name of a dielectric; did you mean water",
        ),
        ("stone", r"expected the name of a dielectric"),
        ("glass", r"another medium: glass would lie in itself"),
    ],
)
def test_what_surrounds_glass_is_another_dielectric(
    make_scene: MakeScene, surrounded_by: str, message: str
) -> None:
    with pytest.raises(SceneError, match=message):
        make_scene(materials=media(1.3, 1.5, surrounded_by=surrounded_by) | {"stone": {}})


def test_media_that_lie_in_each_other_are_refused(make_scene: MakeScene) -> None:
    materials = media(1.3, 1.5)
    materials["water"]["dielectric"]["surrounded_by"] = "glass"
    with pytest.raises(SceneError, match=r"materials\.\w+\.dielectric\.surrounded_by .*in itself"):
        make_scene(materials=materials)


BALL = {"shape": "sphere", "material": "glass", "radius": 0.3}


def test_glass_in_water_that_does_not_say_so_is_told(make_scene: MakeScene) -> None:
    parts = {"objects": [slab("water", 1, 3), BALL, BALL]}
    silent = media(1.33, 1.5, surrounded_by=None)
    with pytest.warns(CourseWarning, match="surrounded_by: water") as told:
        make_scene(materials=silent, **parts)
    assert len(told) == 1
    assert "objects[1] (glass) lies inside objects[0] (water)" in str(told[0].message)
    make_scene(materials=media(1.33, 1.5), **parts)


@pytest.mark.parametrize(
    "objects",
    [
        [slab("water", 1, 3), BALL | {"transform": [{"translate": [0, 2, 0]}]}],
        [slab("water", 1, 3), BALL | {"material": "water"}],
        # In its box, and in its hole.
        [{"shape": "torus", "material": "water", "radius": 1, "tube": 0.35}, BALL],
        [slab("water", 1, 3), BALL | {"material": "air"}],
    ],
)
def test_glass_beside_water_and_bubbles_are_not_told(make_scene: MakeScene, objects: Any) -> None:
    materials = media(1.33, 1.5, surrounded_by=None)
    make_scene(
        objects=objects, materials=materials | {"air": {"dielectric": {"refraction_index": 0.75}}}
    )
