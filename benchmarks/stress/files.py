"""A generated scene as files, and the picture that the renderer makes of it: what users do, and nothing besides."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.placement import Placement
from benchmarks.stress.triangles import cut
from course import load_scene, render

Array = NDArray[np.float64]
Corner = tuple[float, float, float] | Array

SCENE = "scene.yaml"


@dataclass
class SceneFiles:
    """A description and the files it names.

    Attributes
    ----------
    description : of the scene, plain data
    texts : name -> content of mesh files
    pictures : name -> (H, W, 3) float32
    """

    description: dict[str, Any]
    texts: dict[str, str] = field(default_factory=dict)
    pictures: dict[str, NDArray[np.float32]] = field(default_factory=dict)

    def with_(self, **parts: Any) -> SceneFiles:
        """The same files with some of the description replaced."""
        return SceneFiles(self.description | parts, self.texts, self.pictures)

    def write(self, folder: Path) -> Path:
        """Write everything; return the scene file."""
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in self.texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        for name, picture in self.pictures.items():
            from course.formats.pictures.files import save

            save(folder / name, np.moveaxis(picture, 2, 0))
        path = folder / SCENE
        # JSON is YAML.
        path.write_text(json.dumps(self.description, indent=1), encoding="utf-8")
        return path

    def picture(self, folder: Path, compiled: bool | None = None) -> Array:
        """(H, W, 3) float64 linear radiance; what NumPy warns of on the way there is an error.

        ``compiled``: whether by Numba's loops; None for what the renderer takes itself.
        """
        path = self.write(folder)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return _linear(path, compiled)


def _linear(path: Path, compiled: bool | None) -> Array:
    picture = render(load_scene(path, "solutions"), threads=1, compiled=compiled)
    return picture.linear.astype(np.float64)


def square(
    files: SceneFiles,
    name: str,
    place: Placement,
    triangles: tuple[str, float | None],
    middle: Corner,
    a: Corner,
    b: Corner,
    material: str,
    *,
    closed: bool = False,
) -> None:
    """Add the parallelogram middle + u a + v b, u and v in [-1, 1], as a mesh with normals along a x b."""
    kind, size = triangles
    made = cut(kind, size, closed=closed)
    va, vb = np.array(a, float), np.array(b, float)
    normal = np.cross(va, vb)
    normal /= np.linalg.norm(normal)
    # Corners of neighbouring squares are to be the same numbers, so every product must be exact there.
    local = np.array(middle) + made.points[:, :1] * va + made.points[:, 1:] * vb
    # What lies below lies behind, seen from where the camera is: outside of a closed box.
    local += made.below[:, None] * normal * (1 if closed else -1)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in place.points(local).tolist()]
    lines += ["vn {!r} {!r} {!r}".format(*place.normals(normal[None])[0].tolist())]
    lines += [f"f {i + 1}//1 {j + 1}//1 {k + 1}//1" for i, j, k in made.triangles.tolist()]
    files.texts[f"{name}.obj"] = "\n".join(lines) + "\n"
    files.description["objects"].append(
        {"shape": "mesh", "file": f"{name}.obj", "name": name, "material": material}
    )
