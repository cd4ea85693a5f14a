"""Glossy reflection through the engine: nothing is lost, and each lobe has the shape of its formula.

Means are compared as in tests/estimates.py, about 60 of them.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.core.counters import Counters
from course.engine.core.gloss import Gloss
from course.engine.core.rays import Dimensions, Draws
from course.engine.core.samplers import Block
from course.engine.terms.samplers import make_sampler
from tests.conftest import MakeScene
from tests.estimates import estimate
from tests.lengths import fewer

Array = NDArray[np.float64]

LOBES: list[dict[str, Any]] = [
    *({"lobe": "plane", "roughness": r} for r in (0, 1e-3, 0.1, 0.7, 2, 50)),
    *({"lobe": "ball", "glossiness": g} for g in (0, 1e-3, 0.1, 0.5, 0.9, 0.999)),
    *({"lobe": "phong", "exponent": e} for e in (0, 1, 20, 1000, 1e6)),
]


def name(lobe: dict[str, Any]) -> str:
    return "-".join(str(value) for value in lobe.values())


@pytest.mark.parametrize("shading", ["smooth", "flat"])
@pytest.mark.parametrize("lobe", LOBES, ids=name)
def test_white_furnace(make_scene: MakeScene, lobe: dict[str, Any], shading: str) -> None:
    # Convex bodies one at a time: each ray leaves after one bounce, into an environment of 1.
    for shape in ({"shape": "sphere", "segments": 24}, {"shape": "box"}, {"shape": "cone"}):
        scene = make_scene(
            camera={"eye": [1, 2, 3], "look_at": [0, 0, 0]},
            environment={"type": "constant", "radiance": 1},
            materials={"mirror": {"mirror": 1, "gloss": lobe}},
            objects=[shape | {"material": "mirror", "shading": shading}],
            integrator={"cutoff": 0, "max_depth": 1},
        )
        picture = render(scene)
        assert np.allclose(picture.linear, 1, rtol=0, atol=1e-6)
        assert picture.receipt.rays["reflection"] > 250


@pytest.mark.parametrize("lobe", LOBES, ids=name)
def test_white_furnace_between_bodies(make_scene: MakeScene, lobe: dict[str, Any]) -> None:
    # Rays go on from body to body until they leave. Between a ball and a floor that touch, some bounce long.
    ball = {"shape": "sphere", "material": "mirror", "radius": 0.6, "segments": 48}
    scene = make_scene(
        camera={"eye": [1, 2, 3], "look_at": [0, 0, 0]},
        environment={"type": "constant", "radiance": [1, 2, 0.5]},
        materials={"mirror": {"mirror": 1, "gloss": lobe}},
        objects=[
            {"shape": "quad", "material": "mirror", "width": 3, "depth": 3},
            ball | {"transform": [{"translate": [-0.5, 0.7, 0]}]},
            ball | {"transform": [{"translate": [0.8, 0.7, 0.4]}], "shading": "flat"},
        ],
        integrator={"cutoff": 0, "max_depth": 64},
    )
    linear = render(scene).linear
    assert np.allclose(linear, [1, 2, 0.5], rtol=1e-6)


def test_channels_keep_their_own_reflectance(make_scene: MakeScene) -> None:
    scene = make_scene(
        environment={"type": "constant", "radiance": 1},
        materials={"mirror": {"mirror": [1, 0.5, 0.25], "gloss": LOBES[3]}},
        objects=[{"shape": "quad", "material": "mirror", "width": 90, "depth": 90}
                 | {"transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]}],
    )  # fmt: skip
    assert np.allclose(render(scene).linear, [1, 0.5, 0.25], rtol=1e-6)


def seen(make_scene: MakeScene, lobe: dict[str, Any], eye: list[float], *lights: Any) -> Scene:
    """A glossy floor seen in the origin, before an environment of (0, 1, 0); the lights are red and blue."""
    return make_scene(
        camera={"eye": eye, "look_at": [0, 0, 0], "vertical_fov": 1e-3},
        film={"width": 16, "height": 16},
        environment={"type": "constant", "radiance": [0, 1, 0]},
        materials={"mirror": {"mirror": 1, "gloss": lobe}},
        objects=[{"shape": "quad", "material": "mirror", "width": 2, "depth": 2}],
        lights=list(lights),
        integrator={"max_depth": 1},
    )


def share(scene: Scene, samples: int) -> tuple[float, float]:
    """How much of the lobe hits the light, and 5 standard errors."""
    mean, tolerance = estimate(scene, samples)
    assert mean.sum() == pytest.approx(1, abs=1e-5), "either the light or the environment"
    return float(mean[0]), float(tolerance[0])


def within(lobe: dict[str, Any], alpha: float) -> float:
    """The share of a lobe whose angle to the axis is below alpha, by the formula of its docstring."""
    match lobe:
        case {"lobe": "phong", "exponent": exponent}:
            return 1 - math.cos(alpha) ** (exponent + 1)
        case {"lobe": "plane", "roughness": roughness}:
            # The part of a square of side 1 within a circle around its middle.
            s = np.abs(np.arange(2000) + 0.5 - 1000) / 2000
            height = np.sqrt(np.maximum((math.tan(alpha) / roughness) ** 2 - s**2, 0))
            return float(np.minimum(2 * height, 1).mean())
        case {"lobe": "ball", "glossiness": glossiness}:
            # A ball around (0, 0, 1) and the cone around z: rings at height z, up to z tan(alpha).
            z = 1 + glossiness * (np.arange(20000) + 0.5 - 10000) / 10000
            squared = glossiness**2 - (z - 1) ** 2
            inside = np.minimum(squared, (z * math.tan(alpha)) ** 2)
            return float(inside.sum() / squared.sum())
    raise AssertionError


@pytest.mark.parametrize(
    ("lobe", "alpha"),
    [
        *(({"lobe": "plane", "roughness": 0.4}, a) for a in (0.05, 0.1, 0.19, 0.24)),
        *(({"lobe": "ball", "glossiness": 0.3}, a) for a in (0.05, 0.1, 0.2, 0.28)),
        *(({"lobe": "phong", "exponent": 40}, a) for a in (0.05, 0.1, 0.2, 0.4)),
        *(({"lobe": "phong", "exponent": 2}, a) for a in (0.2, 0.6)),
    ],
    ids=str,
)
def test_a_lobe_puts_its_share_into_each_cone_about_the_mirrored_direction(
    make_scene: MakeScene, lobe: dict[str, Any], alpha: float
) -> None:
    # A ball of light fills the cone, but for the 3e-4 radii by which its mesh lies inside.
    mirrored = np.array([0.3, 1.0, -0.2]) / np.linalg.norm([0.3, 1.0, -0.2])
    eye = 3 * mirrored * [-1, 1, -1]
    ball = {"type": "sphere", "center": (4 * mirrored).tolist(), "radius": 4 * math.sin(alpha)}
    scene = seen(make_scene, lobe, eye.tolist(), ball | {"radiance": [1, 0, 0]})
    mean, tolerance = share(scene, 256)
    exact = within(lobe, alpha)
    least = within(lobe, alpha * (1 - 4e-4))
    assert 0.01 < exact < 0.999
    assert tolerance < 0.02, "the estimate is worth something"
    # phong of exponent 2 about a direction 20 degrees off the normal: what fell below comes back from beyond the cone.
    assert least - tolerance <= mean <= exact + tolerance


@fewer
@pytest.mark.parametrize(
    "lobe",
    [
        {"lobe": "plane", "roughness": 0.5},
        {"lobe": "ball", "glossiness": 0.5},
        {"lobe": "phong", "exponent": 10},
    ],
    ids=name,
)
@pytest.mark.parametrize("turn", [0.0, 0.7, 1.6, 2.9])
def test_a_lobe_is_balanced_about_the_mirrored_direction(
    make_scene: MakeScene, lobe: dict[str, Any], turn: float
) -> None:
    # Half of what leaves straight up goes to each side of any vertical plane: a light from there to far away.
    across, along = np.array([math.cos(turn), 0, math.sin(turn)]), np.array(
        [-math.sin(turn), 0, math.cos(turn)]
    )  # fmt: skip
    corner = np.array([0, 0.5, 0]) - 1000 * along
    light = {"type": "rectangle", "corner": corner.tolist(), "radiance": [1, 0, 0]}
    edges = {"edge_u": (1000 * across).tolist(), "edge_v": (2000 * along).tolist()}
    if np.cross(edges["edge_u"], edges["edge_v"])[1] > 0:
        edges = {"edge_u": edges["edge_v"], "edge_v": edges["edge_u"]}
    # The camera looks from below the light, straight down.
    scene = seen(make_scene, lobe, [0, 0.4, 1e-4], light | edges)
    mean, tolerance = share(scene, 256)
    # The camera leans by 2.5e-4 radians; no lobe here has more than 2 per radian in its middle.
    assert abs(mean - 0.5) <= tolerance + 1e-3


@fewer
@pytest.mark.parametrize(
    "lobe",
    [
        {"lobe": "ball", "glossiness": 0.6},
        {"lobe": "ball", "glossiness": 0.95},
        {"lobe": "phong", "exponent": 3},
        {"lobe": "phong", "exponent": 60},
    ],
    ids=name,
)
@pytest.mark.parametrize("degrees", [30.0, 75.0, 88.0])
def test_reflection_of_a_two_coloured_environment_with_what_fell_below_mirrored_up(
    make_scene: MakeScene, lobe: dict[str, Any], degrees: float
) -> None:
    # The light covers the upward directions whose x / y is between 0.2 and 500, and |z / y| below 500.
    angle = math.radians(degrees)
    mirrored = np.array([math.sin(angle), math.cos(angle), 0.0])
    light = {"type": "rectangle", "corner": [0.2, 1, -500], "edge_u": [499.8, 0, 0]} | {
        "edge_v": [0, 0, 1000],
        "radiance": [1, 0, 0],
    }
    eye = (0.9 * mirrored * [-1, 1, 1]).tolist()
    mean, tolerance = share(seen(make_scene, lobe, eye, light), 1024)
    d = directions(lobe, mirrored)
    d[1] = np.abs(d[1])
    with np.errstate(divide="ignore"):
        hits = (d[0] > 0.2 * d[1]) & (d[0] < 500 * d[1]) & (np.abs(d[2]) < 500 * d[1])
    exact = float(hits.mean())
    # Cells that the border cuts: about 1 in 500 of the quadrature's.
    assert abs(mean - exact) <= tolerance + 2e-3


def directions(lobe: dict[str, Any], axis: Array) -> Array:
    """(3, M) directions that stand for equal shares of a lobe; not normalised for the ball."""
    k = 1000
    phi = 2 * np.pi * (np.arange(k) + 0.5) / k
    if lobe["lobe"] == "phong":
        along = (((np.arange(k) + 0.5) / k) ** (1 / (lobe["exponent"] + 1)))[:, None]
        across = np.sqrt(1 - along**2)
    else:
        # Slices of the ball with equal volumes, and rings of equal areas in them.
        z = np.linspace(-1, 1, 200001)
        z = np.interp((np.arange(100) + 0.5) / 100, (3 * z - z**3 + 2) / 4, z)[:, None, None]
        along = 1 + lobe["glossiness"] * z
        share = ((np.arange(100) + 0.5) / 100)[:, None]
        across = lobe["glossiness"] * np.sqrt((1 - z**2) * share)
        phi = phi[::5]
    a = np.cross(axis, [0.1, 0.2, 1.0])
    a /= np.linalg.norm(a)
    b = np.cross(axis, a)
    parts = np.broadcast_arrays(along, across * np.cos(phi), across * np.sin(phi))
    c, s, t = (x.ravel() for x in parts)
    return np.asarray(axis[:, None] * c + a[:, None] * s + b[:, None] * t)


@pytest.mark.parametrize("exponent", [0.0, 1.0, 10.0, 500.0])
@pytest.mark.parametrize("sampler", ["sobol", "random"])
def test_the_engine_scatters_by_the_phong_lobe(
    make_scene: MakeScene, exponent: float, sampler: str
) -> None:
    # cos(alpha)^(exponent + 1) and the angle about the axis are uniform and independent: 8 x 8 cells, 2^16 random
    # directions. Chi-squared with 63 degrees of freedom is over 150 in 4e-9 of all cases; Sobol points stay below it.
    lobe = {"lobe": "phong", "exponent": exponent}
    scene = seen(make_scene, lobe, [0, 1, 0.01])
    assert len(scene.compiled.world.lobes) == 1
    places = [scene.effects.function("supersampling", "random")] if sampler == "random" else []
    draws = Draws(
        make_sampler(sampler, 2, *places),
        Dimensions([("before", 6)], [("gloss", 2)]),
        Block(np.arange(1024, dtype=np.uint32), 0, 64, 0),
        Counters(),
    )
    n = 1024 * 64
    axis = np.array([0.36, 0.48, 0.8])
    mirrored = np.repeat(axis.astype(np.float32)[:, None], n, axis=1)
    gloss, material = Gloss(scene.compiled.world.lobes), np.zeros(n, np.uint16)
    # Its own axis as the normal: nothing falls below.
    out = gloss(material, mirrored.copy(), mirrored, np.arange(n), 0, draws).astype(np.float64)
    assert draws.counters.numbers == {"gloss": 2 * n}
    assert np.allclose(np.linalg.norm(out, axis=0), 1, atol=1e-5)
    a = np.array([0.8, -0.6, 0.0])
    b = np.cross(axis, a)
    phi = np.arctan2(b @ out, a @ out) / (2 * np.pi) % 1
    radial = np.clip(axis @ out, 0, 1) ** (exponent + 1)
    cells = np.floor(radial * 8).clip(max=7) * 8 + np.floor(phi * 8).clip(max=7)
    counts = np.bincount(cells.astype(int), minlength=64)
    assert ((counts - n / 64) ** 2).sum() / (n / 64) < 150


def test_each_material_keeps_its_own_lobe(make_scene: MakeScene) -> None:
    # Side by side, a sharp mirror, two lobes and a surface without: each as if it were alone.
    lobes = [None, {"lobe": "phong", "exponent": 5}, {"lobe": "ball", "glossiness": 0.4}]
    names = ["sharp", "wide", "ball"]
    materials = {n: {"mirror": 1, "gloss": lobe} for n, lobe in zip(names, lobes, strict=True)}
    quad = {"shape": "quad", "width": 1.5, "depth": 4}
    objects = [
        quad | {"material": n, "transform": [{"translate": [1.6 * k - 1.6, 0, 0]}]}
        for k, n in enumerate(names)
    ]
    sky = {"type": "rectangle", "corner": [-100, 3, -100], "edge_u": [100, 0, 0]} | {
        "edge_v": [0, 0, 200],
        "radiance": 1,
    }
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 2.9, 0.01], "look_at": [0, 0, 0], "vertical_fov": 60},
        "film": {"width": 24, "height": 12},
        "lights": [sky],
        "sampler": {"type": "sobol", "samples": 64},
        "integrator": {"max_depth": 1},
    }
    together = render(make_scene(**parts, materials=materials, objects=objects)).linear[..., 0]
    rows = together.mean(axis=0)
    # The camera sees the sharp mirror left, with the border of the light in its pixels only; the lobes blur it.
    for k, n in enumerate(names):
        others = [objects[j] | {"material": n} for j in range(3)]
        alone = render(make_scene(**parts, materials={n: materials[n]}, objects=others)).linear
        columns = slice(8 * k + 2, 8 * k + 6)
        # The same estimate from other pixels' numbers: 64 x 48 samples of at most variance 1/4 each, 6 deviations.
        difference = rows[columns] - alone[..., 0].mean(axis=0)[columns]
        assert np.abs(difference).max() < 6 * math.sqrt(2 * 0.25 / (12 * 64))
