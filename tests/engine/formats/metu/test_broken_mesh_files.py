"""Mesh files that can't be used are told by the conversion, with the element that names them and by their own path."""

from pathlib import Path

import pytest

from course.base.errors import SceneError
from course.engine.formats.metu.converting import convert
from tests.engine.formats.metu.conftest import Metu, Tree, tree, write

GOOD: Tree = {"_id": "1", "Material": "1", "Faces": "1 2 3"}
BROKEN: Tree = {"_id": "7", "Material": "1", "Faces": {"_plyFile": "broken.ply"}}
PLANE: Tree = {"_id": "1", "Material": "1", "Point": "1", "Normal": "0 1 0"}

HEADER = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
"""
TRIANGLE = HEADER + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
THREAD = HEADER + "0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n"


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("", "the file is empty"),
        ("no mesh", "not a PLY file"),
        (TRIANGLE[:-18], "it is cut short"),
        (TRIANGLE[:-2] + "3\n", "refers to vertex 3: out of range"),
    ],
)
@pytest.mark.parametrize("planes", [{}, {"Plane": PLANE}])
@pytest.mark.parametrize("form", ["xml", "json"])
def test_a_broken_mesh_file_is_told_with_its_element_and_path(
    tmp_path: Path, form: str, planes: Tree, content: str, told: str
) -> None:
    """Whether it is needed for the size of a plane or not; and nothing is written."""
    folder = tmp_path / "scene"
    folder.mkdir()
    (folder / "broken.ply").write_text(content, encoding="utf-8")
    source = write(folder, tree(objects={"Mesh": [GOOD, BROKEN], **planes}), form)
    target = tmp_path / "elsewhere" / "box.yaml"
    target.parent.mkdir()
    with pytest.raises(SceneError) as caught:
        convert(source, target)
    broken = folder / "broken.ply"
    text = str(caught.value)
    assert f"Scene/Objects/Mesh[2]/Faces: plyFile can't be used: {broken}: " in text
    assert told in text
    assert not list(target.parent.iterdir())


@pytest.mark.parametrize(
    ("faces", "count"), [("1 1 2", 1), ({"_plyFile": "thread.ply"}, 1), ("1 1 2  1 2 3", 0)]
)
def test_a_mesh_without_any_area_is_told(
    metu: Metu, tmp_path: Path, faces: str | Tree, count: int
) -> None:
    (tmp_path / "thread.ply").write_text(THREAD, encoding="utf-8")
    metu.load(tree(objects={"Mesh": [GOOD, {"_id": "2", "Material": "1", "Faces": faces}]}))
    told = "Scene/Objects/Mesh[2]/Faces has no triangle with an area: nothing of it can be seen"
    assert [warning.partition(": ")[2] for warning in metu.warnings] == [told] * count


@pytest.mark.parametrize("first", [0, 1])
def test_no_mesh_file_of_the_scene_is_written_over(tmp_path: Path, first: int) -> None:
    """As where a scene names a mesh that an earlier conversion has written."""
    own = tmp_path / "box.meshes" / f"mesh-{2 - first}.ply"
    own.parent.mkdir()
    own.write_text(TRIANGLE, encoding="utf-8")
    named: Tree = {"_id": "2", "Material": "1", "Faces": {"_plyFile": f"box.meshes/{own.name}"}}
    meshes = [named, GOOD] if first == 0 else [GOOD, named]
    source = write(tmp_path, tree(objects={"Mesh": meshes}), "xml")
    with pytest.raises(SceneError, match=r"plyFile is box\.meshes/mesh-\d\.ply, which the conv"):
        convert(source, tmp_path / "box.yaml")
    assert own.read_text(encoding="utf-8") == TRIANGLE
