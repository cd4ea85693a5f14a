"""Mesh files that can't be used are told with the element, or the object, that names them, and by their own path."""

from __future__ import annotations

from pathlib import Path

import pytest

from course import load_scene
from course.errors import SceneError
from course.scene.metu.converting import convert, retold
from tests.scene.metu.conftest import Tree, tree, write

GOOD: Tree = {"_id": "1", "Material": "1", "Faces": "1 2 3"}
BROKEN: Tree = {"_id": "7", "Material": "1", "Faces": {"_plyFile": "broken.ply"}}


def scene_in(folder: Path, form: str, **objects: object) -> Path:
    """A scene with a good mesh, a broken one and other objects, in a folder of its own."""
    folder.mkdir()
    (folder / "broken.ply").write_text("no mesh", encoding="utf-8")
    return write(folder, tree(objects={"Mesh": [GOOD, BROKEN], **objects}), form)


@pytest.mark.parametrize("form", ["xml", "json"])
def test_a_broken_mesh_file_is_told_with_its_mesh_and_path(tmp_path: Path, form: str) -> None:
    source = scene_in(tmp_path / "scene", form)
    target = tmp_path / "elsewhere" / "box.yaml"
    target.parent.mkdir()
    (one,), _ = convert(source, target)
    with pytest.raises(SceneError) as caught:
        load_scene(one.path)
    told = str(retold(caught.value, source, one.path))
    broken = source.parent / "broken.ply"
    assert told.startswith(f"{source}: as a scene of this course: objects[1]: mesh 7: {broken}: ")
    assert "not a PLY file" in told


@pytest.mark.parametrize("form", ["xml", "json"])
def test_a_plane_beside_a_broken_mesh_file_changes_nothing(tmp_path: Path, form: str) -> None:
    """Planes are made as large as the meshes need, so these are read by the conversion already."""
    plane = {"_id": "1", "Material": "1", "Point": "1", "Normal": "0 1 0"}
    source = scene_in(tmp_path / "scene", form, Plane=plane)
    target = tmp_path / "elsewhere" / "box.yaml"
    target.parent.mkdir()
    with pytest.raises(SceneError) as caught:
        convert(source, target)
    broken = source.parent / "broken.ply"
    assert f"Scene/Objects/Mesh[2]/Faces: plyFile can't be used: {broken}: " in str(caught.value)
