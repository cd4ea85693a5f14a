"""The meshes of a METU scene: `VertexData` and `Faces`, the files that it names, and planes as squares.

A plane is a square so large that its edges are as good as the horizon, around the middle of everything else, and rings
about it, each twice as wide as the one inside. Triangles close by are small, so that rays leave them as they would
leave any floor, and those far off are large.
"""

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np

from course.base.atomic import make_folder
from course.base.errors import GeometryError, SceneError
from course.base.inputs import LARGEST_DATA, InputLimit, opened
from course.engine.core.types import Floats32, Floats64, Indices
from course.engine.formats.meshes.files import read_mesh, save_ply
from course.engine.formats.meshes.smooth_normals import area_normals
from course.engine.formats.metu.element import MetuElement, Notes
from course.engine.formats.metu.lights import tangents
from course.engine.formats.pictures.files import write_exr
from course.engine.formats.yaml.document import show
from course.engine.shapes.mesh import Mesh

LONGEST_HEADER = 1 << 16  # bytes


def read_vertices(scene: MetuElement) -> Floats64:
    """The vertices of a scene, (V, 3) float64; none where it has no VertexData."""
    element = scene.maybe("VertexData")
    if element is None:
        return np.zeros((0, 3))
    axes = element.attribute("type") or "xyz"
    if sorted(axes) != ["x", "y", "z"]:
        raise element.error(f"type is {show(axes)}: expected the order of x, y and z, such as xyz")
    values = element.many("x, y and z of each vertex")
    if len(values) % 3:
        raise element.error(f"has {len(values)} numbers: expected three for each vertex")
    return values.reshape(-1, 3)[:, [axes.index(axis) for axis in "xyz"]]


def inline_mesh(
    faces: MetuElement, vertices: Floats64, smooth: bool, places: Floats64 | None = None
) -> Mesh:
    """The mesh of triples of vertex numbers, with only the vertices that it uses.

    ``places``: (P, 2) texture coordinates of the scene, if the mesh has a texture.
    """
    offset = offset_of(faces, "vertexOffset")
    aside = offset_of(faces, "textureOffset")
    corners = corners_of(faces, vertices, offset)
    used, triangles = np.unique(corners, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    own = vertices[used]
    uv = None if places is None else places_of(faces, used - offset + aside, places)
    return Mesh(own, triangles, area_normals(own, triangles) if smooth else None, uv)


def places_of(element: MetuElement, numbers: Indices, places: Floats64) -> Floats64:
    """Texture coordinates (n, 2) of numbers (n,) from 0 on; SceneError for one that TexCoordData doesn't have."""
    if len(numbers) and not 0 <= numbers.min() <= numbers.max() < len(places):
        raise element.error(
            f"has a texture, and refers to texture coordinates {numbers.min() + 1} to {numbers.max() + 1}: expected"
            f" numbers from 1 to {len(places)}, as TexCoordData has"
        )
    return places[numbers]


def offset_of(faces: MetuElement, name: str) -> int:
    """What is added to each number of a vertex, or of its texture coordinates."""
    given = faces.attribute(name) or "0"
    try:
        return int(given)
    except ValueError:
        raise faces.error(f"{name} is {given!r}: expected a whole number") from None


def corners_of(element: MetuElement, vertices: Floats64, offset: int = 0) -> Indices:
    """Triples of vertex numbers, counted from 1 in the file, as indices (T, 3)."""
    values = element.many("three vertex numbers for each triangle, such as 1 2 3")
    if len(values) == 0 or len(values) % 3 or (values != np.floor(values)).any():
        raise element.unexpected("three vertex numbers for each triangle, such as 1 2 3")
    check_indices(element, values + offset, vertices)
    return (values + offset).astype(np.intp).reshape(-1, 3) - 1


def check_indices(element: MetuElement, numbers: Floats64, vertices: Floats64) -> None:
    """SceneError for a vertex number that VertexData doesn't have."""
    wrong = numbers[(numbers < 1) | (numbers > len(vertices))]
    if len(wrong):
        raise element.error(
            f"refers to vertex {wrong[0]:g}: expected numbers from 1 to {len(vertices)}, as VertexData has"
        )


def mesh_file(faces: MetuElement, name: str, folder: Path) -> Path:
    """The file that Faces names; SceneError where there is none."""
    path = folder / name.replace("\\", "/")
    # Path.exists would raise an error of its own for a name that is too long.
    if not os.path.exists(path):  # noqa: PTH110
        raise faces.error(f"plyFile is {name}: no such file in {folder.resolve()}")
    if path.suffix.lower() != ".ply":
        raise faces.error(f"plyFile is {name}: expected a file that ends in .ply")
    return path


def has_normals(path: Path) -> bool:
    """True if a PLY file has normals of its own."""
    with opened(path, "mesh file", InputLimit(LARGEST_DATA), SceneError) as stream:
        header = stream.read(LONGEST_HEADER).partition(b"end_header")[0]
    names = {line.split()[-1] for line in header.splitlines() if line.startswith(b"property ")}
    return {b"nx", b"ny", b"nz"} <= names


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
    _named_by: dict[str, MetuElement] = field(default_factory=dict)
    _own: dict[str, Mesh] = field(default_factory=dict)
    _pictures: dict[str, Floats32] = field(default_factory=dict)

    def add_file(self, file: Path, faces: MetuElement) -> str:
        """Read a file that an element names, once; its name. One that can't be used is told where it is named."""
        name = self.name_of(file)
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

    def add_own(self, mesh: Mesh, stem: str, source: MetuElement) -> str:
        """Take a mesh that an element of the scene holds; its name, of that stem."""
        name = f"{self.folder}/{stem}.ply"
        self._check_area(mesh, source)
        self._own[name], self.vertices[name] = mesh, mesh.vertices
        return name

    def add_picture(self, picture: Floats32, stem: str) -> str:
        """Take a picture (H, W, 3) of a texture; its name, of that stem."""
        name = f"{self.folder}/{stem}.exr"
        self._pictures[name] = picture
        return name

    def write(self) -> None:
        """Write the meshes that the scene holds, and the pictures.

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
        for name, picture in self._pictures.items():
            path = self.target / name
            make_folder(path.parent)
            write_exr(path, np.moveaxis(picture, -1, 0))

    def _check_area(self, mesh: Mesh, source: MetuElement) -> None:
        p0, p1, p2 = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
        if not np.cross(p1 - p0, p2 - p0).any():
            self.notes.add(source, "has no triangle with an area: nothing of it can be seen")

    def name_of(self, path: Path) -> str:
        """A file's name as seen from the converted scene."""
        try:
            return Path(os.path.relpath(path.resolve(), self.target.resolve())).as_posix()
        except ValueError:  # on another drive
            return path.resolve().as_posix()


RINGS: Final = 12
"""The outermost is 2^12 times as far away as the farthest thing in the scene.

From a camera as high as the scene is large it ends 1/4096 rad below the horizon.
"""

CORNERS: Final = ((-1, -1), (1, -1), (1, 1), (-1, 1))
"""Counter-clockwise about the normal."""


def plane_mesh(point: Floats64, normal: Floats64, others: Floats64) -> Mesh:
    """The square of a plane.

    Parameters
    ----------
    point, normal : (3,), of any length
    others : (N, 3) corners of everything else in the scene, cameras among it
    """
    normal = normal / np.abs(normal).max()
    normal = normal / np.linalg.norm(normal)
    middle = (others.min(axis=0) + others.max(axis=0)) / 2 if len(others) else point
    # The square's middle is below the scene's: the compiled scene, which lies about its own middle, keeps its digits.
    center = middle - normal * float(normal @ (middle - point))
    half = float(np.linalg.norm(others - center, axis=1).max()) if len(others) else 0.0
    half = half or 1.0
    u, v = tangents(normal)
    squares = [
        center + half * 2.0**ring * (a * u + b * v) for ring in range(RINGS + 1) for a, b in CORNERS
    ]
    triangles = [(0, 1, 2), (0, 2, 3)]
    for ring in range(RINGS):
        for k in range(4):
            a, b = 4 * ring + k, 4 * ring + (k + 1) % 4
            triangles += [(a, a + 4, b + 4), (a, b + 4, b)]
    return Mesh(np.array(squares), np.array(triangles, np.int32), None)
