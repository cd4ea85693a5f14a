"""Lamps beside what they light, at a small part of the scene's size: closed forms of points, small lamps and polygons.

Rays begin 2e-6 of the size above a surface and as much off its edges, and float32 has 6e-8 of it. The hit is on the
diagonal of a square, which is an edge of both its triangles.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from tests.conftest import MakeScene
from tests.lengths import fewer

Array = NDArray[np.float64]
INDEX, ABSORPTION = [0.2, 0.7, 1.3], [3.6, 2.6, 2.3]


def metal(alpha: float) -> dict[str, Any]:
    conductor = {"refraction_index": INDEX, "absorption_index": ABSORPTION, "roughness": alpha}
    return {"color": 0, "mirror": 0.9, "conductor": conductor}


def plate(make_scene: MakeScene, alpha: float, light: dict[str, Any], way: str) -> Scene:
    """One point of a plate of metal, seen at 45 degrees."""
    return make_scene(
        camera={"eye": [4, 4, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-9},
        film={"width": 8, "height": 8},
        materials={"metal": metal(alpha)},
        objects=[{"shape": "quad", "material": "metal", "width": 2, "depth": 2}],
        lights=[light],
        integrator={"max_depth": 1, "gloss_sampling": way},
    )


def reflected(place: list[float], alpha: float) -> Array:
    """The metal's BRDF (3,) times the cosine, for light from a place."""
    wo, wi = np.array([1, 1, 0]) / math.sqrt(2), np.array(place) / np.linalg.norm(place)
    wm = (wo + wi) / np.linalg.norm(wo + wi)
    d = alpha**2 / (math.pi * (wm[0] ** 2 + wm[2] ** 2 + (alpha * wm[1]) ** 2) ** 2)
    lambdas = ((math.sqrt(1 + alpha**2 * (1 / w[1] ** 2 - 1)) - 1) / 2 for w in (wo, wi))
    c, eta = float(wo @ wm), (np.array(INDEX) + 1j * np.array(ABSORPTION)) ** 2
    root = np.sqrt(eta - 1 + c * c)
    s, p = (c - root) / (c + root), (eta * c - root) / (eta * c + root)
    fresnel = (abs(s) ** 2 + abs(p) ** 2) / 2
    return np.asarray(0.9 * fresnel * d / (1 + sum(lambdas)) / (4 * wo[1]))


@pytest.mark.parametrize("distance", [2.0, 0.05, 0.01])
@pytest.mark.parametrize("aside", [0.0, 0.001, 0.1])
@pytest.mark.parametrize("alpha", [0.001, 0.1])
def test_a_point_beside_smooth_metal(
    make_scene: MakeScene, alpha: float, aside: float, distance: float
) -> None:
    place = [-distance, distance, aside * distance]
    light = {"type": "point", "position": place, "intensity": 4}
    found = render(plate(make_scene, alpha, light, "automatic"), compiled=False).linear
    right = reflected(place, alpha) * 4 / np.dot(place, place)
    # The place of the hit is rounded to 1e-7: what that turns the normal by, in widths of the highlight.
    np.testing.assert_allclose(
        found, np.broadcast_to(right, found.shape), rtol=1e-4 + 1e-7 / distance / alpha
    )


@fewer
@pytest.mark.parametrize("samples", ["sphere", "sphere by polar", "visible"])
@pytest.mark.parametrize("way", ["lamp", "balance", "power"])
@pytest.mark.parametrize(
    ("alpha", "radius"), [(0.001, 1e-4), (0.01, 1e-4), (0.1, 1e-3), (0.1, 1e-6)]
)
def test_a_small_ball_in_metal(
    make_scene: MakeScene, alpha: float, radius: float, way: str, samples: str
) -> None:
    """Whatever its points are for matt surfaces. Directions of the lobe alone found it once in a thousand samples."""
    place = [-2.0, 2.0, 0]
    light = {"type": "sphere", "center": place, "radius": radius, "samples": samples}
    light["radiance"] = 1 / (math.pi * radius**2)
    found = render(plate(make_scene, alpha, light, way), compiled=False).linear
    right = reflected(place, alpha) / np.dot(place, place)
    np.testing.assert_allclose(found.mean(axis=(0, 1)), right, rtol=2e-3)


TURNED = [
    np.eye(3),
    np.array([[0.4536, -0.8912, 0], [0.8208, 0.4178, -0.3894], [0.3471, 0.1766, 0.9211]]),
]


def edge_on(
    make_scene: MakeScene, height: float, turned: Array, samples: str
) -> tuple[Scene, float]:
    """A matt point at that height over the plane of a rectangle, beside it, and its radiance by Lambert's polygon."""
    side = np.linalg.qr(turned.T)[0]
    side *= np.sign((side * turned.T).sum(axis=0))
    u, v, n = side.T
    corner = 0.3 * u + 0.2 * v - height * n
    u, v = 0.8 * u, 0.8 * v
    light = {"type": "rectangle", "radiance": 3, "samples": samples, "corner": corner.tolist()}
    light |= {"edge_u": u.tolist(), "edge_v": v.tolist()}
    scene = make_scene(
        camera={"eye": [0.3, 2, 0.4], "look_at": [0, 0, 0], "vertical_fov": 1e-9},
        film={"width": 16, "height": 16},
        sampler={"type": "sobol", "samples": 64},
        materials={"white": {"color": 1}},
        objects=[{"shape": "quad", "material": "white", "width": 2.3, "depth": 3.1}],
        lights=[light],
    )
    corners = [corner, corner + u, corner + u + v, corner + v]
    above = list[Array]()
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        if a[1] > 0:
            above.append(a)
        if (a[1] > 0) != (b[1] > 0):
            above.append(a + a[1] / (a[1] - b[1]) * (b - a))
    total = 0.0
    for a, b in zip(above, above[1:] + above[:1], strict=True):
        across = np.cross(a, b)
        sine = float(np.linalg.norm(across))
        total += math.atan2(sine, a @ b) * across[1] / sine
    return scene, 3 * abs(total) / 2 / math.pi


@fewer
@pytest.mark.parametrize("height", [1e-2, 1e-4, 1e-6, 1e-7])
@pytest.mark.parametrize("turned", TURNED, ids=["upright", "turned"])
@pytest.mark.parametrize("samples", ["point", "grid 64"])
@pytest.mark.usefixtures("each_form")
def test_a_rectangle_seen_edge_on(
    make_scene: MakeScene, samples: str, turned: Array, height: float
) -> None:
    """It had been up to 44 times as bright, by rounding of what is left of the way along it; or black.

    The hit is at the origin, and isn't rounded.
    """
    scene, right = edge_on(make_scene, height, turned, samples)
    found = render(scene, spp=64 if samples == "point" else 1).linear
    assert found.mean(dtype=np.float64) == pytest.approx(right, rel=0.02, abs=0)
