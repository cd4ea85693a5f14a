"""A ray asks the movers whose swept boxes it meets, and finds what it finds when it asks all."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pytest

from course.engine import shapes
from course.engine.core.accelerator import QueryStats, StaticAccelerator
from course.engine.core.motion import Motion, MovingAccelerator
from course.engine.core.types import Functions
from course.engine.shapes.mesh import Mesh
from course.engine.terms.plan import same_fields
from course.engine.terms.surfaces.boxes import box_tree
from course.engine.terms.surfaces.surface import FullPart, build_surface
from course.engine.terms.surfaces.swept_movers import SweptMovers
from solutions import motion_blur
from tests.lengths import fewer

N = 4000
FUNCTIONS = Functions(**vars(motion_blur))


def balls(count: int, speed: float = 0.1) -> SweptMovers:
    """A floor, and balls in a square above it, each with a velocity of its own."""
    rng = np.random.default_rng(2)
    side = int(count**0.5)
    ball = shapes.sphere(0.6 / side, 8)
    floor = shapes.quad(2, 2)
    parts = [FullPart(Mesh(floor.vertices, floor.triangles), 0)]
    for number in range(count):
        x, z = (2 * (i + 0.5) / side - 1 for i in divmod(number, side))
        velocity = rng.normal(size=3) * speed / side
        mesh = Mesh(ball.vertices + np.array((x, 0.3, z)), ball.triangles)
        parts.append(FullPart(mesh, 0, tuple(velocity.tolist())))
    accelerator = build_surface(parts, FUNCTIONS).accelerator
    assert isinstance(accelerator, SweptMovers)
    assert len(accelerator.movers) == count
    return accelerator


def rays(distance: float = 2.0) -> tuple[Any, Any, Any]:
    """Origins, directions and times. Some rays are parallel to axes, and some start among the balls."""
    rng = np.random.default_rng(3)
    target = rng.uniform((-1, 0, -1), (1, 0.5, 1), (N, 3)).T
    origin = rng.normal(size=(3, N))
    origin *= distance / np.linalg.norm(origin, axis=0)
    origin[:, ::5] = rng.uniform((-1, 0.1, -1), (1, 0.5, 1), (N // 5, 3)).T
    direction = target - origin
    direction[:2, ::7], direction[0, ::3] = 0, -0.0
    origin[:2, ::7], origin[0, ::3] = target[:2, ::7], target[0, ::3]
    direction /= np.linalg.norm(direction, axis=0)
    return origin.astype(np.float32), direction.astype(np.float32), rng.random(N, np.float32)


@fewer
@pytest.mark.parametrize("speed", [0.01, 0.5, 5.0])
@pytest.mark.parametrize("count", [1, 4, 64])
@pytest.mark.parametrize("distance", [2.0, 300.0])
def test_it_finds_what_asking_all_finds(count: int, speed: float, distance: float) -> None:
    swept = balls(count, speed)
    everyone = MovingAccelerator(**same_fields(swept))
    origin, direction, time = rays(distance)
    stats = QueryStats()
    for start in (origin, origin[:, :1]):
        mine, theirs = (each.intersect(start, direction, stats, time) for each in (swept, everyone))
        for name in ("triangle", "u", "v", "t"):
            assert getattr(mine, name).tobytes() == getattr(theirs, name).tobytes()
    hit = mine.triangle >= swept.movers[0].first
    assert hit.any()
    active = np.random.default_rng(8).random(N) < 0.7
    for limit, some in ((0.5, None), (1e30, active)):
        mine, theirs = (
            each.unoccluded(origin, direction, limit, stats, time, active=some)
            for each in (swept, everyone)
        )
        chosen = slice(None) if some is None else some
        assert (mine[chosen] == theirs[chosen]).all()
        assert 0 < np.count_nonzero(mine[chosen]) < N


def asked(accelerator: MovingAccelerator, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Rays that movers are asked by a query of either kind of N rays."""
    counts = []
    movers = [mover.accelerator for mover in accelerator.movers]
    for query in ("intersect", "unoccluded"):
        total, original = [0], getattr(StaticAccelerator, query)

        def noted(
            self: Any,
            origin: Any,
            *rest: Any,
            total: Any = total,
            original: Any = original,
            **more: Any,
        ) -> Any:
            total[0] += origin.shape[1] if self in movers else 0
            return original(self, origin, *rest, **more)

        monkeypatch.setattr(StaticAccelerator, query, noted)
        origin, direction, time = rays()
        limit = () if query == "intersect" else (1e30,)
        getattr(accelerator, query)(origin, direction, *limit, QueryStats(), time)
        counts.append(total[0])
    return counts


def test_many_movers_are_asked_by_few_rays(monkeypatch: pytest.MonkeyPatch) -> None:
    # Sixty-four movers that lie apart, in the square of four: a ray meets few of them however many there are.
    four, many = (sum(asked(balls(count), monkeypatch)) for count in (4, 64))
    assert 0 < many < 3 * four
    assert many < 2 * N * 64 / 20


def test_a_students_motion_is_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    # No box is known for what a student's function moves, here backwards, so all are asked.
    swept = balls(4)
    backwards = Functions(
        to_object_space=lambda origins, velocity, time: origins + velocity[:, None] * time
    )
    parts = [FullPart(shapes.sphere(0.2, 8), 0, (1.0, 0.0, 0.0))]
    assert type(build_surface(parts, backwards).accelerator) is MovingAccelerator
    own = Functions(to_object_space=partial(motion_blur.to_object_space))
    assert type(build_surface(parts, own).accelerator) is MovingAccelerator
    everyone = MovingAccelerator(swept.static, swept.movers, Motion(own))
    counts = asked(everyone, monkeypatch)
    assert counts[0] == 4 * N


def test_a_tree_knows_each_box_of_a_ray() -> None:
    rng = np.random.default_rng(4)
    low = rng.random((50, 3), np.float32) * 4
    boxes = np.stack((low, low + rng.random((50, 3), np.float32) + 0.1), axis=1)
    origin, target = rng.uniform(-1, 6, (2, 3, N)).astype(np.float32)
    limit = rng.uniform(0.2, 2, N).astype(np.float32)
    which = np.flatnonzero(rng.random(N) < 0.6)
    met = box_tree(boxes).met(origin, target - origin, limit, which)
    # By points along the rays, in float64: whoever has one inside a box meets it.
    along = np.linspace(0, 1, 200)[:, None] * limit
    points = origin[:, None] + along * (target - origin)[:, None].astype(np.float64)
    for number, (least, most) in enumerate(boxes.astype(np.float64)):
        inside = (points >= least[:, None, None]) & (points <= most[:, None, None])
        certain = np.intersect1d(np.flatnonzero(inside.all(axis=0).any(axis=0)), which)
        found = met.get(number, np.empty(0, np.int64))
        assert np.isin(certain, found).all()
        assert np.isin(found, which).all()
        # And few others, which touch it between two points.
        assert len(found) <= len(certain) + N / 50


def test_a_component_next_to_0_is_as_good_as_0() -> None:
    boxes = np.array([[[-1, -1, -1], [1, 1, 1]]], np.float32)
    origin = np.array([[-3, -3], [0, 2], [0, 0]], np.float32)
    way = np.array([[1, 1], [0, 0], [1e-45, 1e-45]], np.float32)
    met = box_tree(boxes).met(origin, way, np.full(2, np.inf, np.float32), np.arange(2))
    assert {box: found.tolist() for box, found in met.items()} == {0: [0]}
