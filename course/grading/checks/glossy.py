"""Checks of the glossy module: the basis about a direction, the lobes of square, ball and Phong, and the mirroring.

A right function may turn or mirror its square, use the rows of u in any order and sense, and choose any basis, so
all that is looked at is what stays the same whatever it chose.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np

from course.grading.checks import squares
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
from course.grading.checks.vectors import UNIT, check_unit, cross, dot, normalized, unit_vectors

NEAR_POLE = (0.00038527316, 0.00038460016, -0.99999988079)
"""Where a basis in single precision that divides by 1 + z falls to pieces."""


POINTS = 5000
"""Of each axis, in a check of a distribution."""

CELLS = (12, 12)


# ---------------------------------------------------------------- directions and values


def _everywhere(rng: np.random.Generator, dtype: Any, n: int = 500) -> Array:
    """Unit vectors along the axes, in rings closer and closer around them, and anywhere."""
    vectors = [NEAR_POLE, (-NEAR_POLE[1], NEAR_POLE[0], NEAR_POLE[2])]
    for axis, end in product(range(3), (1.0, -1.0)):
        for width in (0.0, *np.geomspace(1e-9, 0.3, 24)):
            turn = rng.uniform(0, 2 * np.pi)
            vectors.append(
                tuple(np.roll((width * np.cos(turn), width * np.sin(turn), end), axis - 2))
            )
    v = np.concatenate((np.array(vectors).T, rng.standard_normal((3, n))), axis=1)
    return np.ascontiguousarray(v / np.linalg.norm(v, axis=0), dtype)


def _axes(rng: np.random.Generator) -> Array:
    """Four axes of lobes: two drawn ones, -z and next to it."""
    few = np.array([(0.0, 0.0, -1.0), NEAR_POLE], np.float32).T
    return np.concatenate((unit_vectors(rng, 2, np.float32), few), axis=1)


def _about(axis: Array, result: Array) -> tuple[Array, Array]:
    """1 - cos(alpha) of each result, without cancellation, and its turn about the axis, 0 to 1."""
    w = axis.astype(np.float64) / np.linalg.norm(axis.astype(np.float64))
    a = np.cross(w, np.eye(3)[np.abs(w).argmin()])
    a /= np.linalg.norm(a)
    result = normalized(result)
    turn = np.arctan2(np.cross(w, a) @ result, a @ result) / (2 * np.pi) % 1
    return ((result - w[:, None]) ** 2).sum(axis=0) / 2, turn


def _show_lobe(trial: Trial, share: Array, turn: Array, title: str) -> None:
    """Draw (share within alpha, turn) as points of the unit disk: right ones fill its area evenly."""
    radius, phi = np.sqrt(share[:2000]), 2 * np.pi * turn[:2000]
    trial.show("points", title, yours=np.stack((radius * np.cos(phi), radius * np.sin(phi))))


# ---------------------------------------------------------------- contract, for all lobes


def _worst(trial: Trial, rows: int, dtype: Any) -> tuple[Array, Array]:
    """Every seventh pair of a direction and of worst numbers."""
    w, worst = _everywhere(trial.rng, dtype, 20), worst_units(rows, dtype)
    d = np.repeat(w, worst.shape[1], axis=1)[:, ::7].copy()
    return d, np.tile(worst, w.shape[1])[:, ::7].copy()


def _check_lobe_contract(trial: Trial, rows: int, sizes: tuple[float, ...]) -> None:
    for dtype in DTYPES:
        d, u = _worst(trial, rows, dtype)
        for size in sizes:
            check_array(trial.call(d, size, u), d.shape, dtype, f"the result for size {size:g}")
    size = sizes[1]
    check_array(trial.call(d[:, :0], size, u[:, :0]), (3, 0), np.float64)
    mixed = trial.call(d.astype(np.float32), size, u)
    check_array(mixed, d.shape, np.float64, "the result of float32 directions and float64 u")


def _check_lobe_unit(trial: Trial, rows: int, name: str, sizes: tuple[float, ...]) -> None:
    d, u = _worst(trial, rows, np.float32)
    few, numbers = unit_vectors(trial.rng, 500, np.float32), trial.uniform(rows, 500)
    d, u = np.concatenate((d, few), axis=1), np.concatenate((u, numbers), axis=1)
    for size in sizes:
        result = finite_numbers(trial.call(d, size, u), d.shape)
        check_unit(result, at(direction=d, u=u), f"for {name} {size:g}, length of the result:")


def _check_lobe_untouched(trial: Trial, rows: int, size: float) -> None:
    check_untouched(trial, unit_vectors(trial.rng, 50, np.float32), size, trial.uniform(rows, 50))


def _check_lobe_refuses(trial: Trial, rows: int, name: str, wrong: tuple[float, ...]) -> None:
    d, u = unit_vectors(trial.rng, 4, np.float32), trial.uniform(rows, 4)
    for bad in (d[:2], d[0], d.T):
        check_refused(trial, bad, 0.5, u, named="direction")
    for bad in (u[:1], u[0], u[:, :3], np.concatenate((u, u))):
        check_refused(trial, d, 0.5, bad, named="u")
    for size in wrong:
        check_refused(trial, d, size, u, named=f"{name} {size}")


def _check_no_jitter(trial: Trial, rows: int, name: str) -> None:
    for dtype in DTYPES:
        d = _everywhere(trial.rng, dtype, 300)
        result = trial.call(d, 0.0, trial.uniform(rows, d.shape[1], dtype))
        result = finite_numbers(result, d.shape)
        check_close(
            result,
            d,
            0.0,
            f"with {name} 0, the direction itself:",
            at(direction=d),
            "Nothing is to be added then; does your way to the result round what was exact?",
        )


# ---------------------------------------------------------------- orthonormal_basis


def _basis(trial: Trial, w: Array) -> tuple[Array, Array]:
    u, v = pair(trial.call(w), "u", "v")
    return finite_numbers(u, w.shape, "u"), finite_numbers(v, w.shape, "v")


def _basis_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        w = _everywhere(trial.rng, dtype)
        for batch in (w, w[:, :1].copy(), w[:, :0].copy()):
            for name, value in zip("uv", pair(trial.call(batch), "u", "v"), strict=True):
                check_array(value, batch.shape, dtype, name)


def _basis_untouched(trial: Trial) -> None:
    check_untouched(trial, unit_vectors(trial.rng, 50, np.float32))


def _basis_refuses(trial: Trial) -> None:
    w = unit_vectors(trial.rng, 4, np.float32)
    for bad in (w[:2], w[0], w.T, w[None]):
        check_refused(trial, bad, named="w")


def _check_orthonormal(trial: Trial, w: Array) -> None:
    u, v = _basis(trial, w)
    say, exact = at(w=w), normalized(w)
    check_unit(u, say, "length of u:", "u has to be a unit vector for every w.")
    check_unit(v, say, "length of v:", "v has to be a unit vector for every w.")
    zero = np.zeros(w.shape[1])
    for name, a, b in (("dot(u, v)", u, v), ("dot(u, w)", u, exact), ("dot(v, w)", v, exact)):
        check_close(dot(a, b), zero, UNIT, f"{name}:", say, "All three are at right angles.")


def _basis_orthonormal(trial: Trial) -> None:
    w = unit_vectors(trial.rng, 5000, np.float32)
    _check_orthonormal(trial, w[:, w[2] > -0.9])


def _basis_poles(trial: Trial) -> None:
    for dtype in DTYPES:
        _check_orthonormal(trial, _everywhere(trial.rng, dtype, 0))


def _basis_right_handed(trial: Trial) -> None:
    for dtype in DTYPES:
        w = _everywhere(trial.rng, dtype)
        u, v = _basis(trial, w)
        check_close(
            cross(u, v),
            normalized(w),
            2 * UNIT,
            "cross(u, v) = w:",
            at(w=w),
            "In a right-handed basis the cross product of the first two is the third.",
        )


# ---------------------------------------------------------------- jitter_on_plane


def _plane_squares(trial: Trial, roughness: float, axes: Array, n: int) -> Iterator[squares.Square]:
    """The squares of n directions jittered about each of some axes."""
    d = np.repeat(axes, n, axis=1)
    u = trial.uniform(2, d.shape[1])
    result = finite_numbers(trial.call(d, roughness, u), d.shape)
    for k, w in enumerate(normalized(axes).T):
        part = slice(n * k, n * (k + 1))
        yield squares.seen(w, u[:, part], result[:, part])


def _plane_square(trial: Trial) -> None:
    for roughness in trial.rng.uniform((0.05, 0.5), (0.5, 2.0)).tolist():
        for square in _plane_squares(trial, roughness, _axes(trial.rng), 100):
            squares.check_square(square, roughness)


def _plane_uniform(trial: Trial) -> None:
    roughness = float(trial.rng.uniform(0.2, 1.5))
    for square in _plane_squares(trial, roughness, _axes(trial.rng)[:, 1:], POINTS):
        squares.check_filled(trial, square, roughness)


# ---------------------------------------------------------------- jitter_in_ball


def _ball_share(h: Array, glossiness: float) -> Array:
    """The share of the ball within each cone; where the ball ends, 1.

    A cone of cos(alpha) = c leaves the share c w^3 / g^3 of the ball outside, w^2 = c^2 - (1 - g^2): the integral
    of the ball's extent along each ray, (t1^3 - t0^3) / 3 with t = c +- w, over the ball's volume.
    """
    w2 = np.maximum(glossiness**2 - h * (2 - h), 0)
    return np.asarray(np.clip(1 - (1 - h) * w2**1.5 / glossiness**3, 0, 1))


def _ball_cone(trial: Trial) -> None:
    for glossiness in (*trial.rng.uniform((0.05, 0.5), (0.5, 0.95)).tolist(), 0.999):
        d, u = unit_vectors(trial.rng, 2000, np.float32), trial.uniform(3, 2000)
        result = normalized(finite_numbers(trial.call(d, glossiness, u), d.shape))
        cos = dot(result, normalized(d))
        reach = float(np.sqrt(1 - glossiness**2))
        worst = int(cos.argmin())
        # The cosine changes with the sine of the angle there: the radius may be off by UNIT.
        if not cos[worst] >= reach - 2 * UNIT / reach:
            raise Failure(
                f"directions through a ball of radius {glossiness:.4g}: cosines over {reach:.5g}",
                f"{cos[worst]:.5g}",
                at(direction=d, u=u)(worst),
                "Is each point inside the ball, and glossiness its radius?",
            )


def _ball_uniform(trial: Trial) -> None:
    for glossiness in trial.rng.uniform((0.15, 0.6), (0.5, 0.95)).tolist():
        axes = _axes(trial.rng)[:, 1:]
        d = np.repeat(axes, POINTS, axis=1)
        result = finite_numbers(trial.call(d, glossiness, trial.uniform(3, d.shape[1])), d.shape)
        for k, axis in enumerate(axes.T):
            h, turn = _about(axis, result[:, POINTS * k : POINTS * (k + 1)])
            share = _ball_share(h, glossiness)
            _show_lobe(trial, share, turn, "ball's volume within your directions, by turn")
            check_uniform(
                np.stack((share, turn)),
                CELLS,
                f"directions of glossiness {glossiness:.4g} by the ball's volume and their turn",
                "Does every part of the ball get its share of points?",
            )


# ---------------------------------------------------------------- sample_phong_lobe


def _phong_in_front(trial: Trial) -> None:
    for exponent in (0.0, float(trial.rng.uniform(0.5, 50)), 1e4):
        d = _everywhere(trial.rng, np.float32, 2000)
        u = trial.uniform(2, d.shape[1])
        cos = dot(finite_numbers(trial.call(d, exponent, u), d.shape), normalized(d))
        worst = int(cos.argmin())
        if not cos[worst] >= -UNIT:
            raise Failure(
                "all directions within a right angle of the axis",
                f"cosine {cos[worst]:.6g} for exponent {exponent:.4g}",
                at(direction=d, u=u)(worst),
                "The lobe ends at a right angle to its axis.",
            )


def _phong_narrow(trial: Trial) -> None:
    exponent = 10.0 ** float(trial.rng.uniform(5, 6))
    d = _everywhere(trial.rng, np.float32, 2000)
    u = np.clip(trial.uniform(2, d.shape[1]), np.float32(1e-6), np.float32(1 - 1e-6))
    result = finite_numbers(trial.call(d, exponent, u), d.shape)
    # cos^(exponent + 1) is 1e-6 at the least, alpha^2 some -2 log(cos).
    check_close(
        np.linalg.norm(result - normalized(d), axis=0),
        np.zeros(d.shape[1]),
        1.1 * float(np.sqrt(2 * np.log(1e6) / exponent)) + 1e-3,
        f"with exponent {exponent:.3g}, distance from the axis:",
        at(direction=d, u=u),
        "The larger the exponent, the closer to a mirror.",
    )


def _exponents(trial: Trial) -> list[float]:
    return [0.0, *trial.rng.uniform((0.7, 15.0), (3.0, 80.0)).tolist()]


def _phong_density(trial: Trial) -> None:
    for exponent in _exponents(trial):
        axes = _axes(trial.rng)[:, 1:]
        d = np.repeat(axes, POINTS, axis=1)
        result = finite_numbers(trial.call(d, exponent, trial.uniform(2, d.shape[1])), d.shape)
        for k, axis in enumerate(axes.T):
            h, turn = _about(axis, result[:, POINTS * k : POINTS * (k + 1)])
            # The share of the lobe within alpha is 1 - cos^(exponent + 1).
            share = -np.expm1((exponent + 1) * np.log1p(-np.minimum(h, 1 - 1e-12)))
            _show_lobe(trial, share, turn, f"share of the lobe of {exponent:.3g} within yours")
            check_uniform(
                np.stack((share, turn)),
                CELLS,
                f"directions of exponent {exponent:.4g} by their share of the lobe and their turn",
                "Integrate the density over the cone of alpha: which angle has the share u within?",
            )


def _phong_mean(trial: Trial) -> None:
    for n in _exponents(trial):
        d = unit_vectors(trial.rng, 15000, np.float32)
        result = finite_numbers(trial.call(d, n, trial.uniform(2, 15000)), d.shape)
        mean = (n + 1) / (n + 2)
        check_mean(
            dot(result, normalized(d)),
            mean,
            (n + 1) / (n + 3) - mean**2,
            f"mean of cos(alpha) for exponent {n:.4g}",
            "It has to be (exponent + 1) / (exponent + 2).",
        )


# ---------------------------------------------------------------- keep_above


def _above_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        d = _everywhere(trial.rng, dtype)
        for n in (unit_vectors(trial.rng, d.shape[1], dtype), d, -d, np.roll(d, 3, axis=1)):
            check_array(trial.call(d, n), d.shape, dtype)
        check_array(trial.call(d[:, :0], n[:, :0]), (3, 0), dtype)
    mixed = trial.call(d.astype(np.float32), n)
    check_array(mixed, d.shape, np.float64, "the result of float32 and float64")


def _above_untouched(trial: Trial) -> None:
    check_untouched(
        trial, unit_vectors(trial.rng, 50, np.float32), unit_vectors(trial.rng, 50, np.float32)
    )


def _above_refuses(trial: Trial) -> None:
    d, n = unit_vectors(trial.rng, 4, np.float32), unit_vectors(trial.rng, 4, np.float32)
    for bad in (d[:2], d[0], d.T):
        check_refused(trial, bad, n, named="direction")
    for bad in (n[:2], n[:, :3], n[:, 0]):
        check_refused(trial, d, bad, named="normal")


def _above_case(trial: Trial, dtype: Any, below: bool) -> tuple[Array, Array, Array, Array]:
    """Directions and normals on one side, their exact dot products, and what came of them."""
    d, n = _everywhere(trial.rng, dtype, 3000), unit_vectors(trial.rng, 3000 + 152, dtype)
    n = n[:, : d.shape[1]]
    # All around one normal, close to the surface too.
    d = np.concatenate((d, _everywhere(trial.rng, dtype, 0)), axis=1)
    plus_z = np.zeros((3, d.shape[1] - n.shape[1]), dtype)
    plus_z[2] = 1
    n = np.concatenate((n, plus_z), axis=1)
    cosine = dot(d.astype(np.float64), n.astype(np.float64))
    side = np.flatnonzero(cosine < -2e-6 if below else cosine > 2e-6)
    d, n = d[:, side].copy(), n[:, side].copy()
    return d, n, cosine[side], finite_numbers(trial.call(d.copy(), n.copy()), d.shape)


def _above_unchanged(trial: Trial) -> None:
    for dtype in DTYPES:
        d, n, _, result = _above_case(trial, dtype, below=False)
        check_close(
            result,
            d,
            0.0,
            "a direction above, unchanged:",
            at(direction=d, normal=n),
            "What is above the surface already comes back bit for bit.",
        )


def _above_mirrored(trial: Trial) -> None:
    for dtype in DTYPES:
        d, n, cosine, result = _above_case(trial, dtype, below=True)
        check_close(
            result,
            d.astype(np.float64) - 2 * cosine * n,
            UNIT,
            "the mirrored direction,",
            at(direction=d, normal=n),
            "The part along the normal changes its sign, the rest stays.",
        )


def _above_batch(trial: Trial) -> None:
    d, n = unit_vectors(trial.rng, 2000, np.float32), unit_vectors(trial.rng, 2000, np.float32)
    result = finite_numbers(trial.call(d, n), d.shape)
    check_unit(result, at(direction=d, normal=n), "length of the result:", "A mirror keeps it.")
    cos = dot(result, n.astype(np.float64))
    expected = np.abs(dot(d.astype(np.float64), n.astype(np.float64)))
    check_close(
        cos,
        expected,
        UNIT,
        "height over the surface, the same as before or mirrored:",
        at(direction=d, normal=n),
        "Each column is above or below on its own.",
    )


# ---------------------------------------------------------------- mistakes


def _steady(trial: Trial) -> Array:
    """Directions well away from every axis, where any basis is fine."""
    w = unit_vectors(trial.rng, 2000, np.float32)
    return w[:, (np.abs(w).max(axis=0) < 0.9) & (np.abs(w).min(axis=0) > 0.05)]


def _basis_errors(trial: Trial, w: Array) -> tuple[float, float, float]:
    """The worst of lengths, of dot products and of the cross product; inf where something isn't finite."""
    try:
        u, v = _basis(trial, w)
    except Failure:  # something isn't finite
        return np.inf, np.inf, np.inf
    exact = normalized(w)
    lengths = np.linalg.norm(u, axis=0), np.linalg.norm(v, axis=0)
    dots = dot(u, v), dot(u, exact), dot(v, exact)
    return (
        max(float(np.abs(x - 1).max()) for x in lengths),
        max(float(np.abs(x).max()) for x in dots),
        float(np.abs(cross(u, v) - exact).max()),
    )


def _sound(trial: Trial, w: Array) -> bool:
    return max(_basis_errors(trial, w)) < 1e-3


def _left_handed(trial: Trial) -> bool:
    w = _steady(trial)
    u, v = _basis(trial, w)
    length, skew, _ = _basis_errors(trial, w)
    return max(length, skew) < 1e-4 and bool(np.abs(cross(u, v) + normalized(w)).max() < 1e-4)


def _ring(axis: tuple[float, float, float]) -> Array:
    """Directions next to an axis, but not on it."""
    turn = np.linspace(0, 2 * np.pi, 50)
    about = np.stack((np.cos(turn), np.sin(turn)))
    rings = np.concatenate([width * about for width in (2e-4, 4e-4, 6e-4)], axis=1)
    k = int(np.abs(axis).argmax())
    w = np.insert(rings, k, axis[k], axis=0)
    return np.ascontiguousarray(w / np.linalg.norm(w, axis=0), np.float32)


def _sound_next_to(trial: Trial, axis: tuple[float, float, float]) -> bool:
    on_it = np.array(axis, np.float32)[:, None]
    return _sound(trial, _ring(axis)) and _sound(trial, on_it)


def _breaks_at_minus_z(trial: Trial) -> bool:
    return (
        _sound(trial, _steady(trial))
        and _sound_next_to(trial, (0, 0, 1))
        and not _sound(trial, _ring((0, 0, -1)))
    )


def _fixed_helper(trial: Trial) -> bool:
    if not _sound(trial, _steady(trial)):
        return False
    for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        opposite = (-axis[0], -axis[1], -axis[2])
        if not (_sound_next_to(trial, axis) or _sound_next_to(trial, opposite)):
            return True
    return False


def _basis_not_normalised(trial: Trial) -> bool:
    w = _steady(trial)
    u, v = _basis(trial, w)
    length, skew, _ = _basis_errors(trial, w)
    return length > 0.05 and skew < 1e-4 and bool((dot(cross(u, v), normalized(w)) > 1e-3).all())


ROUGHNESS = 0.8
"""Of the square that is looked at for mistakes."""


def _plane_is(mistake: Callable[[squares.Square, float], bool]) -> Callable[[Trial], bool]:
    """Whether the square of one direction looks like that."""

    def matches(trial: Trial) -> bool:
        (square,) = _plane_squares(trial, ROUGHNESS, _steady(trial)[:, :1], 200)
        return mistake(square, ROUGHNESS)

    return matches


def _plane_world_axes(trial: Trial) -> bool:
    w = _steady(trial)[:, :500]
    u = trial.uniform(2, w.shape[1])
    result = normalized(finite_numbers(trial.call(w, ROUGHNESS, u), w.shape))
    for i, j in ((0, 1), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1)):
        jittered = normalized(w)
        jittered[i] += ROUGHNESS * (u[0] - 0.5)
        jittered[j] += ROUGHNESS * (u[1] - 0.5)
        if np.abs(normalized(jittered) - result).max() < 1e-4:
            return True
    return False


Warp = Callable[[Array], Array]
"""(3, N) numbers to (3, N) points."""


def _sphere(u: Array) -> Array:
    ring = np.sqrt(1 - (2 * u[0] - 1) ** 2)
    phi = 2 * np.pi * u[1]
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), 2 * u[0] - 1))


def _looks_like_ball(trial: Trial, warp: Warp) -> bool:
    """Directions along +z and +x are spread as those through points that a mistaken warp makes."""
    glossiness, n = 0.8, 4000
    for k in (2, 0):
        d = np.zeros((3, n), np.float32)
        d[k] = 1
        found = normalized(finite_numbers(trial.call(d, glossiness, trial.uniform(3, n)), d.shape))
        model = normalized(d + glossiness * warp(trial.rng.random((3, n))))
        if apart(found[k], model[k]) > CLOSE:
            return False
    return True


def _ball_surface(trial: Trial) -> bool:
    return _looks_like_ball(trial, _sphere)


def _ball_crowded(trial: Trial) -> bool:
    return _looks_like_ball(trial, lambda u: u[2] * _sphere(u))


def _ball_square_root(trial: Trial) -> bool:
    return _looks_like_ball(trial, lambda u: np.sqrt(u[2]) * _sphere(u))


def _ball_cube(trial: Trial) -> bool:
    return _looks_like_ball(trial, lambda u: 2 * u - 1)


def _ball_not_normalised(trial: Trial) -> bool:
    d = np.repeat(_steady(trial)[:, :1], 4000, axis=1)
    result = finite_numbers(trial.call(d, 0.8, trial.uniform(3, 4000)), d.shape)
    points = (result - d) / 0.8
    radius = np.linalg.norm(points, axis=0)
    off = np.abs(np.linalg.norm(result, axis=0) - 1).max() > 0.1
    even = apart(radius**3, trial.rng.random(4000)) < CLOSE
    return bool(off and radius.max() < 1 + 1e-4 and even)


def _phong_cosines(trial: Trial, exponent: float) -> Array:
    d = np.repeat(_steady(trial)[:, :1], 4000, axis=1)
    cos = dot(
        normalized(finite_numbers(trial.call(d, exponent, trial.uniform(2, 4000)), d.shape)),
        normalized(d),
    )
    if not cos.min() >= -1e-3:
        raise Failure("a lobe in front", "none")
    return np.asarray(np.clip(cos, 0, 1))


def _phong_with(trial: Trial, warp: Callable[[Array, float], Array]) -> bool:
    """The angles are spread as a mistaken warp (u, exponent) -> cos(alpha) spreads them."""
    return all(
        apart(_phong_cosines(trial, n), warp(trial.rng.random(4000), n)) < CLOSE for n in (1.0, 2.5)
    )


def _phong_off_by_one(trial: Trial) -> bool:
    return _phong_with(trial, lambda u, n: u ** (1 / n))


def _phong_extra_cosine(trial: Trial) -> bool:
    return _phong_with(trial, lambda u, n: u ** (1 / (n + 2)))


def _phong_sine(trial: Trial) -> bool:
    return _phong_with(trial, lambda u, n: np.sqrt(1 - u ** (2 / (n + 1))))


def _phong_no_exponent(trial: Trial) -> bool:
    narrow, wide = _phong_cosines(trial, 20.0), _phong_cosines(trial, 2.0)
    return apart(narrow, wide) < CLOSE and float(wide.std()) > 0.01


def _phong_half_turn(trial: Trial) -> bool:
    d = np.repeat(_steady(trial)[:, :1], 2000, axis=1)
    result = finite_numbers(trial.call(d, 2.0, trial.uniform(2, 2000)), d.shape)
    turns = np.sort(_about(d[:, 0], result)[1])
    gap = float(np.diff(np.concatenate((turns, turns[:1] + 1))).max())
    return 0.48 < gap < 0.52


def _phong_world_axis(trial: Trial) -> bool:
    d = _steady(trial)
    result = finite_numbers(trial.call(d, 300.0, trial.uniform(2, d.shape[1])), d.shape)
    middle = result.mean(axis=1)
    # Whatever the directions are, the results are those of a narrow lobe about one of the axes.
    return 0.98 < float(np.abs(middle).max()) < 1 - 1e-4


def _above_is(trial: Trial, model: Callable[[Array, Array, Array], Array]) -> bool:
    """What fell below comes back as a mistake (d, cosine, n) makes it; what was above doesn't matter."""
    d, n, cosine, result = _above_case(trial, np.float32, below=True)
    return bool(np.abs(result - model(d.astype(np.float64), cosine, n)).max() < 1e-3)


def _above_clamped(trial: Trial) -> bool:
    d, n, cosine, result = _above_case(trial, np.float32, below=True)
    steep = cosine > -0.99
    flat = (d.astype(np.float64) - cosine * n)[:, steep]
    found = result[:, steep]
    return bool(
        min(np.abs(found - flat).max(), np.abs(found - flat / np.linalg.norm(flat, axis=0)).max())
        < 1e-3
    )


def _above_flipped(trial: Trial) -> bool:
    return _above_is(trial, lambda d, _dot, _n: -d)


def _above_removed(trial: Trial) -> bool:
    return _above_is(trial, lambda d, _dot, _n: 0 * d)


def _above_left(trial: Trial) -> bool:
    return _above_is(trial, lambda d, _dot, _n: d)


def _above_all_mirrored(trial: Trial) -> bool:
    d, n, cosine, result = _above_case(trial, np.float32, below=False)
    mirrored = np.abs(result - (d.astype(np.float64) - 2 * cosine * n)).max() < 1e-3
    return bool(mirrored) and _above_is(trial, lambda d, cosine, n: d - 2 * cosine * n)


def _above_wrong_way_round(trial: Trial) -> bool:
    d, n, cosine, result = _above_case(trial, np.float32, below=False)
    mirrored = np.abs(result - (d.astype(np.float64) - 2 * cosine * n)).max() < 1e-3
    return bool(mirrored) and _above_left(trial)


# ---------------------------------------------------------------- all of them


def _lobe_checks(
    function: str, rows: int, name: str, sizes: tuple[float, ...], wrong: tuple[float, ...]
) -> tuple[Check, ...]:
    return (
        *contract_checks(
            function,
            lambda trial: _check_lobe_contract(trial, rows, sizes),
            lambda trial: _check_lobe_untouched(trial, rows, 0.5),
            lambda trial: _check_lobe_refuses(trial, rows, name, wrong),
        ),
        Check(
            function,
            "unit_length",
            "Directions are unit length, whatever comes in",
            lambda trial: _check_lobe_unit(trial, rows, name, sizes),
        ),
    )


BAD_SIZES = (-1.0, -1e-6, float("nan"))

CHECKS = ModuleChecks(
    "glossy",
    checks=(
        *contract_checks("orthonormal_basis", _basis_contract, _basis_untouched, _basis_refuses),
        Check(
            "orthonormal_basis",
            "orthonormal",
            "u, v and w are unit length and at right angles",
            _basis_orthonormal,
        ),
        Check(
            "orthonormal_basis",
            "right_handed",
            "The basis is right-handed: cross(u, v) = w",
            _basis_right_handed,
        ),
        Check(
            "orthonormal_basis",
            "poles",
            "The basis holds along every axis and next to it",
            _basis_poles,
        ),
        *_lobe_checks("jitter_on_plane", 2, "roughness", (0.0, 0.5, 1e-6, 3.0, 1e4), BAD_SIZES),
        Check(
            "jitter_on_plane",
            "no_jitter",
            "Roughness 0 gives the direction bit for bit",
            lambda trial: _check_no_jitter(trial, 2, "roughness"),
        ),
        Check(
            "jitter_on_plane",
            "square",
            "The jitter is a square of side roughness around the direction, at right angles to it",
            _plane_square,
        ),
        distribution_check(
            "jitter_on_plane",
            "uniform",
            "Directions are uniform over the square",
            _plane_uniform,
            3,
        ),
        *_lobe_checks(
            "jitter_in_ball",
            3,
            "glossiness",
            (0.0, 0.5, 1e-6, 0.99, 0.9999),
            (*BAD_SIZES, 1.0, 1.5),
        ),
        Check(
            "jitter_in_ball",
            "no_jitter",
            "Glossiness 0 gives the direction bit for bit",
            lambda trial: _check_no_jitter(trial, 3, "glossiness"),
        ),
        Check(
            "jitter_in_ball",
            "cone",
            "No direction leaves the cone around the ball",
            _ball_cone,
        ),
        distribution_check(
            "jitter_in_ball",
            "uniform",
            "Points are uniform over the ball's volume",
            _ball_uniform,
            6,
        ),
        *_lobe_checks("sample_phong_lobe", 2, "exponent", (0.0, 10.0, 1e-3, 1e3, 1e6), BAD_SIZES),
        Check(
            "sample_phong_lobe",
            "in_front",
            "The lobe ends at a right angle to its axis",
            _phong_in_front,
        ),
        Check(
            "sample_phong_lobe",
            "narrow",
            "Large exponents are all but a mirror",
            _phong_narrow,
        ),
        distribution_check(
            "sample_phong_lobe",
            "mean_cosine",
            "The mean of cos(alpha) is that of the lobe",
            _phong_mean,
            3,
        ),
        distribution_check(
            "sample_phong_lobe",
            "density",
            "Directions have the density of the lobe, all around its axis",
            _phong_density,
            9,
        ),
        *contract_checks("keep_above", _above_contract, _above_untouched, _above_refuses),
        Check(
            "keep_above",
            "unchanged",
            "Directions above the surface come back bit for bit",
            _above_unchanged,
        ),
        Check(
            "keep_above",
            "mirrored",
            "Directions below the surface are mirrored in it",
            _above_mirrored,
        ),
        Check(
            "keep_above",
            "batch",
            "Directions above and below are told apart one by one",
            _above_batch,
        ),
    ),
    mistakes=(
        Mistake(
            "orthonormal_basis",
            "left-handed",
            "Your basis is a fine one, but left-handed: cross(u, v) points against w.",
            _left_handed,
        ),
        Mistake(
            "orthonormal_basis",
            "breaks-at-minus-z",
            "Your basis is right almost everywhere, but falls to pieces next to -z: what do you divide by there?",
            _breaks_at_minus_z,
        ),
        Mistake(
            "orthonormal_basis",
            "fixed-helper",
            "Your basis fails for directions along one axis: is your helper vector parallel to w there?",
            _fixed_helper,
        ),
        Mistake(
            "orthonormal_basis",
            "not-normalised",
            "Your vectors are at right angles, but not of length 1.",
            _basis_not_normalised,
        ),
        Mistake(
            "jitter_on_plane",
            "one-sided",
            "Your square starts at the direction instead of lying around it, so all reflections are shifted.",
            _plane_is(squares.one_sided),
        ),
        Mistake(
            "jitter_on_plane",
            "twice-as-wide",
            "Your square is twice as wide: roughness is its whole side, not half of it.",
            _plane_is(squares.twice_as_wide),
        ),
        Mistake(
            "jitter_on_plane",
            "one-number",
            "Your jitter runs along one line: both sides of the square are driven by the same number.",
            _plane_is(squares.one_number),
        ),
        Mistake(
            "jitter_on_plane",
            "not-normalised",
            "Your directions point the right way, but jitter makes them longer than 1.",
            _plane_is(squares.not_normalised),
        ),
        Mistake(
            "jitter_on_plane",
            "world-axes",
            "Your square lies along the world's axes; it has to be at right angles to each direction.",
            _plane_world_axes,
        ),
        Mistake(
            "jitter_in_ball",
            "surface-only",
            "Your points all lie on the ball's surface; they have to fill its inside as well.",
            _ball_surface,
        ),
        Mistake(
            "jitter_in_ball",
            "crowded-centre",
            "Your points crowd the ball's centre: a uniform radius is not uniform in volume.",
            _ball_crowded,
        ),
        Mistake(
            "jitter_in_ball",
            "square-root",
            "Your radius is right for a disk's area; how does a ball's volume grow with it?",
            _ball_square_root,
        ),
        Mistake(
            "jitter_in_ball",
            "cube",
            "Your points fill a cube; its corners stick out of the ball.",
            _ball_cube,
        ),
        Mistake(
            "jitter_in_ball",
            "not-normalised",
            "Your points are right, but the directions to them are not brought back to length 1.",
            _ball_not_normalised,
        ),
        Mistake(
            "sample_phong_lobe",
            "exponent-off-by-one",
            "Your lobe is too wide by one in the exponent: the ring at alpha grows with sin(alpha), "
            "and integrating that raises the power by one.",
            _phong_off_by_one,
        ),
        Mistake(
            "sample_phong_lobe",
            "extra-cosine",
            "Your lobe is too narrow by one in the exponent: it has one cosine more than the density asks for.",
            _phong_extra_cosine,
        ),
        Mistake(
            "sample_phong_lobe",
            "sine-for-cosine",
            "You have taken the cosine for the sine: your directions stay away from the axis.",
            _phong_sine,
        ),
        Mistake(
            "sample_phong_lobe",
            "no-exponent",
            "Your lobe is as wide for every exponent.",
            _phong_no_exponent,
        ),
        Mistake(
            "sample_phong_lobe",
            "world-axis",
            "Your lobe always points along the same axis, whatever the direction is.",
            _phong_world_axis,
        ),
        Mistake(
            "sample_phong_lobe",
            "half-turn",
            "Your lobe is only half of one: the directions go half way around the axis.",
            _phong_half_turn,
        ),
        Mistake(
            "keep_above",
            "clamped",
            "You press the directions flat onto the surface; mirrored ones stand as far above it as they were below.",
            _above_clamped,
        ),
        Mistake(
            "keep_above",
            "flipped",
            "You turn the whole direction round; only its part along the normal changes sign.",
            _above_flipped,
        ),
        Mistake(
            "keep_above",
            "removed",
            "You drop the directions below the surface; their light is lost.",
            _above_removed,
        ),
        Mistake(
            "keep_above",
            "wrong-way-round",
            "You mirror the directions that are above and leave those below: here the normal is on the outgoing side.",
            _above_wrong_way_round,
        ),
        Mistake(
            "keep_above",
            "left-below",
            "Directions below the surface come back as they were.",
            _above_left,
        ),
        Mistake(
            "keep_above",
            "all-mirrored",
            "You mirror every direction, those above the surface too.",
            _above_all_mirrored,
        ),
    ),
)
