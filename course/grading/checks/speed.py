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
        if trial.yardstick is None:
            return
        given = arguments(trial.rng)
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
}
"""By module."""
