"""STL files as programs write them: words with a space, several statements in a line, bytes behind the end."""

import struct
from pathlib import Path

import numpy as np
import pytest

from course.base.errors import CourseWarning, GeometryError
from course.engine.formats.meshes.files import read_mesh

TRIANGLES = np.array([[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]], float)


def text(space: str = "", between: str = "\n", number: str = "{}") -> str:
    words = ["solid a plate"]
    for corners in TRIANGLES.tolist():
        words += ["facet normal 0 0 1", "outer loop"]
        words += ["vertex " + " ".join(number.format(x) for x in corner) for corner in corners]
        words += [f"end{space}loop", f"end{space}facet"]
    return between.join([*words, f"end{space}solid a plate", ""])


def binary(head: bytes = b"") -> bytes:
    rows = np.zeros(2, [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["normal"], rows["corners"] = (0, 0, 1), TRIANGLES
    return head.ljust(80, b" ") + struct.pack("<I", 2) + rows.tobytes()


RIGHT = {
    "text": text().encode(),
    "words with a space": text(" ").encode(),
    "capitals and indents": text().upper().replace("\n", "\n\t  ").encode(),
    "one line": text(between=" ").encode(),
    "CR LF": text().replace("\n", "\r\n").encode(),
    "CR": text().replace("\n", "\r").encode(),
    "blank lines and comments": ("\n\n" + text().replace("\n", "\n\n# no\n")).encode(),
    "several solids": (text() + "solid empty\nendsolid empty\n").encode(),
    "no name": text().replace(" a plate", "").encode(),
    "exponents": text(number="{:e}").encode(),
    "a name of another encoding": text().replace("plate", "Pl\u00e4tte").encode("latin-1"),
    "binary": binary(),
    "binary that begins with solid": binary(b"solid as some programs write it"),
}


@pytest.mark.parametrize("content", RIGHT.values(), ids=RIGHT.keys())
def test_all_variants_have_the_same_triangles(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "plate.stl").write_bytes(content)
    mesh = read_mesh(tmp_path / "plate.stl")
    np.testing.assert_array_equal(mesh.vertices[mesh.triangles], TRIANGLES)


@pytest.mark.parametrize("head", [b"", b"solid as some programs write it"])
def test_bytes_behind_the_last_triangle_are_told(tmp_path: Path, head: bytes) -> None:
    (tmp_path / "plate.stl").write_bytes(binary(head) + b"\r\nabc")
    with pytest.warns(CourseWarning, match="5 bytes behind its last triangle are left out"):
        mesh = read_mesh(tmp_path / "plate.stl")
    np.testing.assert_array_equal(mesh.vertices[mesh.triangles], TRIANGLES)


@pytest.mark.parametrize(
    "content",
    [
        binary(b"COLOR=\xff\x00\x00\xff"),
        # The last byte of the second triangle: a colour is there.
        binary()[:-1] + b"\x80",
        text().replace("facet normal", "color 1 0 0\nfacet normal", 1).encode(),
    ],
)
def test_colours_of_a_file_are_told(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "plate.stl").write_bytes(content)
    with pytest.warns(CourseWarning, match="its colours are left out"):
        assert len(read_mesh(tmp_path / "plate.stl").triangles) == 2


WRONG = {
    "decimal commas": (
        text(number="{}").replace("1.0", "1,0").encode(),
        "line 5: '1,0' is no number; write decimals with a point",
    ),
    "a word": (
        text().replace("vertex 1.0 0.0", "vertex one 0.0").encode(),
        "line 5: 'one' is no num",
    ),
    "two numbers": (
        text().replace("vertex 1.0 0.0 0.0", "vertex 1.0 0.0").encode(),
        "line 5: 2 numb",
    ),
    "four corners": (
        text().replace("endloop", "vertex 0 0 0\nendloop").encode(),
        "line 9: a facet of 4 vertices ends: expected 3",
    ),
    "cut short": (text()[:-60].encode(), "a facet of 3 vertices|a facet of 2 vertices"),
    "another statement": (
        text().replace("outer", "inner", 1).encode(),
        "line 3: 'inner' begins no",
    ),
    "binary, cut short": (binary()[:-1], "its 2 triangles need 184: it is cut short"),
    "2 GB by its header": (
        b" " * 80 + struct.pack("<I", 42_949_672) + bytes(50),
        "its 42,949,672 triangles need 2,147,483,684",
    ),
    "a few bytes": (b"solid", "no triangles"),
}


@pytest.mark.parametrize(("content", "told"), WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_told_by_its_line(tmp_path: Path, content: bytes, told: str) -> None:
    (tmp_path / "plate.stl").write_bytes(content)
    with pytest.raises(GeometryError, match=told):
        read_mesh(tmp_path / "plate.stl")
