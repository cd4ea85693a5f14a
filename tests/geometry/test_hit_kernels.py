"""Compiled loops over hits give what the passes over arrays give, bit for bit."""

from typing import Any

import numpy as np
import pytest

from course import shapes
from course.compiled import library
from course.core.accelerator import Intersections
from course.core.hits import Hits
from course.core.materials import Lookup
from course.extras.scatter import FullScatter
from course.extras.surface import FullPart, FullSurface, build_surface
from course.formats.meshes import transforms
from course.shapes.mesh import Mesh

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled.scatter import CompiledScatter
from course.compiled.stages import compiled_surface

PLACES = ("p", "ng", "ns", "offset", "near_origin", "side", "u", "v", "t", "triangle", "material")
TURN = transforms.rotate(np.array([1.0, 2.0, 3.0]), 33.0)
BOX = transforms.apply(shapes.box((1.2, 1, 0.5)), TURN)
MESHES = {
    # Few and large facets: normals at the corners are far from those of the facets.
    "coarse sphere": shapes.sphere(0.9, 12),
    "box": BOX,
    "box without normals": Mesh(BOX.vertices, BOX.triangles),
    "cone of slivers": transforms.apply(shapes.cone(0.5, 1, 1024), TURN),
}


def met(mesh: Mesh, share: float, bends: bool = True) -> tuple[FullSurface, Intersections, Any]:
    """A surface, hits of a share of the rays, and directions; a third of the points lie at edges or corners."""
    surface = build_surface([FullPart(mesh, 3)], turned=None if bends else np.zeros(4, np.bool_))
    n = 4800
    rng = np.random.default_rng(3)
    triangle = rng.integers(len(surface.triangles.material), size=n).astype(np.int32)
    triangle[rng.random(n) >= share] = -1
    w, u, v = rng.dirichlet((1, 1, 1), n).T
    for number, kept in enumerate(((v, w), (u, w), (u, v))):
        there = slice(number * n // 12, (number + 1) * n // 12)
        total = kept[0][there] + kept[1][there]
        u[there], v[there] = u[there] / total, v[there] / total
        (u, v, w)[number][there] = 1e-7 * rng.random(n // 12)
    direction = rng.normal(size=(3, n))
    direction /= np.linalg.norm(direction, axis=0)
    u, v, t = (x.astype(np.float32) for x in (u, v, rng.random(n)))
    return surface, Intersections(triangle, u, v, t), direction.astype(np.float32)


def both(surface: FullSurface, found: Intersections, direction: Any) -> tuple[Hits, Hits]:
    return surface.hits(found, direction), compiled_surface(surface).hits(found, direction)


@pytest.mark.parametrize("bends", [True, False])
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("name", MESHES)
def test_places_and_normals(name: str, share: float, bends: bool) -> None:
    surface, found, direction = met(MESHES[name], share, bends)
    passes, loop = both(surface, found, direction)
    assert passes.size == loop.size == np.count_nonzero(found.triangle >= 0)
    for attribute in PLACES:
        mine, theirs = getattr(passes, attribute), getattr(loop, attribute)
        assert (mine.shape, mine.dtype) == (theirs.shape, theirs.dtype), attribute
        assert mine.tobytes() == theirs.tobytes(), attribute
    assert (loop.ns is loop.ng) == (passes.ns is passes.ng) == (name == "box without normals")
    if share == 1:
        # Some points were pulled off edges, and some normals turned to the viewer.
        p0 = surface.triangles.planes[loop.triangle, :3].T
        e1, e2 = surface.triangles.edges[loop.triangle, :6].T.reshape(2, 3, -1)
        assert (np.abs(p0 + e1 * loop.u + e2 * loop.v - loop.p).max(axis=0) > 1e-6).sum() > 500
        if name == "coarse sphere":
            away = (loop.ns * direction).sum(axis=0)
            assert ((np.abs(away) < 1e-6).sum() > 50) == bends
            assert ((away > 1e-3).sum() > 50) == (not bends)


@pytest.mark.parametrize("name", MESHES)
def test_only_round_triangles_have_normals_to_interpolate(name: str) -> None:
    """A cone has both: its base is flat, its side isn't."""
    surface, found, direction = met(MESHES[name], 1.0, bends=False)
    flat = surface.triangles.planes[:, 7] > 0
    share = {"coarse sphere": 0.0, "box": 1.0, "box without normals": 1.0}.get(name, 0.5)
    assert abs(flat.mean() - share) < 0.03
    for hits in both(surface, found, direction):
        same = (hits.ns == hits.ng).all(axis=0)
        assert np.array_equal(same, flat[hits.triangle])


@pytest.mark.parametrize("name", MESHES)
def test_mirrored_directions(name: str) -> None:
    surface, found, direction = met(MESHES[name], 1.0)
    passes, loop = both(surface, found, direction)
    mirror = Lookup(np.ones((3, 4), np.float32))
    one, other = (
        kind(surface, mirror, None, None, False, None, 0)._mirror_images
        for kind in (FullScatter, CompiledScatter)
    )
    for which in (np.arange(passes.size), np.arange(0, passes.size, 3), np.arange(0)):
        ng = passes.ng.take(which, axis=1)
        mine, theirs = one(passes, which, ng), other(loop, which, ng)
        assert mine.tobytes() == theirs.tobytes()
    if name == "coarse sphere":
        ns, d = passes.ns.astype(float), passes.direction.astype(float)
        into = ((d - 2 * (d * ns).sum(axis=0) * ns) * passes.ng).sum(axis=0) < 0
        assert into.sum() > 50
    way = other(loop, np.arange(loop.size), loop.ng)
    assert ((way * loop.ng).sum(axis=0) > -1e-6).all()


def test_a_mover_carries_its_points(tmp_path: Any) -> None:
    """Points are moved after they were found, and rays leave from there."""
    from course import load_scene, render

    path = tmp_path / "scene.yaml"
    path.write_text(
        """\
camera: {eye: [0, 1, 4], look_at: [0, 0, 0], shutter: {open: 0, close: 1}}
film: {width: 24, height: 16}
sampler: {samples: 16}
materials: {grey: {mirror: 0.3}}
lights: [{type: point, position: [0, 3, 3], intensity: 20}]
objects:
  - {shape: quad, material: grey, width: 6, depth: 6, transform: [{translate: [0, -0.5, 0]}]}
  - {shape: sphere, radius: 0.5, segments: 24, material: grey, motion: {velocity: [1.5, 0, 0]}}
""",
        encoding="utf-8",
    )
    scene = load_scene(path)
    pictures = [render(scene, compiled=compiled).linear for compiled in (False, True)]
    assert pictures[0].std() > 0.01
    assert pictures[0].tobytes() == pictures[1].tobytes()
