"""glTF as its specification has it: each file is written by hand, and where its vertices are is worked out apart."""

import base64
import json
import math
import struct
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.base.errors import CourseWarning, GeometryError
from course.engine.formats.meshes.files import read_mesh, read_named_mesh
from course.engine.shapes.mesh import Mesh
from tests.engine.formats.meshes.gltf_files import KINDS, SQUARE, Writer


def read(writer: Writer, folder: Path) -> Mesh:
    (folder / "a.glb").write_bytes(writer.glb())
    return read_mesh(folder / "a.glb")


def bounds(mesh: Mesh) -> list[list[float]]:
    used = mesh.vertices[np.unique(mesh.triangles)]
    return [np.round(x, 6).tolist() for x in (used.min(axis=0), used.max(axis=0))]


def area(mesh: Mesh) -> float:
    p = mesh.vertices[mesh.triangles]
    return float(np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2)


# ---------------------------------------------------------------- skins and morph targets


def skinned(
    writer: Writer, node: dict[str, Any], joints: NDArray[Any], weights: NDArray[Any]
) -> None:
    """Two joints: one where it was when the skin was bound, one moved by 5 along y, with a binding of -2 along x."""
    binding = np.tile(np.eye(4, dtype="<f4"), (2, 1, 1))
    binding[1, 3, 0] = -2  # columns follow each other
    writer.primitive["attributes"] |= {
        "JOINTS_0": writer.add(joints),
        "WEIGHTS_0": writer.add(weights),
    }
    matrices = writer.add(binding.reshape(2, 16))
    writer.header["skins"] = [{"joints": [1, 2], "inverseBindMatrices": matrices}]
    writer.header["nodes"] = [
        {"mesh": 0, "skin": 0} | node,
        {},
        {"translation": [2, 5, 0]},
    ]
    writer.header["scenes"] = [{"nodes": [0, 1, 2]}]


ONE = np.array([[1, 0, 0, 0]] * 4, "<f4")


@pytest.mark.parametrize("node", [{}, {"scale": [100, 100, 100]}, {"translation": [5, 0, 0]}])
def test_joints_move_a_skinned_mesh_and_its_node_does_not(
    tmp_path: Path, node: dict[str, Any]
) -> None:
    writer = Writer()
    skinned(writer, node, np.zeros((4, 4), "u1"), ONE)
    assert bounds(read(writer, tmp_path)) == [[0, 0, 0], [1, 1, 0]]


def test_vertices_follow_their_joints_by_weight(tmp_path: Path) -> None:
    """The lower two stay; one of the upper ones goes all the way, 5 along y, and one half of it."""
    writer = Writer()
    joints = np.array([(0, 0, 0, 0), (0, 0, 0, 0), (1, 0, 0, 0), (0, 1, 0, 0)], "u1")
    weights = np.array([(255, 0, 0, 0), (255, 0, 0, 0), (255, 0, 0, 0), (128, 128, 0, 0)], "u1")
    skinned(writer, {}, joints, weights)
    writer.header["accessors"][writer.primitive["attributes"]["WEIGHTS_0"]]["normalized"] = True
    mesh = read(writer, tmp_path)
    np.testing.assert_allclose(
        mesh.vertices, [(0, 0, 0), (1, 0, 0), (1, 6, 0), (0, 3.5, 0)], atol=1e-6
    )


def test_a_joint_turns_normals_with_the_vertices(tmp_path: Path) -> None:
    writer = Writer()
    writer.primitive["attributes"]["NORMAL"] = writer.add(np.array([(0, 0, 1)] * 4, "<f4"))
    skinned(writer, {}, np.zeros((4, 4), "u2"), ONE)
    half = math.sqrt(0.5)
    writer.header["nodes"][1] = {"rotation": [half, 0, 0, half], "scale": [1, 1, 2]}
    mesh = read(writer, tmp_path)
    assert bounds(mesh) == [[0, 0, 0], [1, 0, 1]]
    assert mesh.normals is not None
    np.testing.assert_allclose(mesh.normals, [(0, -1, 0)] * 4, atol=1e-6)


@pytest.mark.parametrize("where", ["mesh", "node", "both"])
@pytest.mark.parametrize("sparse", [False, True])
def test_morph_targets_count_by_their_weights(tmp_path: Path, where: str, sparse: bool) -> None:
    """Weights 0.5 and 1: the first target lifts all by 2, the second one corner by 3."""
    writer = Writer()
    lifted = writer.add(np.array([(0, 0, 2)] * 4, "<f4"))
    corner = np.array([(0, 0, 0), (0, 0, 3), (0, 0, 0), (0, 0, 0)], "<f4")
    if sparse:
        # Without a view all other values are 0.
        values = {"bufferView": writer.view(corner[1:2])}
        indices = {"bufferView": writer.view(np.array([1], "<u2")), "componentType": 5123}
        writer.header["accessors"].append(
            {"componentType": 5126, "count": 4, "type": "VEC3"}
            | {"sparse": {"count": 1, "indices": indices, "values": values}}
        )
        other = len(writer.header["accessors"]) - 1
    else:
        other = writer.add(corner)
    writer.primitive["targets"] = [{"POSITION": lifted}, {"POSITION": other}]
    if where != "node":
        writer.header["meshes"][0]["weights"] = [0.5, 1] if where == "mesh" else [9, 9]
    if where != "mesh":
        writer.header["nodes"][0]["weights"] = [0.5, 1]
    np.testing.assert_allclose(read(writer, tmp_path).vertices[:, 2], [1, 4, 1, 1])


# ---------------------------------------------------------------- accessors and modes


@pytest.mark.parametrize(
    ("kind", "largest"), [("i1", 127), ("u1", 255), ("<i2", 32767), ("<u2", 65535)]
)
@pytest.mark.parametrize("normalized", [True, False])
def test_positions_of_whole_numbers(
    tmp_path: Path, kind: str, largest: int, normalized: bool
) -> None:
    writer = Writer()
    rows = np.zeros((4, 4), kind)
    rows[:, :3] = SQUARE * largest
    view = writer.view(rows)
    writer.header["bufferViews"][view]["byteStride"] = rows.strides[0]
    accessor = {
        "bufferView": view,
        "componentType": KINDS[rows.dtype.str[1:]],
        "count": 4,
        "type": "VEC3",
    }
    writer.header["accessors"].append(accessor | {"normalized": normalized})
    writer.primitive["attributes"]["POSITION"] = len(writer.header["accessors"]) - 1
    writer.header |= {"extensionsUsed": ["KHR_mesh_quantization"]}
    writer.header |= {"extensionsRequired": ["KHR_mesh_quantization"]}
    size = 1 if normalized else largest
    assert bounds(read(writer, tmp_path)) == [[0, 0, 0], [size, size, 0]]


def test_uv_of_whole_numbers_and_v_upwards(tmp_path: Path) -> None:
    writer = Writer()
    uv = np.array([(0, 0), (255, 0), (255, 255), (0, 51)], "u1")
    writer.primitive["attributes"]["TEXCOORD_0"] = writer.add(uv, normalized=True)
    mesh = read(writer, tmp_path)
    np.testing.assert_allclose(mesh.uv, [(0, 1), (1, 1), (1, 0), (0, 0.8)], atol=1e-12)


HALF = math.sqrt(0.5)


@pytest.mark.parametrize(
    ("picture", "expected"),
    [
        ({}, [(0, 0.25), (1, 0.25)]),
        ({"texCoord": 1}, [(0.5, 1), (0, 0)]),
        # By hand: offset + R (scale * uv), and R turns (1, 0) to (0, -1), which is up as v runs down.
        ({"offset": [0.125, 0.5]}, [(0.125, 0.75), (1.125, 0.75)]),
        ({"scale": [4, 2]}, [(0, 0.5), (4, 0.5)]),
        ({"rotation": math.pi / 2}, [(0.25, 0), (0.25, -1)]),
        ({"rotation": math.pi / 4, "scale": [2, 4]}, [(HALF, HALF), (3 * HALF, -HALF)]),
        ({"texCoord": 1, "scale": [3, 1], "offset": [0, 5]}, [(1.5, 6), (0, 5)]),
    ],
)
@pytest.mark.parametrize("texture", ["baseColorTexture", "normalTexture"])
def test_uv_are_those_of_the_material_s_picture(
    tmp_path: Path, picture: dict[str, Any], expected: list[tuple[float, float]], texture: str
) -> None:
    writer = Writer()
    for name, (first, second) in {
        "TEXCOORD_0": ((0, 0.25), (1, 0.25)),
        "TEXCOORD_1": ((0.5, 1), (0, 0)),
    }.items():
        uv = np.array([first, second, first, second], "<f4")
        writer.primitive["attributes"][name] = writer.add(uv)
    given = {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform": picture}}
    base = texture == "baseColorTexture"
    material = {"pbrMetallicRoughness": {texture: given}} if base else {texture: given}
    writer.header |= {"materials": [material], "extensionsRequired": ["KHR_texture_transform"]}
    writer.primitive["material"] = 0
    mesh = read(writer, tmp_path)
    np.testing.assert_allclose(mesh.uv[:2], [(u, 1 - v) for u, v in expected], atol=1e-12)


def test_which_triangles_have_no_uv_beside_others(tmp_path: Path) -> None:
    """A square with and one without, the second twice: of six triangles the last four."""
    writer = Writer()
    uv = writer.add(np.zeros((4, 2), "<f4"))
    bare = dict(writer.primitive)
    writer.primitive["attributes"] = writer.primitive["attributes"] | {"TEXCOORD_0": uv}
    writer.header["meshes"].append({"primitives": [bare]})
    as_nodes({"mesh": 0}, {"mesh": 1}, {"mesh": 1, "translation": [3, 0, 0]})(writer)
    writer.header["scenes"] = [{"nodes": [0, 1, 2]}]
    (tmp_path / "a.glb").write_bytes(writer.glb())
    found = read_named_mesh(tmp_path / "a.glb").bare
    assert found is not None
    assert found.tolist() == [False] * 2 + [True] * 4


def test_pictures_of_different_uv_are_told(tmp_path: Path) -> None:
    writer = Writer()
    writer.primitive["attributes"]["TEXCOORD_0"] = writer.add(np.zeros((4, 2), "<f4"))
    writer.primitive["material"] = 0
    color = {"baseColorTexture": {"index": 0, "texCoord": 1}}
    writer.header["materials"] = [{"pbrMetallicRoughness": color, "normalTexture": {"index": 1}}]
    with (
        pytest.warns(CourseWarning, match="'material 0' have different texture coordinates"),
        pytest.warns(CourseWarning, match="no TEXCOORD_1, which its material asks for: TEXCOORD_0"),
    ):
        assert (read(writer, tmp_path).uv == (0, 1)).all()


@pytest.mark.parametrize("scale", [[0, 0, 0], [0, 1, 0]])
def test_a_node_of_which_nothing_is_left_is_not_there(tmp_path: Path, scale: list[float]) -> None:
    writer = Writer()
    writer.header["nodes"].append({"mesh": 0, "scale": scale, "translation": [5, 5, 5]})
    writer.header["scenes"] = [{"nodes": [0, 1]}]
    mesh = read(writer, tmp_path)
    assert area(mesh) == 1
    assert bounds(mesh) == [[0, 0, 0], [1, 1, 0]]


@pytest.mark.parametrize(
    ("mode", "order"), [(4, [0, 1, 2, 0, 2, 3]), (5, [0, 1, 3, 2]), (6, [1, 2, 3, 0])]
)
def test_triangles_strips_and_fans_fill_the_square_and_look_to_one_side(
    tmp_path: Path, mode: int, order: list[int]
) -> None:
    writer = Writer()
    writer.primitive |= {"mode": mode, "indices": writer.add(np.array(order, "<u4"))}
    mesh = read(writer, tmp_path)
    p = mesh.vertices[mesh.triangles]
    across = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    np.testing.assert_allclose(across, [(0, 0, 1)] * 2)


def test_without_normals_triangles_are_flat_beside_others_that_have_some(tmp_path: Path) -> None:
    """Flat normals must be computed where there are none (glTF 2.0, 3.7.2.1)."""
    writer = Writer()
    folded = writer.add(np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1)], "<f4"))
    writer.primitive["attributes"]["POSITION"] = folded
    assert read(writer, tmp_path).normals is None
    other = {
        "attributes": {"POSITION": 1, "NORMAL": writer.add(np.array([(0, 0.6, 0.8)] * 4, "<f4"))}
    }
    writer.header["meshes"][0]["primitives"].append(other | {"indices": 0})
    del writer.header["buffers"]
    mesh = read(writer, tmp_path)
    assert mesh.normals is not None
    found = mesh.normals[mesh.triangles]
    np.testing.assert_allclose(found[0], [(0, 0, 1)] * 3)
    np.testing.assert_allclose(found[1], [np.array([1, -1, 1]) / math.sqrt(3)] * 3)
    np.testing.assert_allclose(found[2:], [[(0, 0.6, 0.8)] * 3] * 2, atol=1e-7)


# ---------------------------------------------------------------- nodes, scenes and instances


def instances(writer: Writer) -> dict[str, Any]:
    half = math.sqrt(0.5)
    return {
        "TRANSLATION": writer.add(np.array([(0, 0, 0), (10, 0, 0), (20, 0, 0)], "<f4")),
        "ROTATION": writer.add(np.array([(0, 0, 0, 1), (0, 0, half, half), (0, 0, 0, 1)], "<f4")),
        "SCALE": writer.add(np.array([(1, 1, 1), (1, 1, 1), (2, 3, 1)], "<f4")),
    }


def test_instances_are_all_there(tmp_path: Path) -> None:
    writer = Writer()
    extension = {"EXT_mesh_gpu_instancing": {"attributes": instances(writer)}}
    writer.header["nodes"] = [{"mesh": 0, "translation": [0, 0, 7], "extensions": extension}]
    writer.header["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    mesh = read(writer, tmp_path)
    low, high = bounds(mesh)
    assert (low, high) == ([0, 0, 7], [22, 3, 7])
    assert area(mesh) == pytest.approx(1 + 1 + 6)
    # The second is turned by a quarter: from 9 to 10.
    middle = mesh.vertices[4:8]
    np.testing.assert_allclose([middle[:, 0].min(), middle[:, 0].max()], [9, 10], atol=1e-6)


def test_hidden_nodes_are_not_there(tmp_path: Path) -> None:
    hidden = {"KHR_node_visibility": {"visible": False}}
    writer = Writer()
    writer.header["nodes"] = [
        {"children": [1]},
        {"mesh": 0, "children": [2]},
        {"extensions": hidden, "children": [3]},
    ]
    writer.header["nodes"].append({"mesh": 0, "translation": [5, 0, 0]})
    assert bounds(read(writer, tmp_path)) == [[0, 0, 0], [1, 1, 0]]


def test_a_file_without_scenes_shows_all_nodes_and_tells_it(tmp_path: Path) -> None:
    writer = Writer()
    del writer.header["scenes"], writer.header["scene"]
    with pytest.warns(CourseWarning, match="it has no scene: all its nodes are shown"):
        assert area(read(writer, tmp_path)) == 1


def test_materials_have_names(tmp_path: Path) -> None:
    writer = Writer()
    writer.header["materials"] = [{}, {"name": "tin"}]
    primitives = [writer.primitive | {"material": k} for k in (1, 0)] + [writer.primitive]
    writer.header["meshes"][0]["primitives"] = primitives
    (tmp_path / "a.glb").write_bytes(writer.glb())
    found = read_named_mesh(tmp_path / "a.glb")
    assert [found.names[k] for k in found.name] == ["tin"] * 2 + ["material 0"] * 2 + [""] * 2


def test_a_million_nodes_take_seconds(tmp_path: Path) -> None:
    """200,000 here, empty ones and moved ones, below each other and beside each other."""
    writer = Writer()
    count = 200_000
    nodes: list[dict[str, Any]] = [{} for _ in range(count)]
    nodes[0] = {"children": list(range(1, 4000))}
    for k in range(4000, 7000):
        nodes[k - 1]["children"] = [k]
        nodes[k]["translation"] = [0, 0, 1]
    nodes[6999]["mesh"] = 0
    writer.header["nodes"] = nodes
    begin = time.process_time()
    mesh = read(writer, tmp_path)
    assert bounds(mesh) == [[0, 0, 3000], [1, 1, 3000]]
    assert time.process_time() - begin < 60


def test_many_nodes_with_one_mesh_are_many_copies(tmp_path: Path) -> None:
    writer = Writer()
    count = 20_000
    writer.header["nodes"] = [{"mesh": 0, "translation": [2 * k, 0, 0]} for k in range(count)]
    writer.header["scenes"] = [{"nodes": list(range(count))}]
    mesh = read(writer, tmp_path)
    assert area(mesh) == pytest.approx(count)
    assert bounds(mesh) == [[0, 0, 0], [2 * count - 1, 1, 0]]


# ---------------------------------------------------------------- buffers


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
@pytest.mark.parametrize("uri", ["a b.bin", "a%20b.bin", "more/a.bin", "data"])
def test_buffers_beside_the_file_and_in_it(tmp_path: Path, suffix: str, uri: str) -> None:
    writer = Writer()
    if uri == "data":
        uri = "data:application/octet-stream;base64," + base64.b64encode(writer.binary).decode()
    else:
        path = tmp_path / uri.replace("%20", " ")
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(writer.binary)
    writer.header["buffers"] = [{"byteLength": len(writer.binary), "uri": uri}]
    content = writer.glb() if suffix == "glb" else json.dumps(writer.header).encode()
    (tmp_path / f"a.{suffix}").write_bytes(content)
    assert area(read_mesh(tmp_path / f"a.{suffix}")) == 1


@pytest.mark.parametrize(
    ("uri", "told"),
    [
        ("../secret.bin", "expected a file in its own folder"),
        ("%2e%2e/secret.bin", "expected a file in its own folder"),
        ("..\\secret.bin", "expected a file in its own folder"),
        ("/etc/passwd", "expected a file in its own folder"),
        ("file:///etc/passwd", "expected a file in its own folder"),
        ("https://example.org/a.bin", "expected a file in its own folder"),
        ("C:\\a.bin", "expected a file in its own folder"),
        ("link.bin", "lies in another folder"),
        ("missing.bin", "missing.bin: no such file"),
        ("data:text/plain,abc", "buffer 0 has 3 bytes of"),
        ("data:;base64,???", "isn't base64"),
    ],
)
def test_buffers_elsewhere_are_refused(tmp_path: Path, uri: str, told: str) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    (tmp_path / "secret.bin").write_bytes(bytes(100))
    if uri == "link.bin":
        (folder / uri).symlink_to(tmp_path / "secret.bin")
    writer = Writer()
    writer.header["buffers"] = [{"byteLength": len(writer.binary), "uri": uri}]
    with pytest.raises(GeometryError, match=told):
        read(writer, folder)


# ---------------------------------------------------------------- told and refused

Change = Callable[[Writer], object]

TOLD: dict[str, tuple[Change, str]] = {
    "unknown extension": (
        lambda w: w.header.update(extensionsUsed=["KHR_texture_transform", "ACME_bones"]),
        "what its extensions ACME_bones say isn't read",
    ),
    "animations": (lambda w: w.header.update(animations=[{}]), "its animations are left out"),
    "points": (
        lambda w: w.header["meshes"][0]["primitives"].append(w.primitive | {"mode": 1}),
        "meshes of points and lines have no surface, and are left out: 1",
    ),
    "colours": (
        lambda w: w.primitive["attributes"].update(COLOR_0=1),
        "colours of its vertices are left out",
    ),
    "alpha": (
        lambda w: (
            w.header.update(materials=[{"name": "leaf", "alphaMode": "MASK"}]),
            w.primitive.update(material=0),
        ),
        "alpha of its material 'leaf' is left out",
    ),
    "two scenes": (lambda w: w.header["scenes"].append({}), "of its 2 scenes number 0 is shown"),
}


@pytest.mark.parametrize(("change", "told"), TOLD.values(), ids=TOLD.keys())
def test_what_is_left_out_is_told(tmp_path: Path, change: Change, told: str) -> None:
    writer = Writer()
    change(writer)
    with pytest.warns(CourseWarning, match=told):
        assert area(read(writer, tmp_path)) == 1


def as_nodes(*nodes: dict[str, Any]) -> Change:
    return lambda writer: writer.header.update(nodes=list(nodes))


def with_zeros(count: int) -> Change:
    """Positions of which there is no data, which are zeros."""

    def change(writer: Writer) -> None:
        writer.header["accessors"][1] = {"componentType": 5126, "count": count, "type": "VEC3"}

    return change


REFUSED: dict[str, tuple[Change, str]] = {
    "draco": (
        lambda w: w.header.update(extensionsRequired=["KHR_draco_mesh_compression"]),
        "it needs KHR_draco_mesh_compression, which isn't read here; export it without compression",
    ),
    "any other": (
        lambda w: w.header.update(extensionsRequired=["ACME_bones"]),
        "it needs ACME_bones, which isn't read here; export it without that extension",
    ),
    "version": (lambda w: w.header.update(asset={"version": "1.0"}), "glTF of version 1.0: expect"),
    "version 1": (
        # There meshes have names instead of numbers.
        lambda w: w.header.update(asset={"version": "1.0"}, meshes={"a": {}}),
        "glTF of version 1: expected 2.0; convert it",
    ),
    "version 1 as a number": (
        lambda w: w.header.update(asset={"version": 1}, meshes={"a": {}}),
        "glTF of version 1: expected 2.0; convert it",
    ),
    "least version": (
        lambda w: w.header.update(asset={"version": "2.0", "minVersion": "2.9"}),
        "version 2.9: expected 2.0",
    ),
    "in itself": (
        as_nodes({"children": [1]}, {"children": [2]}, {"children": [1]}),
        "lies both in",
    ),
    "a cycle": (as_nodes({"mesh": 0}, {"children": [2]}, {"children": [1]}), "lie in themselves"),
    "its own child": (as_nodes({"children": [0]}), "lie in themselves"),
    "two parents": (
        as_nodes({"children": [1, 2]}, {"children": [2]}, {}),
        "lies both in node 0 and",
    ),
    "no such child": (as_nodes({"children": [7]}), "has a child 7, and there are 1"),
    "no such mesh": (as_nodes({"mesh": 3}), "refers to mesh 3, and has 1"),
    "too deep": (
        as_nodes(*({"children": [k + 1]} for k in range(5000)), {"mesh": 0}),
        "more than 4096 levels deep",
    ),
    "no node": (as_nodes({}), "no triangles: its 1 meshes are in no node"),
    "billions of nothing": (
        with_zeros(1 << 40),
        "accessor 1 has 1,099,511,627,776 rows of no data",
    ),
    "a type": (
        lambda w: w.header.update(nodes=[{"mesh": "a"}]),
        r"Expected `int .*nodes\[0\].mesh",
    ),
    "a strip of no data": (lambda w: w.header["bufferViews"][1].update(byteLength=4), "cut short"),
    "a buffer of 2 GB": (
        lambda w: w.header.update(buffers=[{"byteLength": 1 << 31}]),
        "buffer 0 has .* bytes of 2,147,483,648: it is cut short",
    ),
    "five corners": (
        lambda w: w.primitive.update(indices=w.add(np.zeros(5, "u1"))),
        "mesh 0: 5 corners of triangles: expected a multiple of 3",
    ),
    "no positions": (lambda w: w.primitive.update(attributes={}), "triangles have no POSITION"),
    "a mode": (lambda w: w.primitive.update(mode=7), "has a mode 7: expected 0 to 6"),
}


@pytest.mark.parametrize(("change", "told"), REFUSED.values(), ids=REFUSED.keys())
def test_what_is_not_read_is_refused_by_name(tmp_path: Path, change: Change, told: str) -> None:
    writer = Writer()
    change(writer)
    with pytest.raises(GeometryError, match=told):
        read(writer, tmp_path)


def test_a_file_of_2_gb_by_its_header_is_cut_short(tmp_path: Path) -> None:
    content = Writer().glb()
    (tmp_path / "a.glb").write_bytes(content[:8] + struct.pack("<I", 1 << 31) + content[12:])
    with pytest.raises(GeometryError, match="bytes of 2,147,483,648: it is cut short"):
        read_mesh(tmp_path / "a.glb")


def test_too_many_triangles_by_reference_are_refused(tmp_path: Path) -> None:
    """A hundred thousand triangles, ten thousand times."""
    writer = Writer()
    writer.primitive["indices"] = writer.add(np.zeros(300_000, "u1"))
    writer.header["nodes"] = [{"mesh": 0} for _ in range(10_000)]
    writer.header["scenes"] = [{"nodes": list(range(10_000))}]
    with pytest.raises(
        GeometryError, match="more than 67,108,864 triangles, all instances counted"
    ):
        read(writer, tmp_path)
