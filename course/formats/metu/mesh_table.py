"""The mesh files of a converted scene: those that the METU scene names, and those of the meshes in the scene itself."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from course.atomic import make_folder
from course.core.triangles import Mesh
from course.core.types import Floats64
from course.errors import GeometryError
from course.formats.meshes.files import read_mesh, save_ply
from course.formats.metu.element import Element
from course.formats.metu.notes import Notes


@dataclass
class MeshTable:
    """Meshes by their file's name as seen from the converted scene; nothing is written before `write`.

    Attributes
    ----------
    target : folder of the converted scene
    folder : name of the folder beside it for meshes that the scene holds itself
    notes : what there is to say about them
    vertices : of each mesh by its name, (V, 3) float64
    """

    target: Path
    folder: str
    notes: Notes
    vertices: dict[str, Floats64] = field(default_factory=dict)
    _named_by: dict[str, Element] = field(default_factory=dict)
    _own: dict[str, Mesh] = field(default_factory=dict)

    def add_file(self, file: Path, faces: Element) -> str:
        """Read a file that an element names, once; its name. One that can't be used is told where it is named."""
        name = self._name(file)
        if name not in self._named_by:
            try:
                # Its normals aren't looked at here, and these are the quicker ones.
                mesh = read_mesh(file, "area")
            except GeometryError as error:
                raise faces.error(f"plyFile can't be used: {error}") from None
            self._check_area(mesh, faces)
            self.vertices[name] = mesh.vertices
            self._named_by[name] = faces
        return name

    def add_own(self, mesh: Mesh, stem: str, source: Element) -> str:
        """Take a mesh that an element of the scene holds; its name, of that stem."""
        name = f"{self.folder}/{stem}.ply"
        self._check_area(mesh, source)
        self._own[name], self.vertices[name] = mesh, mesh.vertices
        return name

    def write(self) -> None:
        """Write the meshes that the scene holds.

        Raises
        ------
        SceneError
            A file that the scene names would be lost.
        OutputError
            A file can't be written.
        """
        for name in self._own:
            if name in self._named_by:
                raise self._named_by[name].error(
                    f"plyFile is {name}, which the conversion would write over:"
                    " give another name to it, or to the converted scene"
                )
        for name, mesh in self._own.items():
            path = self.target / name
            make_folder(path.parent)
            save_ply(mesh, path)

    def _check_area(self, mesh: Mesh, source: Element) -> None:
        p0, p1, p2 = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
        if not np.cross(p1 - p0, p2 - p0).any():
            self.notes.add(source, "has no triangle with an area: nothing of it can be seen")

    def _name(self, path: Path) -> str:
        try:
            return Path(os.path.relpath(path.resolve(), self.target.resolve())).as_posix()
        except ValueError:  # on another drive
            return path.resolve().as_posix()
