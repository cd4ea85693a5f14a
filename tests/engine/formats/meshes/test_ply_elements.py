"""PLY files of few elements, several lists, and elements that no mesh needs: the same in text and both binaries."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.base.errors import CourseWarning, GeometryError
from course.engine.formats.meshes.files import read_mesh, read_named_mesh
from course.engine.shapes.mesh import Mesh

ORDERS = ("ascii", "binary_little_endian", "binary_big_endian")
CODES = {
    "char": "b",
    "uchar": "B",
    "short": "h",
    "ushort": "H",
    "int": "i",
    "uint": "I",
    "float": "f",
}

SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
XYZ = ("float x", "float y", "float z")
CORNERS = "list uchar int vertex_indices"
UV = "list uchar float texcoord"
JUNK = "list ushort float junk"
TRIANGLE, OTHER, QUAD = (0, 1, 2), (0, 2, 3), (0, 1, 2, 3)
UV3, UV4 = (0, 0, 1, 0, 1, 1), (0, 0, 1, 0, 1, 1, 0, 1)
UV3B = (0.5, 0, 1, 1, 0, 1)


@dataclass(frozen=True)
class Element:
    """Rows of one kind; a property that is a list has a tuple in each row."""

    name: str
    properties: Sequence[str]
    rows: Sequence[Sequence[Any]]


VERTICES = Element("vertex", XYZ, SQUARE)
EDGE = ("int vertex1", "int vertex2")


def faces(properties: Sequence[str], *rows: Sequence[Any]) -> Element:
    return Element("face", properties, rows)


def with_more(*more: str, values: Sequence[Sequence[Any]]) -> Element:
    """The vertices of the square with more properties."""
    rows = [(*point, *value) for point, value in zip(SQUARE, values, strict=True)]
    return Element("vertex", (*XYZ, *more), rows)


def ply(order: str, *elements: Element) -> bytes:
    lines = ["ply", f"format {order} 1.0"]
    for element in elements:
        lines.append(f"element {element.name} {len(element.rows)}")
        lines += [f"property {each}" for each in element.properties]
    header = "\n".join([*lines, "end_header", ""]).encode()
    data = b""
    for element in elements:
        for row in element.rows:
            texts: list[str] = []
            for each, value in zip(element.properties, row, strict=True):
                *counted, kind, _ = each.removeprefix("list ").split()
                values = value if counted else (value,)
                codes = [*(CODES[count] for count in counted), *(CODES[kind] for _ in values)]
                numbers = [*(len(values) for _ in counted), *values]
                texts += map(str, numbers)
                if order != "ascii":
                    data += struct.pack(
                        ("<" if "little" in order else ">") + "".join(codes), *numbers
                    )
            if order == "ascii":
                data += " ".join(texts).encode() + b"\n"
    return header + data


def read(folder: Path, order: str, *elements: Element) -> Mesh:
    path = folder / "mesh.ply"
    path.write_bytes(ply(order, *elements))
    return read_mesh(path)


def uv_of(mesh: Mesh) -> list[list[float]] | None:
    """The uv of each triangle's corners."""
    return None if mesh.uv is None else mesh.uv[mesh.triangles].reshape(-1, 6).tolist()


FANNED = [[0, 0, 1, 0, 1, 1], [0, 0, 1, 1, 0, 1]]
"""The corners of QUAD, cut into two, and as well their uv in UV4."""

ONE, TWO = FANNED[:1], [FANNED[0], [0.5, 0, 1, 1, 0, 1]]
NONE = [[0, 0, 0, 0, 0, 0]]

Case = tuple[tuple[Element, ...], list[list[int]], list[Any] | None]

READ: dict[str, Case] = {
    "one face": ((VERTICES, faces([CORNERS], [TRIANGLE])), ONE, None),
    "one quad": ((VERTICES, faces([CORNERS], [QUAD])), FANNED, None),
    "one face with uv": ((VERTICES, faces([CORNERS, UV], [TRIANGLE, UV3])), ONE, ONE),
    "uv first": ((VERTICES, faces([UV, CORNERS], [UV3, TRIANGLE])), ONE, ONE),
    "one quad with uv": ((VERTICES, faces([CORNERS, UV], [QUAD, UV4])), FANNED, FANNED),
    "uv and more": (
        (VERTICES, faces([CORNERS, UV, "int texnumber"], [TRIANGLE, UV3, 7])),
        ONE,
        ONE,
    ),
    "one face whose uv are none": ((VERTICES, faces([CORNERS, UV], [TRIANGLE, ()])), ONE, None),
    "two with uv": ((VERTICES, faces([CORNERS, UV], [TRIANGLE, UV3], [OTHER, UV3B])), FANNED, TWO),
    "one of two has uv": (
        (VERTICES, faces([CORNERS, UV], [TRIANGLE, UV3], [OTHER, ()])),
        FANNED,
        ONE + NONE,
    ),
    "a quad and a triangle with uv": (
        (VERTICES, faces([CORNERS, UV], [QUAD, UV4], [OTHER, UV3B])),
        [*FANNED, FANNED[1]],
        [*FANNED, TWO[1]],
    ),
    "polygons of three lengths among more": (
        (
            VERTICES,
            faces(
                ["uchar flag", CORNERS, "short mark"],
                [7, TRIANGLE, 8],
                [7, QUAD, 8],
                [7, (*QUAD[:3], *QUAD[2:]), 8],
            ),
        ),
        [FANNED[0], *FANNED, FANNED[0], [0, 0, 1, 1, 1, 1], FANNED[1]],
        None,
    ),
    "one face with another list": ((VERTICES, faces([CORNERS, JUNK], [TRIANGLE, (5,)])), ONE, None),
    "another list before": ((VERTICES, faces([JUNK, CORNERS], [(5, 6), TRIANGLE])), ONE, None),
    "lists of other lengths": (
        (VERTICES, faces([CORNERS, JUNK], [TRIANGLE, (5, 6)], [OTHER, ()])),
        FANNED,
        None,
    ),
    "one edge": (
        (VERTICES, faces([CORNERS], [TRIANGLE]), Element("edge", EDGE, [(0, 1)])),
        ONE,
        None,
    ),
    "edges between": (
        (VERTICES, Element("edge", EDGE, [(0, 1), (2, 9)]), faces([CORNERS], [TRIANGLE])),
        ONE,
        None,
    ),
    "an edge of one number": (
        (VERTICES, faces([CORNERS], [TRIANGLE]), Element("edge", EDGE[:1], [(0,)])),
        ONE,
        None,
    ),
    "edges in colour": (
        (
            VERTICES,
            faces([CORNERS], [TRIANGLE]),
            Element("edge", (*EDGE, "uchar red"), [(0, 1, 255)]),
        ),
        ONE,
        None,
    ),
    "lists of another element first": (
        (
            Element("material", [JUNK, "uchar number"], [((1, 2), 3), ((), 4), ((5,), 6)]),
            VERTICES,
            faces([CORNERS], [TRIANGLE]),
        ),
        ONE,
        None,
    ),
    "faces first": ((faces([CORNERS], [TRIANGLE]), VERTICES), ONE, None),
    "lists of vertices": (
        (
            with_more(
                JUNK, "float s", "float t", values=[((1,) * k, *SQUARE[k][:2]) for k in range(4)]
            ),
            faces([CORNERS], [TRIANGLE]),
        ),
        ONE,
        ONE,
    ),
    **{
        f"uv called {u}": (
            (
                with_more(f"float {u}", f"float {v}", values=[point[:2] for point in SQUARE]),
                faces([CORNERS], [QUAD]),
            ),
            FANNED,
            FANNED,
        )
        for u, v in (
            *(("texture_u", "texture_v"), ("texture_s", "texture_t"), ("tu", "tv")),
            *(("texcoord_u", "texcoord_v"), ("u0", "v0"), ("s0", "t0")),
        )
    },
    "uv of vertices beside empty ones of faces": (
        (
            with_more("float u", "float v", values=[point[:2] for point in SQUARE]),
            faces([CORNERS, UV], [QUAD, ()]),
        ),
        FANNED,
        FANNED,
    ),
}


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize(("elements", "corners", "uv"), READ.values(), ids=READ.keys())
def test_what_a_mesh_needs_is_read(
    tmp_path: Path, order: str, elements: tuple[Element, ...], corners: Any, uv: Any
) -> None:
    mesh = read(tmp_path, order, *elements)
    assert mesh.vertices[mesh.triangles][:, :, :2].reshape(-1, 6).tolist() == corners
    assert uv_of(mesh) == uv


SHORT: dict[str, tuple[tuple[Element, ...], list[list[int]], list[Any] | None, str]] = {
    "two corners, with uv": (
        (VERTICES, faces([CORNERS, UV], [TRIANGLE, UV3], [(0, 1), UV3[:4]], [OTHER, UV3B])),
        FANNED,
        TWO,
        "face 1 has fewer than 3 corners, and so no surface: left out",
    ),
    "one and two": (
        (VERTICES, faces([CORNERS], [(3,)], [QUAD], [(0, 1)])),
        FANNED,
        None,
        "face 0 and 1 more have fewer than 3 corners",
    ),
    "before one that is there twice": (
        (VERTICES, faces([CORNERS, UV], [(0, 1), ()], [TRIANGLE, UV3], [TRIANGLE[::-1], UV3])),
        ONE,
        ONE,
        "face 0 has fewer than 3 corners",
    ),
}


@pytest.mark.filterwarnings("ignore:.*seen from behind:course.base.errors.CourseWarning")
@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize(("elements", "expected", "uv", "told"), SHORT.values(), ids=SHORT.keys())
def test_faces_without_a_surface_are_left_out_and_told(
    tmp_path: Path,
    order: str,
    elements: tuple[Element, ...],
    expected: list[list[int]],
    uv: list[Any] | None,
    told: str,
) -> None:
    with pytest.warns(CourseWarning, match=told):
        mesh = read(tmp_path, order, *elements)
    assert mesh.vertices[mesh.triangles][..., :2].reshape(-1, 6).tolist() == expected
    assert uv_of(mesh) == uv


@pytest.mark.parametrize("order", ORDERS)
def test_one_vertex_is_a_mesh(tmp_path: Path, order: str) -> None:
    mesh = read(tmp_path, order, Element("vertex", XYZ, [(1, 2, 3)]), faces([CORNERS], [(0, 0, 0)]))
    assert mesh.vertices.tolist() == [[1, 2, 3]]
    assert mesh.triangles.tolist() == [[0, 0, 0]]


REFUSED: dict[str, tuple[tuple[Element, ...], str, str]] = {
    "uv of five": (
        (VERTICES, faces([CORNERS, UV], [TRIANGLE, UV3[:5]])),
        "line 15: ",
        "texcoord of face 0 has 5 numbers: expected 6, u and v for each of its 3 corners, or 0",
    ),
    "uv of a triangle for a quad": (
        (VERTICES, faces([UV, CORNERS], [UV3, TRIANGLE], [UV3, QUAD])),
        "line 16: ",
        "texcoord of face 1 has 6 numbers: expected 8, u and v for each of its 4 corners",
    ),
    "no faces": ((VERTICES, faces([CORNERS])), "", "no triangles"),
    "no faces with uv": ((VERTICES, faces([CORNERS, UV])), "", "no triangles"),
    "no element of faces": ((VERTICES,), "", "no triangles"),
    "nothing but edges": ((VERTICES, Element("edge", EDGE, [(0, 1)])), "", "no triangles"),
    "strips": (
        (VERTICES, Element("tristrips", ["list int int vertex_indices"], [(QUAD,)])),
        "",
        "its triangles are strips .*: write it anew with faces",
    ),
    "no vertices": (
        (Element("vertex", XYZ, []), faces([CORNERS], [TRIANGLE])),
        "",
        "triangle 0 refers to vertex 0: out of range, there are 0",
    ),
    "one property": (
        (Element("vertex", XYZ[:1], [(0,)]), faces([CORNERS], [TRIANGLE])),
        "",
        "no y, z: expected properties x, y and z, found x",
    ),
}


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize(("elements", "line", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_what_is_none_is_told(
    tmp_path: Path, order: str, elements: tuple[Element, ...], line: str, message: str
) -> None:
    with pytest.raises(GeometryError, match=(line if order == "ascii" else "") + message):
        read(tmp_path, order, *elements)


@pytest.mark.parametrize("order", ORDERS[1:])
def test_a_list_of_less_than_nothing_is_told(tmp_path: Path, order: str) -> None:
    element = faces([CORNERS, "list char float junk"], [TRIANGLE, (5,)])
    content = ply(order, VERTICES, element)
    assert content.count(b"\x01" + struct.pack("<f" if "little" in order else ">f", 5)) == 1
    path = tmp_path / "mesh.ply"
    path.write_bytes(content[:-5] + b"\xff" + content[-4:])
    with pytest.raises(GeometryError, match="list junk of face 0 has -1 numbers: expected 0"):
        read_mesh(path)


@pytest.mark.parametrize("order", ORDERS)
def test_text_says_no_more_than_its_types(tmp_path: Path, order: str) -> None:
    """A float is one in text too: the same file in another order is the same mesh."""
    mesh = read(
        tmp_path,
        order,
        Element("vertex", XYZ, [(0.1, 0, 0), *SQUARE[1:]]),
        faces([CORNERS], [QUAD]),
    )
    assert mesh.vertices[0, 0] == float(np.float32(0.1))


@pytest.mark.parametrize("order", ORDERS)
def test_which_triangles_have_no_uv_beside_others(tmp_path: Path, order: str) -> None:
    rows = faces([CORNERS, UV], [QUAD, UV4], [QUAD, ()], [TRIANGLE, UV3])
    (tmp_path / "mesh.ply").write_bytes(ply(order, VERTICES, rows))
    bare = read_named_mesh(tmp_path / "mesh.ply").bare
    assert bare is not None
    assert bare.tolist() == [False, False, True, True, False]
