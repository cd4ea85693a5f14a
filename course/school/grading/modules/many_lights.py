"""many_lights declared: lamps by power, cones around cones, light trees, what a node can send, and walks.

Trees are made here, so that a walk pays for no mistake of ``light_tree``. Points keep away from where importance jumps.
"""

from collections.abc import Mapping
from dataclasses import replace
from math import nan, pi
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure
from course.school.grading.checks.declare import Arguments, Case, Made, directions, function
from course.school.grading.checks.drawing import Draw, worst_directions
from course.school.grading.checks.laws import close, holds, law, within
from course.school.grading.checks.vectors import dot, unit_vectors
from course.school.grading.modules.light_trees import (
    ALL,
    Tree,
    apart,
    bounded,
    grown,
    intervals,
    lamps,
    merged,
    narrowed,
    seen,
    squared,
)

INSIDE = 0.05
"""Share of a lamp's part of [0, 1) next to its ends where nothing is asked for."""

SCALES = (1.0, 1e-6, 1e6)

FAINT = (1e-15,)
"""Power of lamps that are the only ones there are."""

# ---------------------------------------------------------------- power_choice


def _powers(draw: Draw) -> Array:
    """Powers (L,), some of them 0."""
    power = draw.lengths(0.5, 4, 4 if draw.simple else int(draw.rng.integers(1, 40)))
    power[draw.rng.random(power.size) < 0.3] = 0
    power[int(draw.rng.integers(power.size))] = 6 * draw.scale
    return power


def _in_parts(draw: Draw) -> Mapping[str, Any]:
    """Numbers within the parts of lamps that have power."""
    power = _powers(draw)
    lamp = draw.rng.choice(np.flatnonzero(power), draw.n)
    place = INSIDE + (1 - 2 * INSIDE) * draw.rng.random(draw.n)
    return {"power": power, "u": (power.cumsum()[lamp] - (1 - place) * power[lamp]) / power.sum()}


def _at_ends(draw: Draw) -> Mapping[str, Any]:
    """Numbers that are sums themselves, and lamps without power around them."""
    last = float(np.nextafter(draw.dtype(1), draw.dtype(0)))
    return {
        "power": np.array([0.0, 2, 0, 0, 2, 4, 0]),
        "u": draw.rng.choice((0.0, 0.25, 0.5, last), draw.n),
    }


def _below_one(draw: Draw) -> Mapping[str, Any]:
    """Lamps whose shares add up to less than 1 by rounding, the last ones without power, and the largest number."""
    last = float(np.nextafter(draw.dtype(1), draw.dtype(0)))
    power, shares = np.zeros(1), np.ones(1)
    # Sums one after the other, of shares and over the sum of all at once: about every fifth draw rounds both down.
    while not max(shares.cumsum()[-1], power.cumsum()[-1] / (power.sum() or 1)) < 1:
        power = draw.rng.uniform(0.5, 4, 1500)
        power[-int(draw.rng.integers(1, 9)) :] = 0
        shares = power / power.sum()
    return {"power": power, "u": np.full(draw.n, last)}


def _lamp_of(a: Arguments) -> Array:
    """The lamp whose part each number falls in."""
    sums = np.cumsum(a.power) / np.sum(a.power)
    return np.asarray((sums[:, None] <= a.u).sum(axis=0).clip(0, a.power.size - 1))


POWER_CHOICE = function(
    "many_lights.power_choice",
    {
        "power": Made(
            _powers,
            (np.array([1.0, -1.0]), np.array([1.0, nan]), np.zeros(3), np.zeros(0)),
            batch=False,
        )
    },
    (
        holds(
            "black",
            "A lamp without power is never chosen, not even at the ends of its neighbours' parts",
            lambda a, r: a.power[r[0].clip(0, 6)] > 0,
            "a lamp that has power",
            "A number that is equal to a sum belongs to the lamp behind it.",
            shows=lambda _, r: r[0],
            case=_at_ends,
        ),
        holds(
            "last",
            "The largest number chooses a lamp that has power, even where shares round to less than 1 together",
            lambda a, r: a.power[r[0].clip(0, a.power.size - 1)] > 0,
            "a lamp that has power",
            "What finds no sum above it belongs to the last lamp that has power, not to the last lamp.",
            shows=lambda _, r: r[0],
            case=_below_one,
            n=3,
        ),
        close(
            "share",
            "The probability is the chosen lamp's share of the power",
            lambda a, r: (r[1], a.power[r[0].clip(0, a.power.size - 1)] / a.power.sum()),
            "Its own power over that of all lamps.",
            what="a probability of",
            scales=SCALES,
            role="core",
        ),
        close(
            "faint",
            "Faint lamps have the shares of bright ones",
            lambda a, r: (r[1], a.power[r[0].clip(0, a.power.size - 1)] / a.power.sum()),
            "Only a sum of 0 can't be divided by.",
            what="of faint lamps, a probability of",
            scales=FAINT,
        ),
        close(
            "values",
            "Lamps and their probabilities are right together",
            lambda a, r: (
                np.stack(r),
                np.stack((_lamp_of(a), a.power[_lamp_of(a)] / a.power.sum())),
                1.0,
            ),
            "The lamps divide [0, 1) among themselves: look for u among the sums of their shares.",
            what="a lamp or a probability of",
            case=_in_parts,
            scales=SCALES,
            whole=True,
        ),
    ),
    case=lambda d: {"power": _powers(d)},
    scales=(),
)

# ---------------------------------------------------------------- merge_cones


def _two_cones(draw: Draw) -> Mapping[str, Any]:
    """Cones of any angles, narrow ones above all."""
    return {
        name: narrowed(
            draw, np.where(draw.rng.random(draw.n) < 0.2, 0, draw.uniform(0, 1.3, draw.n))
        )
        for name in ("angle_a", "angle_b")
    } | {name: draw.directions() for name in ("axis_a", "axis_b")}


def _around(draw: Draw, axis: Array, angle: Array) -> Array:
    """Unit vectors (3, N) at angles from axes."""
    other = unit_vectors(draw.rng, axis.shape[1])
    across = np.cross(axis, other, axis=0)
    across /= np.linalg.norm(across, axis=0)
    return np.asarray(np.cos(angle) * axis + np.sin(angle) * across)


def _nested(draw: Draw) -> Mapping[str, Any]:
    """One cone well within the other, either of the two."""
    axis, narrow = draw.directions(), draw.rng.uniform(0, 0.6, draw.n)
    turn = draw.rng.uniform(0.05, 0.9, draw.n)
    wide = narrow + turn + draw.rng.uniform(0.05, 1, draw.n)
    inner, swap = _around(draw, axis, turn), draw.rng.random(draw.n) < 0.5
    return {
        "axis_a": np.where(swap, inner, axis),
        "angle_a": np.where(swap, narrow, wide),
        "axis_b": np.where(swap, axis, inner),
        "angle_b": np.where(swap, wide, narrow),
    }


def _filling(draw: Draw) -> Mapping[str, Any]:
    """Cones that fill all directions together, or of which one does so alone."""
    angle = draw.rng.choice((2.0, 2.8, ALL), (2, draw.n))
    axis = draw.directions()
    turn = np.maximum(2 * pi - angle.sum(axis=0), 0)
    turn = turn + draw.rng.uniform(0.1, 0.9, draw.n) * (pi - turn)
    return {
        "axis_a": axis,
        "angle_a": angle[0],
        "axis_b": _around(draw, axis, turn),
        "angle_b": angle[1],
    }


def _aligned(draw: Draw) -> Mapping[str, Any]:
    """Axes that are equal or opposite, or nearly."""
    axis = np.repeat(np.eye(3), 2, axis=1)[:, draw.rng.integers(0, 6, draw.n)]
    nearly = draw.rng.choice((False, True), draw.n)
    near = _around(draw, axis, draw.rng.choice((0.004, 0.012), draw.n))
    return {
        "axis_a": axis,
        "angle_a": draw.rng.choice((0.0, 0.5, 1.0), draw.n),
        "axis_b": np.where(nearly, near, axis) * draw.rng.choice((1.0, -1.0), draw.n),
        "angle_b": draw.rng.choice((0.0, 0.25, 1.5), draw.n),
    }


def _nearly_one_axis(draw: Draw) -> Mapping[str, Any]:
    """Narrow cones whose axes are so near to each other that a cosine hardly tells them apart."""
    axis = draw.directions()
    turn = 10.0 ** draw.rng.uniform(-4, -2.5, draw.n)
    return {
        "axis_a": axis,
        "angle_a": turn * draw.uniform(0, 0.9, draw.n),
        "axis_b": _around(draw, axis, turn),
        "angle_b": turn * draw.uniform(0, 0.9, draw.n),
    }


def _expected_cone(a: Arguments, r: Any) -> tuple[Any, ...]:
    axis, angle, told = merged(a.axis_a, a.angle_a, a.axis_b, a.angle_b)
    found = np.concatenate((np.where(told, r[0], axis), r[1][None]))
    return found, np.concatenate((axis, angle[None])), 1.0


def _both_inside(a: Arguments, r: Any) -> Array:
    """By how much each cone looks out of the result, (2, N)."""
    ways = ((a.axis_a, a.angle_a), (a.axis_b, a.angle_b))
    reach = np.array([np.minimum(apart(r[0], axis) + angle, ALL) for axis, angle in ways])
    return np.asarray(np.maximum(reach - r[1], 0).max(axis=0))


CONE = Made(
    lambda d: narrowed(d, d.uniform(0, pi, d.n)), corners=lambda t: np.array([0, 1e-4, 1.5, pi], t)
)

MERGE_CONES = function(
    "many_lights.merge_cones",
    {
        "axis_a": directions(),
        "angle_a": CONE,
        "axis_b": Made(lambda d: d.directions(), corners=lambda t: worst_directions(t)[:, ::7]),
        "angle_b": CONE,
    },
    (
        close(
            "nested",
            "A cone that holds the other is the result",
            _expected_cone,
            "The wide one stays as it is, whether it comes first or second.",
            what="a component, or in the last row an angle, of",
            floor=2e-5,
            case=_nested,
        ),
        close(
            "all",
            "Cones that fill all directions together give pi",
            lambda _, r: (r[1], pi),
            "No angle is larger than pi.",
            what="an angle of",
            case=_filling,
        ),
        within(
            "aligned",
            "Axes that are equal or opposite, or nearly: both cones are inside",
            _both_inside,
            0,
            0,
            "Opposite axes span no plane; any will do. Equal ones need none. Nearly equal ones do: a wide cone need "
            "not hold a narrow one.",
            what="a part of the cones outside, in radians,",
            slack=1e-3,
            case=_aligned,
        ),
        close(
            "narrow",
            "Cones next to each other have the right angle around them",
            lambda a, r: (r[1], merged(a.axis_a, a.angle_a, a.axis_b, a.angle_b)[1], 1.0),
            "The cosine of a small angle is 1 less half of its square: an arcus cosine in float32 loses half of the "
            "digits. The chord between the axes, or both sine and cosine, keep them.",
            what="an angle of",
            case=_nearly_one_axis,
        ),
        within(
            "inside",
            "Both cones are inside the result",
            _both_inside,
            0,
            0,
            what="a part of the cones outside, in radians,",
            slack=1e-3,
            case=_two_cones,
            role="core",
        ),
        close(
            "values",
            "The cone is the narrowest around both",
            _expected_cone,
            "Its sides touch both: its angle is half of what lies between the outermost sides.",
            what="a component, or in the last row an angle, of",
            floor=2e-4,
            case=_two_cones,
            whole=True,
        ),
    ),
    scales=(),
    contract="axis_a: 3 N, angle_a: N, axis_b: 3 N, angle_b: N -> axis: unit 3 N, angle: N",
)

# ---------------------------------------------------------------- light_tree


def _some(draw: Draw) -> Mapping[str, Any]:
    """Any number of lamps."""
    return lamps(draw, max(draw.n, 1))


def _sorts(draw: Draw) -> Mapping[str, Any]:
    """From one lamp on, all at one place, and in a row."""
    count = int(draw.rng.choice((1, 2, 3, 4, 7, 12, 33)))
    own = lamps(draw, count)
    sort = int(draw.rng.integers(3))
    if sort == 1:
        own |= {"lo": np.ones((3, count)), "hi": np.ones((3, count))}
    if sort == 2:
        own["lo"][1:], own["hi"][1:] = 0, 0
    return own


def _right_sizes(a: Arguments, r: Any) -> None:
    """As many nodes as there are, and every lamp in one leaf. Raises Failure."""
    count = a.power.size
    if r[4].size != 2 * count - 1:
        raise Failure(
            f"{2 * count - 1} nodes for {count} lamps",
            f"{r[4].size}",
            hint="L leaves, and L - 1 nodes above them.",
        )
    if not np.array_equal(np.sort(r[5]), np.arange(count)):
        raise Failure(
            "every lamp in one leaf",
            f"order = {r[5][:8].tolist()}",
            f"{count} lamps",
            "order is a permutation of 0 to L - 1.",
        )


def _node(name: str, a: Arguments, k: int, expected: Any, found: Any) -> Failure:
    kind = "leaf" if k >= a.power.size - 1 else "inner node"
    told = [np.round(np.asarray(x, np.float64), 6).tolist() for x in (expected, found)]
    return Failure(f"{name} of {kind} {k} to be {told[0]}", f"{told[1]}", f"{a.power.size} lamps")


def _below(a: Arguments, r: Any, part: int) -> Array:
    """What each node should hold, by the leaves' lamps and by its children's own."""
    count = a.power.size
    whole = np.array(r[part], np.float64)
    whole[..., count - 1 :] = tuple(a.values())[part][..., r[5]]
    merge = {0: np.minimum, 1: np.maximum, 4: np.add}[part]
    for k in reversed(range(count - 1)):
        whole[..., k] = merge(whole[..., 2 * k + 1], whole[..., 2 * k + 2])
    return whole


def _boxes(a: Arguments, r: Any) -> None:
    _right_sizes(a, r)
    for part, name in enumerate(("lo", "hi")):
        expected = _below(a, r, part)
        wrong = np.flatnonzero((r[part] != expected).any(axis=0))
        if wrong.size:
            k = int(wrong[-1])
            raise _node(name, a, k, expected[:, k], r[part][:, k])


def _sums(a: Arguments, r: Any) -> None:
    _right_sizes(a, r)
    expected = _below(a, r, 4)
    wrong = np.flatnonzero(~(np.abs(r[4] - expected) <= 1e-5 * expected))
    if wrong.size:
        k = int(wrong[-1])
        raise _node("power", a, k, expected[k], r[4][k])


def _cones(a: Arguments, r: Any) -> None:
    """Leaves have their lamps' cones, inner nodes the narrowest around their children's."""
    _right_sizes(a, r)
    inner = a.power.size - 1
    axis, angle = np.array(r[2]), np.array(r[3])
    told = np.ones(angle.size, bool)
    axis[:, inner:], angle[inner:] = a.axis[:, r[5]], a.angle[r[5]]
    one, two = slice(1, None, 2), slice(2, None, 2)
    axis[:, :inner], angle[:inner], told[:inner] = merged(
        r[2][:, one], r[3][one], r[2][:, two], r[3][two]
    )
    turned = told & (apart(r[2], axis) > 1e-2)
    # A lamp that shines to all sides has no axis that counts.
    wrong = np.flatnonzero((np.abs(r[3] - angle) > 1e-3) | (turned & (angle < ALL)))
    if wrong.size:
        k = int(wrong[-1])
        found = (*r[2][:, k], r[3][k])
        raise _node("axis and angle", a, k, (*axis[:, k], angle[k]), found)


def _all_of_it(a: Arguments, r: Any) -> None:
    _boxes(a, r)
    _sums(a, r)
    _cones(a, r)


MANY, LARGE = 300, 2.0
"""Lamps, and times the measure of division along the longest axis."""


def _measure(a: Arguments, order: Array) -> float:
    """Sum over inner nodes of their power times their squared diagonal, for lamps in that order of leaves."""
    count = order.size
    lo, hi, power = (
        np.concatenate((x[..., :1].repeat(count - 1, -1), x[..., order]), axis=-1)
        for x in (a.lo, a.hi, a.power)
    )
    for k in range(count - 2, -1, -1):
        both = [2 * k + 1, 2 * k + 2]
        lo[:, k], hi[:, k] = lo[:, both].min(axis=1), hi[:, both].max(axis=1)
        power[k] = power[both].sum()
    inside = slice(count - 1)
    return float((power[inside] * ((hi - lo)[:, inside] ** 2).sum(axis=0)).sum())


def _longest(a: Arguments) -> Array:
    """The lamps of the leaves where each node divides its lamps along their longest axis."""
    count = a.power.size
    held = {0: np.arange(count)}
    sizes = dict.fromkeys(range(count - 1, 2 * count - 1), 1)
    for k in range(count - 2, -1, -1):
        sizes[k] = sizes[2 * k + 1] + sizes[2 * k + 2]
    centre = a.lo / 2 + a.hi / 2
    for k in range(count - 1):
        own = held.pop(k)
        along = centre[np.argmax(np.ptp(centre[:, own], axis=1)), own]
        held[2 * k + 1], held[2 * k + 2] = np.split(own[np.argsort(along)], [sizes[2 * k + 1]])
    return np.array([held[k][0] for k in range(count - 1, 2 * count - 1)])


def _spread(draw: Draw) -> Mapping[str, Any]:
    """Lamps in a room, in a street, and on a ceiling."""
    own = lamps(draw, max(draw.n, 1))
    sides = ((1, 1, 1), (30, 0.5, 0.5), (0.3, 0.3, 20), (8, 0.1, 8))
    stretch = np.array(sides[int(draw.rng.integers(4))])[:, None]
    return own | {"lo": own["lo"] * stretch, "hi": own["hi"] * stretch}


def _small(a: Arguments, r: Any) -> None:
    _right_sizes(a, r)
    limit, found = LARGE * _measure(a, _longest(a)), _measure(a, r[5])
    if not found <= limit:
        raise Failure(
            f"at most {limit:.4g} W m^2, summed over the inner nodes' powers times squared diagonals",
            f"{found:.4g}",
            f"{a.power.size} lamps",
            "Lamps that lie near each other belong together: divide along the longest axis.",
        )


LIGHT_TREE = function(
    "many_lights.light_tree",
    {"lo": Made(wrong=(np.zeros((3, 0)),))},
    (
        law(
            "order", "Every lamp is in one leaf", _right_sizes, case=_sorts, scales=(1.0,) * 8, n=9
        ),
        law(
            "boxes",
            "Each node's box is the smallest around its lamps",
            _boxes,
            case=_sorts,
            scales=(1.0,) * 8,
            n=9,
        ),
        law("sums", "Each node's power is the sum over its lamps", _sums, case=_sorts, n=9),
        law(
            "cones",
            "Each node's cone is the narrowest around its children's",
            _cones,
            case=_sorts,
            scales=(1.0,) * 8,
            n=9,
        ),
        law(
            "small", "Nodes are small", _small, case=_spread, n=MANY, scales=(1.0,) * 4, role="core"
        ),
        law("tree", "Boxes, cones and powers are right together", _all_of_it, n=50, whole=True),
    ),
    case=_some,
    columns=False,
    unique=False,
    speed=0,
)

# ---------------------------------------------------------------- importance


def _node_of(draw: Draw, least: float, most: float) -> dict[str, Any]:
    """Boxes of any sides, and points as many times half a diagonal away from their middles."""
    half = draw.scale * draw.rng.uniform(0.05, 1, (3, draw.n))
    middle = draw.lengths(-3, 3, 3, draw.n)
    radius = np.linalg.norm(half, axis=0)
    way = radius * draw.rng.uniform(least, most, draw.n) * unit_vectors(draw.rng, draw.n)
    return {
        "lo": middle - half,
        "hi": middle + half,
        "axis": draw.directions(),
        "angle": narrowed(draw, draw.rng.choice((0.0, 0.4, 1.2, ALL), draw.n)),
        "power": draw.number(0.02, 50) * draw.uniform(0.5, 4, draw.n),
        "p": middle + way,
        "n": draw.directions(),
    }


def _inside(draw: Draw) -> Mapping[str, Any]:
    """Points in the middle of boxes, too, to the last bit: sides and middles are whole 64ths."""
    found = _node_of(draw, 0, 0.8)
    lo, half = (np.ceil(64 * x) / 64 for x in (found["lo"], found["hi"] / 2 - found["lo"] / 2))
    in_middle = draw.rng.random(draw.n) < 0.25
    return found | {
        "lo": np.where(in_middle, lo, found["lo"]),
        "hi": np.where(in_middle, lo + 2 * half, found["hi"]),
        "p": np.where(in_middle, lo + half, found["p"]),
    }


def _outside(draw: Draw) -> Mapping[str, Any]:
    return _node_of(draw, 1.2, 6)


def _anywhere(draw: Draw) -> Mapping[str, Any]:
    near, far = _node_of(draw, 0, 0.8), _node_of(draw, 1.2, 20)
    inside = draw.rng.random(draw.n) < 0.2
    return {name: np.where(inside, near[name], far[name]) for name in near}


def _point_lamps(draw: Draw) -> Mapping[str, Any]:
    """Lamps without size that shine to all sides."""
    lamp = draw.lengths(-3, 3, 3, draw.n)
    return {"lo": lamp, "hi": lamp, "angle": np.full(draw.n, pi)} | {
        name: value for name, value in _outside(draw).items() if name in ("axis", "power", "n", "p")
    }


def _of_points(a: Arguments, r: Array) -> tuple[Any, ...]:
    way = a.lo - a.p
    far = np.linalg.norm(way, axis=0)
    return r, a.power * np.maximum(dot(a.n, way) / far, 0) / far**2, a.power / far**2


def _turned_away(draw: Draw) -> Mapping[str, Any]:
    """Nodes that lie below the surface as a whole, or whose cones point away from it with all they have."""
    own = _node_of(draw, 3, 6)
    way = own["lo"] / 2 + own["hi"] / 2 - own["p"]
    way /= np.linalg.norm(way, axis=0)
    below = draw.rng.random(draw.n) < 0.5
    return own | {
        "n": np.where(below, _around(draw, -way, draw.rng.uniform(0, 0.8, draw.n)), way),
        "axis": np.where(below, -way, _around(draw, way, draw.rng.uniform(0, 0.2, draw.n))),
        "angle": np.full(draw.n, 0.4),
    }


def _in_place(draw: Draw) -> Mapping[str, Any]:
    lamp = draw.lengths(-3, 3, 3, draw.n)
    return {**_outside(draw), "lo": lamp, "hi": lamp, "p": lamp}


def _sent(a: Arguments, r: Array) -> Array:
    """What lamps in the box send, at the distances of the box, over what is claimed to be the most, (N,)."""
    rng = np.random.default_rng(3)
    most = np.zeros(a.power.size)
    for _ in range(20):
        lamp = a.lo + rng.random(a.lo.shape) * (a.hi - a.lo)
        draw = Draw(rng, a.power.size)
        normal = _around(draw, a.axis, rng.random(a.power.size) * a.angle)
        way = lamp - a.p
        way /= np.linalg.norm(way, axis=0)
        cosines = np.maximum(dot(a.n, way), 0) * np.maximum(-dot(normal, way), 0)
        most = np.maximum(most, cosines)
    scale = a.power / squared((a.lo, a.hi), a.p)
    return np.asarray(most - r / scale)


def _importance(a: Arguments, r: Array) -> tuple[Any, ...]:
    parts = (a.lo, a.hi, a.axis, a.angle, a.power)
    scale = a.power / squared(parts, a.p)
    return r, scale * bounded(parts, a.p, a.n), scale


IMPORTANCE = function(
    "many_lights.importance",
    {},
    (
        close(
            "points",
            "A lamp without size sends its power times the cosine over the squared distance",
            _of_points,
            "All angles but that at the surface are 0.",
            what="an importance of",
            floor=1e-3,
            case=_point_lamps,
        ),
        close(
            "away",
            "What lies below the surface, or shines away from it, counts nothing",
            lambda a, r: (r * squared((a.lo, a.hi), a.p) / a.power, 0.0),
            "Cosines below 0 count as 0.",
            what="an importance, over power and distances, of",
            floor=1e-6,
            case=_turned_away,
        ),
        close(
            "inside",
            "From inside the sphere around the box both cosines are 1",
            lambda a, r: (r * squared((a.lo, a.hi), a.p) / a.power, 1.0),
            "Lamps may lie in any direction; and each of the distances has a least.",
            what="an importance, over power and distances, of",
            floor=1e-5,
            case=_inside,
        ),
        close(
            "in_place",
            "A lamp without size sends nothing to its own place",
            lambda _, r: (r, 0.0),
            "It must not hold 0 / 0.",
            what="an importance of",
            case=_in_place,
        ),
        within(
            "bound",
            "No lamp in the box sends more, at the same distances",
            _sent,
            -np.inf,
            0,
            "The cosines are as large as they can be for a lamp anywhere in the sphere.",
            what="what a lamp sends more",
            slack=1e-3,
            case=lambda d: _node_of(d, 1.2, 3),
            role="core",
        ),
        close(
            "values",
            "Importance is power times two cosines over two distances",
            lambda a, r: (r / (x := _importance(a, r))[2], x[1] / x[2], 1.0),
            "Both angles lose the sphere's own, the second by the cone's too; both distances have a least.",
            what="an importance, over power and distances, of",
            floor=2e-3,
            case=_anywhere,
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_anywhere,
    scales=SCALES,
    contract="lo: 3 N, hi: 3 N, axis: 3 N, angle: N, power: N, p: 3 N, n: 3 N -> the importance: N",
)

# ---------------------------------------------------------------- walks


def _tree(draw: Draw, count: int | None = None) -> Tree:
    if count is None:
        count = 3 if draw.simple else int(draw.rng.choice((5, 6, 8, 11)))
    return grown(draw, **lamps(draw, count))


def _exact(tree: Tree) -> Tree:
    lo, hi, axis, angle, power = (part.astype(np.float64) for part in tree[:5])
    return lo, hi, axis, angle, power, tree[5]


def _walks(draw: Draw) -> Mapping[str, Any]:
    """A tree, and points that see it."""
    tree = _tree(draw)
    p, n = seen(draw, tree)
    return {"tree": tree, "p": p, "n": n}


def _one_lamp(draw: Draw) -> Mapping[str, Any]:
    """A tree of one node."""
    tree = _tree(draw, 1)
    p, n = seen(draw, tree)
    return {"tree": tree, "p": p, "n": n}


def _faint(case: Case) -> Case:
    """The same with lamps of hardly any power."""

    def faint(draw: Draw) -> Mapping[str, Any]:
        found = dict(case(draw))
        lo, hi, axis, angle, power, order = found["tree"]
        return found | {"tree": (lo, hi, axis, angle, power * draw.dtype(FAINT[0]), order)}

    return faint


def _walks_to(draw: Draw) -> Mapping[str, Any]:
    """Numbers well within the parts of lamps that aren't too rare."""
    found = dict(_walks(draw))
    low, length = intervals(_exact(found["tree"]), found["p"], found["n"])
    lamp = (np.where(length > 2e-3, 1, -1) + draw.rng.random(length.shape)).argmax(axis=0)
    column = np.arange(draw.n)
    place = INSIDE + (1 - 2 * INSIDE) * draw.rng.random(draw.n)
    return found | {"u": low[lamp, column] + place * length[lamp, column]}


def _chosen(a: Arguments) -> tuple[Array, Array]:
    """The lamp (N,) of each number, and its probability."""
    low, length = intervals(_exact(a.tree), a.p, a.n)
    lamp = np.where(length > 0, low <= a.u, False)
    lamp = np.where(lamp, low, -1).argmax(axis=0)
    return lamp, length[lamp, np.arange(lamp.size)]


def _of_lamp(a: Arguments, lamp: Array) -> Array:
    length = intervals(_exact(a.tree), a.p, a.n)[1]
    return np.asarray(length[lamp.clip(0, len(length) - 1), np.arange(lamp.size)])


ALIKE = 512
"""Lamps that are the same: a power of 2, so that all walks have nine steps."""


def _alike(draw: Draw) -> Mapping[str, Any]:
    """Many equal lamps at one place, above a floor: u alone decides."""
    count, n = ALIKE, draw.n
    one = np.zeros((3, count))
    own = {
        "lo": one - 0.1 * draw.scale,
        "hi": one + 0.1 * draw.scale,
        "axis": np.repeat([[0.0], [-1.0], [0.0]], count, axis=1),
        "angle": np.full(count, pi),
        "power": np.ones(count),
    }
    p = draw.lengths(-1, 1, 3, n) - np.array([[0], [3 * draw.scale], [0]])
    normal = np.repeat([[0.0], [1.0], [0.0]], n, axis=1)
    place = (draw.rng.integers(0, count, n) + INSIDE + 0.9 * draw.rng.random(n)) / count
    return {"tree": grown(draw, **own), "p": p, "n": normal, "u": place}


def _in_order(a: Arguments) -> Array:
    """Equal lamps by u: leaves from left to right, those of the lowest level first."""
    return np.asarray(a.tree[5][(a.u * ALIKE).astype(np.intp)])


def _beneath(count: int) -> Case:
    """Points that all lamps lie below: nothing can reach them."""

    def case(draw: Draw) -> Mapping[str, Any]:
        tree = _tree(draw, count)
        p = draw.lengths(-1, 1, 3, draw.n) + np.array([[0], [40 * draw.scale], [0]])
        normal = _around(
            draw, np.repeat([[0.0], [1.0], [0.0]], draw.n, 1), draw.rng.uniform(0, 0.5, draw.n)
        )
        return {"tree": tree, "p": p, "n": normal}

    return case


def _one_side(draw: Draw) -> Mapping[str, Any]:
    """One lamp of four lies above the surface, three far below it, together; numbers at all ends."""
    x = np.array([[-3.0, 0, 0.25, 0.5], [1, -3, -3, -3], [0, 0, 0, 0]])
    own = lamps(draw, 4) | {"lo": x - 0.125, "hi": x + 0.125, "angle": np.full(4, pi)}
    last = float(np.nextafter(draw.dtype(1), draw.dtype(0)))
    column = np.ones((1, draw.n))
    return {
        # Whoever goes left where nothing lies there is found out by the number 0.
        "tree": grown(draw, np.array([1, 2, 3, 0]), **own),
        "p": np.array([[1.0], [0], [0]]) * column,
        "n": np.array([[0.0], [1], [0]]) * column,
        "u": draw.rng.choice((0.0, 0.25, 0.5, 0.75, 1 - 2.0**-24, last), draw.n),
    }


ONE = grown(Draw(np.random.default_rng(0), 1), **lamps(Draw(np.random.default_rng(0), 1), 2))
TREE = replace(
    Made(wrong=(ONE[:5], (ONE[0][:, 1:], *ONE[1:]), (*ONE[:5], ONE[5][:1]))), batch=False
)

TREE_CHOICE = function(
    "many_lights.tree_choice",
    {"tree": TREE},
    (
        holds(
            "never",
            "A child without importance is never taken, not even at the ends of [0, 1)",
            lambda _, r: r[0] == 0,
            "lamp 0, the only one above the surface",
            "Left where u is below the left child's probability; and a number stays below 1.",
            shows=lambda _, r: r[0],
            case=_one_side,
        ),
        close(
            "one",
            "A single lamp is always chosen",
            lambda _, r: (np.stack(r), np.array([[0], [1]]), 1.0),
            "A tree of one lamp has no inner node.",
            what="a lamp or a probability of",
            case=_one_lamp,
        ),
        close(
            "dark",
            "Where no child has importance, both are as probable",
            lambda _, r: (r[1], 0.25),
            "The walk goes on: each lamp of four then has a quarter.",
            what="a probability of",
            case=_beneath(4),
        ),
        close(
            "reuse",
            "Equal lamps are chosen evenly, by one number",
            lambda a, r: (np.stack(r), np.stack((_in_order(a), 1 / ALIKE + 0 * a.u)), 1.0),
            "After a step the number's place in the part that was taken is a number again.",
            what="a lamp or a probability of",
            floor=1e-4,
            case=_alike,
        ),
        close(
            "probability",
            "The probability is that of the lamp that was chosen",
            lambda a, r: (r[1], _of_lamp(a, r[0]), 1.0),
            "The product over all steps: of the left child's share, or of what is left of 1.",
            what="a probability of",
            floor=2e-3,
            role="core",
        ),
        close(
            "faint",
            "Trees of faint lamps are walked as those of bright ones",
            lambda a, r: (np.stack(r), np.stack(_chosen(a)), 1.0),
            "Half each is for two children that have no importance at all.",
            what="of faint lamps, a lamp or a probability of",
            floor=2e-3,
            case=_faint(_walks_to),
        ),
        close(
            "values",
            "Lamps and their probabilities are right together",
            lambda a, r: (np.stack(r), np.stack(_chosen(a)), 1.0),
            "u chooses the first child; what is left of it chooses the next.",
            what="a lamp or a probability of",
            floor=2e-3,
            case=_walks_to,
            scales=(1.0,) * 3,
            whole=True,
        ),
    ),
    case=_walks,
    scales=SCALES,
    speed=4096,
)


def _any_lamp(draw: Draw) -> Mapping[str, Any]:
    found = dict(_walks(draw))
    count = found["tree"][5].size
    return found | {"lamp": draw.rng.integers(0, count, draw.n)}


def _each_lamp(draw: Draw) -> Mapping[str, Any]:
    """One point, and every lamp of a tree of as many as there are columns, or of one."""
    draw = draw.but(n=1) if draw.rng.random() < 0.5 else draw
    tree = _tree(draw, draw.n)
    p, n = seen(draw.but(n=1), tree)
    columns = np.ones((1, draw.n))
    return {"tree": tree, "p": p * columns, "n": n * columns, "lamp": np.arange(draw.n)}


def _any_side(draw: Draw) -> Mapping[str, Any]:
    found = dict(_one_side(draw))
    del found["u"]
    return found | {"lamp": draw.rng.integers(0, 4, draw.n)}


TREE_PROBABILITY = function(
    "many_lights.tree_probability",
    {"tree": TREE},
    (
        close(
            "sum",
            "The probabilities of all lamps add up to 1",
            lambda _, r: (r.sum(), 1.0),
            "Each step shares its node's probability among its two children.",
            what="a sum of",
            floor=1e-5,
            case=_each_lamp,
            n=60,
            scales=(1.0,) * 8,
        ),
        close(
            "side",
            "The only lamp above the surface has all of the probability",
            lambda a, r: (r, a.lamp == 0, 1.0),
            what="a probability of",
            case=_any_side,
        ),
        close(
            "dark",
            "Where no child has importance, both are as probable",
            lambda _, r: (r, 0.25),
            what="a probability of",
            case=lambda d: {**_beneath(4)(d), "lamp": d.rng.integers(0, 4, d.n)},
        ),
        close(
            "faint",
            "Trees of faint lamps have the probabilities of bright ones",
            lambda a, r: (r, _of_lamp(a, a.lamp), 1.0),
            "Half each is for two children that have no importance at all.",
            what="of faint lamps, a probability of",
            floor=2e-3,
            case=_faint(_any_lamp),
        ),
        close(
            "values",
            "The probability is the product over the steps to the lamp",
            lambda a, r: (r, _of_lamp(a, a.lamp), 1.0),
            "Find the lamp's leaf, and go up: node k is a child of node (k - 1) // 2.",
            what="a probability of",
            floor=2e-3,
            scales=(1.0,) * 3,
            whole=True,
        ),
    ),
    case=_any_lamp,
    scales=SCALES,
    speed=4096,
    contract="tree, p: 3 N, n: 3 N, lamp: N -> the probability: N",
)

FUNCTIONS = (POWER_CHOICE, MERGE_CONES, LIGHT_TREE, IMPORTANCE, TREE_CHOICE, TREE_PROBABILITY)
