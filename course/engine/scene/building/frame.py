"""The frame of the compiled scene: its own centre as origin, its own size as unit; and what float32 can carry in it.

Everything is moved and scaled in float64 before it becomes float32, so a scene in nanometres or parsecs, at the
origin or 10^8 of its sizes away, gives the same picture.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Floats64
from course.engine.formats.yaml.document import KeyPath
from course.engine.formats.yaml.loading import Loaded
from course.engine.shapes.mesh import Mesh


@dataclass(frozen=True)
class Frame:
    """x_compiled = (x - center) / scale, for positions in the units of the scene file.

    Attributes
    ----------
    center : (3,) float64
    scale : float > 0 [units of the scene file]
    reach : largest compiled coordinate of all objects; 1 unless some are very small
        (``course.engine.scene.building.small_objects``)
    """

    center: Floats64
    scale: float
    reach: float = 1.0

    def position(self, x: Sequence[float] | Floats64) -> Floats64:
        """Compiled positions, (3,) or (V, 3) float64."""
        moved: Floats64 = np.asarray(x, np.float64) - self.center
        return moved / self.scale

    def vector(self, x: Sequence[float] | Floats64) -> Floats64:
        """Compiled differences of positions."""
        scaled: Floats64 = np.asarray(x, np.float64) / self.scale
        return scaled

    def mesh(self, mesh: Mesh) -> Mesh:
        """A compiled mesh; normals don't change."""
        return Mesh(self.position(mesh.vertices), mesh.triangles, mesh.normals, mesh.uv)


def bounds_of(mesh: Mesh) -> Floats64:
    """The lowest and the highest corner of a mesh's triangles, (2, 3)."""
    used = np.zeros(len(mesh.vertices), np.bool_)
    used[mesh.triangles.ravel()] = True
    vertices = mesh.vertices if used.all() else mesh.vertices[used]
    # Column by column: along rows of three, NumPy takes eight times as long.
    return np.array([[way(column) for column in vertices.T] for way in (np.min, np.max)])


def frame_of(boxes: Sequence[Floats64]) -> Frame:
    """The frame in which all boxes, (2, 3) each, just fill [-1, 1]."""
    if not boxes:
        return Frame(np.zeros(3), 1.0)
    low = np.min([box[0] for box in boxes], axis=0)
    high = np.max([box[1] for box in boxes], axis=0)
    # Halved before they are added: the sum of two huge coordinates may overflow.
    center = low / 2 + high / 2
    scale = float((high / 2 - low / 2).max())
    return Frame(center, scale if scale > 0 else 1.0)


FARTHEST = 1e18
"""Sizes of the scene; squares of longer distances would overflow float32."""

BRIGHTEST = 1e20
"""Above this, light close to a surface would overflow float32 on its way to the film."""


def in_reach(x: Floats64, loaded: Loaded, path: KeyPath, what: str) -> Floats32:
    """A compiled position or length as float32; SceneError where it is too far away or too large."""
    return _single(x, FARTHEST, "in sizes of the scene", loaded, path, what)


def in_range(color: Floats64, loaded: Loaded, path: KeyPath, what: str, unit: str = "") -> Floats32:
    """A compiled colour as float32; SceneError where it is too bright. ``unit`` where it isn't the scene file's."""
    return _single(color, BRIGHTEST, unit, loaded, path, what)


def _single(
    x: Floats64, bound: float, unit: str, loaded: Loaded, path: KeyPath, what: str
) -> Floats32:
    if not (np.abs(x) < bound).all():
        largest = np.abs(x).max()
        size = f"{largest:.3g} {unit}".rstrip()
        raise loaded.document.error(path, f"{what} is {size}: expected less than {bound:g}")
    return x.astype(np.float32)
