"""Checks of soft_shadows: the grid of point lights, and uniform points on and in lights.

Whatever a check asks of the values, it asks in float64 of any floating dtype: a wrong dtype costs the contract alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    contract_checks,
    finite_floats,
    near,
    worst_units,
)
from course.grading.checks.statistics import check_uniform, distribution_check

EPS = 2.0**-23
"""Of float32: the tolerances hold for both dtypes."""
ROWS = {
    "point_on_rectangle": 2,
    "point_on_sphere": 2,
    "point_in_ball": 3,
    "point_on_facing_disk": 2,
}
"""Rows of u."""
MANY = 20_000

# ---------------------------------------------------------------- what the checks share


def _single(trial: Trial) -> Array:
    """A point in float64 that float32 holds too."""
    return trial.rng.uniform(-3, 3, 3).astype(np.float32).astype(float)


@dataclass(frozen=True)
class Parallelogram:
    """A light with two edges, neither short nor nearly parallel."""

    corner: Array
    edge_u: Array
    edge_v: Array

    @property
    def arguments(self) -> tuple[Array, Array, Array]:
        """As the student's functions take them."""
        return self.corner, self.edge_u, self.edge_v

    def coordinates(self, points: Array) -> Array:
        """Coordinates (3, N) along the edges, 0 to 1 inside, and off the plane in metres."""
        normal = np.cross(self.edge_u, self.edge_v)
        axes = np.array([self.edge_u, self.edge_v, normal / np.linalg.norm(normal)]).T
        return np.linalg.solve(axes, points - self.corner[:, None])


def _parallelogram(trial: Trial) -> Parallelogram:
    while True:
        edges = trial.rng.uniform(-2, 2, (2, 3)).astype(np.float32).astype(float)
        lengths = np.linalg.norm(edges, axis=1)
        if lengths.min() > 0.7 and np.linalg.norm(np.cross(*edges)) > 0.5 * np.prod(lengths):
            return Parallelogram(_single(trial), *edges)


@dataclass(frozen=True)
class Round:
    """A round light, and what was asked of it.

    Attributes
    ----------
    center, radius : of the light
    point : shading points (3, N) for the facing disk; (3, 0) else
    u : random numbers
    offsets : the student's points as seen from the centre, in radii, (3, N)
    """

    center: Array
    radius: float
    point: Array
    u: Array
    offsets: Array

    @property
    def length(self) -> Array:
        """Of the offsets: 1 at the light's edge."""
        return np.asarray(np.linalg.norm(self.offsets, axis=0))

    @property
    def tolerance(self) -> float:
        """Rounding in units of the radius."""
        return 16 * EPS * (1 + (3 * float(np.abs(self.center).max()) + 1) / self.radius)

    @property
    def axis(self) -> Array:
        """From each shading point to the centre, unit length."""
        w = self.center[:, None] - self.point
        return np.asarray(w / np.linalg.norm(w, axis=0))

    def at(self) -> Callable[[int], str]:
        """What a column was asked with."""
        n = self.u.shape[1]
        single = {"center": np.repeat(self.center[:, None], n, axis=1)}
        if self.point.size:
            single["point"] = self.point
        return at(u=self.u, radius=np.full(n, self.radius), **single)


def _points_around(trial: Trial, center: Array, n: int, dtype: Any = np.float32) -> Array:
    """Shading points in every direction, one to four metres off."""
    w = trial.rng.normal(size=(3, n))
    w *= trial.rng.uniform(1, 4, n) / np.linalg.norm(w, axis=0)
    return (center[:, None] + w).astype(dtype)


def _light(
    trial: Trial, n: int, dtype: Any = np.float32, *, one_point: bool = False, u: Any = None
) -> Round:
    """Call a function of a round light, for points all around it, or for n times the same."""
    center, radius = _single(trial), float(np.float32(trial.rng.uniform(0.6, 0.9)))
    if trial.rng.random() < 0.5:
        radius *= 3
    u = trial.uniform(ROWS[trial.function], n, dtype) if u is None else u
    point = np.zeros((3, 0))
    arguments = (center, radius, u)
    if trial.function == "point_on_facing_disk":
        point = _points_around(trial, center, 1 if one_point else n, dtype)
        point = np.repeat(point, n, axis=1) if one_point else point
        found = finite_floats(trial.call(center, radius, point, u), (3, n), "the points")
    else:
        found = finite_floats(trial.call(*arguments), (3, n), "the points")
    return Round(center, radius, point.astype(float), u, (found - center[:, None]) / radius)


def _frame(w: Array) -> tuple[Array, Array]:
    """Two unit vectors orthogonal to each of w (3, N) and to each other."""
    least = np.eye(3)[:, np.abs(w).argmin(axis=0)]
    first = np.cross(least, w, axis=0)
    first /= np.linalg.norm(first, axis=0)
    return first, np.cross(w, first, axis=0)


def _turns(light: Round, w: Array) -> Array:
    """The angle of each offset about w, from 0 to 1."""
    first, second = _frame(w)
    angle = np.arctan2((second * light.offsets).sum(axis=0), (first * light.offsets).sum(axis=0))
    return np.asarray(angle / (2 * np.pi) % 1)


def _height(light: Round, w: Array) -> Array:
    """The cosine with w (3, 1), from 0 to 1: uniform for directions that are."""
    length = np.where(light.length > 0, light.length, 1)
    return np.asarray((1 + (w * light.offsets).sum(axis=0) / length) / 2)


def _direction(trial: Trial) -> Array:
    w = trial.rng.normal(size=(3, 1))
    return np.asarray(w / np.linalg.norm(w))


# ---------------------------------------------------------------- the contract


def _arguments(trial: Trial, n: int, dtype: Any = np.float32) -> list[Any]:
    """Legal arguments of the check's function; light_grid's k takes the place of n."""
    if trial.function in ("light_grid", "point_on_rectangle"):
        arguments: list[Any] = [*_parallelogram(trial).arguments]
    else:
        arguments = [_single(trial), float(trial.rng.uniform(0.5, 2))]
    if trial.function == "light_grid":
        return [*arguments, n]
    if trial.function == "point_on_facing_disk":
        arguments.append(_points_around(trial, arguments[0], n, dtype))
    return [*arguments, trial.uniform(ROWS[trial.function], n, dtype)]


def _retyped(arguments: list[Any], kind: Callable[[Any], Any]) -> list[Any]:
    """The same with single points of another kind."""
    return [kind(a) if np.shape(a) == (3,) else a for a in arguments]


def _kinds() -> dict[str, Callable[[Any], Any]]:
    return {
        "float64 arrays": np.float64,
        "float32 arrays": np.float32,
        "tuples": lambda point: tuple(point.tolist()),
    }


def _warp_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        for n in (17, 1, 0):
            arguments = _arguments(trial, n, dtype)
            for name, kind in _kinds().items():
                value = trial.call(*_retyped(arguments, kind))
                batch = f"{np.dtype(dtype)} batches of {n}"
                check_array(value, (3, n), dtype, f"the result for {batch} and {name}")
        if trial.function != "point_on_rectangle":
            center, _, *batches = _arguments(trial, 5, dtype)
            for radius in (2, np.float64(0.5), np.float32(0.5)):
                what = f"the result for a radius of type {type(radius).__name__}"
                check_array(trial.call(center, radius, *batches), (3, 5), dtype, what)


def _disk_contract(trial: Trial) -> None:
    _warp_contract(trial)
    center = _single(trial)
    for one, other in (DTYPES, DTYPES[::-1]):
        point, u = _points_around(trial, center, 5, one), trial.uniform(2, 5, other)
        what = f"the result for {point.dtype} points and {u.dtype} u"
        check_array(trial.call(center, 0.5, point, u), (3, 5), np.float64, what)


def _grid_contract(trial: Trial) -> None:
    for k in (1, int(trial.rng.integers(2, 6)), 16):
        arguments = _arguments(trial, k)
        for name, kind in _kinds().items():
            value = trial.call(*_retyped(arguments, kind))
            check_array(value, (3, k * k), np.float32, f"the grid for k = {k} and {name}")


def _untouched(trial: Trial) -> None:
    check_untouched(trial, *_arguments(trial, 6))


def _refuses(trial: Trial) -> None:
    good = _arguments(trial, 4)
    for number, argument in enumerate(good):
        wrongs: list[Any] = []
        if np.shape(argument) == (3,):
            wrongs = [np.zeros(2), np.zeros((3, 1))]
        elif isinstance(argument, np.ndarray):
            rows = len(argument)
            shapes = ((rows + 1, 4), (4, rows), (rows,), (rows, 4, 1))
            wrongs = [np.zeros(shape, np.float32) for shape in shapes if shape != (rows, 4)]
        elif isinstance(argument, float):
            wrongs = [-1.0, float("nan"), float("inf")]
        else:
            wrongs = [0, -2]
        for wrong in wrongs:
            shown = f"shape {wrong.shape}" if isinstance(wrong, np.ndarray) else f"{wrong}"
            arguments = [*good[:number], wrong, *good[number + 1 :]]
            check_refused(trial, *arguments, named=f"argument {number + 1} ({shown})")
    if trial.function == "point_on_facing_disk":
        check_refused(trial, *good[:3], good[3][:, :3], named="number of columns (4 points, 3 u)")


def _rectangle_extremes(trial: Trial) -> None:
    for dtype in DTYPES:
        u = worst_units(2, dtype)
        for size in (0.0, 1e-30, 1e15):
            corner = np.array([size, -size, 0])
            value = trial.call(corner, corner[::-1].copy(), corner * 0.5, u)
            finite_floats(value, (3, u.shape[1]), f"points on a light {size} m large")


def _round_extremes(trial: Trial) -> None:
    for dtype in DTYPES:
        u = worst_units(ROWS[trial.function], dtype)
        for radius, size, distance in (
            (0.0, 0.0, 1.0),
            (1e-15, 0.0, 1e-12),
            (1.0, 1e6, 1e4),
            (1e12, 1.0, 1e12),
        ):
            center, point = np.array([size, 0, -size]), np.zeros((3, u.shape[1]), dtype)
            point[0], point[1], point[2] = size, distance, -size
            arguments = (point, u) if trial.function == "point_on_facing_disk" else (u,)
            value = trial.call(center, radius, *arguments)
            finite_floats(value, point.shape, f"points for radius {radius}, centre {size} m off,")


# ---------------------------------------------------------------- light_grid


def _check_plane(light: Parallelogram, points: Array) -> Array:
    """Points lie in the light's plane; their coordinates along its edges, (2, N)."""
    a, b, off = light.coordinates(points)
    check_close(
        off,
        np.zeros_like(off),
        5e-5,
        "a distance from the light's plane of",
        at(point=points),
        "A corner and steps along the two edges lead to every point of the light.",
    )
    return np.stack((a, b))


def _grid_centres(trial: Trial) -> None:
    for k in (int(trial.rng.integers(2, 5)), int(trial.rng.integers(5, 9)), 1):
        light = _parallelogram(trial)
        points = finite_floats(trial.call(*light.arguments, k), (3, k * k), "the points")
        found = _check_plane(light, points)
        trial.show("points", f"Your grid along the light's edges, k = {k}", yours=found)
        column, row = np.clip(np.floor(found * k), 0, k - 1)
        found = found[:, np.argsort(row * k + column, kind="stable")]
        expected = np.stack(np.divmod(np.arange(k * k), k)[::-1])
        check_close(
            found,
            (expected + 0.5) / k,
            1e-4,
            f"k = {k}, in any order: a place along an edge (0 to 1) of",
            at(cell=expected),
            "The light falls into k x k equal cells, with a point light in the middle of each.",
        )


# ---------------------------------------------------------------- all that take u


def _columns(trial: Trial) -> None:
    *single, u = _arguments(trial, 60)
    order = trial.rng.permutation(60)[:40]
    every = finite_floats(trial.call(*single, u.copy()), (3, 60), "the points")
    turned = [a[:, order] if np.ndim(a) == 2 else a for a in single]
    some = finite_floats(trial.call(*turned, u[:, order].copy()), (3, 40), "the points")
    check_close(
        some,
        every[:, order],
        1e-4,
        "for the same column as before, a coordinate of",
        at(u=u[:, order]),
        "A point depends on its own column of u, and on no other source of chance.",
    )


# ---------------------------------------------------------------- point_on_rectangle


def _on_rectangle(
    trial: Trial, n: int, dtype: Any = np.float32
) -> tuple[Parallelogram, Array, Array]:
    light, u = _parallelogram(trial), trial.uniform(2, n, dtype)
    return light, u, finite_floats(trial.call(*light.arguments, u), (3, n), "the points")


def _rectangle_plane(trial: Trial) -> None:
    for dtype in DTYPES:
        light, u, points = _on_rectangle(trial, 2000, dtype)
        found = _check_plane(light, points)
        trial.show("points", "Your points along the light's edges", yours=found)
        check_close(
            found,
            np.clip(found, 0, 1),
            5e-5,
            "a place along an edge, 0 to 1, of",
            at(u=u),
            "No point leaves the light.",
        )


def _rectangle_uniform(trial: Trial) -> None:
    for dtype in DTYPES:
        light, _, points = _on_rectangle(trial, MANY, dtype)
        found = light.coordinates(points)[:2]
        trial.show("points", "Your points along the light's edges", yours=found[:, :2000])
        check_uniform(
            found, (16, 16), "points even over the light", "Each edge needs a number of its own."
        )


# ---------------------------------------------------------------- round lights


def _check_length(light: Round, expected: Array, hint: str) -> None:
    """Distances from the centre, in metres."""
    check_close(
        light.length * light.radius,
        expected * light.radius,
        light.tolerance * light.radius,
        "a distance from the centre of",
        light.at(),
        hint,
    )


def _sphere_radius(trial: Trial) -> None:
    for dtype in DTYPES:
        light = _light(trial, 2000, dtype)
        hint = "Every point of a sphere's surface is one radius away from its centre."
        _check_length(light, np.ones(2000), hint)


def _inside(trial: Trial) -> None:
    for dtype in DTYPES:
        light = _light(trial, 2000, dtype)
        hint = "No point is more than the radius away from the centre."
        _check_length(light, np.minimum(light.length, 1), hint)


def _radius_zero(trial: Trial) -> None:
    for dtype in DTYPES:
        center, _, *batches = _arguments(trial, 50, dtype)
        check_close(
            finite_floats(trial.call(center, 0.0, *batches), (3, 50), "the points"),
            np.repeat(center[:, None], 50, axis=1),
            4 * EPS * float(np.abs(center).max()),
            "for radius 0, the centre's coordinate",
            at(u=batches[-1]),
            "A light without extent is a point light at its centre.",
        )


def _directions_uniform(trial: Trial, light: Round, cells: tuple[int, int], hint: str) -> None:
    """Height along an axis and angle about it are uniform and independent, whichever the axis."""
    z = np.array([[0.0], [0.0], [1.0]])
    trial.show(
        "points",
        "Your directions: angle about z across, height up",
        yours=np.stack((_turns(light, z), _height(light, z)))[:, :2000],
    )
    for name, w in (("z", z), ("a random axis", _direction(trial))):
        values = np.stack((_height(light, w), _turns(light, w)))
        check_uniform(values, cells, f"directions even in height along {name} and angle", hint)


def _sphere_uniform(trial: Trial) -> None:
    hint = "Slices of a sphere with the same height have the same area."
    for dtype in DTYPES:
        _directions_uniform(trial, _light(trial, MANY, dtype), (16, 16), hint)


def _ball_uniform(trial: Trial) -> None:
    light = _light(trial, MANY)
    z = np.array([[0.0], [0.0], [1.0]])
    volume = np.minimum(light.length**3, 1)
    trial.show("histogram", "Share of the volume within your points' radii", yours=volume)
    hint = "The volume within a radius grows with its third power; radius and direction are independent."
    for name, w in (("z", z), ("a random axis", _direction(trial))):
        values = np.stack((volume, _height(light, w), _turns(light, w)))
        what = f"points even in volume within their radius, height along {name} and angle"
        check_uniform(values, (8, 8, 8), what, hint)


def _ball_directions(trial: Trial) -> None:
    hint = "Seen from the centre, no direction is preferred."
    _directions_uniform(trial, _light(trial, MANY, np.float64), (16, 16), hint)


# ---------------------------------------------------------------- point_on_facing_disk

AXES = np.array([*np.eye(3), *-np.eye(3), (1e-3, 0, -1), (1e-5, 1e-5, -1), (0, 1e-6, 1)]).T
"""Directions at which a basis may fall to pieces, x, y and z and their neighbours."""


def _check_faces(light: Round, axis: Array, tolerance: float) -> None:
    check_close(
        (light.offsets * axis).sum(axis=0),
        np.zeros(axis.shape[1]),
        tolerance,
        "a distance from the disk's plane, in radii, of",
        light.at(),
        "The disk is orthogonal to the line from its shading point to the centre.",
    )


def _disk_faces(trial: Trial) -> None:
    for dtype in DTYPES:
        light = _light(trial, 2000, dtype)
        _check_faces(light, light.axis, 4 * light.tolerance + 1e-5)


def _disk_axes(trial: Trial) -> None:
    for dtype in DTYPES:
        w = np.repeat(AXES, 400, axis=1)
        u, radius = trial.uniform(2, w.shape[1], dtype), 0.75
        point = (w * float(trial.rng.uniform(1, 3))).astype(dtype)
        found = finite_floats(trial.call(np.zeros(3), radius, point, u), w.shape, "the points")
        light = Round(np.zeros(3), radius, point.astype(float), u, found / radius)
        _check_faces(light, light.axis, 1e-4)
        hint = "No point is more than the radius away from the centre."
        _check_length(light, np.minimum(light.length, 1), hint)
        area = np.minimum(light.length**2, 1)
        for number in range(AXES.shape[1]):
            here = slice(400 * number, 400 * number + 400)
            values = np.stack((area, _turns(light, light.axis)))[:, here]
            check_uniform(values, (4, 4), f"point {point[:, here.start]}: points even on the disk")


def _disk_uniform(trial: Trial) -> None:
    for one_point in (False, True):
        light = _light(trial, MANY, one_point=one_point)
        first, second = _frame(light.axis)
        flat = [(light.offsets * axis).sum(axis=0) for axis in (first, second)]
        trial.show("points", "Your disk, face on", yours=(np.stack(flat)[:, :2000] + 1) / 2)
        check_uniform(
            np.stack((np.minimum(light.length**2, 1), _turns(light, light.axis))),
            (16, 16),
            "points even in area within their radius and in angle",
            "Rings of the same width grow with their radius; each needs its share of the points.",
        )


def _disk_at_centre(trial: Trial) -> None:
    for dtype in DTYPES:
        center, radius = _single(trial), 0.75
        u = trial.uniform(2, 2000, dtype)
        point = np.repeat(center[:, None], 2000, axis=1).astype(dtype)
        found = finite_floats(trial.call(center, radius, point, u), (3, 2000), "the points")
        offsets = (found - center[:, None]) / radius
        light = Round(center, radius, point.astype(float), u, offsets)
        _check_length(light, np.minimum(light.length, 1), "A disk of any orientation will do.")
        area = np.minimum(light.length**2, 1)[None]
        check_uniform(
            area, (20,), "for points at the centre itself: points even over the disk's area"
        )


# ---------------------------------------------------------------- known mistakes


def _fill(values: Array, cells: tuple[int, ...]) -> bool:
    """Whether (d, N) values fill the unit cube evenly, and do not leave it."""
    if values.min() < -1e-3 or values.max() > 1.001:
        return False
    try:
        check_uniform(values, cells, "")
    except Failure:
        return False
    return True


def _grid_lies(axis: Callable[[int], Array]) -> Callable[[Trial], bool]:
    """Whether the grid's places along both edges are those."""

    def matches(trial: Trial) -> bool:
        k = int(trial.rng.integers(3, 6))
        light = _parallelogram(trial)
        found = light.coordinates(np.asarray(trial.call(*light.arguments, k), float))
        found = np.round(found, 3) + 0.0
        grid = np.stack([x.ravel() for x in np.meshgrid(axis(k), axis(k))])
        grid = np.concatenate((grid, np.zeros((1, k * k))))
        return near(found[:, np.lexsort(found)], grid[:, np.lexsort(np.round(grid, 3))], 2e-3)

    return matches


def _grid_diagonal(trial: Trial) -> bool:
    light = _parallelogram(trial)
    a, b, off = light.coordinates(np.asarray(trial.call(*light.arguments, 4), float))
    return near(a, b) and near(off, 0) and bool(np.std(a) > 0.1)


def _edges_as_points(trial: Trial) -> bool:
    """Whether the edges are taken for corners: the light between three points."""
    light = _parallelogram(trial)
    corner, edge_u, edge_v = light.arguments
    if trial.function == "light_grid":
        found = trial.call(*light.arguments, 20)
    else:
        found = trial.call(*light.arguments, trial.uniform(2, 2000))
    other = Parallelogram(corner, edge_u - corner, edge_v - corner)
    a, b, off = other.coordinates(np.asarray(found, float))
    return near(off, 0) and _fill(np.stack((a, b)), (4, 4))


def _rectangle_fills(
    place: Callable[[Parallelogram, Array], Array],
) -> Callable[[Trial], bool]:
    """Whether the points fill the unit square once they are moved like that."""

    def matches(trial: Trial) -> bool:
        light, _, points = _on_rectangle(trial, 5000)
        a, b, off = place(light, points)
        return near(off, 0) and _fill(np.stack((a, b)), (8, 8))

    return matches


def _centred(light: Parallelogram, points: Array) -> Array:
    return light.coordinates(points + (0.5 * (light.edge_u + light.edge_v))[:, None])


def _from_origin(light: Parallelogram, points: Array) -> Array:
    return light.coordinates(points + light.corner[:, None])


def _rectangle_diagonal(trial: Trial) -> bool:
    light, _, points = _on_rectangle(trial, 500)
    a, b, _ = light.coordinates(points)
    return (near(a, b) or near(a, 1 - b)) and bool(np.std(a) > 0.1)


def _rectangle_triangle(trial: Trial) -> bool:
    light, _, points = _on_rectangle(trial, 500)
    a, b, off = light.coordinates(points)
    inside = a.min() > -1e-3 and b.min() > -1e-3 and np.abs(off).max() < 1e-3
    return bool(inside and ((a + b).max() < 1.001 or (a + b).min() > 0.999))


def _lengths(test: Callable[[Round], bool]) -> Callable[[Trial], bool]:
    """Whether points of a round light do that, for lights of two sizes."""

    def matches(trial: Trial) -> bool:
        return all(test(_light(trial, 4000)) for _ in range(3))

    return matches


def _returns_centre(light: Round) -> bool:
    return near(light.length, 0)


def _centre_forgotten(light: Round) -> bool:
    """Whether the points lie about the origin, as far off as they should about the centre."""
    found = np.linalg.norm(light.offsets + light.center[:, None] / light.radius, axis=0)
    return bool(found.max() < 1.001 and found.max() > 0.95) and float(light.length.max()) > 1.01


def _scaled(factor: float) -> Callable[[Round], bool]:
    def test(light: Round) -> bool:
        return 0.98 * factor < float(light.length.max()) < 1.001 * factor

    return test


def _radius_ignored(light: Round) -> bool:
    furthest = float(light.length.max()) * light.radius
    return 0.98 < furthest < 1.001


def _on_surface(light: Round) -> bool:
    return near(light.length, 1)


def _power(power: int) -> Callable[[Round], bool]:
    """Whether that power of the radius is uniform."""

    def test(light: Round) -> bool:
        return _fill(light.length[None] ** power, (20,))

    return test


def _cube_filled(light: Round) -> bool:
    return float(light.length.max()) > 1.2 and _fill((light.offsets + 1) / 2, (6, 6, 6))


def _cube_directions(light: Round) -> bool:
    """Whether directions are a cube's points, normalised: even over the faces of a cube."""
    found = light.offsets[:, light.length > 1e-3]
    largest = np.abs(found).argmax(axis=0)
    face = found / np.abs(found).max(axis=0)
    others = [face[(largest + i) % 3, np.arange(face.shape[1])] for i in (1, 2)]
    return _fill((np.stack(others) + 1) / 2, (6, 6))


def _polar_angle(light: Round) -> bool:
    """Whether the angle from some axis is uniform, rather than its cosine."""
    for w in np.eye(3):
        angle = np.arccos(np.clip(2 * _height(light, w[:, None]) - 1, -1, 1)) / np.pi
        if _fill(np.stack((angle, _turns(light, w[:, None]))), (8, 8)):
            return True
    return False


def _half(light: Round) -> bool:
    """Whether only one side of some axis plane gets points."""
    sides = np.sign(np.round(light.offsets, 3))
    one_sided = np.array([not {-1.0, 1.0} <= set(side) for side in sides])
    return int(one_sided.sum()) == 1 and bool(light.length.max() > 0.9)


def _ball_shared(light: Round) -> bool:
    """Whether the radius goes with the direction: one number for both."""
    volume = light.length**3
    if not _fill(volume[None], (20,)):
        return False
    for w in np.eye(3):
        height, turns = _height(light, w[:, None]), _turns(light, w[:, None])
        if abs(np.corrcoef(volume, height)[0, 1]) > 0.99:
            return True
        # Whoever measures the angle from elsewhere, or the other way round: the difference stays the same.
        for sense in (-1, 1):
            if abs(np.exp(2j * np.pi * (turns + sense * volume)).mean()) > 0.99:
                return True
    return False


def _square(light: Round) -> bool:
    """Whether a square is filled: a share of 1 - pi / 4 lies outside its circle."""
    outside = float((light.length > 1).mean())
    return abs(outside - 0.2146) < 0.03 and 1.3 < float(light.length.max()) < 1.415


def _around_point(light: Round) -> bool:
    found = np.linalg.norm(
        light.offsets + (light.center[:, None] - light.point) / light.radius, axis=0
    )
    return bool(found.max() < 1.001)


def _one_plane(light: Round) -> bool:
    """Whether all offsets lie in one plane, although the shading points are all around."""
    return bool(np.linalg.svd(light.offsets, compute_uv=False)[2] < 0.01)


def _sphere_not_disk(light: Round) -> bool:
    across = np.abs((light.offsets * light.axis).sum(axis=0))
    return _on_surface(light) and float(across.max()) > 0.5


def _ring(light: Round) -> bool:
    across = np.abs((light.offsets * light.axis).sum(axis=0))
    return _on_surface(light) and float(across.max()) < 1e-2


def _float64(trial: Trial) -> bool:
    value = trial.call(*_arguments(trial, 4))
    return isinstance(value, np.ndarray) and value.dtype == np.float64


def _round_mistakes(function: str, shape: str) -> tuple[Mistake, ...]:
    return (
        Mistake(
            function,
            f"{shape}-centre-only",
            "All your points are the light's centre, which makes it a point light with hard shadows.",
            _lengths(_returns_centre),
        ),
        Mistake(
            function,
            f"{shape}-centre-forgotten",
            "Your points lie about the origin of the scene; the light is somewhere else.",
            _lengths(_centre_forgotten),
        ),
        Mistake(
            function,
            f"{shape}-radius-ignored",
            "Your light always has radius 1, whatever radius is asked for.",
            _lengths(_radius_ignored),
        ),
        Mistake(
            function,
            f"{shape}-twice-as-large",
            "Your light is twice as large as it should be: the radius goes from the centre to the edge.",
            _lengths(_scaled(2)),
        ),
        Mistake(
            function,
            f"{shape}-half-as-large",
            "Your light is half as large as it should be: you take the radius for a diameter.",
            _lengths(_scaled(0.5)),
        ),
    )


MISTAKES = (
    Mistake(
        "light_grid",
        "grid-at-corners",
        "Your point lights stand at the corners of the cells, so the light as a whole is shifted; "
        "they belong in the middle of each cell.",
        _grid_lies(lambda k: np.arange(k) / k),
    ),
    Mistake(
        "light_grid",
        "grid-both-edges",
        "Your grid goes from edge to edge of the light; its outermost points should be half a cell inside.",
        _grid_lies(lambda k: np.linspace(0, 1, k)),
    ),
    Mistake(
        "light_grid",
        "grid-diagonal",
        "All your point lights lie on the light's diagonal: each cell needs a pair of steps, one for each edge.",
        _grid_diagonal,
    ),
    *(
        Mistake(
            function,
            f"{name}-edges-as-points",
            "You take the edges for corners of the light; they are vectors that leave the first corner.",
            _edges_as_points,
        )
        for function, name in (("light_grid", "grid"), ("point_on_rectangle", "rectangle"))
    ),
    Mistake(
        "point_on_rectangle",
        "rectangle-same-number",
        "You use one random number for both edges, so all points lie on a diagonal of the light.",
        _rectangle_diagonal,
    ),
    Mistake(
        "point_on_rectangle",
        "corner-as-centre",
        "You spread the points about the corner, as if it were the light's centre.",
        _rectangle_fills(_centred),
    ),
    Mistake(
        "point_on_rectangle",
        "corner-forgotten",
        "Your light starts at the scene's origin rather than at its corner.",
        _rectangle_fills(_from_origin),
    ),
    Mistake(
        "point_on_rectangle",
        "triangle",
        "Your points fill one half of the parallelogram only, a triangle.",
        _rectangle_triangle,
    ),
    *_round_mistakes("point_on_sphere", "sphere"),
    Mistake(
        "point_on_sphere",
        "crowded-poles",
        "Your polar angle is uniform, so the points crowd at the two poles; "
        "near them a step of the angle covers less area.",
        _lengths(_polar_angle),
    ),
    Mistake(
        "point_on_sphere",
        "half-sphere",
        "Only one half of the sphere gets points.",
        _lengths(_half),
    ),
    Mistake(
        "point_on_sphere",
        "sphere-filled",
        "Your points fill the inside of the sphere; they belong on its surface.",
        _lengths(lambda light: _power(3)(light) or _power(2)(light) or _power(1)(light)),
    ),
    *_round_mistakes("point_in_ball", "ball"),
    Mistake(
        "point_in_ball",
        "ball-surface-only",
        "All your points lie on the surface; the ball's inside gives light too.",
        _lengths(_on_surface),
    ),
    Mistake(
        "point_in_ball",
        "cube",
        "Your points fill a cube around the ball, so some lie outside of it.",
        _lengths(_cube_filled),
    ),
    Mistake(
        "point_in_ball",
        "cube-corners",
        "Your directions are those of points in a cube, which crowd towards its eight corners.",
        _lengths(_cube_directions),
    ),
    Mistake(
        "point_in_ball",
        "ball-crowded-poles",
        "Your polar angle is uniform, so the points crowd at the two poles.",
        _lengths(_polar_angle),
    ),
    Mistake(
        "point_in_ball",
        "half-ball",
        "Only one half of the ball gets points.",
        _lengths(_half),
    ),
    Mistake(
        "point_in_ball",
        "crowded-middle",
        "Your distance from the centre is uniform, so the points crowd in the middle: "
        "an inner shell holds less volume than an outer one.",
        _lengths(_power(1)),
    ),
    Mistake(
        "point_in_ball",
        "square-root",
        "Your radii would be right for a disk: in a ball it is the third power that counts, not the second.",
        _lengths(_power(2)),
    ),
    Mistake(
        "point_in_ball",
        "shared-number",
        "The same random number gives the direction and the distance, so the points lie on a surface "
        "within the ball; each of the three coordinates needs a number of its own.",
        _lengths(_ball_shared),
    ),
    *_round_mistakes("point_on_facing_disk", "disk"),
    Mistake(
        "point_on_facing_disk",
        "square",
        "Your points fill a square; its corners stick out of the disk.",
        _lengths(_square),
    ),
    Mistake(
        "point_on_facing_disk",
        "around-the-point",
        "Your disk lies around the shading point; it belongs around the light's centre.",
        _lengths(_around_point),
    ),
    Mistake(
        "point_on_facing_disk",
        "fixed-disk",
        "Your disk has the same orientation for all shading points; it should turn to face each of them.",
        _lengths(_one_plane),
    ),
    Mistake(
        "point_on_facing_disk",
        "sphere-not-disk",
        "Your points lie on the sphere; they belong on a flat disk through its centre.",
        _lengths(_sphere_not_disk),
    ),
    Mistake(
        "point_on_facing_disk",
        "ring",
        "All your points lie on the disk's rim; its inside gives light too.",
        _lengths(_ring),
    ),
    Mistake(
        "point_on_facing_disk",
        "crowded-centre",
        "A uniform radius is not uniform in area: your points crowd in the disk's middle.",
        _lengths(_power(1)),
    ),
    # Last: whoever makes another mistake as well is told that first.
    *(
        Mistake(
            function,
            f"{function.replace('_', '-')}-float64",
            "Your result is float64 for float32 numbers; see what single points and constants do to the dtype.",
            _float64,
        )
        for function in ("light_grid", *ROWS)
    ),
)

# ---------------------------------------------------------------- the module's checks

_contracts = partial(contract_checks, untouched=_untouched, refuses=_refuses)


def _warps(
    function: str, extremes: Callable[[Trial], None], contract: Callable[[Trial], None]
) -> tuple[Check, ...]:
    return (
        *_contracts(function, contract),
        Check(
            function, "extremes", "Finite for the ends of [0, 1) and any size", extremes, "contract"
        ),
        Check(function, "columns", "Each point depends on its column of u alone", _columns),
    )


def _rounds(function: str, contract: Callable[[Trial], None] = _warp_contract) -> tuple[Check, ...]:
    return (
        *_warps(function, _round_extremes, contract),
        Check(function, "radius-zero", "Radius 0 gives the centre", _radius_zero),
    )


CHECKS = ModuleChecks(
    "soft_shadows",
    checks=(
        *_contracts("light_grid", _grid_contract),
        Check("light_grid", "centres", "Point lights are at the cells' centres", _grid_centres),
        *_warps("point_on_rectangle", _rectangle_extremes, _warp_contract),
        Check("point_on_rectangle", "plane", "Points are on the parallelogram", _rectangle_plane),
        distribution_check(
            "point_on_rectangle",
            "uniform",
            "Points are uniform on the light",
            _rectangle_uniform,
            2,
        ),
        *_rounds("point_on_sphere"),
        Check("point_on_sphere", "radius", "Points are on the surface", _sphere_radius),
        distribution_check(
            "point_on_sphere", "uniform", "Points are uniform on the sphere", _sphere_uniform, 4
        ),
        *_rounds("point_in_ball"),
        Check("point_in_ball", "inside", "Points are in the ball", _inside),
        distribution_check(
            "point_in_ball", "uniform", "Points are uniform in the volume", _ball_uniform, 2
        ),
        distribution_check(
            "point_in_ball", "directions", "Directions are uniform", _ball_directions, 2
        ),
        *_rounds("point_on_facing_disk", _disk_contract),
        Check("point_on_facing_disk", "inside", "Points are within the radius", _inside),
        Check("point_on_facing_disk", "faces", "The disk faces its shading point", _disk_faces),
        distribution_check(
            "point_on_facing_disk",
            "axes",
            "The disk is right along the axes, and next to them",
            _disk_axes,
            2 * AXES.shape[1],
        ),
        distribution_check(
            "point_on_facing_disk", "uniform", "Points are uniform on the disk", _disk_uniform, 2
        ),
        distribution_check(
            "point_on_facing_disk",
            "at-centre",
            "A point at the centre gets a disk of some orientation",
            _disk_at_centre,
            2,
        ),
    ),
    mistakes=MISTAKES,
)
