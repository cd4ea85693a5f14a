from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from course.formats.yaml.checking import SYNONYMS, meant_by
from course.formats.yaml.loading import Loaded, load_description
from course.formats.yaml.schema import json_schema

SHAPES = (
    "quad, box, sphere, disk, cylinder, cone, torus, torus_knot, displaced_sphere, height_field "
    "or mesh"
)


def test_a_good_file_loads_with_its_document_and_path(good: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.yaml"
    path.write_text(good)
    loaded = load_description(path)
    assert loaded.path == path
    assert loaded.document.where(("objects", 1, "size")) == f"{path}:28"


def test_a_shared_value_may_be_given_by_alias_and_merge(
    load: Callable[[str], Loaded],
) -> None:
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


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "  eye: [",
            "  eye: [0, ",
            "4: camera.eye is [0, 0, 1, 5]: expected 3 numbers [world unit]",
        ),
        ("  eye: [0,", "  eye: [a,", '4: camera.eye[0] is "a": expected a number [world unit]'),
        ("  eye: [0,", "  eye: [true,", "4: camera.eye[0] is true: expected a number [world unit]"),
        (
            "vertical_fov: 35",
            "vertical_fov: 180",
            "7: camera.vertical_fov is 180: expected a number > 0 and < 180 [degree]",
        ),
        (
            "width: 64",
            "width: 0",
            "8: film.width is 0: expected a whole number from 1 to 65536 [pixel]",
        ),
        (
            "width: 64",
            "width: 6.5",
            "8: film.width is 6.5: expected a whole number from 1 to 65536 [pixel]",
        ),
        ("sigma: 0.2", "sigma: 0", "8: film.sigma is 0: expected a number > 0 [pixel]"),
        (
            "filter: gaussian",
            "filter: gausian",
            '8: film.filter is "gausian": expected box or gaussian; did you mean gaussian?',
        ),
        (
            "filter: gaussian",
            "filter: [box]",
            '8: film.filter is ["box"]: expected box or gaussian',
        ),
        ("seed: 7", "seed: -1", "2: seed is -1: expected a whole number from 0 to 4294967295"),
        ("title: everything", "title: 3", "1: title is 3: expected a text"),
        ("cutoff: 1e-3", "cutoff: 1", "10: integrator.cutoff is 1: expected a number >= 0 and < 1"),
        (
            "radiance: [0.1, 0.2, 0.3]",
            "radiance: [0.1, -0.2, 0.3]",
            "11: environment.radiance[1] is -0.2: expected a number >= 0 [W/(m^2 sr)]",
        ),
        (
            "color: [1, 0, 0]",
            "color: red",
            (
                '13: materials.red.color is "red": expected a number from 0 to 1, '
                "3 numbers from 0 to 1 or null"
            ),
        ),
        (
            "color: [1, 0, 0]",
            "color: [1, 0]",
            (
                "13: materials.red.color is [1, 0]: expected a number from 0 to 1, "
                "3 numbers from 0 to 1 or null"
            ),
        ),
        (
            "diffuse: 0.9",
            "diffuse: -1.5",
            "13: materials.red.diffuse is -1.5: expected a number from 0 to 1000000",
        ),
        (
            "mirror: {mirror: 0.9}",
            "mirror: 3",
            "14: materials.mirror is 3: expected a map with keys such as color, ambient, diffuse",
        ),
        (
            "refraction_index: 1.5",
            "refraction_index: 0",
            "16: materials.glass.dielectric.refraction_index is 0: expected a number > 0",
        ),
        (
            "    dielectric: {refraction_index: 1.5, absorption: [0.1, 0, 0.2]}",
            "    dielectric: 1.5",
            "16: materials.glass.dielectric is 1.5: expected a map or null",
        ),
        (
            "radius: 0, intensity",
            "radius: -1, intensity",
            "22: lights[4].radius is -1: expected a number >= 0 [world unit]",
        ),
        (
            "intensity: [10, 20, 30]",
            "intensity: bright",
            '19: lights[1].intensity is "bright": expected a number >= 0 or 3 numbers >= 0 [W/sr]',
        ),
        (
            "size: [1, 2, 3]",
            "size: [1, 0, 3]",
            "28: objects[1].size[1] is 0: expected a number > 0 [world unit]",
        ),
        (
            "segments: 32",
            "segments: 2",
            "33: objects[2].segments is 2: expected a whole number from 3 to 4096",
        ),
        (
            "- scale: -2",
            "- scale: [1, 2]",
            "31: objects[1].transform[1].scale is [1, 2]: expected a number or 3 numbers",
        ),
        (
            "degrees: 30",
            "degrees: yes",
            '32: objects[1].transform[2].rotate.degrees is "yes": expected a number [degree]',
        ),
        (
            "file: bunny.ply",
            "file: ''",
            '41: objects[10].file is "": expected a text that is not empty',
        ),
    ],
)
def test_a_wrong_value_is_named_with_what_was_expected(
    refusal_of: Callable[[str, str], str], old: str, new: str, message: str
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("  look_at:", "  look_att:", "5: camera.look_att: unknown key; did you mean look_at?"),
        ("title: every", "Title: every", "1: Title: unknown key; did you mean title?"),
        (
            "mirror: 0.9",
            "colour: 0.9",
            "14: materials.mirror.colour: unknown key; did you mean color?",
        ),
        (
            "refraction_index: 1.5",
            "bend: 1.5",
            (
                "16: materials.glass.dielectric.bend: unknown key; known are refraction_index, "
                "absorption, shaded, roughness, surrounded_by"
            ),
        ),
        ("width: 10,", "widht: 10,", "24: objects[0].widht: unknown key; did you mean width?"),
        (
            "- scale: -2",
            "- move: -2",
            "31: objects[1].transform[1].move: unknown key; known are translate, scale, rotate, matrix",
        ),
        (
            "- scale: -2",
            "- scal: -2",
            "31: objects[1].transform[1].scal: unknown key; did you mean scale?",
        ),
        (
            "- scale: -2",
            "- <step>: scale",
            (
                '31: objects[1].transform[1]["<step>"]: unknown key; known are translate, '
                "scale, rotate, matrix"
            ),
        ),
        (
            "axis: [0, 1, 0], ",
            "axes: [0, 1, 0], ",
            "32: objects[1].transform[2].rotate.axes: unknown key; did you mean axis?",
        ),
    ],
)
def test_an_unknown_key_is_named_with_the_nearest_known_one(
    refusal_of: Callable[[str, str], str], old: str, new: str, message: str
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ("vertical_fov: 35", "fov: 35", "vertical_fov"),
        ("vertical_fov: 35", "FOV: 35", "vertical_fov"),
        ("  eye:", "  position:", "eye"),
        ("  look_at:", "  target:", "look_at"),
        ("look_at: [0, 0.5, 0]", "direction: [0, 0, -1]", "look_at"),
        ("width: 10,", "position: [0, 1, 0],", "transform: [{translate: [0, 1, 0]}]"),
        (
            "width: 10,",
            "rotation: [0, 90, 0],",
            "transform: [{rotate: {axis: [0, 1, 0], degrees: 90}}]",
        ),
        ("width: 10,", "scale: 2,", "transform: [{scale: 2}]"),
        ("width: 10,", "size: 2,", "width or depth"),
        ("- scale: -2", "- translation: [0, 1, 0]", "translate"),
        ("radius: 0.5,", "size: 0.5,", "radius"),
        ("shape: disk", "type: disk", "shape"),
        ("position: [1, 2, 3]", "pos: [1, 2, 3]", "position"),
        ("center: [0, 4, 0]", "position: [0, 4, 0]", "center"),
        ("intensity: [10, 20, 30]", "color: [10, 20, 30]", "intensity"),
        ("intensity: [10, 20, 30]", "power: 10", "intensity"),
        ("radius: 0, intensity: 3", "radius: 1, color: 3", "radiance or intensity"),
        ("irradiance: 1", "color: 1", "irradiance"),
        ("type: ambient, radiance", "type: ambient, color", "radiance"),
        ("refraction_index: 1.5", "ior: 1.5", "refraction_index"),
        ("mirror: 0.9", "ior: 1.5", "dielectric: {refraction_index: 1.5}"),
    ],
)
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


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("  eye: [0, 1, 5]\n", "", "3: camera: eye is missing: expected 3 numbers [world unit]"),
        (
            "position: [1, 2, 3], ",
            "",
            "19: lights[1]: position is missing: expected 3 numbers [world unit]",
        ),
        (
            "    material: mirror\n",
            "",
            "25: objects[1]: material is missing: expected a text that is not empty",
        ),
        (
            "type: point, ",
            "",
            (
                "19: lights[1]: type is missing: expected ambient, point, directional, "
                "rectangle, sphere or object"
            ),
        ),
        (
            "type: constant, ",
            "",
            "11: environment: type is missing: expected constant, cube or lat_long",
        ),
        ("shape: disk, ", "", f"34: objects[3]: shape is missing: expected {SHAPES}"),
        (
            ", degrees: 30",
            "",
            "32: objects[1].transform[2].rotate: degrees is missing: expected a number [degree]",
        ),
    ],
)
def test_a_missing_key_is_named_at_the_line_of_its_parent(
    refusal_of: Callable[[str, str], str], old: str, new: str, message: str
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"


def test_a_missing_camera_is_named_at_the_first_line(refusal: Callable[[str], str]) -> None:
    assert refusal("title: x\n") == (
        "scene.yaml:1: the scene: camera is missing: expected a map with keys such as "
        "eye, look_at, up"
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "shape: torus,",
            "shape: tors,",
            f'37: objects[6].shape is "tors": expected {SHAPES}; did you mean torus?',
        ),
        ("shape: disk", "shape: 3", f"34: objects[3].shape is 3: expected {SHAPES}"),
        ("shape: disk", "shape: [disk]", f'34: objects[3].shape is ["disk"]: expected {SHAPES}'),
        (
            "type: point",
            "type: pint",
            (
                '19: lights[1].type is "pint": expected ambient, point, directional, rectangle, '
                "sphere or object; did you mean point?"
            ),
        ),
        (
            "type: constant",
            "type: sky",
            '11: environment.type is "sky": expected constant, cube or lat_long',
        ),
        (
            "type: jittered",
            "type: faure",
            (
                '9: sampler.type is "faure": expected chained, halton, hammersley, jittered, random, '
                "regular, sobol or xorshift"
            ),
        ),
    ],
)
def test_an_unknown_kind_is_answered_with_the_known_ones(
    refusal_of: Callable[[str, str], str], old: str, new: str, message: str
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"


@pytest.mark.parametrize(
    ("new", "message"),
    [
        ("- 3", "is 3: expected a map with one key, translate, scale, rotate or matrix"),
        ("- {scale: 2, <step>: 3}", '["<step>"]: unknown key; known are translate, scale'),
        ("- {}", ": a step with 0 keys: expected one, translate, scale, rotate or matrix"),
        (
            "- {scale: 2, translate: [0, 0, 0]}",
            ": a step with 2 keys: expected one, translate, scale, rotate or matrix; each step is an item",
        ),
    ],
)
def test_a_transform_step_has_one_key(
    refusal_of: Callable[[str, str], str], new: str, message: str
) -> None:
    start = "scene.yaml:31: objects[1].transform[1]"
    found = refusal_of("- scale: -2", new)
    assert found.startswith(start)
    assert found.removeprefix(start).lstrip().startswith(message)


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
        "import course.formats.yaml.loading\n"
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
