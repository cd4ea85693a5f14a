"""PLY, OBJ, STL and GLB bytes to `Part`s, by trimesh's parsers.

The parsers are called without the classes above them, which would merge, drop or recompute what the
file holds. What they pass over in silence is looked up here in the file itself, and refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.geometry.ply_header import Header, read_header
from course.geometry.ply_lines import checked_lines, word_that_is_no_number
from course.geometry.ply_polygons import fanned
from course.geometry.welding import same

Array = NDArray[Any]


@dataclass(frozen=True)
class Part:
    """One geometry of a file, as it stands there: nothing is checked.

    Attributes
    ----------
    vertices : (V, 3)
    triangles : (T, 3) integer
    normals : (V, 3) or None
        Of any length.
    uv : (V, 2) or None
        v upwards.
    transform : (4, 4) float64
        From the part's frame to the file's.
    """

    vertices: Array
    triangles: Array
    normals: Array | None
    uv: Array | None
    transform: NDArray[np.float64]


def parse_ply(data: bytes) -> list[Part]:
    """Return the mesh of a PLY file, its polygons cut into fans, with uv by vertex or by corner."""
    from trimesh.exchange.ply import load_ply

    header = read_header(data)
    if header.order == "ascii":
        plain = header.text() + checked_lines(header, data)
    else:
        plain = fanned(header.text() + data[header.end :])
    try:
        parsed = load_ply(BytesIO(plain), fix_texture=False, skip_materials=True)
    except Exception as error:
        trouble = _ply_trouble(header, data, error)
        if trouble is None:
            raise
        raise ValueError(trouble) from error
    raw = parsed["metadata"]["_ply_raw"]
    for name, element in raw.items():
        _check_element(name, element)
    parts = _parts({"geometry": {"": parsed}} if "geometry" not in parsed else parsed)
    faces = raw.get("face", {}).get("data")
    wedges: Array | None = None
    if isinstance(faces, dict):
        wedges = faces.get("texcoord")
    elif isinstance(faces, np.ndarray) and "texcoord" in (faces.dtype.names or ()):
        wedges = faces["texcoord"]["f1"]
    if wedges is None:
        return parts
    return [_split_by_corner(part, np.asarray(wedges)) for part in parts]


def _ply_trouble(header: Header, data: bytes, error: Exception) -> str | None:
    """What to say where trimesh can't read the data of a PLY file; None where it says it itself."""
    if header.order == "ascii":
        return word_that_is_no_number(header, data)
    if "unexpected length" in str(error):
        return (
            f"its {len(data) - header.end} bytes of data are an unexpected length:"
            " it is cut short, or a count in its header is wrong"
        )
    return None


def parse_obj(data: bytes) -> list[Part]:
    """Return the mesh of an OBJ file, its polygons cut into fans; materials are not looked at."""
    from trimesh.exchange.obj import load_obj

    text = _absolute_indices(_plain_lines(data.decode("utf-8", "replace")))
    _check_references(text)
    # Without materials and groups it is one part: vertices shared across them stay shared.
    text = re.sub(r"(?m)^(?:usemtl|mtllib|o|g)\b.*$", "", text)
    stream = BytesIO(text.encode())
    in_order = not _has_seams(text)
    return _parts(load_obj(stream, skip_materials=True, maintain_order=in_order))


def parse_stl(data: bytes) -> list[Part]:
    """Return the solids of an STL file, each triangle with vertices of its own."""
    from trimesh.exchange.stl import load_stl

    return _parts(load_stl(BytesIO(data)))


def _parts(parsed: dict[str, Any]) -> list[Part]:
    """Return the parts of trimesh's keyword arguments for one mesh or for a scene of several."""
    geometries = parsed.get("geometry", {"": parsed})
    return [part for g in geometries.values() if (part := part_of(g, np.eye(4))) is not None]


def part_of(
    geometry: dict[str, Any], transform: NDArray[np.float64], uv: Array | None = None
) -> Part | None:
    """Return the Part of trimesh's keyword arguments for one mesh, None if it has no faces."""
    faces = geometry.get("faces")
    if faces is None or len(faces) == 0:
        return None
    faces = np.asarray(faces)
    fans = [faces[:, [0, k, k + 1]] for k in range(1, faces.shape[1] - 1)]
    visual = geometry.get("visual")
    return Part(
        vertices=np.asarray(geometry["vertices"]),
        triangles=np.stack(fans, axis=1).reshape(-1, 3).astype(np.int64),
        normals=geometry.get("vertex_normals"),
        uv=uv if visual is None else visual.uv,
        transform=transform,
    )


def _check_element(name: str, element: dict[str, Any]) -> None:
    """Refuse a PLY element that is cut short, or whose lists differ in length when binary."""
    data = element.get("data")
    if element["length"] == 0:
        return
    columns = list(data.values()) if isinstance(data, dict) else [data]
    if not columns or any(c is None or len(c) != element["length"] for c in columns):
        raise ValueError(f"it ends before its {element['length']} of element {name}")
    if isinstance(data, np.ndarray):
        for field in data.dtype.names or ():
            column = data[field]
            if column.dtype.names and np.any(column["f0"] != column["f1"].shape[1]):
                raise ValueError(f"the lists of element {name} differ in length")


def _split_by_corner(part: Part, wedges: Array) -> Part:
    """Return `part` with a vertex for each uv that its corners have; wedges are (T, 6)."""
    if wedges.shape != (len(part.triangles), 6):
        return part
    vertex, uv = part.triangles.ravel(), wedges.reshape(-1, 2)
    first, corner = same(vertex, uv[:, 0], uv[:, 1])
    kept = vertex[first]
    if kept.min() < 0 or kept.max() >= len(part.vertices):
        return part  # the caller reports the index
    return Part(
        vertices=part.vertices[kept],
        triangles=corner.reshape(-1, 3),
        normals=None if part.normals is None else np.asarray(part.normals)[kept],
        uv=uv[first],
        transform=part.transform,
    )


def _plain_lines(text: str) -> str:
    """Return OBJ text without comments, continued lines, tabs and indents."""
    text = re.sub(r"\\\r?\n", " ", text).replace("\r\n", "\n").replace("\t", " ")
    text = re.sub(r"#[^\n]*", "", text)
    return re.sub(r"(?m)^ +", "", text)


def _absolute_indices(text: str) -> str:
    """Return OBJ text whose faces count from 1; a negative index counts back from its line."""
    if not re.search(r"(?m)^f [^\n]*-", text):
        return text
    so_far = {"v": 0, "vt": 0, "vn": 0}
    lines = text.split("\n")
    for i, line in enumerate(lines):
        keyword, _, rest = line.partition(" ")
        if keyword in so_far:
            so_far[keyword] += 1
        elif keyword == "f":
            lines[i] = "f " + " ".join(_absolute(word, so_far) for word in rest.split())
    return "\n".join(lines)


def _absolute(corner: str, so_far: dict[str, int]) -> str:
    fields = corner.split("/")
    for k, (field, total) in enumerate(zip(fields, so_far.values(), strict=False)):
        if field.startswith("-"):
            # Before the first one: 0, which no file may use, for the check that follows.
            fields[k] = str(max(0, total + 1 + int(field)))
    return "/".join(fields)


def _check_references(text: str) -> None:
    """Refuse OBJ faces that refer to a vertex, a uv or a normal that isn't there."""
    faces = "\n".join(re.findall(r"(?m)^f( .*)$", text))
    kinds = [("v", "vertex", r" (\d+)"), ("vt", "uv", r"\d/(\d+)"), ("vn", "normal", r"/\d*/(\d+)")]
    for keyword, noun, pattern in kinds:
        if keyword != "v" and "/" not in faces:
            return
        used = np.array(re.findall(pattern, faces), dtype=np.float64)
        there = len(re.findall(rf"(?m)^{keyword} ", text))
        wrong = used[(used < 1) | (used > there)]
        if wrong.size:
            raise IndexError(
                f"a face refers to {noun} {wrong[0]:.0f}, but there are {there}, from 1"
            )


def _has_seams(text: str) -> bool:
    """Whether a vertex of an OBJ file has several uv, or several normals beside its uv, and must be split."""
    corners = re.findall(r" ((\d+)/\d+(?:/\d+)?)", "\n".join(re.findall(r"(?m)^f( .*)$", text)))
    return len({word for word, _ in corners}) > len({vertex for _, vertex in corners})


FORMATS: dict[str, Callable[[bytes], list[Part]]] = {
    ".ply": parse_ply,
    ".obj": parse_obj,
    ".stl": parse_stl,
}
