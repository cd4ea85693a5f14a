"""The loop over packets of hits finds the light that the passes over arrays find, bit for bit."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest

from course import shapes
from course.adaptive.costs import RowOfCosts
from course.compiled import library
from course.core.counters import Counters
from course.core.hits import Hits
from course.core.lights.point import DirectionalLight, PointLight
from course.core.lights.rectangle import RectangleLight
from course.core.lights.sample import Light
from course.core.lights.sphere import SphereLight
from course.core.materials import MaterialTable
from course.core.motion import Motion, MovingAccelerator
from course.core.rays import Dimensions, Draws
from course.core.samplers import Block
from course.core.scene import World, plan_direct_light
from course.core.types import Functions
from course.effects import Effects
from course.extras.plan import same_fields
from course.extras.samplers.sobol import SobolSampler
from course.extras.surface import FullPart, FullSurface, build_surface

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled.accelerator import MovingPackets, in_packets
from course.compiled.direct import CompiledDirectLight
from course.compiled.stages import compiled_surface

N = 5000
WHITE = np.array([0.9, 0.7, 0.4], np.float32)
FUNCTIONS: Any = Effects().function


class Course:
    """Functions of the course."""

    point_on_sphere = staticmethod(FUNCTIONS("soft_shadows", "point_on_sphere"))
    point_in_ball = staticmethod(FUNCTIONS("soft_shadows", "point_in_ball"))
    point_on_facing_disk = staticmethod(FUNCTIONS("soft_shadows", "point_on_facing_disk"))
    point_on_rectangle = staticmethod(FUNCTIONS("soft_shadows", "point_on_rectangle"))
    displacement = staticmethod(FUNCTIONS("motion_blur", "displacement"))
    to_object_space = staticmethod(FUNCTIONS("motion_blur", "to_object_space"))


def vector(*values: float) -> Any:
    return np.array(values, np.float32)


FUNCTIONS_OF: Any = Course
ABOVE, DOWN = vector(0.2, 0.9, 0.3), vector(0, -1, 0)
SQUARE = vector(-0.4, 0.8, -0.4), vector(0.8, 0, 0), vector(0, 0, 0.8)
LIGHTS: dict[str, Light] = {
    "point": PointLight("light", ABOVE, WHITE),
    # It shines on the inside of the collar, which is of glass and stays dark.
    "low": PointLight("light", vector(0.8, -0.3, 0.5), WHITE),
    "cell": PointLight("light", ABOVE, WHITE, normal=DOWN),
    "cell of two sides": PointLight("light", ABOVE, WHITE, normal=vector(1, 0, 0), two_sided=True),
    # As close to the ball as can be: what faces it is raised above its facets, and the light is then nearer.
    "blockable": PointLight("light", vector(0, 0.62, 0), WHITE, blockable=True),
    "sun": DirectionalLight("light", vector(0.6, 0.64, 0.48), WHITE),
    "rectangle": RectangleLight("light", *SQUARE, None, WHITE, FUNCTIONS_OF),
    "lamp": RectangleLight("light", *SQUARE, DOWN, WHITE, FUNCTIONS_OF),
    "ball": SphereLight("light", ABOVE, 0.2, False, WHITE, "ball", FUNCTIONS_OF, 3),
    "sphere": SphereLight("light", ABOVE, 0.2, False, WHITE, "sphere", FUNCTIONS_OF),
    "disk": SphereLight("light", ABOVE, 0.2, False, WHITE, "facing disk", FUNCTIONS_OF),
    "bulb": SphereLight("light", ABOVE, 0.2, True, WHITE, "sphere", FUNCTIONS_OF),
}


@pytest.fixture(scope="module", params=["still", "moving"])
def surface(request: pytest.FixtureRequest) -> FullSurface:
    return scene_of(request.param)


def scene_of(kind: str) -> FullSurface:
    """A coarse ball in a collar over a floor, and two that move away from each other, of three materials."""
    floor, collar = shapes.quad(1.8, 1.8), shapes.quad(1.1, 1.1)
    parts = [
        FullPart(replace(floor, vertices=floor.vertices - vector(0, 0.7, 0)), 1),
        FullPart(shapes.sphere(0.6, 10), 3),
        # It lies between some facets that turn away from a light and the round surface above them.
        FullPart(replace(collar, vertices=collar.vertices + vector(0, 0.35, 0)), 2),
    ]
    if kind == "still":
        return build_surface(parts)
    small = shapes.sphere(0.2, 6)
    for side in (-0.7, 0.7):
        moved = replace(small, vertices=small.vertices + vector(side, -0.3, 0))
        parts.append(FullPart(moved, 3, (0.0, 0.3, side / 2)))
    # A mover of which nothing is left: its triangles are points.
    parts.insert(1, FullPart(replace(small, vertices=small.vertices * 0), 3, (1.0, 0.0, 0.0)))
    return build_surface(parts, FUNCTIONS_OF)


def rays_to(surface: FullSurface) -> tuple[Any, Any, Any]:
    """Origins, directions and times; all are the same moment where nothing moves."""
    rng = np.random.default_rng(5)
    origin = rng.normal(size=(3, 2 * N))
    origin[1] = np.abs(origin[1]) * 0.7
    origin *= 2.5 / np.linalg.norm(origin, axis=0)
    direction = rng.uniform(-0.6, 0.6, (3, 2 * N)) - origin
    direction /= np.linalg.norm(direction, axis=0)
    moves = isinstance(surface.accelerator, MovingAccelerator)
    time = rng.random(2 * N, np.float32) if moves else None
    return origin.astype(np.float32), direction.astype(np.float32), time


def hits_of(surface: FullSurface) -> Hits:
    origin, direction, time = rays_to(surface)
    found = surface.accelerator.intersect(origin, direction, Counters().embree, time)
    return surface.hits(found, direction, time)


def materials(specular: bool) -> MaterialTable:
    """Four, of which the first is black, one has highlights, and one is glass, whose inside is dark."""
    rng = np.random.default_rng(6)
    rows: Any = rng.random((3, 4), np.float32)
    dark = np.array([0, 1, 1, 1], np.float32)
    shines = np.array([0, 0, 0, 1], np.float32) * np.float32(specular)
    none = np.zeros((3, 4), np.float32)
    index = np.array([0, 0, 1.5, 0], np.float32)
    exponent = np.array([1, 1, 20, 30], np.float32)
    return MaterialTable(none, rows * dark, rows * shines, exponent, none, index, none, none)


@pytest.mark.parametrize("specular", [False, True], ids=["matt", "highlights"])
@pytest.mark.parametrize(
    "names", [[name] for name in LIGHTS] + [["sun", "bulb", "point"]], ids=" ".join
)
def test_the_loop_finds_the_same_light(
    surface: FullSurface, names: list[str], specular: bool
) -> None:
    hits = hits_of(surface)
    block = Block(np.arange(2 * N // 16 + 1, dtype=np.uint32), 0, 16, 0)
    lights = tuple(LIGHTS[name] for name in names)
    none = np.zeros(3, np.float32)
    stage = plan_direct_light(World(surface, materials(specular), lights, none, None))
    assert stage is not None
    loop = CompiledDirectLight(**same_fields(stage) | {"surface": compiled_surface(surface)})
    results = []
    for each in (stage, loop):
        counters, costs = Counters(), RowOfCosts.of(block.size)
        dimensions = Dimensions([], [("light", max(light.width for light in lights))])
        draws = Draws(SobolSampler(3), dimensions, block, counters, costs=costs)
        radiance = each(hits, hits.ray, 0, draws)
        assert radiance is not None
        results.append(
            (
                radiance,
                counters.rays,
                costs.with_row(np.zeros((3, len(block.pixels)), np.float32), 1),
            )
        )
    (mine, rays, cost), (theirs, same_rays, same_cost) = results
    assert mine.tobytes() == theirs.tobytes()
    assert rays == same_rays
    assert cost.tobytes() == same_cost.tobytes()
    # Some are lit, some turn away or lie in shadow, and some facets turn away below round surfaces that don't.
    assert 0.04 < (mine.max(axis=0) > 0).mean() < 0.95
    assert rays["shadow"] > 500


def test_rays_among_movers_meet_the_same() -> None:
    surface = scene_of("moving")
    passes = surface.accelerator
    loop = compiled_surface(surface).accelerator
    assert isinstance(loop, MovingPackets)
    origin, direction, time = rays_to(surface)
    stats = Counters().embree
    for start in (origin, origin[:, :1]):
        mine, theirs = (each.intersect(start, direction, stats, time) for each in (passes, loop))
        for name in ("triangle", "u", "v", "t"):
            assert getattr(mine, name).tobytes() == getattr(theirs, name).tobytes()
    met = np.unique(mine.triangle)
    hit = [((met >= mover.first) & (met < mover.last)).any() for mover in passes.movers]
    assert hit == [mover.last > mover.first for mover in passes.movers]
    assert sorted(hit) == [False, True, True]
    active = np.random.default_rng(8).random(2 * N) < 0.7
    for limit, some in ((2.5, None), (1e30, active)):
        free = [
            each.unoccluded(origin, direction, limit, stats, time, active=some)
            for each in (passes, loop)
        ]
        assert free[0].tobytes() == free[1].tobytes()
        assert 0.02 < free[0].mean() < 0.98


def test_movers_that_a_students_function_shifts_are_asked_one_after_the_other() -> None:
    surface = scene_of("moving")
    own = Functions(
        displacement=Course.displacement, to_object_space=partial(Course.to_object_space)
    )
    known = same_fields(surface.accelerator) | {"motion": Motion(own)}
    assert type(in_packets(MovingAccelerator(**known))) is MovingAccelerator
