import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from course.engine.formats.yaml.loading import Loaded, load_description
from course.engine.formats.yaml.schema import json_schema
from course.engine.formats.yaml.suggestions import SYNONYMS, meant_by
from tests.engine.formats.yaml import mistakes


def test_a_good_file_loads_with_its_document_and_path(good: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.yaml"
    path.write_text(good)
    loaded = load_description(path)
    assert loaded.path == path
    assert loaded.document.where(("objects", 1, "size")) == f"{path}:28"


def test_a_shared_value_may_be_given_by_alias_and_merge(load: Callable[[str], Loaded]) -> None:
    scene = load(
        "camera: {eye: &far [0, 0, 1e2], look_at: [0, 0, 0]}\n"
        "materials: {red: &red {color: [1, 0, 0], mirror: 0.5}, dull: {<<: *red, mirror: 0}}\n"
        "objects:\n"
        "  - {shape: box, material: dull, transform: &up [{translate: *far}]}\n"
        "  - {shape: sphere, material: red, transform: *up}\n"
    ).description
    assert scene.materials["dull"].color == (1.0, 0.0, 0.0)
    assert scene.materials["dull"].mirror == 0.0
    assert scene.objects[1].transform == scene.objects[0].transform


@pytest.mark.parametrize(("old", "new", "message"), mistakes.FORMAT + mistakes.CONTRADICTIONS)
def test_a_mistake_is_named_with_its_line_its_value_and_what_was_expected(
    refusal_of: Callable[[str, str], str], old: str, new: str, message: str
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"


@pytest.mark.parametrize(("old", "new", "meant"), mistakes.SYNONYMS)
def test_what_other_programs_call_a_key_is_answered_with_the_name_here(
    refusal_of: Callable[[str, str], str], old: str, new: str, meant: str
) -> None:
    assert refusal_of(old, new).endswith(f": unknown key; did you mean {meant}?")


def test_every_synonym_leads_to_a_key_of_the_format() -> None:
    known = {
        key
        for definition in json_schema()["$defs"].values()
        for key in definition.get("properties", {})
    }
    for word, uses in SYNONYMS.items():
        assert word == word.lower()
        assert meant_by(word.upper(), known) == list(uses)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "environment: {type: constant, radiance: [0.1, 0.2, 0.3]}",
            "environment: 0.5",
            (
                "11: environment is 0.5: expected a map with type, such as "
                "{type: constant, radiance: 0.5}"
            ),
        ),
        (
            "rotate: {axis: [0, 1, 0], degrees: 30}",
            "rotate: [0, 90, 0]",
            (
                "32: objects[1].transform[2].rotate is [0, 90, 0]: expected a map with the keys "
                "axis and degrees, such as {axis: [0, 1, 0], degrees: 90}"
            ),
        ),
    ],
)
def test_a_map_that_nobody_expects_is_shown_by_example(
    good: str,
    load: Callable[[str], Loaded],
    refusal_of: Callable[[str, str], str],
    old: str,
    new: str,
    message: str,
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"
    key, example = new.partition(":")[0], message.partition("such as ")[2]
    load(good.replace(old, f"{key}: {example}"))  # Who does as the message says, is done.


def test_a_missing_camera_is_named_at_the_first_line(refusal: Callable[[str], str]) -> None:
    assert refusal("title: x\n") == (
        "scene.yaml:1: the scene: camera is missing: expected a map with keys such as "
        "eye, look_at, up"
    )


@pytest.mark.parametrize("key", ["materials", "lights", "objects", "camera", "film"])
@pytest.mark.parametrize("value", ["3", "word", "null", "true"])
def test_a_scalar_in_place_of_a_part_is_refused(
    refusal: Callable[[str], str], key: str, value: str
) -> None:
    camera = "" if key == "camera" else "camera: {eye: [0, 0, 1], look_at: [0, 0, 0]}\n"
    message = refusal(f"{camera}{key}: {value}\n")
    shown = '"word"' if value == "word" else value
    assert f"{key} is {shown}: expected a " in message


def test_an_error_in_a_shared_value_is_at_the_line_where_it_is_written(
    refusal: Callable[[str], str],
) -> None:
    message = refusal(
        "camera: {eye: [0, 0, 1], look_at: [0, 0, 0]}\n"
        "materials:\n"
        "  a: &a\n"
        "    mirror: 0.5\n"
        "    exponent: -3\n"
        "  b:\n"
        "    <<: *a\n"
        "    exponent: 3\n"
        "    color: 7\n"
    )
    assert message.startswith("scene.yaml:5: materials.a.exponent is -3: ")


def test_loading_imports_nothing_heavier_than_it_needs() -> None:
    code = (
        "import sys\n"
        "before = set(sys.modules)\n"
        "import course.engine.formats.yaml.loading\n"
        "print(*{name.split('.')[0] for name in set(sys.modules) - before})\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    imported = set(run.stdout.split()) - sys.stdlib_module_names
    own = {name for name in imported if "cython" not in name}  # PyYAML's C parser brings these.
    assert own <= {"course", "yaml", "_yaml", "msgspec", "numpy", "typing_extensions"}


@pytest.mark.parametrize("key", ["gloss", "dielectric", "conductor", "texture", "color"])
def test_what_may_be_null_is_not_blamed_for_what_comes_after_it(
    refusal: Callable[[str], str], key: str
) -> None:
    message = refusal(
        "camera: {eye: [0, 0, 1], look_at: [0, 0, 0], lens: null}\n"
        f"materials: {{a: {{{key}: null}}, b: {{mirror: 2}}}}\n"
    )
    assert (
        message
        == "scene.yaml:2: materials.b.mirror is 2: expected a number from 0 to 1 or 3 numbers from 0 to 1"
    )


@pytest.mark.parametrize("key", ["a - at `$.camera", "a - at `$.materials[...].b"])
def test_a_key_that_is_like_a_place_misleads_nobody(
    refusal: Callable[[str], str], key: str
) -> None:
    message = refusal(f"camera: {{eye: [0, 0, 1], look_at: [0, 0, 0]}}\n'{key}': 1\n")
    assert message.startswith(f'scene.yaml:2: ["{key}"]: unknown key; ')
