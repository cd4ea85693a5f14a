"""METU scenes as the tree that their JSON form is, written as XML or as JSON, converted and rendered."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, load_scene, render
from course.engine.formats.metu.converting import convert
from course.engine.loops import embree_device

Tree = dict[str, Any]

CAMERA: Tree = {
    "_id": "1",
    "Position": "0 0 0",
    "Gaze": "0 0 -1",
    "Up": "0 1 0",
    "NearPlane": "-1 1 -1 1",
    "NearDistance": "1",
    "ImageResolution": "1 1",
    "ImageName": "one.png",
}
"""At the origin, looking along -z, one pixel."""

WALL = "-9 -9 -4  9 -9 -4  9 9 -4  -9 9 -4"
"""Corners of a square at z = -4 that faces the camera."""

MATT: Tree = {"_id": "1", "AmbientReflectance": "1 1 1", "DiffuseReflectance": "1 0.5 0"}


def tree(
    *,
    camera: Tree | None = None,
    materials: list[Tree] | None = None,
    vertices: str = WALL,
    objects: Tree | None = None,
    lights: Tree | None = None,
    **others: Any,
) -> Tree:
    """A scene with one camera; what isn't given is a matt wall in ambient light of 100."""
    wall = {"_id": "1", "Material": "1", "Faces": "1 2 3 1 3 4"}
    return {
        "Cameras": {"Camera": CAMERA | (camera or {})},
        "Lights": {"AmbientLight": "100 100 100"} if lights is None else lights,
        "Materials": {"Material": [MATT] if materials is None else materials},
        "VertexData": vertices,
        "Objects": {"Mesh": wall} if objects is None else objects,
        **others,
    }


def as_xml(tag: str, value: Any) -> str:
    """The XML of a tree."""
    if isinstance(value, list):
        return "".join(as_xml(tag, item) for item in value)
    if not isinstance(value, dict):
        return f"<{tag}>{escape(str(value))}</{tag}>\n"
    attributes = "".join(
        f" {key[1:]}={quoteattr(str(item))}"
        for key, item in value.items()
        if key.startswith("_") and key != "_data"
    )
    inside = escape(str(value.get("_data", "")))
    inside += "".join(as_xml(key, item) for key, item in value.items() if not key.startswith("_"))
    return f"<{tag}{attributes}>{inside}</{tag}>\n"


def write(folder: Path, scene: Tree, form: str) -> Path:
    """Write a tree as scene.xml or scene.json."""
    path = folder / f"scene.{form}"
    text = as_xml("Scene", scene) if form == "xml" else json.dumps({"Scene": scene})
    path.write_text(text, encoding="utf-8")
    return path


@dataclass
class Metu:
    """Converts trees in one form, and keeps the warnings."""

    folder: Path
    form: str
    warnings: list[str]

    def load(self, scene: Tree) -> Scene:
        """The first camera's scene."""
        converted, self.warnings = convert(
            write(self.folder, scene, self.form), self.folder / "scene.yaml"
        )
        return load_scene(converted[0].path)

    def picture(self, scene: Tree, **options: Any) -> NDArray[np.float64]:
        """(H, W, 3) radiance, 255 is white."""
        return render(self.load(scene), **options).linear.astype(np.float64)

    def pixel(self, scene: Tree, **options: Any) -> NDArray[np.float64]:
        """The radiance of a picture's middle pixel."""
        picture = self.picture(scene, **options)
        return picture[picture.shape[0] // 2, picture.shape[1] // 2]


@pytest.fixture(params=["xml", "json"])
def metu(request: pytest.FixtureRequest, tmp_path: Path) -> Metu:
    return Metu(tmp_path, request.param, [])


@pytest.fixture
def xml(tmp_path: Path) -> Metu:
    return Metu(tmp_path, "xml", [])


@pytest.fixture(params=[False, True], ids=["numpy", "compiled"])
def compiled(request: pytest.FixtureRequest) -> bool:
    """Whether compiled loops are used: each of the two is looked at by itself."""
    if request.param and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    return bool(request.param)
