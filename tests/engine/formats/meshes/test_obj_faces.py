"""Faces of OBJ files: what each corner refers to is what is read, and what is wrong is told with its line."""

from pathlib import Path

import numpy as np
import pytest

from course.base.errors import CourseWarning, GeometryError
from course.engine.formats.meshes.files import read_mesh, read_named_mesh
from course.engine.shapes.mesh import Mesh

V = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
VT = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
VN = "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\n"
"""Five lines, four and three: faces begin in line 6, 10 or 13."""


def read(folder: Path, text: str) -> Mesh:
    path = folder / "mesh.obj"
    path.write_bytes(text.encode())
    return read_mesh(path)


def places(mesh: Mesh) -> list[list[int]]:
    """Which row of V stands at each corner of each triangle, from 1."""
    rows = [line.split()[1:] for line in V.splitlines()]
    numbers = {tuple(map(float, row)): k for k, row in enumerate(rows, start=1)}
    return [
        [numbers[tuple(p)] for p in triangle] for triangle in mesh.vertices[mesh.triangles].tolist()
    ]


NO_SURFACE = "has fewer than 3 corners, and so no surface: left out"
NO_CORNER = "is no corner of a face: expected whole numbers, as in 1, 1/2, 1//3 or 1/2/3"

REFUSED: dict[str, tuple[str, str]] = {
    # No surface, and what would be none if it were a face.
    "two corners": (V + "f 1 2\n", f"no triangles: line 6: a face {NO_SURFACE}"),
    "two corners, two times": (
        V + "f 1 2\nf 1 3\n",
        "no triangles: line 6: a face and 1 more have",
    ),
    "two corners of nothing": (V + "f 1 2 3\nf 1 9\n", "line 7: a face refers to vertex 9"),
    "two corners that differ": (V + VT + "f 1 2 3\nf 1/1 3\n", "line 11: 1 of the 2 corners of a"),
    "no corner": (V + "f 1 2 3\nf\n", "line 7: a face has 0 corners: expected 3 or more"),
    "no corner at all": (V + "f\n", "line 6: a face has 0 corners: expected 3 or more"),
    # Out of range.
    "beyond the last": (
        V + "f 1 2 3\nf 1 2 6\n",
        "line 7: a face refers to vertex 6, but there are 5, from 1 to 5: correct the number, or",
    ),
    "nought": (
        V + "f 1 2 0\n",
        "line 6: a face refers to vertex 0, but they count from 1, or back",
    ),
    "before the first": (
        V + "f -1 -2 -6\n",
        "line 6: a face refers to vertex -6, but before it there are 5, from -1 back to -5",
    ),
    "before its own": (
        "v 0 0 0\nf -1 -2 -3\n" + V,
        "line 2: a face refers to vertex -2, but before it there are 1",
    ),
    "uv": (V + VT + "f 1/1 2/2 3/5\n", "line 10: a face refers to uv 5, but there are 4"),
    "no uv": (V + "f 1/1 2/1 3/1\n", "line 6: .* uv 1, but there are 0, so that no face may have"),
    "uv back": (V + "vt 0 0\nf 1/-1 2/-2 3/-1\n", "line 7: .* uv -2, but before it there are 1"),
    "normal": (V + VN + "f 1//1 2//2 3//4\n", "line 9: a face refers to normal 4, but there are 3"),
    "normal beside uv": (V + VT + VN + "f 1/1/1 2/2/2 3/3/9\n", "line 13: .* normal 9"),
    "huge": (V + "f 1 2 99999999999999999999\n", "line 6: a face refers to vertex 1e"),
    "very huge": (V + f"f 1 -1 {'9' * 400}\n", "line 6: a face refers to vertex 1e"),
    "in a comment's line": (V + "# f 1 2\nf 1 2 7 # seven\n", "line 7: .* vertex 7"),
    "after a line that goes on": (V + "f 1 2 \\\n 3\nf 1 2 7\n", "line 8: .* vertex 7"),
    # No numbers.
    "a word": (V + "f 1 2 3\nf 1 2 x\n", f"line 7: 'x' {NO_CORNER}"),
    "half a number": (V + "f 1.5 2 3\n", "line 6: '1.5' is no corner"),
    "an underscore": (V + "f 1 2 0_3\n", "line 6: '0_3' is no corner"),
    "digits of another script": (V + "f 1 2 \u0663\n", "line 6: '\u0663' is no corner"),
    "commas": (V + "f 1,2,3\n", "line 6: '1,2,3' is no corner"),
    "four fields": (V + "f 1/1/1/1 2/2/2/2 3/3/3/3\n", "line 6: '1/1/1/1' is no corner"),
    "no vertex": (V + VT + "f /1 /2 /3\n", "line 10: '/1' is no corner"),
    # Corners of one face that differ.
    "uv at two of three": (
        V + VT + "f 1/1 2/2 3\n",
        "line 10: 2 of the 3 corners of a face have a uv: expected all of them, or none",
    ),
    "a normal at one of three": (V + VN + "f 1//1 2 3\n", "line 9: 1 of the 3 corners .* a normal"),
    # Rows.
    "a vertex of two": (
        "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n",
        "line 2: 2 numbers after v: expected 3",
    ),
    "two and four": ("v 0 0\nv 1 0 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: 2 numbers after v"),
    "one too many and one too few": (
        "v 0 0 0\nv 1 0 0 1\nv 0 1\nf 1 2 3\n",
        "line 3: 2 numbers after v",
    ),
    "a normal of two": (V + "vn 0 1\nf 1//1 2//1 3//1\n", "line 6: 2 numbers after vn: expected 3"),
    "a word in a vertex": (
        "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n",
        "line 2: 'zero' is no number",
    ),
    "an underscore in a vertex": (
        "v 0 0 0\nv 1_0 0 0\nv 0 1 0\nf 1 2 3\n",
        "line 2: '1_0' is no number",
    ),
    "an infinity of old": ("v 0 0 0\nv 1 0 1.#INF\nv 0 1 0\nf 1 2 3\n", "line 2: '1.#INF' is no"),
    "no number": (
        "# a\nv 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n",
        "line 4: v 0 1 nan: expected finite",
    ),
    "uv of no number": (
        V + "vt 0 0\nvt 0 inf\nf 1/1 2/1 3/2\n",
        "line 7: vt 0 inf: expected finite numbers",
    ),
    "nothing after vt": (V + "vt\nf 1 2 3\n", "line 6: 0 numbers after vt: expected 2, u v"),
}


@pytest.mark.parametrize(("text", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_what_is_wrong_is_told_with_its_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(GeometryError, match=message) as caught:
        read(tmp_path, text)
    assert str(caught.value).startswith(f"{tmp_path / 'mesh.obj'}: ")
    assert "\n" not in str(caught.value)


READ: dict[str, tuple[str, list[list[int]]]] = {
    "plain": (V + "f 1 2 3\n", [[1, 2, 3]]),
    "back": (V + "f -5 -4 -3\n", [[1, 2, 3]]),
    "back and forth": (V + "f 1 -4 3\n", [[1, 2, 3]]),
    "back, with fields": (V + VT + VN + "f -5/-4/-3 -4/-3/-2 -3/-2/-1\n", [[1, 2, 3]]),
    "before the vertices": ("f 1 2 3\n" + V, [[1, 2, 3]]),
    "v/": (V + "f 1/ 2/ 3/\n", [[1, 2, 3]]),
    "v//": (V + "f 1// 2// 3//\n", [[1, 2, 3]]),
    "v/vt/": (V + VT + "f 1/1/ 2/2/ 3/3/\n", [[1, 2, 3]]),
    "a sign": (V + "f +1 2 3\n", [[1, 2, 3]]),
    "comments": ("# f 1 2 5\n" + V + "  # f 1 2 4\nf 1 2 3 # 4\n#f 1 2 4", [[1, 2, 3]]),
    "a quad": (V + "f 1 2 3 4\n", [[1, 2, 3], [1, 3, 4]]),
    "six corners after three with uv": (
        V + VT + "f 1/1 2/2 3/3\nf 1 2 2 3 4 4\n",
        [[1, 2, 3], [1, 2, 2], [1, 2, 3], [1, 3, 4], [1, 4, 4]],
    ),
    "a line that goes on": (V + "f 1 2 \\\n3\n", [[1, 2, 3]]),
    "CR LF": ((V + "f 1 2 3\n").replace("\n", "\r\n"), [[1, 2, 3]]),
    "CR": ((V + "f 1 2 3\n").replace("\n", "\r"), [[1, 2, 3]]),
    "a weight of one": (V.replace("v 1 1 0", "v 1 1 0 1") + "f 1 2 3\n", [[1, 2, 3]]),
    "two spaces behind v": (V.replace("v 1 1 0", "v  1 1 0") + "f 1 2 3\n", [[1, 2, 3]]),
    "a space that isn't seen": (V.replace("v 1 1 0", "v\u00a01 1 0") + "f 1 2 3\n", [[1, 2, 3]]),
    "a mark in the middle": (V.replace("v 1 1 0", "\ufeffv 1 1 0") + "f 1 2 3\n", [[1, 2, 3]]),
    "faces as before 3.0": (V + "fo 1 2 3\n", [[1, 2, 3]]),
    "no end of the last line": (V + "f 1 2 3", [[1, 2, 3]]),
}


SHORT: dict[str, tuple[str, list[list[int]], str]] = {
    "two corners": (V + "f 1 2 3\nf 1 2\n", [[1, 2, 3]], f"line 7: a face {NO_SURFACE}"),
    "one corner": (V + "f 4\nf 1 2 3\n", [[1, 2, 3]], f"line 6: a face {NO_SURFACE}"),
    "among quads": (
        V + "f 1 2 3 4\nf 5 2\nf 1\nf 2 3 5\n",
        [[1, 2, 3], [1, 3, 4], [2, 3, 5]],
        "line 7: a face and 1 more have fewer than 3 corners, and so no surface: left out",
    ),
    "before one that is there twice": (
        V + "f 1 5\nf 1 2 3\nf 3 2 1\nf 2 3 4\n",
        [[1, 2, 3], [4, 3, 2]],
        f"line 6: a face {NO_SURFACE}",
    ),
    "at no place": (
        V + "v nan 0 0\nf 1 2 3\nf 1 6\n",
        [[1, 2, 3]],
        f"line 8: a face {NO_SURFACE}",
    ),
}


@pytest.mark.filterwarnings("ignore:.*seen from behind:course.base.errors.CourseWarning")
@pytest.mark.parametrize(("text", "expected", "message"), SHORT.values(), ids=SHORT.keys())
def test_faces_without_a_surface_are_left_out_and_told(
    tmp_path: Path, text: str, expected: list[list[int]], message: str
) -> None:
    """Modellers leave edges between the faces: each thirtieth of some 160 pieces of furniture has them."""
    with pytest.warns(CourseWarning, match=message):
        found = places(read(tmp_path, text))
    assert found == expected


def test_what_faces_have_stays_theirs_behind_one_without_a_surface(tmp_path: Path) -> None:
    path = tmp_path / "mesh.obj"
    lines = (
        "f 1/1 2/2",
        "usemtl tin",
        "s 1",
        "f 1/1 2/2 3/3",
        "usemtl oak",
        "s off",
        "f 1/1 3/3 4/2",
    )
    path.write_text(V + VT + "usemtl wood\n" + "\n".join(lines) + "\n")
    with pytest.warns(CourseWarning, match="line 11: a face has fewer"):
        named = read_named_mesh(path)
    assert [named.names[k] for k in named.name] == ["tin", "oak"]
    assert named.mesh.uv is not None
    assert named.mesh.uv[named.mesh.triangles[1]].tolist() == [[0, 0], [1, 1], [1, 0]]


@pytest.mark.parametrize(("text", "expected"), READ.values(), ids=READ.keys())
def test_faces_are_read_as_they_are_written(
    tmp_path: Path, text: str, expected: list[list[int]]
) -> None:
    assert places(read(tmp_path, text)) == expected


def test_each_corner_has_the_uv_it_refers_to(tmp_path: Path) -> None:
    mesh = read(tmp_path, V + VT + "f 1/3 2/1 3/2 4/4\nf 1/3 2/2 5/1\n")
    assert mesh.uv is not None
    found = mesh.uv[mesh.triangles].tolist()
    assert found == [[[1, 1], [0, 0], [1, 0]], [[1, 1], [1, 0], [0, 1]], [[1, 1], [1, 0], [0, 0]]]
    # The second vertex alone has two.
    assert len(mesh.vertices) == 6


def test_uv_are_not_taken_for_normals(tmp_path: Path) -> None:
    """Without their digits these faces look alike, and they have as many numbers."""
    mesh = read(tmp_path, V + VT + VN + "f 1//3 2//3 3//3\nf 1/2/ 3/3/ 4/4/\n")
    assert mesh.uv is not None
    assert mesh.normals is not None
    assert mesh.uv[mesh.triangles[1]].tolist() == [[1, 0], [1, 1], [0, 1]]
    assert mesh.normals[mesh.triangles].tolist() == [[[1, 0, 0]] * 3, [[0, 0, 1]] * 3]


@pytest.mark.filterwarnings("ignore::course.base.errors.CourseWarning")
@pytest.mark.parametrize("form", ["{}//{}", "{}/1/{}"])
@pytest.mark.parametrize("corners", [(1, 2, 3), (1, 2, 3, 4)])
def test_faces_that_meet_keep_their_own_normals(
    tmp_path: Path, corners: tuple[int, ...], form: str
) -> None:
    """As of a box with hard edges, whose corners have three normals each."""
    wanted = [(corners, 1), ((1, 2, 5), 2), ((1, 4, 5), 3)]
    lines = ["f " + " ".join(form.format(v, vn) for v in face) for face, vn in wanted]
    mesh = read(tmp_path, V + VT + VN + "\n".join(lines) + "\n")
    rows = np.array([line.split()[1:] for line in VN.splitlines()], float)
    expected = [rows[vn - 1] for face, vn in wanted for _ in face[2:]]
    assert mesh.normals is not None
    np.testing.assert_array_equal(
        mesh.normals[mesh.triangles], np.repeat(expected, 3, 0).reshape(-1, 3, 3)
    )


def test_faces_without_uv_or_normals_stand_beside_others(tmp_path: Path) -> None:
    """(0, 0) for the uv, and a normal of the face itself, which lies in z = 0."""
    mesh = read(tmp_path, V + VT + VN + "f 1/1/2 2/2/2 3/3/2\nf 1 3 4\n")
    assert mesh.uv is not None
    assert mesh.normals is not None
    assert mesh.uv[mesh.triangles].tolist() == [[[0, 0], [1, 0], [1, 1]], [[0, 0], [0, 0], [0, 0]]]
    assert mesh.normals[mesh.triangles[0]].tolist() == [[0, 1, 0]] * 3
    assert mesh.normals[mesh.triangles[1]].tolist() == [[0, 0, 1]] * 3
