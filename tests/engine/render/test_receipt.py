"""The receipt: every key, true counts, and nothing paid for what a scene doesn't need."""

import json
import subprocess
import sys
from typing import Any

import pytest

from course import Scene, __version__, render
from course.engine.functions.effects import PROJECT
from course.engine.terms.samplers import FUNCTIONS
from tests.cli.stand_in import RECEIPT
from tests.conftest import MakeScene
from tests.engine.conftest import EveryStage
from tests.lengths import fewer

WALL = {"shape": "quad", "material": "grey", "width": 100, "depth": 100} | {
    "transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]
}
"""Fills the picture; faces the camera at z = 4."""
POINT = {"type": "point", "position": [0, 1, 5], "intensity": 3}
LAMP = {"type": "sphere", "center": [0, 1, 5], "radius": 0.5, "intensity": 3}
PATHS = 32 * 32 * 4


def cost(scene: Scene, **options: Any) -> dict[str, Any]:
    return render(scene, **options).receipt.to_dict()


def test_it_has_every_key_and_is_plain_data(every_stage: EveryStage) -> None:
    receipt = cost(every_stage(), spp=4, seed=11, threads=2)
    assert set(receipt) == set(RECEIPT)
    assert json.loads(json.dumps(receipt)) == receipt
    assert set(receipt["rays"]) == {"camera", "shadow", "reflection", "refraction"}
    assert set(receipt["effects"]) == {"called", "skipped"}
    assert all(
        isinstance(reason, str) and reason for reason in receipt["effects"]["skipped"].values()
    )
    assert (receipt["pixels"], receipt["samples"], receipt["threads"]) == (1200, 4, 2)
    assert (receipt["seed"], receipt["version"]) == (11, __version__)
    assert 0 < receipt["embree_seconds"] < sum(receipt["seconds"].values())
    assert receipt["wall_seconds"] > 0
    assert all(seconds >= 0 for seconds in receipt["seconds"].values())
    assert all(receipt["rays"].values()), "this scene casts rays of every kind"


def test_a_picture_is_rendered_without_a_recorder(every_stage: EveryStage) -> None:
    assert "course pixel" in cost(every_stage(), spp=1)["effects"]["skipped"]["recorder"]
    # Not even its code is there.
    scene = PROJECT / "scenes" / "soft_shadows.yaml"
    program = (
        "import sys, course\n"
        f"course.render(course.load_scene({str(scene)!r}), spp=1, size=(8, 8))\n"
        "assert not [name for name in sys.modules if name.startswith('course.engine.recording')]\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=280)


def test_counts_do_not_depend_on_threads(every_stage: EveryStage) -> None:
    scene = every_stage(film={"width": 80, "height": 70})
    one, four = cost(scene, spp=32, threads=1), cost(scene, spp=32, threads=4)
    assert one["rays"] == four["rays"]
    assert one["numbers"] == four["numbers"]


def test_a_light_without_power_is_said_to_be_skipped(make_scene: MakeScene) -> None:
    skipped = cost(make_scene(objects=[WALL], lights=[POINT, POINT | {"intensity": 0}]))["effects"]
    assert set(skipped["skipped"]) >= {"light 1"}
    assert "light 0" not in skipped["skipped"]


@pytest.mark.parametrize(
    "material",
    [
        {"color": 0},
        {"diffuse": 0},
        {"color": 0, "mirror": 0.5},
        {"dielectric": {"refraction_index": 1.5}},
    ],
)
def test_materials_that_show_no_light_cast_no_shadow_rays(
    make_scene: MakeScene, material: dict[str, Any]
) -> None:
    for materials in ({"grey": material}, {"grey": material, "other": {}}):
        # The second time another material of the scene does, out of sight.
        other = {"shape": "box", "material": "other", "transform": [{"translate": [0, 90, 0]}]}
        objects = [WALL, other] if "other" in materials else [WALL]
        receipt = cost(make_scene(objects=objects, lights=[LAMP], materials=materials))
        assert receipt["rays"]["shadow"] == 0
        assert ("light 0" in receipt["effects"]["skipped"]) == ("other" not in materials)
        if "other" not in materials:
            assert set(receipt["numbers"]) == {"pixel"}
            assert "soft_shadows.point_on_sphere" not in receipt["effects"]["called"]


def test_a_visible_light_is_not_lit_itself(make_scene: MakeScene) -> None:
    lamp = {"type": "rectangle", "corner": [-50, -50, 1], "edge_u": [100, 0, 0]} | {
        "edge_v": [0, 100, 0],
        "radiance": 1,
    }
    receipt = cost(make_scene(objects=[WALL], lights=[lamp, POINT]))
    assert receipt["rays"] == {"camera": PATHS, "shadow": 0, "reflection": 0, "refraction": 0}


@pytest.mark.parametrize(
    ("material", "kind"),
    [
        ({"mirror": 0}, None),
        ({"mirror": [0, 0, 0], "specular": 1}, None),
        ({"mirror": 0.5}, "reflection"),
        ({"dielectric": {}}, "refraction"),
    ],
)
def test_rays_go_on_only_where_a_material_sends_them(
    make_scene: MakeScene, material: dict[str, Any], kind: str | None
) -> None:
    receipt = cost(make_scene(objects=[WALL], lights=[POINT], materials={"grey": material}))
    rays, skipped = receipt["rays"], receipt["effects"]["skipped"]
    if kind is None:
        assert rays["reflection"] == rays["refraction"] == 0
        assert {"reflection", "refraction"} <= set(skipped)
    else:
        assert rays[kind] == PATHS
        assert kind not in skipped


@pytest.mark.parametrize("material", [{"mirror": 0.9}, {"dielectric": {}}])
def test_a_depth_of_zero_ends_every_path_at_its_first_hit(
    make_scene: MakeScene, material: dict[str, Any]
) -> None:
    scene = make_scene(objects=[WALL], materials={"grey": material}, integrator={"max_depth": 0})
    receipt = cost(scene)
    assert receipt["rays"] == {"camera": PATHS, "shadow": 0, "reflection": 0, "refraction": 0}
    assert {"reflection", "refraction"} <= set(receipt["effects"]["skipped"])


@fewer
@pytest.mark.parametrize("sampler", FUNCTIONS)
@pytest.mark.parametrize("filter_", ["box", "gaussian"])
@pytest.mark.parametrize("samples", [1, 4])
def test_exactly_the_needed_functions_are_called(
    make_scene: MakeScene, sampler: str, filter_: str, samples: int
) -> None:
    film = {"width": 32, "height": 32, "filter": filter_}
    scene = make_scene(objects=[WALL], film=film)
    effects = cost(scene, sampler=sampler, spp=samples)["effects"]
    expected = {".".join(function) for function in FUNCTIONS[sampler]}
    if filter_ == "gaussian":
        expected.add("supersampling.gaussian_weights")
    if samples > 1:
        expected.add("supersampling.resolve")
    assert set(effects["called"]) == expected
    modules = {function.partition(".")[0] for function in expected}
    assert ("supersampling" in effects["skipped"]) == ("supersampling" not in modules)
    assert set(scene.effects.imported) == modules


def test_a_continued_render_counts_only_its_own_rays(make_scene: MakeScene) -> None:
    scene = make_scene(objects=[WALL], lights=[POINT])
    start = render(scene, spp=16)
    receipt = cost(scene, spp=32, start=start)
    assert receipt["rays"]["camera"] == 32 * 32 * 16
    assert receipt["samples"] == 32


def test_an_empty_scene_casts_camera_rays_only(make_scene: MakeScene) -> None:
    receipt = cost(make_scene(lights=[LAMP]))
    assert receipt["rays"] == {"camera": PATHS, "shadow": 0, "reflection": 0, "refraction": 0}
