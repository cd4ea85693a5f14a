"""Mesh files: PLY, OBJ, STL, GLB and glTF in, PLY out.

A mesh leaves `read_mesh` checked: finite, every index in range, one triangle or more, unit normals, or none where the
file says that triangles are flat.
"""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from course.base.atomic import replacing
from course.base.errors import CourseWarning, GeometryError
from course.base.inputs import LARGEST_DATA, InputLimit, read_input, shown
from course.engine.core.types import Mask
from course.engine.formats.meshes.beside import Beside
from course.engine.formats.meshes.checked import Weights, checked
from course.engine.formats.meshes.gltf import parse_glb, parse_gltf
from course.engine.formats.meshes.named import NamedMesh
from course.engine.formats.meshes.obj import parse_obj
from course.engine.formats.meshes.parts import FilePart, same
from course.engine.formats.meshes.ply import parse_ply
from course.engine.formats.meshes.smooth_normals import angle_normals
from course.engine.formats.meshes.stl import parse_stl
from course.engine.formats.meshes.transforms import apply_all
from course.engine.shapes.grid import join
from course.engine.shapes.mesh import Mesh

FORMATS: Final[dict[str, Callable[[bytes, Beside], list[FilePart]]]] = {
    ".ply": lambda data, _: parse_ply(data),
    ".obj": lambda data, _: parse_obj(data),
    ".stl": lambda data, _: parse_stl(data),
    ".glb": parse_glb,
    ".gltf": parse_gltf,
}


USUAL = InputLimit(LARGEST_DATA)


def read_mesh(path: Path, weights: Weights = "angle", bound: InputLimit = USUAL) -> Mesh:
    """Read a mesh file; several geometries in it become one mesh, in the file's own frame.

    Normals and uv are the file's where it has them. Without normals, triangles that share a vertex
    are smooth, in an OBJ file with smoothing groups within these, and in a GLB file nothing is; vertices that only lie
    at the same place, as in every STL file, are smooth up to a crease of 40 degrees (`smooth_normals`), unless faces
    weigh by their areas (`area_normals`).
    Triangles without area are let through. Where the file has normals they say which side is out:
    triangles that are wound the other way are turned, and a `CourseWarning` says how many. An STL
    file's normals are its facets'; where they don't lie along these, they say nothing. A `CourseWarning` each tells
    what of the file is left out, and faces that cross themselves or have no area.
    Raises GeometryError, naming the file and the trouble: missing, no regular file, too large, empty, unreadable, no
    triangles, an index out of range, a vertex or a uv that is not finite and that a face has; in a PLY or OBJ file
    a face without corners. Of text the line is told. Normals that are not finite are computed, and told.

    Parameters
    ----------
    path : ends in .ply, .obj, .stl, .glb or .gltf, in capitals or not. No other file is read.
    weights : "angle" or "area", by what faces count in normals that the file doesn't have
    bound : the most bytes that the file may have
    """
    return read_named_mesh(path, weights, bound).mesh


def read_named_mesh(path: Path, weights: Weights = "angle", bound: InputLimit = USUAL) -> NamedMesh:
    """As `read_mesh`, with the names of materials that OBJ and GLB files give to faces."""
    path = Path(path)
    parse = FORMATS.get(path.suffix.lower())
    if parse is None:
        raise GeometryError(
            f"{shown(path)}: expected a file that ends in {', '.join(sorted(FORMATS))}"
        )
    data = read_input(path, "mesh file", bound, GeometryError)
    file = shown(path)
    if not data.strip():
        raise GeometryError(f"{file}: the file is empty")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        # NumPy before 2.3 only warns of text it can't read to the end, and goes on without it.
        warnings.filterwarnings("error", message="string or file could not be read")
        try:
            parts = parse(data, Beside(path.parent, bound))
        except GeometryError:
            raise
        except MemoryError as error:
            raise GeometryError(f"{file}: too large for this computer's memory") from error
        except Exception as error:
            kind = path.suffix[1:].upper()
            article = "an" if kind[0] in "OS" else "a"
            raise GeometryError(
                f"{file}: not {article} {kind} file that can be read: {_reason(error)}"
            ) from error
    for note in dict.fromkeys(note for part in parts for note in part.notes):
        warnings.warn(f"{file}: {note}", CourseWarning, stacklevel=2)
    if not parts:
        raise GeometryError(f"{file}: no triangles")
    meshes = []
    for number, part in enumerate(parts):
        name = file if len(parts) == 1 else f"{file}: geometry {number}"
        mesh = checked(name, part, weights)
        try:
            moved = (part.places != np.eye(4)).any()
            meshes.append(apply_all(mesh, part.places) if moved else mesh)
        except ValueError as error:
            raise GeometryError(f"{name}: its node's {error}") from error
    if not all(mesh.normals is None for mesh in meshes):
        meshes = [mesh if mesh.normals is not None else _parted(mesh) for mesh in meshes]
    mesh = join(meshes)
    mesh = _merged(mesh) if path.suffix.lower() == ".stl" else mesh
    return NamedMesh(mesh, *_names(parts), _bare(parts))


def _names(parts: list[FilePart]) -> tuple[tuple[str, ...], NDArray[np.intp]]:
    """The names of materials of all parts, and which each triangle has."""
    numbers = {name: k for k, name in enumerate(dict.fromkeys(n for p in parts for n in p.names))}
    if not numbers:
        return (), np.zeros(0, np.intp)
    found = []
    for part in parts:
        if part.name is None:
            name = np.full(len(part.triangles), numbers.setdefault("", len(numbers)))
        else:
            name = np.array([numbers[each] for each in part.names])[part.name]
        found += [name] * len(part.places)
    return tuple(numbers), np.concatenate(found).astype(np.intp)


def _bare(parts: list[FilePart]) -> Mask | None:
    """Which triangles of all parts have no uv though others have; None where none is so."""
    without = [part.uv is None for part in parts]
    if all(without) or not (any(without) or any(part.bare is not None for part in parts)):
        return None
    found = [
        np.full(len(part.triangles), part.uv is None) if part.bare is None else part.bare
        for part in parts
    ]
    return np.concatenate(
        [np.tile(each, len(part.places)) for each, part in zip(found, parts, strict=True)]
    )


def ply_bytes(mesh: Mesh) -> bytes:
    """`mesh` as binary PLY: vertices, normals and uv (as s and t) where it has them, every bit of their float64."""
    columns = {"x y z": mesh.vertices, "nx ny nz": mesh.normals, "s t": mesh.uv}
    given = {names: rows for names, rows in columns.items() if rows is not None}
    header = "\n".join(
        [
            "ply",
            "format binary_little_endian 1.0",
            f"element vertex {len(mesh.vertices)}",
            *(f"property double {name}" for names in given for name in names.split()),
            f"element face {len(mesh.triangles)}",
            "property list uchar int vertex_indices",
            "end_header\n",
        ]
    )
    faces = np.empty(len(mesh.triangles), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    faces["count"], faces["corners"] = 3, mesh.triangles
    vertices = np.concatenate(list(given.values()), axis=1).astype("<f8")
    return header.encode("ascii") + vertices.tobytes() + faces.tobytes()


def save_ply(mesh: Mesh, path: Path) -> None:
    """Write `ply_bytes`; OutputError where the file can't be written."""
    with replacing(path) as temporary:
        temporary.write_bytes(ply_bytes(mesh))


def _reason(error: Exception) -> str:
    """Return an exception as one line; a KeyError's message alone is only the key."""
    text = " ".join(str(error).split())
    if type(error) in (ValueError, IndexError, NotImplementedError) and text:
        return text
    return f"{type(error).__name__} {text}".rstrip()


def _parted(mesh: Mesh) -> Mesh:
    """A flat mesh with a vertex for each corner, and its normal."""
    corners = mesh.triangles.ravel()
    vertices = mesh.vertices[corners]
    triangles = np.arange(len(corners), dtype=mesh.triangles.dtype).reshape(-1, 3)
    uv = None if mesh.uv is None else mesh.uv[corners]
    return Mesh(vertices, triangles, angle_normals(vertices, triangles), uv)


def _merged(mesh: Mesh) -> Mesh:
    """Return `mesh` with vertices equal in place and normal as one."""
    assert mesh.normals is not None
    first, vertex = same(*mesh.vertices.T, *mesh.normals.T)
    triangles = vertex[mesh.triangles].astype(mesh.triangles.dtype)
    return Mesh(mesh.vertices[first], triangles, mesh.normals[first])
