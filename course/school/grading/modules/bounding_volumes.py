"""bounding_volumes declared: rays and boxes, hierarchies of boxes, and, in a file of its own, the way through one."""

from collections.abc import Mapping
from math import nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure
from course.school.grading.checks.declare import Arguments, Case, Law, Made, function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import Look, close, holds, law
from course.school.grading.checks.vectors import unit_vectors
from course.school.grading.modules.hierarchies import around, balanced, cost, spans, walkable
from course.school.grading.modules.traversing import TRAVERSE

SCALES = (1.0, 2.0**-10, 2.0**10)
"""Powers of two: corners of boxes are the same numbers in single and in double precision."""


# ---------------------------------------------------------------- slab_test


def _boxes(draw: Draw, thin: bool = False) -> tuple[Array, Array]:
    """Boxes (3, N) of unequal sides, one of them without length if they are to be thin."""
    lo = draw.lengths(-2, 1, 3, draw.n)
    sides = draw.lengths(0.2, 2, 3, draw.n)
    if thin:
        sides[draw.rng.integers(0, 3, draw.n), np.arange(draw.n)] = 0
    return lo.astype(draw.dtype).astype(float), (lo + sides).astype(draw.dtype).astype(float)


def _through(thin: bool = False) -> Case:
    """Rays that begin anywhere, inside too, and whose lines go through a point well within their box."""

    def case(draw: Draw) -> Mapping[str, Any]:
        lo, hi = _boxes(draw, thin)
        origins, directions = _aimed(lo, hi, draw)
        return {"lo": lo, "hi": hi, "origins": origins, "directions": directions}

    return case


def _aimed(lo: Array, hi: Array, draw: Draw) -> tuple[Array, Array]:
    """Origins anywhere and directions (3, N) through a point well within each box."""
    target = lo + draw.uniform(0.05, 0.95, 3, draw.n) * (hi - lo)
    # No component next to zero: parallels have a law of their own.
    d = draw.rng.uniform(0.05, 1, (3, draw.n)) * draw.rng.choice((-1.0, 1.0), (3, draw.n))
    return target - draw.lengths(-6, 6, draw.n) * d, d


def _one_box(draw: Draw) -> Mapping[str, Any]:
    """Rays whose lines go through one box."""
    one = dict(_through()(draw.but(n=1)))
    rays = [_aimed(one["lo"], one["hi"], draw.but(n=1)) for _ in range(draw.n)]
    origins, directions = (np.concatenate(part, axis=1) for part in zip(*rays, strict=True))
    lo, hi = one["lo"][:, 0], one["hi"][:, 0]
    return {"lo": lo, "hi": hi, "origins": origins, "directions": directions}


def _past(draw: Draw) -> Mapping[str, Any]:
    """Lines past the sphere around a box: slabs are crossed one after the other, never all at once."""
    found = dict(_through()(draw))
    center, radius = (found["lo"] + found["hi"]) / 2, found["hi"] - found["lo"]
    d = found["directions"]
    across = np.cross(d, unit_vectors(draw.rng, draw.n), axis=0)
    across *= draw.uniform(0.55, 1, draw.n) * np.linalg.norm(radius, axis=0)
    origins = center + across / np.linalg.norm(across / np.linalg.norm(radius, axis=0), axis=0)
    return found | {"origins": origins - draw.lengths(-6, 6, draw.n) * d}


HALF = np.array((1.0, 2.0, 3.0))
"""Of the sides of the box that lines run along."""

PLACES = (0.6, -0.25, 1.0, -1.0, 1.5, -4.0)
"""Between two faces, on them, and beside them."""


FAR = (100.0, 1e4, 1e9)
"""From where lines come that are nearly parallel to faces: the last in double precision only."""


def _along(draw: Draw) -> Mapping[str, Any]:
    """Lines along the faces of one box: one component or two are +0 or -0, or one so small that far away it matters."""
    columns = np.arange(draw.n)
    axis = draw.rng.integers(0, 3, draw.n)
    o = np.where(draw.rng.random((3, draw.n)) < 0.5, -8.0, 8.0)
    d = -o / 8
    for turn in (0, 1):
        chosen = (axis + turn) % 3
        zero = draw.rng.random(draw.n) < (1.0, 0.5)[turn]
        place = draw.rng.choice(PLACES, draw.n) * HALF[chosen]
        o[chosen, columns] = np.where(zero, place, o[chosen, columns])
        null = draw.rng.choice((0.0, -0.0), draw.n)
        d[chosen, columns] = np.where(zero, null, d[chosen, columns])
    # Some lines have the box behind them.
    d *= draw.rng.choice((1.0, 1.0, -1.0), draw.n)
    # And some begin between two faces and leave, or come from beside them, a long way before the box.
    for k in np.flatnonzero(draw.rng.random(draw.n) < 0.3):
        far = draw.rng.choice(FAR if draw.dtype is np.float64 else FAR[:2])
        before, there = draw.rng.permutation((0.5, 1.6)) * draw.rng.choice((-1.0, 1.0), 2)
        near, other, main = (axis[k] + np.arange(3)) % 3
        o[near, k], d[near, k] = before * HALF[near], (there - before) * HALF[near] / far
        o[other, k], d[other, k] = 0, 0
        d[main, k] = draw.rng.choice((-1.0, 1.0))
        o[main, k] = -far * d[main, k]
    return {
        "origins": draw.scale * o,
        "directions": d,
        "lo": -draw.scale * HALF,
        "hi": draw.scale * HALF,
    }


def _spans(a: Arguments, r: Any) -> tuple[Any, ...]:
    """Where lines enter the last slab and leave the first; no component of theirs is zero."""
    lo, hi = (np.broadcast_to(x.reshape(3, -1), a.origins.shape) for x in (a.lo, a.hi))
    reach = np.abs(np.stack((a.origins, lo, hi))).max(axis=(0, 1))
    size = 2 * reach / np.abs(a.directions).min(axis=0)
    return np.stack(r), np.stack(spans(lo, hi, a.origins, a.directions)), size


def _between(a: Arguments, r: Any) -> Any:
    """Whether exactly those lines are met that are between all faces at the same time, and where they should."""
    o, d = (np.asarray(v, np.float64) for v in (a.origins, a.directions))
    lo, hi = (np.asarray(v, np.float64)[:, None] for v in (a.lo, a.hi))
    near, far = spans(lo, hi, o, d)
    slack = 1e-4 * (np.abs(near) + np.abs(far) + np.ptp((lo, hi)))
    # Of lines that miss, both may be infinite.
    with np.errstate(invalid="ignore"):
        alike = (np.abs(r[0] - near) <= slack) & (np.abs(r[1] - far) <= slack)
    return np.where(near <= far, (r[0] <= r[1]) & alike, r[0] > r[1])


SLAB_TEST = function(
    "bounding_volumes.slab_test",
    dict.fromkeys(("lo", "hi"), Made(single=True)),
    (
        holds(
            "misses",
            "Where a line misses, t_near > t_far",
            lambda _, r: r[0] > r[1],
            "t_near > t_far for a line past the box",
            "It has to be between all three pairs of faces at the same time.",
            case=_past,
            scales=SCALES,
        ),
        holds(
            "parallel",
            "Components of +0 or -0, or next to 0: between two faces, beside them, on them",
            _between,
            "a line that runs along faces to be met just where it is between them, on them counts",
            "Along two faces: between them for all t or for none. Zero over zero is no number. A component that is not "
            "zero is none of these: far away it leads to the box, or past it.",
            case=_along,
            n=200,
            scales=SCALES,
        ),
        close(
            "flat",
            "Boxes without thickness are met",
            _spans,
            "A triangle along an axis has a box without thickness.",
            what="of a box without thickness, t_near (row 0) or t_far (1):",
            case=_through(thin=True),
        ),
        close(
            "one_box",
            "Three lines through one box are no other case",
            _spans,
            "A box is (3,) or (3, N): the number of axes tells one box from many, not the number of lines.",
            what="of one box for three lines, t_near (row 0) or t_far (1):",
            case=_one_box,
            n=3,
        ),
        close(
            "through",
            "Lines through boxes enter at t_near and leave at t_far",
            _spans,
            "In the box is between all three pairs of faces at once; behind the origin t is negative.",
            what="t_near (row 0) or t_far (1):",
            scales=SCALES,
            role="core",
        ),
    ),
    contract="origins: 3 N, directions: 3 N, lo: 3 N, hi: 3 N -> t_near: infinite N, t_far: infinite N",
    case=_through(),
)


# ---------------------------------------------------------------- build


def _small(draw: Draw, n: int, spread: Any = 1.0) -> dict[str, Array]:
    """Small boxes anywhere in a larger one."""
    middle = draw.lengths(-1, 1, 3, n) * np.reshape(spread, (-1, 1))
    half = draw.scale * draw.rng.uniform(0.001, 0.02, (3, n))
    return {"lo": middle - half, "hi": middle + half}


def _any_boxes(draw: Draw) -> Mapping[str, Any]:
    """Boxes of all sorts: one, some, a long row, the same again and again, points ever farther away."""
    n = max(draw.n, 1)
    same = np.ones((3, n))
    far = same * 10.0 ** np.linspace(-6, 6, n)
    sorts = (
        _small(draw, n),
        _small(draw, n, (30, 0.1, 0.1)),
        _small(draw, 1 + n % 3),
        {"lo": 0 * same, "hi": same},
        {"lo": far, "hi": far},
    )
    return sorts[draw.rng.integers(len(sorts))]


SPREADS = {
    "anywhere in a cube": (1, 1, 1),
    "in a row along x": (50, 1, 1),
    "in a row along y": (1, 50, 1),
    "in a row along z": (1, 1, 50),
    "on a floor": (20, 0.05, 20),
}


def _held(a: Arguments, r: Any) -> None:
    """Every box is in one leaf of a hierarchy that can be walked."""
    (_, _, first, count, order), _ = walkable(r, a.lo.shape[1])
    held = [order[f : f + c] for f, c in zip(first, count, strict=True) if c > 0]
    boxes = a.lo.shape[1]
    times = np.bincount(np.concatenate(held).clip(0, boxes), minlength=boxes)
    if times.size > boxes or order.min() < 0 or (times != 1).any():
        k = int(np.argmax(times != 1))
        raise Failure(
            "every box in exactly one leaf",
            f"box {k} in {times[k]}",
            f"{boxes} boxes, leaf_size {a.leaf_size}",
            "Both halves together are the whole, also where it is odd.",
        )


def _leaves(a: Arguments, r: Any) -> None:
    walkable(r, a.lo.shape[1])
    if r[3].max() > a.leaf_size:
        raise Failure(
            f"leaves of at most {a.leaf_size}",
            f"one of {r[3].max():g}",
            f"{a.lo.shape[1]} boxes",
            "A node is divided while it holds more than leaf_size; boxes with the same middle, too.",
        )


def _tight(a: Arguments, r: Any) -> None:
    """Each node's box is the smallest around all that is below it."""
    boxes = around(*walkable(r, a.lo.shape[1]), a.lo, a.hi)
    for what, box, expected in zip(("lo", "hi"), r, boxes, strict=False):
        wrong = np.flatnonzero((box != expected).any(axis=0))
        if wrong.size:
            k = int(wrong[0])
            raise Failure(
                f"{what} of {'leaf' if r[3][k] > 0 else 'inner node'} {k} to be {expected[:, k].tolist()}",
                f"{box[:, k].tolist()}",
                f"{a.lo.shape[1]} boxes; {wrong.size} of {r[3].size} nodes",
                "The smallest box around all that is below the node, bit for bit.",
            )


MANY, LEAF, CHEAP = 1101, 4, 2.0
"""Boxes, most that a leaf may hold, and times the mean tests of halves along the longest axis."""


def _ordinary(draw: Draw) -> Mapping[str, Any]:
    spread = list(SPREADS.values())[draw.rng.integers(len(SPREADS))]
    return _small(draw, max(draw.n, 1), spread) | {"leaf_size": LEAF}


def _useful(a: Arguments, r: Any) -> None:
    """A hierarchy that loses nothing, and whose nodes are small."""
    _held(a, r)
    hierarchy, levels = walkable(r, a.lo.shape[1])
    low, high = around(hierarchy, levels, a.lo, a.hi)
    if (r[0] > low).any() or (r[1] < high).any():
        raise Failure("boxes around all that is below their nodes", "smaller ones")
    if a.lo.shape[1] == MANY:
        # As many as halves make leaves alike of.
        limit = CHEAP * cost(balanced(a.lo[:, :1024], a.hi[:, :1024], 8))
        # Beside a larger root all other boxes would be small.
        tests = cost(hierarchy, (low[:, :1], high[:, :1]))
        if not tests <= limit:
            sides = np.ptp(a.lo, axis=1)
            raise Failure(
                f"at most {limit:.0f} tests of a random line, by the nodes' surfaces",
                f"{tests:.0f}",
                f"{MANY} boxes in a space of {sides[0]:.2g} x {sides[1]:.2g} x {sides[2]:.2g}, leaf_size {LEAF}",
                "What lies together should be near each other: then boxes are small, and rays miss them.",
            )


EMPTY = {"lo": np.zeros((3, 0)), "hi": np.zeros((3, 0))}


def _sorts(name: str, title: str, look: Look) -> Law:
    return law(name, title, look, case=_any_boxes, n=101, scales=(1.0,) * 8)


BUILD = function(
    "bounding_volumes.build",
    {
        "lo": Made(wrong=(EMPTY,)),
        "leaf_size": Made(lambda d: int(d.rng.integers(1, 6)), (0, -1, 1.5, nan)),
    },
    (
        _sorts("once", "Every box is in exactly one leaf", _held),
        _sorts("leaves", "No leaf holds more than leaf_size", _leaves),
        _sorts("contains", "Each node's box is the smallest around what is below it", _tight),
        law(
            "cost",
            "Nodes lose no box, and are small, so that rays miss them",
            _useful,
            case=_ordinary,
            n=MANY,
            scales=(1.0,) * 6,
            role="core",
        ),
    ),
    case=lambda d: _small(d, max(d.n, 1)),
    columns=False,
    unique=False,
    speed=2048,
)

FUNCTIONS = (SLAB_TEST, BUILD, TRAVERSE)
