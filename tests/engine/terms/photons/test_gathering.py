"""Light by way of matte surfaces: final gathering in a closed ball, beside paths in a box, and by nearest photons."""

from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import CourseWarning, SceneError
from course.engine.core.rays import RAYS
from course.engine.core.samplers import Block
from course.engine.core.types import Floats64
from course.engine.recording.recording import record
from course.engine.scene.scene import Scene
from course.engine.terms.photons.gathering import Gathering, ManySampler
from course.engine.terms.samplers.sobol import SobolSampler
from tests.conftest import MakeScene
from tests.engine.terms.photons.parts import (
    FLOOR,
    GLOBE,
    ball,
    caustics,
    map_of,
    pictures,
    sky_of,
)

ALBEDO = np.array([0.8, 0.5, 0.2])


def closed_ball(make_scene: MakeScene, **more: Any) -> Scene:
    """Its inside, lit from the middle: all places are alike, and there is no edge at which photons are missing."""
    known: dict[str, Any] = {
        "camera": {"eye": [0, 0, 0.5], "look_at": [0, 0.1, 0], "vertical_fov": 60},
        "film": {"width": 6, "height": 6},
        "materials": {"wall": {"color": ALBEDO.tolist()}},
        "objects": [{"shape": "sphere", "material": "wall", "radius": 1, "segments": 96}],
        "lights": [{"type": "point", "position": [0, 0, 0], "intensity": 2}],
        "integrator": {"max_depth": 4},
        "photons": {"count": 20_000, "radius": 0.1, "gather": 4},
    }
    return make_scene(**known | more)


@pytest.mark.parametrize("estimate", [{}, {"nearest": 40}], ids=["radius", "nearest"])
@pytest.mark.parametrize("depth", [1, 4])
def test_a_closed_ball_is_as_bright_as_its_series(
    make_scene: MakeScene, depth: int, estimate: dict[str, int]
) -> None:
    """Each bounce brings albedo times what the one before has brought: E = I (1 + a + ... + a^depth)."""
    photons = {"count": 20_000, "radius": 0.1, "gather": 4} | estimate
    scene = closed_ball(make_scene, integrator={"max_depth": depth}, photons=photons)
    found = render(scene, spp=32).linear.mean(axis=(0, 1), dtype=np.float64)
    series = sum(ALBEDO**k for k in range(depth + 1))
    expected = ALBEDO / np.pi * 2 * series
    # 5000 rays in 36 pixels see 20,000 photons, each channel with an error of about a percent of what they bring. The
    # k-th nearest of k photons lies at the edge of its disk, which makes the estimate larger by 1 / (k - 1).
    above = 1 / 39 if estimate else 0
    assert (found <= expected * (1.01 + above)).all()
    assert (found >= expected * 0.99).all()


def test_photons_of_all_surfaces_have_the_power_that_these_send_on(make_scene: MakeScene) -> None:
    """The lamp's, 8 pi W, times albedo + albedo^2 + ...: each photon lives by chance as its strongest channel does."""
    scene = closed_ball(make_scene)
    gathering = sky_of(scene)
    assert isinstance(gathering, Gathering)
    assert gathering.passes is not None
    power = map_of(scene, gathering.passes).power.astype(np.float64)
    terms = np.array([ALBEDO**k for k in range(1, 4)])
    expected = 8 * np.pi * terms.sum(axis=0)
    # Of independent photons whose numbers of bounces are geometric, with q = 0.8, cut off at 3: by its variance.
    chances = 0.8 ** np.arange(1, 4) * [0.2, 0.2, 1]
    chances = np.concatenate(([0.2], chances))
    brought = np.concatenate(
        (np.zeros((1, 3)), np.cumsum(terms / 0.8 ** np.arange(1, 4)[:, None], axis=0))
    )
    sigma = np.sqrt(chances @ (brought - terms.sum(axis=0)) ** 2 / 20_000) * 8 * np.pi
    assert (np.abs(power.sum(axis=1) - expected) <= 4 * sigma).all()


def box(make_scene: MakeScene, kind: str, **more: Any) -> Scene:
    """A room with a red and a green wall, open to the camera, and a box in it that is half a mirror."""

    def wall(material: str, *transform: dict[str, Any]) -> dict[str, Any]:
        size = {"shape": "quad", "width": 2, "depth": 2}
        return size | {"material": material, "transform": list(transform)}

    def turned(x: float, y: float, z: float, degrees: float) -> dict[str, Any]:
        return {"rotate": {"axis": [x, y, z], "degrees": degrees}}

    walls = [
        wall("white", {"translate": [0, -1, 0]}),
        wall("white", turned(1, 0, 0, 180), {"translate": [0, 1, 0]}),
        wall("white", turned(1, 0, 0, 90), {"translate": [0, 0, -1]}),
        wall("red", turned(0, 0, 1, -90), {"translate": [-1, 0, 0]}),
        wall("green", turned(0, 0, 1, 90), {"translate": [1, 0, 0]}),
    ]
    block = {"shape": "box", "material": "half", "size": [0.6, 1, 0.6]}
    lamp = {"type": "rectangle", "corner": [-0.3, 0.98, -0.3], "edge_u": [0.6, 0, 0]}
    known: dict[str, Any] = {
        "camera": {"eye": [0, 0, 3.4], "look_at": [0, 0, 0], "vertical_fov": 26},
        "film": {"width": 12, "height": 12},
        "materials": {
            "white": {"color": 0.7},
            "red": {"color": [0.6, 0.1, 0.1]},
            "green": {"color": [0.1, 0.5, 0.1]},
            "half": {"color": 0.3, "mirror": [0.7, 0.4, 0.1]},
        },
        "objects": [*walls, block | {"transform": [{"translate": [0.3, -0.5, -0.2]}]}],
        "lights": [lamp | {"edge_v": [0, 0, 0.6], "radiance": 10}],
        # Deep enough that it doesn't matter that photons begin anew to count bounces where a mirror has shown them.
        "integrator": {"type": kind, "max_depth": 12},
    }
    return make_scene(**known | more)


def test_gathered_light_is_that_of_paths(make_scene: MakeScene) -> None:
    by_paths = pictures(box(make_scene, "path"), 256, 4)
    photons = {"count": 40_000, "radius": 0.04, "gather": 4}
    found = pictures(box(make_scene, "distribution", photons=photons), 16, 4)
    error = np.hypot(by_paths.std(axis=0, ddof=1), found.std(axis=0, ddof=1)) / 2
    off = np.abs(by_paths.mean(axis=0) - found.mean(axis=0))
    assert (off <= 6 * error + 0.004 * by_paths.mean(axis=0)).all()


def test_what_shines_counts_once(make_scene: MakeScene) -> None:
    """A closed ball whose wall is grey and whose lamp is a ball in the middle, as a light, and then as what glows.

    A wall gets pi L r^2 = 0.16 from the lamp. The lamp takes a share of r^2 = 0.04 of what leaves a wall, and is black.
    """
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 0, 0.5], "look_at": [0, 0, 1], "vertical_fov": 40},
        "materials": {"wall": {"color": 0.5}, "m": {"color": 0, "emission": 4 / np.pi}},
        "objects": [
            {"shape": "sphere", "material": "wall", "radius": 1, "segments": 96},
            {"shape": "sphere", "name": "lamp", "material": "m", "radius": 0.2, "segments": 64},
        ],
        "integrator": {"max_depth": 2},
        "photons": {"count": 20_000, "radius": 0.1, "gather": 16},
    }
    lamp = closed_ball(make_scene, **parts | {"lights": [{"type": "object", "object": "lamp"}]})
    orders = 0.5 * 0.16 / np.pi * np.cumprod([1, 0.5 * 0.96, 0.5 * 0.96])
    found = render(lamp, spp=32).linear.mean(axis=(0, 1), dtype=np.float64)
    assert found == pytest.approx(np.full(3, orders.sum()), rel=0.02)
    # A lamp that is a point, and dim, so that there are photons to be sent; what glows lights others once.
    dim = {"type": "point", "position": [0.5, 0, 0], "intensity": 1e-6}
    with pytest.warns(CourseWarning, match="what glows and is no light sends no photons"):
        glows = closed_ball(make_scene, **parts | {"lights": [dim]})
    found = render(glows, spp=32).linear.mean(axis=(0, 1), dtype=np.float64)
    assert found == pytest.approx(np.full(3, orders[0]), rel=0.05)


@pytest.mark.parametrize(("depth", "rays"), [(1, 0), (2, 4 * 36 * 16)])
def test_what_is_seen_by_the_last_bounce_gathers_no_more(
    make_scene: MakeScene, depth: int, rays: int
) -> None:
    """All that the eye sees is the mirror, and in it the wall."""
    mirror = {"shape": "quad", "material": "m", "width": 0.9, "depth": 0.9}
    wall = {"shape": "sphere", "material": "wall", "radius": 1, "segments": 96}
    scene = closed_ball(
        make_scene,
        camera={"eye": [0, 0.3, 0.01], "look_at": [0, -0.2, 0], "vertical_fov": 40},
        materials={"wall": {"color": 0.5}, "m": {"color": 0, "mirror": 1}},
        objects=[wall, mirror | {"transform": [{"translate": [0, -0.2, 0]}]}],
        integrator={"max_depth": depth},
    )
    gathered = render(scene, spp=16).receipt.rays.get("gather", 0)
    # Rays that meet the mirror are mirrored, and counted again.
    assert rays <= gathered <= 2 * rays


def test_memory_is_bounded_whatever_is_gathered(make_scene: MakeScene, monkeypatch: Any) -> None:
    """Rays are followed RAYS at a time; those of a hit stay together."""
    from course.engine.terms.photons import gathering

    most = []
    rays = gathering.Gathering._rays

    def seen(self: Any, *arguments: Any) -> Any:
        made = rays(self, *arguments)
        most.append(made.size)
        return made

    monkeypatch.setattr(gathering.Gathering, "_rays", seen)
    photons = {"count": 1000, "gather": 1000}
    scene = closed_ball(make_scene, photons=photons, integrator={"max_depth": 1})
    render(scene, spp=4)
    assert RAYS // 2 < max(most) <= RAYS
    assert len(most) > 1


def test_gathering_is_the_same_however_the_picture_is_rendered(make_scene: MakeScene) -> None:
    scene = closed_ball(make_scene, film={"width": 12, "height": 10})
    one, other = (render(scene, spp=16, threads=n).linear for n in (1, 2))
    assert np.array_equal(one, other)


def lit(scene: Scene) -> Floats64:
    return np.asarray(render(scene, spp=16).linear.mean(axis=(0, 1)), np.float64)


def test_nearest_photons_make_the_caustic_that_a_filter_makes(make_scene: MakeScene) -> None:
    """A beam through a ball, averaged over the floor: its power; the disk of 60 is larger by a 59th at most."""
    beam = {"type": "directional", "direction": [0, -1, 0], "irradiance": 2}
    parts: dict[str, Any] = {"lights": [beam], "film": {"width": 16, "height": 16}}
    by_filter, by_nearest, without = (
        lit(caustics(make_scene, photons=photons, **parts))
        for photons in (
            {"count": 50_000, "radius": 0.05},
            {"count": 50_000, "radius": 0.05, "nearest": 60},
            None,
        )
    )
    brought = (by_nearest - without) / (by_filter - without)
    assert ((brought > 0.99) & (brought < 1.03)).all()


def test_rays_of_a_pixel_tell_of_gathered_light_and_add_up(make_scene: MakeScene) -> None:
    scene = closed_ball(make_scene)
    recording = record(scene, 1, 1, spp=16)
    total = sum(np.array(one.radiance) for one in recording.segments) / 16
    np.testing.assert_allclose(total, render(scene, spp=16).linear[1, 1], rtol=1e-3)
    told = [one for one in recording.segments if one.light == "gathered light"]
    # Four rays for each sample, all of which end on the ball. What nobody has told of would be the wall's own.
    assert len(told) == 4 * 16
    own = [one.radiance for one in recording.segments if one.kind == "camera"]
    np.testing.assert_allclose(own, 0, atol=1e-5)


def test_rays_that_gather_have_numbers_of_their_own_that_are_as_even_as_their_paths() -> None:
    """Of 4000 rays of each of two paths the means of numbers are within 5 standard errors of 1/2."""
    block = Block(np.arange(2, dtype=np.uint32), 0, 1, 0)
    sampler = ManySampler(SobolSampler(3), np.array([0, 1]), 4000)
    u = sampler.draw(block, 6, 2).reshape(2, 2, 4000)
    assert u.min() >= 0
    assert u.max() < 1
    assert np.abs(u.mean(axis=2) - 0.5).max() < 5 * (12 * 4000) ** -0.5
    assert np.abs(np.corrcoef(u[0, 0], u[1, 0])[0, 1]) < 5 * 4000**-0.5
    # Others at other depths, for a path's numbers there are others as well.
    assert not np.allclose(u[0, 0], sampler.draw(block, 8, 2)[0, :4000])


@pytest.mark.parametrize(
    ("photons", "integrator", "said"),
    [
        ({"gather": 2}, {"type": "path"}, r"photons.gather is 2: expected 0 where .* path"),
        ({"nearest": 5, "cone": 1.5}, {}, r"photons.cone: expected none beside nearest"),
        ({"nearest": 0}, {}, r"photons.nearest is 0"),
    ],
)
def test_what_is_refused(
    make_scene: MakeScene, photons: dict[str, Any], integrator: dict[str, Any], said: str
) -> None:
    with pytest.raises(SceneError, match=said):
        caustics(make_scene, lights=[GLOBE], photons=photons, integrator=integrator)


def test_functions_that_are_asked_for_are_those_that_are_called(make_scene: MakeScene) -> None:
    parts: dict[str, Any] = {"objects": [FLOOR, ball()], "lights": [GLOBE]}

    def needs(**photons: Any) -> set[str]:
        scene = caustics(make_scene, photons=photons, **parts)
        return {
            need.function.split(".")[1]
            for need in scene.compiled.needs
            if "photon" in need.function
        }

    always = {"emit_area", "emit_cone", "roulette", "stored", "shrunk_radius"}
    assert needs() == always | {"cone_weights"}
    assert needs(nearest=5) == always | {"density_estimate"}
    assert needs(gather=2) == always | {"cone_weights", "final_gather"}
