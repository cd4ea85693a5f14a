"""Mesh files: PLY, OBJ, STL and GLB in, PLY out.

A mesh leaves `read_mesh` checked: finite, every index in range, one triangle or more, unit normals.
"""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from course.atomic import replacing
from course.core.types import Floats64
from course.errors import CourseWarning, GeometryError
from course.formats.meshes.beside import Beside
from course.formats.meshes.gltf import parse_glb, parse_gltf
from course.formats.meshes.named import Named
from course.formats.meshes.obj import parse_obj
from course.formats.meshes.parts import Part, same
from course.formats.meshes.ply import parse_ply
from course.formats.meshes.smooth_normals import (
    angle_normals,
    area_normals,
    edges_and_faces,
    smooth_normals,
    unit,
)
from course.formats.meshes.stl import parse_stl
from course.formats.meshes.transforms import apply_all
from course.inputs import LARGEST_DATA, Bound, read_input, shown
from course.shapes.grid import join
from course.shapes.mesh import Mesh

FORMATS: Final[dict[str, Callable[[bytes, Beside], list[Part]]]] = {
    ".ply": lambda data, _: parse_ply(data),
    ".obj": lambda data, _: parse_obj(data),
    ".stl": lambda data, _: parse_stl(data),
    ".glb": parse_glb,
    ".gltf": parse_gltf,
}

# Beyond this, squares of distances overflow float64; no unit makes a scene that large.
FARTHEST = 1e150

# Areas of triangles of size 1 under which rounding decides where they look.
SLIVER = 1e-6

# Cosine of an angle to a normal, from which on rounding hasn't decided on which side it is.
ALONG = 0.99

# Share of an STL file's triangles along whose facet normals they must lie; else these are no normals, and tell nothing.
MOSTLY = 0.99


USUAL = Bound(LARGEST_DATA)

Weights = Literal["angle", "area"]
"""By what the faces around a vertex count in its normal."""


def read_mesh(path: Path, weights: Weights = "angle", bound: Bound = USUAL) -> Mesh:
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
    triangles, an index out of range, a vertex or a normal that is not finite and that a face has; in a PLY or OBJ file
    a face of fewer than three corners. Of text the line is told.

    Parameters
    ----------
    path : ends in .ply, .obj, .stl, .glb or .gltf, in capitals or not. No other file is read.
    weights : "angle" or "area", by what faces count in normals that the file doesn't have
    bound : the most bytes that the file may have
    """
    return read_named_mesh(path, weights, bound).mesh


def read_named_mesh(path: Path, weights: Weights = "angle", bound: Bound = USUAL) -> Named:
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
            raise GeometryError(
                f"{file}: not a {path.suffix[1:].upper()} file that can be read: {_reason(error)}"
            ) from error
    for note in dict.fromkeys(note for part in parts for note in part.notes):
        warnings.warn(f"{file}: {note}", CourseWarning, stacklevel=2)
    if not parts:
        raise GeometryError(f"{file}: no triangles")
    meshes = []
    for number, part in enumerate(parts):
        name = file if len(parts) == 1 else f"{file}: geometry {number}"
        mesh = _checked(name, part, weights)
        try:
            moved = (part.places != np.eye(4)).any()
            meshes.append(apply_all(mesh, part.places) if moved else mesh)
        except ValueError as error:
            raise GeometryError(f"{name}: its node's {error}") from error
    if not all(mesh.normals is None for mesh in meshes):
        meshes = [mesh if mesh.normals is not None else _parted(mesh) for mesh in meshes]
    mesh = join(meshes)
    mesh = _merged(mesh) if path.suffix.lower() == ".stl" else mesh
    return Named(mesh, *_names(parts))


def _names(parts: list[Part]) -> tuple[tuple[str, ...], NDArray[np.intp]]:
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


def _checked(name: str, part: Part, weights: Weights) -> Mesh:
    """Return the mesh of `part`, in its own frame; GeometryError for what can't be used."""
    vertices = np.array(part.vertices, np.float64)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise GeometryError(f"{name}: vertices have shape {vertices.shape}: expected (V, 3)")
    triangles = part.triangles
    outside = (triangles < 0) | (triangles >= len(vertices))
    if outside.any():
        t, corner = np.argwhere(outside)[0]
        raise GeometryError(
            f"{name}: triangle {t} refers to vertex {triangles[t, corner]}: "
            f"out of range, there are {len(vertices)}, from 0"
        )
    unusable = _without_odd_rows(name, "vertex", vertices, triangles, FARTHEST)
    if len(vertices) <= np.iinfo(np.int32).max:
        triangles = triangles.astype(np.int32)
    normals: Floats64 | None
    normals, given = _normals(name, part, len(vertices))
    stored = np.asarray(part.vertices).dtype
    precision = float(np.finfo(stored).eps) if stored.kind == "f" else 0.0
    if given.any():
        out = normals[triangles].sum(axis=1)
        triangles = _outwards(name, vertices, triangles, out, precision)
    elif part.facets is not None:
        facets = unit(np.nan_to_num(np.array(part.facets, np.float64), posinf=0.0, neginf=0.0))
        triangles = _outwards(name, vertices, triangles, facets, precision, MOSTLY)
    if part.flat:
        normals = None
    elif not given.all():
        normals = np.where(given, normals, _computed(part, vertices, triangles, weights))
    mesh = Mesh(vertices, triangles, normals, _uv(name, part, len(vertices)))
    return _used(mesh) if unusable else mesh


def _computed(
    part: Part, vertices: Floats64, triangles: NDArray[np.integer], weights: Weights
) -> Floats64:
    """The normals (V, 3) that the file doesn't have."""
    if part.shared is None:
        compute = area_normals if weights == "area" else smooth_normals
        return compute(vertices, triangles)
    # Vertices of one normal lie at one place.
    places = np.zeros((int(part.shared.max(initial=-1)) + 1, 3))
    places[part.shared] = vertices
    shared = part.shared[triangles]
    normals = area_normals(places, shared) if weights == "area" else angle_normals(places, shared)
    return normals[part.shared]


def _parted(mesh: Mesh) -> Mesh:
    """A flat mesh with a vertex for each corner, and its normal."""
    corners = mesh.triangles.ravel()
    vertices = mesh.vertices[corners]
    triangles = np.arange(len(corners), dtype=mesh.triangles.dtype).reshape(-1, 3)
    uv = None if mesh.uv is None else mesh.uv[corners]
    return Mesh(vertices, triangles, angle_normals(vertices, triangles), uv)


def _used(mesh: Mesh) -> Mesh:
    """The mesh without vertices that no triangle has."""
    used = np.zeros(len(mesh.vertices), bool)
    used[mesh.triangles] = True
    number = (np.cumsum(used) - 1).astype(mesh.triangles.dtype)
    normals, uv = (rows if rows is None else rows[used] for rows in (mesh.normals, mesh.uv))
    return Mesh(mesh.vertices[used], number[mesh.triangles], normals, uv)


def _normals(name: str, part: Part, count: int) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the file's normals (V, 3), made unit or 0, and (V, 1) which vertices have one."""
    if part.normals is None:
        return np.zeros((count, 3)), np.zeros((count, 1), bool)
    normals = np.array(part.normals, np.float64)
    if normals.shape != (count, 3):
        raise GeometryError(f"{name}: {len(normals)} normals for {count} vertices")
    _without_odd_rows(name, "normal", normals, part.triangles)
    return unit(normals), np.asarray(normals.any(axis=1, keepdims=True))


def _outwards(
    name: str,
    vertices: NDArray[np.float64],
    triangles: NDArray[np.integer],
    out: NDArray[np.float64],
    precision: float,
    mostly: float = 0.0,
) -> NDArray[np.integer]:
    """Return triangles that look to the same side as ``out`` (T, 3); warn of those that were turned.

    Parameters
    ----------
    precision : a coordinate as the file holds it is right to so many times its distance from 0
    mostly : least share of triangles along whose ``out`` they lie, on either side; of fewer none is turned
    """
    _, faces, lengths = edges_and_faces(vertices, triangles)
    ahead = np.sum(faces * out, axis=1)
    sizes = np.sqrt(np.sum(faces * faces, axis=1) * np.sum(out * out, axis=1))
    along = np.abs(ahead) > ALONG * sizes
    # A sliver that rounding alone gives an area looks nowhere.
    far = np.abs(vertices[triangles]).max(axis=(1, 2), initial=0.0)
    rounding = np.where(along, 0.0, 16 * precision * far / lengths)
    wrong = ahead < -(SLIVER + rounding)
    looking = sizes > SLIVER
    if not wrong.any() or np.count_nonzero(along & looking) < mostly * np.count_nonzero(looking):
        return triangles
    warnings.warn(
        f"{name}: {np.count_nonzero(wrong):,} of {len(wrong):,} triangles are wound against their "
        "normals; they were turned, so that the normals' side is the outside",
        CourseWarning,
        stacklevel=2,
    )
    return np.where(wrong[:, None], triangles[:, [0, 2, 1]], triangles)


def _uv(name: str, part: Part, count: int) -> NDArray[np.float64] | None:
    if part.uv is None:
        return None
    uv = np.array(part.uv, np.float64)
    # Some files carry a third texture coordinate, always 0.
    if uv.ndim != 2 or len(uv) != count or uv.shape[1] < 2:
        raise GeometryError(f"{name}: uv have shape {uv.shape}: expected ({count}, 2)")
    uv = uv[:, :2].copy()
    _without_odd_rows(name, "uv", uv, part.triangles)
    return uv


def _merged(mesh: Mesh) -> Mesh:
    """Return `mesh` with vertices equal in place and normal as one."""
    assert mesh.normals is not None
    first, vertex = same(*mesh.vertices.T, *mesh.normals.T)
    triangles = vertex[mesh.triangles].astype(mesh.triangles.dtype)
    return Mesh(mesh.vertices[first], triangles, mesh.normals[first])


def _without_odd_rows(
    name: str,
    noun: str,
    rows: NDArray[np.float64],
    triangles: NDArray[np.integer],
    farthest: float = np.inf,
) -> bool:
    """Refuse rows that aren't finite or lie too far away; others become 0. Whether there are any."""
    finite = np.asarray(np.isfinite(rows).all(axis=1))
    odd = np.asarray(~finite | (np.abs(rows).max(axis=1, initial=0.0) > farthest))
    if not odd.any():
        return False
    used = np.zeros(len(rows), bool)
    used[triangles] = True
    if (odd & used).any():
        k = int(np.argmax(odd & used))
        what = f"beyond {farthest:g}" if finite[k] else "expected finite numbers"
        raise GeometryError(f"{name}: {noun} {k} is {_row(rows, k)}: {what}")
    rows[odd] = 0.0
    return True


def _row(rows: NDArray[np.float64], k: int) -> str:
    return "(" + ", ".join(f"{x:g}" for x in rows[k]) + ")"
