"""thin_lens declared: points on the disk, rays through a lens, and the two formulas about it."""

from collections.abc import Mapping
from functools import partial
from math import inf, nan
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Case, Made, function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, unit_length
from course.school.grading.checks.vectors import dot, normalized
from course.school.grading.modules.round_shapes import DISK, unit_points

# ---------------------------------------------------------------- point_on_disk

POINT_ON_DISK = unit_points("thin_lens.point_on_disk", DISK)


# ---------------------------------------------------------------- lens_rays


def _camera(draw: Draw, radius: float | None = None, wide: float = 1.0) -> Mapping[str, Any]:
    """A camera that looks anywhere, and the pinhole's rays of a picture as wide; at 1, of a right angle."""
    right, up, forward = draw.frame()
    picture = np.concatenate((draw.uniform(-wide, wide, 2, draw.n), np.ones((1, draw.n))))
    d = np.stack((right, up, forward)).T @ picture
    size = draw.scale * (draw.number(0.05, 0.5) if radius is None else radius)
    return {
        "right": right,
        "up": up,
        "forward": forward,
        "directions": d / np.linalg.norm(d, axis=0),
        "lens_points": size * draw.uniform(-1, 1, 2, draw.n),
    }


def _extremes(draw: Draw) -> Mapping[str, Any]:
    """A pinhole, or a lens as wide as its focus is far, and rays up to 85 degrees off the axis."""
    return {**_camera(draw, draw.rng.choice((0.0, 2.0)), 8.0), "focus_distance": 2.0 * draw.scale}


def _on_lens(a: Arguments) -> Array:
    """Where rays start."""
    x, y = a.lens_points
    return np.asarray(a.origin[:, None] + np.outer(a.right, x) + np.outer(a.up, y))


def _sharp(a: Arguments) -> Array:
    """Where the pinhole's rays meet the plane in focus."""
    along = a.focus_distance / dot(a.forward[:, None], a.directions)
    return np.asarray(a.origin[:, None] + a.directions * along)


def _toward(a: Arguments) -> Array:
    """From where rays start to the points in focus."""
    return normalized(_sharp(a) - _on_lens(a))


def _met(a: Arguments, r: Any) -> Array:
    """Where the rays meet the plane in focus."""
    origins, directed = r
    ahead = a.focus_distance - dot(a.forward[:, None], origins - a.origin[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(origins + directed * (ahead / dot(a.forward[:, None], directed)))


def _scale(a: Arguments) -> float:
    """The largest length in a call: rounding is as large as its last place."""
    lens = np.abs(a.lens_points).max(initial=0)
    return float(np.abs(a.origin).max() + lens + 3 * a.focus_distance)


SCALES = (1.0, 1e-3, 1e3)

LENS_RAYS = function(
    "thin_lens.lens_rays",
    {"focus_distance": declare.length(0.7, 20, (0.0, -1.0, nan))},
    (
        close(
            "on_lens",
            "Rays start on the lens, at their lens points",
            lambda a, r: (r[0], _on_lens(a), _scale(a)),
            "Lens points are distances along the camera's own axes, right and up.",
            what="origin + x right + y up:",
            scales=SCALES,
        ),
        close(
            "plane_in_focus",
            "All rays of a pixel meet its pinhole's ray on the plane in focus",
            lambda a, r: (_met(a, r), _sharp(a), _scale(a)),
            "What is in focus is sharp: wherever on the lens a ray starts, it goes through that point.",
            what="on the plane in focus, the pinhole's point:",
            scales=SCALES,
            within=40,
        ),
        close(
            "extremes",
            "The lens's centre gives the pinhole's rays; a lens as wide as its focus is far is right, too",
            lambda a, r: (r[1], _toward(a)),
            "The way from the lens point to the point in focus, from (0, 0) and at any angle.",
            what="a direction of",
            within=100,
            scales=SCALES * 2,
            case=_extremes,
        ),
        close(
            "rays",
            "Rays go from their lens points to the points in focus",
            lambda a, r: (
                np.concatenate(r),
                np.concatenate((_on_lens(a), _toward(a))),
                np.array((_scale(a), 1.0)).repeat(3)[:, None],
            ),
            "Both ends of a ray have to be right: where it starts, and where it meets the plane in focus.",
            what="origin (rows 0 to 2) or direction (3 to 5):",
            scales=SCALES,
            within=100,
            role="core",
        ),
        unit_length(lambda _, r: r[1]),
    ),
    case=_camera,
)


# ---------------------------------------------------------------- image_distance


def _lenses(near: bool) -> Case:
    """Focal lengths, and distances of objects beyond them or nearer."""

    def case(draw: Draw) -> Mapping[str, Any]:
        focal = draw.scale * draw.number(0.01, 10)
        ratio = draw.number(0.1, 0.9) if near else 1 + draw.number(0.1, 20)
        return {"focal_length": focal, "object_distance": focal * ratio}

    return case


def _next_to_focus(draw: Draw) -> Mapping[str, Any]:
    """Objects whose distance is nearly the focal length, or many times it."""
    focal = draw.scale * draw.number(0.01, 10)
    off = draw.rng.choice((-1, 1)) * draw.number(1e-6, 1e-4)
    ratio = 1 + off if draw.rng.random() < 0.5 else draw.number(1e3, 1e5)
    return {"focal_length": focal, "object_distance": focal * ratio}


def _formula(a: Arguments, r: Array) -> tuple[Any, ...]:
    f, d = a.focal_length, a.object_distance
    return r, inf if f == d else f if d == inf else f * d / (d - f)


def _at_limits(draw: Draw) -> Mapping[str, Any]:
    """Objects at the focal length, or at infinity."""
    focal = draw.number(0.05, 1)
    return {"focal_length": focal, "object_distance": draw.rng.choice((focal, inf)).item()}


_image = partial(close, compare=_formula, within=1e-2, scales=SCALES * 7)
"""The formula on lenses of a kind, twenty of them at each of three scales."""


IMAGE_DISTANCE = function(
    "thin_lens.image_distance",
    {
        "focal_length": declare.length(0.01, 10, (0.0, -1.0, nan)),
        "object_distance": declare.length(0.1, 9, (0.0, -1.0, nan)),
    },
    (
        _image(
            "real",
            "Objects beyond the focal length have their image where the lens formula says",
            hint="The reciprocals of both distances add up to that of the focal length.",
            case=_lenses(near=False),
            role="core",
        ),
        _image(
            "virtual",
            "Nearer objects have a virtual image, at a negative distance",
            hint="The same formula holds there; the sign says on which side of the lens the image is.",
            case=_lenses(near=True),
            role="core",
        ),
        _image(
            "next_to_focus",
            "Objects next to the focal length have their image far away, and far ones next to it",
            hint="Only an object at the focal length itself has none: far is not infinitely far.",
            case=_next_to_focus,
        ),
        _image(
            "limits",
            "The image of an object at the focal length is at infinity, and the other way round",
            hint="At the focal length rays leave the lens parallel; from infinity they come so.",
            case=_at_limits,
        ),
    ),
    contract="focal_length, object_distance -> the distance: floating infinite",
    speed=0,
)


# ---------------------------------------------------------------- circle_of_confusion


def _depths(low: float, high: float) -> Case:
    """Depths between these multiples of the distance in focus."""

    def case(draw: Draw) -> Mapping[str, Any]:
        focus = draw.scale * draw.number(0.5, 20)
        exponents = draw.uniform(np.log(low), np.log(high), draw.n)
        return {"focus_distance": focus, "depth": focus * np.exp(exponents)}

    return case


def _circle(a: Arguments, r: Array) -> tuple[Any, ...]:
    expected = 2 * a.aperture_radius * np.abs(a.focus_distance - a.depth) / a.depth
    return r, expected, expected + a.aperture_radius


def _sharp_points(draw: Draw) -> Mapping[str, Any]:
    """Points in focus, or a lens without an aperture."""
    if draw.rng.random() < 0.5:
        return {"aperture_radius": 0.0}
    return {"depth": np.full(draw.n, 2.5), "focus_distance": 2.5}


_spread = partial(close, compare=_circle, what="a diameter of", scales=SCALES * 3)


CIRCLE_OF_CONFUSION = function(
    "thin_lens.circle_of_confusion",
    {
        "depth": Made(
            lambda d: d.lengths(0.5, 9, d.n),
            wrong=(
                np.array([1, 0, 2, 3], np.float32),
                np.array([1, 2, -1, 3], np.float32),
                np.array([1, 2, nan, 3], np.float32),
            ),
        ),
        "aperture_radius": declare.length(0.01, 0.5, (-1.0, nan)),
        "focus_distance": declare.length(0.5, 20, (0.0, -1.0, nan)),
    },
    (
        _spread(
            "behind",
            "Points behind the plane in focus spread as far as they should",
            hint="Two similar triangles: lens and point, circle and point.",
            case=_depths(1.01, 50),
            role="core",
        ),
        _spread(
            "in_front",
            "Points in front of the plane in focus spread as far as they should",
            hint="The circle grows without limit towards the lens: which depth is divided by? No sign is left.",
            case=_depths(0.02, 0.99),
            role="core",
        ),
        _spread(
            "near",
            "Points next to the lens spread as far as they should",
            hint="The circle grows without limit towards the lens: only a depth of 0 can't be divided by.",
            case=_depths(1e-6, 0.02),
        ),
        _spread(
            "limits",
            "Nothing spreads in focus, nor without an aperture",
            hint="The diameter is proportional to the aperture, and to how far from focus a point is.",
            case=_sharp_points,
        ),
        _spread(
            "far",
            "Far points spread over the lens's diameter",
            hint="Very far points spread over a circle as wide as the lens: no matter how much farther.",
            case=lambda d: {"depth": np.geomspace(1e5, 1e6, d.n), "focus_distance": 1.5},
        ),
    ),
    contract="depth: N, aperture_radius, focus_distance -> the diameters: N",
    case=_depths(0.2, 5),
)

FUNCTIONS = (POINT_ON_DISK, LENS_RAYS, IMAGE_DISTANCE, CIRCLE_OF_CONFUSION)
