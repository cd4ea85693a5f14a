"""Lamps in lobes at float32's extremes: each way of looking for them brings what quadrature in float64 finds.

A lamp lies in the mirrored direction of one point of a plate, at any distance, of any size, and at any angle to the
plate. What the plate reflects is an integral of its lobe over the lamp. It is worked out here over a grid on the
narrower of the two: over directions to the lamp, or over those of the lobe. The renderer's numbers are Sobol's, so
means err by far less than 2%.
"""

import itertools
import math
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import render
from course.engine.functions.effects import Effects
from course.engine.terms.scattering.microfacets import Microfacets
from tests.conftest import MakeScene
from tests.lengths import fewer

Array = NDArray[np.float64]
N = 300
GRID = np.stack(np.meshgrid(*[(np.arange(N) + 0.5) / N] * 2)).reshape(2, -1)
ACROSS = np.array([0.0, 0, 1])

LOBES: dict[str, dict[str, Any]] = {
    "diffuse": {},
    "phong 1": {"exponent": 1.0},
    "phong 300": {"exponent": 300.0},
    "phong 1e6": {"exponent": 1e6},
    "metal 1": {"alpha": 1.0},
    "metal .1": {"alpha": 0.1},
    "metal .001": {"alpha": 0.001},
}
PLACES = [(2.8, 0.6), (2.8, 1e-3), (2.8, 1e-6), (1e6, 3e5), (1e6, 1.0), (1e-2, 3e-3), (1e-3, 1e-5)]
"""Distances and radii; the plate is 2 wide."""
LAMPS = ["sphere", "visible", "rectangle"]


@dataclass(frozen=True)
class Seen:
    """Which way the plate is seen: by the elevation [radian], of which the smaller of sine and cosine is exact."""

    sine: float = math.sqrt(0.5)
    cosine: float = math.sqrt(0.5)

    @cached_property
    def view(self) -> Array:
        """To the eye."""
        return np.array([self.cosine, self.sine, 0])

    @cached_property
    def axis(self) -> Array:
        """The mirrored direction."""
        return np.array([-self.cosine, self.sine, 0])


def elevated(angle: float) -> Seen:
    return Seen(math.sin(angle), math.cos(angle))


def inclined(angle: float) -> Seen:
    return Seen(math.cos(angle), math.sin(angle))


def around(axis: Array, x: Array, y: Array, z: Array) -> Array:
    """Vectors (3, n) with these coordinates, the last along the axis."""
    other = np.cross(axis, ACROSS)
    return ACROSS[:, None] * x + other[:, None] * y + axis[:, None] * z


def reflected(lobe: dict[str, Any], way: Array, seen: Seen = Seen()) -> Array:
    """The BRDF times the cosine, for light from directions (3, n)."""
    if not lobe:
        return np.maximum(way[1], 0) / math.pi
    if "exponent" in lobe:
        n = lobe["exponent"]
        dense = np.zeros(way.shape[1])
        for axis in (seen.axis, -seen.view):
            # What points below the surface is mirrored up again.
            off = way - axis[:, None]
            cosine = 1 - np.minimum((off * off).sum(axis=0) / 2, 1)
            dense += np.exp(n * np.log(np.maximum(cosine, 1e-300)))
        return np.where(way[1] > 0, (n + 1) / (2 * math.pi) * dense, 0)
    alpha = lobe["alpha"]
    wm = way + seen.view[:, None]
    wm /= np.linalg.norm(wm, axis=0)
    flat = wm[0] ** 2 + wm[2] ** 2
    d = alpha**2 / (math.pi * (flat + (alpha * wm[1]) ** 2) ** 2)
    up = np.maximum(way[1], 1e-12)
    lambdas = [(np.sqrt(1 + alpha**2 * (1 / c**2 - 1)) - 1) / 2 for c in (up, seen.sine)]
    return np.where(way[1] > 0, d / (1 + lambdas[0] + lambdas[1]) / (4 * seen.sine), 0)


def width(lobe: dict[str, Any]) -> float:
    if not lobe:
        return math.inf
    return 2 * lobe["alpha"] if "alpha" in lobe else 1 / math.sqrt(lobe["exponent"] + 1)


def directions(lobe: dict[str, Any], seen: Seen = Seen()) -> tuple[Array, Array]:
    """Directions (3, n) of the lobe about its axis, or its mirror image, and what each counts."""
    u, phi = GRID[0], 2 * math.pi * GRID[1]
    if "exponent" in lobe:
        cosine = (1 - u) ** (1 / (lobe["exponent"] + 1))
        sine = np.sqrt(-np.expm1(2 * np.log1p(-u) / (lobe["exponent"] + 1)))
        way = around(seen.axis, sine * np.cos(phi), sine * np.sin(phi), cosine)
        way[1] = np.abs(way[1])
        return way, np.ones_like(u)
    alpha = lobe["alpha"]
    tangent = alpha * np.sqrt(u / (1 - u))
    cosine = 1 / np.sqrt(1 + tangent**2)
    wm = around(
        np.array([0.0, 1, 0]), *(tangent * cosine * f(phi) for f in (np.cos, np.sin)), cosine
    )
    facing = seen.view @ wm
    way = 2 * facing * wm - seen.view[:, None]
    density = alpha**2 / (math.pi * (1 - cosine**2 + (alpha * cosine) ** 2) ** 2) * cosine
    return way, reflected(lobe, way, seen) * 4 * np.maximum(facing, 0) / density


def meets(lamp: str, way: Array, distance: float, radius: float, seen: Seen = Seen()) -> Array:
    """Which directions (3, n) meet the lamp."""
    along = seen.axis @ way
    if lamp != "rectangle":
        met = 1 - along**2 < (radius / distance) ** 2
    else:
        with np.errstate(divide="ignore"):
            there = np.abs(way - along * seen.axis[:, None]) * distance / along
        met = np.maximum(there[2], np.hypot(there[0], there[1])) < radius
    return np.asarray(met & (along > 0))


def expected(
    lobe: dict[str, Any], lamp: str, distance: float, radius: float, seen: Seen = Seen()
) -> float:
    """What the plate reflects of a lamp of radiance 1."""
    if radius / distance > 10 * width(lobe):
        way, count = directions(lobe, seen)
        return float((count * meets(lamp, way, distance, radius, seen)).mean())
    if lamp != "rectangle":
        opening = (radius / distance) ** 2 / (1 + math.sqrt(1 - (radius / distance) ** 2))
        sunk, phi = opening * GRID[0], 2 * math.pi * GRID[1]
        sine = np.sqrt(sunk * (2 - sunk))
        way = around(seen.axis, sine * np.cos(phi), sine * np.sin(phi), 1 - sunk)
        return float(reflected(lobe, way, seen).mean() * 2 * math.pi * opening)
    a, b = radius * (2 * GRID - 1)
    way = around(seen.axis, a, b, np.full(a.shape, distance))
    far = np.linalg.norm(way, axis=0)
    return float((reflected(lobe, way / far, seen) * distance / far**3).mean() * 4 * radius**2)


def found(
    make_scene: MakeScene,
    lobe: dict[str, Any],
    lamp: str,
    where: tuple[float, float],
    way: str,
    seen: Seen = Seen(),
) -> float:
    """What the renderer finds, of a lamp of radiance 1."""
    distance, radius = where
    center = seen.axis * distance
    if lamp == "rectangle":
        # It shines towards cross(u, v): along the axis, backwards.
        u, v = 2 * radius * np.cross(seen.axis, ACROSS), 2 * radius * ACROSS
        light = {"type": lamp, "corner": (center - (u + v) / 2).tolist()}
        light |= {"edge_u": u.tolist(), "edge_v": v.tolist()}
    else:
        light = {"type": "sphere", "center": center.tolist(), "radius": radius, "samples": lamp}
    material: dict[str, Any] = {"color": 0, "mirror": 1}
    if not lobe:
        material = {"color": 1}
    elif "exponent" in lobe:
        material |= {"gloss": {"lobe": "phong", "exponent": lobe["exponent"]}}
    else:
        index = {"refraction_index": 0, "absorption_index": 1}
        material |= {"conductor": index | {"roughness": lobe["alpha"]}}
    scene = make_scene(
        camera={
            "eye": (seen.view * 1.5).tolist(),
            "look_at": [0, 0, 0],
            "up": [0, 0, 1],
            "vertical_fov": 1e-7,
        },
        film={"width": 16, "height": 16},
        sampler={"type": "sobol", "samples": 16},
        materials={"plate": material},
        objects=[{"shape": "quad", "material": "plate", "width": 2, "depth": 2}],
        lights=[light | {"radiance": 1.0}],
        integrator={"max_depth": 1, "gloss_sampling": way},
    )
    return float(render(scene, compiled=False).linear.mean(dtype=np.float64))


def ways(lobe: dict[str, Any], where: tuple[float, float]) -> list[str]:
    """Both together; and one alone, unless hardly any of its directions were those of the other."""
    wide = where[1] / where[0] / width(lobe)
    alone = [way for way, able in (("lamp", wide < 1), ("lobe", wide > 0.5)) if able]
    return ["balance", "power", *alone]


TABLE = [*itertools.product(LOBES, PLACES, LAMPS)]


@fewer
@pytest.mark.parametrize("lamp", LAMPS)
@pytest.mark.parametrize("where", PLACES, ids=str)
@pytest.mark.parametrize("lobe", LOBES)
def test_lamps_in_lobes_are_as_bright_as_quadrature_says(
    make_scene: MakeScene, lobe: str, where: tuple[float, float], lamp: str
) -> None:
    """Each of the ways takes its turn."""
    able = ways(LOBES[lobe], where)
    way = able[TABLE.index((lobe, where, lamp)) % len(able)]
    right = expected(LOBES[lobe], lamp, *where)
    assert found(make_scene, LOBES[lobe], lamp, where, way) == pytest.approx(right, rel=0.02), way


ANGLES = {
    "upright 1e-6": inclined(1e-6),
    "upright 1e-3": inclined(1e-3),
    "60 degrees": inclined(math.pi / 3),
    "grazing 1e-1": elevated(1e-1),
    "grazing 1e-3": elevated(1e-3),
    "grazing 1e-6": elevated(1e-6),
}
"""To the normal, and to the plate."""


@fewer
@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("where", [(2.8, 0.6), (2.8, 1e-6), (1e6, 1.0)], ids=str)
@pytest.mark.parametrize("lobe", LOBES)
def test_lamps_are_as_bright_at_any_angle(
    make_scene: MakeScene, lobe: str, where: tuple[float, float], angle: str
) -> None:
    """But for the smoothest metal next to grazing: rounding turns normals there by more than they are spread."""
    seen = ANGLES[angle]
    if LOBES[lobe].get("alpha") == 0.001 and seen.sine < 1e-3:
        return
    number = list(ANGLES).index(angle) + list(LOBES).index(lobe)
    lamp, able = LAMPS[number % 3], ways(LOBES[lobe], where)
    way = able[number % len(able)]
    right = expected(LOBES[lobe], lamp, *where, seen)
    here = found(make_scene, LOBES[lobe], lamp, where, way, seen)
    assert here == pytest.approx(right, rel=0.02), (lamp, way)


@pytest.mark.parametrize("angle", ["upright 1e-6", "60 degrees", "grazing 1e-1", "grazing 1e-3"])
@pytest.mark.parametrize("alpha", [0.001, 0.1, 1.0])
def test_densities_of_microfacets_keep_their_digits(alpha: float, angle: str) -> None:
    """For directions that are units but for rounding: in float32 the normal halfway between them would be another."""
    seen = ANGLES[angle]
    t, phi = (GRID[:, ::50] - [[0], [0.5]]) * [[4 * alpha], [2 * math.pi]]
    wm = around(np.array([0.0, 1, 0]), t * np.cos(phi), t * np.sin(phi), np.ones_like(t))
    wm /= np.linalg.norm(wm, axis=0)
    way = 2 * (seen.view @ wm) * wm - seen.view[:, None]
    wm, way = (each[:, (way[1] > 0) & (seen.view @ wm > 0)] for each in (wm, way))
    to_eye = np.repeat(seen.view.astype(np.float32)[:, None], way.shape[1], axis=1)
    up = np.zeros_like(to_eye)
    up[1] = 1
    pdf = Effects("solutions").function("microfacets", "visible_normal_pdf")
    functions: Any = SimpleNamespace(visible_normal_pdf=pdf)
    one = Microfacets(0, alpha, np.zeros(3), np.ones(3), functions)
    got = one.density(-to_eye, up, way.astype(np.float32))
    a, b = to_eye.astype(np.float64), way.astype(np.float32).astype(np.float64)
    a, b = a / np.linalg.norm(a, axis=0), b / np.linalg.norm(b, axis=0)
    wm = (a + b) / np.linalg.norm(a + b, axis=0)
    flat = wm[0] ** 2 + wm[2] ** 2
    d = alpha**2 / (math.pi * (flat + (alpha * wm[1]) ** 2) ** 2)
    g1 = 2 / (1 + np.sqrt(1 + alpha**2 * (1 / a[1] ** 2 - 1)))
    np.testing.assert_allclose(got, d * g1 / (4 * a[1]), rtol=1e-5)
