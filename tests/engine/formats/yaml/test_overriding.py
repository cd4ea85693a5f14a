"""Overrides of a scene file's values: in the right place, checked like the file, and told by the file's lines."""

from pathlib import Path
from typing import Any

import pytest

from course.base.errors import SceneError
from course.engine.formats.yaml.description import BallLobe, PhongLobe
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.overriding import override
from course.engine.formats.yaml.tree import read_document

SCENE = """\
camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}
materials:
  first: &shared
    mirror: 0.5
    gloss: {lobe: phong, exponent: 10}
  second: *shared
lights:
  - {type: sphere, center: [0, 4, 0], radius: 0.5, intensity: 1}
objects:
  - shape: sphere
    material: first
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def test_a_value_is_replaced_and_the_rest_stays(path: Path) -> None:
    plain = load_description(path).description
    changed = load_description(path, {("lights", 0, "radius"): 0.25}).description
    assert changed.lights[0].radius == 0.25  # type: ignore[union-attr]
    assert (changed.camera, changed.materials, changed.objects) == (
        plain.camera,
        plain.materials,
        plain.objects,
    )


def test_an_alias_of_the_place_is_not_changed_with_it(path: Path) -> None:
    gloss = {("materials", "first", "gloss"): {"lobe": "ball", "glossiness": 0.1}}
    materials = load_description(path, gloss).description.materials
    assert materials["first"].gloss == BallLobe(glossiness=0.1)
    assert materials["second"].gloss == PhongLobe(exponent=10)


def test_keys_that_the_file_leaves_out_may_be_added(path: Path) -> None:
    overrides: dict[Any, Any] = {
        ("sampler",): {"samples": 9},
        ("objects", 0, "motion"): {"velocity": [1, 0, 0]},
    }
    description = load_description(path, overrides).description
    assert description.sampler.samples == 9
    assert description.objects[0].motion.velocity == (1, 0, 0)


def test_the_document_stays_as_it_is(path: Path) -> None:
    document = read_document(path)
    copy = override(document, {("lights", 0, "radius"): 2, ("title",): "other"})
    assert document.data == read_document(path).data
    assert copy.data["title"] == "other"
    # Lines are known for what was copied, at every depth.
    for place in [("objects", 0, "material"), ("materials", "first", "gloss", "exponent")]:
        assert copy.line(place) == document.line(place)
    assert copy.line(("lights", 0, "radius")) == 8


@pytest.mark.parametrize(
    ("overrides", "told"),
    [
        ({("lights", 0, "radius"): -1}, ":8: lights[0].radius is -1: expected"),
        ({("lights", 0, "radiuss"): 1}, ":8: lights[0].radiuss: unknown key"),
        ({("lights", 1): {}}, ":7: lights[1]: can't be overridden: there is no such item"),
        ({("lights", "0"): {}}, ':7: lights["0"]: can\'t be overridden: there is no such item'),
        ({("light", 0): {}}, ":1: light: can't be overridden: did you mean lights?"),
        ({("camera", "eye", 0, "x"): 1}, "camera.eye[0].x: can't be overridden"),
        ({(): {}}, "the scene: can't be overridden as a whole"),
        (
            {("lights", 0): {}, ("lights", 0, "radius"): 1},
            ":8: lights[0].radius: is overridden together with what it is in",
        ),
    ],
)
def test_what_does_not_fit_is_told_by_its_place(
    path: Path, overrides: dict[Any, Any], told: str
) -> None:
    with pytest.raises(SceneError) as caught:
        load_description(path, overrides)
    assert told in str(caught.value)
    assert str(path) in str(caught.value)
