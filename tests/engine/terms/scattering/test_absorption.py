"""Beer's law: light fades by exp(-absorption * length) inside a dielectric, and nowhere else."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import render
from tests.conftest import MakeScene, PixelRays
from tests.estimates import fresnel
from tests.forms import in_both_forms

ABSORPTION = np.array([0.2, 1.0, 4.0])
EXACT = {"max_depth": 40, "cutoff": 0}
WHITE = {"type": "constant", "radiance": 1}


def glass(index: float = 1.0, absorption: Any = None) -> dict[str, Any]:
    a = ABSORPTION.tolist() if absorption is None else absorption
    return {"dielectric": {"refraction_index": index, "absorption": a}}


def slab(thickness: float) -> dict[str, Any]:
    return {"shape": "box", "material": "glass", "size": [50, thickness, 50]}


def close(
    linear: NDArray[np.float32], expected: NDArray[np.float64], tolerance: float = 1e-5
) -> None:
    assert np.allclose(linear, expected, rtol=0, atol=tolerance)


@pytest.mark.parametrize("thickness", [0.01, 0.3, 2.0])
def test_a_slab_without_reflection_absorbs_by_its_slant_thickness(
    make_scene: MakeScene, pixel_rays: PixelRays, thickness: float
) -> None:
    scene = make_scene(
        camera={"eye": [0, 4, 3], "look_at": [0, 0, 0], "vertical_fov": 60},
        sampler={"type": "regular", "samples": 1},
        objects=[slab(thickness)],
        materials={"glass": glass()},
        environment=WHITE,
        integrator=EXACT,
    )
    _, direction = pixel_rays(scene)
    length = thickness / np.abs(direction[1])
    close(render(scene).linear, np.exp(-length[..., None] * ABSORPTION), 1e-5)


@pytest.mark.parametrize("index", [1.5, 2.0])
def test_a_slab_seen_head_on_sums_all_its_inner_reflections(
    make_scene: MakeScene, index: float
) -> None:
    thickness = 0.5
    scene = make_scene(
        camera={"eye": [0, 4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.1},
        objects=[{"shape": "box", "material": "glass", "size": [2, thickness, 2]}],
        materials={"glass": glass(index)},
        environment=WHITE,
        integrator=EXACT,
    )
    f = ((index - 1) / (index + 1)) ** 2
    e = np.exp(-ABSORPTION * thickness)
    transmitted = (1 - f) ** 2 * e / (1 - f**2 * e**2)
    reflected = f + f * (1 - f) ** 2 * e**2 / (1 - f**2 * e**2)
    close(render(scene).linear, np.broadcast_to(transmitted + reflected, (32, 32, 3)), 3e-5)


# Light fades from the eye on, wherever the near plane is.
@pytest.mark.parametrize("near", [0.0, 0.5])
def test_a_camera_inside_glass_looks_through_it(
    make_scene: MakeScene, pixel_rays: PixelRays, near: float
) -> None:
    scene = make_scene(
        camera={"eye": [0, 0, 0.25], "look_at": [0, 0, -1], "vertical_fov": 30, "near": near},
        sampler={"type": "regular", "samples": 1},
        objects=[{"shape": "box", "material": "glass", "size": [2, 2, 2]}],
        materials={"glass": glass()},
        environment=WHITE,
        integrator=EXACT,
    )
    _, direction = pixel_rays(scene)
    length = 1.25 / np.abs(direction[2])
    close(render(scene).linear, np.exp(-length[..., None] * ABSORPTION), 3e-5)


def inside(material: str, gap: float) -> list[dict[str, Any]]:
    """A box of glass with something of another material so far below its surface."""
    return [
        {"shape": "box", "material": "glass", "size": [10, 2, 10]},
        {"shape": "box", "material": material, "size": [9, 2 - 2 * gap, 9]},
    ]


@pytest.mark.parametrize(
    ("objects", "length", "tolerance"),
    [
        (inside("white", 0.25), 0.25, 1e-4),
        (inside("white", 0.75), 0.75, 1e-4),
        (inside("mirror", 0.75), 2 * 0.75, 1e-4),
        # Two panes: the way between them costs nothing.
        *(
            ([slab(0.3) | {"transform": [{"translate": [0, y, 0]}]} for y in (0, -far)], 0.6, 6e-4)
            for far in (1.0, 20.0)
        ),
    ],
    ids=["shallow", "deep", "a mirror", "panes", "panes far apart"],
)
def test_light_fades_on_its_way_within_glass_alone(
    make_scene: MakeScene, objects: list[dict[str, Any]], length: float, tolerance: float
) -> None:
    scene = make_scene(
        camera={"eye": [0, 4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.1},
        objects=objects,
        materials={
            "glass": glass(),
            "white": {"color": 0, "emission": 1},
            "mirror": {"color": 0, "mirror": 1},
        },
        environment=WHITE,
        integrator=EXACT,
    )
    expected = np.broadcast_to(np.exp(-ABSORPTION * length), (32, 32, 3))
    close(render(scene).linear, expected, tolerance)


def test_absorption_counts_in_the_units_of_the_scene_file(make_scene: MakeScene) -> None:
    for k in (1e-9, 1.0, 1e9):
        scene = make_scene(
            camera={"eye": [0, 4 * k, 0], "look_at": [0, 0, 0], "up": [0, 0, 1]}
            | {"vertical_fov": 0.1},
            objects=[{"shape": "box", "material": "glass", "size": [2 * k, 0.5 * k, 2 * k]}],
            materials={"glass": glass(1.0, (ABSORPTION / k).tolist())},
            environment=WHITE,
            integrator=EXACT,
        )
        expected = np.broadcast_to(np.exp(-ABSORPTION * 0.5), (32, 32, 3))
        close(render(scene).linear, expected, 3e-5)


def test_glass_that_lets_nothing_through_is_black_and_finite(make_scene: MakeScene) -> None:
    scene = make_scene(
        camera={"eye": [0, 4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.1},
        objects=[slab(0.3)],
        materials={"glass": glass(1.0, 1e150)},
        environment=WHITE,
        integrator=EXACT,
    )
    linear = render(scene).linear
    # Index 1 reflects nothing, but for the rounding of two cosines, squared.
    assert 0 <= linear.min() <= linear.max() < 1e-12


@in_both_forms
@pytest.mark.parametrize("path", [False, True])
@pytest.mark.parametrize("away", [0.0, 500.0])
@pytest.mark.parametrize("wide", [2.0, 400.0])
def test_a_thin_plate_in_a_wide_scene_absorbs_by_its_whole_thickness(
    make_scene: MakeScene,
    pixel_rays: PixelRays,
    wide: float,
    away: float,
    path: bool,
    compiled: bool,
) -> None:
    # Rays inside start 2^-19 of the plate's largest coordinate, up to 700, behind its surface: 0.4% of its thickness.
    thickness = 0.3
    plate = {"shape": "box", "material": "glass", "size": [wide, thickness, wide]}
    floor = {"shape": "quad", "width": 2000, "depth": 2000, "material": "black"}
    scene = make_scene(
        camera={"eye": [away, 1.5, 0.9], "look_at": [away, 0, 0], "vertical_fov": 30},
        sampler={"type": "regular", "samples": 1},
        objects=[
            plate | {"transform": [{"translate": [away, 0, 0]}]},
            floor | {"transform": [{"translate": [0, -40, 0]}]},
        ],
        materials={
            "glass": glass(),
            "black": {"color": 1, "diffuse": 0, "ambient": 1, "specular": 0},
        },
        lights=[{"type": "ambient", "radiance": 1}],
        integrator=EXACT | ({"type": "path"} if path else {}),
    )
    _, direction = pixel_rays(scene)
    length = thickness / np.abs(direction[1])
    expected = np.exp(-length[..., None] * ABSORPTION)
    close(render(scene, compiled=compiled).linear, expected, 1e-5)


def test_a_ball_absorbs_along_its_chords(make_scene: MakeScene, pixel_rays: PixelRays) -> None:
    # Rays leave at 6e-4 beside the surface, so far from the middle of the scene, which shortens chords by that at most
    # and less at a slant.
    index, a, away = 1.5, 0.5, 300.0
    moved = [{"translate": [away, 0, 0]}]
    ball = {"shape": "sphere", "segments": 600, "material": "glass", "transform": moved}
    floor = {"shape": "quad", "width": 900, "depth": 900, "material": "black"}
    scene = make_scene(
        camera={"eye": [away, 0, 4], "look_at": [away, 0, 0], "vertical_fov": 24},
        sampler={"type": "regular", "samples": 1},
        objects=[ball, floor | {"transform": [{"translate": [0, -50, 0]}]}],
        materials={
            "glass": glass(index, [a] * 3),
            "black": {"color": 1, "diffuse": 0, "ambient": 1, "specular": 0},
        },
        lights=[{"type": "ambient", "radiance": 1}],
        environment=WHITE,
        integrator={"max_depth": 2, "cutoff": 0},
    )
    eye, direction = pixel_rays(scene)
    to_middle = np.array([away, 0, 0]) - eye
    along = np.einsum("i,ijk->jk", to_middle, direction)
    sine2 = to_middle @ to_middle - along * along
    # Farther out a place of the ball that is rounded to 2^-24 of 300 counts for as much.
    near = sine2 < 0.3
    share, cos_t = fresnel(np.sqrt(1 - sine2[near]), 1 / index)
    # What comes back after a bounce inside is beyond the depth.
    expected = share + (1 - share) ** 2 * np.exp(-a * 2 * cos_t)
    shown = render(scene).linear[near, 0].astype(np.float64)
    assert near.sum() > 100
    assert np.abs(np.mean(shown - expected)) < 2.5e-5
