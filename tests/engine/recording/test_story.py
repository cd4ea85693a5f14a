"""The story of a pixel: its colour's reason in a sentence, for pixels of which the reason is known."""

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

from course import load_scene, pixel
from course.cli.main import commands
from course.engine.functions.effects import PROJECT
from course.engine.loops.embree_device import available
from course.engine.recording.story import Line, Story
from course.engine.scene.scene import load_variant
from tests.coarser import coarser
from tests.conftest import MakeScene

BALL: dict[str, Any] = {"shape": "sphere", "material": "grey", "radius": 1, "name": "ball"}
LAMP: dict[str, Any] = {"type": "point", "position": [0, 0, 9], "intensity": 100}
WALL: dict[str, Any] = {
    "shape": "box",
    "size": [20, 20, 0.1],
    "transform": [{"translate": [0, 0, 6]}],
    "material": "grey",
    "name": "wall",
}


def reason(make_scene: MakeScene, x: int = 16, **parts: Any) -> str:
    return pixel(make_scene(**parts), x, 16).reason


@pytest.mark.parametrize(
    ("parts", "told"),
    [
        ({}, "nothing is there: its rays hit no object, and the environment is black"),
        ({"objects": [BALL]}, "nothing lights it: the scene has no light that shows anything"),
        (
            {"objects": [BALL, WALL], "lights": [LAMP]},
            "no light arrives: all 4 shadow rays end at 'wall'",
        ),
        (
            {"objects": [BALL], "lights": [{**LAMP, "position": [0, 0, -9]}]},
            "no light arrives: the surface faces away from light 0",
        ),
        (
            {
                "objects": [BALL],
                "lights": [
                    {
                        "type": "rectangle",
                        "corner": [-1, -1, 3],
                        "edge_u": [2, 0, 0],
                        "edge_v": [0, 2, 0],
                        "radiance": 9,
                        "visible": False,
                    }
                ],
            },
            "no light arrives: light 0 shines the other way",
        ),
        (
            {"objects": [BALL], "lights": [{**LAMP, "intensity": 1e4}]},
            "it is brighter than white (1): its light comes 100% from light 0",
        ),
        (
            {
                "objects": [BALL],
                "lights": [LAMP],
                "environment": {"type": "constant", "radiance": 0.25},
            },
            "its light comes 100% from light 0",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_pixel_says_why(make_scene: MakeScene, parts: dict[str, Any], told: str) -> None:
    assert reason(make_scene, **parts) == told


def test_a_dark_half_is_told_with_what_stands_before_the_lamp(make_scene: MakeScene) -> None:
    lamp = {"type": "sphere", "center": [0, 0, 9], "radius": 1, "intensity": 100}
    half = {**WALL, "transform": [{"translate": [10, 0, 6]}]}
    told = reason(
        make_scene,
        objects=[BALL, half],
        lights=[lamp],
        sampler={"type": "sobol", "samples": 64},
    )
    blocked = int(told.partition("; ")[2].split()[0])
    assert told.endswith(f"; {blocked} of 64 shadow rays end at 'wall'")
    assert 20 < blocked < 44


def changed(story: Story, radiance: Any, weights: Any = None) -> Story:
    """A story of other radiance, as a wrong function would have made it."""
    recording = story.recording
    linear = np.asarray(radiance.mean(axis=2), np.float32)[:, None]
    weights = recording.weights if weights is None else weights
    return Story(replace(recording, linear=linear, radiance=radiance, weights=weights))


def test_one_sample_that_carries_all_light_is_told(make_scene: MakeScene) -> None:
    scene = make_scene(objects=[BALL], lights=[LAMP], sampler={"type": "sobol", "samples": 16})
    story = pixel(scene, 16, 16)
    radiance = story.recording.radiance.copy()
    radiance[:, 0, 5] = 1000
    assert changed(story, radiance).reason.startswith("one sample of 16, number 5, carries 99% of")
    radiance[1, 0, 5] = np.nan
    assert changed(story, radiance).reason == (
        "1 of 16 samples is not finite: number 5 is (1000, nan, 1000)"
    )
    none = np.zeros_like(story.recording.weights)
    told = changed(story, story.recording.radiance, none).reason
    assert told == "the weights of all samples sum to 0"


def texts(line: Line) -> list[str]:
    return [line.text, *(text for below in line.below for text in texts(below))]


def test_the_tree_is_short_and_names_functions() -> None:
    told = texts(pixel(PROJECT / "scenes" / "glossy.yaml", 150, 150, spp=64, size=(300, 200)).tree)
    assert any("soft_shadows.point_on_sphere was asked 64 times; mean" in line for line in told)
    assert all(len(line) < 160 for line in told)
    assert len(told) < 40


@pytest.mark.parametrize("effects", ["solutions", "mine"])
def test_the_film_asks_once_a_pass_whose_functions_it_ever_asks(
    effects: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of one's own it had been told that they were asked 0 times."""
    copied = tmp_path / "assignments"
    copied.mkdir()
    for name in ("supersampling", "soft_shadows"):
        shutil.copy(PROJECT / "solutions" / f"{name}.py", copied)
    monkeypatch.chdir(tmp_path)
    told = pixel(
        PROJECT / "scenes/soft_shadows.yaml", 30, 30, spp=48, size=(64, 48), effects=effects
    )
    asked = [line for line in texts(told.tree) if line.startswith("supersampling.")]
    # A pass has 16 samples of each pixel.
    for name in ("gaussian_weights", "resolve"):
        assert f"supersampling.{name} was asked 3 times, for many rays at once" in asked


def test_shares_of_all_sources_are_the_whole() -> None:
    story = pixel(PROJECT / "scenes" / "path_tracing.yaml", 50, 30, spp=16, size=(96, 64))
    assert sum(story.sources.values()) == pytest.approx(1, abs=1e-6)
    assert sum(story.shares) == pytest.approx(1)


def test_the_guide_shows_what_is_printed() -> None:
    guide = (PROJECT / "docs" / "guides" / "rays.md").read_text(encoding="utf-8")
    shown = re.findall(r"^> (.*)$", guide, re.MULTILINE)
    text = " ".join(line.strip().removeprefix("- ") for line in shown)
    told = texts(pixel(PROJECT / "scenes" / "soft_shadows.yaml", 300, 300).tree)
    assert text == " ".join(told)


def command(*arguments: str | Path) -> Result:
    return CliRunner().invoke(commands, ["pixel", *map(str, arguments)])


@pytest.fixture
def scene_file(make_scene: MakeScene, tmp_path: Path) -> Path:
    lamp = {"type": "sphere", "center": [0, 0, 9], "radius": 1, "intensity": 100}
    make_scene(objects=[BALL], lights=[lamp])
    return tmp_path / "scene.yaml"


def test_the_command_prints_the_story(scene_file: Path) -> None:
    result = command(scene_file, "16,16", "--spp", "8")
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0].startswith("pixel 16,16 of scene.yaml: ")
    assert lines[0].endswith(" from 8 samples")
    assert "      soft_shadows.point_on_sphere was asked 8 times" in result.stdout


def test_the_lamp_is_found_again_from_what_its_function_returned() -> None:
    path = PROJECT / "scenes" / "soft_shadows.yaml"
    told = "\n".join(texts(pixel(path, 300, 300).tree))
    said = re.search(r"point_on_sphere was asked 64 times; mean (.*)", told)
    frame = re.search(r"compiled scene: (.*) is its origin, and (.*) its unit", told)
    assert said
    assert frame
    mean, origin = (np.array(text.split(), float) for text in (said[1], frame[1]))
    (lamp,) = (o for o in load_scene(path).loaded.description.lights if hasattr(o, "radius"))
    assert np.linalg.norm(mean * float(frame[2]) + origin - lamp.center) < lamp.radius / 2


def test_json_has_every_segment(scene_file: Path) -> None:
    told = json.loads(command(scene_file, "16,16,2x1", "--json", "--seed", "3").stdout)
    assert told["area"] == {"x": 16, "y": 16, "width": 2, "height": 1}
    assert told["seed"] == 3
    assert len(told["samples"]) == 8
    assert len(told["segments"]) == 16
    assert told["segments"][1]["calls"][0]["function"] == "soft_shadows.point_on_sphere"


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (["16,2,0x5"], 2, "'16,2,0x5' is not a pixel: expected X,Y"),
        (["16"], 2, "'16' is not a pixel: expected X,Y, counted from the upper left corner"),
        (["40,3"], 1, "pixel 40,3 is outside the picture: expected x from 0 to 31 and y from 0"),
        (["1,1", "--effects", "nowhere"], 1, "no folder nowhere with effect functions"),
        (["1,1", "--spp", "65536"], 1, "65,536 samples are too many to record"),
        (["1,1", "--effects", "assignments"], 1, "lights.0 asks for it"),
    ],
)
def test_what_is_wrong_is_told_with_what_to_do(
    scene_file: Path, arguments: list[str], code: int, told: str
) -> None:
    result = command(scene_file, *arguments)
    assert result.exit_code == code
    assert told in result.stderr.replace("\n", " ")


def test_other_files_are_refused(tmp_path: Path) -> None:
    shutil.copy(PROJECT / "scenes" / "metu" / "showroom.xml", tmp_path)
    result = command(tmp_path / "showroom.xml", "1,1")
    assert result.exit_code == 1
    assert "course convert" in result.stderr


WRONG = {
    "cube_map.lookup_seamless": (
        "cube_map.yaml",
        "lookup_seamless = lambda faces, direction: np.zeros_like(direction)",
        "nothing is there: its rays hit no object, and cube_map.lookup_seamless returned 0",
    ),
    "supersampling.resolve": (
        "soft_shadows.yaml",
        "resolve = lambda radiance, weights: np.zeros(radiance.shape[:2], radiance.dtype)",
        "supersampling.resolve made 0 0 0 of samples whose weighted mean is 0.",
    ),
    "supersampling.gaussian_weights": (
        "soft_shadows.yaml",
        "gaussian_weights = lambda offsets, sigma: np.zeros(offsets.shape[1:], offsets.dtype)",
        "the weights of all samples sum to 0: supersampling.gaussian_weights returned them",
    ),
    "film.encode_srgb": (
        "film.yaml",
        "encode_srgb = lambda linear: np.zeros_like(linear)",
        "film.encode_srgb made 0 0 0 of its colour, ",
    ),
}
"""Function -> a scene, how it is written, and what is told of a pixel that is black for that reason."""


@pytest.mark.parametrize("function", WRONG)
def test_a_function_that_makes_a_pixel_black_is_named(function: str, tmp_path: Path) -> None:
    """They had been told as a black environment, a black material, and light brighter than white."""
    scene, text, told = WRONG[function]
    folder = tmp_path / "mine"
    shutil.copytree(
        PROJECT / "solutions", folder, ignore=lambda _, names: {"wrong", "right"} & {*names}
    )
    with (folder / f"{function.split('.')[0]}.py").open("a", encoding="utf-8") as file:
        file.write(f"\n{text}\n")
    path = PROJECT / "scenes" / scene
    story = pixel(load_variant(path, coarser(path), folder), 5, 5, spp=16, size=(48, 32))
    assert story.reason.startswith(told)


def test_another_colour_than_the_samples_mean_is_told(make_scene: MakeScene) -> None:
    scene = make_scene(objects=[BALL], lights=[LAMP])
    story = pixel(scene, 16, 16)
    assert "resolve" not in story.reason
    other = Story(replace(story.recording, linear=story.recording.linear * np.float32(1.01)))
    assert "; supersampling.resolve made " in other.reason


def test_paths_that_leave_a_lit_scene_are_told_with_what_sent_them(make_scene: MakeScene) -> None:
    """It had been told that no light shows anything, where an ambient light shows all but the mirror."""
    brushed = {"color": 0, "mirror": 0.9, "gloss": {"lobe": "plane", "roughness": 0.2}}
    scene = make_scene(
        objects=[BALL],
        materials={"grey": brushed},
        lights=[{"type": "ambient", "radiance": 1}],
        integrator={"max_depth": 1},
    )
    told = pixel(scene, 16, 16).reason
    assert told.startswith("no light arrives: all 4 paths leave the scene, where it is black; ")
    assert "glossy.jitter_on_plane" in told


def test_each_hit_s_walk_down_the_light_tree_is_recorded() -> None:
    """Hits walk some thousands at a time, and only those that chose the tree do."""
    scene = PROJECT / "scenes" / "many_lights.yaml"
    story = pixel(scene, 40, 50, spp=8, size=(96, 64))
    calls = [
        call
        for one in story.segments
        for call in one.calls
        if call.function == "many_lights.tree_choice"
    ]
    assert len(calls) == story.recording.asked["many_lights.tree_choice"] == 8
    assert all(0 < call.results["probability"] <= 1 for call in calls)


@pytest.mark.parametrize("facets", [False, True])
def test_shafts_are_told_of_scenes_alone_whose_loop_looks_at_them(
    make_scene: MakeScene, facets: bool
) -> None:
    """A floor under a lamp; microfacets are nothing that the loop knows."""
    floor: dict[str, Any] = {"shape": "quad", "width": 9, "depth": 9, "material": "floor"}
    material: dict[str, Any] = (
        {
            "mirror": 0.5,
            "conductor": {"roughness": 0.4, "refraction_index": 2.9, "absorption_index": 3},
        }
        if facets
        else {}
    )
    scene = make_scene(
        camera={"eye": [0, 4, 6], "look_at": [0, 0, 0]},
        film={"width": 512, "height": 512},
        sampler={"type": "sobol", "samples": 64},
        materials={"floor": material},
        objects=[floor],
        lights=[{"type": "sphere", "center": [0, 5, 0], "radius": 0.5, "intensity": 100}],
    )
    told = " ".join(texts(pixel(scene, 256, 256).tree))
    assert (
        "shafts: 64 with nothing between their cell and all of the light need not be sent" in told
    ) == (available() and not facets)
