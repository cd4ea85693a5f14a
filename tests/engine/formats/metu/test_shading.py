"""Lights and materials: pixels worked out by hand."""

import math

import numpy as np
import pytest

from course import render
from tests.engine.formats.metu.conftest import MATT, Metu, tree

POINT = {"_id": "1", "Position": "0 0 0", "Intensity": "800 800 800"}
AT = np.array([0.0, 0.0, -4.0])
"""What the middle of the pixel sees."""


def test_ambient_light_is_added_once_however_many_lights_there_are(metu: Metu) -> None:
    far = {"_id": "2", "Position": "0 0 0", "Intensity": "0 0 0"}
    lights = {"AmbientLight": "100 50 25", "PointLight": [POINT | {"Intensity": "0 0 0"}, far]}
    np.testing.assert_allclose(metu.pixel(tree(lights=lights)), [100, 50, 25], rtol=1e-6)
    assert metu.warnings == []


@pytest.mark.parametrize("position", [(0, 0, 0), (3, 0, 0), (-2, 5, -1)])
def test_a_point_light_gives_kd_i_cos_over_d_squared(
    metu: Metu, position: tuple[float, float, float]
) -> None:
    light = POINT | {"Position": " ".join(map(str, position))}
    way = np.array(position) - AT
    irradiance = 800 * way[2] / np.linalg.norm(way) ** 3
    got = metu.pixel(tree(lights={"PointLight": light}))
    np.testing.assert_allclose(got, [irradiance, irradiance / 2, 0], rtol=3e-5)


@pytest.mark.parametrize(("exponent", "power"), [(None, 1), ("8", 8), ("50.5", 50.5)])
def test_the_highlight_is_plain_blinn_phong_without_a_cosine_and_a_norm(
    metu: Metu, exponent: str | None, power: float
) -> None:
    shiny = {"_id": "1", "SpecularReflectance": "1 0.5 2"}
    if exponent is not None:
        shiny["PhongExponent"] = exponent
    way = np.array([3.0, 0, 0]) - AT
    to_light = way / np.linalg.norm(way)
    half = to_light + np.array([0, 0, 1])
    expected = 800 / (way @ way) * (half[2] / np.linalg.norm(half)) ** power
    scene = tree(lights={"PointLight": POINT | {"Position": "3 0 0"}}, materials=[shiny])
    # A float32 cosine is wrong by a few 1e-7, the point by its shadow ray's offset; the exponent multiplies both.
    tolerance = 3e-5 + 4e-6 * power
    np.testing.assert_allclose(metu.pixel(scene), expected * np.array([1, 0.5, 2]), rtol=tolerance)


@pytest.mark.parametrize("normal", ["0 0 -1", "0 0 7", "1 2 -3"])
@pytest.mark.parametrize("key", ["Radiance", "Intensity"])
def test_a_small_area_light_gives_radiance_area_cos_cos_over_d_squared_from_both_sides(
    metu: Metu, normal: str, key: str
) -> None:
    light = {"_id": "1", "Position": "2 1 -1", "Normal": normal, "Size": "0.01", key: "9e6 9e6 9e6"}
    way = np.array([2.0, 1, -1]) - AT
    distance = np.linalg.norm(way)
    n = np.array(normal.split(), float)
    cosine = abs(n @ way) / distance / np.linalg.norm(n)
    expected = 9e6 * 1e-4 * cosine * (way[2] / distance) / distance**2
    got = metu.pixel(tree(lights={"AreaLight": light}))
    # The light spans 1/370 of its distance.
    np.testing.assert_allclose(got, [expected, expected / 2, 0], rtol=4e-3)


def test_a_large_area_light_is_a_square_about_its_position(xml: Metu) -> None:
    """Irradiance below the middle of a square; the mean of 8 pictures is beyond 8 errors of it once in 10^4 seeds."""
    light = {"_id": "1", "Position": "0 0 0", "Normal": "0 0 -1", "Size": "6", "Radiance": "10 0 0"}
    # A camera that sees hardly more than the middle.
    camera = {"NumSamples": "1024", "NearPlane": "-0.001 0.001 -0.001 0.001"}
    scene = xml.load(tree(lights={"AreaLight": light}, camera=camera))
    half = 3 / math.hypot(3, 4)
    expected = 10 * 4 * half * math.atan(half)
    means = [float(render(scene, seed=seed).linear[0, 0, 0]) for seed in range(8)]
    error = np.std(means, ddof=1) / math.sqrt(8)
    assert abs(np.mean(means) - expected) < 8 * error + 3e-5 * expected
    assert error < 0.003 * expected


def test_an_area_light_is_not_seen_and_casts_no_shadow(metu: Metu) -> None:
    area = {"_id": "1", "Position": "0 0 -2", "Normal": "0 0 1", "Size": "3", "Radiance": "0 0 9"}
    lights = {"PointLight": POINT, "AreaLight": area}
    got = metu.pixel(tree(lights=lights))
    np.testing.assert_allclose(got[0], 800 / 16, rtol=3e-5)


@pytest.mark.parametrize("index", [1.5, 0.7])
def test_light_through_a_slab_fades_by_fresnel_and_beer(metu: Metu, index: float) -> None:
    """Straight through: (1 - R)^2 exp(-c 2) of what the wall sends; two bounces leave nothing else."""
    glass = {
        "_id": "2",
        "_type": "dielectric",
        "RefractionIndex": str(index),
        "AbsorptionCoefficient": "0.1 0 0.5",
    }
    box = "-5 -5 -1  5 -5 -1  5 5 -1  -5 5 -1  -5 -5 -3  5 -5 -3  5 5 -3  -5 5 -3"
    faces = "5 6 7 5 7 8 9 11 10 9 12 11"
    scene = tree(
        materials=[MATT, glass],
        vertices=f"-9 -9 -4  9 -9 -4  9 9 -4  -9 9 -4 {box}",
        objects={
            "Mesh": [
                {"_id": "1", "Material": "1", "Faces": "1 2 3 1 3 4"},
                {"_id": "2", "Material": "2", "Faces": faces},
            ]
        },
        MaxRecursionDepth="2",
        ShadowRayEpsilon="1e-9",
    )
    reflected = ((index - 1) / (index + 1)) ** 2
    expected = 100 * (1 - reflected) ** 2 * np.exp(-2 * np.array([0.1, 0, 0.5]))
    np.testing.assert_allclose(metu.pixel(scene), expected, rtol=1e-5)
    scene["MaxRecursionDepth"] = "1"
    np.testing.assert_array_equal(metu.pixel(scene), 0)


BEHIND = "-9 -9 -4  9 -9 -4  9 9 -4  -9 9 -4   -9 -9 5  -9 9 5  9 9 5  9 -9 5"


def mirrored(material: dict[str, str], depth: str = "1", **others: str) -> dict[str, object]:
    """A mirror before the camera, and behind it a matt wall in ambient light of 100."""
    return tree(
        materials=[MATT, {"_id": "2"} | material],
        vertices=BEHIND,
        objects={
            "Mesh": [
                {"_id": "1", "Material": "2", "Faces": "1 2 3 1 3 4"},
                {"_id": "2", "Material": "1", "Faces": "5 6 7 5 7 8"},
            ]
        },
        MaxRecursionDepth=depth,
        **others,
    )


def test_a_mirror_mirrors_and_its_depth_is_the_most_bounces(metu: Metu) -> None:
    mirror = {
        "_type": "mirror",
        "MirrorReflectance": "0.9 0.5 0.1",
        "AmbientReflectance": "0.1 0 0",
    }
    np.testing.assert_allclose(metu.pixel(mirrored(mirror)), [100, 50, 10], rtol=1e-6)
    np.testing.assert_allclose(metu.pixel(mirrored(mirror, "0")), [10, 0, 0], rtol=1e-6)


def test_beside_materials_with_a_type_one_without_does_not_mirror_and_that_is_said(
    metu: Metu,
) -> None:
    plain = {"MirrorReflectance": "0.9 0.5 0.1", "AmbientReflectance": "0.1 0 0"}
    scene = mirrored(plain)
    glass = {"_id": "3", "_type": "dielectric", "RefractionIndex": "1.5"}
    materials = [MATT, {"_id": "2"} | plain, glass]
    scene["Materials"] = {"Material": materials}
    np.testing.assert_allclose(metu.pixel(scene), [10, 0, 0], rtol=1e-6)
    (warning,) = metu.warnings
    assert "Material[2]/MirrorReflectance counts only with type mirror or conductor" in warning


@pytest.mark.parametrize("roughness", ["0", "1e-6"])
def test_in_a_file_without_any_type_reflectances_make_mirrors_and_that_is_said(
    metu: Metu, roughness: str
) -> None:
    """The homework of 2019 had no types: a rough metal was drawn without its mirror."""
    old = {"MirrorReflectance": "0.9 0.5 0.1", "AmbientReflectance": "0.1 0 0"}
    old |= {"Roughness": roughness, "Transparency": "0 0.0 0"}
    np.testing.assert_allclose(metu.pixel(mirrored(old)), [100, 50, 10], rtol=1e-4)
    (warning,) = metu.warnings
    assert "Material[2]/MirrorReflectance is that of type mirror, as no material" in warning


@pytest.mark.parametrize(
    ("kind", "tag", "types"),
    [
        ("mirror", "RefractionIndex", "conductor or dielectric"),
        ("", "RefractionIndex", "conductor or dielectric"),
        ("mirror", "AbsorptionIndex", "conductor"),
        ("dielectric", "AbsorptionIndex", "conductor"),
        ("mirror", "AbsorptionCoefficient", "dielectric"),
        ("conductor", "AbsorptionCoefficient", "dielectric"),
        ("dielectric", "MirrorReflectance", "mirror or conductor"),
    ],
)
@pytest.mark.parametrize("given", [True, False])
def test_what_a_type_has_no_use_for_is_told_with_the_types_that_have(
    metu: Metu, kind: str, tag: str, types: str, given: bool
) -> None:
    """It is known, so nothing says that it isn't; 0 does nothing anywhere, and nothing is said."""
    needed = {
        "": {},
        "mirror": {"MirrorReflectance": "1 1 1"},
        "conductor": {"MirrorReflectance": "1 1 1", "RefractionIndex": "1", "AbsorptionIndex": "2"},
        "dielectric": {"RefractionIndex": "1.5"},
    }[kind]
    colored = tag in ("MirrorReflectance", "AbsorptionCoefficient")
    value = "0.5" if given else "0"
    material = needed | {tag: f"{value} 0 0" if colored else value}
    metu.load(mirrored(material | ({"_type": kind} if kind else {})))
    if not given:
        assert metu.warnings == []
        return
    (warning,) = metu.warnings
    assert f"Material[2]/{tag} counts only with type {types}, and was left out" in warning
    assert "not known" not in warning


@pytest.mark.parametrize(("n", "k"), [(0.37, 2.82), (2.5, 0.0), (0.0, 1.0), (1.1, 7.0)])
def test_a_conductor_mirrors_its_fresnel_reflectance(metu: Metu, n: float, k: float) -> None:
    metal = {
        "_type": "conductor",
        "RefractionIndex": str(n),
        "AbsorptionIndex": str(k),
        "MirrorReflectance": "1 0.5 0.25",
    }
    reflectance = ((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k)
    expected = 100 * reflectance * np.array([1, 0.5, 0.25])
    np.testing.assert_allclose(metu.pixel(mirrored(metal)), expected, rtol=1e-5)


def test_the_background_is_seen_by_primary_rays_only(metu: Metu) -> None:
    glass = {"_type": "mirror", "MirrorReflectance": "1 1 1"}
    scene = mirrored(glass, BackgroundColor="10 20 255")
    scene["Objects"]["Mesh"].pop()
    np.testing.assert_array_equal(metu.pixel(scene), 0)
    scene["Cameras"]["Camera"] |= {"Gaze": "0 1 0", "Up": "0 0 1"}
    np.testing.assert_array_equal(metu.pixel(scene), [10, 20, 255])


def test_roughness_jitters_on_a_square_of_that_edge(metu: Metu) -> None:
    rough = {"_type": "mirror", "MirrorReflectance": "1 1 1", "Roughness": "0.25"}
    (lobe,) = metu.load(mirrored(rough)).compiled.world.lobes
    assert lobe.parameter == 0.25
    direction = np.array([[0], [0], [-1.0]], np.float32).repeat(4, axis=1)
    corners = np.array([[0, 0, 1, 1], [0, 1, 0, 1]], np.float32)
    jittered = lobe.jitter(direction, corners)
    # The corners are half a diagonal, 0.25 / sqrt(2), from the direction's end.
    tangents = np.linalg.norm(jittered[:2], axis=0) / np.abs(jittered[2])
    np.testing.assert_allclose(tangents, 0.25 / math.sqrt(2), rtol=1e-6)


def test_rough_glass_blurs_what_it_mirrors_and_what_it_refracts(metu: Metu) -> None:
    rough = {"_id": "1", "_type": "dielectric", "RefractionIndex": "1.5", "Roughness": "0.25"}
    world = metu.load(tree(materials=[rough], MaxRecursionDepth="4")).compiled.world
    (lobe,), (glass,) = world.lobes, world.rough
    assert (lobe.parameter, glass.roughness, glass.glossy) == (0.25, 0.25, True)
    assert metu.warnings == []


def test_a_smooth_wall_may_be_glass_that_is_also_shaded(metu: Metu) -> None:
    glass = {
        "_id": "1",
        "_type": "dielectric",
        "RefractionIndex": "1.5",
        "AmbientReflectance": "0.5 0 0",
    }
    np.testing.assert_allclose(metu.pixel(tree(materials=[glass])), [50, 0, 0], rtol=1e-6)
