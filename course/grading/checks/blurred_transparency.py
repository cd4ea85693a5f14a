"""Checks of blurred_transparency: Snell's law, total internal reflection, the blurred lobe, and Fresnel's formulae.

A right function may turn or mirror its square as it likes, so of the lobe only what stays the same is looked at. Close
to the critical angle rounding decides, so no check comes nearer to it than ``MARGIN``.
"""

from __future__ import annotations

from collections.abc import Callable
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
    near,
    pair,
    worst_units,
)
from course.grading.checks.statistics import distribution_check
from course.grading.checks.vectors import UNIT, check_unit, cross, dot, normalized, unit_vectors

MARGIN = 1e-3
"""How near to 1 the sines of refracted rays come."""

POINTS = 5000


# ---------------------------------------------------------------- directions and values


def _incoming(
    rng: np.random.Generator, sine: Array, dtype: Any = np.float32
) -> tuple[Array, Array]:
    """Directions and normals with those sines between them, turned anyhow."""
    n = unit_vectors(rng, sine.size)
    along = cross(n, unit_vectors(rng, sine.size))
    along /= np.linalg.norm(along, axis=0)
    d = sine * along - np.sqrt(1 - sine**2) * n
    return np.ascontiguousarray(d, dtype), np.ascontiguousarray(n, dtype)


def _sines(d: Array, n: Array) -> Array:
    """The sines between them as they really are, after rounding."""
    return np.asarray(np.linalg.norm(cross(n, d), axis=0))


def _etas(rng: np.random.Generator) -> tuple[float, float]:
    """Into a denser medium, and out of one."""
    into = float(rng.uniform(0.4, 0.8))
    return into, float(rng.uniform(1.25, 2.4))


def _refracted(trial: Trial, d: Array, n: Array, eta: Any) -> tuple[Array, Array]:
    """The student's directions and mask."""
    directions, total = pair(trial.call(d.copy(), n.copy(), eta), "directions", "total")
    columns = d.shape[1]
    if getattr(total, "dtype", None) != np.bool_ or total.shape != (columns,):
        raise Failure(
            f"a bool array of shape ({columns},) that says where reflection is total",
            f"{getattr(total, 'dtype', type(total).__name__)} of shape {np.shape(total)}",
        )
    return finite_numbers(directions, d.shape, "the directions"), np.asarray(total)


def _bent(d: Array, n: Array, eta: Any) -> Array:
    """Snell's law in double precision, from sines; all columns have to be refracted."""
    along = d + dot(d, -n) * n
    sine = eta * _sines(d, n)
    return np.asarray(eta * along - np.sqrt(1 - sine**2) * n)


def _mirrored(d: Array, n: Array) -> Array:
    return np.asarray(d - 2 * dot(d, n) * n)


# ---------------------------------------------------------------- refract


def _refract_contract(trial: Trial) -> None:
    rng = trial.rng
    sine = np.concatenate(((0.0, 1.0, 1e-9, 1 - 1e-9), rng.random(60)))
    for dtype in DTYPES:
        d, n = _incoming(rng, sine, dtype)
        # Straight on, and along the surface, without any rounding.
        d[:, 0], d[:, 1] = (0, -1, 0), (1, 0, 0)
        n[:, 0], n[:, 1] = (0, 1, 0), (0, 1, 0)
        own = rng.uniform(0.3, 3.0, sine.size).astype(dtype)
        etas: tuple[Any, ...] = (0.125, 1.0, np.float64(1.5), 8.0, own)
        for eta in etas:
            for m in (sine.size, 1, 0):
                part = eta[:m] if np.ndim(eta) else eta
                directions, total = pair(
                    trial.call(d[:, :m].copy(), n[:, :m].copy(), part), "directions", "total"
                )
                check_array(directions, (3, m), dtype, "the directions")
                check_array(total, (m,), np.bool_, "the mask of total reflection")
    for first, second, third in (
        (np.float32, np.float64, np.float32),
        (np.float64, np.float32, np.float32),
        (np.float32, np.float32, np.float64),
    ):
        directions, _ = pair(
            trial.call(d.astype(first), n.astype(second), own.astype(third)), "directions", "total"
        )
        check_array(directions, d.shape, np.float64, "the directions of float32 and float64")


def _refract_untouched(trial: Trial) -> None:
    d, n = _incoming(trial.rng, trial.rng.random(50))
    check_untouched(trial, d, n, 1.5)
    check_untouched(trial, d, n, trial.rng.uniform(0.5, 2, 50).astype(np.float32))


BAD_ETAS = (0.0, -1.5, 11.0, float("nan"), float("inf"))


def _refract_refuses(trial: Trial) -> None:
    d, n = _incoming(trial.rng, trial.rng.random(4))
    for bad in (d[:2], d[0], d.T):
        check_refused(trial, bad, n, 1.5, named="direction")
    for bad in (n[:2], n[:, :3], n[:, 0]):
        check_refused(trial, d, bad, 1.5, named="normal")
    for bad in (np.ones(3), np.ones((1, 4)), np.array((1.0, 1.5, -1.0, 1.0)), *BAD_ETAS):
        check_refused(trial, d, n, bad, named="eta")


def _refracting(trial: Trial, eta: float, n: int = 1000) -> tuple[Array, Array]:
    """Directions and normals of rays that are all refracted, from straight on to almost too flat."""
    return _incoming(trial.rng, trial.rng.uniform(0, min(1, 1 / eta) - MARGIN, n))


def _reflecting(trial: Trial, eta: float, n: int = 1000) -> tuple[Array, Array]:
    """Directions and normals of rays that are all reflected."""
    return _incoming(trial.rng, trial.rng.uniform((1 + MARGIN) / eta, 1, n))


def _refract_unit(trial: Trial) -> None:
    for eta in (*_etas(trial.rng), 1.0):
        d, n = _incoming(trial.rng, trial.rng.random(1000))
        result, _ = _refracted(trial, d, n, eta)
        check_unit(result, at(direction=d, normal=n), f"with eta {eta:.4g}, length of the result:")


def _refract_snell(trial: Trial) -> None:
    for eta in _etas(trial.rng):
        d, n = _refracting(trial, eta)
        result, _ = _refracted(trial, d, n, eta)
        check_close(
            cross(n, result),
            eta * cross(n, d),
            UNIT,
            f"with eta {eta:.4g}, cross(normal, result) = eta cross(normal, direction):",
            at(direction=d, normal=n),
            "Snell's law: sin_t = eta sin_i, in the plane of direction and normal.",
        )


def _refract_far_side(trial: Trial) -> None:
    for eta in _etas(trial.rng):
        d, n = _refracting(trial, eta)
        result, _ = _refracted(trial, d, n, eta)
        cos = dot(result, n)
        expected = -np.sqrt(1 - (eta * _sines(d, n)) ** 2)
        check_close(
            cos,
            expected,
            # Where cos_t is small, rounding of the sine tells in it.
            1e-4,
            f"with eta {eta:.4g}, dot(result, normal):",
            at(direction=d, normal=n),
            "Refracted rays go on to the far side, where the normal does not point.",
        )


def _refract_straight(trial: Trial) -> None:
    n = unit_vectors(trial.rng, 500, np.float32)
    for eta in _etas(trial.rng):
        result, total = _refracted(trial, -n, n, eta)
        check_close(
            result,
            -n.astype(np.float64),
            # By rounding, n is not quite its own length.
            1e-5,
            f"straight on, with eta {eta:.4g}, the direction itself:",
            at(normal=n),
            "A ray along the normal is not bent.",
        )
        if total.any():
            raise Failure("no total reflection straight on", f"some, with eta {eta:.4g}")
    d, n = _incoming(trial.rng, trial.rng.uniform(0, 0.99, 500))
    result, _ = _refracted(trial, d, n, 1.0)
    check_close(
        result,
        d.astype(np.float64),
        2e-5,
        "with eta 1, the direction itself:",
        at(direction=d, normal=n),
        "Between two equal media nothing is bent.",
    )


def _check_mask(found: Array, expected: Array, eta: Any, d: Array, n: Array) -> None:
    wrong = np.flatnonzero(found != expected)
    if wrong.size:
        k = int(wrong[0])
        own = float(np.broadcast_to(eta, expected.shape)[k])
        sine = float(_sines(d, n)[k])
        raise Failure(
            f"total reflection to be {bool(expected[k])} where eta sin_i is {own * sine:.6g}",
            f"{bool(found[k])}",
            f"eta = {own:.6g}, {at(direction=d, normal=n)(k)}; "
            f"{wrong.size} of {expected.size} rays",
            "No angle has a sine over 1.",
        )


def _refract_critical(trial: Trial) -> None:
    into, out = _etas(trial.rng)
    # Just below the critical angle, and just above.
    below = np.full(200, (1 - MARGIN) / out)
    sine = np.concatenate((below, np.full(200, (1 + MARGIN) / out), trial.rng.random(400)))
    sine = sine[np.abs(out * sine - 1) > MARGIN / 2]
    d, n = _incoming(trial.rng, sine)
    _, total = _refracted(trial, d, n, out)
    _check_mask(total, out * sine > 1, out, d, n)
    _, total = _refracted(trial, d, n, into)
    _check_mask(total, np.zeros(sine.size, bool), into, d, n)


def _refract_total(trial: Trial) -> None:
    for dtype in DTYPES:
        eta = _etas(trial.rng)[1]
        d, n = (v.astype(dtype) for v in _reflecting(trial, eta))
        result, _ = _refracted(trial, d, n, eta)
        check_close(
            result,
            _mirrored(d, n),
            UNIT,
            f"with total reflection, eta {eta:.4g}, the mirrored direction,",
            at(direction=d, normal=n),
            "Where no light gets through, all of it is reflected.",
        )


def _refract_reversible(trial: Trial) -> None:
    for eta in _etas(trial.rng):
        d, n = _refracting(trial, eta)
        result, _ = _refracted(trial, d, n, eta)
        back, _ = _refracted(trial, (-result).astype(np.float32), -n, 1 / eta)
        check_close(
            # Only what lies in the surface: next to the critical angle the rest is all rounding.
            cross(n, back),
            -cross(n, d),
            2 * UNIT,
            f"with eta {eta:.4g}, there and back again, cross(normal, direction):",
            at(direction=d, normal=n),
            "Light takes the same way back, with 1 / eta and the normal of the other side.",
        )


def _refract_each(trial: Trial) -> None:
    """An eta for each ray, some of which are reflected."""
    rng = trial.rng
    eta = rng.uniform(0.4, 2.4, 1000).astype(np.float32)
    sine = rng.random(1000)
    clear = np.abs(eta * sine - 1) > MARGIN
    eta, sine = eta[clear], sine[clear]
    d, n = _incoming(rng, sine)
    result, total = _refracted(trial, d, n, eta)
    _check_mask(total, eta * sine > 1, eta, d, n)
    expected = _mirrored(d, n)
    through = ~total
    expected[:, through] = _bent(d[:, through], n[:, through], eta[through].astype(np.float64))
    check_close(
        result,
        expected,
        1e-4,
        "the direction of a ray with an eta of its own,",
        at(direction=d, normal=n, eta=eta),
        "Each ray has its own eta here, and is bent or mirrored on its own.",
    )


# ---------------------------------------------------------------- jitter_refraction


def _far(rng: np.random.Generator, cos: Array, dtype: Any = np.float32) -> tuple[Array, Array]:
    """Refracted directions that go down at those cosines, and the normals they leave behind."""
    return _incoming(rng, np.sqrt(1 - cos**2), dtype)


SIZES = (0.0, 0.5, 1e-6, 3.0, 1e4)


def _jitter_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        u = worst_units(2, dtype)
        d, n = _far(trial.rng, np.asarray(trial.rng.uniform(0.01, 1, u.shape[1])), dtype)
        d[:, 0], n[:, 0] = (0, 0, -1), (0, 0, 1)
        for size in SIZES:
            result = trial.call(d, n, size, u)
            check_array(result, d.shape, dtype, f"the result for roughness {size:g}")
        check_array(trial.call(d[:, :0], n[:, :0], 0.5, u[:, :0]), (3, 0), dtype)
    single = d.astype(np.float32), n.astype(np.float32), u.astype(np.float32)
    for arrays in ((d, *single[1:]), (single[0], n, single[2]), (*single[:2], u)):
        first, second, third = arrays
        for size in (0.0, 0.5):
            result = trial.call(first, second, size, third)
            check_array(result, d.shape, np.float64, "the result of float32 and float64")


def _jitter_untouched(trial: Trial) -> None:
    for size in (0.0, 0.8):
        d, n = _far(trial.rng, trial.rng.uniform(0.1, 1, 50))
        check_untouched(trial, d, n, size, trial.uniform(2, 50))


def _jitter_refuses(trial: Trial) -> None:
    d, n = _far(trial.rng, trial.rng.uniform(0.1, 1, 4))
    u = trial.uniform(2, 4)
    for bad in (d[:2], d[0], d.T):
        check_refused(trial, bad, n, 0.5, u, named="direction")
    for bad in (n[:2], n[:, :3], n[:, 0]):
        check_refused(trial, d, bad, 0.5, u, named="normal")
    for bad in (u[:1], u[0], u[:, :3], np.concatenate((u, u))):
        check_refused(trial, d, n, 0.5, bad, named="u")
    for size in (-1.0, -1e-6, float("nan")):
        check_refused(trial, d, n, size, u, named=f"roughness {size}")


def _jitter_unit(trial: Trial) -> None:
    d, n = _far(trial.rng, trial.rng.uniform(0.01, 1, 1000))
    u = trial.uniform(2, 1000)
    for size in SIZES:
        result = finite_numbers(trial.call(d, n, size, u), d.shape)
        what = f"for roughness {size:g}, length of the result:"
        check_unit(result, at(direction=d, normal=n, u=u), what)


def _jitter_none(trial: Trial) -> None:
    for dtype in DTYPES:
        d, n = _far(trial.rng, trial.rng.uniform(1e-3, 1, 1000), dtype)
        result = finite_numbers(trial.call(d, n, 0.0, trial.uniform(2, 1000, dtype)), d.shape)
        check_close(
            result,
            d,
            0.0,
            "with roughness 0, the direction itself:",
            at(direction=d, normal=n),
            "Nothing is to be added then; does your way to the result round what was exact?",
        )


def _jitter_far_side(trial: Trial) -> None:
    for roughness in (float(trial.rng.uniform(0.2, 1)), 4.0, 1e3):
        d, n = _far(trial.rng, trial.rng.uniform(0.002, 0.3, 2000))
        u = trial.uniform(2, 2000)
        cos = dot(finite_numbers(trial.call(d, n, roughness, u), d.shape), n)
        worst = int(cos.argmax())
        if not cos[worst] <= 2e-6:
            raise Failure(
                f"all rays of roughness {roughness:.4g} on the far side, dot(result, normal) < 0",
                f"{cos[worst]:.6g}",
                f"{at(direction=d, normal=n, u=u)(worst)}; "
                f"{int((cos > 2e-6).sum())} of {cos.size} rays",
                "What came back through the surface would light up the wrong side.",
            )


def _one_ray(trial: Trial, cos: float, dtype: Any = np.float32) -> tuple[Array, Array]:
    return _far(trial.rng, np.array([cos]), dtype)


def _square_seen(trial: Trial, roughness: float, cos: float, n: int = 200) -> squares.Square:
    """The square of one ray jittered n times."""
    d, normal = _one_ray(trial, cos)
    u = trial.uniform(2, n)
    result = finite_numbers(
        trial.call(np.repeat(d, n, axis=1), np.repeat(normal, n, axis=1), roughness, u), (3, n)
    )
    return squares.seen(normalized(d)[:, 0], u, result)


def _jitter_square(trial: Trial) -> None:
    for roughness in trial.rng.uniform((0.05, 0.4), (0.4, 0.9)).tolist():
        # Steep enough for nothing to come back.
        square = _square_seen(trial, roughness, float(trial.rng.uniform(0.8, 1)))
        squares.check_square(square, roughness)


def _jitter_mirrored(trial: Trial) -> None:
    """A flat ray: the middle of its square tells where all of it would be, and so what came back."""
    for dtype, roughness in ((np.float32, 0.9), (np.float64, float(trial.rng.uniform(0.5, 2)))):
        n = 600
        cos = float(trial.rng.uniform(0.15, 0.25))
        d, normal = (np.repeat(v, n, axis=1) for v in _one_ray(trial, cos, dtype))
        u = trial.uniform(2, n, dtype)
        # Half a diagonal of this part of the square is shorter than the way up to the surface.
        u[:, :200] = 0.5 + (u[:, :200] - 0.5) * min(1, cos / roughness)
        result = finite_numbers(trial.call(d, normal, roughness, u), d.shape)
        w = normalized(d[:, :1])[:, 0]
        jittered = normalized(squares.seen(w, u[:, :200], result[:, :200]).at(u))
        height = dot(jittered, normal)
        sure = np.abs(height) > 1e-3
        expected = jittered - 2 * np.maximum(height, 0) * normal
        check_close(
            result[:, sure],
            expected[:, sure],
            1e-4,
            f"with roughness {roughness:.4g}, the jittered direction, mirrored if it came back,",
            at(direction=d[:, sure], normal=normal[:, sure], u=u[:, sure]),
            "The part along the normal changes its sign if it is positive; the rest stays.",
        )


def _jitter_uniform(trial: Trial) -> None:
    roughness = float(trial.rng.uniform(0.2, 0.9))
    for cos in (1.0, float(trial.rng.uniform(0.8, 0.95))):
        squares.check_filled(trial, _square_seen(trial, roughness, cos, POINTS), roughness)


# ---------------------------------------------------------------- fresnel


def _reflectances(cos_i: Array, eta: Any) -> tuple[Array, Array]:
    """Both polarisations by the angles' sines and tangents; not straight on, nor in total reflection."""
    i = np.arccos(cos_i)
    t = np.arcsin(eta * np.sin(i))
    return np.sin(i - t) ** 2 / np.sin(i + t) ** 2, np.tan(i - t) ** 2 / np.tan(i + t) ** 2


def _cosines(rng: np.random.Generator, eta: float, n: int = 500) -> Array:
    """Cosines of rays that are refracted, none quite straight on."""
    sine = rng.uniform(0.05, min(1, 1 / eta) - MARGIN, n)
    return np.asarray(np.sqrt(1 - sine**2))


def _reflected(trial: Trial, cos_i: Array, eta: Any) -> Array:
    return finite_numbers(trial.call(cos_i, eta), cos_i.shape, "the reflectance")


def _fresnel_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        ends = (0.0, float(np.finfo(dtype).tiny), 1e-9, 0.5, 1 - 2.0**-24, 1.0)
        cos = np.concatenate((ends, trial.rng.random(50))).astype(dtype)
        own = trial.rng.uniform(0.3, 3.0, cos.size).astype(dtype)
        etas: tuple[Any, ...] = (0.125, 1.0, np.float64(1.5), 8.0, own)
        for eta in etas:
            for m in (cos.size, 1, 0):
                part = eta[:m] if np.ndim(eta) else eta
                result = check_array(trial.call(cos[:m].copy(), part), (m,), dtype)
                if m and not (result.min() >= 0 and result.max() <= 1 + UNIT):
                    raise Failure(
                        "reflectances from 0 to 1", f"{result.min():.6g} to {result.max():.6g}"
                    )
    for first, second in ((np.float32, np.float64), (np.float64, np.float32)):
        mixed = trial.call(cos.astype(first), own.astype(second))
        check_array(mixed, cos.shape, np.float64, "the result of float32 and float64")


def _fresnel_untouched(trial: Trial) -> None:
    cos = trial.rng.random(50, np.float32)
    check_untouched(trial, cos, 1.5)
    check_untouched(trial, cos, trial.rng.uniform(0.5, 2, 50).astype(np.float32))


def _fresnel_refuses(trial: Trial) -> None:
    cos = trial.rng.random(4)
    for bad in (cos[None], cos.reshape(2, 2), 0.5):
        check_refused(trial, bad, 1.5, named="cos_i")
    for bad in (np.ones(3), np.ones((1, 4)), np.array((1.0, 1.5, -1.0, 1.0)), *BAD_ETAS):
        check_refused(trial, cos, bad, named="eta")


def _fresnel_straight(trial: Trial) -> None:
    for dtype in DTYPES:
        for eta in _etas(trial.rng):
            found = _reflected(trial, np.ones(3, dtype), eta)
            check_close(
                found,
                np.full(3, ((1 - eta) / (1 + eta)) ** 2),
                1e-6,
                f"straight on, with eta {eta:.6g}, ((n - 1) / (n + 1))^2 =",
                hint="Straight on, both polarisations are reflected alike.",
            )


def _fresnel_grazing(trial: Trial) -> None:
    for eta in _etas(trial.rng):
        check_close(
            _reflected(trial, np.array((0.0, 1e-7)), eta),
            np.ones(2),
            1e-5,
            f"along the surface, with eta {eta:.4g}, reflectance",
            hint="Seen flat enough, every surface is a mirror.",
        )
    cos = trial.rng.uniform(0.05, 1, 500)
    check_close(
        _reflected(trial, cos, 1.0),
        np.zeros(500),
        1e-9,
        "between equal media, reflectance",
        at(cos_i=cos),
        "With eta 1 there is no boundary.",
    )


def _fresnel_total(trial: Trial) -> None:
    for dtype in DTYPES:
        eta = _etas(trial.rng)[1]
        sine = trial.rng.uniform((1 + MARGIN) / eta, 1, 500)
        cos = np.sqrt(1 - sine**2).astype(dtype)
        check_close(
            _reflected(trial, cos, eta),
            np.ones(500),
            2e-6,
            f"beyond the critical angle of eta {eta:.4g}, reflectance",
            at(cos_i=cos),
            "In total internal reflection nothing gets through.",
        )


def _fresnel_brewster(trial: Trial) -> None:
    for eta in _etas(trial.rng):
        # tan = n_to / n_from: reflected and refracted ray are at right angles.
        cos = np.full(3, 1 / np.hypot(1, 1 / eta))
        check_close(
            _reflected(trial, cos, eta),
            np.full(3, 0.5 * ((1 - eta**2) / (1 + eta**2)) ** 2),
            1e-9,
            f"at Brewster's angle of eta {eta:.4g}, reflectance",
            at(cos_i=cos),
            "There one polarisation is not reflected at all; the mean is half of the other's.",
        )


def _fresnel_exact(trial: Trial) -> None:
    for dtype, tolerance in ((np.float32, 1e-4), (np.float64, 1e-9)):
        for eta in _etas(trial.rng):
            eta = float(dtype(eta))
            cos = _cosines(trial.rng, eta).astype(dtype)
            across, within = _reflectances(cos.astype(np.float64), eta)
            check_close(
                _reflected(trial, cos, eta),
                (across + within) / 2,
                tolerance,
                f"with eta {eta:.6g}, reflectance",
                at(cos_i=cos),
                "The mean of both polarisations' squared amplitudes.",
            )


def _fresnel_reversible(trial: Trial) -> None:
    for eta in _etas(trial.rng):
        cos_i = _cosines(trial.rng, eta)
        cos_t = np.sqrt(1 - eta**2 * (1 - cos_i**2))
        check_close(
            _reflected(trial, cos_t, 1 / eta),
            _reflected(trial, cos_i, eta),
            1e-9,
            f"with eta {eta:.4g}, the same as from the other side:",
            at(cos_i=cos_i),
            "From both sides the boundary reflects the same share.",
        )


def _fresnel_each(trial: Trial) -> None:
    eta = trial.rng.uniform(0.4, 2.4, 1000)
    sine = trial.rng.uniform(0.05, 0.999, 1000)
    clear = (np.abs(eta * sine - 1) > MARGIN) & (np.abs(eta - 1) > 0.01)
    eta, sine = eta[clear], sine[clear]
    cos, expected = np.sqrt(1 - sine**2), np.ones(eta.size)
    through = eta * sine < 1
    across, within = _reflectances(cos[through], eta[through])
    expected[through] = (across + within) / 2
    check_close(
        _reflected(trial, cos, eta),
        expected,
        1e-9,
        "reflectance of a ray with an eta of its own",
        at(cos_i=cos, eta=eta),
        "Each ray has its own eta here.",
    )


# ---------------------------------------------------------------- mistakes


def _directions_of(trial: Trial, d: Array, n: Array, eta: float) -> Array:
    """The student's directions, whatever the mask is."""
    return finite_numbers(
        pair(trial.call(d.copy(), n.copy(), eta), "directions", "total")[0], d.shape
    )


INTO, OUT = 0.7, 1.4
"""What mistakes are looked for with."""


def _refract_is(trial: Trial, model: Callable[[Array, Array, float], Array]) -> bool:
    """Rays well away from total reflection come back as a mistake (d, n, eta) bends them."""
    for eta in (INTO, OUT):
        d, n = _incoming(trial.rng, trial.rng.uniform(0.1, 0.6, 300), np.float64)
        if not near(_directions_of(trial, d, n, eta), model(d, n, eta)):
            return False
    return True


def _inverted(trial: Trial) -> bool:
    return _refract_is(trial, lambda d, n, eta: _bent(d, n, 1 / eta))


def _incoming_side(trial: Trial) -> bool:
    return _refract_is(trial, lambda d, n, eta: _mirrored(_bent(d, n, eta), n))


def _other_way_round(trial: Trial) -> bool:
    """Bent away from the plane's other side: the part along the surface is turned round."""
    return _refract_is(trial, lambda d, n, eta: -_mirrored(_bent(d, n, eta), n))


def _angles(trial: Trial) -> bool:
    def model(d: Array, n: Array, eta: float) -> Array:
        sine = _sines(d, n)
        return _bent(d, n, np.sin(eta * np.arcsin(sine)) / sine)

    return _refract_is(trial, model)


def _not_normalised(trial: Trial) -> bool:
    """The right directions, but of another length."""
    for eta in (INTO, OUT):
        d, n = _incoming(trial.rng, trial.rng.uniform(0.1, 0.6, 300), np.float64)
        result = _directions_of(trial, d, n, eta)
        if near(np.linalg.norm(result, axis=0), np.ones(300)):
            return False
        if not near(normalized(result), _bent(d, n, eta)):
            return False
    return True


def _total_is(trial: Trial, model: Callable[[Array, Array], Array]) -> bool:
    d, n = (v.astype(np.float64) for v in _reflecting(trial, OUT, 300))
    return near(_directions_of(trial, d, n, OUT), model(d, n))


def _straight_on(trial: Trial) -> bool:
    return _total_is(trial, lambda d, _n: d)


def _along_surface(trial: Trial) -> bool:
    return _total_is(trial, lambda d, n: OUT * (d - dot(d, n) * n)) or _total_is(
        trial, lambda d, n: normalized(d - dot(d, n) * n)
    )


def _turned_back(trial: Trial) -> bool:
    return _total_is(trial, lambda d, _n: -d)


def _removed(trial: Trial) -> bool:
    return _total_is(trial, lambda d, _n: 0 * d)


def _mask_inverted(trial: Trial) -> bool:
    d, n = _incoming(trial.rng, trial.rng.uniform(0, 1, 300))
    expected = _sines(d, n) * OUT > 1
    sure = np.abs(_sines(d, n) * OUT - 1) > MARGIN
    _, total = _refracted(trial, d, n, OUT)
    return bool((total != expected)[sure].all())


def _jitter_is(mistake: Callable[[squares.Square, float], bool]) -> Callable[[Trial], bool]:
    """Whether the square of a ray from which nothing comes back looks like that."""
    return lambda trial: mistake(_square_seen(trial, 0.7, 0.9), 0.7)


def _flat(trial: Trial) -> tuple[Array, Array, Array]:
    """A flat ray jittered 400 times: the directions that should have come, before mirroring, and what came."""
    n, roughness, cos = 400, 0.9, 0.2
    d, normal = (np.repeat(v, n, axis=1) for v in _one_ray(trial, cos, np.float64))
    u = trial.rng.random((2, n))
    u[:, :200] = 0.5 + (u[:, :200] - 0.5) * cos / roughness
    result = finite_numbers(trial.call(d, normal, roughness, u), d.shape)
    w = d[:, 0]
    square = squares.seen(w, u[:, :200], result[:, :200])
    if not (square.is_flat() and square.is_of(roughness)):
        raise Failure("a square in the middle", "none")
    return normalized(square.at(u)), normal, result


def _flat_is(trial: Trial, model: Callable[[Array, Array], Array]) -> bool:
    """What came back through the surface is as a mistake (jittered, normal) makes it."""
    jittered, n, result = _flat(trial)
    above = dot(jittered, n) > 0.01
    return near(result[:, above], model(jittered, n)[:, above])


def _not_kept(trial: Trial) -> bool:
    return _flat_is(trial, lambda j, _n: j)


def _flipped(trial: Trial) -> bool:
    return _flat_is(trial, lambda j, _n: -j)


def _clamped(trial: Trial) -> bool:
    return _flat_is(trial, lambda j, n: j - dot(j, n) * n) or _flat_is(
        trial, lambda j, n: normalized(j - dot(j, n) * n)
    )


def _wrong_side(trial: Trial) -> bool:
    """What is on the far side is mirrored to the incoming one: keep_above with the same normal."""
    d, n = _far(trial.rng, np.full(300, 0.9))
    cos = dot(finite_numbers(trial.call(d, n, 0.1, trial.uniform(2, 300)), d.shape), n)
    return bool((cos > 0.5).all())


def _about_normal(trial: Trial) -> bool:
    d, n = _far(trial.rng, np.full(300, 0.6))
    result = finite_numbers(trial.call(d, n, 0.01, trial.uniform(2, 300)), d.shape)
    return near(np.abs(dot(result, n)), np.ones(300))


def _fresnel_is(trial: Trial, model: Callable[[Array, float], Array]) -> bool:
    for eta in (INTO, OUT):
        cos = np.sqrt(1 - trial.rng.uniform(0.1, 0.6, 300) ** 2)
        if not near(_reflected(trial, cos, eta), model(cos, eta), 1e-6):
            return False
    return True


def _schlick(trial: Trial) -> bool:
    def model(cos: Array, eta: float) -> Array:
        straight = ((1 - eta) / (1 + eta)) ** 2
        return straight + (1 - straight) * (1 - cos) ** 5

    def bent(cos: Array, eta: float) -> Array:
        return model(np.sqrt(1 - eta**2 * (1 - cos**2)) if eta > 1 else cos, eta)

    return _fresnel_is(trial, model) or _fresnel_is(trial, bent)


def _fresnel_inverted(trial: Trial) -> bool:
    return _fresnel_is(trial, lambda c, eta: sum(_reflectances(c, 1 / eta), np.zeros(300)) / 2)


def _one_polarisation(trial: Trial) -> bool:
    return any(
        _fresnel_is(trial, lambda c, eta, k=k: _reflectances(c, eta)[k])  # type: ignore[misc]
        for k in (0, 1)
    )


def _summed(trial: Trial) -> bool:
    return _fresnel_is(trial, lambda c, eta: sum(_reflectances(c, eta), np.zeros(300)))


def _transmitted(trial: Trial) -> bool:
    return _fresnel_is(trial, lambda c, eta: 1 - sum(_reflectances(c, eta), np.zeros(300)) / 2)


def _not_squared(trial: Trial) -> bool:
    def size(c: Array, eta: float) -> Array:
        across, within = _reflectances(c, eta)
        return (np.sqrt(across) + np.sqrt(within)) / 2

    return _fresnel_is(trial, size)


# ---------------------------------------------------------------- all of them


CHECKS = ModuleChecks(
    "blurred_transparency",
    checks=(
        *contract_checks("refract", _refract_contract, _refract_untouched, _refract_refuses),
        Check("refract", "unit_length", "Directions are unit length", _refract_unit),
        Check("refract", "snell", "Rays are bent by Snell's law", _refract_snell),
        Check("refract", "far_side", "Refracted rays go to the far side", _refract_far_side),
        Check(
            "refract",
            "straight",
            "Nothing is bent along the normal, nor between equal media",
            _refract_straight,
        ),
        Check(
            "refract",
            "critical",
            "Reflection is total beyond the critical angle, and nowhere else",
            _refract_critical,
        ),
        Check(
            "refract", "total", "Totally reflected rays hold the mirrored direction", _refract_total
        ),
        Check("refract", "reversible", "Light takes the same way back", _refract_reversible),
        Check("refract", "each", "Each ray may have an eta of its own", _refract_each),
        *contract_checks("jitter_refraction", _jitter_contract, _jitter_untouched, _jitter_refuses),
        Check(
            "jitter_refraction",
            "unit_length",
            "Directions are unit length, whatever the roughness",
            _jitter_unit,
        ),
        Check(
            "jitter_refraction",
            "no_jitter",
            "Roughness 0 gives the direction bit for bit",
            _jitter_none,
        ),
        Check(
            "jitter_refraction",
            "square",
            "The jitter is a square of side roughness around the refracted direction",
            _jitter_square,
        ),
        Check(
            "jitter_refraction",
            "far_side",
            "No ray comes back to the incoming side",
            _jitter_far_side,
        ),
        Check(
            "jitter_refraction",
            "mirrored",
            "What came back is mirrored in the surface, the rest left as it was",
            _jitter_mirrored,
        ),
        distribution_check(
            "jitter_refraction",
            "uniform",
            "Directions are uniform over the square",
            _jitter_uniform,
            2,
        ),
        *contract_checks("fresnel", _fresnel_contract, _fresnel_untouched, _fresnel_refuses),
        Check(
            "fresnel",
            "straight",
            "Straight on, the reflectance is ((n - 1) / (n + 1))^2",
            _fresnel_straight,
        ),
        Check(
            "fresnel",
            "grazing",
            "Along the surface all is reflected, and without a boundary nothing",
            _fresnel_grazing,
        ),
        Check("fresnel", "total", "Total internal reflection is total", _fresnel_total),
        Check(
            "fresnel",
            "brewster",
            "At Brewster's angle one polarisation is left",
            _fresnel_brewster,
        ),
        Check("fresnel", "exact", "The reflectance is exact at all angles", _fresnel_exact),
        Check(
            "fresnel",
            "reversible",
            "Both sides of the boundary reflect the same share",
            _fresnel_reversible,
        ),
        Check("fresnel", "each", "Each ray may have an eta of its own", _fresnel_each),
    ),
    mistakes=(
        Mistake(
            "refract",
            "inverted-eta",
            "You bend the rays the wrong way: eta is n_from / n_to, not n_to / n_from.",
            _inverted,
        ),
        Mistake(
            "refract",
            "incoming-side",
            "Your refracted rays stay on the incoming side: which way does the normal point?",
            _incoming_side,
        ),
        Mistake(
            "refract",
            "turned-round",
            "Your rays cross the normal: the part along the surface keeps its sense.",
            _other_way_round,
        ),
        Mistake(
            "refract",
            "angles",
            "You multiply the angle by eta; it is its sine that Snell's law is about.",
            _angles,
        ),
        Mistake(
            "refract",
            "not-normalised",
            "Your directions point the right way, but are not of length 1.",
            _not_normalised,
        ),
        Mistake(
            "refract",
            "straight-through",
            "Where reflection is total your rays go straight on; nothing gets through there.",
            _straight_on,
        ),
        Mistake(
            "refract",
            "along-surface",
            "Where reflection is total your rays run along the surface: a cosine was clamped to 0.",
            _along_surface,
        ),
        Mistake(
            "refract",
            "turned-back",
            "Where reflection is total you turn the ray back the way it came; a mirror changes only its part "
            "along the normal.",
            _turned_back,
        ),
        Mistake(
            "refract",
            "removed",
            "Where reflection is total your directions are zero; they have to be the mirrored ones.",
            _removed,
        ),
        Mistake(
            "refract",
            "mask-inverted",
            "Your mask says where rays get through; it has to say where they do not.",
            _mask_inverted,
        ),
        Mistake(
            "jitter_refraction",
            "not-kept",
            "Rays that came back through the surface are left there.",
            _not_kept,
        ),
        Mistake(
            "jitter_refraction",
            "wrong-side",
            "You keep the rays on the incoming side; refracted ones belong on the other.",
            _wrong_side,
        ),
        Mistake(
            "jitter_refraction",
            "flipped",
            "You turn the whole direction round; only its part along the normal changes sign.",
            _flipped,
        ),
        Mistake(
            "jitter_refraction",
            "clamped",
            "You press what came back flat onto the surface; mirrored rays go as deep as they were high.",
            _clamped,
        ),
        Mistake(
            "jitter_refraction",
            "about-normal",
            "Your lobe lies about the normal; it belongs about the refracted direction.",
            _about_normal,
        ),
        Mistake(
            "jitter_refraction",
            "one-sided",
            "Your square starts at the direction instead of lying around it.",
            _jitter_is(squares.one_sided),
        ),
        Mistake(
            "jitter_refraction",
            "twice-as-wide",
            "Your square is twice as wide: roughness is its whole side, not half of it.",
            _jitter_is(squares.twice_as_wide),
        ),
        Mistake(
            "jitter_refraction",
            "one-number",
            "Your jitter runs along one line: both sides of the square are driven by the same number.",
            _jitter_is(squares.one_number),
        ),
        Mistake(
            "jitter_refraction",
            "not-normalised",
            "Your directions point the right way, but jitter makes them longer than 1.",
            _jitter_is(squares.not_normalised),
        ),
        Mistake(
            "fresnel",
            "schlick",
            "That is Schlick's approximation; here Fresnel's formulae are asked for.",
            _schlick,
        ),
        Mistake(
            "fresnel",
            "inverted-eta",
            "You have the two media the wrong way round: eta is n_from / n_to.",
            _fresnel_inverted,
        ),
        Mistake(
            "fresnel",
            "one-polarisation",
            "You return one polarisation; unpolarised light is half of each.",
            _one_polarisation,
        ),
        Mistake("fresnel", "summed", "You add both polarisations up; it is their mean.", _summed),
        Mistake(
            "fresnel",
            "transmitted",
            "You return the share that gets through; asked for is the one that is reflected.",
            _transmitted,
        ),
        Mistake(
            "fresnel",
            "not-squared",
            "You average amplitudes; light's power goes with their squares.",
            _not_squared,
        ),
    ),
)
