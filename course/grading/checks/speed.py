"""Speed: advice, never points. A function is timed in turn with the reference solution, both through a worker."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Trial

SLOW = 10.0
"""Times the reference's time from which a note is made."""

N = 16384
ROUNDS = 3

Arguments = Callable[[np.random.Generator], tuple[Any, ...]]


def _speed(function: str, arguments: Arguments) -> Check:
    def run(trial: Trial) -> None:
        given = arguments(trial.rng)
        if trial.yardstick is None:
            # Nothing to compare with; but what gives no value has not passed.
            trial.call(*given)
            return
        times: tuple[list[float], list[float]] = ([], [])
        for _ in range(ROUNDS):
            for caller, kept in zip((trial.caller, trial.yardstick), times, strict=True):
                started = perf_counter()
                caller.call(function, *given)
                kept.append(perf_counter() - started)
        yours, reference = min(times[0]), min(times[1])
        if yours > SLOW * reference:
            trial.notes.append(
                f"It takes {yours / reference:.0f} times as long as the reference ({yours * 1e3:.0f} ms for {N} rays): "
                "whole arrays instead of loops would help."
            )

    return Check(
        function, "speed", "Its time beside the reference's (advice)", run, kind="speed", points=0
    )


def _u(rows: int) -> Arguments:
    return lambda rng: (_units(rng, rows),)


def _units(rng: np.random.Generator, rows: int) -> Array:
    return rng.random((rows, N), np.float32)


def _directions(rng: np.random.Generator) -> Array:
    d = rng.standard_normal((3, N)).astype(np.float32)
    unit: Array = d / np.sqrt((d * d).sum(axis=0))
    return unit


def _faces(rng: np.random.Generator) -> Array:
    return rng.random((6, 64, 64, 3), np.float32)


_CORNER, _U, _V = (0.0, 2.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
_AXES = (
    np.array([1, 0, 0], np.float32),
    np.array([0, 1, 0], np.float32),
    np.array([0, 0, -1], np.float32),
)


def _lens(rng: np.random.Generator) -> tuple[Any, ...]:
    directions = _directions(rng)
    directions[2] = -np.abs(directions[2]) - np.float32(0.1)
    directions /= np.sqrt((directions * directions).sum(axis=0))
    return np.zeros(3, np.float32), *_AXES, directions, _units(rng, 2) * np.float32(0.1), 4.0


def _down(rng: np.random.Generator) -> tuple[Array, Array]:
    """Directions of travel, and normals that they come from the outside of."""
    directions, normals = _directions(rng), _directions(rng)
    below = (directions * normals).sum(axis=0) > 0
    directions[:, below] *= -1
    return directions, normals


def _cosines(rng: np.random.Generator) -> Array:
    cosines: Array = _units(rng, 1)[0]
    return cosines


def _through(rng: np.random.Generator) -> tuple[Any, ...]:
    """Directions beyond the boundary, as ``jitter_refraction`` takes them."""
    return *_down(rng), 0.2, _units(rng, 2)


def _cells(rng: np.random.Generator) -> tuple[Array, ...]:
    low, size = _units(rng, 2), _units(rng, 2)
    return low[0], low[1], low[0] + size[0], low[1] + size[1]


def _patterns(rng: np.random.Generator) -> tuple[Any, ...]:
    patterns = tuple(rng.random((2, 64), np.float32) for _ in range(4))
    return patterns, rng.integers(0, 64, N), rng


def _numbers(rng: np.random.Generator) -> Array:
    return rng.integers(0, 1 << 20, N)


_P1, _P2, _P3 = (np.array(p, np.float32) for p in ((0, 0, 0), (2, 0, 0), (0, 0, 1)))
_UV = tuple(np.array(p, np.float32) for p in ((0, 0), (1, 0), (0, 1)))


SPEEDS: dict[str, tuple[Check, ...]] = {
    "supersampling": (
        _speed("regular", lambda _: (4, N // 16)),
        _speed("random", lambda rng: (4, N // 16, rng)),
        _speed("jittered", lambda rng: (4, N // 16, rng)),
        _speed("gaussian_weights", lambda rng: (_units(rng, 2).reshape(2, -1, 16),)),
        _speed(
            "resolve",
            lambda rng: (_units(rng, 3).reshape(3, -1, 16), _units(rng, 1).reshape(-1, 16)),
        ),
    ),
    "soft_shadows": (
        _speed("light_grid", lambda _: (_CORNER, _U, _V, 64)),
        _speed("point_on_rectangle", lambda rng: (_CORNER, _U, _V, _units(rng, 2))),
        _speed("point_on_sphere", lambda rng: (_CORNER, 0.5, _units(rng, 2))),
        _speed("point_in_ball", lambda rng: (_CORNER, 0.5, _units(rng, 3))),
        _speed(
            "point_on_facing_disk", lambda rng: (_CORNER, 0.5, _directions(rng), _units(rng, 2))
        ),
    ),
    "glossy": (
        _speed("orthonormal_basis", lambda rng: (_directions(rng),)),
        _speed("jitter_on_plane", lambda rng: (_directions(rng), 0.3, _units(rng, 2))),
        _speed("jitter_in_ball", lambda rng: (_directions(rng), 0.3, _units(rng, 3))),
        _speed("sample_phong_lobe", lambda rng: (_directions(rng), 50.0, _units(rng, 2))),
        _speed("keep_above", lambda rng: (_directions(rng), _directions(rng))),
    ),
    "thin_lens": (
        _speed("point_on_disk", _u(2)),
        _speed("lens_rays", _lens),
        _speed("circle_of_confusion", lambda rng: (1 + _units(rng, 1)[0], 0.1, 1.5)),
    ),
    "motion_blur": (
        _speed("shutter_times", lambda rng: (0.0, 1.0, _units(rng, 1)[0])),
        _speed("displacement", lambda rng: (_CORNER, _units(rng, 1)[0])),
        _speed("to_object_space", lambda rng: (_units(rng, 3), _CORNER, _units(rng, 1)[0])),
    ),
    "cube_map": (
        _speed("face_and_uv", lambda rng: (_directions(rng),)),
        _speed("lookup", lambda rng: (_faces(rng), _directions(rng))),
        _speed("lookup_seamless", lambda rng: (_faces(rng), _directions(rng))),
    ),
    "sampling": (
        _speed("disk_by_rejection", lambda rng: (N, rng)),
        _speed("disk_by_polar", _u(2)),
        _speed("ball_by_rejection", lambda rng: (N, rng)),
        _speed("ball_by_polar", _u(3)),
        _speed("sphere_by_polar", _u(2)),
        _speed("xorshift32", lambda rng: (rng.integers(1, 1 << 32, N, np.uint32),)),
    ),
    "importance_sampling": (
        _speed("uniform_hemisphere", _u(2)),
        _speed("cosine_hemisphere", _u(2)),
        _speed("cosine_hemisphere_pdf", lambda rng: (_cosines(rng),)),
        _speed("phong_lobe_pdf", lambda rng: (_cosines(rng), 20.0)),
        _speed("estimate", lambda rng: (_units(rng, 3), 1 + _cosines(rng))),
        _speed("power_heuristic", lambda rng: (_cosines(rng), 1 + _cosines(rng))),
    ),
    "blurred_transparency": (
        _speed("refract", lambda rng: (*_down(rng), 1 / 1.5)),
        _speed("jitter_refraction", _through),
        _speed("fresnel", lambda rng: (_cosines(rng), 1 / 1.5)),
    ),
    "adaptive_sampling": (
        _speed("needs_subdivision", lambda rng: (_units(rng, 12).reshape(3, 4, N), 0.5)),
        _speed("subdivide", _cells),
    ),
    "textures": (
        _speed("rectangle_uv", lambda rng: (_units(rng, 3), _P1, _P2, _P3)),
        _speed("sphere_uv", lambda rng: (_directions(rng), _P1)),
        _speed("triangle_uv", lambda rng: (_units(rng, 3), *_UV)),
        _speed("texture_lookup", lambda rng: (_faces(rng)[0], 4 * _units(rng, 2))),
    ),
    "quasi_monte_carlo": (
        _speed("radical_inverse", lambda rng: (3, _numbers(rng))),
        _speed("halton", lambda rng: (_numbers(rng), 4)),
        _speed("hammersley", lambda _: (N, 4)),
        _speed("chain", _patterns),
    ),
    "path_tracing": (
        _speed("diffuse_bounce", lambda rng: (_directions(rng), _units(rng, 2))),
        _speed("throughput", lambda rng: (_units(rng, 3), _units(rng, 3))),
        _speed("russian_roulette", lambda rng: (_units(rng, 3), _cosines(rng))),
    ),
}
"""By module; the functions that walk trees or make whole matrices, `traverse` and its kin, have none."""
