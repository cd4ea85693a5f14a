"""All that may answer rays has one interface: mypy compares the types, and here are names, places and answers."""

import inspect
from typing import Any

import numpy as np
import pytest

from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import Accelerator, QueryStats, StaticAccelerator
from course.engine.core.motion import Motion, MovingAccelerator
from course.engine.core.types import Functions
from course.engine.terms.surfaces.hierarchy import HierarchyAccelerator
from course.engine.terms.surfaces.swept_movers import SweptMovers
from solutions import bounding_volumes, motion_blur

KINDS = (StaticAccelerator, MovingAccelerator, SweptMovers, HierarchyAccelerator)
QUERIES = ("intersect", "unoccluded")

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
TRIANGLES = np.array([[0, 1, 2]], np.int32)


def made(kind: type) -> Accelerator:
    """One triangle that stands still in z = 0."""
    if kind is HierarchyAccelerator:
        return HierarchyAccelerator(VERTICES, TRIANGLES, Functions(**vars(bounding_volumes)), 4)
    still = static_accelerator(VERTICES, TRIANGLES)
    if kind in (MovingAccelerator, SweptMovers):
        return kind(still, (), Motion(Functions(**vars(motion_blur))))
    return still


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("query", QUERIES)
def test_queries_take_what_the_interface_says(kind: type, query: str) -> None:
    wanted = inspect.signature(getattr(Accelerator, query)).parameters
    has = inspect.signature(getattr(kind, query)).parameters
    by_place = [name for name, each in wanted.items() if each.kind is not each.KEYWORD_ONLY]
    assert list(has)[: len(by_place)] == by_place
    for name in wanted.keys() - set(by_place):
        assert has[name].default == wanted[name].default


@pytest.mark.parametrize("kind", KINDS)
def test_who_knows_the_interface_alone_gets_the_same_answers(kind: type) -> None:
    accelerator: Any = made(kind)
    # The second one passes the triangle by.
    origin = np.array([[0.25, 0.9], [0.25, 0.9], [2, 2]], np.float32)
    direction = np.repeat(np.array([[0], [0], [-1]], np.float32), 2, axis=1)
    time = np.zeros(2, np.float32)
    stats = QueryStats()
    found = accelerator.intersect(origin, direction, stats, time)
    assert found.triangle.tolist() == [0, -1]
    np.testing.assert_allclose([found.t[0], found.u[0], found.v[0]], [2, 0.25, 0.25], rtol=1e-6)
    assert accelerator.unoccluded(origin, direction, 3.0, stats, time).tolist() == [False, True]
    assert accelerator.unoccluded(origin, direction, 1.5, stats, time).tolist() == [True, True]


@pytest.mark.parametrize("kind", KINDS)
def test_rays_whose_answers_do_not_matter_change_no_other(kind: type) -> None:
    accelerator: Any = made(kind)
    rng = np.random.default_rng(3)
    origin = np.concatenate((rng.random((2, 300)), np.full((1, 300), 2))).astype(np.float32)
    direction = np.repeat(np.array([[0], [0], [-1]], np.float32), 300, axis=1)
    time, active = rng.random(300, np.float32), rng.random(300) < 0.6
    stats = QueryStats()
    free = accelerator.unoccluded(origin, direction, 3.0, stats, time)
    some = accelerator.unoccluded(origin, direction, 3.0, stats, time, active=active)
    assert 50 < free.sum() < 250
    assert (some.shape, some.dtype) == (free.shape, free.dtype)
    assert (some == free)[active].all()
    # One origin for all rays, none of which is active.
    assert accelerator.unoccluded(
        origin[:, :1], direction, 3.0, stats, time, active=active & False
    ).shape == (300,)
