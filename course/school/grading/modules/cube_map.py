"""cube_map declared: OpenGL's faces and coordinates, bilinear lookup, and what lies beyond the edges."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from course.school.grading.checks.check import Array, Trial
from course.school.grading.checks.declare import Arguments, Case, Function, Law, Made, function
from course.school.grading.checks.drawing import Draw, worst_directions
from course.school.grading.checks.laws import close, holds, within

# Each face as a picture that hangs in space, as OpenGL has it: where on the cube of half side 1 its top left corner
# is, and the ways from there along the top row and down the left column.
TOP_LEFT = np.array([(1, 1, 1), (-1, 1, -1), (-1, 1, -1), (-1, -1, 1), (-1, 1, 1), (1, 1, -1)])
ALONG_ROW = np.array([(0, 0, -2), (0, 0, 2), (2, 0, 0), (2, 0, 0), (2, 0, 0), (-2, 0, 0)])
DOWN_COLUMN = np.array([(0, -2, 0), (0, -2, 0), (0, 0, 2), (0, 0, -2), (0, -2, 0), (0, -2, 0)])

LENGTHS = (1e-6, 1e-3, 1e3, 1e6)

NEAR = 1e-5
"""How near to an edge directions of no tie come: nearer, rounding may decide between two faces."""

NEAREST = -6, -3
"""Exponents of ten between which directions beside an edge lie away from it: rounding is six times smaller still."""


def _on_cube(face: Array, u: Array, v: Array) -> Array:
    """Places on the cube (3, N)."""
    places = TOP_LEFT[face] + u[:, None] * ALONG_ROW[face] + v[:, None] * DOWN_COLUMN[face]
    return np.asarray(places.T)


def _place(direction: Array) -> tuple[Array, Array, Array]:
    """Face, u and v of directions: where they meet the cube, measured along the face's sides."""
    axis = np.abs(direction).argmax(axis=0)
    largest = np.take_along_axis(direction, axis[None], 0)[0]
    face = 2 * axis + (largest < 0)
    from_corner = (direction / np.abs(largest)).T - TOP_LEFT[face]
    u, v = ((from_corner * side[face]).sum(axis=1) / 4 for side in (ALONG_ROW, DOWN_COLUMN))
    return face, u, v


def _directions(draw: Draw) -> Array:
    """Of any length, none near an edge of the cube."""
    if draw.simple:
        choice = np.array(((1, 0.5, 0), (-1, 0, 0.5), (0.5, 1, 0), (0, -1, 0.5), (0, 0.5, 1)))
        return draw.scale * choice.T[:, draw.rng.integers(0, 5, draw.n)]
    face = draw.rng.integers(0, 6, draw.n)
    d = _on_cube(face, *draw.uniform(NEAR, 1 - NEAR, 2, draw.n))
    return np.asarray(draw.scale * d / np.linalg.norm(d, axis=0))


DIRECTION = Made(_directions, corners=worst_directions)


# ---------------------------------------------------------------- face_and_uv


def _six(draw: Draw) -> Mapping[str, Any]:
    axes = np.concatenate((np.eye(3), -np.eye(3)), axis=1)
    return {"direction": axes[:, np.arange(draw.n) % 6]}


def _edge(draw: Draw) -> Array:
    """Directions to edges and corners, in the middle or anywhere along."""
    d = draw.rng.choice((-1.0, 1.0), (3, draw.n))
    along = draw.rng.choice((0.0, 0.5, 1.0), draw.n) * draw.uniform(-1, 1, draw.n).round(3)
    corner = draw.rng.random(draw.n) < 0.3
    axis = draw.rng.integers(0, 3, draw.n)
    d[axis, np.arange(draw.n)] = np.where(corner, d[axis, np.arange(draw.n)], along)
    return d


def _nearly(draw: Draw) -> Mapping[str, Any]:
    """On edges and corners, but for a few of the dtype's last places."""
    steps = draw.rng.integers(0, 4, (3, draw.n))
    return {"direction": _edge(draw) * (1 - np.finfo(draw.dtype).eps * steps)}


def _beside(draw: Draw) -> Mapping[str, Any]:
    """Directions that pass an edge closely, where one component is larger by little."""
    away = 10 ** draw.uniform(*NEAREST, draw.n)
    places = np.stack(
        (np.where(draw.rng.random(draw.n) < 0.5, away, 1 - away), draw.uniform(0.1, 0.9, draw.n))
    )
    turned = draw.rng.random(draw.n) < 0.5
    u, v = np.where(turned, places[::-1], places)
    return {"direction": _on_cube(draw.rng.integers(0, 6, draw.n), u, v)}


def _all_three(a: Arguments, r: Any) -> tuple[Any, ...]:
    return np.stack(r), np.stack(_place(a.direction)), 1.0


def _letter(trial: Trial, a: Arguments, r: Any) -> None:
    """Show (u, v) of directions that make a letter F on each face: all of them fill the square, mirrored or not."""
    u, v = expected = np.stack(_place(a.direction)[1:])
    stem, upper, lower = u < 0.35, v > 0.75, (v > 0.4) & (v < 0.55) & (u < 0.65)
    of = (u > 0.2) & (u < 0.8) & (v > 0.1) & (v < 0.9) & (stem | upper | lower)
    title = "(u, v) of directions that make an F on each face"
    trial.show("points", title, yours=np.stack(r[1:])[:, of], expected=expected[:, of])


FACE_AND_UV = function(
    "cube_map.face_and_uv",
    {"direction": DIRECTION},
    (
        close(
            "middles",
            "The six axes meet the middles of faces 0 to 5",
            _all_three,
            "The faces are +x, -x, +y, -y, +z, -z, the sign counts, and an axis meets its face's middle.",
            what="along an axis, face (row 0), u (1) or v (2):",
            case=_six,
            n=6,
        ),
        within(
            "range",
            "u and v stay in [0, 1], at the edges too",
            lambda _, r: np.stack(r[1:]),
            0,
            1,
            "The face's edges are at 0 and 1, and no direction of the face leads beyond them.",
            what="a coordinate",
            case=_nearly,
        ),
        holds(
            "ties",
            "On edges and corners x comes first, then y",
            lambda a, r: r[0] == _place(a.direction)[0],
            "the face of the component largest without its sign; of equal ones x before y, y before z",
            "Edges and corners belong to one face each.",
            shows=lambda _, r: r[0],
            case=lambda d: {"direction": _edge(d)},
        ),
        close(
            "beside",
            "Beside an edge the larger component decides",
            _all_three,
            "Only equal components are a tie: one that is larger by little is larger.",
            what="beside an edge, face (row 0), u (1) or v (2):",
            case=_beside,
        ),
        close(
            "uv",
            "Face, u and v are those of OpenGL's table",
            _all_three,
            "On each face u runs along its rows and v down its columns, from 0 to 1: look which axis "
            "and which sign OpenGL's table gives to them there.",
            what="face (row 0), u (1) or v (2):",
            figure=_letter,
            role="core",
        ),
        close(
            "length",
            "The direction's length doesn't matter",
            _all_three,
            "Only where a direction points matters, not how long it is.",
            what="for a direction of any length, face (row 0), u (1) or v (2):",
            scales=LENGTHS,
        ),
    ),
    contract="direction: 3 N -> face: whole N, u: N, v: N",
)


# ---------------------------------------------------------------- both lookups


def _four(size: int, direction: Array, seamless: bool) -> tuple[Array, Array]:
    """The four texels around each direction as indices (4, N), and their weights.

    A texel beyond an edge is folded down onto the neighbouring face, or is the outermost one; in a cube's corner there
    is none, and what it would weigh is shared out.
    """
    face, u, v = _place(direction)
    column, row = u * size - 0.5, v * size - 0.5
    i, j = (
        np.floor(place) + np.array(steps)[:, None]
        for place, steps in ((column, (0, 1, 0, 1)), (row, (0, 0, 1, 1)))
    )
    far = np.abs(np.stack((column - i, row - j)))
    weight = np.prod(1 - far, axis=0)
    inner_i, inner_j = i.clip(0, size - 1), j.clip(0, size - 1)
    own = ((face * size + inner_j) * size + inner_i).astype(int)
    if not seamless:
        return own, weight
    beyond_i, beyond_j = i != inner_i, j != inner_j
    weight = np.where(beyond_i & beyond_j, 0, weight)
    number, rows, columns = np.indices((6, size, size)).reshape(3, -1)
    centers = _on_cube(number, (columns + 0.5) / size, (rows + 0.5) / size)
    faces = np.broadcast_to(face, i.shape).ravel()
    on_edge = _on_cube(faces, *(((k.ravel() + 0.5) / size).clip(0, 1) for k in (i, j)))
    inward = np.cross(ALONG_ROW[faces], DOWN_COLUMN[faces]).T / 4
    # The face's normal, the way out of the cube, whichever way its picture runs.
    inward *= -np.sign((inward * on_edge).sum(axis=0)) / size
    across = cKDTree(centers.T).query((on_edge + inward).T)[1].reshape(i.shape)
    return np.where(beyond_i | beyond_j, across, own), weight / weight.sum(axis=0)


def _colors(a: Arguments, seamless: bool) -> Array:
    texel, weight = _four(len(a.faces[0]), a.direction, seamless)
    return np.asarray(np.einsum("knc,kn->cn", a.faces.reshape(-1, 3)[texel], weight).round(9))


HEIGHT, WIDTH = 40, 80
"""Of the picture that looks around in all directions."""

Places = Callable[[Draw, int], Array]
"""u and v (2, N) on faces of so many texels along a side."""


def _faces_of(draw: Draw, size: int = 0, brightest: float = 1.0) -> Array:
    """Of random texels, as many along a side or, if that is 0, some."""
    size = size or (2 if draw.simple else int(draw.rng.integers(3, 7)))
    return draw.uniform(0, brightest, 6, size, size, 3)


def _around(places: Places, size: int = 0, brightest: float = 1.0) -> Case:
    """Faces of random texels, and places on any of them."""

    def case(draw: Draw) -> Mapping[str, Any]:
        faces = _faces_of(draw, size, brightest)
        face = draw.rng.integers(0, 6, draw.n)
        direction = draw.scale * _on_cube(face, *places(draw, len(faces[0])))
        return {"faces": faces, "direction": direction}

    return case


def _anywhere(draw: Draw, _: int) -> Array:
    return draw.uniform(NEAR, 1 - NEAR, 2, draw.n)


def _inner(draw: Draw, size: int) -> Array:
    """Between texels' centres."""
    return 0.5 / size + draw.uniform(0.01, 0.99, 2, draw.n) * (1 - 1 / size)


def _centers(draw: Draw, size: int) -> Array:
    return np.asarray((draw.rng.integers(0, size, (2, draw.n)) + 0.5) / size)


def _corner(draw: Draw, size: int) -> Array:
    """Within half a texel of a corner, some very near to an edge."""
    near = draw.uniform(0.02, 0.98, 2, draw.n) * draw.rng.choice((1, 1e-4), (2, draw.n))
    near = near * 0.5 / size + NEAR
    return np.asarray(np.where(draw.rng.random((2, draw.n)) < 0.5, near, 1 - near))


def _edges(draw: Draw, size: int) -> Array:
    """One coordinate within half a texel of an edge, the other not."""
    found = _inner(draw, size)
    found[draw.rng.integers(0, 2, draw.n), np.arange(draw.n)] = _corner(draw, size)[0]
    return found


def _panorama(draw: Draw) -> Mapping[str, Any]:
    """A look around in all directions, turned by chance, if it is to be shown; else between texels' centres."""
    if draw.n != HEIGHT * WIDTH:
        return _around(_inner)(draw)
    theta = np.pi * (np.arange(HEIGHT)[:, None] + draw.rng.random()) / HEIGHT
    phi = 2 * np.pi * (np.arange(WIDTH) + draw.rng.random()) / WIDTH
    x, y, z = np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)
    d = np.stack(np.broadcast_arrays(x, y, z)).reshape(3, -1)
    return {"faces": _faces_of(draw), "direction": d}


def _lookup(name: str, seamless: bool, *more: Any) -> Function:
    """One of the lookups.

    ``more``: laws of it alone, as arguments of `about`
    """

    def compare(a: Arguments, r: Array) -> tuple[Any, ...]:
        # A place on a face is as exact as its last digit, and counts in texels.
        return r, _colors(a, seamless), a.faces.max() * len(a.faces[0])

    def away_from_edges(a: Arguments, r: Array) -> tuple[Any, ...]:
        _, expected, scale = compare(a, r)
        _, u, v = _place(a.direction)
        to_edge = np.minimum(np.minimum(u, 1 - u), np.minimum(v, 1 - v))
        return np.where(to_edge < 0.5 / len(a.faces[0]), expected, r), expected, scale

    def shown(trial: Trial, a: Arguments, r: Array) -> None:
        yours, right = (c.reshape(3, HEIGHT, WIDTH) for c in (r, _colors(a, seamless)))
        trial.show("pictures", "All around, faces of random texels", yours=yours, expected=right)

    def about(name: str, title: str, hint: str, case: Case, whole: bool = False, **how: Any) -> Law:
        usual: dict[str, Any] = {"compare": compare, "what": "a colour's channel of"}
        return close(name, title, hint=hint, case=case, whole=whole, **usual | how)

    return function(
        f"cube_map.{name}",
        {"faces": Made(_faces_of, (np.ones((6, 0, 0, 3)),), batch=False), "direction": DIRECTION},
        (
            about(
                "centres",
                "The centre of a texel shows that texel, however long the direction is",
                "A texel's centre shows that texel alone; centres are half a texel inside the face's edge.",
                _around(_centers),
                scales=(1.0, *LENGTHS),
                what="at a texel's centre, its colour's channel of",
            ),
            about(
                "all-around",
                "The surroundings of random texels look right, away from the cube's edges",
                "Four texels count, the more the nearer they are; see on which faces differences are.",
                _panorama,
                n=HEIGHT * WIDTH,
                compare=away_from_edges,
                figure=shown,
                whole=True,
            ),
            about(
                "bright",
                "Colours may be as bright as they like",
                "The sun is brighter than 1; to show that is the display's business.",
                _around(_inner, brightest=5e4),
                what="in faces with texels over 1, a colour's channel of",
            ),
            *(about(*law) for law in more),
        ),
    )


LOOKUP = _lookup(
    "lookup",
    False,
    (
        "one-texel",
        "A face of a single texel is that colour",
        "A face of a single texel has that texel's colour everywhere.",
        _around(_anywhere, size=1),
    ),
    (
        "clamped",
        "Near its edge a face goes on with its outermost texels",
        "Within half a texel of its edge a face goes on with its outermost texels.",
        _around(_edges),
    ),
)

LOOKUP_SEAMLESS = _lookup(
    "lookup_seamless",
    True,
    (
        "one-texel",
        "Faces of a single texel are mixed on edges and corners, too",
        "In the middle of an edge two texels count the same, and in a corner three.",
        _around(_anywhere, size=1),
    ),
    (
        "continuous",
        "On an edge two faces count alike, and in a corner three",
        "Both sides of an edge have to mix the same texels with the same weights.",
        lambda d: {"faces": _faces_of(d), "direction": _edge(d)},
    ),
    (
        "corners",
        "Beside a corner the weights of three texels are renormalised",
        "Three texels meet in a corner; what the missing fourth would weigh is shared out among them.",
        _around(_corner),
    ),
    (
        "edges",
        "Beside an edge the neighbour's texels are mixed in by their distance",
        "Half a texel from an edge its own face counts alone, on the edge both faces count the same.",
        _around(_edges),
        True,
    ),
)

FUNCTIONS = (FACE_AND_UV, LOOKUP, LOOKUP_SEAMLESS)
