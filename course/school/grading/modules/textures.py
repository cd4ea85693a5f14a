"""textures declared: the places of points on rectangles, spheres and triangles, and the bilinear lookup."""

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Trial
from course.school.grading.checks.declare import Arguments, Case, Made, function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, within

SCALES = (1.0, 1e-3, 1e3)

# ---------------------------------------------------------------- rectangle_uv


def _rectangle(low: float, high: float, off: float = 0.0) -> Case:
    """A rectangle anyhow in space, sides of different length, and points with u and v from low to high.

    ``off``: how far they may lie beside the plane
    """

    def case(draw: Draw) -> Mapping[str, Any]:
        a, b, normal = draw.frame()
        a, b = (edge * draw.scale * draw.number(0.5, 4) for edge in (a, b))
        p1 = draw.lengths(-2, 2, 3)
        u, v = draw.uniform(low, high, 2, draw.n)
        beside = np.outer(normal, draw.lengths(-off, off, draw.n))
        p = p1[:, None] + np.outer(a, u) + np.outer(b, v) + beside
        return {"p": p, "p1": p1, "p2": p1 + a, "p3": p1 + b}

    return case


def _places(a: Arguments, r: Array) -> tuple[Any, ...]:
    """From the plane's own equations: a least-squares solution has no part along the normal."""
    edges = np.stack((a.p2 - a.p1, a.p3 - a.p1))
    expected = np.linalg.lstsq(edges.T, a.p - a.p1[:, None], rcond=None)[0]
    # Points are rounded where they lie in space, and all is measured in edges.
    far = max(np.abs(a.p).max(initial=0), np.abs(a.p1).max())
    return r, expected, 1 + far / np.linalg.norm(edges, axis=1)[:, None]


_placed = partial(
    close, compare=_places, what="of p = p1 + u (p2 - p1) + v (p3 - p1), the coordinate"
)


def _neighbour(name: str) -> Made:
    return Made(wrong=({"p1": np.ones(3), name: np.ones(3)},))


RECTANGLE_UV = function(
    "textures.rectangle_uv",
    {"p2": _neighbour("p2"), "p3": _neighbour("p3")},
    (
        _placed(
            "beyond",
            "Beyond the edges places go on",
            hint="How far along each edge, in lengths of that edge; beyond its ends too.",
            case=_rectangle(-2, 3),
        ),
        _placed(
            "off_plane",
            "Points beside the plane count as on it",
            hint="What is at right angles to both edges changes neither u nor v.",
            what="beside the plane, that of the nearest point on it:",
            case=_rectangle(0, 1, 0.5),
        ),
        _placed(
            "inside",
            "Points have their places",
            hint="How far along each edge, in lengths of that edge.",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_rectangle(0, 1),
)


# ---------------------------------------------------------------- sphere_uv


def _on_sphere(draw: Draw, u: Array, v: Array, at_origin: bool = False) -> Mapping[str, Any]:
    """Points at these coordinates, as the task's text defines them, at different distances from a centre."""
    phi, theta = 2 * np.pi * u, np.pi * v
    s = np.sin(theta)
    directions = np.stack((s * np.cos(phi), -np.cos(theta), -s * np.sin(phi)))
    center = np.zeros(3) if at_origin else draw.lengths(-1, 1, 3)
    return {"center": center, "p": center[:, None] + draw.lengths(0.5, 3, draw.n) * directions}


def _anywhere(draw: Draw) -> Mapping[str, Any]:
    """On a sphere, but not next to its poles."""
    u, v = draw.uniform(0.01, 0.99, draw.n), draw.uniform(0.05, 0.95, draw.n)
    return _on_sphere(draw, u, v)


def _axes(draw: Draw) -> Mapping[str, Any]:
    """Along the axes, and half way between two."""
    places = np.array(
        (
            *((0, 0, -1), (-1, 0, 0), (0, 0, 1), (0, 1, 0), (0, -1, 0)),
            *((1, 0, 0), (1, 0, -1), (0, 1, -1), (0, -1, 1), (-1, 1, 0), (-1, -1, 1)),
        ),
        float,
    ).T
    index = draw.rng.integers(0, places.shape[1], draw.n)
    # Whole numbers and powers of two, so that points lie just where they should.
    center = draw.rng.integers(-2, 3, 3).astype(float)
    return {
        "center": center,
        "p": center[:, None] + draw.rng.choice((0.5, 1, 2)) * places[:, index],
    }


def _near_poles(draw: Draw) -> Mapping[str, Any]:
    """Rings so near to the poles that an arcus cosine in double precision still tells them apart."""
    v = 10.0 ** draw.rng.uniform(-6, -3, draw.n)
    return _on_sphere(
        draw, draw.units(1)[0], np.where(draw.rng.random(draw.n) < 0.5, v, 1 - v), at_origin=True
    )


def _seam(draw: Draw) -> Mapping[str, Any]:
    """All around the equator, on both sides of the half circle where the picture's ends meet, and on the poles."""
    u = draw.rng.choice((0.0, 1e-7, 1e-4, 0.25, 0.5, 0.75, 1 - 1e-4, 1 - 1e-7), draw.n)
    made = dict(_on_sphere(draw, u, draw.uniform(0.2, 0.8, draw.n), at_origin=True))
    made["p"][:, ::9] = [[0.0], [1], [0]] * draw.rng.choice((-1.0, 1.0), made["p"][0, ::9].size)
    return made


def _round(a: Arguments, r: Array) -> tuple[Any, ...]:
    """Angles by another way than a student's; u may be off by a whole turn, and on the poles it is anything."""
    x, y, z = a.p - a.center[:, None]
    u, v = np.angle(x - 1j * z) / (2 * np.pi) % 1, np.angle(np.hypot(x, z) + 1j * y) / np.pi + 0.5
    u = np.where(np.hypot(x, z) == 0, r[0], u)
    found = np.stack((r[0] + np.round(u - r[0]), r[1]))
    # The points themselves are rounded where they lie in space; next to the poles that is a wide angle.
    rounded = np.abs(a.center).max() / np.maximum(np.hypot(x, z), 1e-30)
    return found, np.stack((u, v)), 1 + rounded


SPHERE_UV = function(
    "textures.sphere_uv",
    {},
    (
        within(
            "range",
            "u and v are from 0 to 1",
            lambda _, r: r,
            0,
            1,
            "Angles below 0 belong to the same places as those a whole turn up.",
            what="a coordinate",
            case=_seam,
        ),
        close(
            "known",
            "The axes have their places",
            _round,
            "u goes once around from +x over -z, v from -y to +y.",
            what="on an axis, or half way between two, coordinate (u, v):",
            case=_axes,
            n=40,
        ),
        close(
            "poles",
            "Places next to the poles are right",
            _round,
            "Next to a pole u still goes once around, and an arcus cosine of the height in float32 loses half of v's "
            "digits: take it in double precision, or from height and distance to the axis.",
            what="next to a pole, coordinate (u, v):",
            case=_near_poles,
            within=4,
        ),
        close(
            "everywhere",
            "Points have their places, at any distance from any centre",
            _round,
            "Only the direction from the centre matters. Where does u begin, and which way does it grow?",
            what="coordinate (u, v) on the sphere:",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_anywhere,
)


# ---------------------------------------------------------------- triangle_uv


def _weights(draw: Draw) -> Array:
    """Of points anywhere in a triangle."""
    if draw.simple:
        return np.array([(0.5, 0.25, 0.25), (0.25, 0.75, 0), (0, 0.5, 0.5)]).T[
            :, draw.rng.integers(0, 3, draw.n)
        ]
    return np.asarray(draw.rng.dirichlet((1, 1, 1), draw.n).T)


def _one_triangle(draw: Draw) -> Mapping[str, Any]:
    return {name: draw.lengths(-2, 2, 2) for name in ("uv0", "uv1", "uv2")}


def _few_triangles(draw: Draw) -> Mapping[str, Any]:
    """As many points as coordinates or as corners: shapes alone don't say what is meant."""
    few = draw.but(n=int(draw.rng.integers(2, 4)))
    corners = {name: few.uniform(-2, 2, 2, few.n) for name in ("uv0", "uv1", "uv2")}
    return corners | {"barycentric": _weights(few)}


def _mixed(a: Arguments, r: Array) -> tuple[Any, ...]:
    corners = [uv.reshape(2, -1) for uv in (a.uv0, a.uv1, a.uv2)]
    size = max(float(np.abs(uv).max(initial=0)) for uv in corners)
    return r, sum(w * uv for w, uv in zip(a.barycentric, corners, strict=True)), size


CORNER = Made(lambda d: d.uniform(-2, 2, 2, d.n), single=True)


TRIANGLE_UV = function(
    "textures.triangle_uv",
    {"barycentric": Made(_weights), **dict.fromkeys(("uv0", "uv1", "uv2"), CORNER)},
    (
        close(
            "few",
            "Two or three points of triangles of their own are no other case",
            _mixed,
            "Corners are (2,) or (2, N): the number of axes tells one triangle from many, not their sizes.",
            what="for as many points as coordinates or corners, the corners' coordinate, weighted:",
            case=_few_triangles,
            scales=SCALES * 2,
        ),
        close(
            "inside",
            "Points weigh the corners' places",
            _mixed,
            "Each corner counts by its weight, and the weights sum to 1.",
            what="the corners' coordinate, weighted:",
            case=_one_triangle,
            points=2.0,
            scales=SCALES,
            role="core",
        ),
        close(
            "each",
            "Each point may have a triangle of its own",
            _mixed,
            "Column by column: the weights of a point and the corners of its triangle.",
            what="where each point has a triangle of its own, the corners' coordinate, weighted:",
            whole=True,
        ),
    ),
)


# ---------------------------------------------------------------- texture_lookup


def _image(draw: Draw, brightest: float = 1.0) -> Array:
    """A picture of random texels, wider than high."""
    if draw.simple:
        return draw.uniform(0, brightest, 2, 3, 3)
    height, width = draw.rng.integers((3, 7), (6, 12))
    return draw.uniform(0, brightest, height, width, 3)


def _centers(height: int, width: int) -> Array:
    """Where the texels' centres are, u and v (2, H, W)."""
    j, i = np.indices((height, width))
    return np.stack(((i + 0.5) / width, 1 - (j + 0.5) / height))


HEIGHT, WIDTH = 40, 60
"""Of the picture of a lookup that a report shows."""


def _between(brightest: float) -> Case:
    """Places between texels' centres, none near the picture's edges; as many as pixels, if they are to be shown."""

    def case(draw: Draw) -> Mapping[str, Any]:
        image = _image(draw, brightest)
        places = draw.uniform(0, 1, 2, draw.n)
        if draw.n == HEIGHT * WIDTH:
            down, right = np.indices((HEIGHT, WIDTH)).reshape(2, -1)
            places = np.stack((right / WIDTH, 1 - (down + 1) / HEIGHT))
        half = 0.5 / np.array(image.shape[1::-1])[:, None]
        return {"image": image, "uv": half + places * (1 - 2 * half)}

    return case


def _shown(trial: Trial, a: Arguments, r: Array) -> None:
    expected = _tents(a, r)[1]
    yours, right = (colors.reshape(3, HEIGHT, WIDTH) for colors in (r, expected))
    trial.show("pictures", "A picture of random texels", yours=yours, expected=right)


def _at_centers(draw: Draw) -> Mapping[str, Any]:
    image = _image(draw)
    places = _centers(*image.shape[:2]).reshape(2, -1)
    return {"image": image, "uv": places[:, np.arange(draw.n) % places.shape[1]]}


def _at_edges(draw: Draw) -> Mapping[str, Any]:
    """On the picture's edges, or within half a texel of them."""
    image = _image(draw)
    uv = draw.uniform(0, 1, 2, draw.n)
    edge = draw.rng.integers(0, 2, draw.n) + draw.rng.choice((0, -0.01, 0.01), draw.n)
    uv[draw.rng.integers(0, 2, draw.n), np.arange(draw.n)] = edge.clip(0, 1)
    return {"image": image, "uv": uv}


def _small(draw: Draw) -> Mapping[str, Any]:
    """Pictures of single texels, rows and columns, and places on, next to and far from whole numbers."""
    ends = np.array([0, 1, -1, -1e-9, 1e-9, 1 - 1e-8, 1 + 1e-8, 0.5, -1000.25, 1e6])
    size = draw.rng.choice(((1, 1), (1, 4), (5, 1)))
    return {"image": draw.uniform(0, 1, *size, 3), "uv": draw.rng.choice(ends, (2, draw.n))}


def _tents(a: Arguments, r: Array) -> tuple[Any, ...]:
    """The sum of all texels, each weighted with its periodic tents along u and v."""
    height, width, _ = a.image.shape
    centers = _centers(height, width)

    def tent(place: Array, center: Array, size: int) -> Array:
        apart = place[:, None] - center
        apart -= np.round(apart)
        weights = np.maximum(1 - np.abs(apart) * size, 0)
        # A single texel is its own neighbour on both sides.
        return np.asarray(weights / weights.sum(axis=1)[:, None])

    in_u, in_v = tent(a.uv[0], centers[0, 0], width), tent(a.uv[1], centers[1, :, 0], height)
    expected = np.einsum("nj,ni,jic->cn", in_v, in_u, a.image).round(9)
    # A place is as exact as its last digit, and counts in texels.
    return r, expected, a.image.max() * (1 + np.abs(a.uv).max(axis=0)) * max(height, width)


_texels = partial(close, compare=_tents)


EMPTY = (np.ones((0, 6, 3)), np.ones((4, 0, 3)), np.ones((3, 4, 6)))

TEXTURE_LOOKUP = function(
    "textures.texture_lookup",
    {"image": Made(_image, EMPTY, batch=False), "uv": Made(lambda d: d.uniform(0, 1, 2, d.n))},
    (
        _texels(
            "centers",
            "A texel's centre has the texel's colour",
            hint="At a texel's centre its colour counts alone: column i has it at (i + 1/2) / W, and v = 1 is on top.",
            what="at a texel's centre, its colour's channel of",
            case=_at_centers,
        ),
        _texels(
            "wraps",
            "At an edge the opposite texels mix in",
            hint="Half a texel from an edge the texel at the opposite edge begins to count.",
            what="at the picture's edge, a colour's channel of",
            case=_at_edges,
        ),
        _texels(
            "repeats",
            "Whole numbers away the picture is the same",
            hint="The picture goes on beyond its edges, to the left and downwards too.",
            what="beyond the edges, a colour's channel of",
            case=lambda d: {"image": _image(d), "uv": d.uniform(-5, 6, 2, d.n)},
        ),
        _texels(
            "small",
            "Pictures of one texel, one row or one column have right colours, too",
            hint="A single texel is its own neighbour on all sides, and its colour is everywhere.",
            what="in a picture of a single row or column, a colour's channel of",
            case=_small,
            scales=(1.0,) * 6,
        ),
        _texels(
            "picture",
            "A picture of random texels is right between its texels' centres",
            hint="Between centres four texels count, the more the nearer they are; differences are shown.",
            what="a colour's channel of",
            case=_between(1.0),
            n=HEIGHT * WIDTH,
            figure=_shown,
            role="core",
        ),
        _texels(
            "bright",
            "Colours may be as bright as they like",
            hint="A lamp or the sky in a picture is brighter than 1; to show that is the display's business.",
            what="in a picture with texels over 1, a colour's channel of",
            case=_between(500.0),
        ),
    ),
)

FUNCTIONS = (RECTANGLE_UV, SPHERE_UV, TRIANGLE_UV, TEXTURE_LOOKUP)
