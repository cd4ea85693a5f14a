"""`Textures` and `TexCoordData`: pictures in the place of diffuse reflectances, written as this course has them.

METU's codes are reflectances over a `Normalizer`, without sRGB's curve, so a converted picture is an EXR of those. Its
texture coordinates go down, and bilinear texels lie on their upper left corners; this course's go up, and texels lie in
their middles.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

from course.base.errors import SceneError
from course.engine.core.types import Floats64
from course.engine.formats.metu.element import MetuElement
from course.engine.formats.metu.materials import DEGAMMA, Body
from course.engine.formats.metu.meshes import MeshTable
from course.engine.formats.pictures.reading import LINEAR, read_picture
from course.engine.formats.yaml.document import show
from course.engine.formats.yaml.suggestions import suggest
from course.engine.shapes.mesh import Mesh

KINDS: Final = {
    "replace_all": "color",
    "replace_kd": "color",
    "blend_kd": "color",
    "replace_ks": "highlight",
    "replace_normal": "normals",
    "bump_normal": "normals",
    "replace_background": "background",
}
"""Those that can, and what they paint; in that order they change a material."""

OF_PERLIN: Final = ("replace_all", "replace_kd", "bump_normal")

WHITE: Final = 255.0
"""Radiance that is shown as white."""

CONVERSIONS: Final = {"linear": "linear", "absval": "absolute"}

HALF_A_TEXEL: Final = "it is off by half a texel"

PASTED: Final[dict[str, Any]] = {"color": 1.0, "unlit": WHITE}
"""A material that shows its picture as it is."""


@dataclass(frozen=True)
class TextureMap:
    """A `TextureMap`.

    Attributes
    ----------
    element : itself
    number : its id
    file : the picture
    mode : `DecalMode`
    between : `Interpolation`
    normalizer : what the picture's values are divided by
    noise : of type perlin, in the place of a picture, the keys of a material's `noise`
    height : of bumps, that of a code, or of a noise, of 1
    degamma : true if the values over the normalizer are codes of a screen
    """

    element: MetuElement
    number: str
    file: Path
    mode: str
    between: str
    normalizer: float
    noise: dict[str, Any] | None = None
    height: float = 1.0
    degamma: bool = False

    @property
    def has_places(self) -> bool:
        """True if it needs texture coordinates."""
        return self.noise is None

    @property
    def kind(self) -> str:
        """What it paints: color, highlight, normals or background."""
        return KINDS[self.mode]

    @property
    def pasted(self) -> bool:
        """True if its codes are seen as they are."""
        return self.mode in ("replace_all", "replace_background")

    @property
    def is_reflectance(self) -> bool:
        """True for a picture of reflectances, which a material's own ones are like."""
        return self.kind in ("color", "highlight") and not self.pasted and self.noise is None

    @property
    def nearest(self) -> bool:
        """True if a place has the values of one texel; the slopes of bumps need more."""
        return self.between == "nearest" and self.mode != "bump_normal"

    @property
    def linear(self) -> bool:
        """True for a picture of numbers, which aren't codes up to 255."""
        return self.file.suffix.lower() in LINEAR

    def picture(self) -> Floats64:
        """The values over the normalizer, or of normals, bumps and what is pasted as codes from 0 to 1, (H, W, 3)."""
        try:
            found = read_picture(self.file, codes=True)
        except (SceneError, ValueError) as error:
            raise self.element.error(f"its picture can't be used: {error}") from None
        # METU counts codes to 255, whatever the depth; in float32 the product is exact for 8 bits.
        codes = found if self.linear else found * np.float32(255)
        values: Floats64 = codes.astype(np.float64) / self.normalizer
        if self.kind == "normals" or self.pasted:
            values = found.astype(np.float64)
        if self.mode == "replace_normal":
            # Green is along v, which goes down there, and up here.
            values[..., 1] = 1 - values[..., 1]
        if values.max(initial=0) > 1 and not self.pasted:
            raise self.element.error(
                f"{show(self.file.name)} over its Normalizer, {self.normalizer:g}, goes up to {values.max():g}:"
                " expected reflectances up to 1"
            )
        return values**DEGAMMA if self.degamma and self.is_reflectance else values

    def remarks(self) -> Iterator[str]:
        """What differs from METU's pictures, whatever object has it."""
        bumpy = self.mode == "bump_normal"
        if self.degamma and not self.is_reflectance:
            yield "has degamma, which counts for pictures of reflectances only, and was left out"
        if self.noise is not None:
            yield (
                "is Perlin's noise: its grains lie elsewhere than in other renderers, for the format doesn't say"
                " which table of numbers there is"
            )
        elif self.between == "trilinear" and self.kind in ("color", "highlight"):
            yield (
                "is trilinear, and the format doesn't say which level a place has: here it is that of the area that"
                " a pixel of the render covers"
            )
        elif self.between == "trilinear" and not bumpy:
            yield "is trilinear, and only textures of reflectances have levels here: it is bilinear"
        if bumpy:
            yield (
                "is a bump map: its heights, BumpFactor times a value over Normalizer, are taken for lengths of the"
                " object's own unit"
                + (
                    ""
                    if self.noise is not None or self.between == "bilinear"
                    else ", and are bilinear"
                )
            )


@dataclass
class Textures:
    """The textures of a scene, and the materials that objects have by them.

    Attributes
    ----------
    maps : by id; an element stands for one that can't be converted, which is refused where it is used
    places : (P, 2) texture coordinates of the scene, as METU has them
    ambient : (3,) sum of the ambient lights
    bodies : of each material
    files : where pictures are written
    made : the materials by name
    """

    maps: dict[str, "TextureMap | Refused"]
    places: Floats64
    ambient: Floats64
    bodies: dict[str, Body]
    files: MeshTable
    made: dict[str, dict[str, Any]] = field(default_factory=dict)
    _sizes: dict[str, tuple[int, int]] = field(default_factory=dict)
    _told: set[str] = field(default_factory=set)

    def of(self, thing: MetuElement) -> list[TextureMap]:
        """The textures of an object, of each kind at most one; SceneError for one that can't be converted."""
        element = thing.maybe("Textures")
        names = [] if element is None else element.words()
        found = []
        for name in names:
            assert element is not None
            if name not in self.maps:
                raise element.unexpected(f"ids of a TextureMap; {name}: {suggest(name, self.maps)}")
            texture = self.maps[name]
            if isinstance(texture, Refused):
                raise texture.error(f"; take it from {element.path} to render without it")
            if texture.kind == "background":
                raise element.refused(f"the texture {name} is the background of all objects")
            found.append(texture)
        if len({texture.kind for texture in found}) < len(found):
            assert element is not None
            raise element.refused(
                "an object of this course has one texture of its colour, one of its highlight, and one normal map or"
                " bump map; leave one of each"
            )
        found.sort(key=lambda texture: list(KINDS).index(texture.mode))
        if len(found) > 1 and found[0].mode == "replace_all":
            assert element is not None
            left = " and ".join(texture.number for texture in found[1:])
            self.files.notes.add(
                element, f"has one that replaces all, under which {left} is not seen"
            )
            return found[:1]
        return found

    def background(self, instead: MetuElement | None) -> dict[str, Any] | None:
        """The environment that a texture is for the camera; None where none is.

        ``instead``: another environment, beside which there can't be one.
        """
        found = [
            each
            for each in self.maps.values()
            if isinstance(each, TextureMap) and each.kind == "background"
        ]
        if not found:
            return None
        if len(found) > 1 or instead is not None:
            other = found[1].element.path if len(found) > 1 else instead and instead.path
            raise found[0].element.refused(f"its DecalMode is replace_background, beside {other}")
        texture = found[0]
        file = self.files.add_picture(texture.picture().astype(np.float32), "background")
        scale = 1.0 if texture.linear else WHITE
        self._tell(texture)
        if not texture.nearest:
            self.files.notes.add(
                texture.element, f"is the background, and not nearest: {HALF_A_TEXEL}"
            )
        drawn = {"interpolation": "nearest"} if texture.nearest else {}
        return {"type": "backdrop", "image": file, "scale": scale} | drawn

    def material(self, textures: list[TextureMap], number: str, keys: dict[str, Any]) -> str:
        """The name of a material with textures; ``keys`` are those that it has without."""
        numbers = " and ".join(texture.number for texture in textures)
        name = f"material {number} with texture {numbers}"
        if name not in self.made:
            for texture in textures:
                keys = self._with(texture, number, keys)
            self.made[name] = keys
        return name

    def _with(self, texture: TextureMap, number: str, keys: dict[str, Any]) -> dict[str, Any]:
        body = self.bodies[number]
        self._tell(texture)
        if body.degamma and texture.is_reflectance and not texture.degamma:
            self.files.notes.add(
                texture.element,
                f"is on material {number}, whose degamma counts for the material's own reflectances: the texture has"
                " none, so its values are taken as they are",
            )
        if texture.noise is not None and texture.mode == "bump_normal":
            return keys | {"bump": {"noise": texture.noise, "height": texture.height}}
        if texture.noise is not None:
            pasted = texture.mode == "replace_all"
            painted = PASTED if pasted else self._painted(keys, body.by)
            return painted | {"noise": texture.noise}
        picture = texture.picture()
        self._sizes[texture.number] = picture.shape[1], picture.shape[0]
        stem = f"texture-{len(self.made) + 1}"
        if texture.kind == "normals":
            file = self.files.add_picture(picture.astype(np.float32), f"{stem}-normals")
            if texture.mode == "replace_normal":
                drawn = {"interpolation": "nearest"} if texture.nearest else {}
                return keys | {"normal_map": {"image": file} | drawn}
            height = texture.height * (1.0 if texture.linear else 255.0) / texture.normalizer
            return keys | {"bump": {"image": file, "height": height}}
        if texture.mode == "blend_kd":
            picture = (picture + np.array(body.diffuse)) / 2
            if picture.max() > 1:
                raise texture.element.error("blended with the DiffuseReflectance it goes above 1")
        brightest = max(1.0, float(picture.max(initial=0)))
        stem = f"{stem}-highlights" if texture.kind == "highlight" else stem
        file = self.files.add_picture((picture / brightest).astype(np.float32), stem)
        drawn = {"image": file}
        if texture.between != "bilinear":
            drawn["interpolation"] = texture.between
        if texture.kind == "highlight":
            return keys | body.highlight | {"specular_texture": drawn}
        if texture.mode == "replace_all":
            white = brightest if texture.linear else WHITE
            return PASTED | {"unlit": white, "texture": drawn}
        return self._painted(keys, body.by) | {"texture": drawn}

    def _tell(self, texture: TextureMap) -> None:
        """What there is to say of a texture, once."""
        if texture.number not in self._told:
            self._told.add(texture.number)
            for remark in texture.remarks():
                self.files.notes.add(texture.element, remark)

    def tell_of_sphere(self, textures: list[TextureMap]) -> None:
        """Where they lie on a ball is no more than half a texel off."""
        for texture in textures:
            if texture.has_places and not texture.nearest:
                self.files.notes.add(
                    texture.element, f"is on a Sphere, and not nearest: {HALF_A_TEXEL}"
                )

    def _painted(self, keys: dict[str, Any], by: float) -> dict[str, Any]:
        """The keys of a material whose texture is all of its diffuse reflectance."""
        of_ambient = np.array(keys.get("ambient_color", keys["color"])) * keys.get("ambient", 1.0)
        left = {k: v for k, v in keys.items() if k not in ("ambient_color", "ambient", "diffuse")}
        # A texture would paint the ambient term, too; as an emission it is the same from place to place.
        return left | {
            "color": 1.0,
            "diffuse": by,
            "ambient": 0.0,
            "emission": (of_ambient * self.ambient).tolist(),
        }

    def placed(self, textures: list[TextureMap], mesh: Mesh) -> Mesh:
        """A mesh whose uv are METU's, with those of this course; the material of the textures has been asked for.

        ``textures``: they are moved by the texels of the first.
        """
        assert mesh.uv is not None
        u, v = mesh.uv.T
        away, *others = (self._away(texture) for texture in textures)
        for texture, other in zip(textures[1:], others, strict=True):
            if other != away:
                self.files.notes.add(
                    texture.element,
                    f"is on a mesh whose places are moved for the texels of texture {textures[0].number}: it is off"
                    " by up to half a texel of the two",
                )
        uv = np.stack((u + away[0], 1 - v - away[1]), axis=1)
        return Mesh(mesh.vertices, mesh.triangles, mesh.normals, uv)

    def _away(self, texture: TextureMap) -> tuple[float, float]:
        """By how much of u and v the middles of this course's texels are away from the places of METU's."""
        width, height = self._sizes[texture.number]
        return (0.0, 0.0) if texture.nearest else (0.5 / width, 0.5 / height)


@dataclass(frozen=True)
class Refused:
    """A `TextureMap` that can't be converted, and why."""

    element: MetuElement
    why: str

    def error(self, remedy: str) -> SceneError:
        """The error of an object that has it."""
        return self.element.refused(self.why + remedy)


def read_maps(
    scene: MetuElement, images: dict[str, MetuElement], folder: Path
) -> dict[str, TextureMap | Refused]:
    """All texture maps by id.

    Parameters
    ----------
    images : elements that name files, by id
    folder : from which they are named
    """
    parent = scene.maybe("Textures")
    maps: dict[str, TextureMap | Refused] = {}
    for element in () if parent is None else parent.all("TextureMap"):
        number = element.id(maps)
        texture = maps[number] = _map(element, number, images, folder)
        if isinstance(texture, Refused) and _word(element, "DecalMode") == "replace_background":
            raise texture.error("; remove it to render without it")
    return maps


def _map(
    element: MetuElement, number: str, images: dict[str, MetuElement], folder: Path
) -> TextureMap | Refused:
    kind, mode = element.attribute("type") or "image", _word(element, "DecalMode") or "replace_kd"
    between = _word(element, "Interpolation") or "nearest"
    scale = element.maybe("Normalizer")
    normalizer = 255.0 if scale is None else scale.number(0, above=True)
    for tag in ("ImageId", "NoiseScale", "NoiseConversion"):
        _word(element, tag)
    degamma = element.flag("degamma")
    factor = element.maybe("BumpFactor")
    height = 1.0 if factor is None else factor.numbers(1, "10")[0]
    if kind not in ("image", "perlin"):
        return Refused(element, f"its type is {show(kind)}, and those known are image and perlin")
    if mode not in KINDS:
        known = f"those that can be converted are {', '.join(KINDS)}"
        return Refused(element, f"its DecalMode is {show(mode)}: {known}")
    if kind == "perlin":
        return _noise(element, number, mode, height, degamma)
    if between not in ("nearest", "bilinear", "trilinear"):
        return Refused(
            element,
            f"its Interpolation is {show(between)}: expected nearest, bilinear or trilinear",
        )
    image = element.child("ImageId", "the id of an Image")
    name = " ".join(image.words())
    if name not in images:
        raise image.unexpected(f"the id of an Image; {suggest(name, images)}")
    file = " ".join(images[name].words())
    path = folder / file.replace("\\", "/")
    return TextureMap(element, number, path, mode, between, normalizer, None, height, degamma)


def _noise(
    element: MetuElement, number: str, mode: str, height: float, degamma: bool
) -> TextureMap | Refused:
    if mode not in OF_PERLIN:
        return Refused(
            element,
            f"its type is perlin with DecalMode {mode}: {', '.join(OF_PERLIN)} can be converted",
        )
    conversion = _word(element, "NoiseConversion") or "linear"
    if conversion not in CONVERSIONS:
        raise element.child("NoiseConversion", "linear").unexpected("linear or absval")
    scale = element.maybe("NoiseScale")
    keys = {
        "scale": 1.0 if scale is None else scale.number(0, above=True),
        "conversion": CONVERSIONS[conversion],
    }
    return TextureMap(element, number, Path(), mode, "bilinear", 1.0, keys, height, degamma)


def _word(element: MetuElement, tag: str) -> str:
    child = element.maybe(tag)
    return "" if child is None else " ".join(child.words())


def read_places(scene: MetuElement) -> Floats64:
    """`TexCoordData`, (P, 2)."""
    element = scene.maybe("TexCoordData")
    if element is None or not element.text.strip():
        return np.zeros((0, 2))
    element.attribute("type")
    values = element.many("u and v of each vertex")
    if len(values) % 2:
        raise element.error(f"has {len(values)} numbers: expected two for each vertex")
    return values.reshape(-1, 2)
