"""PLY files with something wrong in them are refused, with what is wrong and where; odd but right ones are read."""

import struct
from collections.abc import Sequence
from pathlib import Path

import pytest

from course import load_scene
from course.base.errors import GeometryError, SceneError
from course.engine.formats.meshes.files import read_mesh

SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
TWO = ((0, 1, 2), (0, 2, 3))
XYZ = ("float x", "float y", "float z")
CORNERS = "list uchar int vertex_indices"
ASCII, LITTLE, BIG = "ascii", "binary_little_endian", "binary_big_endian"
SIZES = {"float": "f", "double": "d", "int": "i", "uint": "I", "short": "h", "uchar": "B"}


def ply(
    order: str = ASCII,
    vertices: Sequence[Sequence[object]] = SQUARE,
    faces: Sequence[Sequence[object]] = TWO,
    *,
    properties: Sequence[str] = XYZ,
    corners: str = CORNERS,
    counts: tuple[object, object] = (None, None),
    tail: str | bytes = "",
) -> bytes:
    """A file of vertices and faces; `counts` are what the header says of them, where that isn't so."""
    of = [len(rows) if n is None else n for n, rows in zip(counts, (vertices, faces), strict=True)]
    lines = ["ply", f"format {order} 1.0", f"element vertex {of[0]}"]
    lines += [f"property {each}" for each in properties]
    lines += [f"element face {of[1]}", f"property {corners}", "end_header", ""]
    header = "\n".join(lines).encode()
    if order == ASCII:
        rows = [*vertices, *([len(face), *face] for face in faces)]
        return (
            header
            + "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()
            + tail_of(tail)
        )
    sign = "<" if order == LITTLE else ">"
    data = b"".join(struct.pack(f"{sign}{len(row)}f", *row) for row in vertices)
    index = SIZES[corners.split()[2]]
    data += b"".join(struct.pack(f"{sign}B{len(f)}{index}", len(f), *f) for f in faces)
    return header + data + tail_of(tail)


def tail_of(tail: str | bytes) -> bytes:
    return tail if isinstance(tail, bytes) else tail.encode()


def flat(points: Sequence[Sequence[object]] = SQUARE) -> list[Sequence[object]]:
    return [point[:2] for point in points]


def instead(file: bytes, old: str, new: str) -> bytes:
    assert file.count(old.encode()) == 1
    return file.replace(old.encode(), new.encode("latin-1"))


NOT_ENOUGH = "it is cut short, or a count in its header is wrong"

BAD: dict[str, tuple[bytes, str]] = {
    # Faces that are none.
    "no corners": (ply(faces=[(0, 1, 2), ()]), "line 15: face 1 has 0 corners: expected 3"),
    "two corners each": (ply(faces=[(0, 1), (0,)]), "no triangles: face 0 and 1 more have fewer"),
    "two corners each, little": (
        ply(LITTLE, faces=[(0, 1)]),
        "no triangles: face 0 has fewer than",
    ),
    "no corners, little": (ply(LITTLE, faces=[(), ()]), "read: face 0 has 0 corners"),
    "a negative count": (ply(faces=[], counts=(4, 1), tail="-3 0 1 2\n"), "face 0 has -3 corners"),
    "a negative count, little": (
        instead(ply(LITTLE), CORNERS, CORNERS.replace("uchar", "char")).replace(b"\3", b"\xfd"),
        "face 0 has -3 corners",
    ),
    # Corners that are none.
    "out of range": (ply(faces=[(0, 1, 9)]), "triangle 0 refers to vertex 9"),
    "out of range, mixed": (ply(LITTLE, faces=[(0, 1, 2), (0, 1, 2, 9)]), "refers to vertex 9"),
    "negative, mixed": (ply(BIG, faces=[(0, 1, 2), (0, 1, 2, -4)]), "refers to vertex -4"),
    "half a corner": (ply(faces=[(0, 1, 2.5)]), "line 14: corner '2.5' of face 0: expected a who"),
    "a word for a corner": (ply(faces=[(0, 1, "two")]), "line 14: corner 'two' of face 0"),
    "a word for a count": (ply(faces=[], counts=(4, 1), tail="x 1 2"), "line 14: 'x' is no count"),
    "corners of floats": (ply(corners="list uchar float vertex_indices"), "type float: expected"),
    "corners of floats, little": (
        ply(LITTLE, corners="list uchar float vertex_indices"),
        "corners of its faces are of type float: expected whole numbers",
    ),
    "no list of corners": (
        ply(vertices=SQUARE[:3], faces=[()], corners="int a"),
        "faces have no list of corners: expected property list uchar int vertex_indices",
    ),
    # Vertices that are none.
    "no z": (ply(vertices=flat(), properties=XYZ[:2]), "have no z: .* x, y and z, found x, y$"),
    "no z, little": (ply(LITTLE, flat(), properties=XYZ[:2]), "vertices have no z: expected"),
    "capitals": (ply(properties=("float X", "float Y", "float Z")), "no x, y, z: .* found X, Y, Z"),
    "a list for z": (
        ply(vertices=[(0, 0, 1, 5)] * 4, properties=(*XYZ[:2], "list uchar float z")),
        "no z: .* found x, y, a list z",
    ),
    "nothing of vertices": (ply(vertices=[()] * 4, properties=()), "vertex has no properties"),
    "nan": (ply(vertices=[(0, "nan", 0), *SQUARE[1:]]), "vertex 0 is .*nan.*: expected finite"),
    "nan, big": (
        ply(BIG, [*SQUARE[:3], (0, float("nan"), 0)]),
        "vertex 3 is .*nan.*: expected fin",
    ),
    "a word": (
        ply(vertices=[SQUARE[0], (1, "one", 0), *SQUARE[2:]]),
        "line 11: 'one' is no number",
    ),
    "an underscore": (
        ply(vertices=[SQUARE[0], ("1_0", 0, 0), *SQUARE[2:]]),
        "line 11: '1_0' is no number",
    ),
    "an underscore in a corner": (
        ply(faces=[(0, 1, 2), (0, "0_2", 3)]),
        "line 15: corner '0_2' of face 1: expected a whole number",
    ),
    "an underscore in a count": (
        ply(faces=TWO[:1], counts=(4, 2), tail="0_3 0 2 3\n"),
        "line 15: '0_3' is no count",
    ),
    # Lines.
    "too few numbers": (
        ply(vertices=[(0, 0), *SQUARE[1:]]),
        "line 10: 2 numbers for vertex 0: expected 3, x y z",
    ),
    "too many numbers": (
        ply(vertices=[*SQUARE[:3], (0, 1, 0, 7)]),
        "line 13: 4 numbers for vertex 3: expected 3, x y z",
    ),
    "a list cut off": (
        ply(faces=TWO[:1], counts=(4, 2), tail="3 0 1\n"),
        "line 15: 3 numbers for face 1: expected 4, count vertex_indices...",
    ),
    "a list too long": (
        ply(faces=TWO[:1], counts=(4, 2), tail="3 0 2 3 1\n"),
        "line 15: 5 numbers",
    ),
    "a line missing": (ply(counts=(4, 3)), f"ends before its 3 of element face: {NOT_ENOUGH}"),
    "a vertex missing": (ply(counts=(5, 2)), "line 14: 4 numbers for vertex 4: expected 3"),
    "a line too many": (ply(tail="\n1 2 3\n"), "line 17 is left over: a count in its header is wr"),
    "a face not counted": (ply(counts=(4, 1)), "line 15 is left over: a count in its header is wr"),
    "a vertex not counted": (ply(counts=(3, 2)), "line 13: face 0 has 0 corners"),
    # Lengths.
    "no data": (ply(vertices=[], faces=[], counts=(4, 2)), f"before its 4 .*vertex: {NOT_ENOUGH}"),
    "cut in the faces, little": (ply(LITTLE)[:-5], f"an unexpected length: {NOT_ENOUGH}"),
    "cut in the vertices, little": (ply(LITTLE)[:-40], f"its 4 of element vertex: {NOT_ENOUGH}"),
    "mixed and cut": (ply(BIG, faces=[TWO[0], (0, 1, 2, 3)])[:-5], f"length: {NOT_ENOUGH}"),
    # As long as two quads.
    "mixed and padded": (ply(LITTLE, faces=[(0, 1, 2, 3), (0, 1, 2)], tail=bytes(4)), "unexpected"),
    "too long": (ply(LITTLE, tail=b"more"), "its 78 bytes of data are an unexpected length"),
    "very many vertices": (
        ply(counts=(10**12, 2)),
        f"its {10**12} of element vertex: {NOT_ENOUGH}",
    ),
    "very many faces": (ply(counts=(4, 10**12)), f"its {10**12} of element face: {NOT_ENOUGH}"),
    "very many vertices, little": (ply(LITTLE, counts=(10**20, 2)), f"its {10**20} of element ver"),
    "very many faces, big": (ply(BIG, counts=(4, 10**15)), f"before its {10**15} of element face"),
    "very many faces, mixed": (
        ply(LITTLE, faces=[TWO[0], (0, 1, 2, 3)], counts=(4, 10**15)),
        f"before its {10**15} of element face",
    ),
    # Headers.
    "a negative number of them": (
        ply(counts=(-4, 2)),
        "line 3 is 'element vertex -4': expected a n",
    ),
    "half of one": (
        ply(LITTLE, counts=("4.5", 2)),
        "line 3 is 'element vertex 4.5': expected a name",
    ),
    "no number of them": (
        ply(counts=("", 2)),
        "line 3 is 'element vertex': expected a name and how",
    ),
    "an unknown type": (ply(properties=(*XYZ[:2], "quux z")), "line 6 is .*: 'quux' is no type of"),
    "an unknown type of a list": (
        ply(BIG, corners="list quux int vertex_indices"),
        "line 8 is .*: 'quux' is no type of PLY: expected such as float",
    ),
    "a list as long as a float says": (
        ply(corners="list float int vertex_indices"),
        "can't be a fl",
    ),
    "a property without a name": (
        ply(properties=(*XYZ, "float")),
        "line 7 is 'property float': exp",
    ),
    "x twice": (ply(properties=("float x", *XYZ)), "line 5 is 'property float x': expected x once"),
    "faces twice": (
        instead(ply(), "end_header", f"element face 1\nproperty {CORNERS}\nend_header"),
        "line 9 is 'element face 1': expected element face once",
    ),
    "a property of nothing": (
        instead(ply(), "element vertex", "property float w\nelement vertex"),
        "line 3 is 'property float w': expected an element before",
    ),
    "a misspelt element": (
        instead(ply(), "element face", "elment face"),
        "line 7 is 'elment face 2'",
    ),
    "an unknown format": (instead(ply(), "ascii", "text"), "line 2 is 'format t"),
    "a name that can't be shown": (
        ply(properties=(*XYZ, "int \x1b")),
        "line 7 is .*printable char",
    ),
    "no format": (
        instead(ply(), "format ascii 1.0\n", ""),
        "its format is missing: expected one of",
    ),
    "no end": (ply().split(b"end_header")[0], "its header has no line end_header"),
    "lines that end in CR": (ply().replace(b"\n", b"\r"), "no line end_header .*must end in LF"),
    "no beginning": (ply()[4:], "doesn't begin with a line that says ply"),
}


@pytest.mark.parametrize(("content", "message"), BAD.values(), ids=BAD.keys())
def test_what_is_wrong_is_told_with_the_file(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "broken.ply"
    path.write_bytes(content)
    with pytest.raises(GeometryError, match=message) as caught:
        read_mesh(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def long_header(most: int, end: str = "end_header\n") -> bytes:
    """Of so many properties more than are needed, and one vertex and face."""
    more = "".join(f"property float p{k}\n" for k in range(most))
    rows = "0 0 0" + " 0" * most + "\n3 0 0 0\n"
    header = ply().decode().partition("element face")[0].replace("vertex 4", "vertex 1")
    return f"{header}{more}element face 1\nproperty {CORNERS}\n{end}{rows}".encode()


def test_headers_longer_than_any_mesh_needs_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "long.ply"
    # Elements and properties are counted together: 2 and 4 of them beside these are the most.
    path.write_bytes(long_header(994))
    assert len(read_mesh(path).triangles) == 1
    elements = "".join(f"element e{k} 0\n" for k in range(100_000)).encode()
    for content in (
        long_header(995),
        long_header(100_000),
        ply().replace(b"element vertex", elements + b"element vertex"),
    ):
        path.write_bytes(content)
        with pytest.raises(GeometryError, match="more than 1000 elements and prop") as caught:
            read_mesh(path)
        assert len(str(caught.value)) < len(str(path)) + 300
    path.write_bytes(long_header(0, "comment more\n" * 1_300_000 + "end_header\n"))
    with pytest.raises(GeometryError, match="no line end_header in the first 16 MB"):
        read_mesh(path)


def test_a_scene_says_where_it_names_the_file(tmp_path: Path) -> None:
    (tmp_path / "broken.ply").write_bytes(ply(faces=[(0, 1, 2), ()]))
    text = (
        "camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}\n"
        "materials: {grey: {}}\n"
        "objects:\n"
        "  - {shape: mesh, file: broken.ply, material: grey}\n"
    )
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(SceneError, match=r"scene.yaml:4: objects\[0\]: .*broken.ply: .*face 1 has"):
        load_scene(tmp_path / "scene.yaml")


GOOD: dict[str, bytes] = {
    "text": ply(),
    "little": ply(LITTLE),
    "big": ply(BIG),
    "CR LF": ply().replace(b"\n", b"\r\n"),
    "CR LF before little": ply(LITTLE).replace(b"\n", b"\r\n", 9),
    "no end of the last line": ply().rstrip(),
    "empty lines": ply(tail="\n \n").replace(b"3 0 2 3", b"\n\n3 0 2 3"),
    "spaces and tabs": ply().replace(b"3 0 2 3", b" 3\t0  2 3 "),
    "a comment": instead(ply(), "element vertex", "comment element face 7\nelement vertex"),
    "a comment in Latin-1": instead(ply(), "element vertex", "comment caf\xe9\nelement vertex"),
    "a comment among the properties": instead(
        ply(LITTLE), "property float y", "comment why\nobj_info\nproperty float y"
    ),
    "another name of the list": ply(corners="list uchar int vertices"),
    "another name of the list, big": ply(BIG, corners="list uchar int vertices"),
    "unsigned corners": ply(LITTLE, corners="list uchar uint vertex_index"),
    "corners with points": ply(faces=[(0, "1.0", 2), (0, "2.", "3e0")]),
    "nothing of another kind": instead(
        ply(), "element vertex", "element camera 0\nproperty float q\nelement vertex"
    ),
    "more of vertices and of faces": instead(
        instead(ply(), f"property {CORNERS}", f"property {CORNERS}\nproperty float quality"),
        "3 0 1 2\n3 0 2 3",
        "3 0 1 2 0.5\n3 0 2 3 nan",
    ),
}


@pytest.mark.parametrize("content", GOOD.values(), ids=GOOD.keys())
def test_what_is_odd_but_right_is_read(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "odd.ply"
    path.write_bytes(content)
    mesh = read_mesh(path)
    assert mesh.vertices.tolist() == [list(point) for point in SQUARE]
    assert mesh.triangles.tolist() == [list(face) for face in TWO]


def test_comments_hide_no_polygons(tmp_path: Path) -> None:
    """Where faces begin is worked out from the properties, though comments stand between them."""
    faces = [(0, 1, 2, 3), (0, 1, 2)]
    content = ply(LITTLE, faces=faces)
    for name in ("float y", "list"):
        content = instead(content, f"property {name}", f"comment {name}\nproperty {name}")
    (tmp_path / "mixed.ply").write_bytes(content)
    mesh = read_mesh(tmp_path / "mixed.ply")
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2]]
