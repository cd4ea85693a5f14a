"""soft_shadows declared: the grid of point lights, and uniform points on and in lights."""

from collections.abc import Callable, Mapping
from math import inf, isqrt, nan
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Case, Function, Law, Made, function
from course.school.grading.checks.distributions import uniform
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.evenness import evenly
from course.school.grading.checks.laws import close, within
from course.school.grading.checks.vectors import dot, normalized
from course.school.grading.modules import round_shapes

SCALES = (1.0, 1e-3, 1e3)

# ---------------------------------------------------------------- parallelograms


def _parallelogram(draw: Draw) -> Mapping[str, Any]:
    """Two edges, neither short nor nearly parallel."""
    first, second, _ = draw.frame()
    slant = draw.uniform(-0.8, 0.8)
    along, across = (draw.scale * draw.number(0.5, 2) for _ in range(2))
    return {"edge_u": along * first, "edge_v": across * (second + slant * first)}


def _coordinates(a: Arguments, r: Array) -> Array:
    """Of points, (3, N): along both edges, 0 to 1 on the light, and off its plane over the light's size."""
    normal = np.cross(a.edge_u, a.edge_v)
    # The normal's length is an area; this one is as long as the light is wide.
    normal /= np.sqrt(np.linalg.norm(normal))
    axes = np.stack((a.edge_u, a.edge_v, normal), axis=1)
    return np.asarray(np.linalg.solve(axes, r - a.corner[:, None]))


PLANE = close(
    "plane",
    "Points are in the parallelogram's plane",
    lambda a, r: (_coordinates(a, r)[2], 0.0),
    "A corner and steps along the two edges lead to every point of the light.",
    what="a distance from the light's plane, in its widths, of",
    floor=5e-5,
    scales=SCALES,
)


def _spread(a: Arguments, r: Array) -> Array:
    """What mistakes show in: places along the edges, how these go together, and how far off the plane."""
    first, second, off = _coordinates(a, r)
    return np.stack((first, second, np.abs(first - second), off))


# ---------------------------------------------------------------- light_grid


def _in_order(a: Arguments, r: Array) -> tuple[Array, Array]:
    """Places along the edges, cell by cell, and the cells' centres."""
    found = _coordinates(a, r)[:2]
    column, row = np.clip(np.floor(found * a.k), 0, a.k - 1)
    cells = np.stack(np.divmod(np.arange(a.k * a.k), a.k)[::-1])
    return found[:, np.argsort(row * a.k + column, kind="stable")], (cells + 0.5) / a.k


def _lights(draw: Draw) -> int:
    """Some along an edge; where time is compared, as many in all as there are columns."""
    return int(draw.rng.integers(3, 10)) if draw.n <= 1000 else isqrt(draw.n)


def _centres(name: str, title: str, hint: str, **how: Any) -> Law:
    return close(
        name,
        title,
        _in_order,
        hint,
        what="in any order, a place along an edge, 0 to 1, of",
        floor=1e-4,
        scales=SCALES,
        **how,
    )


LIGHT_GRID = function(
    "soft_shadows.light_grid",
    {"k": Made(_lights, (0, -2))},
    (
        PLANE,
        _centres(
            "one-or-many",
            "A single point light is in the light's middle, and many are in their cells' centres, too",
            "With k = 1 the whole light is one cell, whose middle is half way along both edges.",
            case=lambda d: {**_parallelogram(d), "k": int(d.rng.choice((1, 2, 40)))},
        ),
        _centres(
            "centres",
            "Point lights are at the cells' centres",
            "The light falls into k x k equal cells, with a point light in the middle of each.",
            whole=True,
        ),
    ),
    case=_parallelogram,
    features=_spread,
    speed=4096,
)


# ---------------------------------------------------------------- point_on_rectangle


def _edges(a: Arguments, r: Array) -> Array:
    return _coordinates(a, r)[:2]


POINT_ON_RECTANGLE = function(
    "soft_shadows.point_on_rectangle",
    {},
    (
        PLANE,
        within(
            "inside",
            "Points are on the light, not beside it",
            _edges,
            0,
            1,
            "No point leaves the light, which begins at its corner.",
            what="a place along an edge",
            slack=5e-5,
            scales=SCALES,
        ),
        uniform(
            "uniform",
            "Points are uniform on the light, each where its own u says",
            _edges,
            (16, 16),
            "Each edge needs a number of its own.",
            what="places along the edges",
            whole=True,
        ),
        evenly(
            lambda a, r: np.exp(np.array((1.2, -1.6)) @ (_edges(a, r) - 0.5)),
            float(np.sinh(0.6) / 0.6 * np.sinh(0.8) / 0.8),
        ),
    ),
    case=_parallelogram,
    corners=(lambda _: dict.fromkeys(("edge_u", "edge_v"), np.zeros(3)),),
    free=True,
    features=_spread,
)


# ---------------------------------------------------------------- round lights

RADIUS = declare.length(0.3, 3, (-1.0, nan, inf))


def _from_centre(a: Arguments, r: Array) -> Array:
    """Points as seen from the light's centre, in radii."""
    return np.asarray((r - a.center[:, None]) / a.radius)


def _radius(radius: float, case: Case | None = None) -> Case:
    return lambda draw: {**(case(draw) if case else {}), "radius": radius}


RADIUS_ZERO = close(
    "radius-zero",
    "Radius 0 gives the centre",
    lambda a, r: (r, a.center[:, None]),
    "A light without extent is a point light at its centre.",
    what="for radius 0, the centre's coordinate",
    within=4,
    case=_radius(0.0),
)


def _light(name: str, shape: round_shapes.RoundShape) -> Function:
    """A light that looks the same from everywhere."""
    return function(
        f"soft_shadows.{name}",
        {"radius": RADIUS},
        (
            round_shapes.edge(shape, _from_centre, scales=SCALES),
            RADIUS_ZERO,
            *round_shapes.warps(shape, _from_centre, unit=_radius(1.0)),
        ),
        corners=(lambda _: {"radius": 0.0},),
        free=True,
        features=lambda a, r: round_shapes.seen(_from_centre(a, r)),
    )


# ---------------------------------------------------------------- point_on_facing_disk


def _around(way: Callable[[Draw], Array]) -> Case:
    """Shading points on these ways from the centre, (3, N) of length 1, some radii off."""

    def case(draw: Draw) -> Mapping[str, Any]:
        center, radius = draw.lengths(-3, 3, 3), draw.scale * draw.number(0.3, 3)
        far = radius * draw.uniform(0.2, 4, draw.n)
        return {"center": center, "radius": radius, "point": center[:, None] + far * way(draw)}

    return case


def _three(draw: Draw) -> Array:
    """Three ways, of which each is taken by every third column."""
    return draw.directions(3)[:, np.arange(draw.n) % 3]


AXES = np.array([*np.eye(3), *-np.eye(3), (1e-3, 0, -1), (1e-5, 1e-5, -1), (0, 1e-6, 1)]).T
"""Ways at which a basis may fall to pieces, x, y and z and their neighbours."""


def _along_axes(draw: Draw) -> Mapping[str, Any]:
    """Shading points on and next to the axes through the origin, where no rounding moves them off, far and near."""
    far = np.exp(draw.uniform(np.log(1e-6), np.log(1e6), draw.n))
    return {"center": np.zeros(3), "point": far * AXES[:, np.arange(draw.n) % AXES.shape[1]]}


def _at_centre(draw: Draw) -> Mapping[str, Any]:
    center = draw.lengths(-3, 3, 3).astype(np.float32)
    return {"center": center, "point": np.repeat(center[:, None], draw.n, axis=1)}


def _axis(a: Arguments) -> Array:
    """From each shading point to the centre."""
    return normalized(a.center[:, None] - a.point)


def _face_on(a: Arguments, r: Array) -> Array:
    """The points as they are seen from their shading points, in radii and as far from the centre as they are."""
    axis, offsets = _axis(a), _from_centre(a, r)
    # The coordinate axis farthest from the way, and one orthogonal to both.
    first = np.cross(np.eye(3)[:, np.abs(axis).argmin(axis=0)], axis, axis=0)
    first = normalized(first)
    flat = np.stack((dot(first, offsets), dot(np.cross(axis, first, axis=0), offsets)))
    return np.asarray(normalized(flat) * np.linalg.norm(offsets, axis=0))


FACING = _around(lambda draw: draw.directions())
ONE_WAY = _around(lambda draw: np.repeat(draw.directions(1), draw.n, axis=1))

POINT_ON_FACING_DISK = function(
    "soft_shadows.point_on_facing_disk",
    {"radius": RADIUS, "point": declare.points()},
    (
        close(
            "faces",
            "The disk faces its shading point",
            lambda a, r: (dot(_axis(a), _from_centre(a, r)), 0.0),
            "The disk is orthogonal to the line from its shading point to the centre.",
            what="a distance from the disk's plane, in radii, of",
            floor=1e-4,
            scales=SCALES,
        ),
        round_shapes.edge(round_shapes.DISK, _from_centre, scales=SCALES),
        RADIUS_ZERO,
        round_shapes.cornered(
            round_shapes.uniform_over(round_shapes.DISK, _face_on, _along_axes),
            "axes",
            "The disk is right along the axes, and next to them",
        ),
        round_shapes.cornered(
            uniform(
                "",
                "",
                lambda a, r: np.linalg.norm(_from_centre(a, r), axis=0)[None] ** 2,
                (20,),
                "A disk of any orientation will do.",
                what="for points at the centre itself, r^2 of the disk's points",
                case=_at_centre,
            ),
            "at-centre",
            "A point at the centre gets a disk of some orientation",
        ),
        *round_shapes.warps(round_shapes.DISK, _face_on, _around(_three), _radius(1.0, ONE_WAY)),
    ),
    case=FACING,
    free=True,
    features=lambda a, r: np.stack(
        (np.linalg.norm(_from_centre(a, r), axis=0), np.abs(dot(_axis(a), _from_centre(a, r))))
    ),
)

FUNCTIONS = (
    LIGHT_GRID,
    POINT_ON_RECTANGLE,
    _light("point_on_sphere", round_shapes.SPHERE),
    _light("point_in_ball", round_shapes.BALL),
    POINT_ON_FACING_DISK,
)
