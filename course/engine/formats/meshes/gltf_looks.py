"""What of a glTF material counts although the scene has materials of its own: where on a picture its vertices lie."""

import math
from typing import Annotated, Final

import msgspec
import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.meshes.gltf_data import Data, item
from course.engine.formats.meshes.gltf_json import Material, Primitive, TextureOf

TRANSFORM: Final = "KHR_texture_transform"

Two = tuple[float, float]


class Moved(msgspec.Struct, frozen=True):
    """How KHR_texture_transform changes texture coordinates; v runs downwards."""

    offset: Two = (0.0, 0.0)
    rotation: float = 0.0
    scale: Two = (1.0, 1.0)
    texCoord: Annotated[int, msgspec.Meta(ge=0)] | None = None  # noqa: N815


def material_of(data: Data, primitive: Primitive) -> Material:
    """The material of a primitive, one without anything where it has none."""
    if primitive.material is None:
        return Material()
    return item(data.root.materials, primitive.material, "material")


def name_of(data: Data, primitive: Primitive) -> str:
    """The name of a primitive's material, "" where it has none."""
    return material_of(data, primitive).name or (
        "" if primitive.material is None else f"material {primitive.material}"
    )


def uv_of(data: Data, primitive: Primitive) -> tuple[Floats64 | None, list[str]]:
    """Texture coordinates (V, 2), v upwards, as its material's picture has them, None for none; and what is told.

    Of several pictures that have different ones those of its colour count, or else the first of the others.
    """
    material = material_of(data, primitive)
    pictures = [each for each in material.pictures() if each is not None]
    uses = [_use(each) for each in pictures] or [(0, Moved())]
    number, moved = uses[0]
    notes = []
    if any(use != uses[0] for use in uses):
        notes.append(
            f"pictures of its material {name_of(data, primitive)[:40]!r} have different texture coordinates: those of"
            " its colour are taken for all"
        )
    names = primitive.attributes
    if f"TEXCOORD_{number}" not in names:
        if "TEXCOORD_0" not in names:
            return None, []
        notes.append(
            f"it has no TEXCOORD_{number}, which its material asks for: TEXCOORD_0 is taken"
        )
        number = 0
    accessor = names[f"TEXCOORD_{number}"]
    values, normalized = data.values(accessor, 2)
    uv = np.array(data.floats(accessor, 2), np.float64)
    # Without the extension integers stand for 0 to 1 in any case.
    quantised = "KHR_mesh_quantization" in data.root.extensionsUsed
    if values.dtype.kind == "u" and not normalized and not quantised:
        uv /= np.iinfo(values.dtype).max
    if moved != Moved():
        # By this angle a picture turns clockwise under them.
        cosine, sine = math.cos(moved.rotation), math.sin(moved.rotation)
        uv = uv * moved.scale @ np.array([[cosine, -sine], [sine, cosine]]) + moved.offset
    # v runs down from the picture's top row.
    uv[:, 1] = 1.0 - uv[:, 1]
    return uv, notes


def _use(picture: TextureOf) -> tuple[int, Moved]:
    """Which coordinates a picture has, and how they are changed."""
    try:
        moved = msgspec.convert(picture.extensions.get(TRANSFORM, {}), Moved)
    except msgspec.ValidationError as error:
        raise ValueError(f"{TRANSFORM} of a material: {error}") from None
    number = picture.texCoord if moved.texCoord is None else moved.texCoord
    return number, msgspec.structs.replace(moved, texCoord=None)


def cut_out(material: Material) -> bool:
    """Whether the file shows a surface with holes, or lets light through it by alpha."""
    return material.alphaMode != "OPAQUE"
