"""radiosity declared: the cells of a hemicube, one iteration of gathering, one shot, and which patches to divide.

Scenes are tables of form factors made here, for areas of any size: what A_i F[i, j] and A_j F[j, i] have in common is
the light that two patches exchange. So rows and columns differ, and whoever mixes them up is found out.
"""

import math
from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Law, Made, function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, holds, over_threshold

LIGHT = (1.0, 1e-3, 1e3)
"""Factors of all radiosities."""

# ---------------------------------------------------------------- hemicube_form_factors


def _centres(k: int) -> tuple[Array, Array]:
    """Delta form factors from what holds at the cells' centres, times their area."""
    edges = np.linspace(-1, 1, k + 1)
    x = (edges[1:] + edges[:-1]) / 2
    z = x[k // 2 :][:, None]
    area = 4 / k / k
    top = area / math.pi / (1 + x**2 + x[:, None] ** 2) ** 2
    return top, area / math.pi * z / (1 + x**2 + z**2) ** 2


def _integrals(k: int) -> tuple[Array, Array]:
    """The same, integrated over the cells: differences of the closed forms at their corners."""
    edges = np.linspace(-1, 1, k + 1)
    y, x = edges[:, None], edges
    a, b = np.sqrt(1 + x**2), np.sqrt(1 + y**2)
    above = (x / a * np.arctan(y / a) + y / b * np.arctan(x / b)) / (2 * math.pi)
    z = edges[k // 2 :][:, None]
    c = np.sqrt(1 + z**2)
    beside = (np.arctan(x) - np.arctan(x / c) / c) / (2 * math.pi)
    top, side = (np.diff(np.diff(table, axis=0), axis=1) for table in (above, beside))
    return top, side


def _part(part: int, k: int, found: Array, slack: float = 0.0) -> tuple[Array, Array, Array]:
    """What came, what is nearest to it and right, and that once more, as what rounding is as large as.

    Centres and integrals are right, and so is what lies between: a finer grid inside each cell.
    """
    both = _centres(k)[part], _integrals(k)[part]
    low, high = np.minimum(*both) * (1 - slack), np.maximum(*both) * (1 + slack)
    return found, np.clip(found, low, high), high


def _all(a: Arguments, r: Any) -> tuple[Array, ...]:
    """Both parts, but for the error of coarse cells."""
    parts = [_part(part, a.k, r[part], 1 / a.k**2) for part in (0, 1)]
    return tuple(np.concatenate(columns) for columns in zip(*parts, strict=True))


def _sizes(draw: Draw) -> Mapping[str, Any]:
    return {"k": int(draw.rng.choice((2, 4) if draw.simple else (2, 4, 8, 30, 64)))}


def _cells(name: str, title: str, compare: Any, **how: Any) -> Law:
    hint = "cos cos' / (pi r^2), times the cell's area."
    return close(name, title, compare, hint, case=_sizes, within=84, scales=(1.0,) * 4, **how)


def _total(_: Arguments, r: Any) -> Array:
    return np.array([r[0].sum() + 4 * r[1].sum()])


HEMICUBE = function(
    "radiosity.hemicube_form_factors",
    {"k": Made(lambda d: 2 * int(d.rng.integers(1, 17)), (0, 1, 3, 33, -2))},
    (
        _cells(
            "top",
            "Cells of the top have their delta form factors",
            lambda a, r: _part(0, a.k, r[0]),
            what="a cell of the top:",
        ),
        _cells(
            "side",
            "Cells of the sides have theirs, the lowest row first",
            lambda a, r: _part(1, a.k, r[1]),
            what="a cell of the sides:",
        ),
        holds(
            "sum",
            "All cells together make 1",
            lambda a, r: np.abs(_total(a, r) - 1) <= 1 / a.k**2,
            "sum(top) + 4 sum(side) to be 1 within 1 / k^2",
            "All light leaves through some cell.",
            shows=_total,
            case=_sizes,
            scales=(1.0,) * 4,
        ),
        _cells("cells", "All cells have their form factors, but for their size", _all, role="core"),
    ),
    corners=(lambda _: {"k": 2}, lambda _: {"k": 64}),
    speed=0,
)

# ---------------------------------------------------------------- rooms


def _room(draw: Draw) -> dict[str, Any]:
    """Patches of all sizes in a closed room without light from outside: rows of form factors sum to at most 1."""
    patches = min(draw.n, 15)
    areas = draw.scale**2 * 10.0 ** draw.rng.uniform(-1, 1, patches)
    exchanged = draw.rng.random((patches, patches)) ** 3
    if draw.simple:
        areas, exchanged = np.ones(patches), np.full((patches, patches), 0.25)
        areas[::2] = 2
    exchanged = np.triu(exchanged, 1) + np.triu(exchanged, 1).T
    factors = exchanged / areas[:, None]
    if not draw.simple:
        factors /= factors.sum(axis=1).max(initial=1e-300) * 1.01
    return {
        "radiosity": draw.lengths(0, 4, 3, patches),
        "unshot": draw.lengths(0, 2, 3, patches),
        "emission": draw.lengths(0, 1, 3, patches),
        "reflectance": draw.uniform(0.1, 0.9, 3, patches),
        "areas": areas,
        "form_factors": factors,
    }


def _solution(room: Mapping[str, Any]) -> Array:
    """(3, P) radiosities that solve (I - rho F) B = E."""
    return np.stack(
        [
            np.linalg.solve(np.eye(len(rho)) - rho[:, None] * room["form_factors"], emission)
            for rho, emission in zip(room["reflectance"], room["emission"], strict=True)
        ]
    )


# ---------------------------------------------------------------- gather


def _dark(draw: Draw) -> Mapping[str, Any]:
    room = _room(draw)
    return {**room, "radiosity": 0 * room["radiosity"]}


def _hollow(draw: Draw) -> Mapping[str, Any]:
    """A room whose patches see a part of themselves."""
    room = _room(draw)
    own = draw.uniform(0.1, 0.3, len(room["areas"]))
    return {**room, "form_factors": 0.7 * room["form_factors"] + np.diag(own)}


def _solved(draw: Draw) -> Mapping[str, Any]:
    room = _room(draw)
    return {**room, "radiosity": _solution(room)}


def _matt_black(dtype: Any) -> Mapping[str, Any]:
    room = _room(Draw(np.random.default_rng(0), 5, dtype))
    return {**room, "reflectance": 0 * room["reflectance"]}


def _gathered(a: Arguments, r: Array) -> tuple[Array, Array]:
    arriving = [a.form_factors @ channel for channel in a.radiosity]
    return r, a.emission + a.reflectance * np.reshape(arriving, a.emission.shape)


GATHER = function(
    "radiosity.gather",
    {},
    (
        close(
            "dark",
            "In the dark only lamps shine",
            lambda a, r: (r, a.emission),
            "Lamps shine whether light reaches them or not.",
            what="in a dark room the emission alone:",
            within=0,
            case=_dark,
        ),
        close(
            "few",
            "A room of two or three patches is no other case",
            _gathered,
            "Form factors go from the sender, in the row, to the receiver, in the column.",
            what="in a room of three patches, the radiosity",
            within=64,
            case=lambda d: _room(d.but(n=int(d.rng.integers(2, 4)))),
            scales=(1.0,) * 3,
        ),
        close(
            "hollow",
            "What a hollow patch sends to itself arrives there, too",
            _gathered,
            "The sum runs over all patches, the receiver itself included.",
            what="of a room of hollow patches, the radiosity",
            within=64,
            case=_hollow,
        ),
        close(
            "fixed",
            "The solution stays as it is",
            lambda a, r: (r, a.radiosity),
            "At the limit an iteration changes nothing.",
            what="the solution of (I - rho F) B = E, left as it is:",
            within=64,
            case=_solved,
        ),
        close(
            "values",
            "Emission, and what is reflected of what arrives",
            _gathered,
            "What a patch emits, and its own reflectance times all that reaches it.",
            what="the radiosity",
            within=64,
            scales=LIGHT,
            role="core",
        ),
    ),
    case=_room,
    corners=(_matt_black,),
    columns=False,
    speed=0,
)

# ---------------------------------------------------------------- shoot


def _shot(draw: Draw) -> dict[str, Any]:
    """One patch of a room shoots."""
    room = _room(draw.but(n=max(draw.n, 1)))
    shooter = int(draw.rng.integers(len(room["areas"])))
    return {**room, "form_factors": room["form_factors"][shooter].copy(), "shooter": shooter}


def _flat_or_hollow(draw: Draw) -> Mapping[str, Any]:
    """A patch that sees nothing of itself, or a fourth."""
    given = _shot(draw)
    given["form_factors"][given["shooter"]] = draw.rng.choice((0, 0.25))
    return given


def _white(draw: Draw) -> Mapping[str, Any]:
    """All light arrives, and nothing is absorbed."""
    given = _shot(draw.but(n=max(draw.n, 2)))
    factors = given["form_factors"] / given["form_factors"].sum()
    return {**given, "reflectance": np.ones_like(given["reflectance"]), "form_factors": factors}


def _nothing_to_shoot(dtype: Any) -> Mapping[str, Any]:
    given = _shot(Draw(np.random.default_rng(0), 5, dtype))
    return {**given, "unshot": 0 * given["unshot"]}


def _received(a: Arguments) -> Array:
    light = a.unshot[:, a.shooter] * a.areas[a.shooter]
    return np.asarray(a.reflectance * light[:, None] * (a.form_factors / a.areas))


def _left(a: Arguments) -> Array:
    left: Array = a.unshot.copy()
    left[:, a.shooter] = 0
    return np.asarray(left + _received(a))


SHOOT = function(
    "radiosity.shoot",
    {"shooter": Made(wrong=(-1, 99))},
    (
        close(
            "cleared",
            "The shooter has nothing left",
            lambda a, r: (r[1][:, [a.shooter]], _left(a)[:, [a.shooter]], a.unshot.max()),
            "What has been shot is gone; only what a hollow patch sends to itself is new light.",
            what="the shooter's unshot radiosity afterwards:",
            case=_flat_or_hollow,
            scales=LIGHT * 2,
        ),
        close(
            "energy",
            "No power is made or lost on the way",
            lambda a, r: ((r[1] @ a.areas)[:, None], (a.unshot @ a.areas)[:, None]),
            "Power is radiosity times area.",
            what="where nothing is absorbed, as much unshot power after a shot as before, ",
            case=_white,
            within=64,
        ),
        close(
            "shot",
            "Receivers get brighter by what they reflect, and have that to shoot",
            lambda a, r: (
                np.concatenate(r),
                np.concatenate((a.radiosity + _received(a), _left(a))),
            ),
            "Light is radiosity times area; it is spread over the receiver's area, reflected, and to be shot.",
            what="radiosity (rows 0 to 2) or unshot radiosity (3 to 5):",
            scales=LIGHT,
            role="core",
        ),
    ),
    case=_shot,
    corners=(_nothing_to_shoot,),
    columns=False,
    speed=0,
)

# ---------------------------------------------------------------- needs_split

STEP = 2.0**-8


def _contrast(values: Array) -> Array:
    """Difference as a share of the largest value; colours are multiples of STEP, and quotients nearly exact."""
    difference = (values.max(axis=1) - values.min(axis=1)).max(axis=0)
    peak = values.max(axis=(0, 1))
    return np.asarray(np.where(peak > 0, difference / np.where(peak > 0, peak, 1), 0))


def _patches(draw: Draw) -> dict[str, Any]:
    """Patches and channels dark and bright, even and uneven; no contrast is near the threshold."""
    rng, n = draw.rng, draw.n
    points = int(rng.integers(2, 4 if draw.simple else 9))
    values = 1 - rng.random((3, 1, n)) ** 2 * rng.random((3, points, n))
    step = 0.25 if draw.simple else STEP
    level = 2.0 ** rng.integers(-3, 4, n) * rng.choice((1, 0.5, 0.125), (3, 1, n))
    values = np.round(values / step) * step * draw.scale * level
    found = np.unique(_contrast(values))
    middle = found[len(found) // 4 : len(found) - len(found) // 4]
    widest = int(np.diff(middle).argmax()) if len(middle) > 1 else 0
    threshold = float(middle[widest : widest + 2].mean()) if len(middle) > 1 else 0.3
    return {"patch_radiosity": values, "threshold": threshold}


def _at_threshold(draw: Draw) -> Mapping[str, Any]:
    """Even patches but for one point in one channel, by the threshold, or a step more or less."""
    n, rng = draw.n, draw.rng
    values = np.ones((3, 3, n))
    steps = rng.integers(63, 66, n)
    values[rng.integers(0, 3, n), rng.integers(0, 3, n), np.arange(n)] -= steps * STEP
    return {"patch_radiosity": 4 * values, "threshold": 0.25}


def _just_over(draw: Draw) -> Mapping[str, Any]:
    """Even patches but for one point in one channel, by the threshold, or by 2^-22 more: single precision has both."""
    values = np.full((3, 3, draw.n), 4.0)
    over = draw.rng.integers(0, 2, draw.n) * 2.0**-20
    values[draw.rng.integers(0, 3, draw.n), 2, np.arange(draw.n)] -= 1 + over
    return {"patch_radiosity": values, "threshold": 0.25}


def _even(draw: Draw) -> Mapping[str, Any]:
    """Patches of one colour, every second one black."""
    values = np.repeat(_patches(draw)["patch_radiosity"][:, :1], 4, axis=1)
    values[:, :, ::2] = 0
    return {"patch_radiosity": values, "threshold": 0.0}


_divided = partial(
    over_threshold, value=lambda a: _contrast(a.patch_radiosity), what="the contrast"
)


NEEDS_SPLIT = function(
    "radiosity.needs_split",
    {
        "patch_radiosity": Made(
            lambda d: d.lengths(0, 1, 3, 4, d.n), wrong=(np.ones((3, 0, 4), np.float32),)
        ),
        "threshold": Made(lambda _: 0.3, (-0.5, -1e-9, math.nan)),
    },
    (
        _divided(
            "threshold",
            "Just over the threshold, not just under",
            hint="The contrast has to be over the threshold: as much is not enough.",
            case=_at_threshold,
        ),
        _divided(
            "just_over",
            "A contrast that is over the threshold by its last digits is over it",
            hint="More than the threshold, however little: that is a plain >.",
            case=_just_over,
        ),
        _divided(
            "dark",
            "Black and even patches are left alone",
            hint="Black patches and even ones are left alone.",
            case=_even,
        ),
        _divided(
            "scale",
            "Dim patches are as those in bright light",
            hint="Contrast is a ratio: in dim light as in bright light the same patches are divided.",
            scales=(2.0**-20, 2.0**20),
        ),
        _divided(
            "contrast",
            "Patches with enough contrast",
            hint="The largest difference in any channel, as a share of the patch's largest value.",
            scales=(1.0,) * 3,
            role="core",
        ),
    ),
    case=_patches,
    corners=(
        lambda dtype: {"patch_radiosity": np.ones((3, 1, 5), dtype)},
        lambda _: {"threshold": 1.0},
        lambda _: {"threshold": math.inf},
    ),
)

FUNCTIONS = (HEMICUBE, GATHER, SHOOT, NEEDS_SPLIT)
