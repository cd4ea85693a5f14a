"""Materials by the names that a mesh file gives to its faces: what each face shows, and what is told."""

import json
import warnings
from pathlib import Path

import numpy as np
import pytest

import course
from course.base.errors import CourseWarning, SceneError
from course.engine.formats.yaml.named_files import named_files
from course.engine.render.cluster.parcel import pack, unpack
from tests.engine.formats.meshes.gltf_files import Writer

# Four strips one unit wide, from x = 0 to 4, in z = 0; the last has no material.
STRIPS = "".join(f"v {x} {y} 0\n" for x in range(5) for y in (0, 1))
FACES = ["f 1 3 4 2", "f 3 5 6 4", "f 5 7 8 6", "f 7 9 10 8"]
OBJ = STRIPS + "\n".join(
    [FACES[3], "usemtl wood", FACES[0], "usemtl tin", FACES[1], "usemtl wood", FACES[2], ""]
)

SCENE = """
camera: {{eye: [2, 0.5, 10], look_at: [2, 0.5, 0], vertical_fov: 10}}
film: {{width: 64, height: 8, filter: box}}
sampler: {{samples: 1, type: regular}}
materials:
  oak: {{unlit: 1, color: [1, 0.5, 0]}}
  steel: {{unlit: 1, color: [0, 0.5, 1]}}
  other: {{unlit: 1, color: [0.2, 0.2, 0.2]}}
objects:
  - {{shape: mesh, file: strips.obj, material: other{keys}}}
  - {{shape: sphere, material: oak, radius: 0.1, transform: [{{translate: [2, 9, 0]}}]}}
"""

COLORS = {"oak": [1, 0.5, 0], "steel": [0, 0.5, 1], "other": [0.2, 0.2, 0.2], "": [0, 0, 0]}


def load(folder: Path, keys: str) -> course.Scene:
    (folder / "strips.obj").write_text(OBJ)
    (folder / "scene.yaml").write_text(SCENE.format(keys=keys))
    return course.load_scene(folder / "scene.yaml")


def shown(folder: Path, keys: str) -> list[str]:
    """Which material each of the four strips has in the picture; "" where nothing is."""
    picture = course.render(load(folder, keys)).linear
    # How many pixels a unit is, from a height of 8.
    unit = 8 / (2 * 10 * np.tan(np.radians(5)))
    found = []
    for strip in range(4):
        x = int(32 + (strip - 1.5) * unit)
        found += [n for n, c in COLORS.items() if np.allclose(picture[4, x], c, atol=1e-6)]
    return found


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (", materials: {wood: oak, tin: steel, '': other}", ["oak", "steel", "oak", "other"]),
        (", materials: {wood: oak, tin: oak, '': steel}", ["oak", "oak", "oak", "steel"]),
        (", only: [wood]", ["other", "", "other", ""]),
        (", only: [wood, tin], materials: {wood: steel, tin: oak}", ["steel", "oak", "steel", ""]),
        (", only: ['']", ["", "", "", "other"]),
    ],
)
def test_faces_have_the_materials_of_their_names(
    tmp_path: Path, keys: str, expected: list[str]
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert shown(tmp_path, keys) == expected


def test_names_that_are_given_no_material_are_told(tmp_path: Path) -> None:
    told = r"scene.yaml:10: the faces of those without a name, \"tin\" of strips.obj aren't named"
    with pytest.warns(CourseWarning, match=told):
        assert shown(tmp_path, ", materials: {wood: oak}") == ["oak", "other", "oak", "other"]
    told = (
        'the faces of those without a name, "wood", "tin" of strips.obj all have material "other"'
    )
    with pytest.warns(CourseWarning, match=told):
        assert shown(tmp_path, "") == ["other"] * 4


def test_one_name_for_all_faces_is_not_told(tmp_path: Path) -> None:
    scene = SCENE.format(keys="")
    (tmp_path / "scene.yaml").write_text(scene)
    (tmp_path / "strips.obj").write_text(f"{STRIPS}usemtl wood\n" + "\n".join(FACES))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        course.load_scene(tmp_path / "scene.yaml")


def test_objects_keep_their_numbers_and_lines(tmp_path: Path) -> None:
    scene = load(tmp_path, ", name: a, materials: {wood: oak, tin: steel, '': other}")
    objects = scene.loaded.description.objects
    assert [thing.name for thing in objects] == ["a", "", "a: steel", "a: other"]
    assert objects[1].__struct_config__.tag == "sphere"
    lines = [scene.loaded.document.where(("objects", k)).split(":")[-1] for k in range(4)]
    assert lines == ["10", "11", "10", "10"]


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        (
            ", materials: {woood: oak}",
            r"scene.yaml:10: objects\[0\].materials.woood: .*did you mean",
        ),
        (", materials: {wood: ok}", r'materials.wood is "ok": expected the name of one of'),
        (", only: [brass]", r'objects\[0\]: only: no face of strips.obj has a material "brass"'),
        (", only: []", r"objects\[0\].only is \[\]: expected"),
        (", file: gone.obj, materials: {wood: oak}", "gone.obj: no such file"),
    ],
)
def test_names_that_there_are_not_are_refused(tmp_path: Path, keys: str, told: str) -> None:
    text = SCENE.format(keys=keys)
    if "gone" in keys:
        text = text.replace("file: strips.obj, ", "")
    (tmp_path / "strips.obj").write_text(OBJ)
    (tmp_path / "scene.yaml").write_text(text)
    with pytest.raises(SceneError, match=told):
        course.load_scene(tmp_path / "scene.yaml")


def test_a_light_has_one_material(tmp_path: Path) -> None:
    (tmp_path / "strips.obj").write_text(OBJ)
    text = SCENE.format(keys=", name: lamp, materials: {wood: oak}")
    text = text.replace("other: {unlit: 1", "other: {emission: 1")
    (tmp_path / "scene.yaml").write_text(text + "lights: [{type: object, object: lamp}]\n")
    with pytest.raises(
        SceneError, match=r"lights\[0\] is this object, and a light has one material"
    ):
        course.load_scene(tmp_path / "scene.yaml")


def test_files_beside_a_gltf_file_are_files_of_the_scene(tmp_path: Path) -> None:
    """Whoever hashes, watches, spares or sends the files of a scene needs them; a parcel renders without the folder."""
    writer = Writer()
    uri = "more/a%20b.bin"
    writer.header["buffers"] = [{"byteLength": len(writer.binary), "uri": uri}]
    (tmp_path / "sub" / "more").mkdir(parents=True)
    (tmp_path / "sub" / "more" / "a b.bin").write_bytes(writer.binary)
    (tmp_path / "sub" / "square.gltf").write_text(json.dumps(writer.header))
    text = SCENE.format(keys="").replace("strips.obj", "sub/square.gltf")
    (tmp_path / "scene.yaml").write_text(text)
    scene = course.load_scene(tmp_path / "scene.yaml")
    files = named_files(scene.loaded.description, tmp_path)
    assert files == ["sub/square.gltf", "sub/more/a b.bin"]
    parcel = pack(scene)
    (tmp_path / "sub" / "more" / "a b.bin").unlink()
    (tmp_path / "there").mkdir()
    there = unpack(parcel.content, tmp_path / "there")
    assert there.compiled.triangles[0] == 2
