"""film declared: exposure, luminance, photographic tone mapping, the sRGB curve, gamuts, and dithered codes."""

from collections.abc import Iterator, Mapping
from math import inf, nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Case, Made, function, number
from course.school.grading.checks.distributions import means
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import EPSILON, close, holds, within

SCALES = (1.0, 1e-3, 1e3)
"""Factors of all radiances."""

FAINT = (1e-15,)
"""Factor of radiances that are hardly any, and not 0."""

WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
"""Of red, green and blue in the luminance, of Rec. 709."""

LIGHT = Made(lambda d: d.lengths(0, 4, 3, d.n))

# ---------------------------------------------------------------- expose


def _exposed(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, a.radiance * np.exp2(a.stops)


EXPOSE = function(
    "film.expose",
    {"radiance": LIGHT, "stops": Made(lambda d: float(d.uniform(-6, 6)), (nan, inf, -inf))},
    (
        close(
            "none",
            "No stop changes nothing",
            lambda a, r: (r, a.radiance),
            "A factor of 1.",
            what="with 0 stops, a radiance of",
            case=lambda _: {"stops": 0.0},
        ),
        close(
            "bright",
            "Radiance over 1 is not cut off",
            _exposed,
            "What a screen can't show is left to tone mapping, or to the curve.",
            what="with more light, a radiance of",
            case=lambda d: {"stops": float(d.uniform(4, 8))},
        ),
        close(
            "negative",
            "Channels below 0 are exposed like others",
            _exposed,
            "A colour outside of the gamut has such channels; what can't be shown is cut off when it is encoded.",
            what="of a channel below 0, a radiance of",
            case=lambda d: {"radiance": d.lengths(-2, 4, 3, d.n)},
        ),
        close(
            "far",
            "Any number of stops is exact",
            _exposed,
            "No number of stops is too many: the light is what is left of it.",
            what="a radiance of",
            within=64,
            case=lambda d: {"stops": float(d.rng.choice((-1, 1)) * d.uniform(8, 30))},
            scales=(1.0,) * 3,
        ),
        close(
            "values",
            "Each stop doubles the light, each negative one halves it",
            _exposed,
            "A power of 2.",
            what="a radiance of",
            scales=SCALES,
            whole=True,
        ),
    ),
)

# ---------------------------------------------------------------- luminance


def _weighted(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, WEIGHTS @ a.rgb


def _primaries(draw: Draw) -> Mapping[str, Any]:
    return {"rgb": np.eye(3)[:, draw.rng.integers(0, 3, draw.n)]}


LUMINANCE = function(
    "film.luminance",
    {"rgb": LIGHT},
    (
        close(
            "grey",
            "Grey of 1 has the luminance 1",
            _weighted,
            "The weights sum to 1.",
            what="of a grey, a luminance of",
            case=lambda d: {"rgb": np.ones((3, d.n)) * d.uniform(0, 2, d.n)},
        ),
        close(
            "primaries",
            "Green looks brightest, then red, then blue",
            _weighted,
            "Each primary alone has its weight as its luminance.",
            what="of a primary, a luminance of",
            case=_primaries,
        ),
        close(
            "negative",
            "Channels below 0 count as they are",
            _weighted,
            "A colour outside of the gamut has such channels: what is cut off makes it brighter.",
            what="of a colour outside of the gamut, a luminance of",
            case=lambda d: {"rgb": d.lengths(-2, 4, 3, d.n)},
        ),
        close(
            "values",
            "Channels are weighted",
            _weighted,
            "The docstring has the weights; channels are linear, as they came.",
            what="a luminance of",
            scales=SCALES,
            whole=True,
        ),
    ),
    contract="rgb: 3 N -> the luminances: N",
)

# ---------------------------------------------------------------- photographic


def _picture(draw: Draw, dark: float = 0.0) -> Array:
    """A picture of a high dynamic range; ``dark`` is the part of its pixels that are black."""
    if draw.simple:
        found = draw.lengths(0.5, 4, 3, draw.n)
    else:
        found = draw.scale * np.exp(draw.rng.normal(0, 1.5, (3, draw.n)))
    return np.where(draw.rng.random(draw.n) < dark, 0, found)


def _shot(**given: Any) -> Case:
    """A picture, with some of the numbers given."""

    def case(draw: Draw) -> Mapping[str, Any]:
        return {"radiance": _picture(draw)} | given

    return case


def _with_black(draw: Draw) -> Mapping[str, Any]:
    return {"radiance": _picture(draw, 0.3)}


def _mapped(a: Arguments, r: Array) -> tuple[Any, ...]:
    """The task's formulae; the percentile by sorting."""
    y = WEIGHTS @ a.radiance
    lit = y > 0
    if not lit.any():
        return r, np.zeros_like(r)
    tone = a.key * y / np.exp(np.log(y[lit]).sum() / lit.sum())
    place = (1 - a.burn / 100) * (y.size - 1)
    white = float(np.interp(place, np.arange(y.size), np.sort(tone)))
    if white == 0:
        return r, np.zeros_like(r)
    shown = (tone + (tone / white) ** 2) / (1 + tone)
    ratios = a.radiance / np.where(lit, y, 1)
    expected = np.where(lit, shown * ratios**a.saturation, 0)
    # Values far beyond white are as exact as they are large.
    return r, expected, 1 + np.abs(expected)


def _tones(_: Arguments, r: Array) -> Array:
    return np.asarray(WEIGHTS @ r)


def _brightest(a: Arguments, r: Array) -> Array:
    """The luminance that became of the brightest pixel's."""
    return _tones(a, r)[[np.argmax(WEIGHTS @ a.radiance)]]


def _in_order(a: Arguments, r: Array) -> Array:
    """Whether no pixel is darker than one that was darker before, by more than rounding."""
    order = np.argsort(WEIGHTS @ a.radiance)
    sorted_tones = _tones(a, r)[order]
    found = np.ones(order.size, bool)
    found[order[1:]] = np.diff(sorted_tones) >= -1e-5 * (1 + sorted_tones[1:])
    return found


PHOTOGRAPHIC = function(
    "film.photographic",
    {
        "key": number(0.05, 1, (0.0, -0.18, nan, inf)),
        "burn": Made(lambda d: float(d.uniform(0, 20)), (-1.0, 100.5, nan)),
        "saturation": Made(lambda d: float(d.uniform(0.3, 1.5)), (-0.5, nan, inf)),
    },
    (
        holds(
            "black",
            "Black stays black, and a black picture is one",
            lambda _, r: (r == 0).all(axis=0),
            "a pixel of 0 0 0",
            "The logarithm of 0 is no number, and 0 / 0 neither: pixels without light are left out.",
            case=lambda d: {"radiance": np.zeros((3, d.n))},
        ),
        close(
            "some_black",
            "Black pixels count in the percentile, but not in the logarithmic mean",
            _mapped,
            "The mean is over pixels with Y > 0, the percentile over all.",
            what="in a picture with black pixels, a channel of",
            within=64,
            case=_with_black,
        ),
        holds(
            "mostly_black",
            "A picture whose white is 0 is black",
            lambda _, r: (r == 0).all(axis=0),
            "a pixel of 0 0 0",
            "Where nearly all pixels are black, so may be white: a division by it gives no number.",
            case=lambda d: {"radiance": _picture(d) * (np.arange(d.n) == 0), "burn": 50.0},
            n=100,
        ),
        close(
            "white",
            "Without burning, the brightest pixel is just white",
            lambda a, r: (_brightest(a, r), 1.0),
            "D = 1 where L = white, whatever the key.",
            what="the brightest pixel's luminance of",
            within=64,
            case=_shot(burn=0.0, saturation=1.0),
            scales=SCALES,
        ),
        close(
            "grey",
            "Without saturation the picture is grey",
            _mapped,
            "The power 0 of each ratio is 1.",
            what="with a saturation of 0, a channel of",
            within=64,
            case=_shot(saturation=0.0),
        ),
        holds(
            "monotone",
            "What was brighter stays brighter",
            _in_order,
            "a luminance of no less than that of a darker pixel",
            "Beyond white the curve goes on; what is over 1 is cut off later.",
            shows=_tones,
            case=_shot(saturation=1.0),
        ),
        close(
            "faint",
            "A picture with hardly any light is mapped as any other",
            _mapped,
            "Only a luminance of 0 has no logarithm.",
            what="of a dark picture, a channel of",
            within=64,
            case=_with_black,
            scales=FAINT,
        ),
        close(
            "values",
            "Pictures are mapped, however bright they were",
            _mapped,
            "Logarithmic mean, key, percentile, curve, ratios: in this order.",
            what="a channel of",
            within=64,
            scales=SCALES,
            whole=True,
        ),
    ),
    case=lambda d: {"radiance": _picture(d)},
    columns=False,
)

# ---------------------------------------------------------------- encode_srgb


def _encoded(a: Arguments, r: Array) -> tuple[Any, ...]:
    x = np.clip(a.linear, 0, 1)
    return r, np.where(x > 0.0031308, 1.055 * np.exp(np.log(x + 1e-300) / 2.4) - 0.055, 12.92 * x)


def _decoded(a: Arguments, r: Array) -> tuple[Any, ...]:
    back = np.where(r > 0.04045, ((np.abs(r) + 0.055) / 1.055) ** 2.4, r / 12.92)
    return back, np.clip(a.linear, 0, 1), 4.0


def _beyond(draw: Draw) -> Mapping[str, Any]:
    return {"linear": draw.rng.choice((-3.0, -1e-6, 0.0, 1.0, 1 + 1e-6, 50.0), (3, draw.n))}


ENCODE_SRGB = function(
    "film.encode_srgb",
    {
        "linear": Made(
            lambda d: d.uniform(0.0035, 1, 3, d.n),
            corners=lambda t: np.array([[0, 1, -1e30, 1e30, 0.0031308]] * 3, t),
        )
    },
    (
        within(
            "range",
            "Below 0 is black, above 1 is white",
            lambda _, r: r,
            0,
            1,
            "Cut off first: a root of what is below 0 is no number.",
            what="an encoded value",
            case=_beyond,
        ),
        close(
            "ends",
            "0 and 1 are 0 and 1, and so is what is beyond",
            lambda a, r: (r, np.clip(a.linear, 0, 1) > 0.5),
            what="at an end of the range, an encoded value of",
            case=_beyond,
            floor=2e-5,
        ),
        close(
            "dark",
            "Next to black the curve is a line",
            _encoded,
            "12.92 x: a root would be infinitely steep at 0.",
            what="next to black, an encoded value of",
            case=lambda d: {"linear": d.rng.uniform(0, 0.0062, (3, d.n))},
        ),
        close(
            "inverse",
            "Decoding gives the radiance back",
            _decoded,
            "The power is 1 / 2.4, and the line and the root meet.",
            what="decoded again, a value of",
        ),
        close(
            "values",
            "Values lie on the curve",
            _encoded,
            "A line up to 0.0031308, the root of 2.4 from there on.",
            what="an encoded value of",
            whole=True,
        ),
    ),
)

# ---------------------------------------------------------------- convert_gamut

D65 = (0.3127, 0.3290)
SRGB = np.array([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06), D65]).T
REC2020 = np.array([(0.708, 0.292), (0.170, 0.797), (0.131, 0.046), D65]).T

TO_SRGB = np.array(
    [(1.6605, -0.5876, -0.0728), (-0.1246, 1.1329, -0.0083), (-0.0182, -0.1006, 1.1187)]
)
"""From Rec. 2020, to four digits: ITU-R BT.2407."""


def _matrix(gamut: Array) -> Array:
    """RGB to XYZ, by the normalised primary matrix's closed form: areas of triangles in the plane of x and y."""
    points = np.vstack((gamut, np.ones(4)))
    red, green, blue, white = points.T
    areas = [
        np.linalg.det(np.stack(three))
        for three in ((white, green, blue), (red, white, blue), (red, green, white))
    ]
    xyz = np.vstack((gamut, 1 - gamut.sum(axis=0)))[:, :3]
    total = np.linalg.det(np.stack((red, green, blue)))
    return np.asarray(xyz * (np.array(areas) / total / gamut[1, 3]))


def _gamut(draw: Draw, white: Array) -> Array:
    """Three primaries around a white."""
    primaries = np.array(SRGB[:, :3])
    if not draw.simple:
        primaries = primaries + draw.rng.uniform(-0.04, 0.04, (2, 3))
    return np.column_stack((primaries, white))


def _gamuts(draw: Draw) -> Mapping[str, Any]:
    white = np.array(D65)
    if draw.simple:
        return {"source": REC2020, "target": SRGB}
    white = white + draw.rng.uniform(-0.02, 0.02, 2)
    return {"source": _gamut(draw, white), "target": _gamut(draw, white)}


def _converted(a: Arguments, r: Array) -> tuple[Any, ...]:
    expected = np.linalg.inv(_matrix(a.target)) @ _matrix(a.source) @ a.rgb
    return r, expected, 2 * np.abs(a.rgb).max(initial=0)


CONVERT_GAMUT = function(
    "film.convert_gamut",
    {"rgb": LIGHT, "source": Made(batch=False), "target": Made(batch=False)},
    (
        close(
            "white",
            "Greys stay greys",
            lambda a, r: (r, a.rgb),
            "RGB (1, 1, 1) is the white of both gamuts: how much of each primary makes it?",
            what="of a grey, a channel of",
            case=lambda d: {**_gamuts(d), "rgb": np.ones((3, d.n)) * d.uniform(0, 2, d.n)},
        ),
        close(
            "same",
            "From a gamut to itself nothing changes",
            lambda a, r: (r, a.rgb),
            what="from a gamut to itself, a channel of",
            case=lambda _: {"source": REC2020, "target": REC2020},
        ),
        close(
            "known",
            "Rec. 2020's colours are those of its published matrix",
            lambda a, r: (r, TO_SRGB @ a.rgb),
            "From the source's RGB to XYZ, and from there to the target's.",
            what="from Rec. 2020 to sRGB, a channel of",
            floor=1e-3,
            case=lambda d: {"source": REC2020, "target": SRGB, "rgb": d.uniform(0, 1, 3, d.n)},
        ),
        close(
            "outside",
            "Colours outside of the gamut keep their channels below 0",
            _converted,
            "What a screen can't show is cut off when it is encoded.",
            what="of a pure primary, a channel of",
            case=lambda d: {"source": REC2020, "target": SRGB, **_primaries(d)},
        ),
        close(
            "values",
            "Colours are the same light",
            _converted,
            "Two matrices, one of them inverted.",
            what="a channel of",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_gamuts,
)

# ---------------------------------------------------------------- quantize

CLOSE = 300 * EPSILON
"""Codes so close to a whole number that either side of it may be taken."""


def _codes(a: Arguments, r: Array) -> Array:
    exact = 255 * a.encoded + a.u
    low, high = np.floor(exact - CLOSE), np.floor(exact + CLOSE)
    right = (r >= np.clip(low, 0, 255)) & (r <= np.clip(high, 0, 255))
    return np.asarray(right.all(axis=0))


def _neighbour(a: Arguments, r: Array) -> Array:
    return np.asarray((np.abs(r - 255 * a.encoded) < 1 + CLOSE).all(axis=0))


def _ends(draw: Draw) -> Mapping[str, Any]:
    u = draw.rng.choice((0.0, 0.5, 1 - 2.0**-24), (3, draw.n))
    return {"encoded": draw.rng.integers(0, 2, (3, draw.n)).astype(float), "u": u}


def _steps(draw: Draw) -> Mapping[str, Any]:
    """All values at the same fraction between two codes, nearer to the lower one."""
    fraction = draw.rng.uniform(0.1, 0.4)
    return {"encoded": (draw.rng.integers(0, 255, (3, draw.n)) + fraction) / 255}


def _at_the_border(draw: Draw) -> Mapping[str, Any]:
    """Eighths: 255 k / 8 has the fraction f = 1 - k / 8, so that u = k / 8 is just 1 - f, in either precision."""
    eighths = draw.rng.integers(1, 8, (3, draw.n)) / 8
    return {"encoded": eighths, "u": eighths}


def _mean_codes(a: Arguments, r: Array) -> Iterator[tuple[str, Array, float, float]]:
    errors, fractions = r - 255 * a.encoded, 255 * a.encoded % 1
    for channel, values, fraction in zip(("red", "green", "blue"), errors, fractions, strict=True):
        variance = float((fraction * (1 - fraction)).mean())
        yield f"mean error of {channel}, in codes", values, 0.0, variance


QUANTIZE = function(
    "film.quantize",
    {"encoded": Made(lambda d: d.uniform(0, 1, 3, d.n))},
    (
        holds(
            "ends",
            "Black is 0 and white is 255, for every u",
            lambda a, r: (r == 255 * a.encoded).all(axis=0),
            "codes 0 for 0 and 255 for 1",
            "255 is the last code: there is no 256, and 0 begins no further down.",
            case=_ends,
        ),
        holds(
            "neighbours",
            "Codes are next to the value",
            _neighbour,
            "one of the two codes next to 255 encoded",
            "The noise is one code wide, and no more. A type of 8 bits with a sign ends at 127.",
        ),
        close(
            "border",
            "Where u is just 1 - f the upper code comes",
            lambda a, r: (r, 256 * a.encoded),
            "At least 1 - f: that is >=.",
            what="a code of",
            within=0,
            case=_at_the_border,
        ),
        means(
            "unbiased",
            "The mean of the codes is the value",
            _mean_codes,
            "A fraction f of the numbers u is at least 1 - f.",
            comparisons=3,
            case=_steps,
        ),
        holds(
            "values",
            "The upper code comes where u is at least 1 - f",
            _codes,
            "the lower code where u < 1 - f, and the upper one else",
            "Each value has a u of its own, and the codes 254 and 255 are chosen like all others.",
            whole=True,
        ),
    ),
)

FUNCTIONS = (EXPOSE, LUMINANCE, PHOTOGRAPHIC, ENCODE_SRGB, CONVERT_GAMUT, QUANTIZE)
