"""A mesh file that has been read: its mesh, and which of its faces have which of its materials."""

from dataclasses import dataclass

from course.engine.core.types import Indices, Mask
from course.engine.shapes.mesh import Mesh


@dataclass(frozen=True)
class NamedMesh:
    """A mesh, and which of its triangles have which of the file's materials.

    Attributes
    ----------
    names : of materials that triangles have, "" for none; empty where the file names no materials
    name : (T,) integer, which of the names each triangle has
    bare : (T,) which triangles have no uv, of a mesh of which others have; None where none is so
    """

    mesh: Mesh
    names: tuple[str, ...]
    name: Indices
    bare: Mask | None = None
