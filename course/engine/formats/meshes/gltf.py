"""GLB and glTF 2.0 bytes to `FilePart`s: what the file's scene shows, at rest.

This is code of our own over the JSON because a file is to be read as it is written, or refused by what it needs.
trimesh 5.2 takes normalised integers for plain ones, moves skinned meshes by their nodes, and reads no morph weights,
fans and instances.

The format: Khronos Group, "glTF 2.0 specification", 2021. Extensions are read by an allow-list: `gltf_json`.
"""

import struct
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Final
from urllib.parse import unquote

import numpy as np

from course.base.errors import CourseError
from course.base.inputs import LARGEST_DATA, InputLimit, read_input
from course.engine.core.types import Floats64
from course.engine.formats.meshes.beside import Beside
from course.engine.formats.meshes.gltf_data import Data, item
from course.engine.formats.meshes.gltf_json import Node, Primitive, read_root
from course.engine.formats.meshes.gltf_looks import name_of
from course.engine.formats.meshes.gltf_nodes import Tree, placed, tree_of
from course.engine.formats.meshes.gltf_shapes import Joints, part_of
from course.engine.formats.meshes.parts import FilePart

MOST_PARTS: Final = 1 << 16
"""Primitives of all meshes that are shown."""

MOST_TRIANGLES: Final = 1 << 26
"""All instances counted."""

INSTANCING: Final = "EXT_mesh_gpu_instancing"


def parse_glb(data: bytes, beside: Beside) -> list[FilePart]:
    """Return the parts of a GLB file, one for each primitive, or for each time that a skin moves one.

    Raises ValueError for what isn't GLB 2, needs an extension that isn't known, or is cut short, and for nodes that are
    no tree.
    """
    if len(data) < 20 or data[:4] != b"glTF":
        raise ValueError("it doesn't begin as a GLB file does")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise ValueError(f"it is GLB of version {version}: expected 2")
    if length > len(data):
        raise ValueError(f"it has {len(data):,} bytes of {length:,}: it is cut short")
    chunks = dict(reversed(list(_chunks(memoryview(data)[:length]))))
    if b"JSON" not in chunks:
        raise ValueError("its JSON chunk is missing or cut short")
    return _parts(bytes(chunks[b"JSON"]), chunks.get(b"BIN\0"), beside)


def files_beside(path: Path) -> list[str]:
    """Names of the files that a GLB or glTF file takes buffers from, relative to its folder; none of any other file.

    A file that can't be read has none: whoever reads it tells why.
    """
    if path.suffix.lower() not in (".glb", ".gltf"):
        return []
    try:
        data = read_input(path, "mesh file", InputLimit(LARGEST_DATA))
        if data[:4] == b"glTF":
            data = bytes(dict(reversed(list(_chunks(memoryview(data)))))[b"JSON"])
        root, _ = read_root(data)
    except (CourseError, ValueError, KeyError):
        return []
    uris = (buffer.uri for buffer in root.buffers if buffer.uri is not None)
    return [unquote(uri) for uri in uris if uri[:5].lower() != "data:"]


def parse_gltf(data: bytes, beside: Beside) -> list[FilePart]:
    """Return the same of a glTF file, whose buffers are in files beside it or in its text."""
    return _parts(data, None, beside)


def _chunks(data: memoryview) -> Iterator[tuple[bytes, memoryview]]:
    at = 12
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + length > len(data):
            raise ValueError(f"its {kind.decode('latin-1').strip()} chunk is cut short")
        yield kind, data[at + 8 : at + 8 + length]
        at += 8 + length


def _parts(text: bytes, binary: memoryview | None, beside: Beside) -> list[FilePart]:
    root, notes = read_root(text)
    data = Data(root, binary, beside)
    tree, more = tree_of(root)
    notes += more
    left_out = 0
    parts: list[FilePart] = []
    triangles = 0
    for mesh, weights, skin, places in _shown(data, tree):
        for primitive in item(root.meshes, mesh, "mesh").primitives:
            if primitive.mode not in range(7):
                raise ValueError(f"mesh {mesh} has a mode {primitive.mode}: expected 0 to 6")
            if primitive.mode < 4:
                left_out += 1
                continue
            if "KHR_draco_mesh_compression" in primitive.extensions and not primitive.attributes:
                raise ValueError("its meshes are compressed; export it without compression")
            if len(parts) == MOST_PARTS:
                raise ValueError(f"it shows more than {MOST_PARTS:,} meshes: join some of them")
            part = _part(data, primitive, weights, skin, mesh)
            triangles += len(part.triangles) * len(places)
            if triangles > MOST_TRIANGLES:
                raise ValueError(
                    f"it shows more than {MOST_TRIANGLES:,} triangles, all instances counted"
                )
            if len(part.triangles):
                parts.append(replace(part, places=places))
    if left_out:
        notes.append(f"meshes of points and lines have no surface, and are left out: {left_out:,}")
    if not parts:
        shown = sum(node.mesh is not None for node in root.nodes)
        there = (
            f": its {len(root.meshes)} meshes are in no node" if root.meshes and not shown else ""
        )
        raise ValueError(f"no triangles{there}{''.join(f'; {note}' for note in notes)}")
    return [replace(parts[0], notes=(*notes, *parts[0].notes)), *parts[1:]]


def _part(
    data: Data, primitive: Primitive, weights: list[float], skin: Joints | None, mesh: int
) -> FilePart:
    try:
        part = part_of(data, primitive, weights, skin)
    except ValueError as error:
        raise ValueError(f"mesh {mesh}: {error}") from None
    name = name_of(data, primitive)
    if not name:
        return part
    return replace(part, names=(name,), name=np.zeros(len(part.triangles), np.intp))


def _shown(data: Data, tree: Tree) -> Iterator[tuple[int, list[float], Joints | None, Floats64]]:
    """Meshes of the scene's nodes with weights and joints, and all matrices (K, 4, 4) with which each is there."""
    nodes = data.root.nodes
    places: dict[tuple[int, tuple[float, ...]], list[tuple[int, Floats64]]] = {}
    for number in np.flatnonzero(tree.shown).tolist():
        node = nodes[number]
        if node.mesh is None:
            continue
        weights = node.weights
        if weights is None:
            weights = item(data.root.meshes, node.mesh, "mesh").weights
        if node.skin is not None:
            # Its node moves it nowhere (glTF 2.0, 3.7.3.2).
            skin = item(data.root.skins, node.skin, "skin")
            yield node.mesh, weights, Joints.of(data, skin, tree.matrices), np.eye(4)[None]
            continue
        own = tree.matrices[number][None]
        if INSTANCING in node.extensions:
            own = own @ _instances(data, node)
        places.setdefault((node.mesh, tuple(weights)), []).append((number, own))
    for (mesh, of), listed in places.items():
        if len(matrices := _with_area(listed)):
            yield mesh, list(of), None, matrices


def _with_area(listed: list[tuple[int, Floats64]]) -> Floats64:
    """The matrices (K, 4, 4) of nodes that leave faces an area; ValueError for a node that makes its mesh flat."""
    matrices = np.concatenate([own for _, own in listed])
    rows = matrices[:, :3, :3]
    # A scale of 0 in all directions, or in two, is how programs hide a node: no point or line is seen.
    hidden = ~np.cross(rows, np.roll(rows, -1, axis=1)).any(axis=(1, 2))
    flat = ~hidden & (np.linalg.slogdet(rows).sign == 0)
    if flat.any():
        number = np.repeat([k for k, _ in listed], [len(own) for _, own in listed])[np.argmax(flat)]
        raise ValueError(
            f"node {number}: its matrix can't be inverted, and flattens its mesh; give it another scale than 0"
        )
    return matrices[~hidden]


def _instances(data: Data, node: Node) -> Floats64:
    """Matrices (K, 4, 4) of a node's instances."""
    found: Any = node.extensions[INSTANCING]
    names = found.get("attributes") if isinstance(found, dict) else None
    if not isinstance(names, dict) or not all(type(k) is int and k >= 0 for k in names.values()):
        raise ValueError(f"{INSTANCING} of a node has no attributes")
    of = {
        name: data.floats(names[name], width)
        for name, width in (("TRANSLATION", 3), ("ROTATION", 4), ("SCALE", 3))
        if name in names
    }
    counts = {len(rows) for rows in of.values()}
    if len(counts) != 1:
        raise ValueError(f"{INSTANCING} of a node has attributes of {sorted(counts)} instances")
    count = counts.pop()
    if count > MOST_TRIANGLES:
        raise ValueError(f"a node has {count:,} instances: more than {MOST_TRIANGLES:,}")
    return placed(
        of.get("TRANSLATION", np.zeros((count, 3))),
        of.get("ROTATION", np.tile([0.0, 0.0, 0.0, 1.0], (count, 1))),
        of.get("SCALE", np.ones((count, 3))),
    )
