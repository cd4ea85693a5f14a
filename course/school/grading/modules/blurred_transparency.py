"""blurred_transparency declared: Snell's law, total internal reflection, the blurred lobe, and Fresnel's formulae.

Close to the critical angle rounding decides, so no check comes nearer to it than ``MARGIN``.
"""

from collections.abc import Callable, Mapping
from functools import partial
from math import inf, nan
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array, Trial
from course.school.grading.checks.declare import Arguments, Case, Made, function
from course.school.grading.checks.drawing import Draw, worst_directions, worst_units
from course.school.grading.checks.laws import close, holds, unit_length, within
from course.school.grading.checks.vectors import cross, dot
from course.school.grading.modules.squares import no_jitter, offsets, square

MARGIN = 1e-3
"""How near to 1 the sines of refracted rays come."""


ETA = Made(
    lambda d: d.uniform(0.3, 3, d.n),
    (0.0, -1.5, 11.0, nan, inf, np.array((1.0, 1.5, -1.0, 1.0), np.float32)),
    single=True,
)


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


def _ends(draw: Draw) -> Mapping[str, Any]:
    """Straight on with any eta, between equal media, or along the surface into a denser one."""
    straight, equal = draw.rng.random((2, draw.n)) < 1 / 3
    eta = np.where(straight, draw.uniform(0.1, 10, draw.n), draw.uniform(0.1, 0.9, draw.n))
    sine = np.where(equal, draw.uniform(0, 0.95, draw.n), 1 - draw.uniform(0, 0.01, draw.n))
    return _boundary(np.where(equal, 1, eta), np.where(straight, 0, sine), draw)


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


_bent = partial(close, compare=_beyond, what="direction (rows 0 to 2) or total (3):")


REFRACT = function(
    "blurred_transparency.refract",
    {"eta": ETA},
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
        ),
        _bent(
            "ends",
            "Along the normal and between equal media nothing is bent, along the surface most",
            hint="Straight on, or with eta 1, a ray stays as it was; along the surface sin_t = eta.",
            case=_ends,
        ),
        _bent(
            "snell",
            "Rays are bent by Snell's law, to the far side",
            hint="sin_t = eta sin_i, in the plane of direction and normal, "
            "on the side where the normal does not point.",
            case=lambda d: _boundary(*_one_eta(d), d),
            scales=(1.0,) * 4,
            role="core",
            whole=True,
        ),
        _bent(
            "total",
            "Totally reflected rays hold the mirrored direction",
            hint="Where no light gets through, all of it is reflected.",
            case=lambda d: _boundary(*_one_eta(d, total=True), d),
        ),
        _bent(
            "each",
            "Each ray may have an eta of its own",
            hint="With an array of etas each ray is bent or mirrored by its own.",
            case=lambda d: _boundary(*_each_eta(d), d),
        ),
    ),
    case=_through,
    corners=(
        _facing(),
        lambda dtype: {**_through(Draw(np.random.default_rng(0), 5, dtype)), "eta": 1.0},
    ),
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


def _shown(trial: Trial, a: Arguments, r: Array) -> None:
    """Where the offsets lie in the square that fits them best."""
    found = offsets(a, r)
    if np.isfinite(found).all():
        design = np.concatenate((a.u - 0.5, np.ones((1, a.u.shape[1]))))
        sides = np.linalg.lstsq(design.T, found.T, rcond=None)[0][:2]
        sides /= np.maximum(np.linalg.norm(sides, axis=1, keepdims=True), 1e-30)
        places = sides @ found / a.roughness + 0.5
        inside = (np.abs(places - 0.5) <= 0.5).all(axis=0)
        trial.show("points", "where yours meet the square", yours=places[:, inside])


def _out_of_square(a: Arguments, r: Array) -> tuple[Any, ...]:
    """How wrong offsets are in length: what came, or what it was before it was mirrored, if that was above."""
    size = a.roughness * np.linalg.norm(a.u - 0.5, axis=0)
    before = r - 2 * dot(r, a.normal) * a.normal
    off, off_before = (np.abs(np.linalg.norm(offsets(a, j), axis=0) - size) for j in (r, before))
    # What comes out behind the direction itself has no offset, and is wrong.
    came_back = dot(before, a.normal) >= 0
    return np.where(came_back, np.fmin(off, off_before), off), 0.0, 1 + a.roughness**2


def _features(a: Arguments, r: Array) -> Array:
    """What a turn or a mirror image of the square leaves alone."""
    size = np.linalg.norm(r / dot(r, a.direction) - a.direction, axis=0) / a.roughness
    return np.stack((size, dot(r, a.direction), dot(r, a.normal), np.linalg.norm(r, axis=0)))


JITTER_REFRACTION = function(
    "blurred_transparency.jitter_refraction",
    {"roughness": declare.number(0.05, 2, (-1.0, -1e-6, nan))},
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
        ),
        close(
            "mirrored",
            "What came back is mirrored in the surface, the rest left as it was",
            _out_of_square,
            "Where the part along the normal is positive its sign changes; nothing else does.",
            what="from the place in the square, directly or by way of the mirror, a distance of",
            within=100,
            case=_far(_flat, 0.5, 0.9, 2.0),
            scales=(1.0,) * 3,
        ),
        close(
            "sizes",
            "Small and large squares are as wide as they should be",
            _out_of_square,
            "The sides are as long as roughness, however small or large that is.",
            what="from the place in the square, directly or by way of the mirror, a distance of",
            within=100,
            case=_far(_flat, 0.01, 5.0),
            scales=(1.0,) * 6,
        ),
        no_jitter("roughness", _far(_flat)),
        square(
            "square",
            "The jitter is a square of side roughness around the refracted direction",
            case=_steep,
            scales=(1.0,) * 2,
            figure=_shown,
            whole=True,
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


def _worst_cosines(dtype: Any) -> Array:
    """Cosines along and at right angles to the surface, and what rounding puts beyond them."""
    return np.array(ENDS, dtype)


def _flat_or_straight(draw: Draw) -> Mapping[str, Any]:
    """Straight on with any eta, between equal media, or along the surface."""
    straight, equal = draw.rng.random((2, draw.n)) < 1 / 3
    eta = np.where(straight, draw.uniform(0.1, 10, draw.n), draw.uniform(0.3, 3, draw.n))
    cos_i = np.where(equal, draw.uniform(0.1, 1, draw.n), draw.rng.choice((0, 1e-9), draw.n))
    return {"eta": np.where(equal, 1, eta), "cos_i": np.where(straight, 1, cos_i)}


def _along_the_surface(draw: Draw) -> Mapping[str, Any]:
    """Rays along the surface between media of which every third pair is equal."""
    eta = np.where(np.arange(draw.n) % 3 == 0, 1, draw.uniform(0.3, 3, draw.n))
    return {"eta": eta, "cos_i": np.zeros(draw.n)}


def _amplitudes(a: Arguments, r: Array) -> tuple[Any, ...]:
    """By complex amplitudes, whose size is 1 in total reflection."""
    cos_i = np.clip(a.cos_i, 0, 1)
    cos_t = np.sqrt(1 - a.eta**2 * (1 - cos_i**2) + 0j)
    across = (a.eta * cos_i - cos_t) / (a.eta * cos_i + cos_t)
    within = (cos_i - a.eta * cos_t) / (cos_i + a.eta * cos_t)
    expected = (np.abs(across) ** 2 + np.abs(within) ** 2) / 2
    return r, expected, (1 + a.eta) ** 2 / np.maximum(np.abs(cos_t), MARGIN)


_reflected = partial(close, compare=_amplitudes, what="a reflectance of")


FRESNEL = function(
    "blurred_transparency.fresnel",
    {"cos_i": Made(lambda d: d.units(1)[0], corners=_worst_cosines), "eta": ETA},
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
            "ends",
            "Straight on, along the surface and between equal media the reflectance is right",
            hint="Straight on both polarisations give ((n - 1) / (n + 1))^2; the surface seen flat is a mirror.",
            case=_flat_or_straight,
        ),
        close(
            "horizon",
            "Along the surface all is mirrored, between equal media too",
            lambda _, r: (r, 1.0),
            "There is 0 / 0 where both media are equal: along the surface the reflectance is 1, whatever eta is.",
            what="along the surface, a reflectance of",
            case=_along_the_surface,
        ),
        _reflected(
            "exact",
            "The reflectance is exact at all angles at which light gets through",
            hint="The mean of both polarisations' squared amplitudes.",
            case=lambda d: _cosines(*_one_eta(d)),
            scales=(1.0,) * 4,
            role="core",
            whole=True,
        ),
        _reflected(
            "slanting",
            "Nearly along the surface most is mirrored, and not all",
            hint="Only along the surface itself all is mirrored.",
            case=lambda d: {
                "eta": d.uniform(0.1, 0.95, d.n),
                "cos_i": 10 ** d.uniform(-4, -1, d.n),
            },
        ),
        _reflected(
            "total",
            "Total internal reflection is total",
            hint="In total internal reflection nothing gets through.",
            case=lambda d: _cosines(*_one_eta(d, total=True)),
        ),
        _reflected(
            "each",
            "Each ray may have an eta of its own",
            hint="With an array of etas each ray is reflected by its own, totally or not.",
            case=lambda d: _cosines(*_each_eta(d)),
        ),
    ),
    corners=(
        lambda _: {"eta": 1.0},
        lambda dtype: {"eta": 1.0, "cos_i": _worst_cosines(dtype)},
        lambda dtype: {"eta": np.ones(len(ENDS)), "cos_i": _worst_cosines(dtype)},
    ),
)

FUNCTIONS = (REFRACT, JITTER_REFRACTION, FRESNEL)
