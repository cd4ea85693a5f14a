"""Checks of the thin_lens module: points on the disk, rays through a lens, and the two formulas about it."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isfinite, nan
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
    finite_numbers,
    near,
    pair,
    worst_units,
)
from course.grading.checks.statistics import (
    CLOSE,
    apart,
    check_mean,
    check_uniform,
    distribution_check,
)
from course.grading.checks.vectors import UNIT, normalized
from course.grading.errors import StudentError

EPSILON = float(np.finfo(np.float32).eps)

POINTS = 20_000
"""In a check of a distribution."""


# ---------------------------------------------------------------- values


def _number(value: Any) -> float:
    """The value as a Python float."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, bool | np.bool_) or not isinstance(
        value, int | float | np.integer | np.floating
    ):
        raise Failure("a float", type(value).__name__)
    return float(value)


# ---------------------------------------------------------------- point_on_disk


def _disk(trial: Trial, n: int, dtype: Any = np.float32) -> Array:
    return finite_numbers(trial.call(trial.uniform(2, n, dtype)), (2, n))


def _by_area(points: Array) -> Array:
    """r^2 and the turn of points, 0 to 1: uniform for uniform points of the disk."""
    x, y = points
    return np.stack((np.clip(x * x + y * y, 0, 1), np.arctan2(y, x) / (2 * np.pi) % 1))


def _disk_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        worst = np.concatenate((worst_units(2, dtype), trial.uniform(2, 100, dtype)), axis=1)
        for u in (worst, worst[:, :1].copy(), worst[:, :0].copy()):
            check_array(trial.call(u), u.shape, dtype)


def _disk_untouched(trial: Trial) -> None:
    check_untouched(trial, trial.uniform(2, 50))


def _disk_refuses(trial: Trial) -> None:
    u = trial.uniform(3, 4)
    for bad in (u, u[:1], u[0], u[:2].T, u[None, :2]):
        check_refused(trial, bad, named="u")


def _disk_inside(trial: Trial) -> None:
    for dtype in DTYPES:
        u = np.concatenate((worst_units(2, dtype), trial.uniform(2, 5000, dtype)), axis=1)
        points = finite_numbers(trial.call(u), u.shape)
        trial.show("points", "your points", yours=points[:, -2000:])
        r = np.hypot(*points)
        worst = int(r.argmax())
        if not r[worst] <= 1 + 1e-6:
            raise Failure(
                "points of the unit disk: a radius of 1 at the most",
                f"radius {r[worst]:.7g}",
                at(u=u)(worst),
                "Is the disk's radius 1, and is it a disk?",
            )


def _disk_uniform(trial: Trial) -> None:
    for dtype in DTYPES:
        points = _disk(trial, POINTS, dtype)
        trial.show("points", "your points", yours=points[:, :2000])
        values = _by_area(points)
        hint = "Does a ring get as many points as its share of the area, all the way round?"
        check_uniform(values[:1], (24,), "r^2 of the points", hint)
        check_uniform(values[1:], (24,), "turn of the points", hint)
        check_uniform(
            values,
            (16, 16),
            "r^2 and turn of the points together",
            "Each of the two numbers has to have a job of its own.",
        )


def _disk_moments(trial: Trial) -> None:
    x, y = _disk(trial, POINTS)
    centre = "The disk lies around the origin."
    check_mean(x, 0, 1 / 4, "mean of x", centre)
    check_mean(y, 0, 1 / 4, "mean of y", centre)
    spread = "Uniform points have a mean square of 1/4 along each axis."
    check_mean(x * x, 1 / 4, 1 / 16, "mean of x^2", spread)
    check_mean(y * y, 1 / 4, 1 / 16, "mean of y^2", spread)
    check_mean(x * y, 0, 1 / 24, "mean of x y", "x and y have nothing to do with each other.")


# ---------------------------------------------------------------- lens_rays


class Camera:
    """A camera that looks anywhere, and the pinhole's rays of a picture of a right angle.

    Parameters
    ----------
    trial : whose numbers are drawn
    n : rays
    dtype : of the batches
    radius : of the lens; None for a drawn one
    """

    def __init__(
        self, trial: Trial, n: int, dtype: Any = np.float32, radius: float | None = None
    ) -> None:
        rng = trial.rng
        forward, up = rng.standard_normal((2, 3))
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, up)
        right /= np.linalg.norm(right)
        self.axes = np.stack((right, np.cross(right, forward), forward))
        """right, up and forward, a row each."""
        self.origin = rng.uniform(-3, 3, 3)
        self.focus = float(np.exp(rng.uniform(np.log(0.7), np.log(20))))
        d = self.axes.T @ np.concatenate((rng.uniform(-1, 1, (2, n)), np.ones((1, n))))
        self.directions = np.ascontiguousarray(d / np.linalg.norm(d, axis=0), dtype)
        self.radius = float(rng.uniform(0.05, 0.4)) if radius is None else radius
        r, phi = np.sqrt(rng.random(n)), rng.uniform(0, 2 * np.pi, n)
        self.lens = (self.radius * np.stack((r * np.cos(phi), r * np.sin(phi)))).astype(dtype)

    def arguments(
        self, directions: Array | None = None, lens: Array | None = None, focus: float | None = None
    ) -> tuple[Any, ...]:
        """All arguments, with the batches or the distance replaced."""
        return (
            self.origin,
            *self.axes,
            self.directions if directions is None else directions,
            self.lens if lens is None else lens,
            self.focus if focus is None else focus,
        )

    def sharp(self) -> Array:
        """Where the pinhole's rays meet the plane in focus, (3, N) in the world."""
        d = self.directions.astype(np.float64)
        return np.asarray(self.origin[:, None] + d * (self.focus / (self.axes[2] @ d)))

    def tolerance(self) -> float:
        """What coordinates of points of the plane in focus may be off by in single precision."""
        reach = float(np.abs(self.origin).max()) + self.radius + 2 * self.focus
        # A point's own rounding, and that of a direction to it; seen under 55 degrees at the most.
        return 32 * EPSILON * (1 + reach)


def _rays(trial: Trial, camera: Camera, **other: Any) -> tuple[Array, Array]:
    """Origins and directions of the student's rays, float64."""
    arguments = camera.arguments(**other)
    n = arguments[4].shape[1]
    value = trial.call(*arguments)
    origins, directions = pair(value, "origins", "directions")
    return finite_numbers(origins, (3, n), "origins"), finite_numbers(
        directions, (3, n), "directions"
    )


def _met(camera: Camera, origins: Array, directions: Array) -> Array:
    """Where rays meet the plane in focus, (3, N) in the world."""
    forward = camera.axes[2]
    along = forward @ directions
    if not (along > 0).all():
        worst = int(along.argmin())
        raise Failure(
            "every ray to go forward",
            f"dot(direction, forward) = {along[worst]:.6g}",
            at(lens_point=camera.lens, direction=camera.directions)(worst),
            "A ray goes from the lens to the point in focus, not back.",
        )
    t = (camera.focus - forward @ (origins - camera.origin[:, None])) / along
    return np.asarray(origins + t * directions)


def _lens_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        camera = Camera(trial, 200, dtype)
        for focus in (camera.focus, 1e-3, 1e6):
            for n in (200, 1, 0):
                batches = camera.directions[:, :n].copy(), camera.lens[:, :n].copy()
                for name, value in zip(
                    ("origins", "directions"),
                    pair(trial.call(*camera.arguments(*batches, focus)), "origins", "directions"),
                    strict=True,
                ):
                    check_array(value, (3, n), dtype, name)
    mixed = camera.arguments(camera.directions.astype(np.float32))
    for value in pair(trial.call(*mixed), "origins", "directions"):
        check_array(value, (3, 200), np.float64, "the result of float32 and float64")


def _lens_untouched(trial: Trial) -> None:
    check_untouched(trial, *Camera(trial, 50).arguments())


def _lens_refuses(trial: Trial) -> None:
    camera = Camera(trial, 4)
    good = list(camera.arguments())
    wrong: list[tuple[int, str, Any]] = [
        (k, name, bad)
        for k, name in enumerate(("origin", "right", "up", "forward"))
        for bad in (np.zeros(2), np.zeros((3, 1)), np.zeros(4))
    ]
    wrong += [(4, "directions", bad) for bad in (good[4][:2], good[4][:, 0], good[4].T)]
    wrong += [(5, "lens_points", bad) for bad in (good[5][:1], good[5][:, :3], good[4])]
    wrong += [(6, f"focus_distance {bad}", bad) for bad in (0.0, -1.0, nan)]
    for position, name, bad in wrong:
        check_refused(trial, *good[:position], bad, *good[position + 1 :], named=name)


def _lens_pinhole(trial: Trial) -> None:
    for dtype in DTYPES:
        camera = Camera(trial, 2000, dtype)
        lens = camera.lens.copy()
        middle = trial.rng.random(2000) < 0.5
        lens[:, middle] = 0
        for points, part in ((0 * lens, slice(None)), (lens, middle)):
            origins, directions = _rays(trial, camera, lens=points)
            start = np.repeat(camera.origin.astype(dtype)[:, None], 2000, axis=1)[:, part]
            check_close(
                origins[:, part],
                start,
                0.0,
                "at lens point (0, 0), the camera's origin:",
                hint="A lens without size is a pinhole.",
            )
            d = camera.directions[:, part]
            check_close(
                directions[:, part],
                d,
                0.0,
                "at lens point (0, 0), the pinhole's direction bit for bit:",
                at(direction=d),
                "Does your way to the point in focus and back round what was exact?",
            )


def _lens_origins(trial: Trial) -> None:
    for _ in range(3):
        camera = Camera(trial, 2000)
        origins, _ = _rays(trial, camera)
        right, up, _ = camera.axes
        expected = camera.origin[:, None] + np.outer(right, camera.lens[0])
        expected = expected + np.outer(up, camera.lens[1])
        trial.show(
            "points",
            "your rays' origins along right and up, by the lens's radius",
            yours=camera.axes[:2] @ (origins - camera.origin[:, None])[:, :2000] / camera.radius,
            expected=camera.lens[:, :2000] / camera.radius,
        )
        check_close(
            origins,
            expected,
            16 * EPSILON * (4 + camera.radius),
            "origin + x right + y up:",
            at(lens_point=camera.lens),
            "Lens points are distances along the camera's own axes, right and up.",
        )


def _lens_unit(trial: Trial) -> None:
    for radius in (0.01, 0.3, 5.0):
        camera = Camera(trial, 2000, radius=radius)
        _, directions = _rays(trial, camera)
        check_close(
            np.linalg.norm(directions, axis=0),
            np.ones(2000),
            UNIT,
            "length of the direction:",
            at(lens_point=camera.lens, direction=camera.directions),
            "Normalise at the end.",
        )


def _lens_plane(trial: Trial) -> None:
    for _ in range(4):
        camera = Camera(trial, 3000)
        rays = _rays(trial, camera)
        check_close(
            _met(camera, *rays),
            camera.sharp(),
            camera.tolerance(),
            f"on the plane in focus at {camera.focus:.4g}, the pinhole's point:",
            at(lens_point=camera.lens, direction=camera.directions),
            "Every ray goes through the point where the pinhole's ray meets the plane in focus.",
        )


def _lens_one_point(trial: Trial) -> None:
    camera = Camera(trial, 1000)
    corner = camera.axes.T @ np.array((*trial.rng.choice((-1.0, 1.0), 2), 1.0))
    d = (corner / np.linalg.norm(corner)).astype(np.float32)
    camera.directions = np.repeat(d[:, None], 1000, axis=1)
    met = _met(camera, *_rays(trial, camera))
    check_close(
        met,
        np.repeat(met.mean(axis=1)[:, None], 1000, axis=1),
        2 * camera.tolerance(),
        "in the picture's corner, one point for all rays of the pixel:",
        at(lens_point=camera.lens),
        "What is in focus is sharp: all rays of one pixel meet there.",
    )


# ---------------------------------------------------------------- image_distance


def _lenses(trial: Trial, n: int, nearer: bool) -> list[tuple[float, float]]:
    """Focal lengths, and distances of objects beyond them or nearer."""
    focal = np.exp(trial.rng.uniform(np.log(0.01), np.log(10), n))
    ratio = trial.rng.uniform(0.1, 0.9, n) if nearer else 1 + trial.rng.uniform(0.1, 20, n)
    return [(float(f), float(f * r)) for f, r in zip(focal, ratio, strict=True)]


def _image(trial: Trial, focal: float, distance: float) -> float:
    return _number(trial.call(focal, distance))


def _check_image(trial: Trial, focal: float, distance: float, expected: float, hint: str) -> None:
    found = _image(trial, focal, distance)
    right = found == expected or abs(found - expected) <= 1e-9 * abs(expected) < inf
    if not right:
        raise Failure(
            f"{expected:.10g}",
            f"{found:.10g}",
            f"focal_length = {focal:.6g}, object_distance = {distance:.6g}",
            hint,
        )


def _image_contract(trial: Trial) -> None:
    for focal, distance in (*_lenses(trial, 5, nearer=False), (1.0, 2.0), (2.0, 1.0)):
        value = trial.call(focal, distance)
        if isinstance(value, bool) or not isinstance(value, float | np.floating):
            raise Failure("a float", type(value).__name__)
        if not isfinite(value):
            raise Failure(
                "a finite number",
                f"{value}",
                f"focal_length = {focal:.6g}, object_distance = {distance:.6g}",
            )


def _image_untouched(trial: Trial) -> None:
    check_untouched(trial, 1.0, 3.0)


def _image_refuses(trial: Trial) -> None:
    for bad in (0.0, -1.0, nan):
        check_refused(trial, bad, 1.0, named=f"focal_length {bad}")
        check_refused(trial, 1.0, bad, named=f"object_distance {bad}")


def _image_real(trial: Trial) -> None:
    for f, d in _lenses(trial, 20, nearer=False):
        hint = "The reciprocals of both distances add up to that of the focal length."
        _check_image(trial, f, d, f * d / (d - f), hint)


def _image_virtual(trial: Trial) -> None:
    for f, d in _lenses(trial, 20, nearer=True):
        hint = "An object nearer than the focal length has a virtual image: a negative distance."
        _check_image(trial, f, d, f * d / (d - f), hint)


def _image_limits(trial: Trial) -> None:
    for f, _ in (*_lenses(trial, 5, nearer=False), (0.05, 0.0), (1.0, 0.0)):
        _check_image(trial, f, f, inf, "An object at the focal length has its image at infinity.")
        far = "An object far away has its image at the focal length."
        _check_image(trial, f, inf, f, far)
        _check_image(trial, f, 1e6 * f, f * 1e6 / (1e6 - 1), far)


# ---------------------------------------------------------------- circle_of_confusion


def _circle_case(trial: Trial, n: int, dtype: Any = np.float32) -> tuple[Array, float, float]:
    """Depths, the aperture's radius and the distance in focus."""
    focus = float(np.exp(trial.rng.uniform(np.log(0.5), np.log(20))))
    depth = focus * np.exp(trial.rng.uniform(np.log(0.02), np.log(50), n))
    return depth.astype(dtype), float(trial.rng.uniform(0.01, 0.5)), focus


def _circle_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        depth, radius, focus = _circle_case(trial, 500, dtype)
        depth = np.concatenate((depth, np.array([1e-6, 1e-3, 1e6, 1e30], dtype)))
        for batch in (depth, depth[:1].copy(), depth[:0].copy()):
            for aperture, distance in ((radius, focus), (0.0, 1.0), (1.0, 1e-6), (1.0, 1e6)):
                value = trial.call(batch, aperture, distance)
                check_array(value, batch.shape, dtype)


def _circle_untouched(trial: Trial) -> None:
    check_untouched(trial, *_circle_case(trial, 50))


def _circle_refuses(trial: Trial) -> None:
    depth, radius, focus = _circle_case(trial, 4)
    for bad in (depth[None], np.float32(1), depth.reshape(2, 2)):
        check_refused(trial, bad, radius, focus, named="depth")
    for number in (0.0, -1.0, nan):
        wrong = depth.copy()
        wrong[2] = number
        check_refused(trial, wrong, radius, focus, named=f"depth {number}")
        check_refused(trial, depth, radius, number, named=f"focus_distance {number}")
    for number in (-1.0, nan):
        check_refused(trial, depth, number, focus, named=f"aperture_radius {number}")


def _circle(depth: Array, radius: float, focus: float) -> Array:
    """The diameter in double precision."""
    return np.asarray(2 * radius * np.abs(focus / depth.astype(np.float64) - 1))


def _check_circle(trial: Trial, depth: Array, radius: float, focus: float, hint: str) -> None:
    found = finite_numbers(trial.call(depth, radius, focus), depth.shape)
    expected = _circle(depth, radius, focus)
    # Near the focus all that is left is the rounding of focus_distance and depth.
    scale = expected + 2 * radius * (1 + focus / depth.astype(np.float64))
    excess = np.abs(found - expected) - 8 * EPSILON * scale
    worst = int(excess.argmax())
    if not excess[worst] <= 0:
        raise Failure(
            f"diameter {expected[worst]:.7g}",
            f"{found[worst]:.7g}",
            f"depth = {depth[worst]:.6g}, aperture_radius = {radius:.6g}, focus_distance = {focus:.6g}",
            hint,
        )


def _circle_behind(trial: Trial) -> None:
    for dtype in DTYPES:
        depth, radius, focus = _circle_case(trial, 2000, dtype)
        hint = "Two similar triangles: lens and point, circle and point."
        _check_circle(trial, depth[depth > 1.01 * focus], radius, focus, hint)


def _circle_in_front(trial: Trial) -> None:
    for dtype in DTYPES:
        depth, radius, focus = _circle_case(trial, 2000, dtype)
        hint = "In front of the plane in focus a diameter is positive as well."
        _check_circle(trial, depth[depth < 0.99 * focus], radius, focus, hint)


def _circle_limits(trial: Trial) -> None:
    _, radius, focus = _circle_case(trial, 1)
    focus = float(np.float32(focus))
    sharp = "What is in focus spreads over nothing."
    _check_circle(trial, np.array([focus], np.float32), radius, focus, sharp)
    far = "Very far points spread over a circle as wide as the lens."
    _check_circle(trial, np.array([1e8, 1e20], np.float32), radius, focus, far)
    _check_circle(trial, _circle_case(trial, 20)[0], 0.0, focus, "A pinhole shows all sharp.")


def _circle_overflow(trial: Trial) -> None:
    for dtype in DTYPES:
        depth = np.array([np.finfo(dtype).tiny, 1.0], dtype)
        value = trial.call(depth, float(trial.rng.uniform(50, 100)), 20.0)
        what = "the diameter of a point all but on the lens"
        found = float(check_array(value, depth.shape, dtype, what)[0])
        largest = float(np.finfo(dtype).max)
        if not found >= largest * (1 - 4 * float(np.finfo(dtype).eps)):
            raise Failure(
                f"{what}: the largest finite number, {largest:.6g}",
                f"{found:.6g}",
                f"depth = {depth[0]:.6g}",
                "The formula's value is larger than the dtype can hold.",
            )


# ---------------------------------------------------------------- mistakes


def _radius_is(trial: Trial, model: Callable[[Array], Array], rim: float = 1.0) -> bool:
    """Radii are spread as a mistaken warp of uniform numbers spreads them, evenly all around."""
    points = _disk(trial, 4000)
    r, turn = np.hypot(*points), _by_area(points)[1]
    fits = apart(r, rim * model(trial.rng.random(4000))) < CLOSE
    return fits and apart(turn, trial.rng.random(4000)) < CLOSE


def _disk_crowded(trial: Trial) -> bool:
    return _radius_is(trial, lambda u: u)


def _disk_squared(trial: Trial) -> bool:
    return _radius_is(trial, lambda u: u * u)


def _disk_half_as_wide(trial: Trial) -> bool:
    return _radius_is(trial, np.sqrt, 0.5)


def _disk_rim(trial: Trial) -> bool:
    return bool(np.abs(np.hypot(*_disk(trial, 1000)) - 1).max() < 1e-3)


def _disk_square(trial: Trial) -> bool:
    points = _disk(trial, 4000)
    uniform = trial.rng.random(4000)
    even = max(apart((x + 1) / 2, uniform) for x in points) < CLOSE
    return even and bool(np.hypot(*points).max() > 1.2)


def _disk_half_turn(trial: Trial) -> bool:
    points = _disk(trial, 4000)
    turns = np.sort(_by_area(points)[1])
    gap = float(np.diff(np.concatenate((turns, turns[:1] + 1))).max())
    r = np.hypot(*points)
    return 0.48 < gap < 0.52 and bool(r.max() < 1 + 1e-3 and r.std() > 0.05)


def _disk_degrees(trial: Trial) -> bool:
    points = _disk(trial, 4000)
    turn = _by_area(points)[1]
    return bool(turn.max() < 0.2 and turn.std() > 1e-3)


def _disk_one_number(trial: Trial) -> bool:
    u = trial.uniform(2, 500)
    found = finite_numbers(trial.call(u), u.shape)
    if found.std(axis=1).min() < 0.01:
        return False
    for row in range(2):
        other = u.copy()
        other[row] = trial.uniform(1, 500)[0]
        if np.array_equal(found, finite_numbers(trial.call(other), u.shape)):
            return True
    return False


def _right_origins(camera: Camera) -> Array:
    return np.asarray(camera.origin[:, None] + camera.axes[:2].T @ camera.lens)


def _mistaken_camera(trial: Trial) -> Camera:
    """A wide lens focused nearby, so that mistakes are far apart."""
    camera = Camera(trial, 500, radius=0.4)
    camera.focus = float(trial.rng.uniform(1.4, 2.6))
    return camera


Target = Callable[[Camera], Array]
"""The point that each ray goes through by mistake."""


def _aims_at(trial: Trial, target: Target) -> bool:
    """Origins are right, and the directions those to other points."""
    camera = _mistaken_camera(trial)
    origins, directions = _rays(trial, camera)
    aimed = normalized(target(camera) - _right_origins(camera))
    return near(origins, _right_origins(camera)) and near(normalized(directions), aimed)


def _lens_sphere(trial: Trial) -> bool:
    return _aims_at(trial, lambda c: c.origin[:, None] + c.directions * c.focus)


def _lens_no_origin(trial: Trial) -> bool:
    return _aims_at(trial, lambda c: c.sharp() - c.origin[:, None])


def _lens_wrong_cosine(trial: Trial) -> bool:
    return _aims_at(
        trial,
        lambda c: c.origin[:, None] + c.directions * (c.focus * (c.axes[2] @ c.directions)),
    )


def _lens_unchanged_directions(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    origins, directions = _rays(trial, camera)
    return near(origins, _right_origins(camera)) and near(directions, camera.directions)


def _lens_unchanged_origins(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    origins, directions = _rays(trial, camera)
    start = np.repeat(camera.origin[:, None], 500, axis=1)
    return near(origins, start) and not near(directions, camera.directions)


def _lens_only_relative(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    origins, _ = _rays(trial, camera)
    return near(origins, _right_origins(camera) - camera.origin[:, None])


def _lens_world_axes(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    origins, _ = _rays(trial, camera)
    offset = origins - camera.origin[:, None]
    x, y = camera.lens
    return any(
        near(offset, np.insert(np.stack((x, y)), k, np.zeros(500), axis=0)) for k in range(3)
    )


def _lens_swapped(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    origins, _ = _rays(trial, camera)
    return near(origins - camera.origin[:, None], camera.axes[1::-1].T @ camera.lens)


def _lens_not_normalised(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    origins, directions = _rays(trial, camera)
    long = np.abs(np.linalg.norm(directions, axis=0) - 1).max() > 1e-3
    return bool(long) and near(_met(camera, origins, directions), camera.sharp())


def _lens_rounded(trial: Trial) -> bool:
    camera = _mistaken_camera(trial)
    camera.lens *= 0
    origins, directions = _rays(trial, camera)
    start = np.repeat(camera.origin.astype(np.float32)[:, None], 500, axis=1)
    off = float(np.abs(directions - camera.directions).max())
    return bool((origins == start).all()) and 0 < off < 1e-5


Formula = Callable[[float, float], float]


def _image_is(trial: Trial, mistaken: Formula, nearer: tuple[bool, ...] = (False, True)) -> bool:
    """Everywhere, to six digits, what a mistaken formula gives."""
    return all(
        abs(_image(trial, f, d) - mistaken(f, d)) <= 1e-6 * abs(mistaken(f, d))
        for side in nearer
        for f, d in _lenses(trial, 5, side)
    )


def _gauss(f: float, d: float) -> float:
    return f * d / (d - f)


def _image_sum(trial: Trial) -> bool:
    return _image_is(trial, lambda f, d: f * d / (d + f))


def _image_negated(trial: Trial) -> bool:
    return _image_is(trial, lambda f, d: -_gauss(f, d))


def _image_reciprocal(trial: Trial) -> bool:
    return _image_is(trial, lambda f, d: 1 / _gauss(f, d))


def _image_absolute(trial: Trial) -> bool:
    return _image_is(trial, lambda f, d: abs(_gauss(f, d)))


def _image_at_focus(trial: Trial) -> bool:
    """Right, but for an object at the focal length or at infinity."""
    if not _image_is(trial, _gauss):
        return False
    for f, d in ((0.5, 0.5), (0.5, inf)):
        try:
            found = _image(trial, f, d)
        except StudentError:
            return True
        if found != (inf if d == f else f):
            return True
    return False


def _circle_is(trial: Trial, mistaken: Callable[[Array, float, float], Array]) -> bool:
    for _ in range(2):
        depth, radius, focus = _circle_case(trial, 200, np.float64)
        found = finite_numbers(trial.call(depth, radius, focus), depth.shape)
        expected = mistaken(depth, radius, focus)
        if not (np.abs(found - expected) <= 1e-5 * (radius + np.abs(expected))).all():
            return False
    return True


def _circle_half(trial: Trial) -> bool:
    return _circle_is(trial, lambda z, a, f: _circle(z, a, f) / 2)


def _circle_double(trial: Trial) -> bool:
    return _circle_is(trial, lambda z, a, f: 2 * _circle(z, a, f))


def _circle_at_depth(trial: Trial) -> bool:
    return _circle_is(trial, lambda z, a, f: 2 * a * np.abs(f - z) / f)


def _circle_signed(trial: Trial) -> bool:
    return _circle_is(trial, lambda z, a, f: 2 * a * (f - z) / z) or _circle_is(
        trial, lambda z, a, f: 2 * a * (z - f) / z
    )


def _circle_not_divided(trial: Trial) -> bool:
    return _circle_is(trial, lambda z, a, f: 2 * a * np.abs(f - z))


# ---------------------------------------------------------------- all of them


CHECKS = ModuleChecks(
    "thin_lens",
    checks=(
        *contract_checks("point_on_disk", _disk_contract, _disk_untouched, _disk_refuses),
        Check("point_on_disk", "inside", "Points lie on the unit disk", _disk_inside),
        distribution_check(
            "point_on_disk", "uniform", "Points are uniform over the disk's area", _disk_uniform, 6
        ),
        distribution_check(
            "point_on_disk",
            "moments",
            "Means, spread and correlation of the points are those of the disk",
            _disk_moments,
            5,
        ),
        *contract_checks("lens_rays", _lens_contract, _lens_untouched, _lens_refuses),
        Check(
            "lens_rays",
            "pinhole",
            "The lens's centre gives the pinhole's rays bit for bit",
            _lens_pinhole,
        ),
        Check(
            "lens_rays",
            "on_lens",
            "Rays start on the lens, at their lens points",
            _lens_origins,
        ),
        Check("lens_rays", "unit_length", "Directions are unit length", _lens_unit),
        Check(
            "lens_rays",
            "plane_in_focus",
            "Rays meet the pinhole's rays on the plane in focus",
            _lens_plane,
        ),
        Check(
            "lens_rays",
            "one_point",
            "All rays of one pixel meet in one point, in the picture's corners too",
            _lens_one_point,
        ),
        *contract_checks("image_distance", _image_contract, _image_untouched, _image_refuses),
        Check(
            "image_distance",
            "real",
            "Objects beyond the focal length have their image where the lens formula says",
            _image_real,
        ),
        Check(
            "image_distance",
            "virtual",
            "Nearer objects have a virtual image, at a negative distance",
            _image_virtual,
        ),
        Check(
            "image_distance",
            "limits",
            "Objects at the focal length, and at infinity",
            _image_limits,
        ),
        *contract_checks(
            "circle_of_confusion", _circle_contract, _circle_untouched, _circle_refuses
        ),
        Check(
            "circle_of_confusion",
            "behind",
            "Points behind the plane in focus spread as far as they should",
            _circle_behind,
        ),
        Check(
            "circle_of_confusion",
            "in_front",
            "Points in front of the plane in focus spread as far as they should",
            _circle_in_front,
        ),
        Check(
            "circle_of_confusion",
            "limits",
            "Nothing in focus, the lens's diameter far away, nothing for a pinhole",
            _circle_limits,
        ),
        Check(
            "circle_of_confusion",
            "overflow",
            "What is too large for the dtype is the largest finite number",
            _circle_overflow,
            "contract",
        ),
    ),
    mistakes=(
        Mistake(
            "point_on_disk",
            "crowded-centre",
            "Your points crowd the centre: a uniform radius is not uniform in area.",
            _disk_crowded,
        ),
        Mistake(
            "point_on_disk",
            "radius-squared",
            "Your points crowd the centre even more than a uniform radius would: you warp it the wrong way round.",
            _disk_squared,
        ),
        Mistake(
            "point_on_disk",
            "half-as-wide",
            "Your disk has the diameter 1; the unit disk has the radius 1.",
            _disk_half_as_wide,
        ),
        Mistake(
            "point_on_disk",
            "rim-only",
            "Your points all lie on the rim; they have to fill the disk.",
            _disk_rim,
        ),
        Mistake(
            "point_on_disk",
            "square",
            "Your points fill a square, and its corners stick out of the disk.",
            _disk_square,
        ),
        Mistake(
            "point_on_disk",
            "one-number",
            "You use one of the two numbers only, so your points lie on a spiral.",
            _disk_one_number,
        ),
        Mistake(
            "point_on_disk",
            "half-turn",
            "Your points fill half a disk: the angle goes only half way round.",
            _disk_half_turn,
        ),
        Mistake(
            "point_on_disk",
            "part-turn",
            "Your points fill a narrow slice: does your angle go all the way round, in radians?",
            _disk_degrees,
        ),
        Mistake(
            "lens_rays",
            "sphere",
            "You focus on a sphere around the lens: measure the distance along forward, not along the ray.",
            _lens_sphere,
        ),
        Mistake(
            "lens_rays",
            "wrong-cosine",
            "Your points in focus come nearer towards the picture's corners: the cosine belongs on the other side.",
            _lens_wrong_cosine,
        ),
        Mistake(
            "lens_rays",
            "forgotten-origin",
            "Your point in focus is measured from the world's origin, not from the camera.",
            _lens_no_origin,
        ),
        Mistake(
            "lens_rays",
            "unchanged-directions",
            "You move the origins but keep the pinhole's directions, so nothing is in focus.",
            _lens_unchanged_directions,
        ),
        Mistake(
            "lens_rays",
            "unchanged-origins",
            "You change the directions, but all rays still start at the lens's centre.",
            _lens_unchanged_origins,
        ),
        Mistake(
            "lens_rays",
            "lens-at-world-origin",
            "Your lens lies at the world's origin instead of the camera's.",
            _lens_only_relative,
        ),
        Mistake(
            "lens_rays",
            "world-axes",
            "Your lens lies along the world's axes; it turns with the camera.",
            _lens_world_axes,
        ),
        Mistake(
            "lens_rays",
            "swapped-axes",
            "You have swapped right and up.",
            _lens_swapped,
        ),
        Mistake(
            "lens_rays",
            "not-normalised",
            "Your rays go through the right points, but their directions are not of length 1.",
            _lens_not_normalised,
        ),
        Mistake(
            "lens_rays",
            "rounded",
            "At the lens's centre your direction is right but for rounding; there it has to be the pinhole's exactly.",
            _lens_rounded,
        ),
        Mistake(
            "image_distance",
            "added",
            "You add the reciprocal of the object's distance where the lens formula has a difference.",
            _image_sum,
        ),
        Mistake(
            "image_distance",
            "wrong-sign",
            "Your sign is the wrong way round: real images are positive, virtual ones negative.",
            _image_negated,
        ),
        Mistake(
            "image_distance",
            "reciprocal",
            "What you return is the reciprocal of the image's distance.",
            _image_reciprocal,
        ),
        Mistake(
            "image_distance",
            "always-positive",
            "You make every distance positive; a virtual image is on the object's own side, so it is negative.",
            _image_absolute,
        ),
        Mistake(
            "image_distance",
            "limits",
            "Your formula is right, but it breaks where a distance or a difference is infinite or zero.",
            _image_at_focus,
        ),
        Mistake(
            "circle_of_confusion",
            "radius-for-diameter",
            "Your circle is half as wide: you return its radius, or take the aperture's radius for its diameter.",
            _circle_half,
        ),
        Mistake(
            "circle_of_confusion",
            "diameter-for-radius",
            "Your circle is twice as wide: the aperture is given by its radius.",
            _circle_double,
        ),
        Mistake(
            "circle_of_confusion",
            "relative-to-focus",
            "You divide by the distance in focus; the similar triangles have their tip at the point.",
            _circle_at_depth,
        ),
        Mistake(
            "circle_of_confusion",
            "signed",
            "Your diameter changes its sign at the plane in focus; a width is never negative.",
            _circle_signed,
        ),
        Mistake(
            "circle_of_confusion",
            "not-divided",
            "Your circle grows with the distance from the plane in focus only; how far is the point from the lens?",
            _circle_not_divided,
        ),
    ),
)
