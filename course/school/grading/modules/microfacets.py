"""microfacets declared: the GGX distribution, Smith's masking, visible normals and their density, and what is mirrored.

Visible normals are tested by what becomes of them when the surface is squeezed until its microfacets are a hemisphere:
mirrored there, the view is uniform over a cap of the sphere, from the height -z of the view to the pole (Dupuy and
Benyoub, "Sampling visible GGX normals with spherical caps", 2023).
"""

from collections.abc import Mapping
from functools import partial
from math import log, nan, pi
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import Arguments, Function, Law, Made, function
from course.school.grading.checks.distributions import uniform
from course.school.grading.checks.drawing import SEVEN, Draw, worst_directions
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.laws import EPSILON, close, holds, unit_length
from course.school.grading.checks.vectors import dot

SEVERAL = (1.0, 1.0, 1.0, 1.0)
"""Scales of a law without lengths: each makes other numbers."""

ALPHA = declare.number(0.1, 1.0, (0.0, -0.5, 1.5, nan))

LEAST = 0.02
"""Cosine of ordinary directions to the normal."""

ENDS = (-1.0, -1e-7, 0.0, 1e-30, 1e-7, 0.5, 1.0)
COSINES = Made(lambda d: d.uniform(0.05, 1, d.n), corners=lambda dtype: np.array(ENDS, dtype))


def _above(draw: Draw) -> Array:
    """Unit vectors (3, n) above the surface."""
    if draw.simple:
        up = SEVEN[:, SEVEN[2] > 0]
        return up[:, draw.rng.integers(0, up.shape[1], draw.n)].astype(float)
    return _turned(draw.uniform(LEAST, 1, draw.n), draw)


def _turned(z: Array, draw: Draw) -> Array:
    """Unit vectors of those heights, turned anyhow."""
    phi = draw.uniform(0, 2 * pi, len(z))
    radius = np.sqrt(1 - z * z)
    return np.stack((radius * np.cos(phi), radius * np.sin(phi), z))


def _worst_above(dtype: Any) -> Array:
    """Unit vectors on and around the axes, above the surface."""
    worst = worst_directions(dtype)
    return np.ascontiguousarray(worst[:, worst[2] > 1e-6])


ABOVE = Made(_above, corners=_worst_above)


def _normals(alpha: float, draw: Draw) -> Array:
    """Normals (3, n) of microfacets, about as steep as those of that roughness are."""
    if draw.simple:
        return _above(draw)
    slope = alpha * np.sqrt(draw.uniform(0, 3, draw.n))
    return _turned(1 / np.sqrt(1 + slope * slope), draw)


# ---------------------------------------------------------------- the distribution and its masking, in float64


def _tan2(cos: Array) -> Array:
    return np.asarray((1 - cos) * (1 + cos) / np.maximum(cos, 1e-30) ** 2)


def _d(cos: Array, alpha: float) -> Array:
    """By the tangent: (1 / pi) / (alpha^2 cos^4 (1 + tan^2 / alpha^2)^2)."""
    steep = alpha * np.maximum(cos, 1e-30) ** 2 * (1 + _tan2(cos) / alpha**2)
    return np.asarray((cos > 0) / (pi * steep * steep))


def _lambda(cos: Array, alpha: float) -> Array:
    """Hidden over seen: 0 straight above, infinite along the surface."""
    return np.asarray(np.where(cos > 0, (np.sqrt(1 + alpha**2 * _tan2(cos)) - 1) / 2, np.inf))


def _g1(a: Arguments, r: Array) -> tuple[Array, Array, Array]:
    """Masking, and the share that is seen, which is its size, too."""
    seen = 1 / (1 + _lambda(a.cos, a.alpha))
    return r, seen, seen


def _below(draw: Draw) -> Mapping[str, Any]:
    """Cosines below the horizon, and 0 itself."""
    return {"cos": -draw.uniform(0, 1, draw.n) * (np.arange(draw.n) % 4 > 0)}


# ---------------------------------------------------------------- ggx


def _sharp(draw: Draw) -> Mapping[str, Any]:
    """Small roughnesses, and cosines where their microfacets are."""
    alpha = draw.number(0.002, 0.02)
    return {"cos": 1 - draw.uniform(0.1, 2, draw.n) * alpha**2, "alpha": alpha}


def _covered(function: Function, trial: Trial) -> None:
    """The area of all microfacets, seen from above."""
    alpha = float(trial.rng.uniform(0.2, 1))
    step = pi / 2 / 4000
    theta = step * (np.arange(4000) + 0.5)
    found = function.call(trial, Arguments(cos=np.cos(theta), alpha=alpha))
    whole = float((found * np.cos(theta) * np.sin(theta)).sum() * 2 * pi * step)
    if not abs(whole - 1) <= 1e-4:
        raise Failure(
            "the integral of D(wm) cos over the hemisphere to be 1",
            f"{whole:.6g}",
            f"alpha = {alpha:.4g}, 4000 angles",
            "Seen from above the microfacets cover the surface once.",
        )


_dense = partial(
    close, compare=lambda a, r: (r, *2 * (_d(a.cos, a.alpha),)), what="a value of", within=64
)

GGX = function(
    "microfacets.ggx",
    {"cos": COSINES, "alpha": ALPHA},
    (
        close(
            "below",
            "No microfacet looks down",
            lambda _, r: (r, 0.0),
            "The surface is a height field: where the cosine isn't above 0 there is none.",
            what="below the horizon, a value of",
            case=_below,
        ),
        _dense(
            "sharp",
            "Small roughnesses keep their digits",
            hint="1 - cos^2 loses all of them next to cos = 1; (1 - cos)(1 + cos) doesn't.",
            case=_sharp,
            scales=SEVERAL,
        ),
        Law("covered", "The microfacets cover the surface once", _covered, "core"),
        _dense(
            "values",
            "D is its formula",
            hint="alpha^2 over pi and the square of a sum, which has cos^2 in it.",
            scales=SEVERAL,
            whole=True,
        ),
    ),
    contract="cos: N, alpha -> the values: N",
    scales=(),
)

# ---------------------------------------------------------------- smith_g1, smith_g2


SMITH_G1 = function(
    "microfacets.smith_g1",
    {"cos": COSINES, "alpha": ALPHA},
    (
        close(
            "below",
            "From below the surface nothing is seen",
            lambda _, r: (r, 0.0),
            "A direction below the horizon sees no front of a microfacet.",
            what="below the horizon, a share of",
            case=_below,
        ),
        close(
            "straight",
            "From straight above all is seen",
            lambda a, r: (r, np.ones(len(a.cos))),
            what="a share of",
            case=lambda d: {"cos": np.ones(d.n)},
        ),
        close(
            "slanting",
            "Views along the surface see what they should, of smooth surfaces as well",
            _g1,
            "Neither a cosine nor a roughness is too small to count.",
            what="a share of",
            within=64,
            case=lambda d: {"cos": 10 ** d.uniform(-4, -1, d.n), "alpha": d.number(0.001, 1)},
            scales=SEVERAL,
        ),
        close(
            "values",
            "G1 is its formula",
            _g1,
            "Lambda is half of what sqrt(1 + alpha^2 tan^2) is above 1.",
            what="a share of",
            within=64,
            scales=SEVERAL,
            whole=True,
        ),
    ),
    scales=(),
)


def _both(a: Arguments) -> Array:
    return np.asarray(1 / (1 + _lambda(a.cos_o, a.alpha) + _lambda(a.cos_i, a.alpha)))


def _one_below(draw: Draw) -> Mapping[str, Any]:
    """One direction is below the horizon or along it, or both are."""
    o, i = draw.uniform(0, 1, 2, draw.n)
    which, level = np.arange(draw.n) % 3, np.arange(draw.n) % 4 > 0
    return {
        "cos_o": np.where(which == 1, o, -o * level),
        "cos_i": np.where(which == 2, i, -i * level),
    }


def _one_straight(draw: Draw) -> Mapping[str, Any]:
    cos, first = draw.uniform(0.05, 1, draw.n), np.arange(draw.n) % 2 == 0
    return {"cos_o": np.where(first, cos, 1), "cos_i": np.where(first, 1, cos)}


def _slanting(draw: Draw) -> Mapping[str, Any]:
    """Light along the surface, of which a smooth one hides little and a rough one nearly all."""
    cos_i = 10 ** draw.uniform(-4, -1, draw.n)
    return {"cos_o": draw.uniform(0.05, 1, draw.n), "cos_i": cos_i, "alpha": draw.number(0.001, 1)}


_seen = partial(close, compare=lambda a, r: (r, *2 * (_both(a),)), what="a share of", within=64)

SMITH_G2 = function(
    "microfacets.smith_g2",
    {"cos_o": COSINES, "cos_i": COSINES, "alpha": ALPHA},
    (
        close(
            "below",
            "Below the horizon nothing is seen, from one side or both",
            lambda _, r: (r, 0.0),
            "Where either direction is below the surface, no light gets along.",
            what="below the horizon, a share of",
            case=_one_below,
        ),
        _seen(
            "straight",
            "Where one direction is straight above only the other hides anything",
            hint="Lambda is 0 straight above.",
            case=_one_straight,
        ),
        _seen(
            "slanting",
            "Light along the surface is hidden as it should be, by smooth surfaces as well",
            hint="Neither a cosine nor a roughness is too small to count.",
            case=_slanting,
            scales=SEVERAL,
        ),
        _seen(
            "values",
            "G2 is its formula, correlated by height",
            hint="The product of two G1 takes hidden and hidden for independent; low microfacets are hidden from both.",
            scales=SEVERAL,
            whole=True,
        ),
    ),
    scales=(),
)

# ---------------------------------------------------------------- sample_visible_normal


def _cap(a: Arguments, r: Array) -> Array:
    """Height in the cap and turn of the mirrored view: uniform from 0 to 1 for visible normals of length 1."""
    squeezed = np.array([[a.alpha], [a.alpha], [1.0]])
    v, m = squeezed * a.wo, r / squeezed
    v, m = (x / np.maximum(np.sqrt(dot(x, x)), 1e-30) for x in (v, m))
    mirrored = 2 * dot(v, m) * m - v
    height = (mirrored[2] + v[2]) / (1 + v[2]) * np.sqrt(dot(r, r))
    return np.stack((height, np.arctan2(mirrored[1], mirrored[0]) / (2 * pi) % 1))


def _one_view(draw: Draw) -> Mapping[str, Any]:
    return {"wo": np.repeat([[0.48], [0.64], [0.6]], draw.n, axis=1), "alpha": 0.5}


SAMPLE_VISIBLE_NORMAL = function(
    "microfacets.sample_visible_normal",
    {"wo": ABOVE, "alpha": ALPHA},
    (
        unit_length(),
        holds(
            "visible",
            "Microfacets look up, and to the viewer",
            lambda a, r: (r[2] >= -1e-6) & (dot(r, a.wo) >= -2e-5),
            "z >= 0 and dot(wo, wm) >= 0",
            "What looks away from the viewer is not seen.",
            shows=lambda a, r: np.minimum(r[2], dot(r, a.wo)),
            n=5000,
        ),
        uniform(
            "grazing",
            "Seen along the surface, normals are as probable as they look large",
            _cap,
            (12, 12),
            "Only the half that looks to the viewer is seen, the flatter the more.",
            what="height and turn of the squeezed view's mirror image",
            case=lambda d: {"wo": _turned(d.uniform(0.002, 0.05, d.n), d)},
            picture=lambda _, r: r[:2],
        ),
        uniform(
            "above",
            "Seen from above, normals are as probable as they look large",
            _cap,
            (12, 12),
            "The slopes are alpha tan of a hemisphere's normals, and each counts by its cosine.",
            what="height and turn of the squeezed view's mirror image",
            case=lambda d: {"wo": np.repeat([[0.0], [0.0], [1.0]], d.n, axis=1)},
            picture=lambda _, r: r[:2],
        ),
        uniform(
            "sharp",
            "On nearly smooth surfaces normals are as probable as they look large",
            lambda a, r: _cap(a, r)[:1],
            (24,),
            "No roughness is too small to count.",
            what="height of the squeezed view's mirror image",
            case=lambda d: {"alpha": d.number(0.001, 0.02)},
            n=10_000,
            picture=lambda _, r: r[:2],
        ),
        uniform(
            "density",
            "Normals are as probable as they look large",
            _cap,
            (16, 16),
            "Squeezed, the microfacets are a hemisphere, of which the viewer sees a half-disk and a half-ellipse.",
            what="height and turn of the squeezed view's mirror image",
            draws=2,
            whole=True,
            picture=lambda _, r: r[:2],
        ),
        smooth(10.0),
        evenly(lambda a, r: _cap(a, r)[0], 0.5, case=_one_view),
    ),
    free=True,
    features=lambda a, r: np.concatenate((_cap(a, r), dot(r, a.wo)[None])),
    scales=(),
)

# ---------------------------------------------------------------- visible_normal_pdf


def _anywhere(draw: Draw, low: float = 0.1, high: float = 1) -> Mapping[str, Any]:
    alpha = draw.number(low, high)
    return {"wo": _above(draw), "wm": _normals(alpha, draw), "alpha": alpha}


def _flat(draw: Draw) -> Mapping[str, Any]:
    return {**_anywhere(draw), "wo": _turned(10 ** draw.uniform(-6, -1, draw.n), draw)}


def _hidden(draw: Draw) -> Mapping[str, Any]:
    """Normals that look away from the viewer, and others that look to it, but down."""
    wo = _above(draw)
    wm = draw.directions()
    away = dot(wo, wm) > -1e-3
    wm[:, away] = -wo[:, away]
    down = np.stack((wo[0], wo[1], -1e-3 - (1 - wo[2] ** 2) / 2))
    down /= np.linalg.norm(down, axis=0)
    return {"wo": wo, "wm": np.where(np.arange(draw.n) % 2 == 0, wm, down)}


def _visible(a: Arguments, r: Array) -> tuple[Any, ...]:
    """Rounding of the dot product is as large where it is small; and sin^2 is 1 - z^2, or x^2 + y^2, which differ."""
    z, height = a.wo[2], a.wm[2]
    size = _d(height, a.alpha) / (z * (1 + _lambda(z, a.alpha)))
    slack = 1 + 0.1 / (1 - height**2 + a.alpha**2)
    return r, size * np.maximum(dot(a.wo, a.wm), 0), size * slack


def _grid() -> tuple[Array, Array]:
    """Directions (3, n) over the hemisphere, and the solid angle of each [sr]."""
    steps = 160, 320
    theta, phi = (
        (np.arange(n) + 0.5) * end / n for n, end in zip(steps, (pi / 2, 2 * pi), strict=True)
    )
    theta, phi = (x.ravel() for x in np.meshgrid(theta, phi))
    w = np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)))
    return w, np.sin(theta) * pi**2 / (steps[0] * steps[1])


def _view(trial: Trial, z: float, columns: int) -> Array:
    phi = trial.rng.uniform(0, 2 * pi)
    ring = np.sqrt(1 - z * z)
    return np.repeat([[ring * np.cos(phi)], [ring * np.sin(phi)], [z]], columns, axis=1)


def _normalised(function: Function, trial: Trial) -> None:
    wm, solid_angle = _grid()
    alpha, z = trial.rng.uniform(0.3, 1), trial.rng.uniform(0.1, 1)
    a = Arguments(wo=_view(trial, z, wm.shape[1]), wm=wm, alpha=float(alpha))
    whole = float((function.call(trial, a) * solid_angle).sum())
    if not abs(whole - 1) <= 1e-3:
        raise Failure(
            "the density's integral over the hemisphere to be 1",
            f"{whole:.6g}",
            f"alpha = {alpha:.4g}, wo_z = {z:.4g}, {wm.shape[1]} normals",
            "It is one of normals: the 4 dot(wo, wm) belongs to mirrored directions.",
        )


_probable = partial(close, compare=_visible, what="a density of", within=64)

VISIBLE_NORMAL_PDF = function(
    "microfacets.visible_normal_pdf",
    {"wo": ABOVE, "wm": Made(lambda d: d.directions(), corners=worst_directions), "alpha": ALPHA},
    (
        close(
            "hidden",
            "Normals that look away or down are never drawn",
            lambda _, r: (r, 0.0),
            "Where dot(wo, wm) or wm_z isn't above 0 the density is 0.",
            what="a density of",
            case=_hidden,
        ),
        Law("normalised", "The density integrates to 1", _normalised, "core"),
        _probable(
            "grazing",
            "Along the surface the density is right",
            hint="G1 and wo_z both go to 0, and their ratio doesn't.",
            case=_flat,
        ),
        _probable(
            "sharp",
            "On nearly smooth surfaces the density is right, however large",
            hint="No roughness is too small to count, and no density too large.",
            case=lambda d: _anywhere(d, 0.001, 0.02),
            scales=SEVERAL,
        ),
        _probable(
            "values",
            "The density is G1(wo) dot(wo, wm) D(wm) / wo_z",
            hint="As probable as a microfacet looks large: its area, its slant, and whether it is hidden.",
            scales=SEVERAL,
            whole=True,
        ),
    ),
    case=_anywhere,
    scales=(),
)

# ---------------------------------------------------------------- fresnel_complex

N = Made(
    lambda d: d.number(0.05, 6) * d.uniform(0.2, 1, 3),
    (np.array([1.5, -1, 1]), np.array([1.5, nan, 1])),
)
K = Made(
    lambda d: d.number(0.1, 20) * d.uniform(0.2, 1, 3),
    (np.array([1, -1, 1.0]), {"n": np.array([1, 0, 1.0]), "k": np.array([1, 0, 0.0])}),
)


def _reflectance(cos: Array, n: Array, k: Array) -> Array:
    """By the admittances of the two polarisations, whose mismatch with the outside's is what is mirrored."""
    index = (np.asarray(n, float) + 1j * np.asarray(k, float))[:, None]
    cos = np.clip(cos, 1e-15, 1)
    within = np.sqrt(1 - (1 - cos * cos) / index**2)
    shares = [
        np.abs((one - other) / (one + other)) ** 2
        for one, other in ((cos, index * within), (within, index * cos))
    ]
    return np.asarray((shares[0] + shares[1]) / 2)


def _mirrored(a: Arguments, r: Array) -> tuple[Any, ...]:
    """Next to a glass's critical angle the cosine within loses its digits."""
    index = (np.asarray(a.n, float) + 1j * np.asarray(a.k, float))[:, None]
    within = np.sqrt(1 - (1 - np.clip(a.cos, 0, 1) ** 2) / index**2)
    return r, _reflectance(a.cos, a.n, a.k), 1 + 0.1 / np.maximum(np.abs(within), 1e-3)


_share = partial(close, compare=_mirrored, what="a reflectance of", within=64)

FRESNEL_COMPLEX = function(
    "microfacets.fresnel_complex",
    {
        "cos": Made(
            lambda d: d.uniform(0.02, 1, d.n),
            corners=lambda dtype: np.array((*ENDS, 1 + 2.0**-23), dtype),
        ),
        "n": N,
        "k": K,
    },
    (
        _share(
            "beyond",
            "Cosines beyond 0 and 1 count as 0 and 1",
            hint="At cos = 0 all is mirrored.",
            case=lambda d: {"cos": d.rng.choice((-0.5, -1e-7, 0, 1, 1 + 2.0**-22), d.n)},
        ),
        _share(
            "straight",
            "Straight on the reflectance is ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)",
            case=lambda d: {"cos": np.ones(d.n)},
        ),
        _share(
            "perfect",
            "An index of 0 with absorption mirrors all",
            hint="Only where both are 0 there is no index.",
            case=lambda d: {"n": np.where(np.arange(3) == d.rng.integers(3), 0.0, 1.5)},
        ),
        _share(
            "glass",
            "Without absorption it is glass",
            hint="The square root is that of a positive number, and all formulae hold.",
            case=lambda d: {"n": d.uniform(1.2, 3, 3), "k": np.zeros(3)},
            scales=SEVERAL,
        ),
        _share(
            "inside",
            "From the inside of glass reflection is total beyond an angle",
            hint="The square root is that of a negative number there: an imaginary one.",
            case=lambda d: {"n": d.uniform(0.3, 0.9, 3), "k": np.zeros(3)},
            scales=SEVERAL,
        ),
        _share(
            "values",
            "Metals mirror what Fresnel's equations say, in three channels",
            hint="The mean of the squared sizes of two complex amplitudes.",
            scales=SEVERAL,
            whole=True,
        ),
    ),
    scales=(),
)

# ---------------------------------------------------------------- brdf

PERFECT = {"n": np.zeros(3), "k": np.ones(3)}
"""An index of a metal that mirrors all light."""

FURNACE = ((1.0, 1.0, 1 - log(2)), (0.8, 0.7, 0.48192), (0.5, 0.5, 0.69825), (0.3, 0.2, 0.83851))
"""alpha, wo_z, and the share of the light that microfacets mirror once: the mean of G2 / G1 over visible normals."""


def _pairs(draw: Draw) -> Mapping[str, Any]:
    """Directions whose microfacets there are; some of the light comes from below."""
    alpha = draw.number(0.1, 1)
    wo = _above(draw)
    if draw.simple:
        return {"wo": wo, "wi": _above(draw), "alpha": alpha}
    wm = _normals(alpha, draw)
    return {"wo": wo, "wi": 2 * dot(wo, wm) * wm - wo, "alpha": alpha}


def _under(draw: Draw) -> Mapping[str, Any]:
    """One direction is below the surface or along it, or both are."""
    wo, wi = _above(draw), _above(draw)
    which, level = np.arange(draw.n) % 3, np.arange(draw.n) % 4 == 0
    for w, above in ((wo, 1), (wi, 2)):
        along = np.stack((w[2], np.hypot(w[0], w[1]), 0 * w[2]))
        w[:] = np.where(which == above, w, np.where(level, along, w * [[1], [1], [-1]]))
    return {"wo": wo, "wi": wi}


def _along(draw: Draw) -> Mapping[str, Any]:
    """Both directions run nearly along the surface, to about the same side."""
    phi, heights = draw.uniform(0, 2 * pi, draw.n), 10 ** draw.uniform(-4, -1, 2, draw.n)
    turned = (phi, phi + draw.uniform(-1.5, 1.5, draw.n))
    wo, wi = (
        np.stack((np.sqrt(1 - z * z) * np.cos(way), np.sqrt(1 - z * z) * np.sin(way), z))
        for z, way in zip(heights, turned, strict=True)
    )
    return {"wo": wo, "wi": wi}


def _exchanged(draw: Draw) -> Mapping[str, Any]:
    """Each pair of columns has the same two directions, exchanged."""
    wo, wi = _above(draw), _above(draw)
    wo[:, 1::2], wi[:, 1::2] = wi[:, : draw.n // 2 * 2 : 2], wo[:, : draw.n // 2 * 2 : 2]
    return {"wo": wo, "wi": wi}


def _reciprocal(_: Arguments, r: Array) -> tuple[Any, ...]:
    pairs = r.shape[1] // 2
    one, other = r[:, : 2 * pairs : 2], r[:, 1::2]
    return one, other, np.abs(other)


def _halfway(a: Arguments) -> tuple[Array, Array]:
    """The microfacets' normals, and their cosine to the directions."""
    wm = a.wo + a.wi
    wm = wm / np.maximum(np.sqrt(dot(wm, wm)), 1e-30)
    return wm, dot(a.wo, wm)


def _returned(a: Arguments, r: Array) -> tuple[Any, ...]:
    """Rounding of wm tells in D, the more the sharper it is."""
    wm, cos = _halfway(a)
    o, i = a.wo[2], a.wi[2]
    above = (o > 0) & (i > 0)
    seen = above / (
        1 + _lambda(np.where(above, o, 1), a.alpha) + _lambda(np.where(above, i, 1), a.alpha)
    )
    share = _d(wm[2], a.alpha) * seen / np.where(above, 4 * o * i, 1)
    expected = share * _reflectance(cos, a.n, a.k)
    return r, expected, share * (1 + 1 / (1 - wm[2] ** 2 + a.alpha**2))


def _furnace(function: Function, trial: Trial) -> None:
    wi, solid_angle = _grid()
    for alpha, z, expected in FURNACE:
        a = Arguments(wo=_view(trial, z, wi.shape[1]), wi=wi, alpha=alpha, **PERFECT)
        found = float((function.call(trial, a)[0] * wi[2] * solid_angle).sum())
        if not abs(found - expected) <= 1e-3:
            raise Failure(
                f"{expected:.4f} of the light to come back from a perfect metal under an even sky of radiance 1",
                f"{found:.4f}",
                f"alpha = {alpha}, wo_z = {z}, {wi.shape[1]} directions",
                "What hits a second microfacet is lost, and nothing else.",
            )


BRDF = function(
    "microfacets.brdf",
    {"wo": ABOVE, "wi": ABOVE, "alpha": ALPHA, "n": Made(N.make), "k": Made(K.make)},
    (
        close(
            "below",
            "Nothing is mirrored through the surface",
            lambda _, r: (r, 0.0),
            "Where wo or wi is below the surface there is no light.",
            what="a value of",
            case=_under,
        ),
        close(
            "reciprocal",
            "Light that goes the other way is mirrored alike, to 1e-6",
            _reciprocal,
            "Exchange wo and wi: every factor stays what it was.",
            what="with wo and wi exchanged, a value of",
            within=1e-6 / EPSILON,
            case=_exchanged,
            dtypes=(np.float64,),
        ),
        close(
            "along",
            "Along the surface values are as large as they are",
            _returned,
            "4 wo_z wi_z goes to 0, and so does G2: their ratio doesn't.",
            what="at a grazing angle, a value of",
            within=64,
            case=_along,
        ),
        Law("furnace", "Under an even sky as little is lost as should be", _furnace, "core"),
        close(
            "values",
            "The value is F D G2 / (4 wo_z wi_z)",
            _returned,
            "F sees the angle to the microfacet, G2 those to the surface.",
            what="a value of",
            within=64,
            scales=SEVERAL,
            whole=True,
        ),
    ),
    case=_pairs,
    scales=(),
)

FUNCTIONS = (
    *(GGX, SMITH_G1, SMITH_G2, SAMPLE_VISIBLE_NORMAL, VISIBLE_NORMAL_PDF, FRESNEL_COMPLEX, BRDF),
)
