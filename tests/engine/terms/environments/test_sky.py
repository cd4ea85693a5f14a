"""Light from environments that are sampled by their tables, through the renderer.

Means are compared as in tests/estimates.py, about 60 of them. Beside their errors stands 1e-4 for shadow rays, which
leave 2^-19 of the half extent above the surface.
"""

import dataclasses
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.core.environment import ConstantEnvironment, CubeEnvironment
from course.engine.formats.pictures.files import save
from course.engine.terms.environments.sampling import ProductSampling
from course.engine.terms.environments.sky import CosineSampling
from course.engine.terms.scattering.hemisphere import cosine_directions
from tests.conftest import MakeScene
from tests.engine.terms.environments.skies import by_texel
from tests.estimates import estimate
from tests.lengths import fewer

pytestmark = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]

FLOOR = {"shape": "quad", "material": "white", "width": 6, "depth": 6}
SKY = np.array([0.5, 0.7, 1.0])
SIZE, ROW, COLUMN, SUN = 128, 40, 30, 12000.0


def environment(folder: Path, faces: NDArray[np.floating], **keys: Any) -> dict[str, Any]:
    """As a description, from faces (6, S, S, 3)."""
    names = []
    for number, face in enumerate(faces):
        names.append(f"face{number}.exr")
        save(folder / names[-1], np.moveaxis(face, -1, 0).astype(np.float32))
    return {"type": "cube", "faces": names, "lights": True} | keys


def sunny() -> NDArray[np.float32]:
    """An even sky with a sun of one texel on the face +y."""
    faces = np.full((6, SIZE, SIZE, 3), SKY, np.float32)
    faces[2, ROW, COLUMN] += np.float32(SUN)
    return faces


def towards_sun() -> tuple[Array, float]:
    """Unit vector, and the solid angle of a texel there: bilinear interpolation keeps the texel's light."""
    d = by_texel(SIZE)[2, ROW, COLUMN, 0]
    r = float(np.linalg.norm(d))
    return d / r, 4 / SIZE**2 / r**3


def uneven() -> NDArray[np.float32]:
    """Bright all around one horizontal direction, so that both ways to sample have a small variance."""
    d = by_texel(24)[..., 0, :]
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    glow = 0.2 + 4 * np.exp(-8 * (1 - d @ np.array([0.8, 0.6, 0])))
    return (glow[..., None] * (1.0, 0.8, 0.5)).astype(np.float32)


@pytest.fixture
def spot(make_scene: MakeScene) -> MakeScene:
    """Looks at the origin of a white floor, turned by some degrees about z."""

    def make(sky: dict[str, Any], degrees: float = 0, *objects: dict[str, Any]) -> Scene:
        turn = {"rotate": {"axis": [0, 0, 1], "degrees": degrees}}
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        return make_scene(
            camera={"eye": [0.1 * c - 0.2 * s, 0.1 * s + 0.2 * c, 0.1], "look_at": [0, 0, 0]}
            | {"vertical_fov": 1e-3},
            film={"width": 16, "height": 16},
            objects=[FLOOR | {"transform": [turn]}, *objects],
            materials={"white": {"color": 1}, "black": {"color": 0}},
            environment=sky,
        )

    return make


def by_cosine(scene: Scene) -> Scene:
    """The same scene without tables."""
    world = scene.compiled.world
    assert isinstance(world.environment, CubeEnvironment)
    assert isinstance(world.sky, ProductSampling)
    compiled = dataclasses.replace(
        scene.compiled, world=dataclasses.replace(world, sky=CosineSampling())
    )
    return dataclasses.replace(scene, compiled=compiled)


# ---------------------------------------------------------------- with tables


@fewer
@pytest.mark.parametrize(
    ("degrees", "lookup"),
    [*((each, "seamless") for each in (0, 35, 70, 85, 120, 180)), (35, "clamped"), (85, "clamped")],
)
def test_a_plane_under_sun_and_sky_has_their_irradiance(
    spot: MakeScene, tmp_path: Path, degrees: float, lookup: str
) -> None:
    mean, tolerance = estimate(spot(environment(tmp_path, sunny(), lookup=lookup), degrees))
    normal = np.array([-math.sin(math.radians(degrees)), math.cos(math.radians(degrees)), 0])
    direction, solid_angle = towards_sun()
    exact = SKY + SUN * solid_angle * max(float(normal @ direction), 0) / np.pi
    assert (np.abs(mean - exact) < tolerance + 2e-4 * exact).all()
    assert (tolerance < 0.02 * exact).all(), "the estimate is worth something"


def test_the_sun_casts_a_shadow(spot: MakeScene, tmp_path: Path) -> None:
    direction, _ = towards_sun()
    tilt = math.degrees(math.acos(direction[1]))
    axis = np.cross([0, 1, 0], direction)
    # A disc at right angles to the sun's direction, of half angle 3 degrees as seen from the origin.
    radius = math.tan(math.radians(3))
    turned = [{"rotate": {"axis": axis.tolist(), "degrees": tilt}}]
    hat = {"shape": "disk", "material": "black", "radius": radius, "segments": 4096}
    hat["transform"] = [*turned, {"translate": direction.tolist()}]
    mean, tolerance = estimate(spot(environment(tmp_path, sunny()), 0, hat))
    # What the disc hides of the even sky is its form factor sin^2 cos; the sun is all gone.
    exact = SKY * (1 - math.sin(math.radians(3)) ** 2 * direction[1])
    assert (np.abs(mean - exact) < tolerance + 2e-4 * exact).all()
    assert (tolerance < 0.02 * exact).all()


@fewer
@pytest.mark.parametrize(
    ("degrees", "sampler"),
    [(-60, "sobol"), (20, "sobol"), (150, "sobol"), (20, "random"), (20, "jittered")],
)
def test_tables_and_cosine_agree(
    spot: MakeScene, tmp_path: Path, degrees: float, sampler: str
) -> None:
    wall = {"shape": "quad", "material": "black", "width": 2, "depth": 2}
    wall["transform"] = [{"rotate": {"axis": [0, 0, 1], "degrees": 80}}, {"translate": [1, 0, 0]}]
    scene = spot(environment(tmp_path, uneven()), degrees, wall)
    (a, da), (b, db) = (
        estimate(each, 256, sampler=sampler, seed=number)
        for number, each in enumerate((scene, by_cosine(scene)))
    )
    assert (np.abs(a - b) < np.hypot(da, db)).all()
    assert (np.hypot(da, db) < 0.05 * b).all(), "the comparison is worth something"


def test_the_squared_error_under_a_sun_is_five_thousand_times_less(
    spot: MakeScene, tmp_path: Path
) -> None:
    direction, solid_angle = towards_sun()
    share = solid_angle * direction[1] / np.pi
    exact = SKY + SUN * share
    shown = render(spot(environment(tmp_path, sunny())), spp=64).linear.astype(np.float64)
    squared = ((shown - exact) ** 2).mean()
    # The bilinear pyramid over a texel of height 1 has a mean square of 4/9 over the texel's area; the cosine's 64
    # samples hit it so rarely that strata don't help. The tables' texels are as large as the sun's own, and leave a
    # variance as large as its squared mean for each sample.
    by_cosine = SUN**2 * 4 / 9 * share / 64
    assert squared < by_cosine / 5000
    assert squared < 1.5 * (SUN * share) ** 2 / 64


def test_a_coarse_ball_takes_no_light_from_below_its_round_horizon(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    """Where facet and shading normal differ, both horizons count, as they do for the cosine."""
    scene = make_scene(
        camera={"eye": [-4, 0.5, 1], "look_at": [0, 0, 0], "vertical_fov": 30},
        objects=[{"shape": "sphere", "material": "white", "radius": 1, "segments": 8}],
        materials={"white": {"color": 1}},
        # Seen from the dark side, so that most is lit by what is near the horizon.
        environment=environment(tmp_path, uneven()),
    )
    assert (render(scene, spp=1).linear >= 0).all(), "no sample takes light away"
    halves = []
    for each in (scene, by_cosine(scene)):
        seeds = np.stack([render(each, spp=64, seed=seed).linear for seed in range(12)])
        means = seeds.mean(axis=(1, 2)).astype(np.float64)
        halves.append((means.mean(axis=0), means.std(axis=0, ddof=1) / math.sqrt(12)))
    (a, da), (b, db) = halves
    # Student's t for 11 degrees of freedom.
    assert (np.abs(a - b) < 9.3 * np.hypot(da, db)).all()
    assert (np.hypot(da, db) < 0.002 * b).all(), "the comparison is worth something"


def test_a_picture_is_the_same_for_any_number_of_threads(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    scene = make_scene(
        camera={"eye": [0, 2, 4], "look_at": [0, 0, 0]},
        film={"width": 150, "height": 100},
        objects=[FLOOR, {"shape": "sphere", "material": "white", "radius": 1}],
        materials={"white": {"color": 0.7}},
        environment=environment(tmp_path, uneven()),
    )
    one, three = (render(scene, spp=16, threads=threads).linear for threads in (1, 3))
    assert np.array_equal(one, three)
    again = render(scene, spp=16, start=render(scene, spp=16)).linear
    assert np.array_equal(one, again)


def test_extreme_light_stays_finite(make_scene: MakeScene, tmp_path: Path) -> None:
    """Suns in the corner of a face, on an edge and on the horizon, in a sky that is black elsewhere."""
    faces = np.zeros((6, 32, 32, 3), np.float32)
    faces[0, 0, 0] = 1e15
    faces[4, 16, 31] = 1e-15
    faces[3, 5, 5] = 1
    scene = make_scene(
        camera={"eye": [0, 1, 4], "look_at": [0, 0, 0]},
        objects=[FLOOR, {"shape": "sphere", "material": "white", "radius": 1, "segments": 32}],
        materials={"white": {"color": 0.7}},
        environment=environment(tmp_path, faces),
    )
    linear = render(scene, spp=16).linear
    assert np.isfinite(linear).all()
    assert (linear >= 0).all()
    assert linear.max() > 1e8


# ---------------------------------------------------------------- nothing that isn't needed


MIXED = {
    "camera": {"eye": [0, 1, 3], "look_at": [0, 0, 0]},
    "objects": [
        {"shape": "sphere", "material": "silver", "radius": 0.7},
        {"shape": "sphere", "material": "white", "radius": 0.4}
        | {"transform": [{"translate": [0.8, 0, 0.8]}]},
    ],
    "materials": {"silver": {"color": 0, "mirror": 0.9}, "white": {"color": 0.8}},
}


def test_only_what_is_diffuse_draws_numbers_and_casts_rays(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    flat = make_scene(**MIXED, integrator={"max_depth": 0})
    white = make_scene(
        **MIXED | {"lights": [{"type": "ambient", "radiance": 1}]}, integrator={"max_depth": 0}
    )
    # One sample in the middle of each pixel; the ambient term shows which of them see the white ball.
    one = {"spp": 1, "sampler": "regular"}
    assert not render(flat, **one).linear.any()
    balls = (render(white, **one).linear.max(axis=2) > 0).sum()
    for sky in (environment(tmp_path, uneven()), {"type": "constant", "radiance": 1}):
        scene = make_scene(**MIXED, environment=sky | {"lights": True}, integrator={"max_depth": 0})
        receipt = render(scene, **one).receipt
        assert receipt.numbers["environment"] == 2 * balls
        assert 0.7 * balls < receipt.rays["shadow"] <= balls


def test_directions_below_the_horizon_cost_no_rays(spot: MakeScene, tmp_path: Path) -> None:
    """The tables draw a few; the cosine draws none."""
    scene = spot(environment(tmp_path, uneven()), -60)
    hits = 256 * 64
    assert 0.9 * hits < render(scene, spp=64).receipt.rays["shadow"] < hits
    assert render(by_cosine(scene), spp=64).receipt.rays["shadow"] == hits


@pytest.mark.parametrize("lights", [True, False])
def test_mirrors_need_no_tables(make_scene: MakeScene, tmp_path: Path, lights: bool) -> None:
    """What is only mirrored or seen is the same picture whether the environment lights or not."""
    objects = [MIXED["objects"][0]]
    if not lights:
        objects = MIXED["objects"]
    scene = make_scene(
        **MIXED | {"objects": objects}, environment=environment(tmp_path, uneven(), lights=lights)
    )
    world = scene.compiled.world
    assert isinstance(world.environment, CubeEnvironment)
    assert not isinstance(world.sky, ProductSampling)
    picture = render(scene)
    assert picture.receipt.rays["shadow"] == 0
    assert "environment" not in picture.receipt.numbers
    dark = make_scene(
        **MIXED | {"objects": objects}, environment=environment(tmp_path, uneven(), lights=False)
    )
    assert np.array_equal(picture.linear, render(dark).linear)


@pytest.mark.parametrize("scale", [1, 1e-40])
def test_black_surroundings_need_nothing(
    make_scene: MakeScene, tmp_path: Path, scale: float
) -> None:
    """Neither those that are painted black nor those whose light is lost to float32."""
    faces = np.zeros((6, 4, 4, 3))
    if scale < 1:
        faces[2] = 1e-10
    scene = make_scene(**MIXED, environment=environment(tmp_path, faces, scale=scale))
    picture = render(scene)
    assert not picture.linear.any()
    assert picture.receipt.rays["shadow"] == 0


def test_an_even_sky_keeps_the_cosine_exactly(make_scene: MakeScene, tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    normal = rng.normal(size=(3, 100)).astype(np.float32)
    normal /= np.linalg.norm(normal, axis=0)
    u = rng.random((2, 100), np.float32)
    # A cube of one colour is a constant environment, to the last bit but for the interpolation's weights.
    cube = environment(tmp_path, np.full((6, 4, 4, 3), 0.75))
    flat = {"type": "constant", "radiance": 0.75, "lights": True}
    cube_scene, flat_scene = (make_scene(**MIXED, environment=sky) for sky in (cube, flat))
    world = flat_scene.compiled.world
    assert isinstance(world.environment, ConstantEnvironment)
    assert world.sky is not None
    direction, weight = world.sky.sample(normal, u)
    assert weight is None
    assert np.array_equal(direction, cosine_directions(normal, u))
    a, b = render(cube_scene), render(flat_scene)
    assert np.allclose(a.linear, b.linear, rtol=1e-5)
    assert a.receipt.rays == b.receipt.rays
    assert a.receipt.numbers == b.receipt.numbers
