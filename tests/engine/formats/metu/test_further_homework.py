"""METU's homework 4 to 7: what is converted is that of the closed forms, and what isn't is refused by its name."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.base.errors import SceneError
from course.engine.formats.pictures.files import write_exr
from course.engine.formats.yaml.description import ObjectLight, SphereLight
from tests.engine.formats.metu.conftest import MATT, WALL, Metu, Tree, tree
from tests.lengths import fewer

NARROW = {"NearPlane": "-1e-3 1e-3 -1e-3 1e-3"}
"""A camera that sees the wall's middle only, at (0, 0, -4)."""

DARK = {"_id": "2", "DiffuseReflectance": "0 0 0"}
BLACK = {"AmbientLight": "0 0 0"}
KD = np.array([1, 0.5, 0])
PATHS = {"Renderer": "PathTracing", "RendererParams": "NextEventEstimation ImportanceSampling"}
WALL_MESH = {"_id": "1", "Material": "1", "Faces": "1 2 3 1 3 4"}


def directional(direction: str = "0 0 -1", **more: Any) -> Tree:
    """Light of 10, 20 and 30 from one direction."""
    return {"DirectionalLight": {"_id": "1", "Direction": direction, "Radiance": "10 20 30"} | more}


@pytest.mark.parametrize("direction", ["0 0 -1", "0 3 -3", "2 0 -1"])
def test_a_directional_light_has_one_irradiance_everywhere(xml: Metu, direction: str) -> None:
    cosine = -float(direction.split()[2]) / np.linalg.norm(np.array(direction.split(), float))
    pixel = xml.pixel(tree(lights=directional(direction)))
    np.testing.assert_allclose(pixel, KD * [10, 20, 30] * cosine, rtol=1e-5)


def test_a_directional_light_turns_with_its_transformations(xml: Metu) -> None:
    turned = tree(lights=directional("0 -1 0", Transformations="r1"))
    turned["Transformations"] = {"Rotation": {"_id": "1", "_data": "90 1 0 0"}}
    np.testing.assert_allclose(xml.pixel(turned), KD * [10, 20, 30], rtol=1e-5)


SPOT = {
    "_id": "1",
    "Position": "0 0 0",
    "Direction": "0 0 -2",
    "Intensity": "160 320 80",
    "FalloffAngle": "10",
    "CoverageAngle": "50",
}


@pytest.mark.parametrize("degrees", [0, 4.9, 15, 24, 26])
def test_a_spot_light_falls_off_between_half_of_its_two_angles(xml: Metu, degrees: float) -> None:
    """The camera stands with the light, 4 before the wall: E = I cos^3 / 16 times the share."""
    way = math.tan(math.radians(degrees))
    camera = NARROW | {"Gaze": f"{way} 0 -1"}
    pixel = xml.pixel(tree(camera=camera, lights={"SpotLight": SPOT}))
    cosine, low, high = (math.cos(math.radians(a)) for a in (degrees, 25, 5))
    share = min(max((cosine - low) / (high - low), 0), 1) ** 4
    expected = KD * [160, 320, 80] * cosine**3 / 16 * share
    np.testing.assert_allclose(pixel, expected, rtol=2e-3, atol=1e-6)


@fewer
@pytest.mark.parametrize("paths", [False, True])
@pytest.mark.parametrize(
    ("kind", "flag"),
    [
        ("OriginalBlinnPhong", ""),
        ("ModifiedBlinnPhong", ""),
        ("ModifiedBlinnPhong", "_normalized"),
        ("OriginalPhong", ""),
        ("ModifiedPhong", ""),
        ("ModifiedPhong", "_normalized"),
        ("TorranceSparrow", ""),
        ("TorranceSparrow", "_kdfresnel"),
    ],
)
def test_brdfs_are_those_of_their_formulas(metu: Metu, kind: str, flag: str, paths: bool) -> None:
    """The light comes at 60 degrees to the normal, and the eye stands at 20 on the other side of it."""
    brdf = {"_id": "7", "Exponent": "12"} | ({flag: "true"} if flag else {})
    matt = MATT | {"_BRDF": "7", "SpecularReflectance": "0.5 1 0.25", "PhongExponent": "3"}
    matt |= {"RefractionIndex": "2.5"} if kind == "TorranceSparrow" else {}
    light = directional(f"0 {math.sin(math.pi / 3)} {-math.cos(math.pi / 3)}")
    tilt = math.radians(20)
    camera = NARROW | {"Position": f"0 {4 * math.tan(tilt)} 0", "Gaze": f"0 {-math.tan(tilt)} -1"}
    camera |= PATHS if paths else {}
    scene = tree(camera=camera, lights=light, materials=[matt], BRDFs={kind: brdf})
    scene["MaxRecursionDepth"] = "1"
    pixel = metu.pixel(scene)
    to_light, to_eye = (
        np.array([0, -math.sqrt(0.75), 0.5]),
        np.array([0, math.sin(tilt), math.cos(tilt)]),
    )
    half = (to_light + to_eye) / np.linalg.norm(to_light + to_eye)
    cosine, seen, upright, met = 0.5, to_eye[2], half[2], half @ to_eye
    shine = (
        2 * cosine * seen - to_light @ to_eye
        if "nPhong" not in kind and "Phong" in kind
        else upright
    ) ** 12
    ks, kd = np.array([0.5, 1, 0.25]), KD
    f = kd + ks * shine / (cosine if "Original" in kind else 1)
    if flag == "_normalized":
        f = (
            kd / math.pi
            + ks * shine * ((12 + 8) / 8 if "Blinn" in kind else (12 + 2) / 2) / math.pi
        )
    if kind == "TorranceSparrow":
        straight = (1.5 / 3.5) ** 2
        fresnel = straight + (1 - straight) * (1 - met) ** 5
        masked = min(1, 2 * upright * min(cosine, seen) / met)
        d = (12 + 2) / (2 * math.pi) * shine
        f = kd / math.pi * (1 - fresnel if flag else 1) + ks * d * fresnel * masked / (
            4 * cosine * seen
        )
    np.testing.assert_allclose(pixel, f * [10, 20, 30] * cosine, rtol=1e-4)


def test_a_material_without_a_brdf_keeps_its_pi_beside_a_normalized_one(xml: Metu) -> None:
    brdf = {"_id": "1", "_normalized": "true", "Exponent": "1"}
    scene = tree(lights=directional(), BRDFs={"ModifiedBlinnPhong": brdf})
    np.testing.assert_allclose(xml.pixel(scene), KD * [10, 20, 30], rtol=1e-5)


def test_degamma_is_a_power_of_the_reflectances(metu: Metu) -> None:
    matt = MATT | {"_degamma": "true", "AmbientReflectance": "0.5 0 0"}
    scene = tree(lights=directional() | {"AmbientLight": "7 7 7"}, materials=[matt])
    linear = KD**2.2 * [10, 20, 30] + [7 * 0.5**2.2, 0, 0]
    np.testing.assert_allclose(metu.pixel(scene), linear, rtol=1e-5)


def ball(center: str, **more: Any) -> Tree:
    """The wall, and a ball of radius 1 at vertex 5 that shines and reflects nothing."""
    lamp = {"_id": "1", "Material": "2", "Center": "5", "Radius": "1", "Radiance": "30 20 90"}
    objects = {"Mesh": WALL_MESH, "LightSphere": lamp}
    return tree(
        vertices=f"{WALL} {center}", objects=objects, materials=[MATT, DARK], lights=BLACK, **more
    )


@pytest.mark.parametrize(
    "camera",
    [
        {"Renderer": "DirectLighting"},
        PATHS,
        PATHS | {"RendererParams": "NextEventEstimation RussianRoulette"},
        {"Renderer": "PathTracing"},
    ],
    ids=["direct", "paths", "roulette", "chance"],
)
def test_a_ball_sends_its_radiance_to_the_eye_and_pi_times_its_solid_angle_to_a_wall(
    xml: Metu, camera: Tree
) -> None:
    """It lies on the wall's axis, 6 away: E = pi L / 36. The ball of triangles is a little smaller (128 segments).

    Over 12 seeds 1024 samples had a standard deviation of 1.4%, so 2% is 5.9 of those of 16,384, beyond which 1 in
    3e8 lies.
    """
    many = NARROW | {"NumSamples": "16384"} | camera
    expected = KD * [30, 20, 90] * math.pi / 36
    np.testing.assert_allclose(xml.pixel(ball("0 0 2", camera=many)), expected, rtol=0.02)
    seen = xml.pixel(ball("0 0 -3", camera=NARROW | camera))
    np.testing.assert_allclose(seen, [30, 20, 90], rtol=1e-5)


def test_a_ball_is_looked_for_in_the_cone_that_it_fills(xml: Metu) -> None:
    """64 samples are within 0.1% of the closed form: all have nearly one value. Those of a mesh differ by 30%."""
    scene = ball("0 0 2", camera=NARROW | {"NumSamples": "64"})
    expected = KD * [30, 20, 90] * math.pi / 36
    np.testing.assert_allclose(xml.pixel(scene), expected, rtol=1e-3)
    light = xml.load(scene).loaded.description.lights[-1]
    assert isinstance(light, SphereLight)
    assert light.samples == "visible"


@pytest.mark.parametrize(
    ("steps", "center", "radius", "kind"),
    [
        ({}, [1, 2, -6], 1, SphereLight),
        ({"Scaling": "2 2 2"}, [2, 4, -12], 2, SphereLight),
        ({"Scaling": "-2 2 2", "Rotation": "90 0 1 0"}, [-12, 4, 2], 2, SphereLight),
        ({"Rotation": "180 0 1 0", "Translation": "5 6 7"}, [4, 8, 13], 1, SphereLight),
        ({"Scaling": "2 2 2.001"}, None, None, ObjectLight),
        ({"Composite": "1 0.1 0 0  0 1 0 0  0 0 1 0  0 0 0 1"}, None, None, ObjectLight),
    ],
)
def test_only_what_is_a_ball_still_is_a_light_of_type_sphere(
    xml: Metu, steps: Tree, center: Any, radius: Any, kind: type
) -> None:
    scene = ball("1 2 -6")
    names = {"Scaling": "s1", "Rotation": "r1", "Translation": "t1", "Composite": "c1"}
    scene["Objects"]["LightSphere"]["Transformations"] = " ".join(names[step] for step in steps)
    scene["Transformations"] = {step: {"_id": "1", "_data": steps[step]} for step in steps}
    light = xml.load(scene).loaded.description.lights[-1]
    assert isinstance(light, kind)
    if isinstance(light, SphereLight):
        np.testing.assert_allclose(light.center, center, atol=1e-12)
        assert light.radius == pytest.approx(radius)


def test_a_ball_that_reflects_or_holds_a_camera_is_an_object(xml: Metu) -> None:
    """The camera is at the origin; a ball may reach it on its way."""

    def light(center: str, **more: str) -> Any:
        scene = ball(center)
        scene["Objects"]["LightSphere"] |= more
        return xml.load(scene).loaded.description.lights[-1]

    assert isinstance(light("0 0 -3"), SphereLight)
    assert isinstance(light("0 0 -0.9"), ObjectLight)
    assert isinstance(light("0 0 -3", MotionBlur="0 0 2.5"), ObjectLight)
    assert light("0 0 -3", MotionBlur="1 2 1.5").motion.velocity == (1, 2, 1.5)
    for reflectance in ("Ambient", "Diffuse", "Specular"):
        shiny = ball("0 0 -3")
        shiny["Materials"]["Material"][1] = DARK | {f"{reflectance}Reflectance": "0 0.1 0"}
        assert isinstance(xml.load(shiny).loaded.description.lights[-1], ObjectLight)


@pytest.mark.parametrize("camera", [{}, PATHS], ids=["direct", "paths"])
def test_both_forms_of_a_ball_make_one_picture(xml: Metu, camera: Tree) -> None:
    """Of a wall, a mirror and the ball itself; a scaling that is hardly uneven makes a mesh of it.

    Over 12 seeds the means had standard deviations of up to 0.8%, so 4% is 3.6 of those of a difference.
    """
    many = {"ImageResolution": "24 16", "NumSamples": "64"} | camera
    means = []
    for scaling in ("1 1 1", "1 1 1.00001"):
        scene = ball("-1 0.5 -2.5", camera=many)
        scene["Materials"]["Material"].append(
            {"_id": "3", "_type": "mirror", "MirrorReflectance": "1 1 1"}
        )
        scene["VertexData"] += "  1.5 0 -3"
        scene["Objects"]["Sphere"] = {"_id": "1", "Material": "3", "Center": "6", "Radius": "0.8"}
        scene["Objects"]["LightSphere"]["Transformations"] = "s1"
        scene["Transformations"] = {"Scaling": {"_id": "1", "_data": scaling}}
        means.append(xml.picture(scene).mean(axis=(0, 1)))
    np.testing.assert_allclose(*means, rtol=0.04)


def test_a_mesh_lights_a_wall_as_the_rectangle_that_it_is(xml: Metu) -> None:
    """Of a square of edge 2, 2 away on the axis: four times the form factor of the quarter of it.

    Over 12 seeds 1024 samples had a standard deviation of 0.42%: 2% is nine of those of 4096.
    """
    lamp = {"_id": "1", "Material": "2", "Radiance": "8 8 8", "Faces": "5 6 7 5 7 8"}
    scene = tree(
        camera=NARROW | {"Position": "0 0 -3", "NumSamples": "4096"},
        vertices=f"{WALL} -1 -1 -2  1 -1 -2  1 1 -2  -1 1 -2",
        objects={"Mesh": WALL_MESH, "LightMesh": lamp},
        materials=[MATT, DARK],
        lights=BLACK,
    )
    x = 1 / 2
    root = math.sqrt(1 + x * x)
    factor = 4 / (2 * math.pi) * 2 * (x / root) * math.atan(x / root)
    np.testing.assert_allclose(xml.pixel(scene), KD * 8 * math.pi * factor, rtol=0.02)


def environment(
    folder: Path, picture: np.ndarray[Any, Any], kind: str = "latlong", **more: Any
) -> Tree:
    """A scene in the light of a picture; the wall is the only object."""
    write_exr(folder / "sky.exr", np.moveaxis(picture, -1, 0).astype(np.float32))
    lights = BLACK | {"SphericalDirectionalLight": {"_id": "1", "_type": kind, "ImageId": "3"}}
    images = {"Image": {"_id": "3", "_data": "sky.exr"}}
    return tree(lights=lights, Textures={"Images": images}, **more)


def test_an_even_environment_is_seen_and_lights_as_half_a_sphere(xml: Metu) -> None:
    """METU's renderers find kd pi L. Where all directions are alike, every sample has the same value."""
    even = np.full((8, 16, 3), [2.0, 3.0, 4.0])
    lit = xml.pixel(environment(xml.folder, even, camera=NARROW | {"NumSamples": "16"}))
    np.testing.assert_allclose(lit, KD * [2, 3, 4] * math.pi, rtol=1e-4)
    away = xml.pixel(environment(xml.folder, even, camera=NARROW | {"Gaze": "0 0 1"}))
    np.testing.assert_allclose(away, [2, 3, 4], rtol=1e-5)


@pytest.mark.parametrize(
    ("gaze", "row", "column"),
    [("0 0 1", 4, 0), ("1 0 0", 4, 12), ("-1 0 0", 4, 4), ("0 1 0", 0, 0)],
)
def test_the_middle_of_the_picture_is_ahead(xml: Metu, gaze: str, row: int, column: int) -> None:
    """Longitude atan2(x, -z) from left to right, and +y at the top."""
    sky = np.full((8, 16, 3), 0.01)
    sky[max(row - 1, 0) : row + 1, [column - 1, column]] = 1
    if row == 0:
        sky[0] = 1
    camera = NARROW | {"Gaze": gaze, "Up": "0 0 1" if row == 0 else "0 1 0"}
    scene = environment(xml.folder, sky, camera=camera)
    assert xml.pixel(scene).min() > 0.5
    other = NARROW | {"Gaze": "0 -1 0.3", "Up": "0 0 1"}
    assert xml.pixel(environment(xml.folder, sky, camera=other)).max() < 0.5


@pytest.mark.parametrize("gaze", ["1 0 -2", "-1 2 1", "0.3 -0.4 1", "0 0 1"])
def test_a_probe_has_the_angle_from_ahead_along_its_radius(xml: Metu, gaze: str) -> None:
    """With r = acos(-z) / (pi sqrt(x^2 + y^2)), u = (1 + r x) / 2 and v = (1 - r y) / 2, v down; a spot is there."""
    x, y, z = np.array(gaze.split(), float) / np.linalg.norm(np.array(gaze.split(), float))
    count, across = 256, math.hypot(x, y)
    r = math.acos(-z) / (math.pi * across) if across else 1.0
    rows, columns = np.mgrid[:count, :count] + 0.5
    u, v = (1 + r * x) / 2 * count, (1 - r * y) / 2 * count
    if across:
        spot = np.hypot(columns - u, rows - v) < 12
    else:
        # Straight behind is all around the rim; the corners beyond it are dark.
        distance = np.hypot(columns - count / 2, rows - count / 2)
        spot = (distance > count / 2 - 12) & (distance < count / 2)
    sky = np.where(spot, 1, 0.01)[..., None].repeat(3, axis=2)
    camera = NARROW | {"Gaze": gaze, "Position": "0 0 -3" if z > 0 else "0 0 -5"}
    assert xml.pixel(environment(xml.folder, sky, "probe", camera=camera)).min() > 0.99
    camera["Gaze"] = f"{-x} {-y} {z}" if across else "1 0 1"
    assert xml.pixel(environment(xml.folder, sky, "probe", camera=camera)).max() < 0.02


def test_an_even_probe_lights_as_half_a_sphere_whatever_its_corners_are(xml: Metu) -> None:
    rows, columns = np.mgrid[:16, :16] - 7.5
    even = np.where(np.hypot(rows, columns)[..., None] < 8, [2.0, 3.0, 4.0], 0)
    scene = environment(xml.folder, even, "probe", camera=NARROW | {"NumSamples": "16"})
    np.testing.assert_allclose(xml.pixel(scene), KD * [2, 3, 4] * math.pi, rtol=1e-4)


def refused(metu: Metu, scene: Tree) -> str:
    with pytest.raises(SceneError) as error:
        metu.load(scene)
    assert not (metu.folder / "scene.yaml").exists()
    assert not (metu.folder / "scene.meshes").exists()
    return str(error.value)


REFUSED: dict[str, tuple[Tree, tuple[str, ...]]] = {
    "narrow": (
        {"lights": {"SpotLight": SPOT | {"CoverageAngle": "9"}}},
        ('SpotLight/FalloffAngle is "10": expected an angle up to CoverageAngle, 9 [degree]',),
    ),
    "wide": (
        {"lights": {"SpotLight": SPOT | {"CoverageAngle": "361"}}},
        ('SpotLight/CoverageAngle is "361": expected an angle up to 360 [degree]',),
    ),
    "torrance": (
        {"BRDFs": {"TorranceSparrow": {"_id": "1", "_kdfresnel": "true", "Exponent": "3"}}},
        (
            "Scene/Materials/Material: RefractionIndex is missing: expected an element of that name, ",
            "such as 1.5, for its BRDF is TorranceSparrow",
        ),
    ),
    "kdfresnel": (
        {"BRDFs": {"ModifiedPhong": {"_id": "1", "_kdfresnel": "true", "Exponent": "3"}}},
        ("Scene/BRDFs/ModifiedPhong: kdfresnel is true: only TorranceSparrow has such a form",),
    ),
    "no such brdf": (
        {"BRDFs": {"ModifiedBlinnPhong": {"_id": "2", "Exponent": "3"}}},
        ("Scene/Materials/Material: BRDF is 1: expected the id of one",),
    ),
    "unknown brdf": (
        {"BRDFs": {"DisneyPrincipled": {"_id": "1", "Exponent": "3"}}},
        (
            "Scene/BRDFs/DisneyPrincipled is refused: this course has no such model, only OriginalBlinnPhong, ",
            "take the attribute BRDF from its materials to render without it",
        ),
    ),
    "unknown light": (
        {
            "lights": {
                "EnvironmentLight": {"_id": "1"},
                "TriangularLight": [{"_id": "1"}, {"_id": "2"}],
            },
            "objects": {"Mesh": WALL_MESH, "Cylinder": {"_id": "1", "Radius": "2"}},
        },
        (
            "Scene/Lights/EnvironmentLight is refused: this course has no such light; remove it",
            " to render without it; refused are also: Scene/Lights/TriangularLight, Scene/Objects/Cylinder",
        ),
    ),
    "normalized": (
        {"BRDFs": {"OriginalBlinnPhong": {"_id": "1", "_normalized": "1", "Exponent": "3"}}},
        ("Scene/BRDFs/OriginalBlinnPhong: normalized is true: only a modified model",),
    ),
    "renderer": (
        {"camera": {"Renderer": "Photons"}},
        ('Scene/Cameras/Camera/Renderer is "Photons": expected DirectLighting or PathTracing',),
    ),
    "parameters": (
        {"camera": {"Renderer": "PathTracing", "RendererParams": "NextEventEstimation MIS"}},
        ('RendererParams is "NextEventEstimation MIS": expected NextEventEstimation, ',),
    ),
    "chance": (
        {"camera": {"Renderer": "PathTracing"}, "lights": directional()},
        ("never finds Scene/Lights/DirectionalLight: add NextEventEstimation",),
    ),
    "transparency": (
        {"materials": [MATT | {"Transparency": "0.5 0.5 0.5"}]},
        ("Scene/Materials/Material/Transparency is refused: ",),
    ),
    "ball": (
        {"lights": {"SphericalDirectionalLight": {"_id": "1", "_type": "ball", "ImageId": "1"}}},
        ('SphericalDirectionalLight: its type is "ball": expected latlong or probe',),
    ),
    "no image": (
        {"lights": {"SphericalDirectionalLight": {"_id": "1", "ImageId": "1"}}},
        ('SphericalDirectionalLight/ImageId is "1": expected the id of an Image',),
    ),
    "codes": (
        {
            "lights": {"SphericalDirectionalLight": {"_id": "1", "ImageId": "1"}},
            "Textures": {"Images": {"Image": {"_id": "1", "_data": "sky.png"}}},
        },
        ('Image is "sky.png": expected a picture of radiance, .exr or .hdr',),
    ),
    "no file": (
        {
            "lights": {"SphericalDirectionalLight": {"_id": "1", "ImageId": "1"}},
            "Textures": {"Images": {"Image": {"_id": "1", "_data": "sky.exr"}}},
        },
        ('Image: names "sky.exr": no such file in',),
    ),
    "dark lamp": (
        {"objects": {"LightMesh": WALL_MESH | {"Radiance": "0 0 0"}}},
        ("Scene/Objects/LightMesh: Radiance is 0 0 0: expected a light that shines",),
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_converted_is_refused_by_its_name_and_place(metu: Metu, name: str) -> None:
    changed, told = REFUSED[name]
    scene = tree(**{"materials": [MATT | {"_BRDF": "1"}] if "BRDFs" in changed else None} | changed)
    message = refused(metu, scene)
    place = "scene.xml:" if metu.form == "xml" else "scene.json: "
    assert place in message
    for part in told:
        assert part in message


def test_textures_of_planes_and_lamps_are_refused(metu: Metu) -> None:
    plane = {"_id": "1", "Material": "1", "Textures": "1", "Point": "1", "Normal": "0 0 1"}
    lamp = {"_id": "1", "Material": "1", "Center": "1", "Radius": "1", "Radiance": "1 1 1"}
    message = refused(metu, tree(objects={"Plane": plane, "LightSphere": lamp | {"Textures": "1"}}))
    assert "Scene/Objects/Plane/Textures is refused: a Plane and a LightSphere" in message
    assert "refused are also: Scene/Objects/LightSphere/Textures" in message


def test_an_unknown_brdf_of_a_material_that_no_object_has_is_left_out_with_a_warning(
    metu: Metu,
) -> None:
    scene = tree(materials=[MATT, DARK | {"_BRDF": "1"}], BRDFs={"Velvet": {"_id": "1"}})
    metu.load(scene)
    (warning,) = metu.warnings
    assert "Scene/BRDFs/Velvet is not known, and was left out" in warning


def test_a_brdf_that_no_material_has_is_no_loss(metu: Metu) -> None:
    metu.load(tree(BRDFs={"TorranceSparrow": {"_id": "1", "Exponent": "3"}}))
    assert metu.warnings == []


def test_what_paths_and_skies_leave_out_is_named(xml: Metu) -> None:
    shiny = MATT | {"SpecularReflectance": "1 1 1"}
    xml.load(tree(camera=PATHS, materials=[shiny], lights=directional()))
    assert "Scene/Cameras/Camera/Renderer is PathTracing: highlights are those" in xml.warnings[0]
    xml.load(environment(xml.folder, np.ones((2, 4, 3)), materials=[shiny]))
    assert "SphericalDirectionalLight lights diffuse terms; of highlights it" in xml.warnings[0]


def test_renderers_become_integrators(xml: Metu) -> None:
    scene = tree(camera=PATHS, lights=directional(), MaxRecursionDepth="9")
    integrator = xml.load(scene).loaded.description.integrator
    assert (integrator.type, integrator.max_depth, integrator.roulette) == ("path", 9, None)
    scene["Cameras"]["Camera"]["RendererParams"] = "RussianRoulette NextEventEstimation"
    integrator = xml.load(scene).loaded.description.integrator
    assert (integrator.max_depth, integrator.roulette) == (32, 9)
