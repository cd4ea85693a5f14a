"""Pictures whose rays go through the hierarchy of the bounding_volumes module: they are Embree's."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from course import SceneError, load_scene, render
from course.cli.main import commands
from course.engine.formats.pictures.reading import read_picture
from course.engine.functions.effects import PROJECT
from course.engine.render.box_tests import box_tests
from course.engine.terms.surfaces.hierarchy import HierarchyAccelerator
from tests.conftest import MakeScene

HIERARCHY = {"type": "hierarchy"}
SCENE: dict[str, Any] = {
    "camera": {"eye": [0.4, 2.0, 5.0], "look_at": [0, 0.5, 0]},
    "film": {"width": 28, "height": 21},
    "environment": {"type": "constant", "radiance": [0.2, 0.3, 0.4]},
    "materials": {
        "floor": {"color": 0.6},
        "steel": {"color": 0.05, "mirror": 0.8},
        "glass": {"color": 0, "dielectric": {"absorption": [0.5, 0.1, 0.1]}},
    },
    "lights": [{"type": "sphere", "center": [-2, 4, 2], "radius": 0.4, "radiance": 40}],
    "objects": [
        {"shape": "quad", "material": "floor", "width": 12, "depth": 12},
        {"shape": "torus_knot", "material": "steel", "radius": 0.5, "tube": 0.15}
        | {"segments": 96, "sides": 12, "transform": [{"translate": [-0.8, 0.8, 0]}]},
        {"shape": "sphere", "material": "glass", "radius": 0.5, "segments": 32}
        | {"transform": [{"translate": [0.8, 0.6, 0.4]}]},
    ],
}
MOVES = {"motion": {"velocity": [1, 0, 0]}}


def without(thing: dict[str, Any], *keys: str) -> dict[str, Any]:
    return {key: value for key, value in thing.items() if key not in keys}


@pytest.mark.parametrize("integrator", ["distribution", "path"])
def test_the_picture_is_that_of_embree(make_scene: MakeScene, integrator: str) -> None:
    parts = {**SCENE, "integrator": {"type": integrator}}
    mine, theirs = (
        render(make_scene(**parts, **more), compiled=False)
        for more in ({"acceleration": HIERARCHY}, {})
    )
    # A ray through an edge that goes the other way changes its pixel; of 588 a few do.
    differing = (abs(mine.linear - theirs.linear) > 1e-4).any(axis=-1)
    assert differing.sum() <= 6
    assert mine.receipt.tests is not None
    assert mine.receipt.tests["boxes"] > mine.receipt.tests["triangles"] > 0
    assert mine.receipt.embree_seconds == 0
    assert theirs.receipt.tests is None
    assert "tests" not in theirs.receipt.to_dict()


def test_the_picture_does_not_depend_on_threads_or_on_compiled_loops(make_scene: MakeScene) -> None:
    scene = make_scene(**SCENE, acceleration=HIERARCHY)
    one, two = (render(scene, threads=threads) for threads in (1, 2))
    np.testing.assert_array_equal(one.linear, two.linear)
    assert one.receipt.tests == two.receipt.tests
    pytest.importorskip("numba")
    np.testing.assert_array_equal(one.linear, render(scene, compiled=True).linear)


def test_leaves_are_as_large_as_the_scene_says(make_scene: MakeScene) -> None:
    tests = [
        render(make_scene(**SCENE, acceleration=HIERARCHY | {"leaf_size": size})).receipt.tests
        for size in (1, 4, 32)
    ]
    boxes, triangles = ([each[kind] for each in tests if each] for kind in ("boxes", "triangles"))
    assert boxes == sorted(boxes, reverse=True)
    assert triangles == sorted(triangles)
    assert len({*boxes, *triangles}) == 6


def test_it_says_which_functions_are_called(make_scene: MakeScene) -> None:
    functions = {"bounding_volumes.build", "bounding_volumes.traverse"}
    effects = render(make_scene(**SCENE, acceleration=HIERARCHY)).receipt.effects
    assert functions <= set(effects["called"])
    assert "bounding_volumes" not in effects["skipped"]
    scene = make_scene(**SCENE)
    effects = render(scene).receipt.effects
    assert not functions & set(effects["called"])
    assert "Embree" in effects["skipped"]["bounding_volumes"]
    assert "bounding_volumes" not in scene.effects.imported


def test_holes_of_a_wrong_function_are_seen(make_scene: MakeScene, tmp_path: Path) -> None:
    for name in ("supersampling", "soft_shadows", "bounding_volumes"):
        text = (PROJECT / "solutions" / f"{name}.py").read_text(encoding="utf-8")
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    with (tmp_path / "bounding_volumes.py").open("a", encoding="utf-8") as file:
        file.write(
            "\n_all = traverse\n\n"
            "def traverse(hierarchy, p0, p1, p2, origins, directions):\n"
            "    triangle, t, *tests = _all(hierarchy, p0, p1, p2, origins, directions)\n"
            "    lost = triangle % 3 == 0\n"
            "    return np.where(lost, -1, triangle), np.where(lost, np.inf, t), *tests\n"
        )
    scene = make_scene(**SCENE, acceleration=HIERARCHY)
    right = render(scene).linear
    wrong = render(load_scene(scene.path, effects=tmp_path)).linear
    assert (abs(right - wrong) > 0.01).any(axis=-1).mean() > 0.1


@pytest.mark.parametrize(
    ("changed", "what"),
    [
        ({"objects": [SCENE["objects"][0], SCENE["objects"][1] | MOVES]}, "objects[1]"),
        ({"lights": [SCENE["lights"][0] | MOVES]}, "lights[0]"),
    ],
)
def test_motion_is_refused(make_scene: MakeScene, changed: dict[str, Any], what: str) -> None:
    parts = {**SCENE, **changed, "acceleration": HIERARCHY}
    with pytest.raises(SceneError, match=r"acceleration\.type") as caught:
        make_scene(**parts)
    assert f"{what} moves while the shutter is open" in str(caught.value)
    assert "leave its motion out, or take embree" in str(caught.value)
    # A closed shutter stops everything.
    shut = make_scene(**parts | {"camera": SCENE["camera"] | {"shutter": {"open": 1, "close": 1}}})
    assert isinstance(shut.compiled.world.surface.accelerator, HierarchyAccelerator)


def test_cameras_and_lights_without_a_surface_may_move(make_scene: MakeScene) -> None:
    light = without(SCENE["lights"][0], "radiance") | {"intensity": 30} | MOVES
    parts = {**SCENE, "lights": [light], "camera": SCENE["camera"] | MOVES}
    mine, theirs = (
        render(make_scene(**parts, **more), compiled=False).linear
        for more in ({"acceleration": HIERARCHY}, {})
    )
    assert (abs(mine - theirs) > 1e-4).any(axis=-1).sum() <= 6


def test_a_leaf_holds_something(make_scene: MakeScene) -> None:
    with pytest.raises(SceneError, match=r"acceleration\.leaf_size"):
        make_scene(**SCENE, acceleration=HIERARCHY | {"leaf_size": 0})


def test_the_command_prints_the_tests(make_scene: MakeScene, tmp_path: Path) -> None:
    scene = make_scene(**SCENE, acceleration=HIERARCHY)
    out, receipt = tmp_path / "out.png", tmp_path / "receipt.json"
    arguments = ["render", str(scene.path), "-o", str(out), "--receipt", str(receipt)]
    printed = CliRunner().invoke(commands, arguments)
    assert printed.exit_code == 0, printed.output
    told = json.loads(receipt.read_text(encoding="utf-8"))
    each = told["tests"]["boxes"] / sum(told["rays"].values())
    assert f"{told['tests']['boxes']:,}, {each:.1f} a ray" in printed.output


def test_the_heat_map_shows_box_tests(make_scene: MakeScene, tmp_path: Path) -> None:
    # Two triangles in two leaves: rays that miss the root take one test, and the others three.
    half = {"shape": "quad", "material": "grey", "width": 1, "depth": 1}
    turned = [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]
    scene = make_scene(
        film={"width": 16, "height": 16},
        objects=[half | {"transform": turned}],
        acceleration=HIERARCHY | {"leaf_size": 1},
    )
    heat = tmp_path / "heat.exr"
    arguments = ["render", str(scene.path), "-o", str(tmp_path / "out.exr")]
    printed = CliRunner().invoke(commands, [*arguments, "--heat-map", str(heat)])
    assert printed.exit_code == 0, printed.output
    # Four away, 40 degrees high: the square is 1 of 2.9 units, which 16 pixels show.
    tests = box_tests(scene, scene.settings)
    middle = (np.arange(16) - 7.5) / 8 * 4 * np.tan(np.radians(20))
    inside = abs(middle) < 0.5
    np.testing.assert_array_equal(tests, np.where(inside[:, None] & inside, 3, 1))
    shown = read_picture(heat)
    assert (shown[tests == 1] == 0).all()
    assert shown[tests == 3].min() > 0.7


def test_the_scene_and_its_twin_show_the_same() -> None:
    scenes = PROJECT / "scenes"
    mine, theirs = (
        render(load_scene(scenes / folder / "bounding_volumes.yaml"), size=(60, 40), compiled=False)
        for folder in ("", "before")
    )
    assert (abs(mine.linear - theirs.linear) > 1e-4).any(axis=-1).sum() <= 12
    triangles = sum(load_scene(scenes / "bounding_volumes.yaml").compiled.triangles)
    assert f"{triangles:,} triangles" in (scenes / "bounding_volumes.yaml").read_text("utf-8")
