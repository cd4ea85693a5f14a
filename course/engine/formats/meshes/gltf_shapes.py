"""Primitives of a glTF file as triangles at rest: morphed by their weights, and moved by their joints."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats, Floats64, Indices
from course.engine.formats.meshes.gltf_data import Data
from course.engine.formats.meshes.gltf_json import Primitive, Skin
from course.engine.formats.meshes.gltf_looks import cut_out, material_of, name_of, uv_of
from course.engine.formats.meshes.parts import FilePart


def triangles_of(data: Data, primitive: Primitive, vertices: int) -> Indices:
    """The triangles (T, 3) of a primitive whose mode is triangles, a strip or a fan (glTF 2.0, 3.7.2.1)."""
    if primitive.indices is None:
        order: NDArray[np.int64] = np.arange(vertices)
    else:
        values, _ = data.values(primitive.indices, 1)
        if values.dtype.kind != "u":
            raise ValueError("indices are no whole numbers without a sign")
        order = values.ravel().astype(np.int64)
    if primitive.mode == 4:
        if len(order) % 3:
            raise ValueError(f"{len(order)} corners of triangles: expected a multiple of 3")
        return order.reshape(-1, 3)
    k = np.arange(max(0, len(order) - 2))
    if primitive.mode == 6:
        return order[np.stack([k + 1, k + 2, 0 * k], axis=1)]
    odd = k % 2
    return order[np.stack([k, k + 1 + odd, k + 2 - odd], axis=1)]


def part_of(
    data: Data, primitive: Primitive, weights: list[float], skin: "Joints | None"
) -> FilePart:
    """The part of a primitive of triangles.

    Parameters
    ----------
    weights : of its morph targets
    skin : the joints that move it, None where its node does
    """
    names = primitive.attributes
    if "POSITION" not in names:
        raise ValueError("triangles have no POSITION")
    vertices = data.floats(names["POSITION"], 3)
    normals = data.floats(names["NORMAL"], 3) if "NORMAL" in names else None
    uv, notes = uv_of(data, primitive)
    triangles = triangles_of(data, primitive, len(vertices))
    for target, weight in zip(primitive.targets, weights, strict=False):
        if weight and "POSITION" in target:
            vertices = vertices + np.float64(weight) * _like(
                vertices, data.floats(target["POSITION"], 3)
            )
        if weight and "NORMAL" in target and normals is not None:
            normals = normals + np.float64(weight) * _like(
                normals, data.floats(target["NORMAL"], 3)
            )
    if skin is not None:
        vertices, normals, mirrored = skin.move(data, names, vertices, normals)
        triangles = triangles[:, ::-1] if mirrored else triangles
    if "COLOR_0" in names:
        notes.append(
            "colours of its vertices are left out; the object's material says what colour it has"
        )
    if cut_out(material_of(data, primitive)):
        notes.append(
            f"alpha of its material {name_of(data, primitive)[:40]!r} is left out: faces are whole, and opaque unless"
            " the object's material says otherwise"
        )
    # Without normals triangles are flat (glTF 2.0, 3.7.2.1).
    return FilePart(vertices, triangles, normals, uv, flat=normals is None, notes=tuple(notes))


def _like(rows: Floats, others: Floats) -> Floats:
    if len(others) != len(rows):
        raise ValueError(f"a morph target has {len(others)} rows for {len(rows)} vertices")
    return others


@dataclass(frozen=True)
class Joints:
    """What moves the vertices of a skin.

    Attributes
    ----------
    matrices : (J, 4, 4), from the mesh's frame at binding to the file's, one for each joint
    """

    matrices: Floats64

    @classmethod
    def of(cls, data: Data, skin: Skin, places: Floats64) -> "Joints":
        """The joints of a skin; ``places``: matrices (N, 4, 4) of all nodes."""
        if not skin.joints or max(skin.joints) >= len(places):
            raise ValueError("a skin has no joints, or one that is no node")
        matrices = places[skin.joints]
        if skin.inverseBindMatrices is not None:
            binding = data.floats(skin.inverseBindMatrices, 16).reshape(-1, 4, 4)
            if len(binding) < len(matrices):
                raise ValueError(f"a skin has {len(binding)} matrices for {len(matrices)} joints")
            matrices = matrices @ np.swapaxes(binding[: len(matrices)], 1, 2)
        return cls(matrices)

    def move(
        self, data: Data, names: dict[str, int], vertices: Floats, normals: Floats | None
    ) -> tuple[Floats, Floats | None, bool]:
        """Vertices and normals at rest, and whether they are mirrored.

        Each is moved by the mean of its joints' matrices, by weights that are made to add up to 1.
        """
        blended = np.zeros((len(vertices), 3, 4))
        total = np.zeros(len(vertices))
        k = 0
        while f"JOINTS_{k}" in names:
            joints, _ = data.values(names[f"JOINTS_{k}"], 4)
            weights = data.floats(item_of(names, f"WEIGHTS_{k}"), 4)
            if (
                joints.dtype.kind != "u"
                or len(joints) != len(vertices)
                or len(weights) != len(vertices)
            ):
                raise ValueError("joints and weights of a skin aren't one for each vertex")
            if joints.size and int(np.where(weights, joints, 0).max()) >= len(self.matrices):
                raise ValueError(
                    f"a vertex has joint {joints.max()}, and there are {len(self.matrices)}"
                )
            for column in range(4):
                weight = weights[:, column]
                which = np.where(weight != 0, joints[:, column], 0)
                blended += weight[:, None, None] * self.matrices[which, :3]
                total += weight
            k += 1
        if not k:
            raise ValueError("a mesh with a skin has no JOINTS_0")
        # What no joint has stands where the first one takes it, as viewers show it.
        blended[total == 0] = self.matrices[0, :3]
        blended /= np.where(total == 0, 1.0, total)[:, None, None]
        moved = np.einsum("vij,vj->vi", blended[:, :, :3], vertices) + blended[:, :, 3]
        r0, r1, r2 = np.moveaxis(blended[:, :, :3], 1, 0)
        cofactors = np.stack([np.cross(r1, r2), np.cross(r2, r0), np.cross(r0, r1)], axis=1)
        sign = np.sign(np.sum(r0 * cofactors[:, 0], axis=1))
        if normals is not None:
            normals = np.einsum("vij,vj->vi", cofactors, normals) * sign[:, None]
        return moved, normals, bool(len(sign) and np.median(sign) < 0)


def item_of(names: dict[str, int], name: str) -> int:
    """The accessor of an attribute."""
    if name not in names:
        raise ValueError(f"a primitive has no {name}")
    return names[name]
