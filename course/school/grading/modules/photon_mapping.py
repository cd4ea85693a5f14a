"""photon_mapping declared: photons of lamps, their way, what they say of the light around a point, and their radii.

Where a photon comes nearly along a surface, or survives by a hair, rounding decides whether it counts; columns that
come nearer than ``HAIR`` are not looked at.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from math import inf, nan, pi
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array, Trial
from course.school.grading.checks.declare import Arguments, Case, Function, Law, Made, function
from course.school.grading.checks.distributions import means, uniform
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.laws import close, holds, unit_length
from course.school.grading.checks.vectors import dot, turn_about

HAIR = 1e-3

SCALES = (1.0, 1e-3, 1e3)


def _color(draw: Draw) -> Array:
    """Three numbers, none like another."""
    if draw.simple:
        return np.array((1.0, 0.5, 0.25))
    return draw.rng.permutation((0.3, 0.9, 1.7)) * draw.uniform(0.8, 1.2, 3)


def _axis(draw: Draw) -> Array:
    return draw.directions(1)[:, 0]


COUNT = Made(lambda d: int(d.rng.integers(2, 1000)))


def _strong(name: str, hint: str, expected: Any, **how: Any) -> Law:
    """Each photon has its share of the lamp's power; the first result may be any."""
    return close(
        name,
        how.pop("title", "All photons together have the power of the lamp"),
        lambda a, r: (r[1], np.broadcast_to(expected(a)[:, None], r[1].shape)),
        hint,
        what="a power of",
        **how,
    )


def _photons_of(title: str, *laws: Law) -> Law:
    """All of them hold, of which the last is the core: photons with some of it are of no use."""

    def run(function: Function, trial: Trial) -> None:
        for each in laws:
            each.run(function, trial)

    return replace(laws[-1], name="photons", title=title, run=run)


# ---------------------------------------------------------------- emit_cone


def _cone_power(a: Arguments) -> Array:
    return np.asarray(a.intensity * 2 * pi * (1 - a.cos_edge) / a.count)


def _in_cone(a: Arguments, r: Any) -> Array:
    """The share of the cone that is nearer to its axis, and the turn: uniform for a right function."""
    axis = np.repeat(a.axis[:, None], r[0].shape[1], axis=1)
    share = (1 - dot(r[0], axis)) / (1 - a.cos_edge)
    return np.stack((share, turn_about(axis, r[0])))


def _cosine_to_axis(a: Arguments, r: Any) -> Array:
    return np.asarray((r[0] * a.axis[:, None]).sum(axis=0))


def _upright(_: Draw) -> Mapping[str, Any]:
    return {"axis": np.eye(3)[2], "cos_edge": 0.0}


_EMIT_CONE_POWER = _strong(
    "power",
    "Intensity is power per solid angle: that of the cone is 2 pi (1 - cos_edge). How many photons share it?",
    _cone_power,
)
_EMIT_CONE_PLACES = uniform(
    "uniform",
    "Directions are uniform over the solid angle of the cone",
    _in_cone,
    (16, 16),
    "Cosines from the edge to 1 are uniform, and so are turns about the axis.",
    what="share of the cone and turn",
    whole=True,
    picture=lambda a, r: np.stack((_cosine_to_axis(a, r), _in_cone(a, r)[1])),
)

EMIT_CONE = function(
    "photon_mapping.emit_cone",
    {
        "axis": Made(_axis),
        "cos_edge": Made(lambda d: float(d.uniform(-0.9, 0.7))),
        "intensity": Made(_color),
        "count": COUNT,
    },
    (
        unit_length(lambda _, r: r[0]),
        _strong(
            "one",
            "What is the power of the lamp if a single photon carries all of it?",
            _cone_power,
            title="A single photon has all of the power",
            case=lambda _: {"count": 1},
        ),
        _strong(
            "everywhere",
            "All directions are 4 pi sr.",
            _cone_power,
            title="A lamp that shines everywhere has 4 pi times its intensity",
            case=lambda _: {"cos_edge": -1.0},
        ),
        _EMIT_CONE_POWER,
        replace(_EMIT_CONE_PLACES, role="corner", points=1.0, beside=None),
        _photons_of(
            "Directions are uniform over the cone, and each photon has its share of the power",
            _EMIT_CONE_POWER,
            _EMIT_CONE_PLACES,
        ),
        smooth(30.0),
        evenly(
            lambda _, r: r[0][2] + 0.3 * r[0][0] + 0.2 * r[0][1],
            0.5,
            case=_upright,
        ),
    ),
    free=True,
    features=lambda a, r: np.stack((_cosine_to_axis(a, r), *r[0], *r[1])),
    scales=(),
)

# ---------------------------------------------------------------- emit_area


def _area_power(a: Arguments) -> Array:
    return np.asarray(a.radiance * pi * a.area / a.count)


def _by_cosine(a: Arguments, r: Any) -> Array:
    """Squared cosine and turn: uniform where the density is cos / pi."""
    cos = np.clip(dot(r[0], a.normal), 0, 1)
    return np.stack((cos**2, turn_about(a.normal, r[0])))


def _floor(draw: Draw) -> Mapping[str, Any]:
    return {"normal": np.repeat(np.eye(3)[:, 2:], draw.n, axis=1)}


_EMIT_AREA_POWER = _strong(
    "power",
    "Radiance times cosine, over the hemisphere, is pi times the radiance: so much leaves each unit of area.",
    _area_power,
)
_EMIT_AREA_PLACES = uniform(
    "density",
    "Directions have the density cos / pi about the normal",
    _by_cosine,
    (16, 16),
    "With the density cos / pi the squared cosine is uniform from 0 to 1, and so is the turn.",
    what="squared cosine and turn",
    whole=True,
)

EMIT_AREA = function(
    "photon_mapping.emit_area",
    {
        "normal": declare.directions(),
        "radiance": Made(_color),
        "area": declare.number(0.2, 5.0, (0.0, -1.0, nan, inf)),
        "count": COUNT,
    },
    (
        unit_length(lambda _, r: r[0]),
        holds(
            "outwards",
            "Photons leave on the side of the normal",
            lambda a, r: dot(r[0], a.normal) >= -1e-5,
            "a direction on the side of the normal",
            "The hemisphere is the one about each photon's own normal.",
            shows=lambda a, r: dot(r[0], a.normal),
        ),
        _strong(
            "one",
            "A single photon carries the power of the whole lamp.",
            _area_power,
            title="A single photon has all of the power",
            case=lambda _: {"count": 1},
        ),
        _EMIT_AREA_POWER,
        means(
            "mean",
            "The mean cosine to the normal is 2 / 3",
            lambda a, r: [("mean cosine", dot(r[0], a.normal), 2 / 3, 1 / 18)],
            "A bright surface sends more light along its normal than to the side.",
            comparisons=1,
        ),
        replace(_EMIT_AREA_PLACES, role="corner", points=1.0, beside=None),
        _photons_of(
            "Directions are as dense as the cosine, and each photon has its share of the power",
            _EMIT_AREA_POWER,
            _EMIT_AREA_PLACES,
        ),
        smooth(30.0),
        evenly(lambda _, r: r[0][2] + 0.3 * r[0][0] + 0.2 * r[0][1], 2 / 3, case=_floor),
    ),
    free=True,
    features=lambda a, r: np.stack((dot(r[0], a.normal), *r[0], *r[1])),
    scales=(),
)

# ---------------------------------------------------------------- emit_directional


def _disk_power(a: Arguments) -> Array:
    return np.asarray(a.irradiance * pi * a.radius**2 / a.count)


def _on_disk(a: Arguments, r: Any) -> tuple[Array, Array]:
    """How far origins lie along the light's way from the centre, and how they lie beside it (3, N)."""
    aside = r[0] - a.center[:, None]
    along = a.direction @ aside
    return along, aside - along * a.direction[:, None]


def _by_area(a: Arguments, r: Any) -> Array:
    aside = _on_disk(a, r)[1]
    far = np.linalg.norm(aside, axis=0)
    axis = np.repeat(a.direction[:, None], len(far), axis=1)
    return np.stack(((far / a.radius) ** 2, turn_about(axis, aside / np.maximum(far, 1e-12))))


def _no_ball(_: Draw) -> Mapping[str, Any]:
    return {"radius": 0.0}


def _above(_: Draw) -> Mapping[str, Any]:
    return {
        "direction": np.array([0.0, 0.0, -1.0]),
        "center": np.zeros(3),
        "radius": 1.0,
        "irradiance": np.ones(3),
    }


_EMIT_DIRECTIONAL_PLANE = close(
    "before",
    "Origins lie on a plane before the ball, at right angles to the light",
    lambda a, r: (
        _on_disk(a, r)[0] / a.radius,
        -1.0,
        1 + np.abs(a.center).max() / a.radius,
    ),
    "From the centre go back against the light's way, as far as the ball reaches.",
    what="a place, in radii along the light's way,",
    scales=SCALES,
)
_EMIT_DIRECTIONAL_POWER = _strong(
    "power",
    "Irradiance is power per area: that of the disk is pi radius^2. How many photons share it?",
    _disk_power,
    scales=SCALES,
)
_EMIT_DIRECTIONAL_PLACES = uniform(
    "uniform",
    "Origins are uniform on the disk",
    _by_area,
    (16, 16),
    "A circle twice as wide has four times the area.",
    what="share of the area and turn",
    whole=True,
)

EMIT_DIRECTIONAL = function(
    "photon_mapping.emit_directional",
    {
        "direction": Made(_axis),
        "irradiance": Made(_color),
        "radius": declare.length(0.5, 4.0, (-1.0, nan, inf)),
        "count": COUNT,
    },
    (
        close(
            "point",
            "Without a radius all photons leave from the centre, and have no power",
            lambda a, r: (
                np.vstack((r[0] - a.center[:, None], r[1])),
                0.0,
                float(np.abs(a.center).max()),
            ),
            "Nothing is divided by the radius.",
            what="an origin less the centre (rows 0 to 2) or a power (3 to 5) of",
            case=_no_ball,
        ),
        _EMIT_DIRECTIONAL_PLANE,
        _strong(
            "one",
            "A single photon carries all light that falls into the disk.",
            _disk_power,
            title="A single photon has all of the power",
            case=lambda _: {"count": 1},
        ),
        _EMIT_DIRECTIONAL_POWER,
        replace(_EMIT_DIRECTIONAL_PLACES, role="corner", points=1.0, beside=None),
        _photons_of(
            "Origins are uniform on the disk, and each photon has its share of the power",
            _EMIT_DIRECTIONAL_POWER,
            _EMIT_DIRECTIONAL_PLANE,
            _EMIT_DIRECTIONAL_PLACES,
        ),
        smooth(30.0, case=_above),
        evenly(lambda _, r: r[0][0] ** 2 + 0.3 * r[0][0] + 0.2 * r[0][1], 0.25, case=_above),
    ),
    free=True,
    features=lambda a, r: np.stack((*_by_area(a, r), *r[0], *r[1])),
    scales=(),
)

# ---------------------------------------------------------------- roulette


def _photons(draw: Draw) -> dict[str, Any]:
    """Powers and albedos, and numbers that decide clearly."""
    made = {
        "power": draw.uniform(0.1, 2, 3, draw.n),
        "albedo": draw.uniform(0.1, 0.95, 3, draw.n),
        "u": draw.units(1)[0].astype(np.float64),
    }
    q = _survival(made["power"], made["albedo"])
    made["u"] = np.where(np.abs(made["u"] - q) < HAIR, q / 2, made["u"])
    return made


def _survival(power: Array, albedo: Array) -> Array:
    came = np.max(power, axis=0)
    return np.asarray((power * albedo).max(axis=0) / np.where(came > 0, came, 1))


def _sent_on(a: Arguments, r: Any) -> tuple[Any, ...]:
    q = _survival(a.power, a.albedo)
    survives = a.u < q
    left = a.power * a.albedo / np.where(survives, q, inf)
    return np.vstack((r[0], r[1])), np.vstack((survives, left)), np.maximum(a.power.max(axis=0), 1)


_sends = partial(close, compare=_sent_on, what="survival (row 0) or power (1 to 3):")


def _but(case: Case, **changed: Any) -> Case:
    """A case with other arrays, each made by the draw."""

    def made(draw: Draw) -> Mapping[str, Any]:
        return {**case(draw), **{name: make(draw) for name, make in changed.items()}}

    return made


def _alike(draw: Draw) -> Mapping[str, Any]:
    """A grey photon of one power, and one colour of surface."""
    one = np.ones(draw.n)
    return {
        "power": 0.8 * np.ones((3, draw.n)),
        "albedo": np.stack((0.2 * one, 0.5 * one, 0.35 * one)),
    }


ROULETTE = function(
    "photon_mapping.roulette",
    {},
    (
        _sends(
            "white",
            "A white surface sends all photons on as they came",
            hint="Where nothing is lost, nothing ends.",
            case=_but(_photons, albedo=lambda d: np.ones((3, d.n))),
        ),
        _sends(
            "black",
            "A black surface ends all photons",
            hint="Nothing is divided by a probability of 0.",
            case=_but(_photons, albedo=lambda d: np.zeros((3, d.n))),
        ),
        _sends(
            "dark",
            "A photon without power ends",
            hint="Nothing is divided by a power of 0.",
            case=_but(_photons, power=lambda d: np.zeros((3, d.n))),
        ),
        _sends(
            "dim",
            "Whether a photon survives doesn't depend on how strong it is",
            hint="Powers are in watts over many photons: all of them are small. Compare what is left with what was.",
            case=_but(_photons, power=lambda d: 1e-6 * d.uniform(0.1, 2, 3, d.n)),
        ),
        holds(
            "strong",
            "A photon that survives is as strong as it was, in its largest channel",
            lambda a, r: (
                np.abs(r[1].max(axis=0) - r[0] * a.power.max(axis=0)) <= 1e-5 * a.power.max(axis=0)
            ),
            "the largest channel as it was, or 0",
            "What survives stands for what doesn't: it is divided by q.",
            shows=lambda _, r: r[1].max(axis=0),
        ),
        means(
            "mean",
            "On average albedo times power goes on",
            lambda _, r: [
                (
                    f"mean power of channel {c}",
                    r[1][c],
                    0.8 * albedo,
                    0.64 * albedo**2 * (1 / 0.5 - 1),
                )
                for c, albedo in enumerate((0.2, 0.5, 0.35))
            ],
            "What survives makes up for what ends.",
            comparisons=3,
            case=_alike,
        ),
        _sends(
            "values",
            "Photons survive with the probability q, and then have albedo power / q",
            hint="q compares largest channels, before the surface and after it.",
            whole=True,
        ),
    ),
    case=_photons,
    scales=(),
)

# ---------------------------------------------------------------- stored


def _hits(draw: Draw) -> Array:
    """How often a photon has met something: not at all, a few times, or caught between mirrors."""
    often = (10.0 ** draw.rng.uniform(0, 2.3, draw.n)).astype(np.int64)
    return np.where(draw.rng.random(draw.n) < 0.4, 0, often)


def _ways(draw: Draw) -> dict[str, Any]:
    return {
        "matte": draw.rng.random(draw.n) < 0.6,
        "specular": _hits(draw),
        "diffuse": _hits(draw),
    }


def _kept(a: Arguments, r: Any) -> tuple[Any, ...]:
    caustic = a.matte & (a.specular > 0) & (a.diffuse == 0)
    return np.vstack(r), np.vstack((caustic, a.matte & (a.specular + a.diffuse > 0)))


_keeps = partial(close, compare=_kept, what="caustic (row 0) or indirect (1):")


STORED = function(
    "photon_mapping.stored",
    {"matte": Made(), "specular": Made(), "diffuse": Made()},
    (
        _keeps(
            "mirrors",
            "Mirrors and glass keep nothing",
            hint="What a mirror shows is found from the eye.",
            case=_but(_ways, matte=lambda d: np.zeros(d.n, np.bool_)),
        ),
        _keeps(
            "direct",
            "Light that comes straight from a lamp is in no map",
            hint="Shadow rays bring it already.",
            case=_but(
                _ways,
                specular=lambda d: np.zeros(d.n, np.int64),
                diffuse=lambda d: np.zeros(d.n, np.int64),
            ),
        ),
        _keeps(
            "values",
            "Caustics are of mirrors and glass alone, and indirect light is of any surface",
            hint="Write the ways as words: a lamp, then S for mirror and glass, D for matte. Which words end here?",
            whole=True,
        ),
    ),
    case=_ways,
    scales=(),
)

# ---------------------------------------------------------------- density_estimate

NEAR = 5
"""Photons for each point."""


def _near(draw: Draw) -> dict[str, Any]:
    """Photons around points, in any order."""
    return {
        "power": draw.uniform(0.1, 2, 3, NEAR, draw.n),
        "direction": draw.directions(NEAR * draw.n).reshape(3, NEAR, draw.n),
        "distance": draw.lengths(0.1, 1, NEAR, draw.n),
        "normal": draw.directions(),
    }


def _arrives(a: Arguments) -> Array:
    """The cosine of each photon's way with the normal (K, N): below 0 it comes from before."""
    return np.asarray((a.direction * a.normal[:, None]).sum(axis=0))


def _estimated(a: Arguments, r: Array) -> tuple[Any, ...]:
    """As shares of what all photons would bring; nothing of points that rounding decides."""
    area = pi * a.distance.max(axis=0) ** 2
    cos, most = _arrives(a), a.power.sum(axis=1) / area
    clear = np.abs(cos).min(axis=0) > HAIR
    expected = (a.power * (cos < 0)).sum(axis=1) / area
    return np.where(clear, r / most, 0), np.where(clear, expected / most, 0), 1.0


_estimates = partial(close, compare=_estimated, what="as a share of all, an irradiance of")


def _from_above(draw: Draw) -> dict[str, Any]:
    """A board, and photons that come from above at slants; none counts less for it."""
    made = _near(draw)
    down = made["direction"]
    down[2] = -np.maximum(np.abs(down[2]), 0.1)
    made["direction"] = down / np.linalg.norm(down, axis=0)
    made["normal"] = np.repeat(np.eye(3)[:, 2:], draw.n, axis=1)
    return made


def _from_below(draw: Draw) -> dict[str, Any]:
    made = _from_above(draw)
    return made | {"normal": -made["normal"]}


def _single(draw: Draw) -> dict[str, Any]:
    made = _near(draw)
    for name in ("power", "direction"):
        made[name] = made[name][:, :1]
    return made | {"distance": made["distance"][:1]}


DENSITY_ESTIMATE = function(
    "photon_mapping.density_estimate",
    {},
    (
        _estimates(
            "nearest",
            "The nearest photon alone says what arrives",
            hint="The disk reaches as far as the photon.",
            case=_single,
        ),
        _estimates(
            "behind",
            "Photons from behind the surface count nothing",
            hint="A photon that flies along the normal comes from behind.",
            case=_from_below,
        ),
        _estimates(
            "slanted",
            "Photons that come at a slant count in full",
            hint="A slanted beam is spread over more area already: there are fewer photons.",
            case=_from_above,
        ),
        _estimates(
            "values",
            "What arrives is the power of the nearest photons, over the area of their disk",
            hint="The radius is the distance of the farthest. Surfaces are flat: is it a disk or a ball?",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_near,
    scales=(),
)

# ---------------------------------------------------------------- cone_weights


def _disks(draw: Draw) -> dict[str, Any]:
    """Photons within their disks and beyond them, and none at the edge."""
    radius = draw.lengths(0.2, 1, draw.n)
    share = draw.uniform(0, 1.4, draw.n)
    share = np.where(np.abs(share - 1) < HAIR, 0.5, share)
    return {"distance": share * radius, "radius": radius}


def _cone(a: Arguments) -> Array:
    height = 1 - a.distance / (a.k * a.radius)
    whole = pi * a.radius**2 * (1 - 2 / (3 * a.k))
    return np.where(a.distance <= a.radius, height / whole, 0)


def _weighed(a: Arguments, r: Array) -> tuple[Any, ...]:
    """In units of one over the disk's area."""
    area = pi * a.radius**2
    return r * area, _cone(a) * area, 3.0


_weighs = partial(close, compare=_weighed, what="times the disk's area, a weight of")


def _over_disk(draw: Draw) -> Mapping[str, Any]:
    """Places uniform over the area of one disk."""
    radius = np.full(draw.n, 0.7)
    return {"distance": 0.7 * np.sqrt(draw.rng.random(draw.n)), "radius": radius, "k": 1.2}


def _spread(k: float) -> float:
    """Variance of the weights times the area, over the area: the mean of their squares less 1."""
    squared = 1 - 4 / (3 * k) + 1 / (2 * k * k)
    return squared / (1 - 2 / (3 * k)) ** 2 - 1


CONE_WEIGHTS = function(
    "photon_mapping.cone_weights",
    {"k": declare.number(1.0, 4.0, (0.0, 0.5, nan))},
    (
        _weighs(
            "beyond",
            "Photons beyond the radius count nothing",
            hint="A weight is never below 0, and the disk ends at the radius.",
            case=_but(_disks, distance=lambda d: d.scale * d.uniform(1.1, 9, d.n)),
        ),
        _weighs(
            "sharp",
            "With k = 1 the cone falls to 0 at the radius",
            hint="Its height at the middle is three times that of the disk.",
            case=_but(_disks, k=lambda _: 1.0),
        ),
        _weighs(
            "flat",
            "With a large k it is the disk: one over its area",
            hint="What is 1 - 2 / (3 k) for a large k?",
            case=_but(_disks, k=lambda _: 1e6),
        ),
        means(
            "normalised",
            "Over the area of the disk the weights integrate to 1",
            lambda _, r: [("mean weight, times the area", r * pi * 0.49, 1.0, _spread(1.2))],
            "A cone has less volume than a cylinder as high: divide by its share.",
            comparisons=1,
            case=_over_disk,
        ),
        _weighs(
            "values",
            "The weight is that of the cone at the photon's distance, over the cone's volume",
            hint="Integrate 1 - d / (k r) over the disk: 2 pi d for each ring.",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_disks,
    scales=(),
)

# ---------------------------------------------------------------- final_gather

RAYS = 4


def _gathered(draw: Draw) -> dict[str, Any]:
    return {
        "albedo": draw.uniform(0.1, 0.9, 3, draw.n),
        "seen": draw.uniform(0.1, 0.9, 3, RAYS, draw.n),
        "irradiance": 10.0 ** draw.uniform(-2, 1, 3, RAYS, draw.n),
    }


def _reflected(a: Arguments, r: Array) -> tuple[Any, ...]:
    found = a.albedo * (a.seen * a.irradiance).mean(axis=1) / pi
    return r, found, found


_reflects = partial(close, compare=_reflected, what="a radiance of")

FINAL_GATHER = function(
    "photon_mapping.final_gather",
    {},
    (
        close(
            "furnace",
            "A white surface among white ones is as bright as these",
            lambda _, r: (r, 1.0),
            "Where E / pi is 1 everywhere, the mean of cosine-distributed rays is 1, and a white surface returns it.",
            what="a radiance of",
            case=lambda d: {
                "albedo": np.ones((3, d.n)),
                "seen": np.ones((3, RAYS, d.n)),
                "irradiance": np.full((3, RAYS, d.n), pi),
            },
        ),
        _reflects(
            "one",
            "A single ray says all",
            hint="The mean of one is itself.",
            case=lambda d: {
                name: value[:, :1] if value.ndim == 3 else value
                for name, value in _gathered(d).items()
            },
        ),
        close(
            "nothing",
            "Rays that meet nothing bring nothing, and are counted",
            _reflected,
            "The mean is over all rays.",
            what="a radiance of",
            case=_but(
                _gathered,
                irradiance=lambda d: (
                    d.uniform(0.1, 2, 3, RAYS, d.n) * (np.arange(RAYS) < 2)[:, None]
                ),
            ),
        ),
        _reflects(
            "values",
            "The mean over the rays of what the surfaces send back, times the albedo",
            hint="A matte surface sends albedo times irradiance over pi into each direction. The density cos / pi"
            " of the rays cancels cosine and pi of the surface that gathers.",
            whole=True,
        ),
    ),
    case=_gathered,
    scales=(),
)

# ---------------------------------------------------------------- shrunk_radius


def _passes(draw: Draw) -> dict[str, Any]:
    return {"radius": draw.lengths(0.1, 1, draw.n), "i": draw.rng.geometric(0.2, draw.n)}


def _shrunk(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r / a.radius, np.sqrt((a.i + a.alpha) / (a.i + 1)), 1.0


_shrinks = partial(close, compare=_shrunk, what="over the radius, one of")

SHRUNK_RADIUS = function(
    "photon_mapping.shrunk_radius",
    {"alpha": declare.number(0.1, 0.95, (0.0, -1.0, 1.5, nan))},
    (
        _shrinks(
            "constant",
            "With alpha = 1 no radius shrinks",
            hint="(i + 1) / (i + 1) is 1.",
            case=_but(_passes, alpha=lambda _: 1.0),
        ),
        _shrinks(
            "first",
            "After the first pass the area is (1 + alpha) / 2 of what it was",
            hint="The first pass is number 1.",
            case=_but(_passes, i=lambda d: np.ones(d.n, np.int64)),
        ),
        _shrinks(
            "late",
            "Later passes hardly shrink it",
            hint="The ratio comes near to 1.",
            case=_but(_passes, i=lambda d: d.rng.integers(10_000, 100_000, d.n)),
        ),
        _shrinks(
            "values",
            "The squares of the radii have the ratio (i + alpha) / (i + 1)",
            hint="It is areas that shrink so: is there a root?",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_passes,
    scales=(),
)

FUNCTIONS = (
    EMIT_CONE,
    EMIT_AREA,
    EMIT_DIRECTIONAL,
    ROULETTE,
    STORED,
    DENSITY_ESTIMATE,
    CONE_WEIGHTS,
    FINAL_GATHER,
    SHRUNK_RADIUS,
)
