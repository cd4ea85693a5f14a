"""Normals of stretched meshes are interpolated first and transformed then, to the same bits by both kinds of loops."""

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine import shapes
from course.engine.core.accelerator import Intersections
from course.engine.core.hits import Hits
from course.engine.formats.meshes import transforms
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface

Array = NDArray[np.float64]

TURN = transforms.rotate((1.0, 2.0, 3.0), 33.0)
STRETCHES = {
    "even": transforms.scale(0.3),
    "uneven": transforms.scale((0.9, 0.3, 0.1)),
    "uneven and turned": TURN @ transforms.scale((0.9, 0.2, 0.4)),
    "sheared": np.array([[0.5, 0.3, 0, 0], [0, 0.4, 0.2, 0], [0, 0, 0.6, 0], [0, 0, 0, 1.0]]),
    "mirrored": TURN @ transforms.scale((-0.9, 0.2, 0.4)),
    "nearly flat": transforms.scale((0.9, 1e-12, 0.9)),
    "a needle": transforms.scale((1e-12, 0.9, 1e-12)),
}


def hits_of(mesh: Mesh) -> tuple[FullSurface, Hits]:
    """Hits all over a mesh, their normals as they are interpolated, wherever the viewer is."""
    surface = build_surface([FullPart(mesh, 0)], turned=np.zeros(1, np.bool_))
    rng = np.random.default_rng(3)
    n = 5000
    triangle = rng.integers(len(surface.triangles.material), size=n).astype(np.int32)
    barycentrics = rng.dirichlet((1, 1, 1), n)
    # Some lie just at corners.
    barycentrics[:300] = np.tile(np.eye(3), (100, 1))
    u, v = np.ascontiguousarray(barycentrics[:, 1:].T, np.float32)
    # Along the facets' normals, so that all meet the front.
    direction = np.ascontiguousarray(-surface.triangles.planes[triangle, 3:6].T)
    return surface, surface.hits(Intersections(triangle, u, v, u), direction)


def stretched_ball(name: str) -> tuple[Mesh, Mesh, Array]:
    """A coarse ball, the same stretched, and by what matrix normals go from the one to the other."""
    ball = shapes.sphere(1.0, 12)
    image = transforms.apply(ball, STRETCHES[name])
    return ball, image, np.linalg.inv(STRETCHES[name][:3, :3]).T


@pytest.mark.parametrize("name", [name for name in STRETCHES if name != "nearly flat"])
def test_a_stretched_ball_is_shaded_as_an_ellipsoid(name: str) -> None:
    """Whose normals are those of the ball at the same barycentrics, which look along the points, transformed."""
    ball, image, inverse_transpose = stretched_ball(name)
    surface, hits = hits_of(image)
    assert len(surface.triangles.material) == len(ball.triangles)
    corners = ball.vertices[image.triangles[hits.triangle]]
    u, v = hits.u.astype(float)[:, None], hits.v.astype(float)[:, None]
    point = (1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
    normal = inverse_transpose @ point.T
    normal /= np.linalg.norm(normal, axis=0)
    # Near the tip of the needle what float32 keeps of the shortest normals shows.
    assert np.abs(hits.ns - normal).max() < (1e-5 if name == "a needle" else 1e-6)


@pytest.mark.parametrize("name", STRETCHES)
def test_shading_normals_of_stretched_meshes_are_unit(name: str) -> None:
    _, hits = hits_of(stretched_ball(name)[1])
    assert np.abs(np.linalg.norm(hits.ns.astype(float), axis=0) - 1).max() < 1e-6


def test_lengths_of_normals_are_the_same_for_the_round_surface_above_the_facets() -> None:
    """Where shadow rays start, and which lights may be seen, the directions of normals count alone."""
    _, image, _ = stretched_ball("uneven")
    assert image.normals is not None
    unit = image.normals / np.linalg.norm(image.normals, axis=1, keepdims=True)
    by_direction = build_surface(
        [FullPart(Mesh(image.vertices, image.triangles, unit), 0)]
    ).triangles
    surface = build_surface([FullPart(image, 0)]).triangles
    assert surface.bulge is not None
    assert by_direction.bulge is not None
    np.testing.assert_allclose(surface.bulge, by_direction.bulge, rtol=1e-5, atol=1e-9)
    assert surface.largest_sine == pytest.approx(by_direction.largest_sine, rel=1e-12)


def test_a_box_has_the_same_tables_however_it_is_stretched() -> None:
    """Facets whose normals agree are as flat as they were."""
    stretched = transforms.apply(shapes.box((1, 1, 1)), transforms.scale((0.9, 0.3, 0.1)))
    made = shapes.box((0.9, 0.3, 0.1))
    one, other = (
        build_surface([FullPart(mesh, 0)]).triangles.corner_normals for mesh in (stretched, made)
    )
    assert one is not None
    assert other is not None
    rows, wanted = (np.unique(table, axis=0) for table in (one + 0.0, other + 0.0))
    np.testing.assert_array_equal(rows, wanted)
