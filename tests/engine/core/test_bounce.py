"""Rays that go on: mirrors and glass against closed forms, energy, depth and cutoff."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.core.accelerator import QueryStats
from course.engine.core.counters import Counters
from course.engine.core.rays import Draws
from course.engine.core.samplers import Block
from course.engine.render.binding import bind
from tests.conftest import MakeScene, PixelRays
from tests.estimates import fresnel
from tests.lengths import fewer

pytestmark = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]

ONE = {"type": "regular", "samples": 1}
FLOOR = {"shape": "quad", "material": "m", "width": 20, "depth": 20}
EXACT = {"max_depth": 64, "cutoff": 0}


def lamp(y: float, up: bool, half: float, radiance: float = 1.0) -> dict[str, Any]:
    """A square light in the plane at height y."""
    light = {"type": "rectangle", "corner": [-half, y, -half], "radiance": radiance}
    x, z = [2 * half, 0, 0], [0, 0, 2 * half]
    return light | ({"edge_u": z, "edge_v": x} if up else {"edge_u": x, "edge_v": z})


def grey(scene: Scene) -> Array:
    """(H, W) of a picture without colours."""
    linear = render(scene).linear.astype(np.float64)
    assert np.array_equal(linear[..., 0], linear[..., 2])
    return linear[..., 0]


def test_a_mirror_shows_a_lamp_where_the_law_of_reflection_puts_it(
    make_scene: MakeScene, pixel_rays: PixelRays
) -> None:
    scene = make_scene(
        camera={"eye": [0.2, 1, 2], "look_at": [0, 0, 0.3], "vertical_fov": 60},
        film={"width": 64, "height": 64},
        sampler=ONE,
        objects=[FLOOR],
        materials={"m": {"color": 0, "mirror": 0.5}},
        lights=[lamp(1.5, False, 1.2, 3.0)],
    )
    eye, d = pixel_rays(scene)
    assert (d[1] < 0).all(), "the floor fills the picture"
    # Where the mirrored ray meets the lamp's plane: down by 1 and up by 1.5.
    p = eye[:, None, None] - d * ((eye[1] + 1.5) / d[1])
    inside = np.abs(p[[0, 2]]).max(axis=0)
    found = grey(scene)
    assert np.array_equal(found[inside < 1.2 - 1e-4], np.full((inside < 1.2 - 1e-4).sum(), 1.5))
    assert not found[inside > 1.2 + 1e-4].any()
    assert 0.1 < (found > 0).mean() < 0.9


def between_mirrors(
    make_scene: MakeScene, mirror: float, **integrator: float
) -> NDArray[np.float32]:
    """A camera between two parallel mirrors whose every surface adds 1 of its own."""
    lower = {"transform": [{"translate": [0, -1, 0]}]}
    upper = {"transform": [{"translate": [0, 1, 0]}]}
    scene = make_scene(
        camera={"eye": [0, 0, 0], "look_at": [0, -1, 0], "up": [0, 0, 1], "vertical_fov": 1},
        film={"width": 8, "height": 8},
        objects=[FLOOR | lower, FLOOR | upper],
        materials={"m": {"color": 1, "diffuse": 0, "mirror": mirror}},
        lights=[{"type": "ambient", "radiance": 1}],
        integrator=integrator,
    )
    return render(scene).linear


@pytest.mark.parametrize("depth", [0, 1, 2, 5, 20, 64])
def test_the_depth_is_the_number_of_bounces(make_scene: MakeScene, depth: int) -> None:
    found = between_mirrors(make_scene, 0.75, max_depth=depth, cutoff=0)
    assert np.allclose(found, sum(0.75**k for k in range(depth + 1)), rtol=1e-6)


@pytest.mark.parametrize(
    ("cutoff", "bounces"), [(0.5, 0), (0.4999, 1), (0.25, 1), (0.2, 2), (2.0**-10, 9), (0.0, 20)]
)
def test_rays_that_bring_no_more_than_the_cutoff_are_dropped(
    make_scene: MakeScene, cutoff: float, bounces: int
) -> None:
    found = between_mirrors(make_scene, 0.5, max_depth=20, cutoff=cutoff)
    assert np.array_equal(found, np.full_like(found, sum(0.5**k for k in range(bounces + 1))))


def test_the_brightest_channel_decides_about_the_cutoff(make_scene: MakeScene) -> None:
    scene = make_scene(
        camera={"eye": [0, 1, 2], "look_at": [0, 0, 0]},
        objects=[FLOOR],
        materials={"m": {"mirror": [0.01, 0.2, 0.01]}},
        environment={"type": "constant", "radiance": 1},
        integrator={"cutoff": 0.1},
    )
    assert np.allclose(render(scene).linear, [0.01, 0.2, 0.01], rtol=1e-6)


@pytest.mark.parametrize("index", [1.1, 1.5, 2.4])
def test_reflectance_at_normal_incidence(make_scene: MakeScene, index: float) -> None:
    scene = make_scene(
        camera={"eye": [0, 1, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.1},
        objects=[FLOOR],
        materials={"m": {"dielectric": {"refraction_index": index}}},
        lights=[lamp(2, False, 5)],
        integrator={"cutoff": 0},
    )
    assert np.allclose(grey(scene), ((index - 1) / (index + 1)) ** 2, rtol=1e-5)


@pytest.mark.parametrize("index", [1 / 1.5, 1.2, 1.5, 2.4])
@pytest.mark.parametrize("inside", [False, True])
def test_reflected_and_refracted_light_obey_fresnel_and_snell(
    make_scene: MakeScene, pixel_rays: PixelRays, index: float, inside: bool
) -> None:
    # One plane of glass, seen from above (outside) or from below (inside); a large lamp on the camera's side shows what
    # is reflected, a small one on the far side what is refracted, and where.
    sign = -1.0 if inside else 1.0
    eta = index if inside else 1 / index
    found, expected, clear = [], [], []
    for light in (lamp(2 * sign, inside, 100), lamp(-sign, not inside, 0.7)):
        scene = make_scene(
            camera={"eye": [0, sign, 0.9], "look_at": [0, 0, -0.2], "vertical_fov": 75},
            film={"width": 48, "height": 48},
            sampler=ONE,
            objects=[FLOOR | {"width": 200, "depth": 200}],
            materials={"m": {"dielectric": {"refraction_index": index}}},
            lights=[light],
            integrator={"cutoff": 0},
        )
        found.append(grey(scene))
    eye, d = pixel_rays(scene)
    cos_i = -d[1] * sign
    assert (cos_i > 0.05).all()
    reflectance, cos_t = fresnel(cos_i, eta)
    hit = eye[:, None, None] + d * (1 / cos_i)
    # Snell: the part of the direction along the surface is eta times as long, the other is cos_t.
    with np.errstate(divide="ignore", invalid="ignore"):
        far = hit[[0, 2]] + d[[0, 2]] * eta / cos_t
    reach = np.abs(np.nan_to_num(far, nan=np.inf)).max(axis=0)
    expected = [reflectance, np.where(reach < 0.7, 1 - reflectance, 0)]
    clear = [np.ones_like(reach, bool), np.abs(reach - 0.7) > 2e-3]
    # Close to the critical angle sqrt(1 - sin^2) makes 1e-7 of the sine into 3e-4 of the cosine.
    critical = np.abs(1 - eta**2 * (1 - cos_i**2))
    clear = [mask & (critical > 1e-4) for mask in clear]
    for a, b, mask in zip(found, expected, clear, strict=True):
        assert mask.mean() > 0.9
        assert np.allclose(a[mask], b[mask], rtol=1e-3, atol=2e-5)
    total = reflectance == 1
    assert total.any() == (eta > 1)
    assert np.array_equal(found[0][total & clear[0]], np.ones((total & clear[0]).sum()))
    assert (found[1] > 0.5).any()


def furnace(make_scene: MakeScene, thing: dict[str, Any], index: float, **integrator: Any) -> Array:
    """Something of clear glass where everything around it has radiance 1."""
    scene = make_scene(
        camera={"eye": [0.3, 0.5, 3], "look_at": [0, 0, 0], "vertical_fov": 45},
        objects=[{"material": "m"} | thing],
        materials={"m": {"dielectric": {"refraction_index": index}}},
        environment={"type": "constant", "radiance": 1},
        integrator=integrator,
    )
    return grey(scene)


CONVEX = [
    {"shape": "sphere"},
    {"shape": "sphere", "segments": 12},
    {"shape": "sphere", "shading": "flat", "segments": 16},
    {"shape": "box", "size": [1.2, 1, 0.8], "transform": [{"rotate": {"axis": [1, 2, 3], "degrees": 40}}]},
    {"shape": "cylinder"},
]  # fmt: skip


@fewer
@pytest.mark.parametrize("thing", CONVEX)
@pytest.mark.parametrize("index", [1.0, 1.5, 1 / 1.5])
def test_clear_glass_in_a_white_furnace_cannot_be_seen(
    make_scene: MakeScene, thing: dict[str, Any], index: float
) -> None:
    found = furnace(make_scene, thing, index, **EXACT)
    # Never more than everything. What is missing after 64 bounces is (1 - F) F^64 <= 1/(65 e) of a path that meets the
    # surface at one angle throughout, as in a ball; facets keep some light in by total reflection for ever, and near
    # the rim of a ball of 64 segments up to about as much again.
    assert found.max() <= 1 + 1e-5
    if thing == {"shape": "sphere"}:
        assert found.min() > 1 - 4 / (65 * np.e)
    assert np.median(found) > 1 - 1e-4


@pytest.mark.parametrize("cutoff", [0.1, 0.02, 1 / 512])
@pytest.mark.usefixtures("each_form")
def test_the_cutoff_takes_nothing_from_clear_glass(make_scene: MakeScene, cutoff: float) -> None:
    """What is too weak to be followed goes the other way; it had been missing, up to .01 of what there is."""
    found = furnace(make_scene, {"shape": "sphere"}, 1.5, max_depth=64, cutoff=cutoff)
    assert found.max() <= 1 + 1e-5
    assert np.median(found) > 1 - 1e-6
    # Near the rim the stronger way leads back into the ball, up to the last bounce.
    assert abs(found.mean() - 1) < max(1e-4, cutoff / 50)


def test_a_smooth_mirror_sends_no_ray_into_itself(make_scene: MakeScene) -> None:
    # At the silhouette of a coarse smooth ball, reflection about the shading normal would point into the ball. All
    # light must come from outside: the ball shows only the environment, in its own colour.
    for segments in (6, 12, 40):
        scene = make_scene(
            objects=[{"shape": "sphere", "material": "m", "segments": segments}],
            materials={"m": {"mirror": 0.5}},
            environment={"type": "constant", "radiance": 1},
            integrator={"max_depth": 1, "cutoff": 0},
        )
        found = grey(scene)
        # Each sample sees the sky or its mirror image, one bounce away.
        assert np.isin(found, [0.5, 0.625, 0.75, 0.875, 1.0]).all()


def test_a_smooth_mirror_ball_shows_a_lamp_where_a_round_one_does(
    make_scene: MakeScene, pixel_rays: PixelRays
) -> None:
    scene = make_scene(
        camera={"eye": [0, 0, 5], "look_at": [0, 0, 0], "vertical_fov": 20},
        film={"width": 64, "height": 64},
        sampler=ONE,
        objects=[{"shape": "sphere", "material": "m", "segments": 64}],
        materials={"m": {"color": 0, "mirror": 0.5}},
        lights=[lamp(4, False, 2, 4.0)],
    )
    eye, d = pixel_rays(scene)
    b = np.tensordot(eye, d, 1)
    inside = b**2 - eye @ eye + 1
    n = eye[:, None, None] - (b + np.sqrt(np.maximum(inside, 0))) * d
    cosine = -(d * n).sum(axis=0)
    seen = (inside > 0) & (cosine > 0.3)
    mirrored = d + 2 * cosine * n
    up = np.where(mirrored[1] > 1e-6, mirrored[1], np.nan)
    p = n + mirrored * (4 - n[1]) / up
    reach = np.nan_to_num(np.abs(p[[0, 2]]).max(axis=0), nan=np.inf)
    found = grey(scene)
    # Normals err by (2 pi / 64)^2 / 8 of a radian, which moves what is seen 4 away by 1% of the lamp; facets by 10%.
    assert (found[seen & (reach < 1.9)] == 2).all()
    assert not found[seen & (reach > 2.1)].any()
    assert (seen & (reach < 1.9)).sum() > 100


@pytest.mark.parametrize("segments", [5, 12, 64])
@pytest.mark.parametrize("index", [1 / 1.5, 1.5])
@pytest.mark.parametrize("inside", [False, True])
def test_rays_leave_a_smooth_mesh_on_the_side_they_are_meant_to(
    make_scene: MakeScene, segments: int, index: float, inside: bool, each_form: bool
) -> None:
    scene = make_scene(
        objects=[{"shape": "sphere", "material": "m", "segments": segments}],
        materials={"m": {"mirror": 0.1, "dielectric": {"refraction_index": index}}},
        integrator={"cutoff": 0},
    )
    tracer = bind(scene, scene.settings, compiled=each_form)
    rng = np.random.default_rng(2)
    n = 20000
    target = rng.normal(size=(3, n))
    target /= np.linalg.norm(target, axis=0)
    origin = (
        rng.uniform(-0.4, 0.4, (3, n)) if inside else 3 * rng.permuted(target, axis=1)
    ).astype("f4")
    direction = (target - origin).astype(np.float32)
    direction /= np.linalg.norm(direction, axis=0)
    surface, scatter = tracer.integrator.surface, tracer.integrator.scatter
    assert scatter is not None
    hits = surface.hits(surface.accelerator.intersect(origin, direction, QueryStats()), direction)
    assert hits.size > 5000
    draws = Draws(
        tracer.sampler, tracer.dimensions, Block(np.empty(0, np.uint32), 0, 1, 0), Counters()
    )
    found = scatter(hits, None, None, None, 0, draws)
    assert found is not None
    # Every hit mirrors, and the mirrored rays come first.
    assert draws.counters.rays["reflection"] == hits.size
    refracted, mirrored = found.part(slice(hits.size, None)), found.part(slice(hits.size))
    turned_back = 0
    for rays, side in ((mirrored, 1), (refracted, -1)):
        assert rays.size > 0
        assert rays.path is not None
        ng = hits.ng[:, rays.path]
        assert (side * (rays.direction * ng).sum(axis=0)).min() >= -1e-6
        assert (side * ((rays.origin - hits.p[:, rays.path]) * ng).sum(axis=0)).min() > 0
        assert np.abs(np.linalg.norm(rays.direction.astype(float), axis=0) - 1).max() < 2e-6
        naive = hits.direction - 2 * (hits.direction * hits.ns).sum(axis=0) * hits.ns
        turned_back += int(((naive * hits.ng).sum(axis=0) < 0).sum())
    # Seen from outside, some of the shading normals would have sent a ray to the wrong side.
    assert turned_back > 0 or inside


def test_a_camera_inside_glass_looks_out(make_scene: MakeScene) -> None:
    scene = make_scene(
        camera={"eye": [0, 0, 0], "look_at": [0, 0, -1], "vertical_fov": 100},
        objects=[{"shape": "sphere", "material": "m"}],
        materials={"m": {"dielectric": {"refraction_index": 1.5}}},
        environment={"type": "constant", "radiance": [1, 2, 3]},
        integrator=EXACT,
    )
    # From the centre every ray meets the surface head on.
    assert np.allclose(render(scene).linear, [1, 2, 3], rtol=1e-3)


def test_a_camera_on_a_mirror_and_on_glass_sees_a_clean_picture(make_scene: MakeScene) -> None:
    for material in ({"mirror": 1.0}, {"dielectric": {"refraction_index": 1.5}}):
        scene = make_scene(
            camera={"eye": [0, 0, 0], "look_at": [0, 1, 1], "vertical_fov": 30},
            objects=[FLOOR],
            materials={"m": material},
            environment={"type": "constant", "radiance": 1},
            integrator=EXACT,
        )
        assert np.allclose(render(scene).linear, 1, rtol=1e-6)
