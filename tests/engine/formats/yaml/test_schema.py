import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from course.engine.formats.yaml.description import STEP
from course.engine.formats.yaml.loading import Loaded
from course.engine.formats.yaml.schema import json_schema
from course.engine.formats.yaml.tree import parse_document, read_document
from tests.engine.formats.yaml import mistakes

ROOT = Path(__file__).parents[4]
SCENES = sorted((ROOT / "scenes").glob("*.yaml"))


@pytest.fixture(scope="module")
def validator() -> jsonschema.Draft202012Validator:
    return jsonschema.Draft202012Validator(json_schema())


def test_the_schema_is_a_json_schema_with_a_name() -> None:
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert schema["$id"]
    assert schema["title"] == "Penumbra scene"
    text = json.dumps(schema, allow_nan=False)
    assert STEP not in text
    assert "discriminator" not in text


def test_keys_carry_description_unit_range_and_default() -> None:
    definitions = json_schema()["$defs"]
    fov = definitions["CameraDescription"]["properties"]["vertical_fov"]
    assert fov.pop("description")
    assert fov == {
        "x-unit": "degree",
        "type": "number",
        "exclusiveMinimum": 0,
        "maximum": 180,
        "default": 40.0,
    } or fov == {
        "x-unit": "degree",
        "type": "number",
        "exclusiveMinimum": 0,
        "exclusiveMaximum": 180,
        "default": 40.0,
    }
    for name, definition in definitions.items():
        assert definition["description"], name
        assert definition["additionalProperties"] is False, name


def test_every_reference_in_the_schema_leads_somewhere() -> None:
    schema = json_schema()
    for reference in _references(schema):
        assert reference.removeprefix("#/$defs/") in schema["$defs"]


def test_the_schema_accepts_the_whole_format(
    good: str, validator: jsonschema.Draft202012Validator
) -> None:
    validator.validate(parse_document(good.encode(), "good.yaml").data)


@pytest.mark.skipif(not SCENES, reason="no scenes shipped yet")
@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.name)
def test_the_schema_accepts_the_shipped_scenes(
    path: Path, validator: jsonschema.Draft202012Validator
) -> None:
    validator.validate(read_document(path).data)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        *((old, new) for old, new, _ in mistakes.FORMAT),
        (", radiance: 5", ""),
        (", radiance: 5", ", radiance: 5, intensity: 5"),
    ],
)
def test_the_schema_refuses_what_loading_refuses(
    good: str, validator: jsonschema.Draft202012Validator, old: str, new: str
) -> None:
    assert not validator.is_valid(parse_document(good.replace(old, new).encode(), "a").data)


def test_the_schema_says_what_a_colour_is_that_is_not_given() -> None:
    color = json_schema()["$defs"]["MaterialDescription"]["properties"]["color"]
    assert color["default"] is None
    assert "0.8 (1 - mirror)" in color["description"]


def test_limits_that_take_two_keys_are_in_the_descriptions() -> None:
    definitions = json_schema()["$defs"]
    for shape, key, other in (
        ("Torus", "tube", "radius"),
        ("DisplacedSphere", "amplitude", "radius"),
        ("TorusKnot", "segments", "8 (p + q)"),
    ):
        assert other in definitions[shape]["properties"][key]["description"]


def test_the_first_scene_names_the_schema_that_its_comment_says_how_to_write() -> None:
    scene = ROOT / "scenes" / "still_life.yaml"
    first, *rest = scene.read_text(encoding="utf-8").splitlines()[:4]
    start, _, name = first.partition("$schema=")
    assert start == "# yaml-language-server: "
    written = f"{scene.parent.name}/{name}"  # The first line is relative to the scene.
    assert f"`course schema -o {written}`" in " ".join(rest)
    assert f"course schema -o {written}" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"/{written}" in (ROOT / ".gitignore").read_text(encoding="utf-8").split()


@pytest.mark.parametrize("emission", ["intensity: null, radiance: 5", "intensity: 1"])
def test_an_emission_of_null_counts_as_not_given(
    good: str,
    load: Callable[[str], Loaded],
    validator: jsonschema.Draft202012Validator,
    emission: str,
) -> None:
    text = good.replace("radiance: 5}", f"{emission}}}")
    load(text)
    validator.validate(parse_document(text.encode(), "a").data)


def _references(node: Any) -> list[str]:
    if isinstance(node, list):
        return [found for item in node for found in _references(item)]
    if isinstance(node, dict):
        own = [node["$ref"]] if "$ref" in node else []
        return own + [found for item in node.values() for found in _references(item)]
    return []
