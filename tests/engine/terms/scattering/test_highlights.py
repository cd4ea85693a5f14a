"""Highlights by other models than Blinn's, against their formulas in double precision."""

import math
from typing import Any

import numpy as np
import pytest

from course import pixel, render
from course.base.errors import SceneError
from course.engine.loops import embree_device
from tests.conftest import MakeScene

COLOR, SPECULAR, EXPONENT = np.array([0.5, 0.3, 0.1]), np.array([0.2, 0.6, 1.5]), 7.0
N, K = 1.8, 1.2
FACETS = {"refraction_index": N, "absorption_index": K}
WAYS = [(0.3, 1.0, 0.2, -0.5), (0.0, 1.0, 0.0, 1.2), (1.0, 0.4, -1.0, 0.9), (-1, 0.5, 0.3, 0.8)]
"""To the light, and the slope to the viewer along x."""


def expected(way: Any, slope: float, **keys: Any) -> Any:
    """Radiance over irradiance / pi of the floor, whose normal is y; w is the way to the light."""
    w, v = np.array(way, float), np.array([slope, 1.0, 0.0])
    w, v = w / np.linalg.norm(w), v / np.linalg.norm(v)
    h = (w + v) / np.linalg.norm(w + v)
    nl, nv, nh, hv = w[1], v[1], h[1], h @ v
    body, shine = 1.0, nh**EXPONENT
    if "phong" in keys.get("highlight", ""):
        shine = max(2 * nl * nv - w @ v, 0) ** EXPONENT
    if keys.get("highlight", "").startswith("plain"):
        shine /= nl
    if "facets" in keys:
        straight = ((N - 1) ** 2 + K * K) / ((N + 1) ** 2 + K * K)
        fresnel = straight + (1 - straight) * (1 - hv) ** 5
        d = (EXPONENT + 2) / (2 * math.pi) * nh**EXPONENT
        g = min(1, 2 * nh * nv / hv, 2 * nh * nl / hv)
        shine = math.pi * d * fresnel * g / (4 * nl * nv)
        body = 1 - fresnel if keys["facets"].get("covers") else 1.0
    return (COLOR * body + SPECULAR * shine) * nl


KINDS: list[dict[str, Any]] = [
    {"highlight": "cosine"},
    {"highlight": "plain"},
    {"highlight": "phong"},
    {"highlight": "plain_phong"},
    {"facets": FACETS},
    {"facets": FACETS | {"covers": True}},
]


def floor(make_scene: MakeScene, way: Any, slope: float, compiled: bool, **keys: Any) -> Any:
    """What a camera sees of the floor at the origin, in light of irradiance pi."""
    if compiled and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    shiny = {"color": COLOR.tolist(), "specular": SPECULAR.tolist(), "exponent": EXPONENT} | keys
    scene = make_scene(
        camera={"eye": [4 * slope, 4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1]}
        | {"vertical_fov": 1e-3},
        film={"width": 2, "height": 2},
        materials={"shiny": shiny, "matt": {}},
        objects=[
            {"shape": "quad", "width": 9, "depth": 9, "material": "shiny"},
            {"shape": "quad", "material": "matt", "transform": [{"translate": [0, -9, 0]}]},
        ],
        lights=[
            {"type": "directional", "direction": [-each for each in way], "irradiance": math.pi}
        ],
    )
    return render(scene, compiled=compiled).linear[0, 0]


@pytest.mark.parametrize("keys", KINDS, ids=str)
@pytest.mark.parametrize(("way", "compiled"), [*((way, False) for way in WAYS), (WAYS[2], True)])
def test_a_highlight_is_that_of_its_formula(
    make_scene: MakeScene, keys: dict[str, Any], way: Any, compiled: bool
) -> None:
    *to_light, slope = way
    found = floor(make_scene, to_light, slope, compiled, **keys)
    np.testing.assert_allclose(found, expected(to_light, slope, **keys), rtol=2e-5)


@pytest.mark.parametrize("slope", [0.0, 1.0, 3.0])
def test_facets_return_no_more_light_than_they_get(slope: float) -> None:
    """Their reflectance for a view, integrated over all directions of light by a grid in double precision."""
    v = np.array([slope, 1.0, 0.0]) / math.hypot(slope, 1)
    total, count = 0.0, 96
    for z in (np.arange(count) + 0.5) / count:
        for angle in (np.arange(2 * count) + 0.5) * math.pi / count:
            side = math.sqrt(1 - z * z)
            w = np.array([side * math.cos(angle), z, side * math.sin(angle)])
            h = (w + v) / np.linalg.norm(w + v)
            d = (EXPONENT + 2) / (2 * math.pi) * h[1] ** EXPONENT
            g = min(1, 2 * h[1] * min(v[1], z) / (h @ v))
            total += d * g / (4 * v[1]) * 2 * math.pi / (2 * count * count)
    assert 0.5 < total < 1


def test_facets_beside_another_highlight_are_refused(make_scene: MakeScene) -> None:
    for keys, told in (
        ({"highlight": "phong"}, "expected cosine beside facets"),
        ({"exponent": 1e7}, r"expected at most 1e\+06 of facets"),
    ):
        material = {"facets": FACETS, **keys}
        with pytest.raises(SceneError, match=told):
            make_scene(materials={"m": material}, objects=[{"shape": "quad", "material": "m"}])


def test_a_story_of_a_pixel_tells_what_is_seen(make_scene: MakeScene) -> None:
    """Facets leave less to the diffuse term in the recording stages, too."""
    scene = make_scene(
        camera={"eye": [3, 2, 0], "look_at": [0, 0, 0]},
        film={"width": 1, "height": 1},
        materials={"m": {"specular": 1, "exponent": 5, "facets": FACETS | {"covers": True}}},
        objects=[{"shape": "quad", "width": 9, "depth": 9, "material": "m"}],
        lights=[{"type": "directional", "direction": [1, -2, 0], "irradiance": 1}],
    )
    told = pixel(scene, 0, 0, spp=1)
    (lit,) = [each.radiance for each in told.recording.segments if each.kind == "shadow"]
    np.testing.assert_allclose(lit, told.color, rtol=1e-5)
