"""Scenes of the suite as files, rendered; and where the unit scene is put: turned, scaled by k, moved."""

import json
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.triangles import cut
from course import load_scene, render
from course.engine.formats.meshes.transforms import rotate

AXIS = (1.0, 2.0, 3.0)
AWAY = np.array([1.0, -0.7, 0.31])
"""Direction of the offset, its longest component 1."""

Vector = list[float]
Steps = list[dict[str, Any]]


@dataclass(frozen=True)
class Placement:
    """x -> k R x + k offset.

    Attributes
    ----------
    k : half the extent of the scene [units of the scene file]
    away : the offset [extents, which are 2 k]
    degrees : of the turn R about AXIS
    """

    k: float = 1.0
    away: float = 0.0
    degrees: float = 0.0

    @property
    def _turn(self) -> NDArray[np.float64]:
        if self.degrees == 0:
            return np.eye(3)
        return np.asarray(rotate(AXIS, self.degrees)[:3, :3])

    def points(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions (V, 3)."""
        turned = x if self.degrees == 0 else x @ self._turn.T
        return np.asarray(self.k * turned + 2 * self.away * self.k * AWAY)

    def point(self, *x: float) -> Vector:
        """A position."""
        return [float(v) for v in self.points(np.array([x], float))[0]]

    def vector(self, *x: float) -> Vector:
        """A difference of positions, or a velocity."""
        return [self.k * v for v in self.direction(*x)]

    def direction(self, *x: float) -> Vector:
        """A direction, its length kept."""
        return [float(v) for v in self._turn @ np.array(x, float)]

    def length(self, x: float) -> float:
        """A length."""
        return self.k * x

    def intensity(self, x: float) -> float:
        """An intensity, which counts per squared length."""
        return self.k * self.k * x

    def steps(self, *x: float) -> Steps:
        """The `transform` of a shape whose own sizes are scaled already."""
        moved: Steps = [{"translate": self.point(*x)}]
        return [self.turned(), *moved] if self.degrees else moved

    def turned(self) -> dict[str, Any]:
        """The step of the turn."""
        return {"rotate": {"axis": list(AXIS), "degrees": self.degrees}}

    def normals(self, n: NDArray[np.float64]) -> NDArray[np.float64]:
        """Unit normals (V, 3)."""
        return n if self.degrees == 0 else np.asarray(n @ self._turn.T)


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

    def with_(self, **parts: Any) -> "SceneFiles":
        """The same files with some of the description replaced."""
        return SceneFiles(self.description | parts, self.texts, self.pictures)

    def write(self, folder: Path) -> Path:
        """Write everything; return the scene file."""
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in self.texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        for name, picture in self.pictures.items():
            from course.engine.formats.pictures.files import save

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
