"""Checks of the importance_sampling module: directions and their densities, the estimate, and the power heuristic.

The integrand is cos^n over the hemisphere wherever one is needed. Its integral is 2 pi / (n + 1), and the variance that
each way of sampling leaves has a closed form.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import comb, nan, pi, sqrt
from typing import Any

import numpy as np
from scipy.special import ndtri

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
    pair,
    worst_units,
)
from course.grading.checks.statistics import (
    CLOSE,
    FALSE_FAIL,
    apart,
    check_mean,
    check_uniform,
    distribution_check,
)

EPSILON = float(np.finfo(np.float32).eps)

POINTS = 20_000
"""In a check of a distribution."""


# ---------------------------------------------------------------- values


def _cosines(trial: Trial, n: int, dtype: Any = np.float32) -> Array:
    """Above the horizon and below."""
    return trial.rng.uniform(-1, 1, n).astype(dtype)


ENDS = (-1.0, -1e-7, 0.0, 1e-30, 1e-7, 0.5, 1.0)
"""Cosines at which something may go wrong."""


def _integral(n: float) -> float:
    """Of cos^n over the hemisphere [sr]."""
    return 2 * pi / (n + 1)


def _moment(power: float, lobe: float) -> float:
    """The mean of cos^power over directions whose density is a Phong lobe's."""
    return (lobe + 1) / (power + lobe + 1)


def _central(n: int, lobe: float, order: int) -> float:
    """A central moment of f / pdf, f = cos^n sampled by a Phong lobe of another exponent.

    Exponent 0 is the uniform hemisphere, 1 the cosine.
    """
    scale, mean = 2 * pi / (lobe + 1), _integral(n)
    return sum(
        comb(order, k) * scale**k * _moment(k * (n - lobe), lobe) * (-mean) ** (order - k)
        for k in range(order + 1)
    )


# ---------------------------------------------------------------- uniform_hemisphere, cosine_hemisphere

LOBES = {"uniform_hemisphere": 0, "cosine_hemisphere": 1}
"""Exponent of the Phong lobe that a function samples."""


def _directions(trial: Trial, n: int, dtype: Any = np.float32) -> Array:
    directions = finite_floats(
        trial.call(trial.rng.random((2, n), dtype)), (3, n), "the directions"
    )
    trial.show("points", "your directions, seen along z", yours=directions[:2, :2000])
    return directions


def _direction_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        worst = np.concatenate((worst_units(2, dtype), trial.rng.random((2, 90), dtype)), axis=1)
        for u in (worst, worst[:, :1].copy(), worst[:, :0].copy()):
            check_array(trial.call(u), (3, u.shape[1]), dtype, "the directions")


def _direction_untouched(trial: Trial) -> None:
    check_untouched(trial, trial.rng.random((2, 50), np.float32))


def _direction_refuses(trial: Trial) -> None:
    u = trial.rng.random((3, 4), np.float32)
    for bad in (u, u[:1], u[0], u[:2].T, u[None, :2]):
        check_refused(trial, bad, named=f"u of shape {bad.shape}")


def _direction_hemisphere(trial: Trial) -> None:
    for dtype in DTYPES:
        u = np.concatenate((worst_units(2, dtype), trial.rng.random((2, 5000), dtype)), axis=1)
        directions = finite_floats(trial.call(u), (3, u.shape[1]), "the directions")
        check_close(
            np.sqrt((directions * directions).sum(axis=0)),
            np.ones(u.shape[1]),
            1e-5,
            "length of the direction:",
            at(u=u),
            "What the height leaves for the ring around it is told by Pythagoras.",
        )
        below = int(directions[2].argmin())
        if not directions[2, below] >= -1e-6:
            raise Failure(
                "directions above the horizon, z >= 0",
                f"z = {directions[2, below]:.6g}",
                at(u=u)(below),
                "It is half a sphere, the half about +z.",
            )


def _even(directions: Array, lobe: float) -> Array:
    """Two coordinates that are uniform if the directions are distributed as a Phong lobe about +z."""
    x, y, z = directions
    return np.stack((np.clip(z, 0, 1) ** (lobe + 1), np.arctan2(y, x) / (2 * np.pi) % 1))


def _direction_distribution(trial: Trial) -> None:
    lobe = LOBES[trial.function]
    height = "z^2" if lobe else "z"
    values = _even(_directions(trial, POINTS), lobe)
    hint = f"With the right density {height} is uniform from 0 to 1."
    check_uniform(values[:1], (24,), f"{height} of the directions", hint)
    check_uniform(values[1:], (24,), "turn of the directions", "All round alike, a whole turn.")
    check_uniform(
        values,
        (16, 16),
        f"{height} and turn of the directions together",
        "Each of the two numbers has to have a job of its own.",
    )


def _direction_integral(trial: Trial) -> None:
    lobe = LOBES[trial.function]
    n = int(trial.rng.integers(2, 5))
    z = _directions(trial, POINTS, np.float64)[2]
    # With the exact density: only the directions are the student's.
    value = 2 * pi / (lobe + 1) * np.clip(z, 0, None) ** (n - lobe)
    what = f"mean of cos^{n} / pdf, the integral of cos^{n}"
    variance = _central(n, lobe, 2)
    check_mean(
        value, _integral(n), variance, what, "Is the density of your directions the right one?"
    )
    check_mean(
        (value - _integral(n)) ** 2,
        variance,
        _central(n, lobe, 4) - variance**2,
        f"variance of cos^{n} / pdf",
        "Directions where the density is large have to come more often.",
    )


# ---------------------------------------------------------------- densities


def _pdf_arguments(trial: Trial, cos: Array, exponent: float) -> tuple[Any, ...]:
    return (cos, exponent) if trial.function == "phong_lobe_pdf" else (cos,)


def _exponents(trial: Trial) -> tuple[float, ...]:
    """To try: of the cosine's density there is only one."""
    if trial.function != "phong_lobe_pdf":
        return (1.0,)
    return 0.0, 1.0, 2.0, float(trial.rng.uniform(3, 60))


def _pdf(trial: Trial, cos: Array, exponent: float) -> Array:
    return finite_floats(
        trial.call(*_pdf_arguments(trial, cos, exponent)), cos.shape, "the density"
    )


def _lobe(cos: Array, exponent: float) -> Array:
    """The density above the horizon, in double precision."""
    return np.asarray((exponent + 1) / (2 * pi) * cos.astype(np.float64) ** exponent)


def _pdf_contract(trial: Trial) -> None:
    exponents = _exponents(trial)
    if trial.function == "phong_lobe_pdf":
        exponents += (1e-3, 1e5, 1e30, 1e300)
    for dtype in DTYPES:
        cos = np.concatenate((np.array(ENDS, dtype), _cosines(trial, 50, dtype)))
        for batch in (cos, cos[:1].copy(), cos[:0].copy()):
            for exponent in exponents:
                value = trial.call(*_pdf_arguments(trial, batch, exponent))
                check_array(value, batch.shape, dtype, "the density")


def _pdf_untouched(trial: Trial) -> None:
    check_untouched(trial, *_pdf_arguments(trial, _cosines(trial, 50), 3.0))


def _pdf_refuses(trial: Trial) -> None:
    cos = _cosines(trial, 4)
    for bad in (cos[None], cos.reshape(2, 2), cos[0]):
        check_refused(trial, *_pdf_arguments(trial, bad, 2.0), named="cos (its shape)")
    if trial.function == "phong_lobe_pdf":
        for exponent in (-1.0, -1e-6, nan):
            check_refused(trial, cos, exponent, named=f"exponent {exponent}")


def _pdf_values(trial: Trial) -> None:
    for dtype in DTYPES:
        for exponent in _exponents(trial):
            cos = np.concatenate((trial.rng.uniform(1e-3, 1, 500), [1.0])).astype(dtype)
            check_close(
                _pdf(trial, cos, exponent),
                _lobe(cos, exponent),
                # A power takes the rounding of its base so many times.
                8 * EPSILON * (exponent + 1) ** 2,
                f"for exponent {exponent:.6g} the density"
                if trial.function == "phong_lobe_pdf"
                else "the density",
                at(cos=cos),
                "Its integral over the hemisphere is 1.",
            )


def _pdf_below(trial: Trial) -> None:
    cos = -trial.rng.uniform(1e-3, 1, 200)
    for exponent in _exponents(trial):
        check_close(
            _pdf(trial, cos, exponent),
            np.zeros(200),
            0.0,
            "below the horizon, the density",
            at(cos=cos),
            "No direction is ever sampled there.",
        )


def _pdf_integral(trial: Trial) -> None:
    nodes, weights = np.polynomial.legendre.leggauss(64)
    for exponent in _exponents(trial):
        total = float(2 * pi * _pdf(trial, (nodes + 1) / 2, exponent) @ weights / 2)
        if not abs(total - 1) <= 1e-4:
            raise Failure(
                "a density whose integral over the hemisphere is 1",
                f"{total:.6g}",
                f"exponent = {exponent:.6g}" if trial.function == "phong_lobe_pdf" else "",
                "What is it divided by, so that all directions together have probability 1?",
            )


# ---------------------------------------------------------------- estimate


def _samples(trial: Trial, n: int, channels: int = 0, dtype: Any = np.float64) -> tuple[Any, Any]:
    """Values and densities that have little to do with each other."""
    shape = (channels, n) if channels else (n,)
    return (
        trial.rng.uniform(0.1, 4, shape).astype(dtype),
        trial.rng.uniform(0.2, 2, n).astype(dtype),
    )


def _estimate(trial: Trial, f: Array, pdf: Array) -> tuple[Array, Array]:
    """Mean and variance as float64, () or (C,)."""
    mean, variance = (
        np.array(x) if isinstance(x, float | np.floating) else x
        for x in pair(trial.call(f, pdf), "mean", "variance")
    )
    shape = f.shape[:-1]
    return finite_floats(mean, shape, "the mean"), finite_floats(variance, shape, "the variance")


def _estimate_contract(trial: Trial) -> None:
    for f_dtype in DTYPES:
        for pdf_dtype in DTYPES:
            dtype = np.result_type(f_dtype, pdf_dtype)
            for channels, n in ((0, 20), (3, 20), (1, 20), (0, 1), (3, 1), (0, 0), (3, 0)):
                f, pdf = _samples(trial, n, channels)
                value = pair(
                    trial.call(f.astype(f_dtype), pdf.astype(pdf_dtype)), "mean", "variance"
                )
                for name, found in zip(("the mean", "the variance"), value, strict=True):
                    if not channels and isinstance(found, float):
                        found = np.array(found, dtype)
                    elif not channels and isinstance(found, np.floating):
                        found = np.array(found)
                    check_array(found, f.shape[:-1], dtype, f"of f {f.shape}, {name}")
                    if n == 0 and found.any():
                        raise Failure(f"of no samples, {name} 0", f"{found.ravel()[0]}")


def _estimate_untouched(trial: Trial) -> None:
    check_untouched(trial, *_samples(trial, 50, 3))
    f, pdf = _samples(trial, 50)
    f[:5], pdf[:5] = 0, 0
    check_untouched(trial, f, pdf)


def _estimate_refuses(trial: Trial) -> None:
    f, pdf = _samples(trial, 4, 3)
    for bad in (f[None], f[0, 0]):
        check_refused(trial, bad, pdf, named="f (its shape)")
    for bad in (pdf[:3], pdf[None], f, pdf[0]):
        check_refused(trial, f, bad, named="pdf (its shape)")
    for number in (-1.0, nan, 0.0):
        wrong = pdf.copy()
        wrong[2] = number
        check_refused(trial, f, wrong, named=f"pdf ({number})")


def _check_estimate(trial: Trial, f: Array, pdf: Array, hint: str, of: str = "both") -> None:
    """Against the two formulas in double precision."""
    kept = pdf != 0
    value = np.zeros(f.shape)
    value[..., kept] = f[..., kept].astype(np.float64) / pdf[kept]
    n = f.shape[-1]
    mean, variance = _estimate(trial, f, pdf)
    where = f"N = {n}, f of shape {f.shape}"
    if of != "variance":
        expected = value.mean(axis=-1)
        check_close(
            mean[..., None],
            expected[..., None],
            1e-5 * float(np.abs(value).mean()),
            f"{where}: mean",
            hint=hint,
        )
    if of != "mean":
        expected = value.var(axis=-1, ddof=1) / n
        check_close(
            variance[..., None],
            expected[..., None],
            1e-4 * float(expected.max()),
            f"{where}: variance of the mean",
            hint=hint,
        )


def _estimate_mean(trial: Trial) -> None:
    hint = "Each sample counts as much as it is rare: its value over its density."
    for dtype in DTYPES:
        for channels, n in ((0, 2), (0, 500), (3, 400)):
            _check_estimate(trial, *_samples(trial, n, channels, dtype), hint, "mean")


def _estimate_variance(trial: Trial) -> None:
    hint = "It is the mean's variance, not one sample's, and the mean was estimated from the same samples."
    for dtype in DTYPES:
        for channels, n in ((0, 2), (0, 5), (0, 500), (3, 400)):
            _check_estimate(trial, *_samples(trial, n, channels, dtype), hint, "variance")


def _estimate_zero(trial: Trial) -> None:
    for channels in (0, 3):
        f, pdf = _samples(trial, 200, channels)
        none = trial.rng.random(200) < 0.3
        none[:1] = True
        f[..., none], pdf[none] = 0, 0
        _check_estimate(trial, f, pdf, "A sample of density 0 counts 0, and it does count.")


def _estimate_small(trial: Trial) -> None:
    """A variance that is small beside the square of the mean."""
    for dtype in DTYPES:
        f = (3000 + trial.rng.random(1000)).astype(dtype)
        hint = "The difference of two large means of squares has no digits left."
        _check_estimate(trial, f, np.ones(1000, dtype), hint, "variance")


def _estimate_perfect(trial: Trial) -> None:
    n = int(trial.rng.integers(2, 20))
    cos = trial.rng.random(1000) ** (1 / (n + 1))
    mean, variance = _estimate(trial, cos**n, _lobe(cos, n))
    exact = _integral(n)
    if not (abs(mean - exact) <= 1e-9 and abs(variance) <= 1e-12):
        raise Failure(
            f"mean {exact:.7g} and variance 0 for a density proportional to f",
            f"mean {mean:.7g}, variance {variance:.3g}",
            hint="Then every sample says the same.",
        )


def _estimate_predicted(trial: Trial) -> None:
    """Uniform, cosine and Phong lobe: the variances that theory tells for cos^n."""
    n = int(trial.rng.integers(3, 6))
    for lobe, name in ((0, "uniform"), (1, "cosine-weighted"), (n - 1, f"Phong ({n - 1})")):
        cos = trial.rng.random(POINTS) ** (1 / (lobe + 1))
        mean, variance = _estimate(trial, cos**n, _lobe(cos, lobe))
        exact = _central(n, lobe, 2)
        z = -float(ndtri(FALSE_FAIL / 2))
        for what, found, expected, spread in (
            ("mean", float(mean), _integral(n), sqrt(exact / POINTS)),
            (
                "variance",
                float(variance),
                exact / POINTS,
                sqrt((_central(n, lobe, 4) - exact**2) / POINTS) / POINTS,
            ),
        ):
            if not abs(found - expected) <= z * spread:
                raise Failure(
                    f"for cos^{n} by {name} sampling, {what} {expected:.5g} within {z * spread:.2g}",
                    f"{found:.5g}",
                    f"N = {POINTS}",
                    "The same integral each time; the closer the density, the smaller the variance.",
                )


# ---------------------------------------------------------------- power_heuristic


def _densities(trial: Trial, n: int, dtype: Any = np.float64) -> tuple[Array, Array]:
    a, b = np.exp(trial.rng.uniform(-3, 3, (2, n)))
    return a.astype(dtype), b.astype(dtype)


def _weights(trial: Trial, a: Array, b: Array) -> Array:
    return finite_floats(trial.call(a, b), a.shape, "the weights")


def _power_contract(trial: Trial) -> None:
    for a_dtype in DTYPES:
        for b_dtype in DTYPES:
            a, b = _densities(trial, 60)
            a[:10], b[5:15] = 0, 0
            for n in (60, 1, 0):
                value = trial.call(a[:n].astype(a_dtype), b[:n].astype(b_dtype))
                check_array(value, (n,), np.result_type(a_dtype, b_dtype), "the weights")


def _power_untouched(trial: Trial) -> None:
    check_untouched(trial, *_densities(trial, 50))


def _power_refuses(trial: Trial) -> None:
    a, b = _densities(trial, 4)
    for bad in (a[None], a[0]):
        check_refused(trial, bad, b, named="a (its shape)")
    for bad in (b[None], b[:3], b[0]):
        check_refused(trial, a, bad, named="b (its shape)")
    for number in (-1.0, nan):
        wrong = a.copy()
        wrong[1] = number
        check_refused(trial, wrong, b, named=f"a ({number})")
        check_refused(trial, b, wrong, named=f"b ({number})")


def _power_values(trial: Trial) -> None:
    for dtype in DTYPES:
        a, b = _densities(trial, 500, dtype)
        squares = a.astype(np.float64) ** 2, b.astype(np.float64) ** 2
        check_close(
            _weights(trial, a, b),
            squares[0] / (squares[0] + squares[1]),
            16 * EPSILON,
            "the weight",
            at(a=a, b=b),
            "The power is 2, and the weight is that of the sample drawn with a.",
        )


def _power_sum(trial: Trial) -> None:
    a, b = _densities(trial, 500)
    check_close(
        _weights(trial, a, b) + _weights(trial, b, a),
        np.ones(500),
        16 * EPSILON,
        "the two weights of one sample together:",
        at(a=a, b=b),
        "Together they count each sample once.",
    )


def _power_limits(trial: Trial) -> None:
    x = float(np.exp(trial.rng.uniform(-3, 3)))
    a = np.array([x, 0.0, 0.0, x])
    b = np.array([0.0, x, 0.0, x])
    check_close(
        _weights(trial, a, b),
        np.array([1, 0, 0, 0.5]),
        1e-6,
        "the weight",
        at(a=a, b=b),
        "What only one density could have drawn is its own; what none could have counts 0.",
    )


def _power_extremes(trial: Trial) -> None:
    a = np.array([1.0, 3.0, 1.0, 2.0], np.float32)
    b = np.array([1.0, 1.0, 2.0, 0.0], np.float32)
    expected = np.array([0.5, 0.9, 0.2, 1.0])
    for scale in (1e-30, 1e-22, 1e22, 1e30):
        by = np.float32(scale)
        check_close(
            _weights(trial, a * by, b * by),
            expected,
            1e-5,
            "the weight",
            at(a=a * by, b=b * by),
            "It depends on the ratio alone, but the squares are too large or too small for the dtype.",
        )


# ---------------------------------------------------------------- mistakes


def _heights_are(trial: Trial, model: Callable[[Array], Array]) -> bool:
    """Heights are spread as a mistaken warp of uniform numbers spreads them."""
    z = _directions(trial, 4000)[2]
    return apart(z, model(trial.rng.random(4000))) < CLOSE


def _pdf_is(trial: Trial, mistaken: Callable[[Array, float], Array]) -> bool:
    exponents = (1.0,) if trial.function == "cosine_hemisphere_pdf" else (2.0, 5.0, 8.0)
    for exponent in exponents:
        cos = trial.rng.uniform(0.1, 1, 200)
        expected = mistaken(cos, exponent)
        if not (np.abs(_pdf(trial, cos, exponent) - expected) < 1e-5 * expected.max()).all():
            return False
    return True


def _pdf_below_horizon(trial: Trial) -> bool:
    """Right above the horizon, but not 0 below."""
    return _pdf_is(trial, _lobe) and bool(_pdf(trial, -trial.rng.uniform(0.1, 1, 50), 2.0).any())


def _estimate_is(trial: Trial, mean: Callable[[Array, Array], Any]) -> bool:
    f, pdf = _samples(trial, 200)
    return abs(float(_estimate(trial, f, pdf)[0]) - float(mean(f, pdf))) < 1e-5 * float(
        mean(f, pdf)
    )


def _variance_is(trial: Trial, variance: Callable[[Array], Any]) -> bool:
    f, pdf = _samples(trial, 20)
    expected = float(variance(f / pdf))
    return abs(float(_estimate(trial, f, pdf)[1]) - expected) < 1e-5 * expected


def _estimate_leaves_out(trial: Trial) -> bool:
    f, pdf = _samples(trial, 100)
    f[:40], pdf[:40] = 0, 0
    mean = float(_estimate(trial, f, pdf)[0])
    return abs(mean - float((f[40:] / pdf[40:]).mean())) < 1e-5


def _weights_are(trial: Trial, mistaken: Callable[[Array, Array], Array]) -> bool:
    a, b = _densities(trial, 200)
    return bool(np.abs(_weights(trial, a, b) - mistaken(a, b)).max() < 1e-5)


def _weights_overflow(trial: Trial) -> bool:
    """Right, but for densities whose squares the dtype can't hold."""
    if not _weights_are(trial, lambda a, b: a * a / (a * a + b * b)):
        return False
    large = np.full(1, 1e30, np.float32)
    value = np.asarray(trial.call(large, large), np.float64)
    return not bool(np.abs(value - 0.5).max() < 1e-5)


# ---------------------------------------------------------------- all of it


def _direction_checks(function: str) -> tuple[Check, ...]:
    density = "cos / pi" if LOBES[function] else "1 / (2 pi)"
    return (
        *contract_checks(function, _direction_contract, _direction_untouched, _direction_refuses),
        Check(
            function,
            "hemisphere",
            "Directions are unit length and above the horizon",
            _direction_hemisphere,
        ),
        distribution_check(
            function, "density", f"Directions have density {density}", _direction_distribution, 3
        ),
        distribution_check(
            function,
            "integral",
            "They integrate a power of the cosine, with the variance that theory tells",
            _direction_integral,
            2,
        ),
    )


def _pdf_checks(function: str) -> tuple[Check, ...]:
    return (
        *contract_checks(function, _pdf_contract, _pdf_untouched, _pdf_refuses),
        Check(function, "values", "The density is its formula", _pdf_values),
        Check(function, "below", "Below the horizon the density is 0", _pdf_below),
        Check(function, "normalised", "The density's integral is 1", _pdf_integral),
    )


CHECKS = ModuleChecks(
    "importance_sampling",
    checks=(
        *_direction_checks("uniform_hemisphere"),
        *_direction_checks("cosine_hemisphere"),
        *_pdf_checks("cosine_hemisphere_pdf"),
        *_pdf_checks("phong_lobe_pdf"),
        *contract_checks("estimate", _estimate_contract, _estimate_untouched, _estimate_refuses),
        Check("estimate", "mean", "The estimate is the mean of f / pdf", _estimate_mean),
        Check("estimate", "variance", "The variance is that of the mean", _estimate_variance),
        Check("estimate", "zero_density", "Samples of density 0 count 0", _estimate_zero),
        Check(
            "estimate",
            "small_variance",
            "A small variance about a large mean is not lost in rounding",
            _estimate_small,
        ),
        Check(
            "estimate",
            "perfect",
            "A density proportional to f leaves no variance",
            _estimate_perfect,
        ),
        distribution_check(
            "estimate",
            "predicted",
            "Uniform, cosine and Phong sampling leave the variances that theory tells",
            _estimate_predicted,
            6,
        ),
        *contract_checks("power_heuristic", _power_contract, _power_untouched, _power_refuses),
        Check("power_heuristic", "values", "Weights are a^2 / (a^2 + b^2)", _power_values),
        Check("power_heuristic", "sum", "The weights of both densities make 1", _power_sum),
        Check("power_heuristic", "limits", "Where one density or both are 0", _power_limits),
        Check(
            "power_heuristic",
            "extremes",
            "Very large and very small densities weigh as their ratio says",
            _power_extremes,
        ),
    ),
    mistakes=(
        Mistake(
            "uniform_hemisphere",
            "uniform-angle",
            "Your directions crowd the pole: what is uniform is the height, not the angle.",
            partial(_heights_are, model=lambda u: np.cos(np.pi / 2 * u)),
        ),
        Mistake(
            "uniform_hemisphere",
            "whole-sphere",
            "Your directions cover the whole sphere.",
            partial(_heights_are, model=lambda u: 2 * u - 1),
        ),
        Mistake(
            "uniform_hemisphere",
            "cosine-for-uniform",
            "Your directions have the density cos / pi instead of a constant one.",
            partial(_heights_are, model=np.sqrt),
        ),
        Mistake(
            "cosine_hemisphere",
            "uniform-for-cosine",
            "Your directions are uniform: those near the horizon come as often as those near the pole.",
            partial(_heights_are, model=lambda u: u),
        ),
        Mistake(
            "cosine_hemisphere",
            "disk-crowded-centre",
            "The disk that you lift to the hemisphere is crowded at its centre.",
            partial(_heights_are, model=lambda u: np.sqrt(1 - u * u)),
        ),
        Mistake(
            "cosine_hemisphere",
            "uniform-angle-for-cosine",
            "Your angles from the pole are uniform: that crowds the pole too much.",
            partial(_heights_are, model=lambda u: np.cos(np.pi / 2 * u)),
        ),
        Mistake(
            "cosine_hemisphere_pdf",
            "cosine-not-normalised",
            "Your density is the cosine itself, whose integral over the hemisphere is pi.",
            partial(_pdf_is, mistaken=lambda cos, _: cos),
        ),
        Mistake(
            "cosine_hemisphere_pdf",
            "cosine-over-2-pi",
            "You divide by the hemisphere's solid angle; the integral of the cosine over it is half of that.",
            partial(_pdf_is, mistaken=lambda cos, _: cos / (2 * pi)),
        ),
        Mistake(
            "cosine_hemisphere_pdf",
            "cosine-below-horizon",
            "Below the horizon your density is not 0.",
            _pdf_below_horizon,
        ),
        Mistake(
            "phong_lobe_pdf",
            "reflectance-for-density",
            "You divide by the integral of cos^(n + 1): that belongs to the reflectance, not to the density.",
            partial(_pdf_is, mistaken=lambda cos, n: (n + 2) / (2 * pi) * cos**n),
        ),
        Mistake(
            "phong_lobe_pdf",
            "lobe-not-normalised",
            "Your density is the power of the cosine itself: its integral is not 1.",
            partial(_pdf_is, mistaken=lambda cos, n: cos**n),
        ),
        Mistake(
            "phong_lobe_pdf",
            "exponent-off-by-one",
            "Your density is scaled by the exponent instead of one more.",
            partial(_pdf_is, mistaken=lambda cos, n: n / (2 * pi) * cos**n),
        ),
        Mistake(
            "phong_lobe_pdf",
            "lobe-below-horizon",
            "Below the horizon your density is not 0; even powers hide the sign of the cosine.",
            _pdf_below_horizon,
        ),
        Mistake(
            "estimate",
            "density-ignored",
            "You take the mean of f, as if all samples were equally probable with density 1.",
            partial(_estimate_is, mean=lambda f, _: f.mean()),
        ),
        Mistake(
            "estimate",
            "times-density",
            "You multiply by the density, so samples count more the more probable they are.",
            partial(_estimate_is, mean=lambda f, pdf: (f * pdf).mean()),
        ),
        Mistake(
            "estimate",
            "sum-over-sum",
            "You divide the sum of f by the sum of the densities: a ratio of means is not the mean of ratios.",
            partial(_estimate_is, mean=lambda f, pdf: f.sum() / pdf.sum()),
        ),
        Mistake(
            "estimate",
            "variance-of-one-sample",
            "Your variance is that of a single sample; the mean of N varies less.",
            lambda trial: any(_variance_is(trial, partial(np.var, ddof=ddof)) for ddof in (0, 1)),
        ),
        Mistake(
            "estimate",
            "biased-variance",
            "Your variance is too small on average: the mean was made of the same samples.",
            partial(_variance_is, variance=lambda x: x.var() / x.size),
        ),
        Mistake(
            "estimate",
            "standard-deviation",
            "You return the square root of the variance.",
            partial(_variance_is, variance=lambda x: np.sqrt(x.var(ddof=1) / x.size)),
        ),
        Mistake(
            "estimate",
            "zeros-left-out",
            "You leave out the samples of density 0; they count 0, but they do count.",
            _estimate_leaves_out,
        ),
        Mistake(
            "power_heuristic",
            "balance-heuristic",
            "You weigh by the densities themselves, not by their squares: that is the balance heuristic.",
            partial(_weights_are, mistaken=lambda a, b: a / (a + b)),
        ),
        Mistake(
            "power_heuristic",
            "weights-swapped",
            "You return the weight of the sample drawn with b.",
            partial(_weights_are, mistaken=lambda a, b: b * b / (a * a + b * b)),
        ),
        Mistake(
            "power_heuristic",
            "squares-overflow",
            "Your weights are right until the squares of the densities overflow.",
            _weights_overflow,
        ),
    ),
)
