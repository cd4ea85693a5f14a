"""Textures, reliefs and spot lights in the fused loop: bit for bit what the batches make of them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.engine.formats.pictures.files import write_exr
from course.engine.loops import embree_device
from tests.conftest import MakeScene
from tests.lengths import fewer

if not embree_device.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.engine.render.binding import bind
from tests.engine.loops.test_fused import assert_same, both

COLORS: dict[str, dict[str, Any]] = {"image": "map.exr", "interpolation": "bilinear"}
NORMALS = {"image": "map.exr"}
MATERIALS: dict[str, dict[str, Any]] = {
    "picture": {"texture": COLORS},
    "nearest": {"texture": COLORS | {"interpolation": "nearest", "repeat": [3, 2]}},
    "repeated": {"texture": COLORS | {"repeat": [2.5, 0.3]}, "specular": 0.4, "exponent": 20},
    "picture in the dark": {"texture": COLORS, "ambient": 1, "diffuse": 0},
    "noise": {"noise": {"scale": 7}},
    "veins": {"noise": {"scale": 7, "conversion": "absolute"}},
    "normals": {"normal_map": NORMALS},
    "nearest normals": {"normal_map": NORMALS | {"interpolation": "nearest", "repeat": [2, 3]}},
    "bumps": {"bump": {"image": "map.exr", "height": 0.2, "repeat": [2, 1]}},
    "waves": {"bump": {"noise": {"scale": 5}, "height": 0.2}, "noise": {"scale": 2}},
    "creased mirror": {
        "bump": {"noise": {"scale": 5, "conversion": "absolute"}, "height": 0.1},
        "texture": COLORS,
        "mirror": 0.6,
    },
    "bumpy glass": {
        "normal_map": NORMALS,
        "texture": COLORS,
        "dielectric": {"refraction_index": 1.4, "shaded": True},
    },
}
"""All on every shape; each picture on the floor, too."""

LIGHTS: dict[str, dict[str, Any]] = {
    "spot": {"inner": 10, "outer": 25},
    "sharp spot": {"inner": 20, "outer": 20},
    "sphere": {"type": "sphere", "radius": 0.5},
}
SPOT = {"type": "spot", "position": [1, 3, 1], "direction": [-1, -2.7, -1], "intensity": 60}


def light(name: str) -> dict[str, Any]:
    given = LIGHTS[name]
    if "type" in given:
        return given | {"center": [1, 3, 1], "intensity": 20}
    return SPOT | {"inner_angle": given["inner"], "outer_angle": given["outer"]}


def write_files(folder: Path) -> None:
    """A picture of 7 x 5 colours, and a mesh whose places go below 0 and above 1, on its second triangle mirrored."""
    colors = np.random.default_rng(4).random((3, 5, 7)).astype(np.float32)
    write_exr(folder / "map.exr", colors)
    (folder / "flag.obj").write_text(
        "v -0.6 0 0\nv 0.6 0 0\nv 0.6 1 0.3\nv -0.6 1 0\nvn 0 0 1\nvn 0.3 0 1\n"
        "vt -0.4 0.1\nvt 1.7 0\nvt 1.2 2.3\nvt 2 1\nf 1/1/1 2/2/2 3/3/1\nf 1/1/1 3/3/1 4/4/2\n"
    )


@fewer
@pytest.mark.filterwarnings("ignore:.*it has no inside")
@pytest.mark.parametrize("lamp", LIGHTS)
@pytest.mark.parametrize("paths", [False, True])
@pytest.mark.parametrize("material", MATERIALS)
def test_the_loop_and_the_batches_agree_on_what_is_painted(
    make_scene: MakeScene, tmp_path: Path, material: str, paths: bool, lamp: str
) -> None:
    write_files(tmp_path)
    scene = make_scene(
        integrator={"type": "path"} if paths else {},
        camera={"eye": [0, 1.5, 4], "look_at": [0, 0.7, 0]},
        film={"width": 22, "height": 15},
        sampler={"samples": 20},
        environment={"type": "constant", "radiance": [0.1, 0.2, 0.3]},
        materials={"floor": MATERIALS[material], "plain": {"color": 0.4, "mirror": 0.2}},
        lights=[{"type": "ambient", "radiance": 0.1}, light(lamp)],
        objects=[
            {"shape": "quad", "material": "floor", "width": 9, "depth": 7},
            {"shape": "sphere", "material": "floor", "radius": 0.7}
            | {"transform": [{"translate": [-0.9, 0.8, 0]}], "motion": {"velocity": [0.2, 0.1, 0]}},
            {"shape": "mesh", "file": "flag.obj", "material": "floor"}
            | {"transform": [{"translate": [0.8, 0.2, 0]}]},
            {"shape": "box", "material": "plain", "transform": [{"translate": [0, 0, -2.5]}]},
        ],
    )
    fused, batches = both(scene)
    assert_same(fused, batches)
    assert fused.linear.std() > 0.01


@pytest.mark.parametrize("width", [3, 30_000])
def test_noise_far_from_its_origin_is_that_of_the_batches(
    make_scene: MakeScene, width: float
) -> None:
    """Places from 2^24 on are whole numbers, behind the period of the table many times over."""
    scene = make_scene(
        camera={"eye": [0, width, width], "look_at": [0, 0, 0]},
        materials={"m": {"noise": {"scale": 10_000}}},
        objects=[{"shape": "quad", "material": "m", "width": width, "depth": width}],
        lights=[{"type": "directional", "direction": [0, -1, 0], "irradiance": 3}],
    )
    fused, batches = both(scene)
    assert_same(fused, batches)
    assert fused.linear.any()


def test_light_leaves_a_bumpy_floor_upwards_where_all_is_flat(make_scene: MakeScene) -> None:
    """Without normals at corners those of bumps may still point a bounce into the floor."""
    scene = make_scene(
        integrator={"type": "path"},
        camera={"eye": [0, 2, 3], "look_at": [0, 0, 0]},
        sampler={"samples": 64},
        environment={"type": "constant", "radiance": 1},
        materials={"m": {"bump": {"noise": {"scale": 5}, "height": 1}, "color": 0.9}},
        objects=[{"shape": "quad", "material": "m", "width": 3, "depth": 3, "shading": "flat"}],
    )
    tracer = bind(scene, scene.settings)
    assert tracer.integrator.surface.triangles.corner_normals is None
    fused, batches = both(scene)
    assert_same(fused, batches)
    assert fused.linear.any()
