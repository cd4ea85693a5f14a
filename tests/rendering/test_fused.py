"""The fused loop makes the pictures that the batches make, bit for bit, and counts what they count."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.compiled import library
from course.effects import PROJECT
from course.jobs.picture import Picture
from course.render_scene import render
from course.scene.scene import Scene, load_scene

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled import engine

SCENES = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
SIZES: dict[str, dict[str, Any]] = {
    "whole packets": {"spp": 16, "size": (24, 16)},
    "several pixels in a packet": {"spp": 4, "size": (60, 40)},
    "packets that aren't full": {"spp": 21, "size": (13, 7)},
    "one ray": {"spp": 1, "size": (1, 1)},
    "to an error": {"spp": 64, "size": (45, 30), "error": 0.03},
}


def both(scene: Scene, monkeypatch: pytest.MonkeyPatch, **options: Any) -> tuple[Picture, Picture]:
    """The picture of the fused loop, which must fit, and that of the batches."""
    fits, known = engine.fits, []
    monkeypatch.setattr(engine, "fits", lambda tracer: known.append(fits(tracer)) or known[-1])
    fused = render(scene, sampler="sobol", compiled=True, threads=2, **options)
    assert known == [True]
    monkeypatch.setattr(engine, "fits", lambda _tracer: False)
    batches = render(scene, sampler="sobol", compiled=True, threads=1, **options)
    monkeypatch.undo()
    return fused, batches


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", SCENES)
def test_the_loop_and_the_batches_make_the_same_picture(
    name: str, size: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = load_scene(Path(PROJECT) / "scenes" / f"{name}.yaml")
    fused, batches = both(scene, monkeypatch, **SIZES[size])
    assert np.array_equal(fused.linear, batches.linear)
    assert fused.receipt.rays == batches.receipt.rays
    assert fused.receipt.numbers == batches.receipt.numbers
    assert fused.receipt.embree_seconds > 0


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


@pytest.mark.parametrize("part", PARTS)
def test_the_loop_and_the_batches_agree_on_each_part_of_a_scene(
    part: str, make_scene: Callable[..., Scene], monkeypatch: pytest.MonkeyPatch
) -> None:
    given = PARTS[part]
    scene = make_scene(
        camera={"eye": [0, 1.5, 4], "look_at": [0, 0.7, 0]} | given.get("camera", {}),
        film={"width": 22, "height": 15},
        sampler={"samples": 20},
        environment={"type": "constant", "radiance": [0.1, 0.2, 0.3]},
        materials={"floor": {"color": [0.7, 0.6, 0.5]}, "ball": given.get("ball", {})},
        lights=[{"type": "ambient", "radiance": 0.1}, *given.get("lights", [POINT])],
        objects=[
            {"shape": "quad", "material": "floor", "width": 9, "depth": 9},
            {"shape": "sphere", "material": "ball", "radius": 0.7}
            | {"transform": [{"translate": [0, 0.8, 0]}]}
            | given.get("object", {}),
        ],
    )
    fused, batches = both(scene, monkeypatch)
    assert np.array_equal(fused.linear, batches.linear)
    assert fused.linear.std() > 0.01
    assert fused.receipt.rays == batches.receipt.rays
    assert fused.receipt.numbers == batches.receipt.numbers
