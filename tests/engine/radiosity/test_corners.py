"""Radiosities at corners: those of a plane are the plane's, also at the rim, and steps stay steps."""

import numpy as np
import pytest

from course.engine.radiosity.corners import at_corners
from course.engine.radiosity.patches import Patches
from course.engine.scene.building.cutting import SharedTriangles, bisected
from tests.engine.radiosity.test_patches import square


def uneven(seed: int, tilted: bool) -> SharedTriangles:
    """A square of 3 x 3, halved here and there."""
    rng = np.random.default_rng(seed)
    triangles = square(3)
    for _ in range(4):
        triangles = bisected(triangles, rng.random(triangles.size) < 0.3)
    if tilted:
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        triangles = SharedTriangles(
            triangles.vertices @ turn.T, triangles.corners, triangles.origin
        )
    return triangles


def patches(triangles: SharedTriangles, surface: np.ndarray | None = None) -> Patches:
    grey = np.full((3, triangles.size), 0.5, np.float32)
    if surface is None:
        surface = np.zeros(triangles.size, np.intp)
    return Patches(triangles, grey, np.zeros_like(grey), surface)


def both_sides(front: np.ndarray) -> np.ndarray:
    return np.concatenate((front, np.zeros_like(front)), axis=1).astype(np.float32)


def told(triangles: SharedTriangles) -> np.ndarray:
    """(3, T) which corners have patches enough around them, and neighbours that have.

    A corner of the square that one patch has, or two, knows no more than those say, and its patches tell the others.
    """
    poor = np.bincount(triangles.corners.ravel()) < 3
    touched = np.zeros(len(poor), bool)
    touched[triangles.corners[poor[triangles.corners].any(axis=1)]] = True
    return ~touched[triangles.corners.T]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("tilted", [False, True])
def test_a_plane_is_a_plane_up_to_the_rim(seed: int, tilted: bool) -> None:
    triangles = uneven(seed, tilted)
    p = triangles.vertices[triangles.corners]
    u, v = p[0, 1] - p[0, 0], p[0, 2] - p[0, 0]
    slopes = np.array([[u, v, u + v], [v, -u, u], [u - v, u, v]][seed]) / 2
    constant = np.array([20.0, 30.0, 25.0])
    light = slopes @ p.mean(axis=1).T + constant[:, None]
    found = at_corners(patches(triangles), both_sides(light))
    wanted = np.einsum("cx,tkx->ckt", slopes, p) + constant[:, None, None]
    known = told(triangles)
    assert known.mean() > 0.6
    assert np.abs(found[:, :, : triangles.size] - wanted)[:, known].max() < 1e-3
    assert (found[:, :, triangles.size :] == 0).all()


def test_the_mean_would_not_be() -> None:
    # What the plane mends: at the rim all centres lie on one side.
    triangles = uneven(0, tilted=False)
    p = triangles.vertices[triangles.corners]
    light = np.repeat(p[None, :, :, 0].mean(axis=2), 3, axis=0) + 1
    found = at_corners(patches(triangles), both_sides(light))[0, :, : triangles.size]
    rim = (p[:, :, 0].T == 0) & told(triangles)
    assert rim.any()
    assert np.abs(found[rim] - 1).max() < 1e-3
    assert light[0][rim.any(axis=0)].min() > 1.05


def test_one_patch_is_as_bright_at_its_corners() -> None:
    one = SharedTriangles(np.eye(3), np.array([[0, 1, 2]]), np.zeros(1, np.intp))
    found = at_corners(patches(one), both_sides(np.array([[1.0], [2.0], [3.0]])))
    assert np.allclose(found[:, :, 0], [[1], [2], [3]], rtol=1e-6)


def test_no_light_is_lost_between_the_corners() -> None:
    triangles = uneven(2, tilted=False)
    x, y, _ = triangles.vertices[triangles.corners].mean(axis=1).T
    x, y = x - 1.5, y - 1.5
    light = np.stack((20 + x * x + y * y, 30 - x * x - y * y, 25 + x * x + y * y))
    found = at_corners(patches(triangles), both_sides(light))[:, :, : triangles.size]
    areas = triangles.areas()
    assert np.allclose(found.mean(axis=1) @ areas, light @ areas, rtol=1e-3)


def test_what_changes_abruptly_overshoots_no_more_than_it_changes_and_never_below_nothing() -> None:
    triangles = uneven(1, tilted=False)
    light = np.random.default_rng(2).integers(0, 2, (3, triangles.size)).astype(float)
    found = at_corners(patches(triangles), both_sides(light))[:, :, : triangles.size]
    assert found.min() == 0
    assert 1.2 < found.max() <= 2


def test_surfaces_that_meet_at_an_edge_keep_their_own() -> None:
    triangles = square(2)
    left = triangles.vertices[triangles.corners].mean(axis=1)[:, 0] < 1
    light = np.repeat(np.where(left, 1.0, 5.0)[None], 3, axis=0)
    found = at_corners(patches(triangles, np.where(left, 3, 8)), both_sides(light))
    assert np.allclose(found[:, :, : triangles.size][..., left], 1, rtol=1e-6)
    assert np.allclose(found[:, :, : triangles.size][..., ~left], 5, rtol=1e-6)
