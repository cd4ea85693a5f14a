"""``traverse`` declared: the way of a ray through a hierarchy of boxes.

Hierarchies are made here, so that it pays for no mistake of ``build``. What it finds is judged in double precision: a
triangle that is named has to be hit where it is said, and no other may clearly be hit before it. So ties, and rays
through edges, may go either way.
"""

from typing import Any

import numpy as np

from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import QueryStats
from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import Arguments, Case, Function, Law, Made, function
from course.school.grading.checks.examples import example, where
from course.school.grading.checks.laws import close, holds, law
from course.school.grading.modules import ray_scenes
from course.school.grading.modules.hierarchies import (
    balanced,
    boxes_around,
    exact_hit,
    nearest_triangle,
    one_leaf,
)

EDGE = 1e-3
"""Barycentric distance from an edge within which a hit may be missed."""

GRAZING = 0.02
"""Cosine of directions so flat that a hit may be missed."""


def _found(a: Arguments, r: Any) -> tuple[Array, Array]:
    """Triangles and t, which are there together or not at all. Raises Failure."""
    triangle, t = r[0].astype(np.int64), r[1]
    triangles = a.p0.shape[1]
    if triangle.size and (triangle.min() < -1 or triangle.max() >= triangles):
        came = f"{triangle.min()} to {triangle.max()}"
        raise Failure(f"triangles from -1 to {triangles - 1}", came)
    wrong = np.isnan(t) | (np.isposinf(t) != (triangle < 0))
    if wrong.any():
        k = int(np.argmax(wrong))
        raise Failure(
            "t infinite where triangle is -1, and only there",
            f"triangle {triangle[k]}, t = {t[k]:g}",
            where(a, (k,), t.shape),
            "A ray that hits nothing has no triangle and no t.",
        )
    return triangle, t


def _nearest(a: Arguments, r: Any, expected: Array | None = None) -> None:
    """Each triangle named is hit at its t, and none of those expected, the nearest, is clearly hit before it."""
    triangle, t = _found(a, r)
    p, o, d = (a.p0, a.p1, a.p2), a.origins, a.directions
    if expected is None:
        expected = nearest_triangle(p, o, d)
    reach = max(np.abs(part).max(initial=0) for part in (*p, o))
    own_t, own_least, own_cosine = exact_hit([c[:, triangle] for c in p], o, d)
    named = triangle >= 0
    slack = 1e-4 * reach / np.maximum(own_cosine, GRAZING)
    with np.errstate(invalid="ignore"):
        off = (own_least < -EDGE) | (own_t < -slack) | ~(np.abs(own_t - t) <= slack)
    if (named & off).any():
        k = int(np.argmax(named & off))
        raise Failure(
            "a triangle that is hit, at its t",
            f"triangle {triangle[k]} at t = {t[k]:.6g}, whose plane is met at {own_t[k]:.6g}"
            + (", outside it" if own_least[k] < -EDGE else ""),
            where(a, (k,), t.shape),
            "Either side, only in front of the origin, only within the triangle.",
        )
    true_t, least, cosine = exact_hit([c[:, expected] for c in p], o, d)
    clear = (expected >= 0) & (least > EDGE) & (cosine > GRAZING)
    with np.errstate(invalid="ignore"):
        wrong = clear & ~(named & (own_t <= true_t + slack + 1e-4 * reach / GRAZING))
    if wrong.any():
        k = int(np.argmax(wrong))
        raise Failure(
            f"triangle {expected[k]} at t = {true_t[k]:.6g}",
            f"triangle {triangle[k]} at {t[k]:.6g}" if named[k] else "nothing",
            where(a, (k,), t.shape),
            "The nearest of all: a leaf that is visited later may hold something nearer.",
        )


def _hit_or_not(a: Arguments, r: Any) -> tuple[Any, ...]:
    _, t = _found(a, r)
    exact_t, least, _ = exact_hit((a.p0, a.p1, a.p2), a.origins, a.directions)
    reach = np.abs(a.origins).max(initial=0) + np.abs(a.p0).max() + np.abs(a.p1 - a.p0).max()
    return t, np.where((least > 0) & (exact_t > 0), exact_t, np.inf), 2 * reach


FEW = 6.0
"""Triangles a ray, where the first of the layers ends it; without order it is 64 from one side at least."""


def _few_from_both_sides(a: Arguments, r: Any) -> None:
    _nearest(a, r)
    up = a.directions[2] > 0
    for way, tests in (("upwards", r[3][up]), ("downwards", r[3][~up])):
        if tests.size and not tests.mean() <= FEW:
            raise Failure(
                f"at most {FEW:g} triangles tested a ray",
                f"{tests.mean():.3g}",
                f"{ray_scenes.LAYERS} layers, one a leaf, rays {way}",
                "The nearer child first; and what begins beyond the nearest hit so far needs no visit.",
            )


def _counted(a: Arguments, r: Any) -> Any:
    """Whether tests are those of leaves that rays meet or miss as a whole; the root's box may be left out."""
    if a.hierarchy[3].size > 3:
        return _counted_without_hits(a, r)
    two, x = a.hierarchy[3].size > 1, np.abs(a.origins[0])
    triangles = np.where(x == 300, 0, np.where(x == 10, 20, 0) if two else 40)
    least = np.where(x < 300, 2, 0) if two else 0 * x
    return (r[3] == triangles) & (r[2] >= least) & (r[2] <= least + 1)


def _counted_without_hits(a: Arguments, r: Any) -> Any:
    """The same where rays hit nothing, so that no order and no skipping makes a difference."""
    _, _, first, count, _ = a.hierarchy
    near, far = ray_scenes.crossed(a.hierarchy, a.origins, a.directions)
    met, inner = near <= far, count == 0
    # Children come after their parents in no order that is known: down from the root, level by level.
    reached, level = np.zeros_like(met), np.array([0])
    reached[0] = met[0]
    while (level := level[inner[level]]).size:
        for child in (first[level], first[level] + 1):
            reached[child] = met[child] & reached[level]
        level = np.concatenate((first[level], first[level] + 1))
    boxes = 2 * reached[inner].sum(axis=0)
    triangles = (count[:, None] * reached).sum(axis=0)
    return (r[3] == triangles) & (r[2] >= boxes) & (r[2] <= boxes + 1)


LEVELS, MOST = 14, 256
"""Tests a ray, of boxes and triangles: a 256th of all triangles, and nine times what a right function needs."""


def _embree(function: Function, trial: Trial) -> None:
    o, d = ray_scenes.camera(trial.rng)
    # Few triangles first: who tests all of them would need minutes for the others.
    for segments, sides, levels, step in ((32, 32, 9, 20), (256, 128, LEVELS, 1)):
        vertices, faces, p = ray_scenes.torus_of(segments, sides)
        rays = tuple(np.ascontiguousarray(v[:, ::step]) for v in (o, d))
        a = Arguments(ray_scenes.scene(p, balanced(*boxes_around(p), levels), rays[0], rays[1]))
        try:
            r = function.call(trial, a)
            embree = static_accelerator(vertices, faces).intersect(rays[0], rays[1], QueryStats())
            if step == 1:
                trial.show(
                    "pictures",
                    "How near the first hit is: 65,536 triangles, yours beside Embree's",
                    yours=_depth(r[1]),
                    expected=_depth(np.where(embree.triangle < 0, np.inf, embree.t)),
                )
            _nearest(a, r, embree.triangle)
            _few(r, len(faces))
        except Failure as failure:
            example(function, trial, failure, _nearest, ray_scenes.cloud)
            raise
    trial.notes.append(
        f"{r[2].mean():.1f} boxes and {r[3].mean():.1f} triangles were tested for each ray; "
        f"without boxes it would be {len(faces):,} triangles."
    )


def _few(r: Any, triangles: int) -> None:
    tests = (r[2] + r[3]).mean()
    if not tests <= MOST:
        raise Failure(
            f"at most {MOST} tests a ray, for {triangles:,} triangles",
            f"{tests:.0f}",
            f"{r[2].size} rays",
            "A ray goes down only into boxes that it meets.",
        )


def _depth(t: Array) -> Array:
    """White is near, black is nothing."""
    with np.errstate(invalid="ignore"):
        near = np.where(np.isfinite(t), np.clip((4.8 - t) / 3.2, 0.05, 1), 0.0)
    shape = (ray_scenes.HEIGHT, ray_scenes.WIDTH)
    return np.broadcast_to(near.reshape(shape), (3, *shape)).astype(np.float32)


def _hits(name: str, title: str, case: Case) -> Law:
    return law(name, title, _nearest, case=case, n=100, scales=(1.0, 1.0))


TREE = one_leaf(tuple(np.eye(3)[:, [k]] for k in range(3)))  # type: ignore[arg-type]

TRAVERSE = function(
    "bounding_volumes.traverse",
    {
        "hierarchy": Made(wrong=(TREE[:4], (TREE[0][:, 1:], *TREE[1:]))),
        **dict.fromkeys(("p0", "p1", "p2"), Made(batch=False)),
    },
    (
        close(
            "one",
            "One triangle, from both sides, near and far, before and behind",
            _hit_or_not,
            "Either side, only in front of the origin, however near, only within the triangle.",
            what="t =",
            case=ray_scenes.one_triangle,
            scales=(1.0, 1e-3, 1e3),
        ),
        _hits("any", "The nearest hit, in any hierarchy", ray_scenes.cloud),
        _hits(
            "small",
            "The nearest hit in scenes a hundred thousandth as large",
            ray_scenes.of_size(1e-5),
        ),
        _hits(
            "large",
            "The nearest hit in scenes a hundred thousand times as large",
            ray_scenes.of_size(1e5),
        ),
        law(
            "deep",
            "A hierarchy may be of any depth",
            _nearest,
            case=ray_scenes.deep,
            n=20,
            scales=(1.0, 1.0),
        ),
        holds(
            "boxes",
            "The boxes decide what is tested",
            lambda a, r: np.abs(r[1] * a.directions[2] + a.origins[2] - 8) < 1e-4,
            "only triangles whose boxes the ray meets: the boxes of eight stand elsewhere",
            "A triangle counts only where the ray meets the boxes of all nodes above it.",
            case=ray_scenes.hidden,
            n=50,
        ),
        holds(
            "counts",
            "The numbers of tests are right",
            _counted,
            "a test for each box that the ray was held against, and for each triangle in the leaves that it meets",
            "A leaf whose box is met costs as many tests as it holds triangles; one whose box is missed costs none, "
            "the root too where it is a leaf.",
            shows=lambda _, r: r[3],
            case=ray_scenes.counted,
            n=16,
            scales=(1.0,) * 6,
        ),
        law(
            "order",
            "What lies behind the nearest hit is skipped",
            _few_from_both_sides,
            case=ray_scenes.ordered,
            n=100,
        ),
        Law(
            "embree", "Hit for hit with Embree on 65,536 triangles, with few tests", _embree, "core"
        ),
    ),
    case=ray_scenes.cloud,
    unique=False,
    speed=512,
)
