"""What goes through a mesh file comes back, and what can't be used is refused by name."""

import json
import math
import struct
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.base.errors import CourseWarning, GeometryError, OutputError
from course.engine import shapes
from course.engine.formats.meshes.files import read_mesh, save_ply
from course.engine.formats.meshes.smooth_normals import smooth_normals
from course.engine.formats.meshes.transforms import apply, compose, rotate, scale, translate
from course.engine.shapes.mesh import Mesh

TORUS = shapes.torus(2.0, 0.5, 24, 12)

SQUARE_OBJ = """
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
"""


# -- writers, from the formats' own descriptions ---------------------------------------------------


def ply_text(
    vertices: Sequence[Sequence[object]], faces: list[list[int]], properties: str = "x y z"
) -> str:
    rows = [" ".join(str(x) for x in row) for row in vertices]
    return "\n".join(
        [
            "ply",
            "format ascii 1.0",
            f"element vertex {len(rows)}",
            *(f"property double {name}" for name in properties.split()),
            f"element face {len(faces)}",
            "property list uchar int vertex_indices",
            "end_header",
            *rows,
            *(" ".join(str(i) for i in (len(face), *face)) for face in faces),
            "",
        ]
    )


def obj_text(mesh: Mesh) -> str:
    assert mesh.uv is not None
    assert mesh.normals is not None
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.vertices.tolist()]
    lines += [f"vt {u!r} {v!r}" for u, v in mesh.uv.tolist()]
    lines += [f"vn {x!r} {y!r} {z!r}" for x, y, z in mesh.normals.tolist()]
    lines += ["f " + " ".join(f"{i}/{i}/{i}" for i in row) for row in (mesh.triangles + 1).tolist()]
    return "\n".join(lines)


def stl_bytes(mesh: Mesh) -> bytes:
    facets = np.zeros(len(mesh.triangles), [("n", "<f4", 3), ("p", "<f4", (3, 3)), ("_", "<u2")])
    facets["p"] = mesh.vertices[mesh.triangles]
    return b"solid in name only".ljust(80) + struct.pack("<I", len(facets)) + facets.tobytes()


def stl_text(mesh: Mesh) -> str:
    lines = ["solid thing"]
    for corners in mesh.vertices[mesh.triangles].tolist():
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x!r} {y!r} {z!r}" for x, y, z in corners]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid thing", ""])


def glb_bytes(
    mesh: Mesh,
    nodes: list[dict[str, Any]] | None = None,
    edit: Callable[[dict[str, Any]], object] = bool,
) -> bytes:
    assert mesh.normals is not None
    assert mesh.uv is not None
    uv = np.stack([mesh.uv[:, 0], 1.0 - mesh.uv[:, 1]], axis=1)
    arrays = [
        (mesh.vertices.astype("<f4"), 5126, "VEC3"),
        (mesh.normals.astype("<f4"), 5126, "VEC3"),
        (uv.astype("<f4"), 5126, "VEC2"),
        (mesh.triangles.astype("<u4").ravel(), 5125, "SCALAR"),
    ]
    binary, views, accessors = b"", [], []
    for k, (array, component, kind) in enumerate(arrays):
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
        accessors.append(
            {"bufferView": k, "componentType": component, "count": len(array), "type": kind}
        )
        binary += array.tobytes()
    attributes = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}
    header: dict[str, Any] = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": views,
        "accessors": accessors,
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 3}]}],
        "nodes": nodes or [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    edit(header)
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def saved(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def corners(values: NDArray[np.float64] | None, mesh: Mesh) -> NDArray[np.float64]:
    """Values at the corners of all triangles: the same however the vertices are split."""
    assert values is not None
    return values[mesh.triangles]


def assert_same_mesh(read: Mesh, mesh: Mesh, tolerance: float) -> None:
    for a, b in ((read.vertices, mesh.vertices), (read.normals, mesh.normals), (read.uv, mesh.uv)):
        np.testing.assert_allclose(corners(a, read), corners(b, mesh), rtol=0.0, atol=tolerance)


# -- round trips -----------------------------------------------------------------------------------


def test_ply_written_by_us_comes_back_exactly(tmp_path: Path) -> None:
    save_ply(TORUS, tmp_path / "torus.ply")
    read = read_mesh(tmp_path / "torus.ply")
    assert_same_mesh(read, TORUS, 2e-16)
    np.testing.assert_array_equal(read.vertices, TORUS.vertices)


def test_ply_without_normals_or_uv_comes_back_without_uv(tmp_path: Path) -> None:
    save_ply(Mesh(TORUS.vertices, TORUS.triangles), tmp_path / "torus.ply")
    read = read_mesh(tmp_path / "torus.ply")
    assert read.uv is None
    np.testing.assert_array_equal(read.triangles, TORUS.triangles)


def test_ply_text_comes_back_exactly(tmp_path: Path) -> None:
    assert TORUS.normals is not None
    assert TORUS.uv is not None
    rows = np.concatenate([TORUS.vertices, TORUS.normals, TORUS.uv], axis=1).tolist()
    text = ply_text(rows, TORUS.triangles.tolist(), "x y z nx ny nz s t")
    read = read_mesh(saved(tmp_path, "TORUS.PLY", text))
    assert_same_mesh(read, TORUS, 2e-16)
    np.testing.assert_array_equal(read.vertices, TORUS.vertices)


def test_obj_comes_back_exactly(tmp_path: Path) -> None:
    read = read_mesh(saved(tmp_path, "torus.obj", obj_text(TORUS)))
    assert_same_mesh(read, TORUS, 2e-16)


@pytest.mark.parametrize("content", [stl_bytes(TORUS), stl_text(TORUS)], ids=["binary", "text"])
def test_stl_comes_back_welded(tmp_path: Path, content: str | bytes) -> None:
    read = read_mesh(saved(tmp_path, "torus.stl", content))
    np.testing.assert_allclose(
        corners(read.vertices, read), corners(TORUS.vertices, TORUS), rtol=0.0, atol=3e-7
    )
    assert len(read.vertices) == 24 * 12
    assert read.uv is None
    # Smooth: within the angle between neighbouring facets of the analytic normal.
    cosine = np.sum(corners(read.normals, read) * corners(TORUS.normals, TORUS), axis=2)
    assert cosine.min() > math.cos(math.pi / 12)


def test_glb_comes_back_to_float32(tmp_path: Path) -> None:
    read = read_mesh(saved(tmp_path, "torus.glb", glb_bytes(TORUS)))
    assert_same_mesh(read, TORUS, 3e-7)


def test_save_names_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"nowhere.*can't be written"):
        save_ply(TORUS, tmp_path / "nowhere" / "torus.ply")


# -- what formats allow ----------------------------------------------------------------------------


def test_glb_nodes_place_turn_and_mirror_their_meshes(tmp_path: Path) -> None:
    nodes = [
        {"children": [1, 2], "translation": [1.0, 2.0, 3.0], "camera": 0},
        {"mesh": 0, "scale": [-2.0, 1.0, 1.0]},
        {"mesh": 0, "rotation": [0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5)]},
        {"mesh": 0, "translation": [99.0, 0.0, 0.0]},  # not in the scene
    ]
    # Points and lines beside the triangles of a mesh are not surfaces.
    points = {"attributes": {"POSITION": 0}, "mode": 0}
    data = glb_bytes(TORUS, nodes, lambda header: header["meshes"][0]["primitives"].append(points))
    with pytest.warns(
        CourseWarning, match="meshes of points and lines have no surface, and are left out: 1"
    ):
        read = read_mesh(saved(tmp_path, "scene.glb", data))
    place = translate((1.0, 2.0, 3.0))
    mirrored = apply(TORUS, compose([scale((-2.0, 1.0, 1.0)), place]))
    turned = apply(TORUS, compose([rotate((0.0, 1.0, 0.0), 90.0), place]))
    half = len(TORUS.triangles)
    assert len(read.triangles) == 2 * half

    def middles(mesh: Mesh) -> NDArray[np.float64]:
        rows = np.concatenate([mesh.vertices, mesh.normals], axis=1)[mesh.triangles].mean(axis=1)
        return np.asarray(rows)

    expected = np.concatenate([middles(mirrored), middles(turned)])
    got = middles(read)
    # The order of a scene's nodes is the parser's affair.
    swapped = np.concatenate([got[half:], got[:half]])
    error = min(np.max(np.abs(got - expected)), np.max(np.abs(swapped - expected)))
    assert error < 1e-6
    # Winding still agrees with the normals after the mirror.
    p0, p1, p2 = read.vertices[read.triangles].transpose(1, 0, 2)
    facing = np.cross(p1 - p0, p2 - p0)
    assert np.all(np.sum(facing * corners(read.normals, read)[:, 0], axis=1) > 0.0)


def test_obj_counts_back_from_the_line_of_the_face(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 5\nv 1 0 5\nv 0 1 5\n  f\t-3 -2 -1 # up\n"
    read = read_mesh(saved(tmp_path, "two.obj", text))
    heights = np.sort(read.vertices[read.triangles][:, :, 2].mean(axis=1))
    np.testing.assert_array_equal(heights, [0.0, 5.0])


def test_polygons_are_cut_into_triangles(tmp_path: Path) -> None:
    pentagon = [[math.cos(a), math.sin(a), 0.0] for a in np.arange(5) * 0.4 * math.pi]
    exact = 2.5 * math.sin(0.4 * math.pi)
    obj = "\n".join([*(f"v {x} {y} {z}" for x, y, z in pentagon), "f 1 2 3 4 5", ""])
    mixed = "\n".join([*(f"v {x} {y} {z}" for x, y, z in pentagon), "f 1 2 3", "f 1 3 4 5", ""])
    for name, text in (
        ("a.obj", obj),
        ("b.obj", mixed),
        ("a.ply", ply_text(pentagon, [[0, 1, 2, 3, 4]])),
        ("b.ply", ply_text(pentagon, [[0, 1, 2], [0, 2, 3, 4]])),
    ):
        read = read_mesh(saved(tmp_path, name, text))
        p0, p1, p2 = read.vertices[read.triangles].transpose(1, 0, 2)
        areas = 0.5 * np.cross(p1 - p0, p2 - p0)[:, 2]
        assert len(areas) == 3
        assert np.all(areas > 0.0)
        assert np.sum(areas) == pytest.approx(exact, rel=1e-12)


def test_ply_uv_by_corner_keeps_normals_and_splits_the_seam(tmp_path: Path) -> None:
    header = [
        "ply",
        "format ascii 1.0",
        "element vertex 4",
        *(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")),
        "element face 2",
        "property list uchar int vertex_indices",
        "property list uchar float texcoord",
        "end_header",
    ]
    points = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]
    faces = ["3 0 1 2 6 0 0 1 0 1 1", "3 0 2 3 6 0.5 0 1 1 0 1"]
    text = "\n".join([*header, *(f"{p} 0 0.6 0.8" for p in points), *faces, ""])
    read = read_mesh(saved(tmp_path, "wedge.ply", text))
    np.testing.assert_allclose(
        corners(read.uv, read), [[[0, 0], [1, 0], [1, 1]], [[0.5, 0], [1, 1], [0, 1]]]
    )
    np.testing.assert_allclose(corners(read.normals, read), np.tile([0.0, 0.6, 0.8], (2, 3, 1)))
    assert len(read.vertices) == 5


def test_file_normals_are_made_unit_and_zero_ones_computed(tmp_path: Path) -> None:
    rows = [[0, 0, 0, 0, 0, 5], [1, 0, 0, 0, 0, 0], [0, 1, 0, 3e-200, 0, 4e-200]]
    read = read_mesh(saved(tmp_path, "n.ply", ply_text(rows, [[0, 1, 2]], "x y z nx ny nz")))
    expected = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]]
    np.testing.assert_allclose(read.normals, expected, rtol=1e-15)


def test_several_solids_of_an_stl_are_one_mesh(tmp_path: Path) -> None:
    twice = stl_text(TORUS) + stl_text(apply(TORUS, translate((10.0, 0.0, 0.0))))
    read = read_mesh(saved(tmp_path, "two.stl", twice))
    assert len(read.triangles) == 2 * len(TORUS.triangles)
    assert read.vertices[:, 0].max() == pytest.approx(12.5)


# -- normals of files without ----------------------------------------------------------------------


def test_shared_vertices_are_smooth_and_parted_ones_keep_their_edge(tmp_path: Path) -> None:
    box = shapes.box()
    places, which = np.unique(box.vertices, axis=0, return_inverse=True)
    shared = which.reshape(-1)[box.triangles].tolist()
    smooth = read_mesh(saved(tmp_path, "shared.ply", ply_text(places.tolist(), shared)))
    # By angle each of three faces counts the same, however many triangles it is cut into.
    np.testing.assert_allclose(smooth.normals, places * 2.0 / math.sqrt(3.0), atol=1e-15)
    parted = ply_text(box.vertices.tolist(), box.triangles.tolist())
    hard = read_mesh(saved(tmp_path, "parted.ply", parted))
    np.testing.assert_allclose(hard.normals, box.normals, atol=1e-15)


def test_stl_is_hard_at_creases_and_smooth_elsewhere(tmp_path: Path) -> None:
    cylinder = shapes.cylinder(1.0, 2.0, 24)
    read = read_mesh(saved(tmp_path, "cylinder.stl", stl_text(cylinder)))
    # Rim vertices twice, for side and cap; the middles of both caps.
    assert len(read.vertices) == 4 * 24 + 2
    np.testing.assert_allclose(
        corners(read.normals, read), corners(cylinder.normals, cylinder), rtol=0.0, atol=1e-12
    )


def test_texture_seam_of_an_obj_is_smooth(tmp_path: Path) -> None:
    sphere = shapes.sphere(1.0, 32)
    lines = [line for line in obj_text(sphere).split("\n") if not line.startswith("vn")]
    text = "\n".join(lines).replace("/", " ")
    text = "\n".join(
        "f " + " ".join(f"{i}/{i}" for i in line.split()[1::3]) if line[:1] == "f" else line
        for line in text.split("\n")
    )
    read = read_mesh(saved(tmp_path, "sphere.obj", text))
    assert read.uv is not None
    assert read.normals is not None
    # Half a facet would be 0.098 rad: at a seam left open, normals lean by about that much.
    cosine = np.sum(read.normals * read.vertices, axis=1)
    assert cosine.min() > math.cos(0.02)


@pytest.mark.parametrize("size", [1e-140, 1.0, 1e140])
def test_normals_of_degenerate_triangles_are_finite_and_unit(size: float) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [9, 9, 9]]) * size
    # No area, all one point, a sheet and its own back: none has a normal of its own.
    triangles = np.array([[0, 1, 2], [4, 4, 4], [0, 1, 3], [1, 0, 3]])
    with np.errstate(all="raise", under="ignore"):
        normals = smooth_normals(points, triangles)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, rtol=0.0, atol=1e-15)
    np.testing.assert_array_equal(normals[2], [0.0, 1.0, 0.0])
    np.testing.assert_array_equal(np.abs(normals[[0, 1, 3], 2]), 1.0)


def test_degenerate_triangles_of_a_file_are_let_through(tmp_path: Path) -> None:
    text = SQUARE_OBJ + "f 1 2 3\nf 1 1 2\nf 4 4 4\n"
    read = read_mesh(saved(tmp_path, "degenerate.obj", text))
    assert len(read.triangles) == 3
    assert read.normals is not None
    np.testing.assert_allclose(np.linalg.norm(read.normals, axis=1), 1.0, atol=1e-15)


def test_a_fan_of_very_many_facets_takes_no_quadratic_time() -> None:
    count = 200_000
    tips = np.zeros((count, 3))
    angle = np.arange(count + 1) * (2.0 * math.pi / count)
    rim = np.stack([np.cos(angle), np.full(count + 1, -1.0), -np.sin(angle)], axis=1)
    points = np.concatenate([tips, rim])
    i = np.arange(count)
    normals = smooth_normals(points, np.stack([i, count + i, count + i + 1], axis=1))
    np.testing.assert_allclose(normals[:, 1], math.sqrt(0.5), atol=1e-6)


# -- refused ---------------------------------------------------------------------------------------

TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def compressed(header: dict[str, Any]) -> None:
    header["extensionsRequired"] = ["KHR_draco_mesh_compression"]


def as_points(header: dict[str, Any]) -> None:
    header["meshes"][0]["primitives"][0]["mode"] = 0


def flattened(header: dict[str, Any]) -> None:
    header["nodes"][0]["scale"] = [1.0, 0.0, 1.0]


def with_vertex(k: int, value: float) -> Mesh:
    vertices = TORUS.vertices.copy()
    vertices[k, 1] = value
    return Mesh(vertices, TORUS.triangles, TORUS.normals, TORUS.uv)


FAR_INDEX = Mesh(TORUS.vertices, TORUS.triangles + 300, TORUS.normals, TORUS.uv)

BAD: dict[str, tuple[str, str | bytes, str]] = {
    "empty": ("a.ply", b"", "the file is empty"),
    "blank": ("a.obj", "  \n\n", "the file is empty"),
    "other suffix": (
        "a.blend",
        b"x",
        r"expected a file that ends in \.glb, \.gltf, \.obj, \.ply, \.stl",
    ),
    "no suffix": ("mesh", b"x", "expected a file that ends in"),
    "not a ply": ("a.ply", b"\x00\xff\x13 nonsense", "not a PLY file that can be read"),
    "not an obj": ("a.obj", "once upon a time\n", "no triangles"),
    "not an stl": ("a.stl", b"\x01" * 200, "no triangles|not an STL file"),
    "not a glb": ("a.glb", b"\x01" * 200, "doesn't begin as a GLB"),
    "short glb": ("a.glb", b"glTF", "doesn't begin as a GLB"),
    "cut glb": ("a.glb", glb_bytes(TORUS)[:-100], "not a GLB file that can be read"),
    "obj points": ("a.obj", SQUARE_OBJ, "no triangles"),
    "stl of none": ("a.stl", b"".ljust(84, b"\0"), "no triangles"),
    "glb points": ("a.glb", glb_bytes(TORUS, edit=as_points), "no triangles"),
    "glb draco": ("a.glb", glb_bytes(TORUS, edit=compressed), "needs KHR_draco_mesh_compression"),
    "glb flat node": (
        "a.glb",
        glb_bytes(TORUS, edit=flattened),
        r"node \d+: its matrix can't be inverted",
    ),
    "glb index": ("a.glb", glb_bytes(FAR_INDEX), "triangle .* refers to vertex .*there are 325"),
    "obj inf": ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n", "line 3: v 0 -inf 0: exp"),
    "stl nan": ("a.stl", stl_text(with_vertex(0, math.nan)), "vertex 0 is .*nan.*finite"),
    "binary stl nan": ("a.stl", stl_bytes(with_vertex(0, math.nan)), "vertex 0 is .*nan.*finite"),
    "glb nan": ("a.glb", glb_bytes(with_vertex(7, math.nan)), "vertex 7 is .*nan.*finite"),
    "too far": (
        "a.ply",
        ply_text([*TRIANGLE[:2], [0, 1e200, 0]], [[0, 1, 2]]),
        "vertex 2 .*beyond",
    ),
    "nan uv": (
        "a.ply",
        ply_text([[*p, 0, "inf"] for p in TRIANGLE], [[0, 1, 2]], "x y z s t"),
        "uv 0 is .*inf",
    ),
}


@pytest.mark.parametrize(("name", "content", "message"), BAD.values(), ids=BAD.keys())
def test_file_that_cannot_be_used_is_refused_by_name(
    tmp_path: Path, name: str, content: str | bytes, message: str
) -> None:
    path = saved(tmp_path, name, content)
    with pytest.raises(GeometryError, match=message) as caught:
        read_mesh(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


OBJ_NORMALS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 nan\nvn 0 0 1\nf 1//1 2//2 3//2\n"


@pytest.mark.parametrize(
    ("name", "content"),
    [
        (
            "a.ply",
            ply_text(
                [[*p, 0, 0, z] for p, z in zip(TRIANGLE, ("nan", 1, 1), strict=True)],
                [[0, 1, 2]],
                "x y z nx ny nz",
            ),
        ),
        ("a.obj", OBJ_NORMALS),
    ],
)
def test_normals_that_are_no_numbers_are_computed_and_told(
    tmp_path: Path, name: str, content: str
) -> None:
    path = saved(tmp_path, name, content)
    with pytest.warns(CourseWarning, match="1 of 3 normals are not numbers, and are computed from"):
        mesh = read_mesh(path)
    assert mesh.normals is not None
    np.testing.assert_array_equal(mesh.normals, [[0, 0, 1]] * 3)


def test_missing_file_and_folder_are_told_apart(tmp_path: Path) -> None:
    with pytest.raises(GeometryError, match="no such file"):
        read_mesh(tmp_path / "nowhere.ply")
    folder = tmp_path / "folder.ply"
    folder.mkdir()
    with pytest.raises(GeometryError, match="a folder"):
        read_mesh(folder)


def test_trimesh_is_not_imported_before_a_file_is_read() -> None:
    code = (
        "import sys; import course.engine.formats.meshes.files, course.engine.shapes; "
        "sys.exit(any(m in sys.modules for m in ('trimesh', 'scipy', 'PIL')))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
