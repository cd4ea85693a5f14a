"""The loop over packets of hits finds the light that the passes over arrays find, bit for bit."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from course import shapes
from course.adaptive.costs import RowOfCosts
from course.compiled import library
from course.core.counters import Counters
from course.core.direct import direct_light
from course.core.hits import Hits
from course.core.lights import DirectionalLight, Light, PointLight, RectangleLight, SphereLight
from course.core.materials import MaterialTable
from course.core.rays import Dimensions, Draws
from course.core.samplers import Block
from course.effects import Effects
from course.extras.plan import same_fields
from course.extras.samplers.sobol import SobolSampler
from course.extras.surface import FullPart, FullSurface, build_surface

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled.direct import CompiledDirectLight
from course.compiled.stages import compiled_surface

N = 5000
WHITE = np.array([0.9, 0.7, 0.4], np.float32)
FUNCTIONS: Any = Effects().function


class Course:
    """Functions of soft_shadows."""

    point_on_sphere = staticmethod(FUNCTIONS("soft_shadows", "point_on_sphere"))
    point_in_ball = staticmethod(FUNCTIONS("soft_shadows", "point_in_ball"))
    point_on_facing_disk = staticmethod(FUNCTIONS("soft_shadows", "point_on_facing_disk"))
    point_on_rectangle = staticmethod(FUNCTIONS("soft_shadows", "point_on_rectangle"))


def vector(*values: float) -> Any:
    return np.array(values, np.float32)


FUNCTIONS_OF: Any = Course
ABOVE, DOWN = vector(0.2, 0.9, 0.3), vector(0, -1, 0)
SQUARE = vector(-0.4, 0.8, -0.4), vector(0.8, 0, 0), vector(0, 0, 0.8)
LIGHTS: dict[str, Light] = {
    "point": PointLight("light", ABOVE, WHITE),
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


@pytest.fixture(scope="module")
def surface() -> FullSurface:
    """A coarse ball over a floor, of two materials and three."""
    floor = shapes.quad(1.8, 1.8)
    floor = replace(floor, vertices=floor.vertices - vector(0, 0.7, 0))
    return build_surface([FullPart(floor, 1), FullPart(shapes.sphere(0.6, 10), 3)])


def hits_of(surface: FullSurface) -> Hits:
    rng = np.random.default_rng(5)
    origin = rng.normal(size=(3, 2 * N))
    origin[1] = np.abs(origin[1]) * 0.7
    origin *= 2.5 / np.linalg.norm(origin, axis=0)
    direction = rng.uniform(-0.6, 0.6, (3, 2 * N)) - origin
    direction /= np.linalg.norm(direction, axis=0)
    origin, direction = origin.astype(np.float32), direction.astype(np.float32)
    found = surface.accelerator.intersect(origin, direction, Counters().embree)
    return surface.hits(found, direction)


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
    stage = direct_light(surface, lights, None, materials(specular))
    loop = CompiledDirectLight(**same_fields(stage) | {"surface": compiled_surface(surface)})
    results = []
    for each in (stage, loop):
        counters, costs = Counters(), RowOfCosts.of(block.size)
        dimensions = Dimensions([], [("light", max(light.width for light in lights))])
        draws = Draws(SobolSampler(3), dimensions, block, counters, costs=costs)
        radiance = each(hits, hits.ray, 1, draws)
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
