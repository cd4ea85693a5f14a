"""Smoothing groups, materials, both sides and the rest that an OBJ file may say of its faces."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from course.base.errors import CourseWarning, GeometryError
from course.engine.formats.meshes.files import read_mesh, read_named_mesh
from course.engine.shapes.mesh import Mesh

CORNERS = "".join(f"v {x} {y} {z}\n" for x in (0, 3) for y in (0, 3) for z in (-3, 0))
FACES = ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")
"""Of a cube, wound so that they look outwards."""
MIDDLE = np.array([1.5, 1.5, -1.5])


def read(folder: Path, text: str) -> Mesh:
    (folder / "cube.obj").write_text(text, encoding="utf-8")
    return read_mesh(folder / "cube.obj")


def cube(before: Sequence[str]) -> str:
    """The cube with something before each of its faces."""
    return CORNERS + "".join(f"{s}f {f}\n" for s, f in zip(before, FACES, strict=True))


def normals_at_corners(mesh: Mesh) -> np.ndarray:
    """(T, 3, 3), the triangles' own ones where it is flat."""
    p = mesh.vertices[mesh.triangles]
    own = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    given = np.repeat(own[:, None], 3, axis=1)
    return given if mesh.normals is None else mesh.normals[mesh.triangles]


def axis_of(mesh: Mesh) -> np.ndarray:
    """The outward normals of the cube's sides, of each triangle (T, 3)."""
    away = mesh.vertices[mesh.triangles].mean(axis=1) - MIDDLE
    along = np.abs(away).argmax(axis=1)
    return np.asarray(np.eye(3)[along] * np.sign(away[np.arange(len(away)), along])[:, None])


@pytest.mark.parametrize(
    "before",
    [
        ["s off\n", *[""] * 5],
        ["s 0\n", *[""] * 5],
        [f"s {k}\n" for k in range(1, 7)],
        # Off until it is switched on; the last face alone is in a group.
        [*[""] * 5, "s 1\n"],
    ],
)
def test_edges_between_smoothing_groups_are_sharp(tmp_path: Path, before: list[str]) -> None:
    mesh = read(tmp_path, cube(before))
    expected = np.repeat(axis_of(mesh)[:, None], 3, axis=1)
    np.testing.assert_allclose(normals_at_corners(mesh), expected, atol=1e-15)


@pytest.mark.parametrize("word", ["s 1\n", "s on\n", "s 4294967295\n", ""])
def test_within_a_group_all_is_smooth(tmp_path: Path, word: str) -> None:
    mesh = read(tmp_path, cube([word, *[""] * 5]))
    away = mesh.vertices[mesh.triangles] - MIDDLE
    expected = away / np.linalg.norm(away, axis=2, keepdims=True)
    np.testing.assert_allclose(normals_at_corners(mesh), expected, atol=1e-15)


def test_two_groups_meet_in_an_edge(tmp_path: Path) -> None:
    """Sides x = 0, x = 3 and y = 0 in one group: at a corner of the first and the last, two normals' mean."""
    mesh = read(tmp_path, cube(["s 1\n", "", "", "s 2\n", "", ""]))
    sides = axis_of(mesh)
    first = np.flatnonzero(sides[:, 0] == -1)[0]
    places = mesh.vertices[mesh.triangles[first]]
    found = normals_at_corners(mesh)[first]
    for place, normal in zip(places, found, strict=True):
        # Below, the side y = 0 shares the group; above, no other of the group meets it.
        expected = np.array([-1, -1, 0]) / np.sqrt(2) if place[1] == 0 else np.array([-1, 0, 0])
        np.testing.assert_allclose(normal, expected, atol=1e-15)


def test_a_seam_of_uv_within_a_group_parts_no_normals(tmp_path: Path) -> None:
    faces = ("1/1 2/1 4/1 3/1", "1/2 5/2 6/2 2/2")
    text = CORNERS + "vt 0 0\nvt 1 1\ns 1\n" + "".join(f"f {face}\n" for face in faces)
    mesh = read(tmp_path, text)
    at = np.flatnonzero((mesh.vertices[:, :2] == 0).all(axis=1))
    assert len(at) == 4
    assert mesh.normals is not None
    np.testing.assert_allclose(mesh.normals[at], [[-(0.5**0.5), -(0.5**0.5), 0]] * 4, atol=1e-15)


def test_a_files_normals_count_whatever_its_groups(tmp_path: Path) -> None:
    mesh = read(tmp_path, CORNERS + "vn 0.6 0.8 0\ns off\nf 6//1 5//1 1//1\n")
    assert mesh.normals is not None
    np.testing.assert_allclose(mesh.normals, [[0.6, 0.8, 0]] * 3)


def test_an_s_of_no_number_is_refused_by_line(tmp_path: Path) -> None:
    with pytest.raises(GeometryError, match="line 9: s 'smooth': expected a number, or off"):
        read(tmp_path, CORNERS + "s smooth\nf 1 2 3\n")


def turned(face: str) -> str:
    return " ".join(face.split()[::-1])


@pytest.mark.parametrize("order", ["pairs", "fronts first", "mixed", "other corners first"])
def test_faces_from_both_sides_are_one(tmp_path: Path, order: str) -> None:
    """The cube is as smooth and as large as with its faces once, and normals agree, be they out or in."""
    fronts, backs = list(FACES), [turned(face) for face in FACES]
    listed = {
        "pairs": [face for pair in zip(fronts, backs, strict=True) for face in pair],
        "fronts first": fronts + backs,
        "mixed": [
            f for k, p in enumerate(zip(fronts, backs, strict=True)) for f in p[:: (-1) ** k]
        ],
        "other corners first": fronts + [" ".join(np.roll(b.split(), 1)) for b in backs],
    }[order]
    with pytest.warns(CourseWarning, match="6 of its 12 faces are others seen from behind"):
        mesh = read(tmp_path, CORNERS + "".join(f"f {face}\n" for face in listed))
    assert len(mesh.triangles) == 12
    away = mesh.vertices - MIDDLE
    assert mesh.normals is not None
    cosines = np.sum(mesh.normals * away, axis=1) / np.linalg.norm(away, axis=1)
    np.testing.assert_allclose(np.abs(cosines), 1, atol=1e-12)
    assert len(set(np.sign(cosines))) == 1


def test_a_ply_file_with_both_sides_and_a_sheet_of_which_some_are_there_twice(
    tmp_path: Path,
) -> None:
    head = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
    rows = "0 0 0\n1 0 0\n2 0 1\n0 1 0\n1 1 0\n2 1 1\n"
    faces = "4 1 4 3 0\n4 0 3 4 1\n4 1 2 5 4\n"
    (tmp_path / "a.ply").write_text(
        f"{head}element face 3\nproperty list uchar int vertex_indices\nend_header\n{rows}{faces}"
    )
    with pytest.warns(CourseWarning, match="1 of its 3 faces"):
        mesh = read_mesh(tmp_path / "a.ply")
    # Two faces at 45 degrees: along the edge they share, the mean, 22.5 degrees from either.
    assert mesh.normals is not None
    across = np.abs(mesh.normals[[1, 4]])
    angle = np.radians(22.5)
    np.testing.assert_allclose(across, [[np.sin(angle), 0, np.cos(angle)]] * 2, atol=1e-7)


def test_faces_twice_the_same_way_are_no_two_sides(tmp_path: Path) -> None:
    assert len(read(tmp_path, CORNERS + f"f {FACES[0]}\n" * 2).triangles) == 4


def test_names_of_materials_follow_the_faces(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(
        CORNERS
        + "f 1 2 4\nusemtl red wood\nf 5 7 8 6\ng part\nf 1 5 6\nusemtl tin\nusemtl red wood\nf 3 4 8\n"
    )
    found = read_named_mesh(tmp_path / "a.obj")
    assert [found.names[k] for k in found.name] == ["", *["red wood"] * 4]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("v 1 1 1 1 0 0\n", "line 9: numbers behind x y z, such as colours of vertices, are left"),
        ("l 1 2\np 3\n", "line 9: points and lines have no surface, and are left out: 2"),
        ("cstype bezier\nsurf 0 1 0 1 1 2 3\n", r"line 9: free-form .*\(cstype, surf\)"),
        ("call other.obj\n", "line 9: 'call' is no statement of a mesh, and was passed over"),
        ("x\ny\nx\n", "line 9: 'x' is no .* passed over, with 2 more such lines"),
    ],
)
def test_what_is_passed_over_is_told(tmp_path: Path, text: str, told: str) -> None:
    with pytest.warns(CourseWarning, match=told):
        read(tmp_path, f"{CORNERS}{text}f 1 2 3\n")
    if "v" not in text.split():
        with pytest.raises(GeometryError, match="no triangles"):
            read(tmp_path, CORNERS + text)


MARKS = ["\ufeff", "\u200b", "\ufeff\u200e\u2060", "\ufeff\n \ufeff"]


@pytest.mark.parametrize("mark", MARKS)
def test_what_nobody_sees_before_the_first_word_changes_nothing(tmp_path: Path, mark: str) -> None:
    mesh = read(tmp_path, f"{mark}v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nf 1 2 3 4\n")
    assert mesh.vertices[mesh.triangles].max() == 1


@pytest.mark.parametrize("encoding", ["utf-16", "utf-32", "utf-8-sig", "utf-16-be"])
def test_text_of_any_mark_is_read(tmp_path: Path, encoding: str) -> None:
    mark = "\ufeff\u200b" if encoding == "utf-16-be" else "\u200b"
    head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    ply = f"{head}element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    stl = f"solid é\n{facet}endsolid\n"
    for name, text in (
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("a.ply", ply),
        ("a.stl", stl),
    ):
        (tmp_path / name).write_bytes((mark + text).encode(encoding))
        mesh = read_mesh(tmp_path / name)
        assert mesh.vertices[mesh.triangles].sum(axis=1).tolist() == [[1, 1, 0]]


def test_names_of_other_programs_are_read(tmp_path: Path) -> None:
    """Latin-1 where it is no UTF-8; and a # within a word begins no comment."""
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Wände#2\nf 1 2 3\n"
    names = []
    for content in (text.encode("latin-1"), text.encode("utf-8"), text.encode("utf-16")):
        (tmp_path / "a.obj").write_bytes(content)
        names.append(read_named_mesh(tmp_path / "a.obj").names)
    assert names == [("Wände#2",)] * 3
