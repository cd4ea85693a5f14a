"""media declared: what gets through fog, how far light flies, where it is scattered, and steps through uneven fog.

Extinctions are taken by the length that the scene has. Where steps end next to a limit, or a number is next to the
density that it is compared with, rounding decides; columns that come nearer than ``HAIR`` are not looked at.
"""

from collections.abc import Mapping
from functools import partial
from math import inf, nan, pi
from typing import Any

import numpy as np
from scipy.ndimage import map_coordinates

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Made, function
from course.school.grading.checks.distributions import means, uniform
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.laws import close, holds, unit_length, within
from course.school.grading.checks.vectors import dot, turn_about

HAIR = 1e-3

SCALES = (1.0, 1e-3, 1e3)

WRONG = (np.array([1.0, -0.5, 1]), np.array([nan, 1, 1]))


def _colors(draw: Draw) -> Array:
    """Three extinctions, none like another [1/length]."""
    if draw.simple:
        return np.array((1.0, 2.0, 0.5)) / draw.scale
    return draw.rng.permutation((0.4, 1.1, 2.3)) * draw.uniform(0.8, 1.2, 3) / draw.scale


def _weights(draw: Draw) -> Array:
    """Probabilities of three channels, none like another."""
    if draw.simple:
        return np.array((0.25, 0.5, 0.25))
    return draw.rng.permutation((0.2, 0.3, 0.5))


COLORS, WEIGHTS = Made(_colors, WRONG), Made(_weights, WRONG)
DISTANCE = Made(lambda d: d.lengths(0, 3, d.n))


def _even(draw: Draw) -> Mapping[str, Any]:
    """The same extinction in all channels."""
    return {"sigma_t": np.full(3, draw.number(0.5, 2))}


# ---------------------------------------------------------------- transmittance


def _left(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, np.exp(-a.sigma_t[:, None] * a.distance)


_lets = partial(close, compare=_left, what="a share of")

TRANSMITTANCE = function(
    "media.transmittance",
    {"sigma_t": COLORS, "distance": DISTANCE},
    (
        close(
            "clear",
            "What takes nothing lets all through, and so does a way of no length",
            lambda _, r: (r, 1.0),
            "Without a medium, or without a way, all light is left.",
            what="a share of",
            case=lambda d: (
                {"sigma_t": np.zeros(3)} if d.rng.random() < 0.5 else {"distance": np.zeros(d.n)}
            ),
        ),
        _lets(
            "grey",
            "What takes all channels alike leaves them alike",
            hint="Each unit of length takes the same share of what is left.",
            case=_even,
        ),
        _lets(
            "long",
            "After a long way nothing is left, and never less",
            hint="A share is never below 0.",
            case=lambda d: {"distance": d.scale * 10.0 ** d.uniform(2, 5, d.n)},
        ),
        _lets(
            "values",
            "Each channel loses light by its own extinction",
            hint="Twice the way takes the same share once more.",
            scales=SCALES,
            whole=True,
        ),
    ),
)

# ---------------------------------------------------------------- free_flight and its density


def _flights(draw: Draw) -> Mapping[str, Any]:
    """Numbers that choose a channel clearly."""
    weights = _weights(draw)
    u = draw.units(2).astype(np.float64)
    bounds = np.cumsum(weights)[:2, None]
    near = (np.abs(u[0] - bounds) < HAIR).any(axis=0)
    u[0] = np.where(near, 0.01, u[0])
    return {"sigma_t": _colors(draw), "weights": weights, "u": u}


def _flown(a: Arguments, r: Array) -> tuple[Any, ...]:
    channel = np.searchsorted(np.cumsum(a.weights)[:2], a.u[0], side="right")
    with np.errstate(divide="ignore"):
        sigma = a.sigma_t[channel]
        way = np.where(sigma > 0, -np.log1p(-a.u[1]) / np.where(sigma > 0, sigma, 1), inf)
    # Near u = 1 rounding of 1 - u is all there is.
    room = np.where(np.isfinite(way), (1 + 1 / (1 - a.u[1])) / np.where(sigma > 0, sigma, 1), 1)
    return r, way, room


_flies = partial(close, compare=_flown, what="a distance of")


def _through_some(draw: Draw) -> Mapping[str, Any]:
    """A medium that takes nothing of one channel."""
    made = dict(_flights(draw))
    made["sigma_t"][draw.rng.integers(3)] = 0
    return made


def _grey_flights(draw: Draw) -> Mapping[str, Any]:
    return {**_flights(draw), **_even(draw)}


def _one_channel(draw: Draw) -> Mapping[str, Any]:
    return {**_flights(draw), "weights": np.eye(3)[draw.rng.integers(3)]}


FREE_FLIGHT = function(
    "media.free_flight",
    {"sigma_t": Made(None, WRONG), "weights": Made(None, WRONG)},
    (
        _flies(
            "clear",
            "A channel of which nothing is stopped flies for ever",
            hint="Without extinction there is no place where light is stopped: the distance is infinite.",
            case=_through_some,
        ),
        _flies(
            "sure",
            "A channel of weight 1 is always chosen, one of weight 0 never",
            hint="u[0] below the first weight chooses red, below the first two green, else blue.",
            case=_one_channel,
        ),
        means(
            "mean",
            "In a grey medium the mean distance is 1 / sigma_t",
            lambda a, r: [("mean distance", r, 1 / a.sigma_t[0], 1 / a.sigma_t[0] ** 2)],
            "Where e-fold is lost on a length, light flies as far on average.",
            comparisons=1,
            case=_grey_flights,
        ),
        _flies(
            "values",
            "By each distance the share u[1] of the chosen channel has been stopped",
            hint="Solve 1 - exp(-sigma_t distance) = u[1], with the sigma_t that u[0] has chosen.",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_flights,
)


def _dense(a: Arguments, r: Array) -> tuple[Any, ...]:
    each = a.weights * a.sigma_t
    return r, each @ np.exp(-a.sigma_t[:, None] * a.distance), each.sum()


_flight_density = partial(close, compare=_dense, what="a density of")


def _along(draw: Draw) -> Mapping[str, Any]:
    """The middles of equal steps, far enough that hardly anything is left."""
    return {"distance": (np.arange(4000) + 0.5) * 0.02 * draw.scale}


FREE_FLIGHT_PDF = function(
    "media.free_flight_pdf",
    {"sigma_t": COLORS, "weights": WEIGHTS, "distance": DISTANCE},
    (
        _flight_density(
            "clear",
            "Where nothing is stopped the density is 0",
            hint="No flight ends where there is no medium.",
            case=lambda _: {"sigma_t": np.zeros(3)},
        ),
        _flight_density(
            "grey",
            "In a grey medium weights don't matter",
            hint="All channels have the same density there.",
            case=_even,
        ),
        close(
            "integral",
            "Over all distances it integrates to 1",
            lambda a, r: (r.sum() * (a.distance[1] - a.distance[0]), 1.0),
            "A density integrates to 1; which factor is missing?",
            what="an integral of",
            floor=2e-3,
            case=_along,
        ),
        _flight_density(
            "values",
            "All channels count, by their weights, whichever was chosen",
            hint="Another channel might have led to the same distance.",
            scales=SCALES,
            whole=True,
        ),
    ),
)

# ---------------------------------------------------------------- henyey_greenstein


def _mean_cosine(draw: Draw) -> float:
    if draw.simple:
        return float(draw.rng.choice((-0.5, 0.5, 0.75)))
    return float(draw.rng.choice((-1, 1)) * draw.rng.uniform(0.2, 0.9))


G = Made(_mean_cosine, (-1.0, 1.0, 1.5, nan))


def _spread(cos: Array, g: float) -> Array:
    return 1 + g * g - 2 * g * cos


def _phase(cos: Array, g: float) -> Array:
    return np.asarray((1 - g * g) / (4 * pi * _spread(cos, g) ** 1.5))


def _scattered(a: Arguments, r: Array) -> tuple[Any, ...]:
    found = _phase(a.cos, a.g)
    # Rounding of 1 + g^2 - 2 g cos counts by what is left of it.
    return r, found, found * (1 + 4 / _spread(a.cos, a.g))


_scatters = partial(close, compare=_scattered, what="a value of")


def _cosines(_draw: Draw) -> Mapping[str, Any]:
    """The middles of equal steps of all cosines."""
    return {"cos": (np.arange(8000) + 0.5) / 4000 - 1}


HENYEY_GREENSTEIN = function(
    "media.henyey_greenstein",
    {"cos": declare.values(-1.0, 1.0), "g": G},
    (
        close(
            "even",
            "For g = 0 it is 1 / (4 pi) in all directions",
            lambda _, r: (r, 1 / (4 * pi)),
            "The whole sphere has 4 pi steradians.",
            what="a value of",
            case=lambda _: {"g": 0.0},
        ),
        holds(
            "forwards",
            "With g above 0 more light goes on forwards than back, with g below 0 less",
            lambda a, r: (r > 1 / (4 * pi)) == (a.g > 0),
            "a value above 1 / (4 pi) straight on if g > 0, and one below it if g < 0",
            "A cosine of 1 is straight on; the sign of the term with the cosine says where the light goes.",
            case=lambda d: {"cos": np.ones(d.n)},
        ),
        close(
            "integral",
            "Over all directions it integrates to 1",
            lambda _, r: (2 * pi * r.mean() * 2, 1.0),
            "Scattering loses no light: that is what the albedo is for.",
            what="an integral of",
            floor=2e-3,
            case=_cosines,
        ),
        _scatters(
            "narrow",
            "Narrow lobes have their height",
            hint="Next to cos = 1 it may be as large as it has to.",
            case=lambda d: {"g": float(d.rng.choice((-0.97, 0.97)))},
        ),
        _scatters(
            "values",
            "Values are those of the formula",
            hint="Write it down term by term: where is the square, and where the power 3/2?",
            whole=True,
        ),
    ),
    scales=(),
)

# ---------------------------------------------------------------- sample_henyey_greenstein


def _cosine(a: Arguments, r: Any) -> Array:
    return np.clip(dot(r[0], a.direction), -1, 1)


def _by_share(a: Arguments, r: Any) -> Array:
    """The share of the light that is turned farther, and the turn: uniform for a right function."""
    cos, g = _cosine(a, r), a.g
    share = (1 + cos) / 2
    if g:
        share = (1 - g * g) / (2 * g) * (1 / np.sqrt(_spread(cos, g)) - 1 / (1 + g))
    return np.stack((np.clip(share, 0, 1), turn_about(a.direction, r[0])))


def _own_density(a: Arguments, r: Any) -> tuple[Any, ...]:
    # A direction is known to the last places of its numbers.
    found = _phase(_cosine(a, r), a.g)
    return r[1], found, found * (1 + 40 / _spread(_cosine(a, r), a.g))


def _up(draw: Draw) -> Mapping[str, Any]:
    return {"direction": np.repeat(np.eye(3)[:, 2:], draw.n, axis=1), "g": 0.5}


SAMPLE_HENYEY_GREENSTEIN = function(
    "media.sample_henyey_greenstein",
    {"direction": declare.directions(), "g": G},
    (
        unit_length(lambda _, r: r[0]),
        means(
            "mean",
            "The mean cosine is g",
            # The second moment of the cosine is (1 + 2 g^2) / 3.
            lambda a, r: [("mean cosine", _cosine(a, r), a.g, (1 + 2 * a.g**2) / 3 - a.g**2)],
            "Above 0 light goes on forwards, along the way that it came.",
            comparisons=1,
        ),
        close(
            "density",
            "The density is that of the direction",
            _own_density,
            "The phase function is normalised, and directions are as dense as it.",
            what="a density of",
        ),
        uniform(
            "even",
            "For g = 0 directions are uniform over the sphere",
            _by_share,
            (16, 16),
            "g = 0 would divide 0 by 0 in the formula for the cosine: what is left of it?",
            what="share and turn",
            case=lambda _: {"g": 0.0},
        ),
        uniform(
            "distribution",
            "Directions are as dense as the phase function",
            _by_share,
            (16, 16),
            "Set the integral of the phase function up to a cosine equal to u, and solve for the cosine.",
            what="share and turn",
            whole=True,
            picture=lambda a, r: np.stack((_cosine(a, r), turn_about(a.direction, r[0]))),
        ),
        smooth(60.0),
        evenly(lambda _, r: r[0][2] + 0.3 * r[0][0] + 0.2 * r[0][1], 0.5, case=_up),
    ),
    free=True,
    features=lambda a, r: np.stack((_cosine(a, r), *r[0])),
    scales=(),
)

# ---------------------------------------------------------------- delta_tracking, ratio_tracking


STEPS = 6


def _uneven(draw: Draw) -> dict[str, Any]:
    """A grid of other sizes along each axis, thin or dense, and rays through it and beside it."""
    shape = tuple(draw.rng.permutation((2, 3, 4)))
    thick = draw.number(0.125, 8)
    return {
        "grid": draw.rng.uniform(0.1, 0.9, shape) * thick,
        "majorant": float(draw.rng.uniform(1, 3) * thick),
        "origin": draw.uniform(-0.5, 1.5, 3, draw.n),
        "direction": draw.directions() * draw.uniform(0.3, 1, draw.n),
        "limit": draw.uniform(0.5, 3, draw.n) / thick,
    }


def _decides(draw: Draw) -> Mapping[str, Any]:
    return {**_uneven(draw), "u": draw.rng.random((2, STEPS, draw.n))}


def _weighs(draw: Draw) -> Mapping[str, Any]:
    return {**_uneven(draw), "u": draw.rng.random((STEPS, draw.n))}


def _densities(a: Arguments, t: Array) -> Array:
    """(N,) at distances; read by SciPy."""
    points = a.origin + t * a.direction
    size = np.array(a.grid.shape)[:, None]
    return np.asarray(
        map_coordinates(a.grid.astype(np.float64), points * size - 0.5, order=1, mode="nearest")
    )


def _ways(a: Arguments, u: Array) -> Array:
    """(K, N) where steps end."""
    return np.asarray(np.cumsum(-np.log1p(-u), axis=0) / a.majorant)


def _expected(a: Arguments) -> tuple[Array, Array, Array]:
    """Distance and collision of each ray, and which rays are decided clearly."""
    ways = _ways(a, a.u[0])
    density = np.stack([_densities(a, t) for t in ways]) / a.majorant
    inside, real = ways < a.limit, a.u[1] < density
    stops = ~inside | real
    first = np.where(stops.any(axis=0), stops.argmax(axis=0), len(ways) - 1)
    at = first, np.arange(len(a.limit))
    collided = stops[at] & inside[at]
    clear = (np.abs(ways - a.limit) > HAIR) & (np.abs(a.u[1] - density) > HAIR)
    return np.minimum(ways[at], a.limit), collided, clear.all(axis=0)


def _tracked(a: Arguments, r: Any) -> tuple[Any, ...]:
    """Distance, and whether it is stopped; nothing of rays that rounding decides."""
    distance, collided, clear = _expected(a)
    found = np.where(clear, np.stack((r[0], r[1])), 0)
    return found, np.where(clear, np.stack((distance, collided)), 0), 3.0


def _made_grid(draw: Draw, value: Any) -> Mapping[str, Any]:
    made = dict(_decides(draw))
    return made | {"grid": np.full((2, 3, 4), value(made["majorant"]))}


_tracks = partial(close, what="distance (row 0) and collision (1):", within=64)

MAJORANT = Made(wrong=(0.0, -1.0, nan, inf))

TRACKED: Mapping[str, Made] = {"grid": Made(batch=False), "majorant": MAJORANT, "u": Made()}

DELTA_TRACKING = function(
    "media.delta_tracking",
    TRACKED,
    (
        _tracks(
            "empty",
            "Through nothing every ray comes to its limit, or as far as its steps go",
            _tracked,
            hint="Where the density is 0, no step ends a flight.",
            case=lambda d: _made_grid(d, lambda _: 0.0),
        ),
        _tracks(
            "dense",
            "Where the density is the majorant, the first step within the limit ends the flight",
            _tracked,
            hint="With the probability density / majorant = 1 it is stopped.",
            case=lambda d: _made_grid(d, lambda most: most),
        ),
        _tracks(
            "one-step",
            "A single step ends where it ends",
            _tracked,
            hint="One step: it is beyond the limit, or stopped, or it just ends.",
            case=lambda d: {**_uneven(d), "u": d.rng.random((2, 1, d.n))},
        ),
        holds(
            "within",
            "No distance is beyond its limit",
            lambda a, r: (r[0] >= 0) & (r[0] <= a.limit * (1 + 1e-6)),
            "a distance from 0 to the limit",
            "A step that goes beyond the limit ends there, and nothing has stopped it.",
            shows=lambda _, r: r[0],
        ),
        _tracks(
            "values",
            "Light is stopped where a step meets the medium",
            _tracked,
            hint="Go on from where the last step ended; look the density up there.",
            whole=True,
        ),
    ),
    case=_decides,
    scales=(),
    speed=4096,
)


def _shared(a: Arguments) -> tuple[Array, Array, Array]:
    ways = _ways(a, a.u)
    density = np.stack([_densities(a, t) for t in ways]) / a.majorant
    share = np.where(ways < a.limit, 1 - density, 1).prod(axis=0)
    clear = (np.abs(ways - a.limit) > HAIR).all(axis=0)
    return share, np.minimum(ways[-1], a.limit), clear


def _weighed(a: Arguments, r: Any) -> tuple[Any, ...]:
    share, distance, clear = _shared(a)
    return np.where(clear, np.stack(r), 0), np.where(clear, np.stack((share, distance)), 0), 3.0


_weighs_in = partial(close, compare=_weighed, what="share (row 0) and distance (1):", within=64)


def _even_grid(draw: Draw) -> Mapping[str, Any]:
    """A medium of one density, rays of one length, and steps enough for all of it."""
    made = {**_uneven(draw), "u": draw.rng.random((40, draw.n))}
    return made | {"grid": np.full((2, 2, 2), 0.6), "majorant": 2.0, "limit": np.full(draw.n, 1.5)}


def _mean_share(a: Arguments, r: Any) -> list[tuple[str, Array, float, float]]:
    """The number of steps within the limit is Poisson's, so that the moments of 0.7^steps are known."""
    steps, kept = a.majorant * a.limit[0], 1 - 0.6 / a.majorant
    mean = float(np.exp(-steps * (1 - kept)))
    return [("mean share", r[0], mean, float(np.exp(-steps * (1 - kept**2))) - mean**2)]


RATIO_TRACKING = function(
    "media.ratio_tracking",
    TRACKED,
    (
        _weighs_in(
            "empty",
            "Through nothing all light comes",
            hint="Where the density is 0, a step takes nothing.",
            case=lambda d: {**_weighs(d), "grid": np.zeros((2, 3, 4))},
        ),
        _weighs_in(
            "one-step",
            "A single step loses density / majorant, or nothing beyond the limit",
            hint="A step that ends beyond the limit loses nothing.",
            case=lambda d: {**_uneven(d), "u": d.rng.random((1, d.n))},
        ),
        within(
            "share",
            "Shares are from 0 to 1",
            lambda _, r: r[0],
            0,
            1,
            "What isn't stopped is 1 - density / majorant of what came.",
            what="a share",
        ),
        means(
            "mean",
            "On average as much light comes through as the medium lets",
            _mean_share,
            "The mean is exp(-density distance), though no step knows it.",
            comparisons=1,
            case=_even_grid,
        ),
        _weighs_in(
            "values",
            "Each step keeps what isn't stopped there",
            hint="The product over all steps within the limit.",
            whole=True,
        ),
    ),
    case=_weighs,
    scales=(),
    speed=4096,
)

# ---------------------------------------------------------------- equiangular


def _beside(draw: Draw) -> dict[str, Any]:
    """Lamps beside rays: before, along and behind them."""
    return {
        "origin": draw.lengths(-1, 1, 3, draw.n),
        "direction": draw.directions(),
        "light": draw.lengths(-2, 2, 3, draw.n),
        "limit": draw.lengths(0.5, 4, draw.n),
    }


def _places(draw: Draw, side: float) -> Mapping[str, Any]:
    """Lamps at that distance from the lines of rays, as a share of the limit."""
    made = _beside(draw)
    across = np.cross(made["direction"], np.roll(made["direction"], 1, axis=0), axis=0)
    across /= np.maximum(np.linalg.norm(across, axis=0), 1e-3)
    along = made["limit"] * draw.uniform(0.2, 0.8, draw.n) * made["direction"]
    made["light"] = made["origin"] + along + across * side * made["limit"]
    return made


def _angles(a: Arguments) -> tuple[Array, Array, Array, Array]:
    """Where the lamp's foot is on each ray, how far it is from there, and the angles of the ray's ends."""
    way = a.light - a.origin
    foot = dot(way, a.direction)
    side = np.linalg.norm(way - foot * a.direction, axis=0)
    side = np.maximum(side, 1e-6 * a.limit)
    return foot, side, np.arctan2(-foot, side), np.arctan2(a.limit - foot, side)


def _near_lamps(a: Arguments, r: Any) -> tuple[Any, ...]:
    """Distances as shares of the limit, and densities as shares of the largest; rounding of the lamp's side counts."""
    foot, side, first, last = _angles(a)
    t = side * np.tan(first + a.u * (last - first))
    density = side / ((last - first) * (side**2 + t**2))
    most = 1 / ((last - first) * side)
    found = np.stack((r[0] / a.limit, r[1] / most))
    room = 1 + np.hypot(foot, a.limit) / side
    return found, np.stack(((foot + t) / a.limit, density / most)), np.stack((room, room))


_finds = partial(close, compare=_near_lamps, what="distance (row 0) or density (1), as a share:")

EQUIANGULAR = function(
    "media.equiangular",
    {},
    (
        holds(
            "within",
            "Distances are from 0 to the limit",
            lambda a, r: (r[0] >= -1e-5 * a.limit) & (r[0] <= a.limit * (1 + 1e-5)),
            "a distance from 0 to the limit",
            "The angles go from the ray's start to its limit.",
            shows=lambda _, r: r[0],
            scales=SCALES,
        ),
        holds(
            "on-the-ray",
            "A lamp on the ray itself has distances and densities that are finite",
            lambda a, r: (r[0] >= 0) & (r[0] <= a.limit * (1 + 1e-5)) & (r[1] > 0),
            "a distance from 0 to the limit, and a density above 0",
            "D counts as at least a millionth of the limit.",
            shows=lambda _, r: r[1],
            case=lambda d: _places(d, 0.0),
        ),
        _finds(
            "far",
            "Seen from a lamp far away all distances are about as dense",
            hint="What is A for a lamp that is ten limits away?",
            within=256,
            case=lambda d: _places(d, 10.0),
        ),
        _finds(
            "values",
            "The lamp sees equal angles equally often",
            hint="Draw the triangle of lamp, foot and place: the tangent of the angle is t / D.",
            within=256,
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_beside,
)

# ---------------------------------------------------------------- in_scattering


def _lit(draw: Draw) -> dict[str, Any]:
    sigma_t = _colors(draw)
    return {
        "sigma_t": sigma_t,
        "sigma_s": sigma_t * draw.rng.permutation((0.3, 0.6, 0.9)),
        "distance": draw.lengths(0.1, 1, draw.n),
        "beyond": draw.lengths(0.1, 1, draw.n),
        "phase": draw.uniform(0.02, 1, draw.n),
        "density": draw.uniform(0.2, 2, draw.n) / draw.scale,
    }


def _arrives(a: Arguments, r: Array) -> tuple[Any, ...]:
    left = np.exp(-a.sigma_t[:, None] * (a.distance + a.beyond))
    found = a.sigma_s[:, None] * left * a.phase / a.density
    return r, found, (a.sigma_s[:, None] * a.phase / a.density)


_adds = partial(close, compare=_arrives, what="a radiance of")

IN_SCATTERING = function(
    "media.in_scattering",
    {"sigma_s": Made(None, WRONG), "sigma_t": Made(None, WRONG)},
    (
        close(
            "black",
            "A medium that scatters nothing adds nothing",
            lambda _, r: (r, 0.0),
            "What is stopped and not scattered is gone.",
            what="a radiance of",
            case=lambda d: {**_lit(d), "sigma_s": np.zeros(3)},
        ),
        _adds(
            "at-the-eye",
            "Next to the eye and next to the lamp only the other way counts",
            hint="Light comes from the lamp to the place, and from there to the eye.",
            case=lambda d: {**_lit(d), str(d.rng.choice(("distance", "beyond"))): np.zeros(d.n)},
        ),
        _adds(
            "values",
            "What is scattered there, of what comes, less what is lost on both ways, over the density",
            hint="Four factors and a division: which of them is missing, or there twice?",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_lit,
)

FUNCTIONS = (
    TRANSMITTANCE,
    FREE_FLIGHT,
    FREE_FLIGHT_PDF,
    HENYEY_GREENSTEIN,
    SAMPLE_HENYEY_GREENSTEIN,
    DELTA_TRACKING,
    RATIO_TRACKING,
    EQUIANGULAR,
    IN_SCATTERING,
)
