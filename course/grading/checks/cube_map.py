"""Checks of cube_map: OpenGL's faces and coordinates, bilinear lookup, and what lies beyond the edges."""

from __future__ import annotations

from functools import partial
from itertools import combinations, product
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Caller, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    finite_numbers,
    near,
)
from course.grading.checks.statistics import FALSE_FAIL, check_mean
from course.grading.checks.vectors import unit_vectors

MODULE = "cube_map"

FACES = ("+x", "-x", "+y", "-y", "+z", "-z")

# Each face as a picture that hangs in space, as OpenGL has it: where on the cube of half side 1 its top left corner
# is, and the ways from there along the top row and down the left column.
TOP_LEFT = np.array([(1, 1, 1), (-1, 1, -1), (-1, 1, -1), (-1, -1, 1), (-1, 1, 1), (1, 1, -1)])
ALONG_ROW = np.array([(0, 0, -2), (0, 0, 2), (2, 0, 0), (2, 0, 0), (2, 0, 0), (-2, 0, 0)])
DOWN_COLUMN = np.array([(0, -2, 0), (0, -2, 0), (0, 0, 2), (0, 0, -2), (0, -2, 0), (0, -2, 0)])

EPSILON = 1e-5
"""How near to an edge random directions come: nearer, rounding may decide between two faces."""

TOLERANCE = 2e-5
"""Of a float32 lookup in faces of a few texels whose colours are no larger than 1."""

HEIGHT, WIDTH = 40, 80
"""Of the pictures that look around in all directions."""


def _toward(face: Array, u: Array, v: Array) -> Array:
    """Directions (3, N) to places on the cube, not of unit length."""
    places = TOP_LEFT[face] + u[:, None] * ALONG_ROW[face] + v[:, None] * DOWN_COLUMN[face]
    return np.ascontiguousarray(places.T)


def _places(rng: np.random.Generator, n: int, margin: float = EPSILON) -> tuple[Array, ...]:
    """Random faces, u and v, each face as often as the others."""
    u, v = rng.uniform(margin, 1 - margin, (2, n))
    return np.arange(n) % 6, u, v


def _lattice(dtype: Any) -> Array:
    """Middles of faces, edges, corners, and directions between them."""
    steps = (-1.0, -0.5, 0.0, 1e-6, 1.0)
    return np.array([d for d in product(steps, repeat=3) if 1.0 in np.abs(d)], dtype).T


def _edges(rng: np.random.Generator, n: int) -> tuple[Array, Array]:
    """Directions (3, M) to the 12 edges, n random ones each, to the edges' middles and the corners; their faces."""
    directions, faces = [], []
    for first, second in combinations(range(3), 2):
        (along,) = {0, 1, 2} - {first, second}
        for sign, other in product((1, -1), repeat=2):
            for place in (0.0, *rng.uniform(-0.999, 0.999, n)):
                direction = np.zeros(3)
                direction[[first, second, along]] = sign, other, place
                directions.append(direction)
                faces.append(2 * first + (sign < 0))
    for corner in product((1.0, -1.0), repeat=3):
        directions.append(np.array(corner))
        faces.append(int(corner[0] < 0))
    return np.array(directions).T, np.array(faces)


def _ramps(rng: np.random.Generator) -> Array:
    """A colour (6, 3) at each face's top left, its changes along u and v, and along both: bilinear pictures."""
    scale = np.array([1, 0.6, -0.5, 0.4])
    return np.asarray(rng.uniform(0.1, 0.9, (4, 6, 3)) * scale[:, None, None])


def _ramp_at(ramps: Array, face: Array, u: Array, v: Array) -> Array:
    weights = np.stack((np.ones_like(u), u, v, u * v))
    colors: Array = np.einsum("kn,knc->cn", weights, ramps[:, face])
    return colors


def _centers(size: int) -> tuple[Array, Array, Array]:
    """Face, u and v of each texel's centre, in the order in which faces hold them."""
    face, row, column = np.indices((6, size, size)).reshape(3, -1)
    return face, (column + 0.5) / size, (row + 0.5) / size


def _painted(colors: Array, size: int, dtype: Any = np.float32) -> Array:
    """Faces (6, size, size, 3) from colours (3, 6 size size) of the texels' centres."""
    return np.ascontiguousarray(colors.T.reshape(6, size, size, 3), dtype)


def _plain(colors: Array, size: int, dtype: Any = np.float32) -> Array:
    """Faces of one colour (6, 3) each."""
    return np.array(np.broadcast_to(colors[:, None, None], (6, size, size, 3)), dtype)


def _random_faces(rng: np.random.Generator, size: int, dtype: Any = np.float32) -> Array:
    return rng.random((6, size, size, 3)).astype(dtype)


def _colors(trial: Trial, faces: Array, direction: Array) -> Array:
    """What the student's lookup finds, (3, N)."""
    return finite_numbers(trial.call(faces, direction), (3, direction.shape[1]), "the colours")


def _three(value: Any) -> tuple[Any, Any, Any]:
    if not isinstance(value, (tuple, list)) or len(value) != 3:
        raise Failure("a tuple (face, u, v)", type(value).__name__)
    face, u, v = value
    return face, u, v


def _face_uv(trial: Trial, direction: Array) -> tuple[Array, Array, Array]:
    """What the student makes of directions, as numbers (N,) each."""
    shape = (direction.shape[1],)
    face, u, v = _three(trial.call(direction))
    return (
        finite_numbers(face, shape, "face"),
        finite_numbers(u, shape, "u"),
        finite_numbers(v, shape, "v"),
    )


def _check_faces_are(found: Array, expected: Array, direction: Array, hint: str) -> None:
    wrong = np.flatnonzero(found != expected)
    if len(wrong):
        worst = int(wrong[0])
        number = int(found[worst])
        name = f", {FACES[number]}" if 0 <= number < 6 else ""
        raise Failure(
            f"face {expected[worst]}, {FACES[int(expected[worst])]}",
            f"{found[worst]:g}{name}",
            f"{at(direction=direction)(worst)}; {len(wrong)} of {len(found)} directions",
            hint,
        )


# ---------------------------------------------------------------- face_and_uv


def _faces_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        d = np.concatenate((_lattice(dtype), unit_vectors(trial.rng, 50, dtype)), axis=1)
        for directions in (d, d[:, :0]):
            shape = (directions.shape[1],)
            face, u, v = _three(trial.call(directions))
            kind = getattr(face, "dtype", np.dtype(float))
            if not np.issubdtype(kind, np.integer):
                raise Failure("face as an array of integers", str(kind))
            check_array(face, shape, kind, "face")
            check_array(u, shape, dtype, "u")
            check_array(v, shape, dtype, "v")


def _faces_untouched(trial: Trial) -> None:
    check_untouched(trial, unit_vectors(trial.rng, 20, np.float32))


def _faces_refuses(trial: Trial) -> None:
    d = unit_vectors(trial.rng, 4, np.float32)
    check_refused(trial, d[:2], named="number of components")
    check_refused(trial, d[:, 0], named="shape of direction, one without columns")
    check_refused(trial, np.ascontiguousarray(d.T), named="order of axes")


def _middles(trial: Trial) -> None:
    half = np.full(6, 0.5)
    d = _toward(np.arange(6), half, half)
    face, u, v = _face_uv(trial, d)
    _check_faces_are(face, np.arange(6), d, "The six faces are +x, -x, +y, -y, +z, -z.")
    for name, found in (("u", u), ("v", v)):
        check_close(found, half, 1e-6, name, at(direction=d), "An axis meets its face's middle.")


def _faces(trial: Trial) -> None:
    for dtype in DTYPES:
        expected, u, v = _places(trial.rng, 1200)
        d = _toward(expected, u, v)
        d = (d / np.linalg.norm(d, axis=0)).astype(dtype)
        _check_faces_are(
            _face_uv(trial, d)[0],
            expected,
            d,
            "A direction leaves the cube through the face of its largest component, sign and all.",
        )


def _uv(trial: Trial) -> None:
    for dtype in DTYPES:
        face, u, v = _places(trial.rng, 1200)
        d = _toward(face, u, v)
        d = (d / np.linalg.norm(d, axis=0)).astype(dtype)
        _, found_u, found_v = _face_uv(trial, d)
        trial.show(
            "points", "(u, v)", yours=np.stack((found_u, found_v)), expected=np.stack((u, v))
        )
        tolerance = 16 * float(np.finfo(dtype).eps)
        for name, found, expected in (("u", found_u, u), ("v", found_v, v)):
            check_close(
                found,
                expected,
                tolerance,
                name,
                at(direction=d, face=face),
                "Follow OpenGL's table row by row: each face has signs of its own.",
            )


def _ties(trial: Trial) -> None:
    d, expected = _edges(trial.rng, 4)
    for dtype in DTYPES:
        direction = d.astype(dtype)
        face, u, v = _face_uv(trial, direction)
        _check_faces_are(
            face,
            expected,
            direction,
            "Where two components are equally large, x comes before y and y before z.",
        )
        check_close(
            _toward(expected, u, v),
            direction,
            16 * float(np.finfo(dtype).eps),
            "u and v to lead back to the direction:",
            at(direction=direction),
            "On an edge, u and v are those of the face that the edge counts to.",
        )


def _range(trial: Trial) -> None:
    for dtype in DTYPES:
        edge, _ = _edges(trial.rng, 20)
        nearly = edge * (1 - np.finfo(dtype).eps * trial.rng.integers(0, 4, edge.shape))
        d = np.concatenate((nearly.astype(dtype), _lattice(dtype)), axis=1)
        for name, found in zip(("u", "v"), _face_uv(trial, d)[1:], strict=True):
            outside = np.maximum(-found, found - 1)
            worst = int(np.argmax(outside))
            if outside[worst] > 4 * float(np.finfo(dtype).eps):
                raise Failure(
                    f"{name} in [0, 1]",
                    f"{found[worst]:.9g}",
                    at(direction=d)(worst),
                    "The face's edges are at 0 and 1, and no direction of the face leads beyond them.",
                )


def _lengths(dtype: Any) -> tuple[float, ...]:
    """Powers of two, so that they round nothing; their squares leave the dtype's range."""
    far = 90 if dtype is np.float32 else 600
    return (2.0**-far, 2.0**-10, 2.0**10, 2.0**far)


def _faces_length(trial: Trial) -> None:
    for dtype in DTYPES:
        face, u, v = _places(trial.rng, 60)
        d = _toward(face, u, v)
        lengths = _lengths(dtype)
        scaled = np.concatenate([d * length for length in lengths], axis=1).astype(dtype)
        found = _face_uv(trial, scaled)
        hint = "Only where a direction points matters, not how long it is."
        n = len(lengths)
        _check_faces_are(found[0], np.tile(face, n), scaled, hint)
        for name, value, expected in zip("uv", found[1:], (u, v), strict=True):
            check_close(
                value,
                np.tile(expected, n),
                16 * float(np.finfo(dtype).eps),
                name,
                at(direction=scaled),
                hint,
            )


# ---------------------------------------------------------------- both lookups


def _lookup_contract(trial: Trial) -> None:
    for size, dtype, f_dtype in (
        (5, np.float32, np.float32),
        (1, np.float32, np.float64),
        (2, np.float64, np.float32),
        (5, np.float64, np.float64),
    ):
        faces = _random_faces(trial.rng, size, f_dtype)
        d = np.concatenate((_lattice(dtype), unit_vectors(trial.rng, 50, dtype)), axis=1)
        what = f"the colours for {d.dtype} directions in {faces.dtype} faces of {size} x {size}"
        check_array(trial.call(faces, d), d.shape, dtype, what)
        check_array(trial.call(faces, d[:, :0]), (3, 0), dtype, "the colours for no directions")


def _lookup_untouched(trial: Trial) -> None:
    # With edges and corners: these are where faces are mended.
    d = np.concatenate((_lattice(np.float32), unit_vectors(trial.rng, 20, np.float32)), axis=1)
    check_untouched(trial, _random_faces(trial.rng, 4), d)


def _lookup_refuses(trial: Trial) -> None:
    d, faces = unit_vectors(trial.rng, 4, np.float32), _random_faces(trial.rng, 4)
    check_refused(trial, faces, d[:2], named="shape of direction")
    check_refused(trial, faces[:5], d, named="number of faces")
    check_refused(trial, faces[:, :3], d, named="shape of faces that are not square")
    check_refused(trial, faces[..., :2], d, named="number of channels")
    check_refused(trial, faces[:, :0, :0], d, named="shape of faces without texels")


def _check_colors(
    trial: Trial, faces: Array, d: Array, expected: Array, hint: str, tolerance: float = TOLERANCE
) -> None:
    found = _colors(trial, faces, d)
    size = faces.shape[1]
    check_close(
        found,
        expected,
        tolerance,
        f"in faces of {size} x {size} texels a colour's channel of",
        at(direction=d),
        hint,
    )


def _own_face(trial: Trial) -> None:
    colors = trial.rng.random((6, 3))
    face, u, v = _places(trial.rng, 900, 0.2)
    _check_colors(
        trial,
        _plain(colors, 4),
        _toward(face, u, v).astype(np.float32),
        colors[face].T,
        "Inside a face of one colour there is only that colour; see whether the right face is asked.",
    )


def _texel_centers(trial: Trial) -> None:
    size = int(trial.rng.choice((3, 5, 6, 7)))
    faces = _random_faces(trial.rng, size)
    _check_colors(
        trial,
        faces,
        _toward(*_centers(size)).astype(np.float32),
        faces.reshape(-1, 3).T,
        "A texel's centre shows that texel alone; centres are half a texel inside the face's edge.",
    )


def _inner_places(rng: np.random.Generator, n: int, size: int) -> tuple[Array, Array, Array]:
    """Places between texels' centres."""
    face, u, v = _places(rng, n, 0.5 / size + EPSILON)
    return face, u, v


def _linear(trial: Trial) -> None:
    for dtype, tolerance in ((np.float32, TOLERANCE), (np.float64, 1e-12)):
        size = int(trial.rng.choice((5, 6, 7, 8)))
        ramps = _ramps(trial.rng)
        face, u, v = _inner_places(trial.rng, 1200, size)
        _check_colors(
            trial,
            _painted(_ramp_at(ramps, *_centers(size)), size, dtype),
            _toward(face, u, v).astype(dtype),
            _ramp_at(ramps, face, u, v),
            "Between texels' centres, four texels are weighed by how near they are, so that a smooth"
            " ramp stays one.",
            tolerance,
        )


def _clamped(trial: Trial) -> None:
    size = int(trial.rng.choice((4, 5, 6)))
    ramps = _ramps(trial.rng)
    face, u, v = _places(trial.rng, 1200)
    # One coordinate, or both, within half a texel of an edge.
    near = trial.rng.uniform(EPSILON, 0.5 / size, (2, 1200))
    near = np.where(trial.rng.random((2, 1200)) < 0.5, near, 1 - near)
    which = trial.rng.integers(0, 3, 1200)
    u, v = np.where(which != 1, near[0], u), np.where(which != 0, near[1], v)
    half = 0.5 / size
    _check_colors(
        trial,
        _painted(_ramp_at(ramps, *_centers(size)), size),
        _toward(face, u, v).astype(np.float32),
        _ramp_at(ramps, face, u.clip(half, 1 - half), v.clip(half, 1 - half)),
        "Within half a texel of its edge a face goes on with its outermost texels.",
    )


def _single_texel(trial: Trial) -> None:
    colors = trial.rng.random((6, 3))
    face, u, v = _places(trial.rng, 600)
    _check_colors(
        trial,
        _plain(colors, 1),
        _toward(face, u, v).astype(np.float32),
        colors[face].T,
        "A face of a single texel has that texel's colour everywhere.",
    )


def _lookup_length(trial: Trial) -> None:
    for dtype, tolerance in ((np.float32, TOLERANCE), (np.float64, 1e-12)):
        ramps = _ramps(trial.rng)
        face, u, v = _inner_places(trial.rng, 60, 5)
        d, lengths = _toward(face, u, v), _lengths(dtype)
        _check_colors(
            trial,
            _painted(_ramp_at(ramps, *_centers(5)), 5, dtype),
            np.concatenate([d * length for length in lengths], axis=1).astype(dtype),
            np.tile(_ramp_at(ramps, face, u, v), len(lengths)),
            "Only where a direction points matters, not how long it is.",
            tolerance,
        )


def _mean(trial: Trial) -> None:
    """Faces of one colour each: every face takes a sixth of the sphere, with whatever its edges are mixed."""
    colors = trial.rng.random((6, 3))
    found = _colors(trial, _plain(colors, 4), unit_vectors(trial.rng, 5000, np.float32))
    for channel, name in enumerate(("red", "green", "blue")):
        check_mean(
            found[channel],
            float(colors[:, channel].mean()),
            # Of unmixed colours; mixing can only bring them nearer to each other.
            float(colors[:, channel].var()),
            f"mean {name} over the whole sphere",
            "The six faces are equally large, seen from the middle.",
        )


def _around(rng: np.random.Generator) -> tuple[Array, Array]:
    """Random faces, and the directions (3, N) of a picture all around, turned by chance."""
    size = int(rng.choice((3, 4, 5)))
    faces = _random_faces(rng, size)
    turn, lift = rng.uniform(0.1, 0.9, 2)
    theta = np.pi * (np.arange(HEIGHT)[:, None] + lift) / HEIGHT
    phi = 2 * np.pi * (np.arange(WIDTH) + turn) / WIDTH
    d = np.stack(
        np.broadcast_arrays(np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi))
    )
    return faces, np.ascontiguousarray(d.reshape(3, -1), np.float32)


def _prepare_around(function: str, reference: Caller, rng: np.random.Generator) -> dict[str, Array]:
    faces, d = _around(rng)
    _, u, v = reference.call("face_and_uv", d)
    to_edge = np.minimum(np.minimum(u, 1 - u), np.minimum(v, 1 - v))
    return {"colors": reference.call(function, faces, d), "sure": to_edge > EPSILON}


def _all_around(trial: Trial) -> None:
    faces, d = _around(trial.rng)
    expected, sure = trial.references["colors"], trial.references["sure"]
    found = _colors(trial, faces, d)
    shape = (3, HEIGHT, WIDTH)
    trial.show(
        "pictures",
        "Faces of random texels, looked at in all directions",
        yours=found.reshape(shape),
        expected=np.asarray(expected).reshape(shape),
    )
    check_close(
        found[:, sure],
        expected[:, sure],
        TOLERANCE,
        "a colour's channel of",
        at(direction=d[:, sure]),
        "The picture of the differences shows on which faces, and how near to their edges, they are.",
    )


# ---------------------------------------------------------------- lookup_seamless


def _weights_sum(trial: Trial) -> None:
    for size in (1, 2, 5):
        edge, _ = _edges(trial.rng, 10)
        inward = edge * trial.rng.uniform(0.7, 1, edge.shape)
        d = np.concatenate((edge, inward), axis=1).astype(np.float32)
        _check_colors(
            trial,
            np.ones((6, size, size, 3), np.float32),
            d,
            np.ones(d.shape),
            "In a white room everything is white, its corners too: weights sum to 1.",
        )


def _equal_shares(trial: Trial) -> None:
    """Faces of one texel: on an edge two colours meet in equal parts, in a corner three."""
    colors = trial.rng.random((6, 3))
    edge, _ = _edges(trial.rng, 0)
    # In the direction's components, whichever are as large as the largest belong to a face that meets there.
    expected = np.stack(
        [
            np.mean([colors[2 * a + (d[a] < 0)] for a in range(3) if abs(d[a]) == 1], axis=0)
            for d in edge.T
        ],
        axis=1,
    )
    _check_colors(
        trial,
        _plain(colors, 1),
        edge.astype(np.float32),
        expected,
        "In the middle of an edge two texels count the same, and in a corner three.",
    )


def _crossings(rng: np.random.Generator, n: int) -> tuple[Array, Array, Array]:
    """Directions on both sides of the 12 edges, n places on each, and the edges themselves."""
    on, one, other = [], [], []
    for first, second in combinations(range(3), 2):
        (along,) = {0, 1, 2} - {first, second}
        for signs in product((1, -1), repeat=2):
            edge = np.empty((3, n))
            edge[[first, second]] = np.array(signs)[:, None]
            edge[along] = np.concatenate(
                (rng.uniform(-1, 1, n - 4), (-1 + 1e-7, 1 - 1e-7, -0.9, 0.9))
            )
            sides = []
            for axis in (first, second):
                side = edge.copy()
                side[axis] *= 1 - 1e-9
                sides.append(side)
            on.append(edge)
            one.append(sides[0])
            other.append(sides[1])
    return tuple(np.concatenate(part, axis=1) for part in (on, one, other))  # type: ignore[return-value]


def _jumps(trial: Trial, faces: Array) -> tuple[Array, Array, Array]:
    """Colours on one side of the edges and on the other, and the edges."""
    edge, one, other = _crossings(trial.rng, 24)
    n = edge.shape[1]
    found = _colors(trial, faces, np.concatenate((one, other), axis=1))
    return found[:, :n], found[:, n:], edge


def _continuous(trial: Trial) -> None:
    for size in (1, int(trial.rng.choice((2, 3, 4))), 5):
        faces = _random_faces(trial.rng, size, np.float64)
        one, other, edge = _jumps(trial, faces)
        check_close(
            one,
            other,
            1e-7,
            f"in faces of {size} x {size} texels, a step from the other side of an edge, a channel of",
            at(edge=edge),
            "Both sides of an edge have to mix the same texels with the same weights.",
        )


def _near_edges(rng: np.random.Generator, corners: bool) -> tuple[Array, Array]:
    """Random faces, and directions within half a texel of an edge, or of two: not on, but beside them."""
    size, n = int(rng.choice((3, 4, 5, 6))), 900
    face, u, v = _places(rng, n, 0.5 / size)
    near = rng.uniform(1e-3, 0.5, (2, n)) / size
    near = np.where(rng.random((2, n)) < 0.5, near, 1 - near)
    if corners:
        u, v = near
    else:
        swap = rng.random(n) < 0.5
        u, v = np.where(swap, near[0], u), np.where(swap, v, near[1])
    return _random_faces(rng, size), _toward(face, u, v).astype(np.float32)


def _prepare_near(corners: bool, reference: Caller, rng: np.random.Generator) -> dict[str, Array]:
    return {"colors": reference.call("lookup_seamless", *_near_edges(rng, corners))}


def _beside(corners: bool, trial: Trial) -> None:
    faces, d = _near_edges(trial.rng, corners)
    _check_colors(
        trial,
        faces,
        d,
        trial.references["colors"],
        "Three texels meet in a corner; what the missing fourth would weigh is shared out among them."
        if corners
        else "Half a texel from an edge its own face counts alone, on the edge both faces count the same.",
    )


# ---------------------------------------------------------------- mistakes


def _asked(trial: Trial) -> tuple[Array, ...]:
    """Expected face, u, v and the student's."""
    face, u, v = _places(trial.rng, 300, 0.01)
    return (face, u, v, *_face_uv(trial, _toward(face, u, v)))


_same = partial(near, tolerance=1e-9)


def _turned(trial: Trial, turn_u: bool, turn_v: bool) -> set[int]:
    """The faces whose u or v, or both, run the other way; none at all if others are wrong otherwise."""
    face, u, v, found, found_u, found_v = _asked(trial)
    wanted_u, wanted_v = 1 - u if turn_u else u, 1 - v if turn_v else v
    turned = set()
    for number in range(6):
        on = face == number
        if _same(found_u[on], wanted_u[on]) and _same(found_v[on], wanted_v[on]):
            turned.add(number)
        elif not (_same(found_u[on], u[on]) and _same(found_v[on], v[on])):
            return set()
    return turned if (found == face).all() else set()


def _mirrored(trial: Trial) -> bool:
    return len(_turned(trial, True, False)) > 3


def _face_mirrored(trial: Trial) -> bool:
    return 0 < len(_turned(trial, True, False)) <= 3


def _upside_down(trial: Trial) -> bool:
    return len(_turned(trial, False, True)) > 0


def _divided_by_signed(trial: Trial) -> bool:
    return _turned(trial, True, True) == {1, 3, 5}


def _u_for_v(trial: Trial) -> bool:
    face, u, v, found, found_u, found_v = _asked(trial)
    return bool((found == face).all() and _same(found_u, v) and _same(found_v, u))


def _not_halved(trial: Trial) -> bool:
    _, u, v, _, found_u, found_v = _asked(trial)
    return _same(found_u, 2 * u - 1) and _same(found_v, 2 * v - 1)


def _sign_ignored(trial: Trial) -> bool:
    face, _, _, found, _, _ = _asked(trial)
    return bool((found == face - face % 2).all() or (found == face // 2).all())


def _renumbered(trial: Trial) -> list[int]:
    """The student's number of each face, if u and v are right and each face has a number of its own."""
    face, u, v, found, found_u, found_v = _asked(trial)
    numbers = [set(found[face == number].tolist()) for number in range(6)]
    if not (_same(found_u, u) and _same(found_v, v)) or any(len(n) != 1 for n in numbers):
        return []
    order = [int(n.pop()) for n in numbers]
    return order if len(set(order)) == 6 else []


def _two_swapped(trial: Trial) -> bool:
    order = _renumbered(trial)
    return len(order) == 6 and sum(a != b for a, b in enumerate(order)) == 2


def _reordered(trial: Trial) -> bool:
    order = _renumbered(trial)
    return len(order) == 6 and sum(a != b for a, b in enumerate(order)) > 2


def _other_ties(trial: Trial) -> bool:
    face, u, v, found, found_u, found_v = _asked(trial)
    if not ((found == face).all() and _same(found_u, u) and _same(found_v, v)):
        return False
    d, expected = _edges(trial.rng, 2)
    on_edge = _face_uv(trial, d)[0]
    fits = np.abs(d)[on_edge.astype(int).clip(0, 5) // 2, np.arange(len(on_edge))] == 1
    return bool(fits.all() and (on_edge != expected).any())


SIZE = 8
"""Of the faces that tell where a student's lookup has looked."""


def _looked(trial: Trial, face: Array, u: Array, v: Array, dtype: Any = np.float64) -> Array:
    """Where the student's lookup looks, as (u, v, face): the texels of these faces say where they are."""
    number, column, row = _centers(SIZE)
    faces = _painted(np.stack((column, row, number)), SIZE, dtype)
    return _colors(trial, faces, _toward(face, u, v).astype(dtype))


def _map_wrong(trial: Trial) -> bool:
    """Whether the student's face_and_uv is to blame for what the lookup does."""
    face, u, v = _places(trial.rng, 300, 0.01)
    d = _toward(face, u, v)
    found = trial.call_other("face_and_uv", d / np.linalg.norm(d, axis=0))
    return not all(_same(a, b) for a, b in zip(_three(found), (face, u, v), strict=True))


def _inside_right(trial: Trial) -> bool:
    face, u, v = _inner_places(trial.rng, 120, SIZE)
    return _same(_looked(trial, face, u, v), np.stack((u, v, face)))


def _looks_at(trial: Trial, where: Any) -> bool:
    """Whether the lookup looks at ``where(u, v)`` instead of (u, v), on the right face."""
    face, u, v = _places(trial.rng, 240, 1.0 / SIZE)
    found = _looked(trial, face, u, v)
    return _same(found, np.stack((*where(u, v), face)))


def _nearest(trial: Trial) -> bool:
    def centers(*place: Array) -> list[Array]:
        return [np.floor(x * SIZE) / SIZE + 0.5 / SIZE for x in place]

    return _looks_at(trial, centers)


def _half_texel(trial: Trial) -> bool:
    return any(
        _looks_at(trial, lambda u, v, by=by: (u + by / SIZE, v + by / SIZE))
        for by in (0.5, -0.5, 1.0, -1.0)
    )


def _stretched(trial: Trial) -> bool:
    return _looks_at(
        trial, lambda u, v: ((u * (SIZE - 1) + 0.5) / SIZE, (v * (SIZE - 1) + 0.5) / SIZE)
    )


def _transposed(trial: Trial) -> bool:
    return _looks_at(trial, lambda u, v: (v, u))


def _bottom_up(trial: Trial) -> bool:
    return _looks_at(trial, lambda u, v: (u, 1 - v))


def _at_edge(trial: Trial) -> tuple[Array, Array, Array, Array]:
    """Face, u and v a little inside the left edge, away from corners, and where the lookup looks."""
    face, u, v = _inner_places(trial.rng, 120, SIZE)
    u = trial.rng.uniform(0.05, 0.3, 120) / SIZE
    return face, u, v, _looked(trial, face, u, v)


def _wraps(trial: Trial) -> bool:
    face, u, v, found = _at_edge(trial)
    own = 0.5 + u * SIZE
    mixed = own * 0.5 / SIZE + (1 - own) * (1 - 0.5 / SIZE)
    return _inside_right(trial) and _same(found, np.stack((mixed, v, face)))


def _extrapolates(trial: Trial) -> bool:
    face, u, v, found = _at_edge(trial)
    return _inside_right(trial) and _same(found, np.stack((u, v, face)))


def _stays_inside(trial: Trial) -> bool:
    face, _, v, found = _at_edge(trial)
    clamped = np.full(len(v), 0.5 / SIZE)
    return _inside_right(trial) and _same(found, np.stack((clamped, v, face)))


def _mixes_faces(trial: Trial) -> bool:
    face, _, _, found = _at_edge(trial)
    return _inside_right(trial) and bool((np.abs(found[2] - face) > 0.01).mean() > 0.9)


def _white(trial: Trial) -> tuple[Array, Array]:
    """A white room, looked at by the edges' middles, and by the corners."""
    edge, _ = _edges(trial.rng, 0)
    found = _colors(trial, np.ones((6, SIZE, SIZE, 3)), edge)
    return found[:, :12], found[:, 12:]


def _dark_corners(trial: Trial) -> bool:
    edges, corners = _white(trial)
    return _same(edges, np.ones((3, 12))) and bool((corners < 0.9).all())


def _edge_colors(trial: Trial) -> tuple[Array, Array]:
    """How far from equal shares single texels are mixed: in the edges' middles, and in the corners."""
    edge, _ = _edges(trial.rng, 0)
    colors = trial.rng.random((6, 3))
    found = _colors(trial, _plain(colors, 1, np.float64), edge)
    axes = np.stack([colors[2 * axis + (edge[axis] < 0)].T for axis in range(3)])
    meets = (np.abs(edge) == 1)[:, None]
    off = np.abs(found - (axes * meets).sum(axis=0) / meets.sum(axis=0)).max(axis=0)
    return off[:12], off[12:]


def _corner_filled(trial: Trial) -> bool:
    white = np.concatenate(_white(trial), axis=1)
    edges, corners = _edge_colors(trial)
    return bool(_same(white, np.ones((3, 20))) and edges.max() < 1e-9 and corners.max() > 0.01)


def _other_place(trial: Trial) -> bool:
    if max(off.max() for off in _edge_colors(trial)) > 1e-9 or not _inside_right(trial):
        return False
    one, other, _ = _jumps(trial, _random_faces(trial.rng, SIZE, np.float64))
    return bool(np.abs(one - other).max() > 0.01)


def _of_lookup(function: str) -> tuple[Check, ...]:
    """The checks that both lookups have."""
    make = partial(Check, function)
    return (
        make(
            "contract",
            "Colours are (3, N) and of the directions' dtype, for no rays and single texels too",
            _lookup_contract,
            "contract",
        ),
        make("untouched", "faces and directions are only read", _lookup_untouched, "contract", 0.5),
        make(
            "refuses",
            "Faces and directions of other shapes are refused",
            _lookup_refuses,
            "contract",
            0.5,
        ),
        make("own-face", "Each direction sees the face that it leaves through", _own_face),
        make("centres", "The centre of a texel shows that texel", _texel_centers),
        make("linear", "A smooth ramp on a face stays one", _linear),
        make("length", "The direction's length doesn't matter", _lookup_length, points=0.5),
        make(
            "mean",
            "Each face takes a sixth of the sphere",
            _mean,
            "distribution",
            false_fail=3 * FALSE_FAIL,
        ),
        make(
            "all-around",
            "The surroundings of random texels look right in all directions",
            _all_around,
            prepare=partial(_prepare_around, function),
        ),
    )


def _mistakes_of_lookup(function: str) -> tuple[Mistake, ...]:
    """The mistakes that are made in both lookups."""
    return (
        Mistake(
            function,
            f"{function}-map",
            "Your face_and_uv isn't right yet, and this lookup most likely builds on it; mend that one first.",
            _map_wrong,
        ),
        Mistake(
            function,
            f"{function}-nearest",
            "You show the nearest texel alone, so the sky is made of squares; mix the four around the place.",
            _nearest,
        ),
        Mistake(
            function,
            f"{function}-half-texel",
            "Your picture is shifted by half a texel or a whole one; whole numbers should be texels'"
            " centres, which are half a texel from the texels' edges.",
            _half_texel,
        ),
        Mistake(
            function,
            f"{function}-stretched",
            "You stretch the face so that the outermost texels' centres lie on its edges; they should lie"
            " half a texel inside.",
            _stretched,
        ),
        Mistake(
            function,
            f"{function}-transposed",
            "Rows and columns are mixed up: u counts columns, v counts rows, and rows come first in the array.",
            _transposed,
        ),
        Mistake(
            function,
            f"{function}-upside-down",
            "Your faces are upside down; row 0 is the top row, and v is measured down from it.",
            _bottom_up,
        ),
        Mistake(
            function,
            f"{function}-wraps",
            "Near its edge your face is mixed with its own opposite edge; the texel beyond the edge is not"
            " the one at the other end.",
            _wraps,
        ),
        Mistake(
            function,
            f"{function}-extrapolates",
            "Near its edge your face goes on as a ramp, beyond the colours of its texels; the weights must"
            " stay between 0 and 1.",
            _extrapolates,
        ),
    )


CHECKS = ModuleChecks(
    MODULE,
    checks=(
        Check(
            "face_and_uv",
            "contract",
            "face is of integers, u and v are of the direction's dtype, for no rays too",
            _faces_contract,
            "contract",
        ),
        Check(
            "face_and_uv",
            "untouched",
            "The direction is only read",
            _faces_untouched,
            "contract",
            0.5,
        ),
        Check(
            "face_and_uv",
            "refuses",
            "Directions of another shape are refused",
            _faces_refuses,
            "contract",
            0.5,
        ),
        Check("face_and_uv", "middles", "The six axes meet the middles of faces 0 to 5", _middles),
        Check("face_and_uv", "faces", "Each direction has the face it leaves through", _faces),
        Check("face_and_uv", "uv", "u and v are those of OpenGL's table", _uv, points=2.0),
        Check("face_and_uv", "ties", "On edges and corners x comes first, then y", _ties),
        Check("face_and_uv", "range", "u and v stay in [0, 1], at the edges too", _range),
        Check(
            "face_and_uv",
            "length",
            "The direction's length doesn't matter",
            _faces_length,
            points=0.5,
        ),
        *_of_lookup("lookup"),
        Check(
            "lookup", "clamped", "Near its edge a face goes on with its outermost texels", _clamped
        ),
        Check(
            "lookup",
            "one-texel",
            "A face of a single texel is that colour",
            _single_texel,
            points=0.5,
        ),
        *_of_lookup("lookup_seamless"),
        Check(
            "lookup_seamless",
            "white-room",
            "In a white room everything is white, corners too",
            _weights_sum,
        ),
        Check(
            "lookup_seamless",
            "equal-shares",
            "On an edge two texels count the same, in a corner three",
            _equal_shares,
        ),
        Check(
            "lookup_seamless",
            "continuous",
            "All 24 ways across an edge are without a jump",
            _continuous,
            points=2.0,
        ),
        Check(
            "lookup_seamless",
            "edges",
            "Beside an edge the neighbour's texels are mixed in by their distance",
            partial(_beside, False),
            prepare=partial(_prepare_near, False),
        ),
        Check(
            "lookup_seamless",
            "corners",
            "Beside a corner the weights of three texels are renormalised",
            partial(_beside, True),
            prepare=partial(_prepare_near, True),
        ),
    ),
    mistakes=(
        Mistake(
            "face_and_uv",
            "sign-ignored",
            "You name the axis but not its side: + and - faces are different, and numbered in turn.",
            _sign_ignored,
        ),
        Mistake(
            "face_and_uv",
            "two-faces-swapped",
            "Two of your faces have changed places; the order is +x, -x, +y, -y, +z, -z.",
            _two_swapped,
        ),
        Mistake(
            "face_and_uv",
            "other-order",
            "Your faces are numbered in another order; it is +x, -x, +y, -y, +z, -z.",
            _reordered,
        ),
        Mistake(
            "face_and_uv",
            "mirrored",
            "Your faces are mirror images; OpenGL's u runs to the right as seen from outside the cube.",
            _mirrored,
        ),
        Mistake(
            "face_and_uv",
            "face-mirrored",
            "Some of your faces, but not all, are mirror images; compare the signs of u in the table.",
            _face_mirrored,
        ),
        Mistake(
            "face_and_uv",
            "upside-down",
            "Some or all of your faces are upside down; v is measured down from the top row.",
            _upside_down,
        ),
        Mistake(
            "face_and_uv",
            "signed-divisor",
            "Your faces on the negative sides are turned by half a turn, as if divided by the largest"
            " component with its sign.",
            _divided_by_signed,
        ),
        Mistake(
            "face_and_uv",
            "u-for-v",
            "You have u and v the other way round.",
            _u_for_v,
        ),
        Mistake(
            "face_and_uv",
            "not-halved",
            "Your u and v run from -1 to 1; they should run from 0 to 1.",
            _not_halved,
        ),
        Mistake(
            "face_and_uv",
            "other-ties",
            "Inside the faces you are right, but on edges and corners another face than agreed gets the"
            " direction: x comes first, then y.",
            _other_ties,
        ),
        *_mistakes_of_lookup("lookup"),
        Mistake(
            "lookup",
            "mixes-faces",
            "Near an edge you mix in the neighbouring face; this lookup stays on its own, the seamless one"
            " comes next.",
            _mixes_faces,
        ),
        *_mistakes_of_lookup("lookup_seamless"),
        Mistake(
            "lookup_seamless",
            "stays-inside",
            "Your lookup stays on its own face at the edge, so the cube's edges show; beyond an edge lies"
            " the neighbouring face.",
            _stays_inside,
        ),
        Mistake(
            "lookup_seamless",
            "dark-corners",
            "Your corners are too dark: the fourth texel that isn't there has left its weight unused.",
            _dark_corners,
        ),
        Mistake(
            "lookup_seamless",
            "corner-filled",
            "You fill the gap in the cube's corner with some texel, but there are only three; they share"
            " its weight.",
            _corner_filled,
        ),
        Mistake(
            "lookup_seamless",
            "other-place",
            "Beyond the edge you find the right face, but not the texel at the same place along the edge.",
            _other_place,
        ),
    ),
)
