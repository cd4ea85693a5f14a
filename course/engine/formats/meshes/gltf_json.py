"""The JSON of glTF 2.0, so far as it says which triangles there are and where; and which extensions are heeded.

Whatever else a file holds, such as lights, cameras and most of its materials, a scene file says by itself.
"""

from typing import Annotated, Any, Final

import msgspec

from course.base.inputs import without_marks

HEEDED: Final = frozenset(
    (
        "KHR_mesh_quantization",
        "EXT_mesh_gpu_instancing",
        "KHR_node_visibility",
        "KHR_texture_transform",
    )
)
"""Extensions of geometry, or of places on pictures, that are read."""

OF_LOOKS: Final = frozenset(
    (
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "EXT_texture_avif",
        "MSFT_texture_dds",
        "KHR_lights_punctual",
        "EXT_lights_image_based",
        "KHR_xmp",
        "KHR_xmp_json_ld",
        "KHR_animation_pointer",
        "MSFT_packing_occlusionRoughnessMetallic",
        "MSFT_packing_normalRoughnessMetallic",
        "FB_geometry_metadata",
        "GOOGLE_backgrounds",
        "VRM",
        "VRMC_vrm",
        "VRMC_springBone",
    )
)
"""Extensions that change no triangle at rest, but materials, pictures, lights or what is known about a file."""

MATERIALS: Final = ("KHR_materials_", "ADOBE_materials_", "EXT_materials_", "VRMC_materials_")

REMEDIES: Final = {
    "KHR_draco_mesh_compression": "export it without compression",
    "EXT_meshopt_compression": "export it without compression",
    "KHR_meshopt_compression": "export it without compression",
}

Index = Annotated[int, msgspec.Meta(ge=0)]
Three = tuple[float, float, float]
Extensions = dict[str, Any]


class TextureOf(msgspec.Struct, frozen=True):
    """A picture of a material."""

    texCoord: Index = 0  # noqa: N815
    extensions: Extensions = {}


class Metal(msgspec.Struct, frozen=True):
    """A material's colour, by pictures."""

    baseColorTexture: TextureOf | None = None  # noqa: N815
    metallicRoughnessTexture: TextureOf | None = None  # noqa: N815


class Material(msgspec.Struct, frozen=True):
    """A material, so far as geometry needs it."""

    name: str = ""
    alphaMode: str = "OPAQUE"  # noqa: N815
    pbrMetallicRoughness: Metal = Metal()  # noqa: N815
    normalTexture: TextureOf | None = None  # noqa: N815
    emissiveTexture: TextureOf | None = None  # noqa: N815
    occlusionTexture: TextureOf | None = None  # noqa: N815

    def pictures(self) -> tuple[TextureOf | None, ...]:
        """Of its colour first."""
        surface = self.pbrMetallicRoughness
        return (
            surface.baseColorTexture,
            surface.metallicRoughnessTexture,
            self.normalTexture,
            self.emissiveTexture,
            self.occlusionTexture,
        )


class Asset(msgspec.Struct, frozen=True):
    """About the file."""

    version: str
    minVersion: str | None = None  # noqa: N815


class OldAsset(msgspec.Struct, frozen=True):
    """About a file of the first version, of which some programs wrote a number."""

    version: str | float


class Version(msgspec.Struct, frozen=True):
    """A file of which only the version is asked."""

    asset: OldAsset


class Buffer(msgspec.Struct, frozen=True):
    """Bytes."""

    byteLength: Index  # noqa: N815
    uri: str | None = None


class BufferView(msgspec.Struct, frozen=True):
    """Bytes of a buffer."""

    buffer: Index
    byteLength: Index  # noqa: N815
    byteOffset: Index = 0  # noqa: N815
    byteStride: Index | None = None  # noqa: N815
    extensions: Extensions = {}


class SparseIndices(msgspec.Struct, frozen=True):
    """Which elements have other values."""

    bufferView: Index  # noqa: N815
    componentType: int  # noqa: N815
    byteOffset: Index = 0  # noqa: N815


class SparseValues(msgspec.Struct, frozen=True):
    """These values."""

    bufferView: Index  # noqa: N815
    byteOffset: Index = 0  # noqa: N815


class Sparse(msgspec.Struct, frozen=True):
    """Elements of an accessor that have other values than its view."""

    count: Index
    indices: SparseIndices
    values: SparseValues


class Accessor(msgspec.Struct, frozen=True):
    """Numbers in a view."""

    componentType: int  # noqa: N815
    count: Index
    type: str
    bufferView: Index | None = None  # noqa: N815
    byteOffset: Index = 0  # noqa: N815
    normalized: bool = False
    sparse: Sparse | None = None


class Primitive(msgspec.Struct, frozen=True):
    """Points, lines or triangles of one material."""

    attributes: dict[str, Index]
    indices: Index | None = None
    mode: int = 4
    material: Index | None = None
    targets: list[dict[str, Index]] = []
    extensions: Extensions = {}


class MeshOf(msgspec.Struct, frozen=True):
    """Primitives."""

    primitives: list[Primitive]
    weights: list[float] = []


class Node(msgspec.Struct, frozen=True):
    """A place in a tree."""

    children: list[Index] = []
    mesh: Index | None = None
    skin: Index | None = None
    matrix: Annotated[list[float], msgspec.Meta(min_length=16, max_length=16)] | None = None
    translation: Three | None = None
    rotation: tuple[float, float, float, float] | None = None
    scale: Three | None = None
    weights: list[float] | None = None
    extensions: Extensions = {}


class Skin(msgspec.Struct, frozen=True):
    """Nodes that move a mesh."""

    joints: list[Index]
    inverseBindMatrices: Index | None = None  # noqa: N815


class SceneOf(msgspec.Struct, frozen=True):
    """What is seen."""

    nodes: list[Index] = []


class Root(msgspec.Struct, frozen=True):
    """A whole file."""

    asset: Asset
    scene: Index | None = None
    scenes: list[SceneOf] = []
    nodes: list[Node] = []
    meshes: list[MeshOf] = []
    accessors: list[Accessor] = []
    bufferViews: list[BufferView] = []  # noqa: N815
    buffers: list[Buffer] = []
    skins: list[Skin] = []
    materials: list[Material] = []
    animations: list[Any] = []
    extensionsUsed: list[str] = []  # noqa: N815
    extensionsRequired: list[str] = []  # noqa: N815


def read_root(text: bytes) -> tuple[Root, list[str]]:
    """Return the JSON of a file and what is to be told of it.

    Raises ValueError: it is no JSON of glTF 2, or it requires an extension that isn't known.
    """
    plain = without_marks(text, "replace")
    try:
        root = msgspec.json.decode(plain, type=Root)
    except (msgspec.DecodeError, UnicodeError, RecursionError) as error:
        # What stands where was another in version 1.
        if _is_old(plain):
            raise ValueError("it is glTF of version 1: expected 2.0; convert it to that") from None
        raise ValueError(f"its JSON: {error}") from None
    for version in (root.asset.version, root.asset.minVersion or "2.0"):
        if version.partition(".")[0] != "2" or (version != "2.0" and version != root.asset.version):
            raise ValueError(f"it is glTF of version {version[:40]}: expected 2.0")
    for name in root.extensionsRequired:
        if not _known(name):
            remedy = REMEDIES.get(name, "export it without that extension")
            raise ValueError(f"it needs {name[:80]}, which isn't read here; {remedy}")
    unknown = [name for name in root.extensionsUsed if not _known(name)]
    notes = []
    if unknown:
        notes.append(
            f"what its extensions {', '.join(name[:80] for name in unknown[:8])} say isn't read, and may change how it"
            " looks"
        )
    if root.animations:
        notes.append("its animations are left out: it is as it stands at rest")
    return root, notes


def _is_old(text: bytes) -> bool:
    try:
        version = msgspec.json.decode(text, type=Version).asset.version
        return str(version).startswith("1.")
    except (msgspec.DecodeError, UnicodeError, RecursionError):
        return False


def _known(name: str) -> bool:
    return name in HEEDED or name in OF_LOOKS or name.startswith(MATERIALS)
