"""The fused loop makes the pictures that the batches make, bit for bit, and counts what they count."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.engine.functions.effects import PROJECT
from course.engine.loops import embree_device
from course.engine.render.picture import Picture
from course.engine.render.render import render
from course.engine.scene.scene import Scene, load_scene

if not embree_device.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.engine.loops import fused_kernels
from course.engine.loops.fits import fits
from course.engine.render.binding import bind
from tests.lengths import fewer

SCENES = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
PATHS = ("path_tracing", "radiosity")
SIZES: dict[str, dict[str, Any]] = {
    "whole packets": {"spp": 16, "size": (24, 16)},
    "several pixels in a packet": {"spp": 4, "size": (60, 40)},
    "packets that aren't full": {"spp": 21, "size": (13, 7)},
    "one ray": {"spp": 1, "size": (1, 1)},
    "to an error": {"spp": 64, "size": (45, 30), "error": 0.03},
}


def both(scene: Scene, **options: Any) -> tuple[Picture, Picture]:
    """The picture of the fused loop, which must fit, and that of the batches."""
    assert fits(bind(scene, replace(scene.settings, sampler="sobol")))
    fused = render(scene, sampler="sobol", compiled=True, threads=2, **options)
    batches = render(scene, sampler="sobol", compiled=False, threads=1, **options)
    return fused, batches


def assert_same(fused: Picture, batches: Picture) -> None:
    assert np.array_equal(fused.linear, batches.linear)
    assert fused.receipt.rays == batches.receipt.rays
    numbers, more = dict(fused.receipt.numbers), dict(batches.receipt.numbers)
    # A path's choice takes a second number for mirrors and glass: all hits of a packet draw it, or all of a batch.
    assert numbers.pop("choice", 0) <= more.pop("choice", 0)
    assert numbers == more


@fewer
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", SCENES + PATHS)
def test_the_loop_and_the_batches_make_the_same_picture(name: str, size: str) -> None:
    scene = load_scene(Path(PROJECT) / "scenes" / f"{name}.yaml")
    fused, batches = both(scene, **SIZES[size])
    assert_same(fused, batches)
    assert fused.receipt.embree_seconds > 0


def test_more_paths_than_are_followed_together_make_the_same_picture() -> None:
    scene = load_scene(Path(PROJECT) / "scenes" / "path_tracing.yaml")
    fused, batches = both(scene, spp=64, size=(40, 40), seed=3)
    assert 16 * fused_kernels.PATH_CHUNK < 64 * 40 * 40
    assert_same(fused, batches)


POINT: dict[str, Any] = {"type": "point", "position": [1, 3, 1], "intensity": 20}
RECTANGLE: dict[str, Any] = {
    "type": "rectangle",
    "corner": [-1, 3, -1],
    "edge_u": [2, 0, 0],
    "edge_v": [0, 0, 2],
}
SPHERE: dict[str, Any] = {"type": "sphere", "center": [1, 3, 1], "radius": 0.5}
GLASS = {"dielectric": {"refraction_index": 1.5, "absorption": [0.1, 0.4, 0.8]}}
MOTION = {"motion": {"velocity": [0.6, 0, 0]}}

PARTS: dict[str, dict[str, Any]] = {
    "point": {"lights": [POINT]},
    "sun": {"lights": [{"type": "directional", "direction": [-1, -3, -1], "irradiance": 2}]},
    "rectangle by intensity": {"lights": [RECTANGLE | {"intensity": 20}]},
    "grid": {"lights": [RECTANGLE | {"intensity": 20, "samples": "grid 2"}]},
    "emitting rectangle": {"lights": [RECTANGLE | {"radiance": 4}]},
    "two-sided rectangle": {
        "lights": [RECTANGLE | {"radiance": 4, "two_sided": True, "visible": False}]
    },
    "sphere": {"lights": [SPHERE | {"intensity": 20}]},
    "ball": {"lights": [SPHERE | {"intensity": 20, "samples": "ball"}]},
    "facing disk": {"lights": [SPHERE | {"intensity": 20, "samples": "facing disk"}]},
    "emitting sphere": {"lights": [SPHERE | {"radiance": 4}]},
    "part of a sphere that is seen": {"lights": [SPHERE | {"radiance": 4, "samples": "visible"}]},
    "seen part that moves": {"lights": [SPHERE | {"radiance": 4, "samples": "visible"} | MOTION]},
    "around the floor": {
        "lights": [SPHERE | {"center": [0, 0, 0], "radiance": 4, "samples": "visible"}]
    },
    "moving light": {"lights": [POINT | MOTION, SPHERE | {"intensity": 9} | MOTION]},
    "two lights": {"lights": [POINT, SPHERE | {"radiance": 4}]},
    "lights of triangles": {
        "lights": [{"type": "object", "object": name} for name in ("lamp", "other")] + [POINT],
        "ball": {"emission": [2, 1, 0.5]},
        "objects": [
            {"shape": "torus_knot", "name": "lamp", "material": "ball", "radius": 0.3, "tube": 0.1}
            | {"transform": [{"translate": [-1.2, 1, 0]}]},
            {"shape": "quad", "name": "other", "material": "ball", "width": 1, "depth": 0.5}
            | {"transform": [{"translate": [1.2, 2, 0]}]},
        ],
    },
    "highlights": {"ball": {"specular": 0.5, "exponent": 30}},
    "mirror": {"ball": {"mirror": 0.8}},
    "plane lobe": {"ball": {"mirror": 0.8, "gloss": {"lobe": "plane", "roughness": 0.3}}},
    "ball lobe": {"ball": {"mirror": 0.8, "gloss": {"lobe": "ball", "glossiness": 0.3}}},
    "phong lobe": {"ball": {"mirror": 0.8, "gloss": {"lobe": "phong", "exponent": 40}}},
    "coloured glass": {"ball": GLASS},
    "mover": {"object": MOTION},
    "moving camera": {"camera": MOTION},
    "lens": {"camera": {"lens": {"aperture_radius": 0.1, "focus_distance": 4}}},
}
"""What a scene may have, one by one: those of the course don't have all of it."""


GLOWING = {"emission": [2, 1, 0.5]}
LAMPS: dict[str, Any] = {"lights": [RECTANGLE | {"radiance": 4}, SPHERE | {"radiance": 4}]}
PATH_PARTS: dict[str, dict[str, Any]] = {
    "mirror among lamps": LAMPS | {"ball": {"color": 0.3, "mirror": 0.6}},
    "glass among lamps": LAMPS | {"ball": GLASS},
    "glass with a matt outside": LAMPS
    | {"ball": {"color": 0.3, "dielectric": {"refraction_index": 1.5, "shaded": True}}},
    "glass with highlights": LAMPS | {"ball": {"specular": 0.3, "exponent": 9, **GLASS}},
    "a ball that glows": {"lights": [], "ball": GLOWING},
    "a ball that glows and mirrors": {"ball": {"mirror": 0.7, **GLOWING}},
    "sky by chance": {"environment": {"type": "constant", "radiance": 1}, "lights": []},
    "roulette at once": LAMPS | {"integrator": {"roulette": 0}},
    "no roulette": LAMPS | {"integrator": {"roulette": None}},
    "one bounce": LAMPS | {"integrator": {"max_depth": 1}},
    "no bounce": LAMPS | {"integrator": {"max_depth": 0}},
    "mirrors alone": {"floor": {"color": 0, "mirror": 0.9}, "ball": {"color": 0, "mirror": 0.5}},
    "another seed": LAMPS | {"ball": GLASS, "seed": 7},
}
"""What only paths have, or have otherwise."""


@fewer
@pytest.mark.parametrize(
    ("part", "paths"),
    [(part, False) for part in PARTS] + [(part, True) for part in PARTS | PATH_PARTS],
)
def test_the_loop_and_the_batches_agree_on_each_part_of_a_scene(
    part: str, paths: bool, make_scene: Callable[..., Scene]
) -> None:
    given = (PARTS | PATH_PARTS)[part]
    scene = make_scene(
        integrator={"type": "path"} | given.get("integrator", {}) if paths else {},
        camera={"eye": [0, 1.5, 4], "look_at": [0, 0.7, 0]} | given.get("camera", {}),
        film={"width": 22, "height": 15},
        sampler={"samples": 20},
        environment=given.get("environment") or {"type": "constant", "radiance": [0.1, 0.2, 0.3]},
        materials={
            "floor": given.get("floor", {"color": [0.7, 0.6, 0.5]}),
            "ball": given.get("ball", {}),
        },
        lights=[{"type": "ambient", "radiance": 0.1}, *given.get("lights", [POINT])],
        objects=[
            {"shape": "quad", "material": "floor", "width": 9, "depth": 9},
            {"shape": "sphere", "material": "ball", "radius": 0.7}
            | {"transform": [{"translate": [0, 0.8, 0]}]}
            | given.get("object", {}),
            *given.get("objects", []),
        ],
    )
    fused, batches = both(scene, seed=given.get("seed", 0))
    assert_same(fused, batches)
    assert fused.linear.std() > 0.01
