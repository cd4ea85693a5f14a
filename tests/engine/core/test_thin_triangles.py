"""Rays at long thin triangles: none meets the one that it leaves, and things beside them look as closed forms say.

Needles have one short edge, caps a corner over their longest edge. In a needle the normal is as good as elsewhere; in a
cap it is turned, and rays leave it from further above (``course.engine.core.ray_offset.LONG``).
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.casters.batches import BatchCaster
from course.engine.core.embree import EmbreeCaster
from course.engine.formats.meshes import transforms
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart, build_surface
from tests.lengths import fewer

Array = NDArray[np.float64]


def compiled(vertices: Any, triangles: Any) -> Any:
    # Its loops are compiled when it is imported, which no process of a run must do to collect its tests.
    from course.engine.casters.compiled import CompiledCaster

    return CompiledCaster(vertices, triangles)


CASTERS: dict[str, Callable[..., Any]] = {
    "embree": EmbreeCaster,
    "numba": compiled,
    "numpy": BatchCaster,
}
RATIOS = (10.0, 100.0, 1e3, 1e4)


def corners(kind: str, ratio: float, rng: np.random.Generator) -> Array:
    """A triangle 2 long and 2 / ratio high, its corners in any order."""
    high = 2 / ratio
    third = {
        "half a plank": (1, high),
        "needle": (1 + high / 2, high),
        "cap": (rng.uniform(-0.8, 0.8), high),
        "slanted": (1 - 20 * high, high),
    }[kind]
    first = [[-1.0, 0, 0], [1, 0, 0], [*third, 0]]
    return rng.permutation(np.array(first))


def turns(rng: np.random.Generator) -> Array:
    """A random rotation (3, 3)."""
    axis = rng.normal(size=3)
    return np.asarray(transforms.rotate(axis, rng.uniform(0, 360))[:3, :3])


def unit(d: Array) -> Array:
    return np.asarray(d / np.linalg.norm(d, axis=0))


def leaving(n: Array, along: Array, count: int, rng: np.random.Generator) -> Array:
    """Directions (3, count) above a plane: a third all over, the others grazing it, half of them along a triangle."""
    d = unit(rng.normal(size=(3, count)))
    d *= np.sign(n @ d)
    grazing = d[:, count // 3 :]
    grazing -= n[:, None] * (n @ grazing)
    long = grazing[:, ::2]
    long += along[:, None] * 10 ** rng.uniform(0, 4, long.shape[1])
    d[:, count // 3 :] = unit(grazing) + n[:, None] * 10 ** rng.uniform(-6, 0, grazing.shape[1])
    return unit(d)


def own_hits(kind: str, ratio: float, far: bool, caster: str) -> tuple[int, int]:
    """How many rays meet the triangle that they leave, on either side, and of how many."""
    rng, again, rays, count = np.random.default_rng(3), 0, 0, 1500
    for _ in range(16):
        p = corners(kind, ratio, rng) @ turns(rng).T
        if far:
            p = 0.05 * p + (0.9, -0.7, 0.8)
        mesh = Mesh(p, np.array([[0, 1, 2]]))
        triangles = build_surface([FullPart(mesh, 0)]).triangles
        plane, edges = triangles.planes[0], triangles.edges[0]
        u, v = rng.dirichlet((1, 1, 1), count).T[:2].astype(np.float32)
        point = plane[:3, None] + edges[:3, None] * u + edges[3:6, None] * v
        made = CASTERS[caster](p.astype(np.float32), np.array([[0, 1, 2]], np.int32))
        for side in (np.float32(1), np.float32(-1)):
            n = plane[3:6].astype(float) * side
            d = leaving(n, unit(edges[:3].astype(float)), count, rng).astype(np.float32)
            # Rounded to float32, a grazing direction may point below the triangle, which it then rightly meets.
            fair = n @ d > 3e-7
            origin = (point + (plane[3:6] * side * plane[6])[:, None]).astype(np.float32)
            again += int((~made.free(origin, d, 1e30) & fair).sum())
            rays += int(fair.sum())
    return again, rays


@fewer
@pytest.mark.parametrize("caster", CASTERS)
@pytest.mark.parametrize("far", [False, True], ids=["in the middle", "far out"])
@pytest.mark.parametrize("kind", ["half a plank", "needle", "cap", "slanted"])
def test_no_ray_meets_the_thin_triangle_that_it_leaves(kind: str, far: bool, caster: str) -> None:
    for ratio in RATIOS:
        again, rays = own_hits(kind, ratio, far, caster)
        assert rays > 40000
        assert again == 0


@pytest.mark.parametrize("caster", CASTERS)
@pytest.mark.parametrize("kind", ["half a plank", "needle"])
def test_the_distance_of_a_needle_is_as_exact_as_another_triangles(kind: str, caster: str) -> None:
    """By the product of its long edges it would err by 2^-24 L^2 / H, here by up to 2e-3."""
    rng, count = np.random.default_rng(5), 500
    for _ in range(10):
        p = (corners(kind, 1e4, rng) @ turns(rng).T).astype(np.float32)
        exact = p.astype(np.float64)
        normal = unit(np.cross(exact[1] - exact[0], exact[2] - exact[0]))
        away = unit(rng.normal(size=(3, count)))
        away *= np.sign(normal @ away)
        steep = away[:, normal @ away > 0.2]
        target = (rng.dirichlet((1, 1, 1), steep.shape[1]) @ exact).T
        origin = (target + 0.1 * steep).astype(np.float32)
        d = unit(target - origin).astype(np.float32)
        made = CASTERS[caster](p, np.array([[0, 1, 2]], np.int32))
        found = made.nearest(origin, d, np.full(d.shape[1], 1e30, np.float32))
        hit = found.triangle == 0
        assert hit.mean() > 0.8
        height = normal @ (origin.astype(np.float64) - exact[:1].T)
        error = np.abs(found.t * (normal @ d.astype(np.float64)) + height)
        assert (error[hit] < 32 * 2.0**-24).all()
