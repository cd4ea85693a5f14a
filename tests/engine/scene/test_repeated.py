"""A lamp whose triangles stand more than once shines once from each place."""

import math
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest

from course import load_scene, render
from course.base.errors import CourseWarning
from course.engine.scene.building.repeated import repeated

SCENE = """
camera: {eye: [3, 3, 0], look_at: [0, 0, 0], vertical_fov: 1}
film: {width: 4, height: 4}
materials:
  floor: {color: 0.5}
  lamp: {color: 0, emission: 1}
lights: [{type: object, object: lamp}]
objects:
  - {shape: quad, width: 20, depth: 20, material: floor}
  - {shape: mesh, file: lamp.obj, name: lamp, material: lamp}
"""
HALF, HEIGHT = 0.5, 1.0


def lamp(times: int) -> str:
    """A square above the origin; its two triangles as often, beginning at other corners and facing both ways."""
    corners = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)]
    lines = [f"v {x} {HEIGHT} {z}" for x, z in corners]
    halves = (1, 2, 3), (1, 3, 4), (2, 3, 4), (2, 4, 1)
    orders = [[*permutations(half)] for half in halves]
    # By turns cut along one diagonal and along the other.
    faces = [orders[k + 2 * (n % 2)][n % 6] for n in range(times) for k in (0, 1)]
    return "\n".join(lines + [f"f {a} {b} {c}" for a, b, c in faces]) + "\n"


def seen() -> float:
    """Radiance of the floor at the origin: its colour times the share of its sky, weighted by cosines, that is lamp."""
    x = HALF / HEIGHT
    root = math.sqrt(1 + x * x)
    return 0.5 * 4 / (2 * math.pi) * 2 * x / root * math.atan(x / root)


@pytest.mark.parametrize("times", [1, 2, 50])
def test_each_place_shines_once(times: int, tmp_path: Path) -> None:
    (tmp_path / "lamp.obj").write_text(lamp(times), encoding="utf-8")
    (tmp_path / "a.yaml").write_text(SCENE, encoding="utf-8")
    if times == 1:
        scene = load_scene(tmp_path / "a.yaml", "solutions")
    else:
        with pytest.warns(CourseWarning) as told:
            scene = load_scene(tmp_path / "a.yaml", "solutions")
        assert any("each place shines once" in str(one.message) for one in told)
    picture = render(scene, spp=1024).linear
    assert picture.mean() == pytest.approx(seen(), rel=5e-3)


def test_triangles_in_any_order_are_found_and_no_others() -> None:
    rng = np.random.default_rng(5)
    base = rng.uniform(-1, 1, (1000, 3, 3))
    # Beside each its mirror image in one of its sides: it shares two corners.
    mirrored = base.copy()
    mirrored[:, 0] = base[:, 1] + base[:, 2] - base[:, 0]
    again = np.array([p[rng.permutation(3)] for p in base[:300]])
    corners = np.concatenate((base, mirrored, again)).astype(np.float32)
    planes, edges = np.zeros((2, len(corners), 8), np.float32)
    planes[:, :3] = corners[:, 0]
    edges[:, :3], edges[:, 3:6] = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    found = repeated(planes, edges)
    assert not found[:2000].any()
    # Of a large lamp: of two whose middles are rounded to different sides of a cell's border one is missed.
    assert found[2000:].mean() > 0.97
