"""A view is written beside its scene, and loses none of its comments."""

from __future__ import annotations

from pathlib import Path

import pytest

from course.base.errors import SceneError
from course.engine.formats.yaml.loading import load_description
from course.engine.scene.scene import load_scene
from course.school.studio.saving import changed_text, save_view
from course.school.studio.studio import Studio
from tests.school.studio.conftest import SCENE

EYE = ("camera", "eye")


def test_only_the_values_change(work: Path) -> None:
    scene = work / "ball.yaml"
    values = {EYE: [1.5, 2, 3], ("lights", 0, "radius"): 0.25, ("sampler", "samples"): 64}
    path = save_view(scene, values)
    assert path == work / "ball-view-1.yaml"
    assert scene.read_text(encoding="utf-8") == SCENE
    expected = SCENE.replace("eye: [0, 1.2, 4]", "eye: [1.5, 2, 3]")
    expected = expected.replace("radius: 0.8", "radius: 0.25").replace("samples: 16", "samples: 64")
    assert path.read_text(encoding="utf-8") == expected
    assert load_scene(path).settings.samples == 64


def test_no_file_is_written_over(work: Path) -> None:
    scene = work / "ball.yaml"
    paths = [save_view(scene, {EYE: [float(n), 2, 3]}) for n in range(3)]
    assert [path.name for path in paths] == [f"ball-view-{n}.yaml" for n in (1, 2, 3)]
    assert "[0.0, 2, 3]" in paths[0].read_text(encoding="utf-8")


def test_a_key_that_is_not_there_is_added(work: Path) -> None:
    scene = work / "block.yaml"
    text = SCENE.replace("camera: {", "camera:\n  # where\n  {").replace("{eye", "{eye")
    scene.write_text(text, encoding="utf-8")
    path = save_view(scene, {("film", "sigma"): 0.5, ("integrator", "cutoff"): 0.01})
    described = load_description(path).description
    assert described.film.sigma == 0.5
    assert path.read_text(encoding="utf-8").count("#") == text.count("#")


def test_a_key_is_added_to_a_map_of_lines() -> None:
    text = "camera:\n  eye: [0, 0, 1]  # here\n  look_at: [0, 0, 0]\n"
    assert changed_text(text, {("camera", "vertical_fov"): 30.0}) == (
        "camera:\n  vertical_fov: 30.0\n  eye: [0, 0, 1]  # here\n  look_at: [0, 0, 0]\n"
    )


@pytest.mark.parametrize(
    "camera",
    [
        "camera:\n  eye: [0, # left\n    1, 4]\n  look_at: [0, 0.4, 0]\n",
        "camera: &c {eye: &e [0, 1, 4], look_at: [0, 0.4, 0], up: [0, 1, 0]}\n",
    ],
    ids=["comment", "anchor"],
)
def test_what_cannot_be_changed_without_loss_is_refused(work: Path, camera: str) -> None:
    scene = work / "other.yaml"
    head, tail = SCENE.split("camera:")[0], SCENE.split("# from the front\n")[1]
    more = "  - {type: point, position: *e, intensity: 1}\n" if "&e" in camera else ""
    tail = tail.replace("objects:", f"{more}objects:")
    scene.write_text(head + camera + tail, encoding="utf-8")
    load_description(scene)
    with pytest.raises(SceneError, match="copy"):
        save_view(scene, {EYE: [1.0, 2.0, 3.0]})
    assert [path.name for path in work.glob("*view*")] == []


def test_the_yaml_of_a_view_says_where_the_camera_is(work: Path) -> None:
    from course.school.studio.saving import yaml_of_view

    studio = Studio(work / "ball.yaml", None)
    assert yaml_of_view(studio) == "camera:\n  eye: [0.0, 1.2, 4.0]\n  look_at: [0.0, 0.4, 0.0]\n"
    studio.values = {EYE: [1, 2, 3], ("lights", 0, "radius"): 0.5}
    assert yaml_of_view(studio) == (
        "camera:\n  eye: [1, 2, 3]\n  look_at: [0.0, 0.4, 0.0]\n# lights[0].radius: 0.5\n"
    )
