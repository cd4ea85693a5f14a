"""What samples cost, as adaptive sampling is told: in closed form, and beside the rays that the receipt counts."""

from typing import Any

import pytest

from course import Picture, render
from course.engine.render.adaptive import costs
from course.engine.terms.environments import sky
from course.engine.terms.paths import path_tracing
from tests.conftest import MakeScene
from tests.forms import in_both_forms

DOWN = {"eye": [0, 2, 0.001], "look_at": [0, 0, 0], "vertical_fov": 40}
FLOOR = {"shape": "quad", "material": "floor", "width": 90, "depth": 90}
SKY = {"type": "constant", "radiance": 1}


def adaptive(scene: Any, compiled: bool, **settings: Any) -> Picture:
    settings = {"size": (16, 12), **settings}
    return render(scene, error=0.02, compiled=compiled, **settings)


@in_both_forms
@pytest.mark.parametrize(
    ("scene", "cost"),
    [
        ({"objects": [], "environment": SKY}, 1),
        ({"materials": {"floor": {"color": 0.5}}}, 1 + costs.HIT),
        ({"materials": {"floor": {"color": 0, "mirror": 0.5}}}, 1 + costs.HIT + costs.FURTHER_RAY),
        (
            {
                "materials": {"floor": {"color": 0.5}},
                "lights": 2 * [{"type": "point", "position": [0, 3, 0], "intensity": 1}],
            },
            1 + costs.HIT + 2 * costs.SHADOW_RAY,
        ),
        (
            {"materials": {"floor": {"color": 0.5}}, "environment": {**SKY, "lights": True}},
            1 + costs.HIT + sky.COST,
        ),
    ],
    ids=["nothing", "a hit", "a mirror", "two lights", "a sky that lights"],
)
def test_what_a_sample_costs_in_closed_form(
    make_scene: MakeScene, compiled: bool, scene: dict[str, Any], cost: float
) -> None:
    found = adaptive(make_scene(camera=DOWN, **{"objects": [FLOOR], **scene}), compiled)
    assert found.film.cost == pytest.approx(cost, rel=1e-5)


@in_both_forms
@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_all_costs_are_those_of_all_rays(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, compiled: bool, kind: str
) -> None:
    """Within a closed room every ray hits something; a box inside has glass, and the lamp's rays are counted."""
    # The rays of audits are in the receipt, and their samples are not in the picture.
    monkeypatch.setattr("course.engine.render.adaptive.rounds.AUDITED", ())
    scene = make_scene(
        camera={"eye": [0, 0, 0.9], "look_at": [0, 0, 0], "vertical_fov": 70},
        materials={
            "wall": {"color": 0.6},
            "glass": {"color": 0, "dielectric": {"refraction_index": 1.5}},
        },
        lights=[
            {
                "type": "rectangle",
                "corner": [-0.25, 0.9, -0.25],
                "edge_u": [0.5, 0, 0],
                "edge_v": [0, 0, 0.5],
                "radiance": 5,
            }
        ],
        objects=[
            {"shape": "box", "material": "wall", "size": [2, 2, 2]},
            {"shape": "box", "material": "glass", "size": [0.5, 0.6, 0.7]},
        ],
        integrator={"type": kind, "max_depth": 4},
    )
    found = adaptive(scene, compiled, spp=32, size=(96, 64))
    rays = dict(found.receipt.to_dict()["rays"])
    camera, shadow = rays.pop("camera"), rays.pop("shadow")
    further = sum(rays.values())
    assert further > 0.5 * camera
    assert shadow > 0.5 * camera
    expected = camera + costs.HIT * (camera + further)
    expected += costs.FURTHER_RAY * further + costs.SHADOW_RAY * shadow
    assert (found.film.cost * found.film.samples).sum() == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_each_pixel_has_the_costs_of_its_own_paths(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    # So that paths are followed in several batches.
    monkeypatch.setattr(path_tracing, "RAYS", 5000)
    scene = make_scene(
        camera={"eye": [0, 1, 0], "look_at": [0, 1, -1], "vertical_fov": 40},
        objects=[{**FLOOR, "width": 9000, "depth": 9000, "material": "grey"}],
        integrator={"type": kind, "max_depth": 0},
        environment=SKY,
    )
    cost = adaptive(scene, False, size=(96, 64)).film.cost
    assert (cost[:31] == 1).all()
    assert (cost[33:] == 1 + costs.HIT).all()
