"""Checks of bounding_volumes: rays and boxes, hierarchies of boxes, and the way of a ray through one.

Hierarchies that ``traverse`` is given are made here, so that it pays for no mistake of ``build``. What it finds is
judged in double precision: a triangle that is named has to be hit where it is said, and no other may clearly be hit
before it. So ties, and rays through edges, may go either way.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.geometry.embree import Accelerator, QueryTime
from course.geometry.shapes import torus
from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    contract_checks,
    pair,
)
from course.grading.checks.hierarchies import (
    Hierarchy,
    Vectors,
    balanced,
    boxes_around,
    cost,
    exact_hit,
    lopsided,
    nearest_triangle,
    one_leaf,
)
from course.grading.checks.vectors import unit_vectors

TOLERANCE = {np.float32: 2e-4, np.float64: 1e-9}
"""Of distances no larger than 20 or so."""

EDGE = 1e-3
"""Barycentric distance from an edge within which a hit may be missed."""

GRAZING = 0.02
"""Cosine of directions so flat that a hit may be missed."""


# ---------------------------------------------------------------- slab_test


def _box(rng: np.random.Generator, n: int) -> tuple[Array, Array]:
    """Boxes (3, n) of unequal sides."""
    lo = rng.uniform(-2, 1, (3, n))
    return lo, lo + rng.uniform(0.2, 2, (3, n))


def _through(
    rng: np.random.Generator, lo: Array, hi: Array, dtype: Any = np.float64
) -> tuple[Array, Array]:
    """Rays that begin anywhere, inside too, and whose lines go through a point well within their box."""
    n = lo.shape[1]
    target = lo + rng.uniform(0.05, 0.95, (3, n)) * (hi - lo)
    directions = unit_vectors(rng, n)
    return (target - rng.uniform(-6, 6, n) * directions).astype(dtype), directions.astype(dtype)


def _repeated(lo: Array, hi: Array, n: int) -> tuple[Array, Array]:
    """One box n times."""
    return np.repeat(lo[:, None], n, axis=1), np.repeat(hi[:, None], n, axis=1)


def _times(trial: Trial, *arguments: Any) -> tuple[Array, Array]:
    """The student's t_near and t_far in float64; infinite ones pass, NaN doesn't."""
    n = arguments[0].shape[1]
    found = []
    for name, value in zip(
        ("t_near", "t_far"), pair(trial.call(*arguments), "t_near", "t_far"), strict=True
    ):
        if type(value) is not np.ndarray or value.shape != (n,) or value.dtype.kind != "f":
            raise Failure(f"{name} as floating ({n},)", _described(value))
        if np.isnan(value).any():
            k = int(np.flatnonzero(np.isnan(value))[0])
            raise Failure(
                f"{name} to be a number",
                "NaN",
                at(**dict(zip(("origin", "direction"), arguments[:2], strict=True)))(k),
                "Zero over zero: the line runs along a face.",
            )
        found.append(value.astype(np.float64))
    return found[0], found[1]


def _described(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"shape {value.shape}, dtype {value.dtype}"
    return type(value).__name__


def _check_met(trial: Trial, arguments: tuple[Array, ...], expected: Array, hint: str) -> None:
    """t_near <= t_far just where expected."""
    near, far = _times(trial, *arguments)
    wrong = np.flatnonzero((near <= far) != expected)
    if wrong.size:
        k = int(wrong[0])
        say = at(**dict(zip(("origin", "direction"), arguments[:2], strict=True)))
        raise Failure(
            f"a line that {'meets' if expected[k] else 'misses'} the box",
            f"t_near {near[k]:.6g}, t_far {far[k]:.6g}",
            say(k),
            hint,
        )


def _slab_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        lo, hi = _box(trial.rng, 40)
        o, d = _through(trial.rng, lo, hi, dtype)
        one = (lo[:, 0], hi[:, 0])
        o1, d1 = _through(trial.rng, *_repeated(*one, 40), dtype)
        own = (lo.astype(dtype), hi.astype(dtype))
        for n in (40, 1, 0):
            batch = (o[:, :n].copy(), d[:, :n].copy(), *(c[:, :n].copy() for c in own))
            for result in pair(trial.call(*batch), "t_near", "t_far"):
                check_array(result, (n,), dtype)
            for single in DTYPES:
                corners = (c.astype(single) for c in one)
                results = trial.call(o1[:, :n].copy(), d1[:, :n].copy(), *corners)
                for result in pair(results, "t_near", "t_far"):
                    check_array(result, (n,), dtype)


def _slab_untouched(trial: Trial) -> None:
    lo, hi = _box(trial.rng, 40)
    check_untouched(trial, *_through(trial.rng, lo, hi), lo, hi)
    o, d = _through(trial.rng, lo, hi)
    d[trial.rng.integers(0, 3, 40), np.arange(40)] = 0
    check_untouched(trial, o, d, lo[:, 0].copy(), hi[:, 0].copy())


def _slab_refuses(trial: Trial) -> None:
    lo, hi = _box(trial.rng, 5)
    fine = (*_through(trial.rng, lo, hi), lo, hi)
    for k, name in enumerate(("origins", "directions", "lo", "hi")):
        for bad in (fine[k][:2], fine[k].T, fine[k][:, :4] if k else fine[k][0]):
            check_refused(trial, *(bad if i == k else a for i, a in enumerate(fine)), named=name)


def _slab_known(trial: Trial) -> None:
    """A box from (-1, -2, -3) to (1, 2, 3), along axes and a diagonal, from outside, inside and beyond."""
    lo, hi = np.array((-1.0, -2, -3)), np.array((1.0, 2, 3))
    r = 1 / np.sqrt(3)
    cases = [
        ((-5, 0.5, 0.5), (1, 0, 0), 4, 6),
        ((5, 0.5, 0.5), (-1, 0, 0), 4, 6),
        ((0, -4, 1), (0, 1, 0), 2, 6),
        ((0, 0, 0), (0, 0, -1), -3, 3),
        ((0, 0, 7), (0, 0, 1), -10, -4),
        ((-2, -2, -2), (r, r, r), 1 / r, 3 / r),
        ((2, 2, 2), (-r, -r, -r), 1 / r, 3 / r),
        ((0, 0, 0), (r, r, -r), -1 / r, 1 / r),
    ]
    for origin, direction, near, far in cases:
        o, d = (np.array(v, np.float64)[:, None] for v in (origin, direction))
        found = _times(trial, o, d, lo, hi)
        for name, value, expected in zip(("t_near", "t_far"), found, (near, far), strict=True):
            check_close(
                value,
                np.array([expected]),
                1e-12,
                f"{name}, for the box from (-1, -2, -3) to (1, 2, 3),",
                at(origin=o, direction=d),
                "In the box is between all three pairs of faces at once; behind the origin t is negative.",
            )


def _slab_through(trial: Trial) -> None:
    """At t_near and t_far the line is on the box's surface, and half way it is inside."""
    for dtype in DTYPES:
        lo, hi = (c.astype(dtype) for c in _box(trial.rng, 2000))
        o, d = _through(trial.rng, lo, hi, dtype)
        near, far = _times(trial, o, d, lo, hi)
        say = at(origin=o, direction=d, lo=lo, hi=hi)
        exact = [v.astype(np.float64) for v in (o, d, lo, hi)]
        for name, t in (("t_near", near), ("t_far", far)):
            p = exact[0] + t * exact[1]
            outside = np.maximum(exact[2] - p, p - exact[3]).max(axis=0)
            check_close(
                outside, np.zeros(2000), TOLERANCE[dtype], f"from the surface at {name}:", say
            )
        k = int(np.argmin(far - near))
        if not far[k] > near[k]:
            raise Failure(
                "t_near < t_far through the inside", f"{near[k]:.6g}, {far[k]:.6g}", say(k)
            )


def _slab_misses(trial: Trial) -> None:
    """Lines past an edge: two slabs are crossed one after the other, never at once."""
    lo, hi = _box(trial.rng, 2000)
    o, d = _through(trial.rng, lo, hi)
    # Moved at right angles to the line until it passes a corner's sphere.
    center, radius = (lo + hi) / 2, np.linalg.norm(hi - lo, axis=0) / 2
    across = np.cross(d, unit_vectors(trial.rng, 2000), axis=0)
    across /= np.linalg.norm(across, axis=0)
    along = ((o - center) * d).sum(axis=0)
    o = center + along * d + across * radius * trial.rng.uniform(1.01, 2, 2000)
    _check_met(
        trial,
        (o, d, lo, hi),
        np.zeros(2000, bool),
        "It has to be between all three pairs of faces at the same time.",
    )


def _slab_parallel(trial: Trial) -> None:
    lo, hi = np.array((-1.0, -2, -3)), np.array((1.0, 2, 3))
    for dtype in DTYPES:
        for axis in range(3):
            for zero in (0.0, -0.0):
                o, d = _through(trial.rng, *_repeated(lo, hi, 300), dtype)
                d[axis] = zero
                o = (o - 8 * d).astype(dtype)
                # Aimed at the middle, and then set between the faces, beside them, or on them.
                d = (-o).astype(dtype)
                d[axis] = zero
                o[axis] = np.repeat(np.array((0.6, 1.5, 1.0)) * hi[axis], 100)
                o[axis] *= np.tile((1, -1), 150)
                expected = np.repeat((True, False, True), 100)
                _check_met(
                    trial,
                    (o, d, lo, hi),
                    expected,
                    "Along two faces: between them for all t or for none; on a face counts as between.",
                )


def _slab_single_axis(trial: Trial) -> None:
    """Along one axis, two components are zero; on edges too."""
    lo, hi = np.array((-1.0, -2, -3)), np.array((1.0, 2, 3))
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        o, d = np.zeros((3, 36)), np.zeros((3, 36))
        places = np.stack([v.ravel() for v in np.meshgrid([-1, 0.5, 1], [-1, 0.5, 1.5])])
        for row, k in enumerate(others):
            o[k] = np.repeat(places[row], 4) * hi[k]
        o[axis] = np.tile((-10.0, 10.0, -10.0, 10.0), 9)
        d[axis] = np.tile((1.0, -1.0, 1.0, -1.0), 9)
        d[others, 2::4] = -0.0
        _check_met(
            trial,
            (o, d, lo, hi),
            np.repeat(places[1] <= 1, 4),
            "Two components may be zero at once, +0 or -0.",
        )


def _slab_flat(trial: Trial) -> None:
    lo, hi = _box(trial.rng, 600)
    axis = trial.rng.integers(0, 3, 600)
    hi[axis, np.arange(600)] = lo[axis, np.arange(600)]
    o, d = _through(trial.rng, lo, hi)
    near, far = _times(trial, o, d, lo, hi)
    expected = ((lo - o) / d)[axis, np.arange(600)]
    for name, t in (("t_near", near), ("t_far", far)):
        check_close(
            t,
            expected,
            1e-9 * float(1 + np.abs(expected).max()),
            f"{name} of a box without thickness:",
            at(origin=o, direction=d, lo=lo, hi=hi),
        )


def _slab_tiny(trial: Trial) -> None:
    """Components so small that one over them is infinite."""
    lo, hi = np.array((-1.0, -2, -3)), np.array((1.0, 2, 3))
    tiny = float(np.finfo(np.float32).smallest_subnormal)
    o = np.array([(-5, 2, 0), (-5, -2, 3), (-5, 0, -3), (-5, 2.5, 0)], np.float32).T.copy()
    d = np.array([(1, -tiny, 0), (1, tiny, -tiny), (1, 0, tiny), (1, tiny, 0)], np.float32).T.copy()
    _check_met(
        trial,
        (o, d, lo, hi),
        np.array((True, True, True, False)),
        "One over a tiny component may be infinite, and 0 times that is no number.",
    )


# ---------------------------------------------------------------- build


def _small_boxes(rng: np.random.Generator, n: int, spread: Any = 1.0) -> tuple[Array, Array]:
    """Small boxes anywhere in a larger one."""
    middle = rng.uniform(-1, 1, (3, n)) * np.reshape(spread, (-1, 1))
    half = rng.uniform(0.001, 0.02, (3, n))
    return middle - half, middle + half


def _hierarchy(value: Any, boxes: int) -> Hierarchy:
    """A hierarchy that can be walked: shapes, kinds and indices are right."""
    if not isinstance(value, tuple | list) or len(value) != 5:
        raise Failure("five arrays: lo, hi, first, count, order", type(value).__name__)
    nodes = np.shape(value[2])[:1]
    shapes = {"lo": (3, *nodes), "hi": (3, *nodes), "first": nodes, "count": nodes}
    for (name, shape), kinds, array in zip(
        (shapes | {"order": (boxes,)}).items(), ("f", "f", "iu", "iu", "iu"), value, strict=True
    ):
        if type(array) is not np.ndarray or array.shape != shape or len(nodes) != 1:
            raise Failure(f"{name} of shape {shape}", _described(array))
        if array.dtype.kind not in kinds:
            raise Failure(
                f"{name} {'floating' if kinds == 'f' else 'integer'}", f"dtype {array.dtype}"
            )
    lo, hi, first, count, order = (np.asarray(array) for array in value)
    first, count, order = (array.astype(np.int64) for array in (first, count, order))
    return lo, hi, first, count, order


def _levels(hierarchy: Hierarchy) -> list[Array]:
    """The nodes of each level, walked from the root.

    Raises
    ------
    Failure
        The walk leaves the arrays, or comes to a node twice.
    """
    _, _, first, count, order = hierarchy
    visits = np.zeros(first.size, np.int64)
    levels, level = [], np.zeros(min(first.size, 1), np.int64)
    while level.size:
        visits += np.bincount(level, minlength=first.size)
        if (visits > 1).any():
            raise Failure(
                "every node but the root to be the child of one node",
                f"node {int(np.argmax(visits))} comes twice",
                hint="An inner node's children are first and first + 1.",
            )
        levels.append(level)
        leaf = count[level] != 0
        ends = (first + count)[level[leaf]]
        left = first[level[~leaf]]
        if (
            (count[level] < 0).any()
            or (first[level] < 0).any()
            or (ends > order.size).any()
            or (left + 1 >= first.size).any()
        ):
            raise Failure(
                "first and count within the arrays",
                f"first up to {first[level].max()}, count {count[level].min()} to {count[level].max()}",
                f"{first.size} nodes, {order.size} boxes",
            )
        level = np.concatenate((left, left + 1))
    if not levels or (visits == 0).any():
        k = int(np.argmin(visits)) if visits.size else 0
        raise Failure("every node to be below the root, node 0", f"node {k} is not")
    return levels


def _built(trial: Trial, lo: Array, hi: Array, leaf_size: int) -> Hierarchy:
    return _hierarchy(trial.call(lo.copy(), hi.copy(), leaf_size), lo.shape[1])


def _sets(rng: np.random.Generator) -> dict[str, tuple[Array, Array]]:
    """Boxes of all sorts."""
    lo, hi = _small_boxes(rng, 500)
    line = _small_boxes(rng, 257, (30, 0.1, 0.1))
    same = np.zeros((3, 100)), np.ones((3, 100))
    far = (10.0 ** np.linspace(-6, 6, 60)) * np.ones((3, 1))
    return {
        "500 boxes": (lo, hi),
        "one box": (lo[:, :1], hi[:, :1]),
        "two boxes": (lo[:, :2], hi[:, :2]),
        "a long row": line,
        "100 times the same box": same,
        "points, each ever farther away": (far, far),
    }


def _build_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        for n in (100, 7, 1):
            lo, hi = (c.astype(dtype) for c in _small_boxes(trial.rng, n))
            for leaf_size in (1, 3, 100):
                value = _hierarchy(trial.call(lo.copy(), hi.copy(), leaf_size), n)
                for name, array in zip(("lo", "hi"), value[:2], strict=True):
                    check_array(array, array.shape, dtype, name)


def _build_untouched(trial: Trial) -> None:
    check_untouched(trial, *_small_boxes(trial.rng, 100), 4)


def _build_refuses(trial: Trial) -> None:
    lo, hi = _small_boxes(trial.rng, 5)
    for bad in (lo[:2], lo[0], lo.T, lo[:, :0]):
        check_refused(trial, bad, bad if bad.size == 0 else hi, 2, named="lo")
    for bad in (hi[:2], hi[:, :4]):
        check_refused(trial, lo, bad, 2, named="hi")
    for wrong in (0, -1, 1.5, float("nan")):
        check_refused(trial, lo, hi, wrong, named=f"leaf_size {wrong}")


def _build_once(trial: Trial) -> None:
    for name, (lo, hi) in _sets(trial.rng).items():
        for leaf_size in (1, 4):
            found = _built(trial, lo, hi, leaf_size)
            levels = np.concatenate(_levels(found))
            _, _, first, count, order = found
            held = [order[first[k] : first[k] + count[k]] for k in levels if count[k] > 0]
            times = np.bincount(np.concatenate(held).clip(0), minlength=lo.shape[1])
            if order.min() < 0 or times.size > lo.shape[1] or (times != 1).any():
                k = int(np.flatnonzero(times != 1)[0]) if (times != 1).any() else 0
                raise Failure(
                    "every box in exactly one leaf",
                    f"box {k} in {times[k]}",
                    f"{name}, leaf_size {leaf_size}",
                    "Both halves together are the whole, also where it is odd.",
                )


def _build_leaves(trial: Trial) -> None:
    for name, (lo, hi) in _sets(trial.rng).items():
        for leaf_size in (1, 2, 5, 1000):
            found = _built(trial, lo, hi, leaf_size)
            _levels(found)
            largest = int(found[3].max())
            if largest > leaf_size:
                raise Failure(
                    f"leaves of at most {leaf_size}",
                    f"one of {largest}",
                    name,
                    "A node is divided while it holds more than leaf_size; boxes with the same middle, too.",
                )


def _build_contains(trial: Trial) -> None:
    for dtype in DTYPES:
        for name, boxes in _sets(trial.rng).items():
            lo, hi = (c.astype(dtype) for c in boxes)
            found = _built(trial, lo, hi, 3)
            _check_tight(found, lo, hi, name)


def _check_tight(found: Hierarchy, lo: Array, hi: Array, name: str) -> None:
    """Each node's box is that around all that is below it, from the leaves upwards."""
    _, _, first, count, order = found
    low, high = (
        np.full(box.shape, np.inf) * sign for box, sign in zip(found, (1, -1), strict=False)
    )
    for level in reversed(_levels(found)):
        for k in level:
            if count[k] > 0:
                inside = order[first[k] : first[k] + count[k]].clip(0, lo.shape[1] - 1)
                low[:, k], high[:, k] = lo[:, inside].min(axis=1), hi[:, inside].max(axis=1)
            else:
                both = [first[k], first[k] + 1]
                low[:, k], high[:, k] = low[:, both].min(axis=1), high[:, both].max(axis=1)
    for what, box, expected in (("lo", found[0], low), ("hi", found[1], high)):
        wrong = np.flatnonzero((box != expected).any(axis=0))
        if wrong.size:
            k = int(wrong[0])
            kind = "leaf" if count[k] > 0 else "inner node"
            raise Failure(
                f"{what} of {kind} {k} to be {_row(expected[:, k])}, bit for bit",
                _row(box[:, k]),
                f"{name}; {wrong.size} of {count.size} nodes",
                "The smallest box around all that is below the node.",
            )


def _row(values: Array) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in values.tolist()) + ")"


CHEAP = 2.0
"""Times the mean tests of halves along the longest axis."""


def _build_cost(trial: Trial) -> None:
    for name, spread in (
        ("anywhere in a cube", (1, 1, 1)),
        ("in a row along x", (50, 1, 1)),
        ("in a row along y", (1, 50, 1)),
        ("in a row along z", (1, 1, 50)),
        ("on a floor", (20, 0.05, 20)),
    ):
        lo, hi = _small_boxes(trial.rng, 1024, spread)
        limit = CHEAP * cost(balanced(lo, hi, 8))
        found = _built(trial, lo, hi, 4)
        _levels(found)
        tests = cost(found)
        if not tests <= limit:
            raise Failure(
                f"at most {limit:.0f} tests of a random line, by the nodes' surfaces",
                f"{tests:.0f}",
                f"1024 boxes {name}, leaf_size 4",
                "What lies together should be near each other: then boxes are small, and rays miss them.",
            )


# ---------------------------------------------------------------- traverse


Found = tuple[Array, Array, Array, Array]
"""triangle, t, box_tests, triangle_tests."""


def _walked(trial: Trial, hierarchy: Hierarchy, p: Vectors, o: Array, d: Array) -> Found:
    """What the student finds: integers, t without NaN, whatever their dtypes."""
    value = trial.call(hierarchy, *p, o.copy(), d.copy())
    if not isinstance(value, tuple | list) or len(value) != 4:
        raise Failure("four results: triangle, t, box_tests, triangle_tests", type(value).__name__)
    n, triangles = o.shape[1], p[0].shape[1]
    for name, array in zip(("triangle", "t", "box_tests", "triangle_tests"), value, strict=True):
        kinds, expected = ("f", "floating") if name == "t" else ("iu", "integer")
        if type(array) is not np.ndarray or array.shape != (n,) or array.dtype.kind not in kinds:
            raise Failure(f"{name} as {expected} ({n},)", _described(array))
    triangle, t, boxes, tests = (np.asarray(array) for array in value)
    if n and (triangle.min() < -1 or triangle.max() >= triangles):
        raise Failure(
            f"triangles from -1 to {triangles - 1}", f"{triangle.min()} to {triangle.max()}"
        )
    if not np.array_equal(np.isposinf(t), triangle < 0) or np.isnan(t).any():
        raise Failure(
            "t infinite where triangle is -1, and only there",
            "something else",
            hint="A ray that hits nothing has no triangle and no t.",
        )
    return triangle.astype(np.int64), t.astype(np.float64), boxes, tests


def _check_hits(
    found: Found, expected: Array, p: Vectors, o: Array, d: Array, tolerance: float, what: str
) -> None:
    """Each triangle named is hit at its t, and none of the expected ones is clearly hit before it.

    Raises
    ------
    Failure
    """
    triangle, t = found[:2]
    say = at(origin=o, direction=d)
    own_t, own_least, own_cosine = exact_hit([c[:, triangle] for c in p], o, d)
    named = triangle >= 0
    slack = tolerance * (1 + np.where(named, np.abs(own_t), 0)) / np.maximum(own_cosine, GRAZING)
    with np.errstate(invalid="ignore"):
        wrong = named & ~((own_least > -EDGE) & (own_t > -slack) & (np.abs(own_t - t) <= slack))
    if wrong.any():
        k = int(np.argmax(wrong))
        raise Failure(
            f"{what}: a triangle that is hit, at its t",
            f"triangle {triangle[k]} at t = {t[k]:.6g}, whose plane is met at {own_t[k]:.6g}"
            + ("" if own_least[k] > -EDGE else ", outside it"),
            say(k) + f"; {wrong.sum()} of {wrong.size} rays",
        )
    true_t, least, cosine = exact_hit([c[:, expected] for c in p], o, d)
    clear = (expected >= 0) & (least > EDGE) & (cosine > GRAZING)
    with np.errstate(invalid="ignore"):
        wrong = clear & ~(named & (own_t <= true_t + slack + tolerance * (1 + true_t) / GRAZING))
    if wrong.any():
        k = int(np.argmax(wrong))
        raise Failure(
            f"{what}: triangle {expected[k]} at t = {true_t[k]:.6g}",
            f"triangle {triangle[k]} at {t[k]:.6g}" if named[k] else "nothing",
            say(k) + f"; {wrong.sum()} of {wrong.size} rays",
            "The nearest of all: a leaf that is visited later may hold something nearer.",
        )


def _cloud(rng: np.random.Generator, triangles: int, rays: int) -> tuple[Vectors, Array, Array]:
    """Triangles anyhow in a cube, and rays from a sphere around it towards it."""
    middle = rng.uniform(-1, 1, (3, triangles))
    p0, p1, p2 = (middle + rng.uniform(-0.5, 0.5, (3, triangles)) for _ in range(3))
    o = 4 * unit_vectors(rng, rays)
    d = rng.uniform(-1, 1, (3, rays)) - o
    return (p0, p1, p2), o, np.asarray(d / np.linalg.norm(d, axis=0))


def _room() -> Vectors:
    """A closed box of 12 triangles around the origin."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1.5, 1.5) for z in (-2, 2)], float)
    quads = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
    faces = np.array([tri for a, b, c, e in quads for tri in ((a, b, c), (a, c, e))])
    p0, p1, p2 = (np.ascontiguousarray(corners[faces[:, k]].T) for k in range(3))
    return p0, p1, p2


def _traverse_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        p = tuple(c.astype(dtype) for c in _room())
        hierarchy = lopsided(trial.rng, *boxes_around(p))  # type: ignore[arg-type]
        o = trial.rng.uniform(-0.5, 0.5, (3, 40)).astype(dtype)
        d = unit_vectors(trial.rng, 40).astype(dtype)
        for n in (40, 1, 0):
            value = trial.call(hierarchy, *p, o[:, :n].copy(), d[:, :n].copy())
            if not isinstance(value, tuple | list) or len(value) != 4:
                raise Failure(
                    "four results: triangle, t, box_tests, triangle_tests", type(value).__name__
                )
            check_array(value[0], (n,), np.int32, "triangle")
            check_array(value[1], (n,), dtype, "t")
            for name, array in zip(("box_tests", "triangle_tests"), value[2:], strict=True):
                kind = getattr(array, "dtype", np.dtype(float))
                if kind.kind not in "iu":
                    raise Failure(f"{name} to be integer", _described(array))
                check_array(array, (n,), kind, name)


def _traverse_untouched(trial: Trial) -> None:
    p, o, d = _cloud(trial.rng, 50, 40)
    hierarchy = lopsided(trial.rng, *boxes_around(p))
    before = [array.copy() for array in hierarchy]
    check_untouched(trial, hierarchy, *p, o, d)
    _, after, _ = trial.caller.call_and_look(trial.function, hierarchy, *p, o, d)
    for name, old, new in zip(
        ("lo", "hi", "first", "count", "order"), before, after[0], strict=True
    ):
        if not np.array_equal(old, new):
            raise Failure(f"the hierarchy's {name} to be left as it was", "it has been written to")


def _traverse_refuses(trial: Trial) -> None:
    p, o, d = _cloud(trial.rng, 20, 5)
    hierarchy = lopsided(trial.rng, *boxes_around(p))
    fine = (hierarchy, *p, o, d)
    bad_ones: list[tuple[int, str, Any]] = [
        (0, "hierarchy", hierarchy[:4]),
        (0, "hierarchy", (hierarchy[0][:, 1:], *hierarchy[1:])),
        *((k, f"p{k - 1}", p[k - 1][:, :-1]) for k in (1, 2, 3)),
        (4, "origins", o[:2]),
        (5, "directions", d[:, :4]),
    ]
    for k, name, bad in bad_ones:
        check_refused(trial, *(bad if i == k else a for i, a in enumerate(fine)), named=name)


def _one_triangle() -> Vectors:
    return tuple(np.array(v, float)[:, None] for v in ((0, 0, 0), (4, 0, 1), (0, 4, 1)))  # type: ignore[return-value]


def _traverse_known(trial: Trial) -> None:
    """One triangle in one leaf, from both sides, past it, and away from it within its box."""
    p = _one_triangle()
    # The plane is z = (x + y) / 4.
    cases = [
        ("from above", (1, 1, 5), (0, 0, -1), 4.5),
        ("from below", (1, 1, -5), (0, 0, 1), 5.5),
        ("at half speed", (1, 1, -5), (0, 0, 0.5), 11.0),
        ("past its long side", (3, 3, 5), (0, 0, -1), None),
        ("past it", (-1, 1, 5), (0, 0, -1), None),
        ("away from it, beginning in its box", (1, 1, 0.8), (0, 0, 1), None),
        ("towards it, beginning in its box", (1, 1, 0.8), (0, 0, -1), 0.3),
        ("along its plane", (-2, -2, -1), (2, 2, 1), None),
    ]
    for name, origin, direction, expected in cases:
        o, d = (np.array(v, float)[:, None] for v in (origin, direction))
        triangle, t, _, _ = _walked(trial, one_leaf(p), p, o, d)
        if (triangle[0] >= 0) != (expected is not None) or (
            expected is not None and not abs(t[0] - expected) < 1e-9
        ):
            raise Failure(
                f"{name}: {'nothing' if expected is None else f't = {expected}'}",
                f"triangle {triangle[0]} at t = {t[0]:.6g}",
                at(origin=o, direction=d)(0) + "; triangle (0, 0, 0), (4, 0, 1), (0, 4, 1)",
                "Either side, only in front of the origin, only within the triangle.",
            )


def _traverse_any(trial: Trial) -> None:
    for dtype in DTYPES:
        for triangles in (1, 2, 7, 150):
            p, o, d = _cloud(trial.rng, triangles, 200)
            p, o, d = tuple(c.astype(dtype) for c in p), o.astype(dtype), d.astype(dtype)  # type: ignore[assignment]
            found = _walked(trial, lopsided(trial.rng, *boxes_around(p)), p, o, d)
            what = f"{triangles} triangles in a lopsided hierarchy"
            _check_hits(found, nearest_triangle(p, o, d), p, o, d, TOLERANCE[dtype], what)


def _hidden(rng: np.random.Generator) -> tuple[Hierarchy, Vectors, Array, Array]:
    """Eight triangles before eight others; the boxes of the front ones have been carried away."""
    p, o, d = _layers(rng, 16)
    o, d = o[:, d[2] > 0], d[:, d[2] > 0]
    lo, hi, first, count, order = balanced(*boxes_around(p), 4)
    front = np.arange(lo.shape[1]) > 0
    front &= hi[2] < 7.5
    lo, hi = lo.copy(), hi.copy()
    lo[0, front] += 100
    hi[0, front] += 100
    hi[0, 0] += 100
    return (lo, hi, first, count, order), p, o, d


def _traverse_boxes(trial: Trial) -> None:
    hierarchy, p, o, d = _hidden(trial.rng)
    triangle, t, _, _ = _walked(trial, hierarchy, p, o, d)
    if triangle.size and not (np.abs(t * d[2] + o[2] - 8) < 1e-6).all():
        k = int(np.argmax(np.abs(t * d[2] + o[2] - 8)))
        raise Failure(
            "only triangles whose boxes the ray meets",
            f"triangle {triangle[k]} at t = {t[k]:.6g}",
            at(origin=o, direction=d)(k) + "; the boxes of eight triangles stand elsewhere",
            "The boxes decide what is tested.",
        )


def _layers(rng: np.random.Generator, layers: int) -> tuple[Vectors, Array, Array]:
    """Large triangles one above the other, at z = 0, 1, 2, ..., in any order; rays through all, up and down."""
    z = rng.permutation(layers).astype(float)
    p0, p1, p2 = (
        np.stack((np.full(layers, x), np.full(layers, y), z))
        for x, y in ((-50, -50), (50, -50), (0, 80))
    )
    d = np.concatenate((rng.uniform(-0.1, 0.1, (2, 100)), np.ones((1, 100))))
    o = np.concatenate((rng.uniform(-5, 5, (2, 100)), np.full((1, 100), -3.0)))
    o[2, ::2], d[2, ::2] = layers + 2, -1
    return (p0, p1, p2), o, d


LAYERS = 64
FEW = 6.0
"""Triangles a ray, where the first of the layers ends it; without order it is 64 from one side at least."""


def _tests_of_layers(trial: Trial) -> tuple[float, float]:
    """Mean triangle tests of rays upwards and downwards, where the first layer is the nearest hit."""
    p, o, d = _layers(trial.rng, LAYERS)
    found = _walked(trial, balanced(*boxes_around(p), 6), p, o, d)
    _check_hits(found, nearest_triangle(p, o, d), p, o, d, 1e-9, f"{LAYERS} layers")
    up = d[2] > 0
    return float(found[3][up].mean()), float(found[3][~up].mean())


def _traverse_order(trial: Trial) -> None:
    for way, tests in zip(("upwards", "downwards"), _tests_of_layers(trial), strict=True):
        if not tests <= FEW:
            raise Failure(
                f"at most {FEW:g} triangles tested a ray",
                f"{tests:.3g}",
                f"{LAYERS} layers, one a leaf, rays {way}",
                "The nearer child first; and what begins beyond the nearest hit so far needs no visit.",
            )


def _traverse_counts(trial: Trial) -> None:
    """Leaves that rays meet or miss as a whole: the numbers of tests are known."""
    p, _, _ = _cloud(trial.rng, 20, 1)
    left, right = (tuple(c + np.array(((x,), (0.0,), (0.0,))) for c in p) for x in (-10, 10))
    both: Vectors = tuple(np.concatenate(pair, axis=1) for pair in zip(left, right, strict=True))  # type: ignore[assignment]
    o = np.array([(-10.0, 10, 0, 300), (0, 0, 0, 0), (-9, -9, -9, -9)])
    d = np.tile(((0.0,), (0.0,), (1.0,)), 4)
    one, two = one_leaf(both), balanced(*boxes_around(both), 1)
    for name, hierarchy, least, most, triangles in (
        ("one leaf of 40", one, (0, 0, 0, 0), (1, 1, 1, 1), (40, 40, 40, 0)),
        ("two leaves of 20 side by side", two, (2, 2, 2, 0), (3, 3, 3, 1), (20, 20, 0, 0)),
    ):
        _, _, boxes, tests = _walked(trial, hierarchy, both, o, d)
        for k, ray in enumerate(("on the left", "on the right", "between", "past everything")):
            if tests[k] != triangles[k]:
                raise Failure(
                    f"triangle_tests of {triangles[k]}", f"{tests[k]}", f"{name}, a ray {ray}"
                )
            if not least[k] <= boxes[k] <= most[k]:
                raise Failure(
                    f"box_tests of {least[k]} to {most[k]}", f"{boxes[k]}", f"{name}, a ray {ray}"
                )


LEVELS = 14
MOST = 256
"""Tests a ray, of boxes and triangles: a 256th of all triangles, and nine times what a right function needs."""

WIDTH, HEIGHT = 56, 42
"""Of the picture whose rays are compared with Embree's."""


def _camera(rng: np.random.Generator) -> tuple[Array, Array]:
    """Rays of a pinhole camera that looks at the origin from anywhere."""
    forward = -unit_vectors(rng, 1)
    right = np.cross(forward, unit_vectors(rng, 1), axis=0)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward, axis=0)
    x, y = np.meshgrid(np.linspace(-0.6, 0.6, WIDTH), np.linspace(0.45, -0.45, HEIGHT))
    d = forward + x.ravel() * right + y.ravel() * up
    d /= np.linalg.norm(d, axis=0)
    return np.repeat(-3.2 * forward, d.shape[1], axis=1).astype(np.float32), d.astype(np.float32)


def _torus(segments: int, sides: int) -> tuple[Array, Array, Vectors]:
    """Vertices (V, 3), faces (T, 3), and the triangles' corners, in single precision."""
    mesh = torus(radius=1.0, tube=0.4, segments=segments, sides=sides)
    vertices, faces = mesh.vertices.astype(np.float32), mesh.triangles.astype(np.int32)
    p0, p1, p2 = (np.ascontiguousarray(vertices[faces[:, k]].T) for k in range(3))
    return vertices, faces, (p0, p1, p2)


def _traverse_embree(trial: Trial) -> None:
    o, d = _camera(trial.rng)
    # Few triangles first: who tests all of them would need minutes for the others.
    _, faces, p = _torus(32, 32)
    _check_few(_walked(trial, balanced(*boxes_around(p), 9), p, o[:, ::20], d[:, ::20]), len(faces))
    vertices, faces, p = _torus(256, 128)
    hierarchy = balanced(*boxes_around(p), LEVELS)
    embree = Accelerator(vertices, faces).intersect(o, d, QueryTime())
    found = _walked(trial, hierarchy, p, o, d)
    trial.show(
        "pictures",
        "How near the first hit is: 65,536 triangles, yours beside Embree's",
        yours=_depth(found[1]),
        expected=_depth(np.where(embree.triangle < 0, np.inf, embree.t)),
    )
    _check_hits(found, embree.triangle, p, o, d, TOLERANCE[np.float32], "with Embree")
    _check_few(found, len(faces))
    _, _, boxes, tests = found
    trial.notes.append(
        f"{boxes.mean():.1f} boxes and {tests.mean():.1f} triangles were tested for each ray; "
        f"without boxes it would be {len(faces):,} triangles."
    )


def _check_few(found: Found, triangles: int) -> None:
    """Tests are few, but not fewer than lead to a triangle."""
    triangle, _, boxes, tests = found
    hit, levels = triangle >= 0, int(np.log2(triangles)) - 2
    if (tests[hit] < 1).any() or (boxes[hit] < levels).any():
        raise Failure(
            f"a triangle test and {levels} box tests for each ray that hits, or more",
            f"{tests[hit].min()} and {boxes[hit].min()}",
            hint="There are that many levels between the root and a leaf.",
        )
    mean = float((boxes + tests).mean())
    if not mean <= MOST:
        raise Failure(
            f"at most {MOST} tests a ray, for {triangles:,} triangles",
            f"{mean:.0f}",
            hint="A ray goes down only into boxes that it meets.",
        )


def _depth(t: Array) -> Array:
    """White is near, black is nothing."""
    with np.errstate(invalid="ignore"):
        near = np.where(np.isfinite(t), np.clip((4.8 - t) / 3.2, 0.05, 1), 0.0)
    return np.broadcast_to(near.reshape(HEIGHT, WIDTH), (3, HEIGHT, WIDTH)).astype(np.float32)


# ---------------------------------------------------------------- mistakes


def _slab_is(trial: Trial, model: Callable[[Array, Array], tuple[Array, Array]]) -> bool:
    """For lines through boxes the student's t_near and t_far are those of a mistake (t_lo, t_hi)."""
    lo, hi = _box(trial.rng, 300)
    o, d = _through(trial.rng, lo, hi)
    near, far = _times(trial, o, d, lo, hi)
    expected = model((lo - o) / d, (hi - o) / d)
    return np.allclose(near, expected[0], atol=1e-9) and np.allclose(far, expected[1], atol=1e-9)


def _right(a: Array, b: Array) -> tuple[Array, Array]:
    return np.minimum(a, b).max(axis=0), np.maximum(a, b).min(axis=0)


def _positive_only(trial: Trial) -> bool:
    return _slab_is(trial, lambda a, b: (a.max(axis=0), b.min(axis=0)))


def _clamped(trial: Trial) -> bool:
    return _slab_is(trial, lambda a, b: (np.maximum(_right(a, b)[0], 0), _right(a, b)[1]))


def _any_slab(trial: Trial) -> bool:
    return _slab_is(
        trial, lambda a, b: (np.minimum(a, b).min(axis=0), np.maximum(a, b).max(axis=0))
    )


def _along_x(places: tuple[float, ...]) -> tuple[Array, ...]:
    """Lines with a y component of 0 past a unit box, and the box."""
    o = np.array([(-3.0, y, 0.25) for y in places]).T.copy()
    d = np.tile(((1.0,), (0.0,), (0.1,)), len(places))
    return o, d, -np.ones(3), np.ones(3)


def _face_lost(trial: Trial) -> bool:
    arguments = _along_x((1.0, -1.0, 0.5, -0.25, 1.5))
    near, far = pair(trial.call(*arguments), "t_near", "t_far")
    met = near <= far
    return bool(met[2:4].all() and not met[4] and not met[:2].all())


def _parallel_lost(trial: Trial) -> bool:
    near, far = pair(trial.call(*_along_x((0.5, -0.25, 0.75))), "t_near", "t_far")
    return not (near <= far).any()


def _parallel_kept(trial: Trial) -> bool:
    near, far = pair(trial.call(*_along_x((1.5, -2.0, 9.0, 0.5))), "t_near", "t_far")
    return bool((near <= far).all())


def _first_box(trial: Trial) -> bool:
    lo, hi = _box(trial.rng, 100)
    o, d = _through(trial.rng, *_repeated(lo[:, 0], hi[:, 0], 100))
    near, far = _times(trial, o, d, lo, hi)
    expected = _right((lo[:, :1] - o) / d, (hi[:, :1] - o) / d)
    return np.allclose(near, expected[0]) and np.allclose(far, expected[1])


def _unsorted(trial: Trial) -> bool:
    lo, hi = _small_boxes(trial.rng, 64)
    found = _built(trial, lo, hi, 2)
    held = [found[4][f : f + c] for f, c in zip(found[2], found[3], strict=True) if c]
    return all(int(np.ptp(run)) < run.size for run in held)


def _one_axis(trial: Trial) -> bool:
    """Rows along one axis are divided well, along the others not."""
    well = []
    for axis in range(3):
        lo, hi = _small_boxes(trial.rng, 256, np.where(np.arange(3) == axis, 50, 1))
        well.append(cost(_built(trial, lo, hi, 4)) <= CHEAP * cost(balanced(lo, hi, 6)))
    return sum(well) == 1


def _leaf_too_large(trial: Trial) -> bool:
    most = []
    for leaf_size in (1, 3, 7):
        lo, hi = _small_boxes(trial.rng, 200)
        most.append(int(_built(trial, lo, hi, leaf_size)[3].max()) - leaf_size)
    return all(0 <= more <= 7 for more in most) and any(most)


def _same_endless(trial: Trial) -> bool:
    """Boxes with the same middle are left together, others are divided well."""
    lo, hi = _small_boxes(trial.rng, 64)
    if _built(trial, lo, hi, 2)[3].max() > 2:
        return False
    return bool(_built(trial, np.zeros((3, 64)), np.ones((3, 64)), 2)[3].max() > 2)


def _middles_boxed(trial: Trial) -> bool:
    lo, hi = _small_boxes(trial.rng, 64)
    found = _built(trial, lo, hi, 2)
    middle = (lo + hi) / 2
    return np.allclose(found[0][:, 0], middle.min(axis=1)) and np.allclose(
        found[1][:, 0], middle.max(axis=1)
    )


def _lost(trial: Trial) -> bool:
    lo, hi = _small_boxes(trial.rng, 63)
    found = _built(trial, lo, hi, 2)
    held = [found[4][f : f + c] for f, c in zip(found[2], found[3], strict=True) if c]
    return np.unique(np.concatenate(held)).size < 63


def _cloud_walked(trial: Trial) -> tuple[Found, Hierarchy, Vectors, Array, Array]:
    p, o, d = _cloud(trial.rng, 100, 300)
    hierarchy = lopsided(trial.rng, *boxes_around(p))
    return _walked(trial, hierarchy, p, o, d), hierarchy, p, o, d


def _positions(trial: Trial) -> bool:
    found, hierarchy, p, o, d = _cloud_walked(trial)
    expected = nearest_triangle(p, o, d)
    named = np.where(found[0] < 0, -1, hierarchy[4][found[0]])
    return bool((named == expected).mean() > 0.98 and (found[0] != expected).mean() > 0.3)


def _not_nearest(trial: Trial) -> bool:
    """Everything that is named is hit, but it is not the nearest."""
    found, _, p, o, d = _cloud_walked(trial)
    triangle, t = found[:2]
    nearest = nearest_triangle(p, o, d)
    own_t, least, _ = exact_hit([c[:, triangle] for c in p], o, d)
    named = triangle >= 0
    true = (least > -EDGE) & (np.abs(own_t - t) < 1e-6) & (own_t > 0)
    return bool(true[named].all() and named[nearest >= 0].all() and (triangle != nearest).any())


def _single(trial: Trial, origin: tuple[float, ...], direction: tuple[float, ...]) -> bool:
    """Whether a ray hits the one triangle."""
    o, d = (np.array(v, float)[:, None] for v in (origin, direction))
    p = _one_triangle()
    value = trial.call(one_leaf(p), *p, o, d)
    return bool(value[0][0] >= 0)


def _behind(trial: Trial) -> bool:
    return _single(trial, (1, 1, 0.8), (0, 0, 1)) and _single(trial, (1, 1, 5), (0, 0, -1))


def _one_sided(trial: Trial) -> bool:
    return _single(trial, (1, 1, 5), (0, 0, -1)) != _single(trial, (1, 1, -5), (0, 0, 1))


def _parallelogram(trial: Trial) -> bool:
    return _single(trial, (3, 3, 5), (0, 0, -1)) and not _single(trial, (-1, 1, 5), (0, 0, -1))


def _first_of_leaf(trial: Trial) -> bool:
    """Only the first triangle of a leaf is found."""
    p, o, d = _cloud(trial.rng, 20, 300)
    found = _walked(trial, one_leaf(p), p, o, d)
    return set(found[0].tolist()) == {-1, 0}


def _boxes_ignored(trial: Trial) -> bool:
    hierarchy, p, o, d = _hidden(trial.rng)
    triangle, t, _, _ = _walked(trial, hierarchy, p, o, d)
    return bool((triangle == nearest_triangle(p, o, d)).all() and np.isfinite(t).all())


def _unordered(trial: Trial) -> bool:
    """Right hits in the layers, but too many tests from one side, or from both."""
    return max(_tests_of_layers(trial)) > FEW


# ---------------------------------------------------------------- all of them


CHECKS = ModuleChecks(
    "bounding_volumes",
    checks=(
        *contract_checks("slab_test", _slab_contract, _slab_untouched, _slab_refuses),
        Check("slab_test", "known", "Lines along axes and diagonals", _slab_known),
        Check("slab_test", "through", "At t_near and t_far the line is on the box", _slab_through),
        Check("slab_test", "misses", "Where a line misses, t_near > t_far", _slab_misses),
        Check(
            "slab_test",
            "parallel",
            "A component of +0 or -0: between two faces, beside them, on them",
            _slab_parallel,
        ),
        Check("slab_test", "axis", "Two components of zero", _slab_single_axis),
        Check("slab_test", "flat", "Boxes without thickness are met", _slab_flat),
        Check("slab_test", "tiny", "Components whose inverse is infinite", _slab_tiny),
        *contract_checks("build", _build_contract, _build_untouched, _build_refuses),
        Check("build", "once", "Every box is in exactly one leaf", _build_once),
        Check("build", "leaves", "No leaf holds more than leaf_size", _build_leaves),
        Check(
            "build",
            "contains",
            "Each node's box is the smallest around what is below it",
            _build_contains,
        ),
        Check("build", "cost", "Nodes are small, so that rays miss them", _build_cost),
        *contract_checks("traverse", _traverse_contract, _traverse_untouched, _traverse_refuses),
        Check("traverse", "known", "One triangle, from all sides", _traverse_known),
        Check("traverse", "any", "The nearest hit, in any hierarchy", _traverse_any),
        Check("traverse", "boxes", "The boxes decide what is tested", _traverse_boxes),
        Check("traverse", "counts", "The numbers of tests are right", _traverse_counts),
        Check("traverse", "order", "What lies behind the nearest hit is skipped", _traverse_order),
        Check(
            "traverse",
            "embree",
            "Hit for hit with Embree on 65,536 triangles, with few tests",
            _traverse_embree,
            points=2.0,
        ),
    ),
    mistakes=(
        Mistake(
            "slab_test",
            "positive-only",
            "You enter by lo and leave by hi; where a direction's component is negative, it is the other way round.",
            _positive_only,
        ),
        Mistake(
            "slab_test",
            "clamped",
            "You cut t_near off at 0; behind the origin it is negative.",
            _clamped,
        ),
        Mistake(
            "slab_test",
            "any-slab",
            "You are in the box when between one pair of faces; it takes all three at once.",
            _any_slab,
        ),
        Mistake("slab_test", "first-box", "You test all rays with the first box.", _first_box),
        Mistake(
            "slab_test",
            "parallel-lost",
            "You lose every line with a component of zero.",
            _parallel_lost,
        ),
        Mistake(
            "slab_test",
            "face-lost",
            "You lose lines that run in the plane of a face: there zero is divided by zero.",
            _face_lost,
        ),
        Mistake(
            "slab_test",
            "parallel-kept",
            "You take no notice of faces that a line runs along; it may be outside them for ever.",
            _parallel_kept,
        ),
        Mistake(
            "build",
            "unsorted",
            "You divide the boxes in the order in which they come; neighbours should lie together.",
            _unsorted,
        ),
        Mistake(
            "build",
            "one-axis",
            "You always divide along the same axis; take the one where the boxes lie farthest apart.",
            _one_axis,
        ),
        Mistake(
            "build",
            "same-middle",
            "You don't divide boxes whose middles are the same; halves of them will do as well as any.",
            _same_endless,
        ),
        Mistake(
            "build",
            "leaf-too-large",
            "Your leaves are a little too large: a node of more than leaf_size boxes is an inner one.",
            _leaf_too_large,
        ),
        Mistake(
            "build",
            "middles-boxed",
            "Your nodes are boxes around the boxes' middles; they have to hold the boxes as a whole.",
            _middles_boxed,
        ),
        Mistake("build", "lost", "Some boxes are in no leaf.", _lost),
        Mistake(
            "traverse",
            "behind",
            "You find triangles behind the origin.",
            _behind,
        ),
        Mistake("traverse", "one-sided", "You find triangles from one side only.", _one_sided),
        Mistake(
            "traverse",
            "parallelogram",
            "Your triangles are parallelograms: the two coordinates together may not be over 1.",
            _parallelogram,
        ),
        Mistake(
            "traverse",
            "first-of-leaf",
            "You test only the first triangle of a leaf.",
            _first_of_leaf,
        ),
        Mistake(
            "traverse",
            "positions",
            "You name the position in order instead of the triangle that stands there.",
            _positions,
        ),
        Mistake(
            "traverse",
            "boxes-ignored",
            "You test triangles whose boxes the ray misses.",
            _boxes_ignored,
        ),
        Mistake(
            "traverse",
            "unordered",
            "Your hits are right, but you visit what lies behind them too: the nearer child comes first.",
            _unordered,
        ),
        Mistake(
            "traverse",
            "not-nearest",
            "What you find is hit, but not the nearest: boxes overlap, so the first leaf with a hit need not have it.",
            _not_nearest,
        ),
    ),
)
