"""METU's textures: which reflectance each place has, by METU's own formulas for u and v and its texels."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course.base.errors import SceneError
from course.engine.formats.meshes.files import save_ply
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.perlin import noise
from tests.engine.formats.metu.conftest import WALL, Metu, Tree, tree
from tests.engine.formats.pictures.picture_files import png
from tests.lengths import fewer

CODES = np.random.default_rng(7).integers(0, 256, (4, 6, 3), np.uint8)
"""A picture of 4 rows and 6 columns."""

MATT = {"_id": "1", "AmbientReflectance": "0.1 0.2 0.3", "DiffuseReflectance": "0.5 0.25 0"}
SUN = {
    "AmbientLight": "10 10 10",
    "DirectionalLight": {"_id": "1", "Direction": "0 0 -1", "Radiance": "100 100 100"},
}
AMBIENT = np.array([1.0, 2.0, 3.0])
"""What the ambient light adds, whatever the texture."""

CORNERS = "0 1  1 1  1 0  0 0"
"""Texture coordinates of the wall's corners: v goes down."""


def textured(
    folder: Path, *, mode: str = "replace_kd", between: str = "nearest", **more: Any
) -> Tree:
    """The wall, 18 x 18 at z = -4, with the picture."""
    Image.fromarray(CODES).save(folder / "picture.png")
    picture = {"_id": "1", "_type": "image", "ImageId": "5", "DecalMode": mode}
    picture |= {"Interpolation": between, "Normalizer": "255"}
    wall = {"_id": "1", "Material": "1", "Textures": "1", "Faces": "1 2 3 1 3 4"}
    known: dict[str, Any] = {
        "Textures": {
            "Images": {"Image": {"_id": "5", "_data": "picture.png"}},
            "TextureMap": picture,
        },
        "TexCoordData": CORNERS,
        "objects": {"Mesh": wall},
        "materials": [MATT],
        "lights": SUN,
    }
    return tree(**(known | more))


def look(u: float, v: float, **more: Any) -> Tree:
    """A camera that sees the wall at u and v alone."""
    gaze = f"{18 * u - 9} {9 - 18 * v} -4"
    return {"Gaze": gaze, "NearPlane": "-1e-4 1e-4 -1e-4 1e-4", **more}


def nearest(u: float, v: float, codes: Any = CODES) -> Any:
    """METU's: the texel in column floor(u nx) and row floor(v ny)."""
    return codes[int(v * 4) % 4, int(u * 6) % 6] / 255


def bilinear(u: float, v: float, codes: Any = CODES) -> Any:
    """METU's: texels lie on whole numbers of u nx and v ny."""
    i, j = u * 6, v * 4
    p, q = math.floor(i), math.floor(j)
    a, b = i - p, j - q
    t = codes / 255
    return (
        t[q % 4, p % 6] * (1 - a) * (1 - b)
        + t[q % 4, (p + 1) % 6] * a * (1 - b)
        + t[(q + 1) % 4, p % 6] * (1 - a) * b
        + t[(q + 1) % 4, (p + 1) % 6] * a * b
    )


PLACES = [(0.1, 0.1), (0.45, 0.3), (0.7, 0.9), (0.97, 0.55)]


@pytest.mark.parametrize(
    ("between", "found"), [("nearest", nearest), ("bilinear", bilinear), ("trilinear", bilinear)]
)
@pytest.mark.parametrize("place", PLACES)
def test_a_place_has_the_reflectance_of_its_texels(
    xml: Metu, between: str, found: Any, place: tuple[float, float]
) -> None:
    pixel = xml.pixel(textured(xml.folder, between=between, camera=look(*place)))
    np.testing.assert_allclose(pixel, AMBIENT + 100 * found(*place), rtol=1e-3, atol=0.05)


def test_from_afar_a_trilinear_picture_is_its_mean(xml: Metu) -> None:
    """A pixel covers 900 of it."""
    camera = look(*PLACES[0]) | {"NearPlane": "-20 20 -20 20"}
    pixel = xml.pixel(textured(xml.folder, between="trilinear", camera=camera))
    np.testing.assert_allclose(pixel, AMBIENT + 100 * CODES.mean(axis=(0, 1)) / 255, rtol=1e-4)


def test_which_level_a_trilinear_picture_has_is_told(xml: Metu) -> None:
    xml.load(textured(xml.folder, between="trilinear"))
    (warning,) = xml.warnings
    assert "TextureMap is trilinear, and the format doesn't say which level" in warning


@fewer
@pytest.mark.parametrize("mode", ["replace_kd", "blend_kd", "replace_ks"])
@pytest.mark.parametrize("of_texture", [False, True])
@pytest.mark.parametrize("of_material", [False, True])
def test_degamma_is_the_textures_own(
    metu: Metu, mode: str, of_texture: bool, of_material: bool
) -> None:
    """A power of its values, and of the material's reflectances; where the texture has none, a warning says so."""
    lights = {"DirectionalLight": SUN["DirectionalLight"]}
    scene = textured(metu.folder, mode=mode, camera=look(*PLACES[1]), lights=lights)
    scene["Textures"]["TextureMap"] |= {"_degamma": "true"} if of_texture else {}
    matt = MATT | {"SpecularReflectance": "0.5 0.5 0.5", "PhongExponent": "1e-9"}
    scene["Materials"]["Material"] = [matt | ({"_degamma": "true"} if of_material else {})]
    seen = nearest(*PLACES[1]) ** (2.2 if of_texture else 1)
    kd = np.array([0.5, 0.25, 0]) ** (2.2 if of_material else 1)
    ks = 0.5 ** (2.2 if of_material else 1)
    kd, ks = {
        "replace_kd": (seen, ks),
        "blend_kd": ((seen + kd) / 2, ks),
        "replace_ks": (kd, seen),
    }[mode]
    np.testing.assert_allclose(metu.pixel(scene), 100 * (kd + ks), rtol=1e-3, atol=0.01)
    told = "is on material 1, whose degamma counts for the material's own reflectances"
    assert [told in warning for warning in metu.warnings] == [True] * (of_material > of_texture)


@pytest.mark.parametrize("mode", ["replace_all", "replace_normal", "bump_normal", "perlin"])
def test_degamma_of_other_textures_is_left_out_and_a_warning_says_so(xml: Metu, mode: str) -> None:
    scene = textured(xml.folder, mode="replace_kd" if mode == "perlin" else mode)
    kind = {"_type": "perlin"} if mode == "perlin" else {}
    scene["Textures"]["TextureMap"] |= {"_degamma": "true"} | kind
    xml.load(scene)
    assert "TextureMap has degamma, which counts for pictures of reflectances" in xml.warnings[0]


def test_what_lies_half_a_texel_off_is_told(xml: Metu) -> None:
    """Two pictures of unlike texels on one mesh, a bilinear one on a ball, and one of the background."""
    scene = textured(xml.folder)
    table = scene["Textures"]
    maps = [table["TextureMap"] | {"_id": str(number)} for number in range(1, 5)]
    maps[1] |= {"DecalMode": "replace_ks", "Interpolation": "bilinear"}
    maps[2] |= {"Interpolation": "bilinear"}
    maps[3] |= {"DecalMode": "replace_background", "Interpolation": "trilinear"}
    table["TextureMap"] = maps
    scene["Objects"]["Mesh"]["Textures"] = "1 2"
    ball = {"_id": "1", "Material": "1", "Textures": "3", "Center": "1", "Radius": "2"}
    scene["Objects"]["Sphere"] = ball
    xml.load(scene)
    for part in (
        "TextureMap[2] is on a mesh whose places are moved for the texels of texture 1",
        "TextureMap[3] is on a Sphere, and not nearest: it is off by half a texel",
        "TextureMap[4] is the background, and not nearest: it is off by half a texel",
        "TextureMap[4] is trilinear, and only textures of reflectances have levels",
    ):
        assert any(part in warning for warning in xml.warnings)
    assert len(xml.warnings) == 4


def test_blending_is_the_mean_with_the_material(metu: Metu) -> None:
    scene = textured(metu.folder, mode="blend_kd", camera=look(*PLACES[1]))
    expected = (np.array([0.5, 0.25, 0]) + nearest(*PLACES[1])) / 2
    np.testing.assert_allclose(metu.pixel(scene), AMBIENT + 100 * expected, rtol=1e-4, atol=0.01)


def test_codes_of_16_bits_count_to_255_too(xml: Metu) -> None:
    """By 8 bits they would be off by half a code, 0.2."""
    scene = textured(xml.folder, camera=look(*PLACES[1]))
    (xml.folder / "picture.png").write_bytes(png(np.full((4, 6, 3), 25856), 16))
    np.testing.assert_allclose(xml.pixel(scene), AMBIENT + 100 * 25856 / 65535, atol=2e-3)


def test_offsets_count_from_where_they_say(xml: Metu) -> None:
    faces = {"_vertexOffset": "1", "_textureOffset": "2", "_data": "1 2 3 1 3 4"}
    wall = {"_id": "1", "Material": "1", "Textures": "1", "Faces": faces}
    scene = textured(
        xml.folder,
        vertices=f"5 5 5 {WALL}",
        TexCoordData=f"9 9 8 8 {CORNERS}",
        objects={"Mesh": wall},
        camera=look(*PLACES[2]),
    )
    np.testing.assert_allclose(
        xml.pixel(scene), AMBIENT + 100 * nearest(*PLACES[2]), rtol=1e-4, atol=0.01
    )


def test_a_file_has_its_own_places(xml: Metu) -> None:
    vertices = np.array(WALL.split(), float).reshape(-1, 3)
    uv = np.array(CORNERS.split(), float).reshape(-1, 2)
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    save_ply(Mesh(vertices, triangles, None, uv), xml.folder / "wall.ply")
    wall = {"_id": "1", "Material": "1", "Textures": "1", "Faces": {"_plyFile": "wall.ply"}}
    scene = textured(xml.folder, objects={"Mesh": wall}, camera=look(*PLACES[3]))
    np.testing.assert_allclose(
        xml.pixel(scene), AMBIENT + 100 * nearest(*PLACES[3]), rtol=1e-4, atol=0.01
    )
    save_ply(Mesh(vertices, triangles, None, None), xml.folder / "wall.ply")
    with pytest.raises(SceneError, match="its plyFile no texture coordinates"):
        xml.load(scene)


@pytest.mark.parametrize("way", [(0.3, 0.2, 0.9), (-0.5, 0.1, 0.6), (0.6, -0.4, 0.5)])
def test_a_ball_has_metus_longitude_and_latitude(
    xml: Metu, way: tuple[float, float, float]
) -> None:
    """From +z, by phi = atan2(z, x) and theta = acos(y): u = (pi - phi) / 2 pi, v = theta / pi."""
    x, y, z = np.array(way) / np.linalg.norm(way)
    u, v = (math.pi - math.atan2(z, x)) / (2 * math.pi), math.acos(y) / math.pi
    ball = {"_id": "1", "Material": "1", "Textures": "1", "Center": "1", "Radius": "2"}
    eye = np.array([0, 0, 6])
    gaze = " ".join(map(str, 2 * np.array([x, y, z]) - eye))
    camera = {"Position": "0 0 6", "Gaze": gaze, "NearPlane": "-1e-4 1e-4 -1e-4 1e-4"}
    scene = textured(
        xml.folder,
        objects={"Sphere": ball},
        vertices="0 0 0",
        camera=camera,
        lights={"AmbientLight": "0 0 0", "DirectionalLight": SUN["DirectionalLight"]},
    )
    np.testing.assert_allclose(xml.pixel(scene), 100 * z * nearest(u, v), rtol=5e-3)


@pytest.mark.parametrize(("said", "meant"), [("linear", "linear"), ("absval", "absolute")])
def test_perlin_noise_is_that_of_this_course(xml: Metu, said: str, meant: str) -> None:
    """At (1.8, 3.6, -4) of the wall, three grains along a unit; no texture coordinates are needed."""
    scene = textured(xml.folder, camera=look(0.6, 0.3), TexCoordData="")
    scene["Textures"]["TextureMap"] = {
        "_id": "1",
        "_type": "perlin",
        "DecalMode": "replace_kd",
        "NoiseScale": "3",
        "NoiseConversion": said,
    }
    value = float(noise(np.array([[1.8], [3.6], [-4]], np.float32) * np.float32(3))[0])
    value = abs(value) if meant == "absolute" else (value + 1) / 2
    np.testing.assert_allclose(xml.pixel(scene), AMBIENT + 100 * value, rtol=1e-2, atol=0.1)
    (warning,) = xml.warnings
    assert "TextureMap is Perlin's noise: its grains lie elsewhere" in warning


@pytest.mark.parametrize("also_a_picture", [False, True])
def test_a_normal_map_turns_the_normal_along_metus_u_and_v(xml: Metu, also_a_picture: bool) -> None:
    """The wall's u is x, its v is -y; light comes along y and z."""
    code = np.array([150, 60, 210], np.uint8)
    Image.fromarray(np.tile(code, (4, 6, 1))).save(xml.folder / "normals.png")
    lights = {"DirectionalLight": SUN["DirectionalLight"] | {"Direction": "0 -1 -1"}}
    scene = textured(xml.folder, lights=lights, camera=look(*PLACES[0]))
    table = scene["Textures"]
    table["Images"]["Image"] = [table["Images"]["Image"], {"_id": "6", "_data": "normals.png"}]
    normals = {"_id": "2", "_type": "image", "ImageId": "6", "DecalMode": "replace_normal"}
    table["TextureMap"] = [table["TextureMap"], normals]
    scene["Objects"]["Mesh"]["Textures"] = "2 1" if also_a_picture else "2"
    n = code / 255 - 0.5
    n = n / np.linalg.norm(n) * [1, -1, 1]
    kd = nearest(*PLACES[0]) if also_a_picture else np.array([0.5, 0.25, 0])
    expected = 100 * kd * (n @ [0, 1, 1]) / math.sqrt(2)
    np.testing.assert_allclose(xml.pixel(scene), expected, rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize(
    ("between", "found"),
    [("nearest", nearest), ("", nearest), ("bilinear", bilinear), ("trilinear", bilinear)],
)
@pytest.mark.parametrize("place", PLACES)
def test_a_normal_map_is_nearest_unless_it_says_otherwise(
    xml: Metu, between: str, found: Any, place: tuple[float, float]
) -> None:
    """The cosine is that of the normal of the place's code, for light along z."""
    codes = CODES // 2 + np.array([60, 60, 120], np.uint8)
    lights = {"DirectionalLight": SUN["DirectionalLight"]}
    scene = textured(xml.folder, mode="replace_normal", lights=lights, camera=look(*place))
    Image.fromarray(codes).save(xml.folder / "picture.png")
    scene["Textures"]["TextureMap"]["Interpolation"] = between
    if not between:
        del scene["Textures"]["TextureMap"]["Interpolation"]
    normal = found(*place, codes) - 0.5
    expected = 100 * np.array([0.5, 0.25, 0]) * normal[2] / np.linalg.norm(normal)
    np.testing.assert_allclose(xml.pixel(scene), expected, rtol=1e-3)
    told = "TextureMap is trilinear, and only textures of reflectances have levels here"
    assert [told in warning for warning in xml.warnings] == [True] * (between == "trilinear")


@pytest.mark.parametrize("kind", ["image", "perlin"])
def test_what_is_pasted_is_seen_as_its_codes_are(metu: Metu, kind: str) -> None:
    """Whatever the light, the material and the Normalizer; and in a mirror's place."""
    mirror = {"_type": "mirror", "MirrorReflectance": "1 1 1", "SpecularReflectance": "1 1 1"}
    scene = textured(metu.folder, mode="replace_all", camera=look(*PLACES[1]))
    scene["Materials"]["Material"] = [MATT | mirror]
    if kind == "perlin":
        pasted = {"_type": "perlin", "DecalMode": "replace_all", "NoiseScale": "0.1"}
        scene["Textures"]["TextureMap"] = {"_id": "1"} | pasted
        place = np.array([[18 * PLACES[1][0] - 9], [9 - 18 * PLACES[1][1]], [-4]]) * 0.1
        value = (noise(place.astype(np.float32))[0] + 1) / 2 * 255
        np.testing.assert_allclose(metu.pixel(scene), value, rtol=1e-3)
        return
    for normalizer in ("255", "1"):
        scene["Textures"]["TextureMap"]["Normalizer"] = normalizer
        np.testing.assert_allclose(metu.pixel(scene), 255 * nearest(*PLACES[1]), rtol=1e-5)


def test_nothing_else_is_seen_under_what_is_pasted_and_a_warning_says_so(xml: Metu) -> None:
    scene = textured(xml.folder, mode="bump_normal", camera=look(*PLACES[1]))
    pasted = {"_id": "2", "_type": "perlin", "DecalMode": "replace_all", "NoiseScale": "1e-9"}
    scene["Textures"]["TextureMap"] = [scene["Textures"]["TextureMap"], pasted]
    scene["Objects"]["Mesh"]["Textures"] = "1 2"
    np.testing.assert_allclose(xml.pixel(scene), 255 / 2, rtol=1e-4)
    assert "Textures has one that replaces all, under which 1 is not seen" in xml.warnings[0]
    assert "TextureMap[2] is Perlin's noise: its grains lie elsewhere" in xml.warnings[1]
    assert len(xml.warnings) == 2


@pytest.mark.parametrize("model", ["", "ModifiedPhong"])
@pytest.mark.parametrize("chosen", ["1", "2 1"])
def test_a_texture_of_ks_is_the_highlight(xml: Metu, model: str, chosen: str) -> None:
    """Light and eye stand at one place, where every model of highlights is ks; beside a texture of kd, too."""
    shiny = MATT | {"SpecularReflectance": "0 0 0"} | ({"_BRDF": "4"} if model else {})
    u, v = 0.55, 0.45
    scene = textured(xml.folder, mode="replace_ks", camera=look(u, v), materials=[shiny])
    table = scene["Textures"]
    table["TextureMap"] = [table["TextureMap"], table["TextureMap"] | {"_id": "2"}]
    table["TextureMap"][1]["DecalMode"] = "replace_kd"
    scene["Objects"]["Mesh"]["Textures"] = chosen
    if model:
        scene["BRDFs"] = {model: {"_id": "4", "_normalized": "true", "Exponent": "10"}}
    way = np.array([18 * u - 9, 9 - 18 * v, -4])
    cosine = 4 / np.linalg.norm(way)
    light = {"_id": "1", "Direction": " ".join(map(str, way)), "Radiance": "100 100 100"}
    scene["Lights"] = {"DirectionalLight": light}
    towards_mirror = 2 * cosine**2 - 1 if model else cosine
    kd = nearest(u, v) if "2" in chosen else np.array([0.5, 0.25, 0])
    factor = (10 + 2) / 2 if model else 1
    shine = nearest(u, v) * factor * towards_mirror ** (10 if model else 1)
    expected = (kd + shine) * cosine / math.pi if model else kd * cosine + shine
    np.testing.assert_allclose(xml.pixel(scene), 100 * expected, rtol=1e-4)


@pytest.mark.parametrize("normalizer", ["255", "1"])
def test_a_background_is_seen_as_its_codes_are_behind_everything(
    metu: Metu, normalizer: str
) -> None:
    """A picture of 6 x 4 pixels shows it pixel by pixel, but for the wall's; a mirror shows none of it."""
    scene = textured(metu.folder, mode="replace_background", camera={"ImageResolution": "6 4"})
    scene["Textures"]["TextureMap"]["Normalizer"] = normalizer
    mirror = {"_type": "mirror", "MirrorReflectance": "1 1 1", "DiffuseReflectance": "0 0 0"}
    scene["Materials"]["Material"] = [MATT | {"AmbientReflectance": "0 0 0"} | mirror]
    del scene["Objects"]["Mesh"]["Textures"]
    scene["VertexData"] = "-9 -9 -4  0 -9 -4  0 9 -4  -9 9 -4"
    scene["BackgroundColor"] = "3 3 3"
    found = metu.picture(scene)
    np.testing.assert_allclose(found[:, 3:], CODES[:, 3:], rtol=1e-6)
    np.testing.assert_array_equal(found[:, :3], 0)


def test_a_background_beside_another_is_refused(xml: Metu) -> None:
    scene = textured(xml.folder, mode="replace_background")
    del scene["Objects"]["Mesh"]["Textures"]
    sky = {"_id": "1", "ImageId": "5"}
    beside = scene | {"Lights": SUN | {"SphericalDirectionalLight": sky}}
    with pytest.raises(SceneError, match="replace_background, beside Scene/Lights/Spherical"):
        xml.load(beside)
    table = scene["Textures"]
    table["TextureMap"] = [table["TextureMap"], table["TextureMap"] | {"_id": "2"}]
    with pytest.raises(SceneError, match=r"replace_background, beside .*TextureMap\[2\]"):
        xml.load(scene)


BUMPS = {"_id": "1", "DecalMode": "bump_normal", "BumpFactor": "2"}


@pytest.mark.parametrize("also_a_picture", [False, True])
def test_a_bump_map_tilts_the_normal_by_the_slope_of_its_codes(
    xml: Metu, also_a_picture: bool
) -> None:
    """Along a u that is 18 wide codes rise by 40 in a sixth, along v by 25 in a quarter, downwards."""
    rows, columns = np.mgrid[:4, :6]
    codes = (10 + 40 * columns + 25 * rows).astype(np.uint8)
    lights = {"DirectionalLight": SUN["DirectionalLight"] | {"Direction": "0 -1 -1"}}
    scene = textured(xml.folder, lights=lights, camera=look(0.4, 0.3))
    Image.fromarray(codes[..., None].repeat(3, axis=2)).save(xml.folder / "bumps.png")
    table = scene["Textures"]
    table["Images"]["Image"] = [table["Images"]["Image"], {"_id": "6", "_data": "bumps.png"}]
    bumps = BUMPS | {"_id": "2", "_type": "image", "ImageId": "6", "Normalizer": "51"}
    table["TextureMap"] = [table["TextureMap"], bumps]
    scene["Objects"]["Mesh"] |= {"Textures": "2 1" if also_a_picture else "2"}
    n = np.array([-40 * 6, 25 * 4, 0]) / 51 * 2 / 18 + [0, 0, 1]
    n /= np.linalg.norm(n)
    kd = nearest(0.4, 0.3) if also_a_picture else np.array([0.5, 0.25, 0])
    expected = 100 * kd * max(n @ [0, 1, 1], 0) / math.sqrt(2)
    np.testing.assert_allclose(xml.pixel(scene), expected, rtol=1e-3, atol=1e-3)
    assert "is a bump map: its heights" in xml.warnings[0]
    assert xml.warnings[0].endswith("own unit, and are bilinear")


def test_bumps_of_perlin_noise_are_those_of_this_course(xml: Metu) -> None:
    scene = textured(xml.folder)
    noises = {"_type": "perlin", "NoiseScale": "3", "NoiseConversion": "absval"}
    scene["Textures"]["TextureMap"] = BUMPS | noises
    found = xml.load(scene).loaded.description.materials["material 1 with texture 1"].bump
    assert found is not None
    assert found.noise is not None
    assert (found.noise.scale, found.noise.conversion, found.height) == (3, "absolute", 2)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        (
            {"mode": "replace"},
            'its DecalMode is "replace": those that can be converted are replace_all',
        ),
        ({"mode": "replace_background"}, "the texture 1 is the background of all objects"),
        (
            {"perlin": "replace_background"},
            "its type is perlin with DecalMode replace_background: ",
        ),
        ({"between": "cubic"}, 'its Interpolation is "cubic": expected nearest, bilinear or tri'),
        ({"perlin": "blend_kd"}, "its type is perlin with DecalMode blend_kd: replace_all, "),
        (
            {"TexCoordData": "0 0 1 1"},
            "refers to texture coordinates 1 to 4: expected numbers from",
        ),
        ({"TexCoordData": "0 0 1"}, "TexCoordData: has 3 numbers: expected two"),
        ({"Normalizer": "100"}, "over its Normalizer, 100, goes up to 2.5"),
        ({"ImageId": "4"}, 'ImageId is "4": expected the id of an Image'),
        ({"chosen": "2"}, 'Textures is "2": expected ids of a TextureMap'),
        ({"chosen": "1 1"}, "Textures is refused: an object of this course has one texture"),
        ({"file": "none.png"}, "its picture can't be used: .*none.png"),
    ],
)
def test_what_is_not_converted_is_refused_by_its_name(
    xml: Metu, changed: dict[str, str], told: str
) -> None:
    keys = {key: changed[key] for key in ("mode", "between", "TexCoordData") if key in changed}
    scene = textured(xml.folder, **keys)
    table = scene["Textures"]
    for key in ("Normalizer", "ImageId"):
        table["TextureMap"] |= {key: changed[key]} if key in changed else {}
    if "perlin" in changed:
        table["TextureMap"] = {"_id": "1", "_type": "perlin", "DecalMode": changed["perlin"]}
    if "file" in changed:
        table["Images"]["Image"]["_data"] = changed["file"]
    scene["Objects"]["Mesh"]["Textures"] = changed.get("chosen", "1")
    with pytest.raises(SceneError, match=rf"scene\.xml:\d+: Scene/.*{told}"):
        xml.load(scene)


def triangles(**more: str) -> list[Tree]:
    """Those of the wall, which have its vertices' places."""
    return [
        {"_id": str(number), "Material": "1", "Indices": corners, **more}
        for number, corners in enumerate(("1 2 3", "1 3 4"), start=1)
    ]


@pytest.mark.parametrize(("between", "found"), [("nearest", nearest), ("bilinear", bilinear)])
@pytest.mark.parametrize("place", PLACES)
def test_a_triangle_has_the_places_of_its_vertices(
    metu: Metu, between: str, found: Any, place: tuple[float, float]
) -> None:
    objects = {"Triangle": triangles(Textures="1")}
    scene = textured(metu.folder, between=between, camera=look(*place), objects=objects)
    expected = AMBIENT + 100 * found(*place)
    np.testing.assert_allclose(metu.pixel(scene), expected, rtol=1e-3, atol=0.05)
    assert metu.warnings == []


def test_triangles_without_places_are_refused_but_for_noise(xml: Metu) -> None:
    scene = textured(xml.folder, objects={"Triangle": triangles(Textures="1")}, TexCoordData="0 0")
    with pytest.raises(SceneError, match=r"Triangle\[1\]/Indices: has a texture, and refers to"):
        xml.load(scene)
    scene["Textures"]["TextureMap"] |= {"_type": "perlin"}
    (thing,) = xml.load(scene).loaded.description.objects
    assert thing.material == "material 1 with texture 1"


@fewer
@pytest.mark.parametrize("of_base", ["", "1", "2"])
@pytest.mark.parametrize("own_material", [False, True])
@pytest.mark.parametrize("of_file", [False, True])
def test_an_instance_may_have_textures_of_its_own(
    metu: Metu, of_base: str, own_material: bool, of_file: bool
) -> None:
    """In the place of those of its mesh, which lies aside; with texels of its own interpolation."""
    if of_file:
        vertices = np.array(WALL.split(), float).reshape(-1, 3)
        uv = np.array(CORNERS.split(), float).reshape(-1, 2)
        mesh = Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]], np.int32), None, uv)
        save_ply(mesh, metu.folder / "wall.ply")
    scene = textured(metu.folder, camera=look(*PLACES[1]))
    table = scene["Textures"]
    bilinear_one = table["TextureMap"] | {"_id": "2", "Interpolation": "bilinear"}
    table["TextureMap"] = [table["TextureMap"], bilinear_one]
    wall = scene["Objects"]["Mesh"] | {"Textures": of_base, "Transformations": "t1"}
    wall |= {"Faces": {"_plyFile": "wall.ply"}} if of_file else {}
    # An instance of an instance, which has nothing of its own.
    scene["Objects"] = {
        "Mesh": wall,
        "MeshInstance": [
            {"_id": "3", "_baseMeshId": "1"},
            {"_id": "2", "_baseMeshId": "3", "_resetTransform": "true", "Textures": "2"},
        ],
    }
    ambient = AMBIENT
    if own_material:
        scene["Materials"]["Material"].append(MATT | {"_id": "2", "AmbientReflectance": "0 0 0"})
        scene["Objects"]["MeshInstance"][1]["Material"] = "2"
        ambient = np.zeros(3)
    scene["Transformations"] = {"Translation": {"_id": "1", "_data": "40 0 0"}}
    expected = ambient + 100 * bilinear(*PLACES[1])
    np.testing.assert_allclose(metu.pixel(scene), expected, rtol=1e-3, atol=0.05)
    assert metu.warnings == []


def test_a_lamp_shines_and_reflects_as_its_texture_says(metu: Metu) -> None:
    lamp = {"_id": "1", "Material": "1", "Textures": "1", "Faces": "1 2 3 1 3 4"}
    lamp |= {"Radiance": "7 8 9"}
    scene = textured(metu.folder, camera=look(*PLACES[2]), objects={"LightMesh": lamp})
    expected = np.array([7, 8, 9]) + AMBIENT + 100 * nearest(*PLACES[2])
    np.testing.assert_allclose(metu.pixel(scene), expected, rtol=1e-3, atol=0.05)
    scene["Textures"]["TextureMap"]["DecalMode"] = "replace_all"
    with pytest.raises(SceneError, match="LightMesh/Textures is refused: a light shows its Rad"):
        metu.load(scene)


def test_an_instance_with_a_material_of_its_own_has_no_texture_and_a_warning(xml: Metu) -> None:
    scene = textured(xml.folder)
    scene["Objects"]["MeshInstance"] = [
        {"_id": "8", "_baseMeshId": "1"},
        {"_id": "9", "_baseMeshId": "1", "Material": "1"},
    ]
    things = xml.load(scene).loaded.description.objects
    assert [thing.material for thing in things] == [
        "material 1 with texture 1",
        "material 1 with texture 1",
        "material 1",
    ]
    assert len(xml.warnings) == 1
    assert "MeshInstance[2] has a Material of its own" in xml.warnings[0]


def test_a_texture_that_nothing_has_is_no_loss(metu: Metu) -> None:
    scene = textured(metu.folder, between="cubic")
    del scene["Objects"]["Mesh"]["Textures"]
    metu.load(scene)
    assert metu.warnings == []
