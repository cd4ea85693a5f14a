"""Lamps in lobes at float32's extremes: each way of looking for them brings what quadrature in float64 finds.

A lamp lies in the mirrored direction of one point of a plate, at any distance and of any size. What the plate reflects
is an integral of its lobe over the lamp. It is worked out here over a grid on the narrower of the two: over directions
to the lamp, or over those of the lobe. The renderer's numbers are Sobol's, so means err by far less than 2%.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from tests.conftest import MakeScene

Array = NDArray[np.float64]
VIEW = np.array([1.0, 1.0, 0]) / math.sqrt(2)
AXIS = np.array([-1.0, 1.0, 0]) / math.sqrt(2)
N = 400
GRID = np.stack(np.meshgrid(*[(np.arange(N) + 0.5) / N] * 2)).reshape(2, -1)

LOBES: dict[str, dict[str, Any]] = {
    "phong 1": {"exponent": 1.0},
    "phong 300": {"exponent": 300.0},
    "phong 1e6": {"exponent": 1e6},
    "metal 1": {"alpha": 1.0},
    "metal .1": {"alpha": 0.1},
    "metal .001": {"alpha": 0.001},
}
PLACES = [(2.8, 0.6), (2.8, 1e-3), (2.8, 1e-6), (1e6, 3e5), (1e6, 1.0), (1e-2, 3e-3), (1e-3, 1e-5)]
"""Distances and radii; the plate is 2 wide."""


def around(axis: Array, x: Array, y: Array, z: Array) -> Array:
    """Vectors (3, n) with these coordinates, the last along the axis."""
    side = np.array([0.0, 0, 1])
    other = np.cross(axis, side)
    return side[:, None] * x + other[:, None] * y + axis[:, None] * z


def reflected(lobe: dict[str, Any], way: Array) -> Array:
    """The BRDF times the cosine, for light from directions (3, n)."""
    if "exponent" in lobe:
        n = lobe["exponent"]
        dense = np.zeros(way.shape[1])
        for axis in (AXIS, -VIEW):
            # What points below the surface is mirrored up again.
            off = way - axis[:, None]
            cosine = 1 - np.minimum((off * off).sum(axis=0) / 2, 1)
            dense += np.exp(n * np.log(np.maximum(cosine, 1e-300)))
        return np.where(way[1] > 0, (n + 1) / (2 * math.pi) * dense, 0)
    alpha = lobe["alpha"]
    wm = way + VIEW[:, None]
    wm /= np.linalg.norm(wm, axis=0)
    flat = wm[0] ** 2 + wm[2] ** 2
    d = alpha**2 / (math.pi * (flat + (alpha * wm[1]) ** 2) ** 2)
    up = np.maximum(way[1], 1e-12)
    lambdas = [(np.sqrt(1 + alpha**2 * (1 / c**2 - 1)) - 1) / 2 for c in (up, VIEW[1])]
    return np.where(way[1] > 0, d / (1 + lambdas[0] + lambdas[1]) / (4 * VIEW[1]), 0)


def width(lobe: dict[str, Any]) -> float:
    return 2 * lobe["alpha"] if "alpha" in lobe else 1 / math.sqrt(lobe["exponent"] + 1)


def directions(lobe: dict[str, Any]) -> tuple[Array, Array]:
    """Directions (3, n) of the lobe about its axis, or its mirror image, and what each counts."""
    u, phi = GRID[0], 2 * math.pi * GRID[1]
    if "exponent" in lobe:
        cosine = (1 - u) ** (1 / (lobe["exponent"] + 1))
        sine = np.sqrt(-np.expm1(2 * np.log1p(-u) / (lobe["exponent"] + 1)))
        way = around(AXIS, sine * np.cos(phi), sine * np.sin(phi), cosine)
        way[1] = np.abs(way[1])
        return way, np.ones_like(u)
    alpha = lobe["alpha"]
    tangent = alpha * np.sqrt(u / (1 - u))
    cosine = 1 / np.sqrt(1 + tangent**2)
    wm = around(
        np.array([0.0, 1, 0]), *(tangent * cosine * f(phi) for f in (np.cos, np.sin)), cosine
    )
    facing = VIEW @ wm
    way = 2 * facing * wm - VIEW[:, None]
    density = alpha**2 / (math.pi * (1 - cosine**2 + (alpha * cosine) ** 2) ** 2) * cosine
    return way, reflected(lobe, way) * 4 * np.maximum(facing, 0) / density


def expected(lobe: dict[str, Any], lamp: str, distance: float, radius: float) -> float:
    """What the plate reflects of a lamp of radiance 1."""
    if radius / distance > 10 * width(lobe):
        way, count = directions(lobe)
        along = AXIS @ way
        if lamp == "sphere":
            met = 1 - along**2 < (radius / distance) ** 2
        else:
            with np.errstate(divide="ignore"):
                there = np.abs(way - along * AXIS[:, None]) * distance / along
            a, b = there[2], np.hypot(there[0], there[1])
            met = np.maximum(a, b) < radius
        return float((count * (met & (along > 0))).mean())
    if lamp == "sphere":
        opening = (radius / distance) ** 2 / (1 + math.sqrt(1 - (radius / distance) ** 2))
        sunk, phi = opening * GRID[0], 2 * math.pi * GRID[1]
        sine = np.sqrt(sunk * (2 - sunk))
        way = around(AXIS, sine * np.cos(phi), sine * np.sin(phi), 1 - sunk)
        return float(reflected(lobe, way).mean() * 2 * math.pi * opening)
    a, b = radius * (2 * GRID - 1)
    way = around(AXIS, a, b, np.full(a.shape, distance))
    far = np.linalg.norm(way, axis=0)
    return float((reflected(lobe, way / far) * distance / far**3).mean() * 4 * radius**2)


def plate(
    make_scene: MakeScene, lobe: dict[str, Any], lamp: str, where: tuple[float, float], way: str
) -> Scene:
    """The lamp as bright as makes about 1 of it."""
    distance, radius = where
    center = AXIS * distance
    if lamp == "rectangle":
        u, v = 2 * radius * VIEW, np.array([0, 0, 2 * radius])
        light = {"type": lamp, "corner": (center - (u + v) / 2).tolist()}
        light |= {"edge_u": u.tolist(), "edge_v": v.tolist()}
    else:
        light = {"type": "sphere", "center": center.tolist(), "radius": radius, "samples": lamp}
    if "exponent" in lobe:
        material = {"gloss": {"lobe": "phong", "exponent": lobe["exponent"]}}
    else:
        index = {"refraction_index": 0, "absorption_index": 1}
        material = {"conductor": index | {"roughness": lobe["alpha"]}}
    return make_scene(
        camera={"eye": [4, 4, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-7},
        film={"width": 16, "height": 16},
        sampler={"type": "sobol", "samples": 64},
        materials={"glossy": {"color": 0, "mirror": 1} | material},
        objects=[{"shape": "quad", "material": "glossy", "width": 2, "depth": 2}],
        lights=[light | {"radiance": 1.0}],
        integrator={"max_depth": 1, "gloss_sampling": way},
    )


@pytest.mark.parametrize("lamp", ["sphere", "visible", "rectangle"])
@pytest.mark.parametrize("where", PLACES, ids=str)
@pytest.mark.parametrize("lobe", LOBES)
def test_lamps_in_lobes_are_as_bright_as_quadrature_says(
    make_scene: MakeScene, lobe: str, where: tuple[float, float], lamp: str
) -> None:
    kind = "rectangle" if lamp == "rectangle" else "sphere"
    right = expected(LOBES[lobe], kind, *where)
    for way in ("balance", "power"):
        found = render(plate(make_scene, LOBES[lobe], lamp, where, way), compiled=False).linear
        assert found.mean(dtype=np.float64) == pytest.approx(right, rel=0.02, abs=0), way
