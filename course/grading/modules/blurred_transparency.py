"""blurred_transparency declared: Snell's law, total internal reflection, the blurred lobe, and Fresnel's formulae.

Close to the critical angle rounding decides, so no check comes nearer to it than ``MARGIN``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import inf, nan
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Trial
from course.grading.checks.declare import (
    Argument,
    Arguments,
    Case,
    Function,
    Module,
    Result,
    number,
    u,
)
from course.grading.checks.drawing import Draw, worst_directions, worst_units
from course.grading.checks.laws import close, holds, unit_length, within
from course.grading.checks.vectors import cross, dot
from course.grading.checks.weights import WHOLE

MARGIN = 1e-3
"""How near to 1 the sines of refracted rays come."""


def _eta() -> Argument:
    wrong = (0.0, -1.5, 11.0, nan, inf, np.array((1.0, 1.5, -1.0, 1.0), np.float32))
    return Argument("eta", "N", lambda d: d.uniform(0.3, 3, d.n), wrong, single=True)


def _one_eta(draw: Draw, total: bool = False) -> tuple[float, Array]:
    """An eta for all rays, and sines of their angles: refracted ones, or totally reflected ones."""
    eta = draw.number(1.1, 10) if total else draw.number(0.1, 10)
    critical = min(1, 1 / eta)
    if total:
        return eta, draw.uniform(critical * (1 + MARGIN), 1, draw.n)
    return eta, draw.uniform(0, critical * (1 - MARGIN), draw.n)


def _facing(roughness: float = 0.0) -> Callable[[Any], Mapping[str, Any]]:
    """Directions and normals on and around the axes, turned towards each other, with the ends of all other numbers."""

    def corner(dtype: Any) -> Mapping[str, Any]:
        worst = worst_directions(dtype)
        size = worst.shape[1]
        first, second = np.divmod(np.arange(0, size**2, 2999), size)
        d, n = worst[:, first], worst[:, second]
        height = dot(d, n)
        d, n = (v[:, np.abs(height) > MARGIN] for v in (d, np.where(height > 0, -n, n)))
        column = np.arange(d.shape[1])
        return {
            "direction": d,
            "normal": n,
            "eta": np.array((0.1, 0.5, 1, 1.5, 10), dtype).clip(0.1, 10)[column % 5],
            "u": worst_units(2, dtype)[:, column % 25],
            "roughness": roughness,
        }

    return corner


def _vectors(name: str) -> Argument:
    return Argument(name, "3 N", lambda d: d.directions())


def _each_eta(draw: Draw) -> tuple[Array, Array]:
    """An eta for each ray, and sines of the angles of refracted and of reflected ones."""
    eta, sine = draw.uniform(0.4, 2.4, draw.n), draw.uniform(0, 0.999, draw.n)
    return eta, np.where(np.abs(eta * sine - 1) < MARGIN, 0.5 / eta, sine)


# ---------------------------------------------------------------- refract


def _met(draw: Draw, sine: Array) -> dict[str, Any]:
    """Directions and normals with those sines between them, turned anyhow."""
    if draw.simple:
        n, along = (np.repeat(row[:, None], draw.n, axis=1) for row in np.eye(3)[[2, 0]])
    else:
        n = draw.directions()
        along = cross(n, draw.directions())
        along /= np.linalg.norm(along, axis=0)
    return {"direction": sine * along - np.sqrt(1 - sine**2) * n, "normal": n}


def _boundary(eta: Any, sine: Array, draw: Draw) -> Mapping[str, Any]:
    return _met(draw, sine) | {"eta": eta}


def _through(draw: Draw) -> Mapping[str, Any]:
    """An eta for each ray; all are refracted."""
    eta = draw.uniform(0.4, 2.4, draw.n)
    return _boundary(eta, draw.uniform(0, 0.98, draw.n) * np.minimum(1, 1 / eta), draw)


def _straight(draw: Draw) -> Mapping[str, Any]:
    """Straight on with any eta, or between equal media."""
    straight = draw.rng.random(draw.n) < 0.5
    sine = np.where(straight, 0, draw.uniform(0, 0.95, draw.n))
    return _boundary(np.where(straight, draw.uniform(0.1, 10, draw.n), 1), sine, draw)


def _sine(a: Arguments) -> Array:
    """Between directions and normals as they are, after rounding."""
    return np.asarray(np.linalg.norm(cross(a.normal, a.direction), axis=0))


def _total(a: Arguments) -> Array:
    return np.asarray(a.eta * _sine(a) > 1)


def _beyond(a: Arguments, r: Any) -> tuple[Any, ...]:
    """Snell's law from sines, and the mirrored direction where there is no angle."""
    along = a.direction + dot(a.direction, -a.normal) * a.normal
    cos_t = np.sqrt(np.maximum(1 - (a.eta * _sine(a)) ** 2, 0))
    mirrored = a.direction - 2 * dot(a.direction, a.normal) * a.normal
    expected = np.where(_total(a), mirrored, a.eta * along - cos_t * a.normal)
    # Where cos_t is small, rounding of the sine tells in it.
    size = np.where(_total(a), 1, (1 + a.eta) ** 2 / np.maximum(cos_t, MARGIN))
    return np.vstack(r), np.vstack((expected, _total(a))), size


def _bent(name: str, title: str, hint: str, case: Case | None, **how: Any) -> Any:
    usual: dict[str, Any] = {"role": "corner", "what": "x, y, z or total of", "case": case}
    return close(name, title, _beyond, hint, **(usual | how))


REFRACT = Function(
    "refract",
    (_vectors("direction"), _vectors("normal"), _eta()),
    (Result("directions", "3 N"), Result("total", "N", np.bool_)),
    (
        unit_length(lambda _, r: r[0]),
        holds(
            "critical",
            "Reflection is total beyond the critical angle, and nowhere else",
            lambda a, r: r[1] == _total(a),
            "total just where eta sin_i > 1",
            "No angle has a sine over 1.",
            shows=lambda _, r: r[1].astype(float),
            case=lambda d: _boundary(*_each_eta(d), d),
            role="corner",
        ),
        _bent(
            "straight",
            "Nothing is bent along the normal, nor between equal media",
            "A ray along the normal is not bent, and with eta 1 no ray is.",
            _straight,
        ),
        _bent(
            "grazing",
            "Rays along the surface are bent into a denser medium",
            "Flat rays are bent most: sin_t = eta there.",
            lambda d: _boundary(d.number(0.1, 0.9), 1 - d.uniform(0, 0.01, d.n), d),
        ),
        _bent(
            "snell",
            "Rays are bent by Snell's law, to the far side",
            "sin_t = eta sin_i, in the plane of direction and normal, on the side where the normal does not point.",
            lambda d: _boundary(*_one_eta(d), d),
            scales=(1.0,) * 4,
            role="core",
            points=WHOLE,
        ),
        _bent(
            "total",
            "Totally reflected rays hold the mirrored direction",
            "Where no light gets through, all of it is reflected.",
            lambda d: _boundary(*_one_eta(d, total=True), d),
        ),
        _bent(
            "each",
            "Each ray may have an eta of its own",
            "Each ray has its own eta here, and is bent or mirrored on its own.",
            lambda d: _boundary(*_each_eta(d), d),
        ),
    ),
    case=_through,
    corners=(_facing(),),
)


# ---------------------------------------------------------------- jitter_refraction


def _far(cosine: Callable[[Draw], Array], *roughness: float) -> Case:
    """Refracted directions that go down at those cosines, and one of these sizes of the square."""

    def case(draw: Draw) -> Mapping[str, Any]:
        size = float(draw.rng.choice(roughness)) if roughness else draw.number(0.3, 2)
        return _met(draw, np.sqrt(1 - cosine(draw) ** 2)) | {"roughness": size}

    return case


def _flat(draw: Draw) -> Array:
    return draw.uniform(0.01, 0.5, draw.n)


def _steep(draw: Draw) -> Mapping[str, Any]:
    """One ray so steep that nothing of its square comes back, jittered many times."""
    ray = _met(draw.but(n=1), np.sqrt(1 - draw.uniform(0.8, 1, 1) ** 2))
    return {name: np.repeat(v, draw.n, axis=1) for name, v in ray.items()} | {
        "roughness": draw.number(0.05, 0.9)
    }


def _offsets(a: Arguments, r: Array) -> Array:
    """From the directions' tips to where the jittered ones meet the planes at right angles to them there."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(r / dot(r, a.direction) - a.direction)


def _square(a: Arguments, r: Array) -> tuple[Any, ...]:
    """All dot products of a ray's offsets, which stay the same however its square is turned or mirrored."""
    offsets, places = _offsets(a, r), a.roughness * (a.u - 0.5)
    return offsets.T @ offsets, places.T @ places, a.roughness * (1 + a.roughness)


def _shown(trial: Trial, a: Arguments, r: Array) -> None:
    """Where the offsets lie in the square that fits them best."""
    offsets = _offsets(a, r)
    if np.isfinite(offsets).all():
        design = np.concatenate((a.u - 0.5, np.ones((1, a.u.shape[1]))))
        sides = np.linalg.lstsq(design.T, offsets.T, rcond=None)[0][:2]
        sides /= np.maximum(np.linalg.norm(sides, axis=1, keepdims=True), 1e-30)
        places = sides @ offsets / a.roughness + 0.5
        inside = (np.abs(places - 0.5) <= 0.5).all(axis=0)
        trial.show("points", "where yours meet the square", yours=places[:, inside])


def _out_of_square(a: Arguments, r: Array) -> tuple[Any, ...]:
    """How wrong offsets are in length: what came, or what it was before it was mirrored, if that was above."""
    size = a.roughness * np.linalg.norm(a.u - 0.5, axis=0)
    before = r - 2 * dot(r, a.normal) * a.normal
    off, off_before = (np.abs(np.linalg.norm(_offsets(a, j), axis=0) - size) for j in (r, before))
    came_back = (dot(before, a.normal) >= 0) & (dot(before, a.direction) > 0)
    # Of what comes out behind the direction itself nothing can be said but that it is wrong.
    off = np.where(dot(r, a.direction) > 0, off, inf)
    return np.where(came_back, np.fmin(off, off_before), off), 0.0, 1 + a.roughness**2


def _features(a: Arguments, r: Array) -> Array:
    """What a turn or a mirror image of the square leaves alone."""
    size = np.linalg.norm(_offsets(a, r), axis=0) / a.roughness
    return np.stack((size, dot(r, a.direction), dot(r, a.normal), np.linalg.norm(r, axis=0)))


JITTER_REFRACTION = Function(
    "jitter_refraction",
    (
        _vectors("direction"),
        _vectors("normal"),
        number("roughness", 0.05, 2, (-1.0, -1e-6, nan)),
        u(2),
    ),
    (Result("the directions", "3 N"),),
    (
        unit_length(),
        holds(
            "far_side",
            "No ray comes back to the incoming side",
            lambda a, r: dot(r, a.normal) <= 2e-6,
            "dot(result, normal) < 0",
            "What came back through the surface would light up the wrong side.",
            shows=lambda a, r: dot(r, a.normal),
            case=_far(_flat, 0.5, 4.0, 1e3),
            scales=(1.0,) * 3,
            role="corner",
        ),
        close(
            "mirrored",
            "What came back is mirrored in the surface, the rest left as it was",
            _out_of_square,
            "The part along the normal changes its sign if it is positive; the rest stays.",
            what="from the place in the square, directly or by way of the mirror, a distance of",
            within=100,
            case=_far(_flat, 0.5, 0.9, 2.0),
            scales=(1.0,) * 3,
            role="corner",
        ),
        close(
            "no_jitter",
            "Roughness 0 gives the direction",
            lambda a, r: (r, a.direction, 1.0),
            "Nothing is to be added then.",
            what="with roughness 0, the direction itself:",
            within=4,
            case=_far(_flat, 0.0),
            role="corner",
        ),
        close(
            "square",
            "The jitter is a square of side roughness around the refracted direction",
            _square,
            "The square lies around the direction, a side for each number, at right angles, as long as roughness.",
            what="between the offsets of two jittered directions a dot product of",
            within=40,
            case=_steep,
            n=300,
            scales=(1.0,) * 2,
            figure=_shown,
            points=WHOLE,
        ),
    ),
    case=_far(_flat),
    corners=(_facing(0.0), _facing(1.0), _facing(1e4)),
    free=True,
    features=_features,
)


# ---------------------------------------------------------------- fresnel


def _cosines(eta: Any, sine: Array) -> Mapping[str, Any]:
    return {"eta": eta, "cos_i": np.sqrt(1 - sine**2)}


ENDS = (0.0, 1e-30, 1e-9, 0.5, 1 - 2.0**-24, 1.0, 1 + 2.0**-23, -1e-7)


def _ends(dtype: Any) -> Array:
    """Cosines along and at right angles to the surface, and what rounding puts beyond them."""
    return np.array(ENDS, dtype)


def _amplitudes(a: Arguments, r: Array) -> tuple[Any, ...]:
    """By complex amplitudes, whose size is 1 in total reflection."""
    cos_i = np.clip(a.cos_i, 0, 1)
    cos_t = np.sqrt(1 - a.eta**2 * (1 - cos_i**2) + 0j)
    across = (a.eta * cos_i - cos_t) / (a.eta * cos_i + cos_t)
    within = (cos_i - a.eta * cos_t) / (cos_i + a.eta * cos_t)
    expected = (np.abs(across) ** 2 + np.abs(within) ** 2) / 2
    return r, expected, (1 + a.eta) ** 2 / np.maximum(np.abs(cos_t), MARGIN)


def _reflected(name: str, title: str, hint: str, case: Case, **how: Any) -> Any:
    usual: dict[str, Any] = {"role": "corner", "what": "a reflectance of", "case": case}
    return close(name, title, _amplitudes, hint, **(usual | how))


FRESNEL = Function(
    "fresnel",
    (Argument("cos_i", "N", lambda d: d.units(1)[0], corners=_ends), _eta()),
    (Result("the reflectance", "N"),),
    (
        within(
            "range",
            "Reflectances are from 0 to 1, at the ends too",
            lambda _, r: r,
            0,
            1,
            "A share is never negative and never more than all.",
            what="a reflectance",
            slack=1e-5,
            case=lambda d: {"cos_i": d.rng.choice(ENDS, d.n)},
        ),
        _reflected(
            "straight",
            "Straight on, the reflectance is ((n - 1) / (n + 1))^2",
            "Straight on, both polarisations are reflected alike: ((n - 1) / (n + 1))^2.",
            lambda d: _cosines(d.number(0.1, 10), np.zeros(d.n)),
            scales=(1.0,) * 4,
        ),
        close(
            "grazing",
            "Along the surface all is reflected, and without a boundary nothing",
            lambda a, r: (r, np.where(a.cos_i < 1e-3, 1.0, 0.0), 1.0),
            "Seen flat enough, every surface is a mirror; and with eta 1 there is no boundary.",
            what="along the surface, or between equal media, a reflectance of",
            case=lambda d: (
                _cosines(1.0, d.uniform(0, 0.99, d.n))
                if d.rng.random() < 0.5
                else {"cos_i": d.rng.choice((0.0, 1e-9), d.n)}
            ),
            scales=(1.0,) * 6,
            role="corner",
        ),
        _reflected(
            "exact",
            "The reflectance is exact at all angles at which light gets through",
            "The mean of both polarisations' squared amplitudes.",
            lambda d: _cosines(*_one_eta(d)),
            scales=(1.0,) * 4,
            role="core",
            points=WHOLE,
        ),
        _reflected(
            "total",
            "Total internal reflection is total",
            "In total internal reflection nothing gets through.",
            lambda d: _cosines(*_one_eta(d, total=True)),
        ),
        _reflected(
            "each",
            "Each ray may have an eta of its own",
            "Each ray has its own eta here.",
            lambda d: _cosines(*_each_eta(d)),
        ),
    ),
)

MODULE = Module("blurred_transparency", (REFRACT, JITTER_REFRACTION, FRESNEL))
