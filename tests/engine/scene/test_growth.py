"""Light that grows from bounce to bounce is carried as far as float32 goes, and refused beyond."""

from collections.abc import Callable
from typing import Any

import pytest

from course import Scene, render
from course.base.errors import SceneError
from course.engine.loops import embree_device

MakeScene = Callable[..., Scene]

# The same everywhere and in all directions, so that every path says what the geometric series does.
ROOM = {"shape": "box", "material": "bright", "size": [4, 4, 4]}
INSIDE = {"eye": [0.1, -0.2, 0.3], "look_at": [1, 0, 0]}


def _room(make_scene: MakeScene, max_depth: int, diffuse: float, **more: Any) -> Scene:
    bright = {"color": 1, "diffuse": diffuse, "mirror": 0.5, "emission": 1}
    return make_scene(
        materials={"bright": bright} | more.get("materials", {}),
        objects=[ROOM, *more.get("objects", [])],
        camera=INSIDE,
        integrator={"type": "path", "max_depth": max_depth},
    )


@pytest.fixture(params=[False, True], ids=["arrays", "loops"])
def compiled(request: pytest.FixtureRequest) -> bool:
    if request.param and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    return bool(request.param)


def _series(share: float, bounces: int) -> float:
    return (share ** (bounces + 1) - 1) / (share - 1)


@pytest.mark.parametrize(("diffuse", "bounces"), [(1.5, 66), (50.0, 11), (1e6, 3)])
def test_the_deepest_paths_carry_what_the_series_says(
    make_scene: MakeScene, diffuse: float, bounces: int, compiled: bool
) -> None:
    picture = render(_room(make_scene, bounces, diffuse), compiled=compiled).linear
    assert picture == pytest.approx(_series(diffuse + 0.5, bounces), rel=1e-4)


@pytest.mark.parametrize(("diffuse", "bounces"), [(1.5, 66), (50.0, 11), (1e6, 3)])
def test_one_bounce_more_is_refused_and_the_most_is_named(
    make_scene: MakeScene, diffuse: float, bounces: int
) -> None:
    with pytest.raises(SceneError, match=rf"materials\.bright: .* max_depth of at most {bounces}$"):
        _room(make_scene, bounces + 1, diffuse)


def test_a_way_without_light_does_not_overflow_where_others_carry_much(
    make_scene: MakeScene, compiled: bool
) -> None:
    """Where there is glass, opaque things have a third way, which is never taken."""
    glass = {"glass": {"color": 0, "dielectric": {}}}
    far = {"shape": "sphere", "material": "glass", "radius": 0.1}
    far["transform"] = [{"translate": [9, 0, 0]}]
    room = _room(make_scene, 8, 50.0, materials=glass, objects=[far])
    picture = render(room, compiled=compiled).linear
    assert picture == pytest.approx(_series(50.5, 8), rel=1e-4)


def test_rays_that_mirror_and_refract_count_without_the_diffuse_term(make_scene: MakeScene) -> None:
    room = {
        "materials": {"bright": {"color": 1, "diffuse": 1e6, "mirror": 1, "dielectric": {}}},
        "objects": [ROOM],
    }
    make_scene(**room, integrator={"max_depth": 66})
    with pytest.raises(SceneError, match=r"returns 2 times .* max_depth of at most 66$"):
        make_scene(**room, integrator={"max_depth": 67})


def test_brighter_light_leaves_less_room(make_scene: MakeScene) -> None:
    room = {
        "materials": {"bright": {"color": 1, "diffuse": 2}},
        "objects": [ROOM],
        "integrator": {"type": "path", "max_depth": 60},
    }
    for brighter in (
        {"environment": {"type": "constant", "radiance": 1e3}},
        {"lights": [{"type": "ambient", "radiance": 1e3}]},
        {"lights": [{"type": "directional", "direction": [0, 0, 1], "irradiance": 1e4}]},
    ):
        make_scene(**room)
        with pytest.raises(SceneError, match=r"max_depth of at most 5[0-9]$"):
            make_scene(**room, **brighter)


def test_materials_that_nothing_has_do_not_count(make_scene: MakeScene) -> None:
    bright, unused = {"color": 1, "diffuse": 1}, {"color": 1, "diffuse": 50}
    make_scene(
        materials={"bright": bright, "unused": unused},
        objects=[ROOM],
        integrator={"type": "path", "max_depth": 1024},
    )
