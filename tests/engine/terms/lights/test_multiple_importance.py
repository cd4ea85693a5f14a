"""Lamps in glossy surfaces by points on the lamp, by directions of the lobe, and by both: means, noise, what is called.

Means of 256 pixels lie within 5 standard errors with a false-fail rate of 1e-6 each (``tests/estimates.py``); some
sixty are tested, with fixed seeds.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Scene, load_scene, render
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant
from course.engine.terms.lights.multiple_importance import Combining
from tests.conftest import MakeScene
from tests.estimates import estimate
from tests.lengths import fewer

WAYS = ("lobe", "lamp", "balance", "power")
EXPONENT, MIRROR, RADIANCE = 20, 0.8, 3.0
BALL = {
    "type": "sphere",
    "center": [-2, 2, 0],
    "radius": 0.5,
    "radiance": RADIANCE,
    "samples": "visible",
}
# Turned towards the origin, at right angles to the mirrored direction.
SHEET = {
    "type": "rectangle",
    "corner": [-2.4, 1.6, -0.5],
    "edge_u": [0.8, 0.8, 0],
    "edge_v": [0, 0, 1],
    "radiance": RADIANCE,
}


def plate(make_scene: MakeScene, way: str, lamp: dict[str, Any], **parts: Any) -> Scene:
    """One point of a glossy plate, seen at 45 degrees; the lamp lies in the mirrored direction."""
    return make_scene(
        **{
            "camera": {"eye": [4, 4, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-4},
            "film": {"width": 16, "height": 16},
            "sampler": {"type": "random", "samples": 64},
            "materials": {
                "glossy": {
                    "color": 0,
                    "mirror": MIRROR,
                    "gloss": {"lobe": "phong", "exponent": EXPONENT},
                }
            },
            "objects": [{"shape": "quad", "material": "glossy", "width": 2, "depth": 2}],
            "lights": [lamp],
            "integrator": {"max_depth": 1, "gloss_sampling": way},
        }
        | parts
    )


def expected(lamp: dict[str, Any]) -> float:
    """The share of the lobe that the lamp fills: of a cone in closed form, of a sheet by midpoints."""
    if lamp["type"] == "sphere":
        sine = lamp["radius"] / math.hypot(*lamp["center"])
        return MIRROR * RADIANCE * float(1 - (1 - sine**2) ** ((EXPONENT + 1) / 2))
    s, t = np.meshgrid(*[(np.arange(1000) + 0.5) / 1000] * 2)
    corner, u, v = (
        np.array(lamp[key], float)[:, None, None] for key in ("corner", "edge_u", "edge_v")
    )
    p = corner + s * u + t * v
    d = np.sqrt((p * p).sum(axis=0))
    cosine = (p[1] - p[0]) / d / math.sqrt(2)
    area = float(np.linalg.norm(np.cross(u.ravel(), v.ravel())))
    # The lamp's normal is the lobe's axis, reversed.
    density = (EXPONENT + 1) / (2 * math.pi) * cosine**EXPONENT
    return MIRROR * RADIANCE * area * float((density * cosine / d**2).mean())


@fewer
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("lamp", [BALL, SHEET], ids=["ball", "sheet"])
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.usefixtures("each_form")
def test_the_mean_is_the_lobe_s_share_of_the_lamp(
    make_scene: MakeScene, way: str, lamp: dict[str, Any], kind: str
) -> None:
    scene = plate(
        make_scene, way, lamp, integrator={"type": kind, "max_depth": 1, "gloss_sampling": way}
    )
    found, spread = estimate(scene)
    assert np.abs(found - expected(lamp)).max() <= spread.max() + 2e-3 * expected(lamp)


@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_matt_and_glossy_light_add_up_beside_other_lamps_too(
    make_scene: MakeScene, kind: str
) -> None:
    """What is reflected in a round about way, and lamps that the lobe alone finds, have the same mean by all ways."""
    shiny = {"color": 0.5, "mirror": 0.4, "gloss": {"lobe": "phong", "exponent": EXPONENT}}
    point = {"type": "point", "position": [1, 2, 1], "intensity": 4}
    ball = BALL | {"center": [-1, 2, 1], "samples": "sphere"}
    wall = {"shape": "quad", "material": "glossy", "width": 3, "depth": 3} | {
        "transform": [{"rotate": {"axis": [0, 0, 1], "degrees": -70}}, {"translate": [-1.5, 1, 0]}]
    }
    floor = {"shape": "quad", "material": "glossy", "width": 2, "depth": 2}
    means, spreads = [], []
    for way in WAYS:
        scene = plate(
            make_scene,
            way,
            BALL,
            lights=[BALL, point, SHEET, ball],
            materials={"glossy": shiny},
            objects=[floor, wall],
            integrator={"type": kind, "max_depth": 3, "gloss_sampling": way},
        )
        mean, spread = estimate(scene, 256)
        means.append(mean)
        spreads.append(spread)
    for mean, spread in zip(means[1:], spreads[1:], strict=True):
        assert np.abs(mean - means[0]).max() <= np.hypot(spread, spreads[0]).max()


def test_both_are_quiet_where_either_is_loud(make_scene: MakeScene) -> None:
    """A small ball in a wide lobe, and a large one in a narrow lobe: both have less than a fifth of the worse error."""
    for radius, exponent, worse in ((0.02, 5, "lobe"), (1.2, 4000, "lamp")):
        gloss = {"lobe": "phong", "exponent": exponent}
        noise = {}
        for way in (worse, "power"):
            scene = plate(
                make_scene,
                way,
                BALL | {"radius": radius},
                materials={"glossy": {"color": 0, "mirror": MIRROR, "gloss": gloss}},
            )
            noise[way] = float(render(scene, compiled=False).linear[..., 0].std())
        assert noise["power"] < noise[worse] / 5


WIDE, NARROW = BALL | {"radius": 1.2}, {"lobe": "phong", "exponent": 4000}


@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_a_lobe_finds_a_much_wider_lamp_alone(make_scene: MakeScene, kind: str) -> None:
    """No shadow ray is cast, and nothing of the lamp is lost: all of the narrow lobe lies within it."""
    glossy = {"glossy": {"color": 0, "mirror": MIRROR, "gloss": NARROW}}
    for way in ("balance", "power"):
        rules = {"type": kind, "max_depth": 1, "gloss_sampling": way}
        scene = plate(make_scene, way, WIDE, materials=glossy, integrator=rules)
        picture = render(scene, compiled=False)
        np.testing.assert_allclose(picture.linear, MIRROR * RADIANCE, rtol=1e-5)
        assert picture.receipt.rays["shadow"] == 0


@pytest.mark.parametrize("way", ["lamp", "balance", "power"])
def test_points_that_are_left_out_count_nothing(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, way: str
) -> None:
    """Where a lamp is wide, where a lobe doesn't reach it, and anywhere else, on a plate that is seen whole."""
    camera = {"eye": [4, 4, 0], "look_at": [0, 0, 0], "vertical_fov": 20}
    lamps = [BALL | {"center": [-1.2, 1, z], "radius": r} for z, r in ((-0.6, 0.5), (0.4, 0.05))]
    means = []
    for left_out in (True, False):
        if not left_out:
            monkeypatch.setattr(Combining, "asks", lambda *_: None)
        glossy = {"glossy": {"color": 0, "mirror": MIRROR, "gloss": NARROW | {"exponent": 300}}}
        scene = plate(make_scene, way, BALL, materials=glossy, camera=camera, lights=lamps)
        means.append(render(scene, compiled=False).linear)
    assert means[0].max() > 0
    np.testing.assert_allclose(*means, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize(
    ("way", "lamp", "calls"),
    [
        ("lobe", BALL, set()),
        ("lamp", BALL, {"cone_density"}),
        ("power", BALL, {"cone_density", "heuristic_weights"}),
        ("balance", SHEET, {"area_density", "heuristic_weights"}),
        # Lobes look for points on what is seen of it.
        ("power", BALL | {"samples": "sphere"}, {"cone_density", "heuristic_weights"}),
        # What only one strategy finds.
        ("power", {"type": "point", "position": [0, 2, 0], "intensity": 3}, set()),
        ("power", SHEET | {"visible": False}, set()),
    ],
)
def test_only_what_is_combined_is_called(
    make_scene: MakeScene, way: str, lamp: dict[str, Any], calls: set[str]
) -> None:
    scene = plate(make_scene, way, lamp)
    needed = {need.function for need in scene.compiled.needs}
    assert {name for name in needed if name.startswith("multiple")} == {
        f"multiple_importance.{name}" for name in calls
    }
    assert (scene.compiled.world.combining is None) == (not calls)


@pytest.mark.parametrize(
    "gloss", [None, {"lobe": "ball", "glossiness": 0.2}, {"lobe": "plane", "roughness": 0.2}]
)
def test_lobes_without_a_density_keep_their_bits(make_scene: MakeScene, gloss: Any) -> None:
    material = {"color": 0.3, "mirror": MIRROR} | ({} if gloss is None else {"gloss": gloss})
    pictures = [
        render(plate(make_scene, way, BALL, materials={"glossy": material})).linear
        for way in ("lobe", "power")
    ]
    assert np.array_equal(*pictures)


def test_a_student_s_weights_are_used(make_scene: MakeScene, tmp_path: Path) -> None:
    """With weights of 1 for both, the lamp is twice as bright."""
    folder = tmp_path / "mine"
    folder.mkdir()
    for file in (PROJECT / "solutions").glob("*.py"):
        (folder / file.name).write_bytes(file.read_bytes())
    with (folder / "multiple_importance.py").open("a", encoding="utf-8") as file:
        file.write("\n\ndef heuristic_weights(c, p, e):\n    return np.ones_like(p)\n")
    path = plate(make_scene, "power", BALL).path
    found, spread = estimate(load_scene(path, folder), compiled=False)
    assert np.abs(found - 2 * expected(BALL)).max() <= spread.max() + 4e-3 * expected(BALL)


def test_both_forms_of_the_scene_make_the_same_picture() -> None:
    scene = load_variant(
        PROJECT / "scenes" / "multiple_importance.yaml", {("sampler", "type"): "sobol"}
    )
    plain, fast = (
        render(scene, size=(60, 40), spp=4, compiled=form).linear for form in (False, True)
    )
    same = np.isclose(plain, fast, rtol=1e-3, atol=1e-4).all(axis=2)
    # Packets may find the other triangle at a common edge.
    assert same.mean() > 0.99


# ---------------------------------------------------------------- rough metals

INDEX, ABSORPTION = [0.2, 0.7, 1.3], [3.6, 2.6, 2.3]


def metal(alpha: float) -> dict[str, Any]:
    conductor = {
        "refraction_index": INDEX,
        "absorption_index": ABSORPTION,
        "roughness": alpha,
    }
    return {"glossy": {"color": 0, "mirror": 0.9, "conductor": conductor}}


def reflected(way: Any, alpha: float) -> Any:
    """The metal's BRDF (3,) times the cosine, for light from a direction to the camera of ``plate``."""
    wo, wi = np.array([1, 1, 0]) / math.sqrt(2), np.asarray(way, float) / np.linalg.norm(way)
    wm = (wo + wi) / np.linalg.norm(wo + wi)
    d = alpha**2 / (math.pi * ((alpha**2 - 1) * wm[1] ** 2 + 1) ** 2)
    lambdas = ((math.sqrt(1 + alpha**2 * (1 / w[1] ** 2 - 1)) - 1) / 2 for w in (wo, wi))
    c, eta = float(wo @ wm), (np.array(INDEX) + 1j * np.array(ABSORPTION)) ** 2
    root = np.sqrt(eta - 1 + c * c)
    s, p = (c - root) / (c + root), (eta * c - root) / (eta * c + root)
    fresnel = (abs(s) ** 2 + abs(p) ** 2) / 2
    return 0.9 * fresnel * d / (1 + sum(lambdas)) / (4 * wo[1])


@fewer
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("alpha", [0.05, 0.3, 0.8])
@pytest.mark.usefixtures("each_form")
def test_lights_without_a_surface_shine_on_rough_metals(
    make_scene: MakeScene, alpha: float, kind: str
) -> None:
    """They had been black there. The plate is the only thing, and has one material."""
    places = ([1.0, 2, 1], [-2.0, 2.5, 0])
    sun = {"type": "directional", "direction": [2, -1, 0.5], "irradiance": 0.7}
    points = [{"type": "point", "position": p, "intensity": 4} for p in places]
    rules = {"type": kind, "max_depth": 1}
    scene = plate(
        make_scene, "", points[0], materials=metal(alpha), lights=[*points, sun], integrator=rules
    )
    expected = sum(reflected(p, alpha) * 4 / np.dot(p, p) for p in places)
    expected = expected + 0.7 * reflected([-2, 1, -0.5], alpha)
    np.testing.assert_allclose(
        render(scene).linear, np.broadcast_to(expected, (16, 16, 3)), rtol=1e-4
    )


@fewer
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("lamp", [BALL, SHEET], ids=["ball", "sheet"])
@pytest.mark.parametrize("alpha", [0.05, 0.3])
def test_rough_metals_find_lamps_in_all_ways_alike(
    make_scene: MakeScene, lamp: dict[str, Any], alpha: float, kind: str
) -> None:
    """With the same mean; by themselves they take the power heuristic, where the wide lobe alone is ten times as loud.

    The lamp is matched by midpoints over the sheet too.
    """
    found = {}
    for way in ("automatic", *WAYS):
        rules = {"type": kind, "max_depth": 1, "gloss_sampling": way}
        scene = plate(make_scene, way, lamp, materials=metal(alpha), integrator=rules)
        found[way] = estimate(scene, 256), float(render(scene, compiled=False).linear[..., 0].std())
    (mean, spread), quiet = found["automatic"]
    assert found["power"][1] == quiet
    for way in WAYS:
        (other, others_spread), _ = found[way]
        assert np.abs(other - mean).max() <= np.hypot(spread, others_spread).max()
    if alpha == 0.3:
        assert quiet < found["lobe"][1] / 10
    if lamp is SHEET:
        s, t = np.meshgrid(*[(np.arange(60) + 0.5) / 60] * 2)
        corner, u, v = (np.array(lamp[key], float) for key in ("corner", "edge_u", "edge_v"))
        total = np.zeros(3)
        for a, b in zip(s.ravel(), t.ravel(), strict=True):
            p = corner + a * u + b * v
            cosine = (p[1] - p[0]) / math.sqrt(2) / math.sqrt(p @ p)
            total += reflected(p, alpha) * cosine / (p @ p)
        area = float(np.linalg.norm(np.cross(u, v)))
        assert np.abs(mean - RADIANCE * area * total / s.size).max() <= spread.max() + 2e-3


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize(
    "lamp",
    [
        {"type": "object", "object": "bulb"},
        SHEET | {"samples": "grid 3"},
        BALL | {"motion": {"velocity": [0.1, 0, 0]}},
    ],
    ids=["object", "grid", "moving"],
)
def test_lamps_of_other_kinds_are_left_to_the_lobe(
    make_scene: MakeScene, lamp: dict[str, Any], kind: str
) -> None:
    """Their points aren't weighed, so that of a lamp that rays meet none is looked for."""
    bulb = {"shape": "sphere", "radius": 0.5, "material": "glow", "name": "bulb"}
    bulb |= {"transform": [{"translate": BALL["center"]}], "segments": 64}
    plain = {"shape": "quad", "material": "glossy", "width": 2, "depth": 2}
    parts: dict[str, Any] = {
        "materials": metal(0.3) | {"glow": {"color": 0, "emission": RADIANCE}},
        "objects": [plain, *([bulb] if lamp["type"] == "object" else [])],
        "camera": {"eye": [4, 4, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-4}
        | {"shutter": {"open": 0, "close": 1}},
    }
    pictures = []
    for rules in ({"gloss_sampling": "lobe", "max_depth": 1}, {"max_depth": 1}):
        scene = plate(make_scene, "", lamp, **parts, integrator={"type": kind} | rules)
        assert "microfacets.brdf" not in {need.function for need in scene.compiled.needs}
        pictures.append(render(scene, compiled=False).linear)
    np.testing.assert_array_equal(*pictures)


def test_a_metal_that_nothing_shines_on_asks_for_no_density(make_scene: MakeScene) -> None:
    """What a scene doesn't need isn't called."""
    sky = {"type": "constant", "radiance": 1}
    quad = [{"shape": "quad", "material": "glossy", "width": 2, "depth": 2}]
    for lights, asked in (
        ([], set()),
        ([{"type": "point", "position": [1, 2, 1], "intensity": 4}], {"brdf"}),
    ):
        scene = make_scene(
            materials=metal(0.3),
            objects=quad,
            environment=sky,
            lights=lights,
            integrator={"max_depth": 1},
        )
        named = {need.function for need in scene.compiled.needs}
        assert {f"microfacets.{name}" for name in asked} == named & {
            "microfacets.brdf",
            "microfacets.visible_normal_pdf",
        }
        assert not any(name.startswith("multiple_importance") for name in named)
