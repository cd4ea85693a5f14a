"""Checks of textures: the places of points on rectangles, spheres and triangles, and the bilinear lookup.

A picture that is a linear ramp tells where a lookup has looked: between texels' centres bilinear filtering is exact.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    contract_checks,
    finite_numbers,
    near,
)
from course.grading.checks.vectors import unit_vectors

TOLERANCE = {np.float32: 2e-5, np.float64: 1e-9}
"""Of coordinates, and of colours no larger than 1 in pictures of a few texels."""

HEIGHT, WIDTH = 40, 60
"""Of the picture that is looked at as a whole."""


# ---------------------------------------------------------------- places and values


def _uv(trial: Trial, *arguments: Any) -> Array:
    """The student's u and v of a batch whose points come first."""
    return finite_numbers(trial.call(*arguments), (2, arguments[0].shape[1]), "u and v")


def _rectangle(rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """A corner and its two neighbours, anyhow in space, sides of different length."""
    a, b = unit_vectors(rng, 2).T
    b -= (a @ b) * a
    b /= np.linalg.norm(b)
    p1 = rng.uniform(-2, 2, 3)
    return p1, p1 + rng.uniform(0.5, 1) * a, p1 + rng.uniform(1.5, 3) * b


def _on_rectangle(corners: tuple[Array, Array, Array], uv: Array) -> Array:
    p1, p2, p3 = (c[:, None] for c in corners)
    return np.asarray(p1 + uv[0] * (p2 - p1) + uv[1] * (p3 - p1))


# ---------------------------------------------------------------- rectangle_uv


def _rectangle_contract(trial: Trial) -> None:
    corners = _rectangle(trial.rng)
    for dtype in DTYPES:
        p = _on_rectangle(corners, trial.rng.random((2, 40))).astype(dtype)
        for single in (np.float32, np.float64):
            points = [c.astype(single) for c in corners]
            for n in (40, 1, 0):
                check_array(trial.call(p[:, :n].copy(), *points), (2, n), dtype, "u and v")


def _rectangle_untouched(trial: Trial) -> None:
    corners = _rectangle(trial.rng)
    p = _on_rectangle(corners, trial.rng.random((2, 40)))
    check_untouched(trial, p, *corners)


def _rectangle_refuses(trial: Trial) -> None:
    corners = _rectangle(trial.rng)
    p = _on_rectangle(corners, trial.rng.random((2, 4)))
    for bad in (p[:2], p[0], p.T):
        check_refused(trial, bad, *corners, named="p")
    for k in range(3):
        for bad in (corners[k][:2], corners[k][:, None]):
            wrong = [bad if i == k else c for i, c in enumerate(corners)]
            check_refused(trial, p, *wrong, named=f"p{k + 1}")
    p1, p2, p3 = corners
    check_refused(trial, p, p1, p1, p3, named="p2, the same as p1")
    check_refused(trial, p, p1, p2, p1, named="p3, the same as p1")


def _rectangle_corners(trial: Trial) -> None:
    for _ in range(5):
        corners = _rectangle(trial.rng)
        expected = np.array([(0, 0), (1, 0), (0, 1), (1, 1), (0.5, 0.5)], float).T
        found = _uv(trial, _on_rectangle(corners, expected), *corners)
        for k, name in enumerate(("p1", "p2", "p3", "the corner across from p1", "the middle")):
            check_close(
                found[:, k],
                expected[:, k],
                1e-9,
                f"of u and v at {name}:",
                hint="u goes from p1 to p2, v from p1 to p3.",
            )


def _rectangle_inside(trial: Trial) -> None:
    for dtype in DTYPES:
        corners = _rectangle(trial.rng)
        expected = trial.rng.uniform(-0.5, 1.5, (2, 1000))
        p = _on_rectangle(corners, expected).astype(dtype)
        check_close(
            _uv(trial, p, *corners),
            expected,
            TOLERANCE[dtype],
            "of p = p1 + u (p2 - p1) + v (p3 - p1), the coordinate",
            at(p=p),
            "How far along each edge, in lengths of that edge; beyond the edges too.",
        )


def _rectangle_off(trial: Trial) -> None:
    corners = _rectangle(trial.rng)
    p1, p2, p3 = corners
    expected = trial.rng.random((2, 500))
    normal = np.cross(p2 - p1, p3 - p1)
    p = _on_rectangle(corners, expected) + normal[:, None] * trial.rng.uniform(-0.1, 0.1, 500)
    check_close(
        _uv(trial, p, *corners),
        expected,
        1e-9,
        "beside the plane, that of the nearest point on it:",
        at(p=p),
        "What is at right angles to both edges changes neither u nor v.",
    )


# ---------------------------------------------------------------- sphere_uv


def _on_sphere(uv: Array, radius: Any, center: Array) -> Array:
    """The points at these coordinates, as the task's text defines them."""
    phi, theta = 2 * np.pi * uv[0], np.pi * uv[1]
    s = np.sin(theta)
    return np.asarray(
        center[:, None] + radius * np.stack((s * np.cos(phi), -np.cos(theta), -s * np.sin(phi)))
    )


def _check_round(found: Array, expected: Array, tolerance: float, p: Array, hint: str) -> None:
    """Compare, where u may be off by a whole turn."""
    turned = found.copy()
    turned[0] += np.round(expected[0] - found[0])
    check_close(turned, expected, tolerance, "coordinate (u, v) on the sphere:", at(p=p), hint)


def _everywhere(rng: np.random.Generator, dtype: Any) -> Array:
    """Directions along the axes, in rings around the poles, and anywhere, unit length."""
    rings = [
        (w * np.cos(turn), end, w * np.sin(turn))
        for w in (1e-7, 1e-4, 1e-2)
        for end in (1, -1)
        for turn in rng.uniform(0, 2 * np.pi, 4)
    ]
    axes = np.concatenate((np.eye(3), -np.eye(3)), axis=1)
    return np.concatenate((axes, np.array(rings).T, unit_vectors(rng, 100)), axis=1).astype(dtype)


def _sphere_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        d = _everywhere(trial.rng, dtype)
        for center in (np.zeros(3), np.zeros(3, np.float32), np.array((3.0, -2.0, 1.0))):
            p = np.asarray(2 * d + np.asarray(center)[:, None], dtype)
            for n in (d.shape[1], 1, 0):
                found = check_array(trial.call(p[:, :n].copy(), center), (2, n), dtype, "u and v")
                if n and not (found.min() >= -1e-6 and found.max() <= 1 + 1e-6):
                    raise Failure(
                        "u and v from 0 to 1",
                        f"{found.min():.6g} to {found.max():.6g}",
                        hint="Angles below 0 belong to the same places as those a whole turn up.",
                    )


def _sphere_untouched(trial: Trial) -> None:
    check_untouched(trial, unit_vectors(trial.rng, 40), np.array((0.1, 0.2, 0.3)))


def _sphere_refuses(trial: Trial) -> None:
    p, center = unit_vectors(trial.rng, 4), np.zeros(3)
    for bad in (p[:2], p[0], p.T):
        check_refused(trial, bad, center, named="p")
    for bad in (center[:2], center[:, None]):
        check_refused(trial, p, bad, named="center")


SPHERE_PLACES = {
    "-z": ((0, 0, -1), (0.25, 0.5)),
    "-x": ((-1, 0, 0), (0.5, 0.5)),
    "+z": ((0, 0, 1), (0.75, 0.5)),
    "between +x and -z": ((1, 0, -1), (0.125, 0.5)),
    "between -z and the north pole": ((0, 1, -1), (0.25, 0.75)),
    "between +z and the south pole": ((0, -1, 1), (0.75, 0.25)),
}


def _sphere_known(trial: Trial) -> None:
    for name, (point, expected) in SPHERE_PLACES.items():
        for dtype in DTYPES:
            p = np.array(point, dtype)[:, None] * np.asarray(trial.rng.uniform(0.5, 2), dtype)
            check_close(
                _uv(trial, p, np.zeros(3)),
                np.array(expected)[:, None],
                TOLERANCE[dtype],
                f"of u and v at {name}:",
                hint="u goes once around from +x over -z, v from -y to +y.",
            )
    poles = np.array([(0.0, -1.0, 0.0), (0.0, 1.0, 0.0)]).T
    check_close(
        _uv(trial, poles, np.zeros(3))[1],
        np.array((0.0, 1.0)),
        1e-9,
        "of v at the south pole and at the north pole:",
        hint="v goes from -y to +y.",
    )


def _sphere_all(trial: Trial) -> None:
    for dtype in DTYPES:
        center = trial.rng.uniform(-1, 1, 3)
        uv = trial.rng.random((2, 2000)) * np.array(((1.0,), (0.9,))) + np.array(((0.0,), (0.05,)))
        p = _on_sphere(uv, trial.rng.uniform(0.5, 3, 2000), center).astype(dtype)
        _check_round(
            _uv(trial, p, center),
            uv,
            TOLERANCE[dtype],
            p,
            "Only the direction from the centre matters, not how far the point is.",
        )


def _sphere_poles(trial: Trial) -> None:
    """Rings so near to the poles that an arcus cosine in double precision still tells them apart."""
    v = 10.0 ** trial.rng.uniform(-6, -3, 400)
    v = np.where(np.arange(400) % 2, v, 1 - v)
    uv = np.stack((trial.rng.random(400), v))
    p = _on_sphere(uv, 1.0, np.zeros(3))
    _check_round(
        _uv(trial, p, np.zeros(3)), uv, 1e-7, p, "Next to a pole u still goes once around."
    )


# ---------------------------------------------------------------- triangle_uv


def _weights(rng: np.random.Generator, n: int, dtype: Any = np.float64) -> Array:
    return np.ascontiguousarray(rng.dirichlet((1, 1, 1), n).T, dtype)


def _triangle_contract(trial: Trial) -> None:
    rng = trial.rng
    for dtype in DTYPES:
        w = _weights(rng, 40, dtype)
        for single in (np.float32, np.float64):
            corners = list(rng.random((3, 2)).astype(single))
            for n in (40, 1, 0):
                check_array(trial.call(w[:, :n].copy(), *corners), (2, n), dtype, "u and v")
        own = rng.random((3, 2, 40)).astype(dtype)
        for n in (40, 1, 0):
            part = [c[:, :n].copy() for c in own]
            check_array(trial.call(w[:, :n].copy(), *part), (2, n), dtype, "u and v")
    for k in range(4):
        batch = [w.astype(np.float32), *own.astype(np.float32)]
        batch[k] = batch[k].astype(np.float64)
        check_array(trial.call(*batch), (2, 40), np.float64, "u and v of float32 and float64")


def _triangle_untouched(trial: Trial) -> None:
    check_untouched(trial, _weights(trial.rng, 40), *trial.rng.random((3, 2)))
    check_untouched(trial, _weights(trial.rng, 40), *trial.rng.random((3, 2, 40)))


def _triangle_refuses(trial: Trial) -> None:
    w, corners = _weights(trial.rng, 5), list(trial.rng.random((3, 2)))
    for bad in (w[:2], w[0], w.T):
        check_refused(trial, bad, *corners, named="barycentric")
    for k in range(3):
        for bad in (np.ones(3), np.ones((2, 4)), np.ones((5, 2)), np.ones((3, 5))):
            wrong = [bad if i == k else c for i, c in enumerate(corners)]
            check_refused(trial, w, *wrong, named=f"uv{k}")


def _triangle_corners(trial: Trial) -> None:
    corners = trial.rng.random((3, 2))
    found = _uv(trial, np.eye(3), *corners)
    for k in range(3):
        check_close(
            found[:, k],
            corners[k],
            0.0,
            f"where only corner {k} weighs, exactly uv{k}:",
            hint="Row 0 of barycentric is the weight of uv0, and so on.",
        )
    middle = _uv(trial, np.full((3, 1), 1 / 3), *corners)[:, 0]
    check_close(middle, corners.mean(axis=0), 1e-12, "in the triangle's middle, the corners' mean")


def _triangle_inside(trial: Trial) -> None:
    for dtype in DTYPES:
        corners = trial.rng.uniform(-2, 2, (3, 2))
        w = _weights(trial.rng, 500, dtype)
        expected = np.einsum("kn,kc->cn", w.astype(np.float64), corners)
        check_close(
            _uv(trial, w, *corners),
            expected,
            TOLERANCE[dtype],
            "the corners' coordinate, weighted:",
            at(barycentric=w),
        )


def _triangle_each(trial: Trial) -> None:
    for dtype in DTYPES:
        corners = trial.rng.random((3, 2, 500)).astype(dtype)
        # As many points as coordinates, too: shapes alone must not decide what is meant.
        for n in (500, 2, 3):
            w = _weights(trial.rng, n, dtype)
            part = [c[:, :n].copy() for c in corners]
            expected = np.einsum("kn,kcn->cn", w.astype(np.float64), np.stack(part))
            check_close(
                _uv(trial, w, *part),
                expected,
                TOLERANCE[dtype],
                "where each point has a triangle of its own, the corners' coordinate, weighted:",
                at(barycentric=w),
                "Column by column: the weights of a point and the corners of its triangle.",
            )


# ---------------------------------------------------------------- texture_lookup


def _centers(height: int, width: int) -> Array:
    """Where the texels' centres are, u and v (2, H, W)."""
    j, i = np.indices((height, width))
    return np.stack(((i + 0.5) / width, 1 - (j + 0.5) / height))


def _inner(rng: np.random.Generator, height: int, width: int, n: int) -> Array:
    """Places between texels' centres, none near the edges."""
    u = rng.uniform(0.5 / width, 1 - 0.5 / width, n)
    v = rng.uniform(0.5 / height, 1 - 0.5 / height, n)
    return np.stack((u, v))


def _size(rng: np.random.Generator) -> tuple[int, int]:
    """Height and width, not the same."""
    return int(rng.integers(3, 6)), int(rng.integers(7, 12))


def _looked(trial: Trial, image: Array, uv: Array) -> Array:
    return finite_numbers(trial.call(image, uv), (3, uv.shape[1]), "the colours")


def _lookup_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        ends = np.array([0, 1, -1, -1e-9, 1e-9, 1 - 1e-8, 1 + 1e-8, 0.5, -1000.25, 1e6])
        uv = np.stack([x.ravel() for x in np.meshgrid(ends, ends)]).astype(dtype)
        for image_dtype in DTYPES:
            for shape in ((1, 1, 3), (1, 4, 3), (5, 1, 3), (4, 7, 3)):
                image = trial.rng.random(shape).astype(image_dtype)
                for n in (uv.shape[1], 1, 0):
                    found = check_array(trial.call(image, uv[:, :n].copy()), (3, n), dtype)
                    if n and not (
                        found.min() >= image.min() - 1e-5 and found.max() <= image.max() + 1e-5
                    ):
                        raise Failure(
                            f"colours between the texels' {image.min():.4g} and {image.max():.4g}",
                            f"{found.min():.4g} to {found.max():.4g}",
                            hint="Weights are from 0 to 1, and sum to 1.",
                        )


def _lookup_untouched(trial: Trial) -> None:
    check_untouched(trial, trial.rng.random((4, 6, 3)), trial.rng.uniform(-2, 2, (2, 40)))


def _lookup_refuses(trial: Trial) -> None:
    image, uv = trial.rng.random((4, 6, 3)), trial.rng.random((2, 5))
    for bad in (image[0], image[:, :, :2], np.moveaxis(image, 2, 0), image[None], image[:0]):
        check_refused(trial, bad, uv, named="image")
    for bad in (uv[:1], uv[0], uv.T):
        check_refused(trial, image, bad, named="uv")


def _check_colors(
    trial: Trial, image: Array, uv: Array, expected: Array, tolerance: float, hint: str
) -> None:
    check_close(
        _looked(trial, image, uv),
        expected,
        tolerance,
        f"in a picture of {image.shape[1]} x {image.shape[0]} texels, a colour's channel of",
        at(uv=uv),
        hint,
    )


def _lookup_centers(trial: Trial) -> None:
    for dtype in DTYPES:
        height, width = _size(trial.rng)
        image = trial.rng.random((height, width, 3)).astype(dtype)
        uv = _centers(height, width).reshape(2, -1).astype(dtype)
        _check_colors(
            trial,
            image,
            uv,
            image.reshape(-1, 3).T,
            TOLERANCE[dtype],
            "At a texel's centre its colour counts alone: column i has it at (i + 1/2) / W, "
            "and v = 1 is at the top.",
        )


def _ramp(rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """A colour and its changes along u and v."""
    start, along_u, along_v = rng.uniform(0.05, 0.4, (3, 3))
    return start, along_u, -along_v * 0.1


def _ramp_at(ramp: tuple[Array, Array, Array], uv: Array) -> Array:
    start, along_u, along_v = ramp
    return np.asarray(
        np.moveaxis(start + uv[0][..., None] * along_u + uv[1][..., None] * along_v, -1, 0)
    )


def _lookup_ramp(trial: Trial) -> None:
    for dtype in DTYPES:
        height, width = _size(trial.rng)
        ramp = _ramp(trial.rng)
        image = np.moveaxis(_ramp_at(ramp, _centers(height, width)), 0, -1).astype(dtype)
        uv = _inner(trial.rng, height, width, 1000).astype(dtype)
        _check_colors(
            trial,
            np.ascontiguousarray(image),
            uv,
            _ramp_at(ramp, uv.astype(np.float64)),
            TOLERANCE[dtype],
            "Where the picture changes evenly, colours between texels do as well.",
        )


def _lookup_middles(trial: Trial) -> None:
    """Half way between four texels all count the same, whatever they are; not so for ramps only."""
    height, width = _size(trial.rng)
    image = trial.rng.random((height, width, 3))
    j, i = (x.ravel() for x in np.indices((height - 1, width - 1)))
    uv = np.stack(((i + 1) / width, 1 - (j + 1) / height))
    four = image[j, i] + image[j, i + 1] + image[j + 1, i] + image[j + 1, i + 1]
    _check_colors(
        trial, image, uv, four.T / 4, 1e-9, "Half way between four texels each weighs a quarter."
    )


def _lookup_wraps(trial: Trial) -> None:
    """On the picture's edges the opposite texels weigh the same."""
    height, width = _size(trial.rng)
    image = trial.rng.random((height, width, 3))
    j, i = np.arange(height), np.arange(width)
    across_u = (image[:, 0] + image[:, -1]).T / 2
    across_v = (image[0] + image[-1]).T / 2
    hint = "Half a texel from an edge the texel at the opposite edge begins to count."
    for edge in (0.0, 1.0):
        uv = np.stack((np.full(height, edge), 1 - (j + 0.5) / height))
        _check_colors(trial, image, uv, across_u, 1e-9, hint)
        uv = np.stack(((i + 0.5) / width, np.full(width, edge)))
        _check_colors(trial, image, uv, across_v, 1e-9, hint)
    corner = image[[0, 0, -1, -1], [0, -1, 0, -1]].mean(axis=0)
    uv = np.array([(0, 0), (1, 0), (0, 1), (1, 1)], float).T
    _check_colors(trial, image, uv, np.repeat(corner[:, None], 4, axis=1), 1e-9, hint)


def _lookup_repeats(trial: Trial) -> None:
    height, width = _size(trial.rng)
    image = trial.rng.random((height, width, 3))
    uv = trial.rng.random((2, 500))
    whole = trial.rng.integers(-5, 6, (2, 500))
    first = _looked(trial, image, uv)
    check_close(
        _looked(trial, image, uv + whole),
        first,
        1e-9,
        "whole numbers away, the same colour's channel of",
        at(uv=uv + whole),
        "The picture goes on beyond its edges, to the left and downwards too.",
    )


def _picture(rng: np.random.Generator) -> tuple[Array, Array]:
    """A small picture, and a look at two by two repetitions of it."""
    image = rng.random((5, 8, 3))
    v, u = np.meshgrid(
        1.5 - 2 * (np.arange(HEIGHT) + rng.uniform(0.3, 0.7)) / HEIGHT,
        -0.5 + 2 * (np.arange(WIDTH) + rng.uniform(0.3, 0.7)) / WIDTH,
        indexing="ij",
    )
    return image, np.stack((u.ravel(), v.ravel()))


def _lookup_picture(trial: Trial) -> None:
    image, uv = _picture(trial.rng)
    found = _looked(trial, image, uv)
    expected = _tents(image, uv)
    shape = (3, HEIGHT, WIDTH)
    trial.show(
        "pictures",
        "A picture of random texels, repeated",
        yours=found.reshape(shape),
        expected=expected.reshape(shape),
    )
    check_close(
        found,
        expected,
        1e-9,
        "a colour's channel of",
        at(uv=uv),
        "The picture of the differences shows where they are.",
    )


def _tents(image: Array, uv: Array) -> Array:
    """The sum of all texels, each weighted with its periodic tents along u and v."""
    height, width, _ = image.shape
    centers = _centers(height, width)

    def tent(place: Array, center: Array, size: int) -> Array:
        apart = place[:, None] - center
        apart -= np.round(apart)
        return np.asarray(np.maximum(1 - np.abs(apart) * size, 0))

    in_u, in_v = tent(uv[0], centers[0, 0], width), tent(uv[1], centers[1, :, 0], height)
    return np.asarray(np.einsum("nj,ni,jic->cn", in_v, in_u, image))


# ---------------------------------------------------------------- mistakes


_near = partial(near, tolerance=1e-6)


def _rectangle_is(
    trial: Trial, model: Callable[[Array, tuple[Array, Array, Array]], Array]
) -> bool:
    for _ in range(2):
        corners = _rectangle(trial.rng)
        uv = trial.rng.random((2, 200))
        if not _near(_uv(trial, _on_rectangle(corners, uv), *corners), model(uv, corners)):
            return False
    return True


def _edge_lengths(corners: tuple[Array, Array, Array]) -> Array:
    p1, p2, p3 = corners
    return np.array(((np.linalg.norm(p2 - p1),), (np.linalg.norm(p3 - p1),)))


def _swapped(trial: Trial) -> bool:
    return _rectangle_is(trial, lambda uv, _c: uv[::-1])


def _in_units(trial: Trial) -> bool:
    return _rectangle_is(trial, lambda uv, c: uv * _edge_lengths(c))


def _squared_lengths(trial: Trial) -> bool:
    return _rectangle_is(trial, lambda uv, c: uv * _edge_lengths(c) ** 2)


def _v_turned(trial: Trial) -> bool:
    return _rectangle_is(trial, lambda uv, _c: np.stack((uv[0], 1 - uv[1]))) or _rectangle_is(
        trial, lambda uv, _c: np.stack((uv[0], -uv[1]))
    )


def _from_origin(trial: Trial) -> bool:
    """As if p were measured from the world's origin instead of from p1."""

    def model(uv: Array, corners: tuple[Array, Array, Array]) -> Array:
        p1, p2, p3 = corners
        edges = np.stack((p2 - p1, p3 - p1))
        return np.asarray(uv + (edges @ p1)[:, None] / _edge_lengths(corners) ** 2)

    return _rectangle_is(trial, model)


def _clamped(trial: Trial) -> bool:
    corners = _rectangle(trial.rng)
    uv = trial.rng.uniform(-0.5, 1.5, (2, 300))
    found = _uv(trial, _on_rectangle(corners, uv), *corners)
    return _near(found, uv.clip(0, 1)) or _near(found, uv - np.floor(uv))


def _sphere_is(trial: Trial, model: Callable[[Array, Array], Array]) -> bool:
    """What comes back is what a mistake makes of the right (u, v) and of the points (3, N)."""
    center = np.array((0.3, -0.2, 0.5))
    uv = trial.rng.uniform(0.1, 0.9, (2, 300))
    p = _on_sphere(uv, 1.5, center)
    off = _uv(trial, p, center) - model(uv, p - center[:, None])
    off[0] -= np.round(off[0])
    return _near(off, np.zeros_like(off))


def _mirrored(trial: Trial) -> bool:
    return _sphere_is(trial, lambda uv, _d: np.stack((-uv[0], uv[1])))


def _upside_down(trial: Trial) -> bool:
    return _sphere_is(trial, lambda uv, _d: np.stack((uv[0], 1 - uv[1])))


def _turned(trial: Trial) -> bool:
    """The seam is elsewhere: u is off by the same part of a turn everywhere."""
    return any(
        _sphere_is(trial, lambda uv, _d, by=by: np.stack((uv[0] + by, uv[1])))  # type: ignore[misc]
        for by in (0.25, 0.5, 0.75)
    )


def _poles_on_z(trial: Trial) -> bool:
    def height(uv: Array, d: Array) -> Array:
        along = np.arcsin(d[2] / np.linalg.norm(d, axis=0)) / np.pi
        return np.stack((uv[0], 0.5 + along))

    center = np.zeros(3)
    p = unit_vectors(trial.rng, 300)
    found = _uv(trial, p, center)[1]
    expected = height(p, p)[1]
    return _near(found, expected) or _near(found, 1 - expected)


def _height_for_angle(trial: Trial) -> bool:
    return _sphere_is(trial, lambda uv, _d: np.stack((uv[0], 0.5 - 0.5 * np.cos(np.pi * uv[1]))))


def _half_around(trial: Trial) -> bool:
    """A quotient's arcus tangent, that knows no quadrants."""
    uv = np.stack((trial.rng.uniform(0.02, 0.98, 300), np.full(300, 0.5)))
    found = _uv(trial, _on_sphere(uv, 1.0, np.zeros(3)), np.zeros(3))[0]
    return any(bool(np.ptp((found + by) % 1) < 0.52) for by in (0.0, 0.25, 0.5))


def _negative(trial: Trial) -> bool:
    uv = np.stack((trial.rng.uniform(0.55, 0.95, 100), np.full(100, 0.4)))
    found = _uv(trial, _on_sphere(uv, 1.0, np.zeros(3)), np.zeros(3))
    return _near(found, uv - np.array(((1.0,), (0.0,))))


def _center_ignored(trial: Trial) -> bool:
    center = np.array((2.0, 1.0, -1.5))
    p = center[:, None] + unit_vectors(trial.rng, 300)
    return _near(_uv(trial, p, center), _uv(trial, p, np.zeros(3)), tolerance=1e-9)


def _triangle_order(trial: Trial) -> bool:
    corners, w = trial.rng.random((3, 2)), _weights(trial.rng, 200)
    found = _uv(trial, w, *corners)
    orders = ((0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0))
    return any(_near(found, np.einsum("kn,kc->cn", w, corners[list(order)])) for order in orders)


def _triangle_parallelogram(trial: Trial) -> bool:
    """The edges from corner 0 are weighted, but corner 0 itself is forgotten."""
    corners, w = trial.rng.random((3, 2)), _weights(trial.rng, 200)
    edges = corners[1:] - corners[0]
    return _near(_uv(trial, w, *corners), np.einsum("kn,kc->cn", w[1:], edges))


def _first_triangle(trial: Trial) -> bool:
    corners, w = trial.rng.random((3, 2, 200)), _weights(trial.rng, 200)
    return _near(_uv(trial, w, *corners), np.einsum("kn,kc->cn", w, corners[:, :, 0]))


def _looks_at(trial: Trial, where: Callable[[Array, int, int], Array]) -> bool:
    """Well inside, the lookup looks at ``where(uv, height, width)`` instead of at uv."""
    height, width = 9, 14
    centers = _centers(height, width)
    image = np.stack((*centers, np.zeros((height, width))), axis=-1)
    uv = trial.rng.uniform(0.25, 0.75, (2, 300))
    return _near(_looked(trial, image, uv)[:2], where(uv, height, width))


def _nearest(trial: Trial) -> bool:
    def centers(uv: Array, height: int, width: int) -> Array:
        size = np.array(((width,), (height,)))
        return np.asarray((np.floor(uv * size) + 0.5) / size)

    return _looks_at(trial, centers)


def _top_down(trial: Trial) -> bool:
    return _looks_at(trial, lambda uv, _h, _w: np.stack((uv[0], 1 - uv[1])))


def _half_texel(trial: Trial) -> bool:
    def shifted(uv: Array, height: int, width: int, by: tuple[float, float]) -> Array:
        return np.stack((uv[0] + by[0] / width, uv[1] + by[1] / height))

    return any(
        _looks_at(trial, lambda uv, h, w, by=(a, b): shifted(uv, h, w, by))  # type: ignore[misc]
        for a in (0.5, -0.5)
        for b in (0.5, -0.5)
    )


def _stretched(trial: Trial) -> bool:
    def model(uv: Array, height: int, width: int) -> Array:
        size = np.array(((width,), (height,)))
        return np.asarray((uv * (size - 1) + 0.5) / size)

    return _looks_at(trial, model)


def _transposed(trial: Trial) -> bool:
    """Told by a square picture, where no index is out of range."""
    image = trial.rng.random((6, 6, 3))
    uv = trial.rng.uniform(0.2, 0.8, (2, 200))
    found = _looked(trial, image, uv)
    turned = image.transpose(1, 0, 2)
    return _near(found, _tents(turned, uv)) or _near(found, _tents(turned[::-1, ::-1], uv))


def _edges(trial: Trial) -> tuple[Array, Array, Array]:
    """A picture, places on its left edge at texels' heights, and what the student sees there."""
    height, width = 5, 8
    image = trial.rng.random((height, width, 3))
    v = 1 - (np.arange(height) + 0.5) / height
    uv = np.stack((np.full(height, 0.0), v))
    return image, uv, _looked(trial, image, uv)


def _edge_clamped(trial: Trial) -> bool:
    image, _, found = _edges(trial)
    return _near(found, image[:, 0].T)


def _beyond_clamped(trial: Trial) -> bool:
    image, uv, _ = _edges(trial)
    beyond = uv + np.array(((3.3,), (0.0,)))
    return _near(_looked(trial, image, beyond), image[:, -1].T)


def _mirror_repeat(trial: Trial) -> bool:
    image = trial.rng.random((5, 8, 3))
    uv = trial.rng.uniform(0.2, 0.8, (2, 100))
    turned = np.stack((2 - uv[0], uv[1]))
    found = _looked(trial, image, turned)
    return _near(found, _tents(image, uv)) and not _near(found, _tents(image, turned))


# ---------------------------------------------------------------- all of them


CHECKS = ModuleChecks(
    "textures",
    checks=(
        *contract_checks(
            "rectangle_uv", _rectangle_contract, _rectangle_untouched, _rectangle_refuses
        ),
        Check("rectangle_uv", "corners", "The corners have their places", _rectangle_corners),
        Check(
            "rectangle_uv",
            "inside",
            "Points have their places, beyond the edges too",
            _rectangle_inside,
        ),
        Check(
            "rectangle_uv", "off_plane", "Points beside the plane count as on it", _rectangle_off
        ),
        *contract_checks("sphere_uv", _sphere_contract, _sphere_untouched, _sphere_refuses),
        Check("sphere_uv", "known", "The axes have their places", _sphere_known),
        Check(
            "sphere_uv",
            "everywhere",
            "Points have their places, at any distance from any centre",
            _sphere_all,
        ),
        Check("sphere_uv", "poles", "Places next to the poles are right", _sphere_poles),
        *contract_checks("triangle_uv", _triangle_contract, _triangle_untouched, _triangle_refuses),
        Check("triangle_uv", "corners", "The corners have their places exactly", _triangle_corners),
        Check("triangle_uv", "inside", "Points weigh the corners' places", _triangle_inside),
        Check("triangle_uv", "each", "Each point may have a triangle of its own", _triangle_each),
        *contract_checks("texture_lookup", _lookup_contract, _lookup_untouched, _lookup_refuses),
        Check(
            "texture_lookup", "centers", "A texel's centre has the texel's colour", _lookup_centers
        ),
        Check("texture_lookup", "ramp", "Linear ramps are exact between texels", _lookup_ramp),
        Check(
            "texture_lookup",
            "middles",
            "Half way between four texels each weighs a quarter",
            _lookup_middles,
        ),
        Check("texture_lookup", "wraps", "At an edge the opposite texels mix in", _lookup_wraps),
        Check(
            "texture_lookup",
            "repeats",
            "Whole numbers away the picture is the same",
            _lookup_repeats,
        ),
        Check(
            "texture_lookup",
            "picture",
            "A repeated picture of random texels is right everywhere",
            _lookup_picture,
        ),
    ),
    mistakes=(
        Mistake(
            "rectangle_uv",
            "swapped",
            "You have u and v the wrong way round: u goes from p1 to p2.",
            _swapped,
        ),
        Mistake(
            "rectangle_uv",
            "in-units",
            "Your u and v are distances; they have to be 1 at the edges' ends, however long those are.",
            _in_units,
        ),
        Mistake(
            "rectangle_uv",
            "not-divided",
            "Your u and v grow with the square of the edges' lengths: a dot product has both lengths in it.",
            _squared_lengths,
        ),
        Mistake(
            "rectangle_uv",
            "v-turned",
            "Your v runs the other way: it is 0 at p1 and 1 at p3.",
            _v_turned,
        ),
        Mistake(
            "rectangle_uv",
            "from-origin",
            "You measure from the world's origin; places on the rectangle are measured from p1.",
            _from_origin,
        ),
        Mistake(
            "rectangle_uv",
            "kept-inside",
            "You keep u and v within 0 and 1; beyond the edges they go on, for the lookup repeats the picture.",
            _clamped,
        ),
        Mistake(
            "sphere_uv",
            "mirrored",
            "Your picture is mirrored: seen from outside, u grows to the right.",
            _mirrored,
        ),
        Mistake(
            "sphere_uv",
            "upside-down",
            "Your picture is upside down: v is 0 at -y and 1 at +y.",
            _upside_down,
        ),
        Mistake("sphere_uv", "turned", "Your picture is turned about y: u begins at +x.", _turned),
        Mistake("sphere_uv", "poles-on-z", "Your poles are on z; they belong on y.", _poles_on_z),
        Mistake(
            "sphere_uv",
            "height-for-angle",
            "Your v grows evenly with the height; it has to with the angle.",
            _height_for_angle,
        ),
        Mistake(
            "sphere_uv",
            "half-around",
            "Your u goes half way around only: a quotient does not know the quadrant.",
            _half_around,
        ),
        Mistake(
            "sphere_uv",
            "negative",
            "Half of your u are negative; they have to be from 0 to 1.",
            _negative,
        ),
        Mistake(
            "sphere_uv",
            "centre-ignored",
            "You take no notice of the centre.",
            _center_ignored,
        ),
        Mistake(
            "triangle_uv",
            "order",
            "Your weights go with the wrong corners.",
            _triangle_order,
        ),
        Mistake(
            "triangle_uv",
            "corner-forgotten",
            "You go along the edges from corner 0, but do not begin there.",
            _triangle_parallelogram,
        ),
        Mistake(
            "triangle_uv",
            "first-triangle",
            "You use the first triangle for all points.",
            _first_triangle,
        ),
        Mistake(
            "texture_lookup",
            "nearest",
            "You take the nearest texel; colours between texels are mixed from four.",
            _nearest,
        ),
        Mistake(
            "texture_lookup",
            "top-down",
            "Your picture is upside down: row 0 is on top, where v is 1.",
            _top_down,
        ),
        Mistake(
            "texture_lookup",
            "half-texel",
            "You look half a texel beside: a texel's centre is half a texel from its border.",
            _half_texel,
        ),
        Mistake(
            "texture_lookup",
            "stretched",
            "You stretch the picture from the first texel's centre to the last one's; it goes from border to border.",
            _stretched,
        ),
        Mistake(
            "texture_lookup",
            "transposed",
            "You have rows and columns the wrong way round: u goes along a row.",
            _transposed,
        ),
        Mistake(
            "texture_lookup",
            "not-repeated",
            "Beyond its edges your picture ends; it has to be repeated.",
            _beyond_clamped,
        ),
        Mistake(
            "texture_lookup",
            "edge-clamped",
            "At the picture's edge only its own texels count; the opposite ones have to mix in.",
            _edge_clamped,
        ),
        Mistake(
            "texture_lookup",
            "mirror-repeat",
            "Every other repetition of your picture is mirrored; all of them are the same.",
            _mirror_repeat,
        ),
    ),
)
