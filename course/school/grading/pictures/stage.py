"""The pipeline around one student function: what else a small scene needs of the same module is not the student's.

So a picture is wrong for one function only. What comes before the function on a ray's way is replayed from a tape that
the reference solution has recorded: it doesn't depend on the student's result. What comes after it has a stand-in that
needs no solution: the same for the reference picture, so that only the function in question can make a difference.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Caller
from course.school.grading.checks.declare import declared_function


def _mean(radiance: Array, weights: Array) -> Array:
    """The pixel's mean; weights are all alike where the filter is the box."""
    wide = np.broadcast_to(weights, radiance.shape)
    mean: Array = np.average(radiance, axis=-1, weights=wide).astype(radiance.dtype)
    return mean


def _as_it_is(directions: Array, _: Array) -> Array:
    """Below the surface stays below."""
    return directions


def _gone(velocity: Array, time: Array) -> Array:
    distance: Array = np.multiply.outer(np.asarray(velocity, time.dtype), time)
    return distance


def _seen(origins: Array, velocity: Array, time: Array) -> Array:
    return origins - _gone(velocity, time)


def _pattern(_: Array, uv: Array) -> Array:
    """Colours that repeat as a picture would, smooth everywhere."""
    waves = np.array([[1, 0], [0, 1], [2, 1]], uv.dtype) @ uv
    return (0.5 + 0.4 * np.cos(2 * np.pi * waves)).astype(uv.dtype)


def _a_tenth(cosines: Array, _: Array) -> Array:
    """So much is reflected at any angle."""
    return np.full_like(cosines, 0.1)


def _clear(directions: Array, *_: Any) -> Array:
    """Glass that isn't frosted."""
    return directions


def _not_as_bright(corners: Array, threshold: float) -> Array:
    """Cells with corners that differ in brightness; colours are not looked at."""
    brightness = corners.mean(axis=0)
    differ: Array = np.abs(brightness - brightness.mean(axis=0)).max(axis=0) > threshold / 2
    return differ


def _around(x0: Array, y0: Array, x1: Array, y1: Array) -> tuple[Array, ...]:
    """Four children that go around the cell."""
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    children = (x, y, x1, y1), (x0, y, x, y1), (x0, y0, x, y), (x, y0, x1, y)
    return tuple(np.stack(side) for side in zip(*children, strict=True))


STAND_INS: dict[str, Callable[..., Any]] = {
    "supersampling.resolve": _mean,
    "glossy.keep_above": _as_it_is,
    "textures.texture_lookup": _pattern,
    "blurred_transparency.fresnel": _a_tenth,
    "blurred_transparency.jitter_refraction": _clear,
    "adaptive_sampling.needs_subdivision": _not_as_bright,
    "adaptive_sampling.subdivide": _around,
    "motion_blur.displacement": _gone,
    "motion_blur.to_object_space": _seen,
}
"""In a form that does for the grader's scenes: functions that come last on a ray's way, and those that hang on others'
results, so that no tape can play them."""


class Stage:
    """Whose the functions are that a small scene is rendered with: one is somebody's, the others stand-ins.

    Parameters
    ----------
    module : whose functions ``caller`` has
    caller : the student's, or the reference's
    only : the one function that the picture is about
    tape : recorded results of functions that come before it, ``tape/NAME/NUMBER`` -> array, and
        ``tape/NAME/NUMBER/PART`` where a result is a tuple
    recording : where to put results of the others instead, when the caller is the reference
    """

    def __init__(
        self,
        module: str,
        caller: Caller,
        only: str,
        tape: Mapping[str, Array] | None = None,
        recording: dict[str, Array] | None = None,
    ) -> None:
        self._own, self._caller, self._only = module, caller, only
        self._tape, self._recording = tape or {}, recording
        self._played: dict[str, int] = {}

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """The function that the picture is to be made with."""
        if (module, name) == (self._own, self._only):
            path = f"{module}.{name}"
            return lambda *arguments: usable(path, self._caller.call(name, *arguments))
        stand_in = STAND_INS.get(f"{module}.{name}")
        if stand_in is not None:
            return stand_in
        if self._recording is not None:
            return lambda *arguments: self._record(name, self._caller.call(name, *arguments))
        return lambda *_: self._replay(name)

    def _record(self, name: str, value: Any) -> Any:
        assert self._recording is not None
        call = self._next(name)
        if isinstance(value, tuple):
            self._recording |= {f"{call}/{number}": part for number, part in enumerate(value)}
            return tuple(part.copy() for part in value)
        self._recording[call] = value
        return value.copy()

    def _replay(self, name: str) -> Any:
        call = self._next(name)
        if call in self._tape:
            return self._tape[call].copy()
        parts = sum(recorded.startswith(f"{call}/") for recorded in self._tape)
        return tuple(self._tape[f"{call}/{number}"].copy() for number in range(parts))

    def _next(self, name: str) -> str:
        number = self._played.get(name, 0)
        self._played[name] = number + 1
        return f"tape/{name}/{number}"


LARGEST = 1e12
"""Beyond any number in the grader's scenes; the engine can square it in float32."""


def usable(function: str, value: Any) -> Any:
    """A student's value as the engine may use it: its own copy, in float32, no number larger than LARGEST; or bool.

    The gate has seen that it is arrays of finite numbers of the right shapes
    (`course/school/grading/checks/running.py`). A wrong dtype costs where it is checked; here it is made harmless.
    """
    results = declared_function(*function.split(".")).results
    parts = value if len(results) > 1 else (value,)
    arrays = tuple(
        np.array(part, bool)
        if result.dtype is np.bool_
        else np.clip(_wide(part), -LARGEST, LARGEST).astype(np.float32, order="C")
        for result, part in zip(results, parts, strict=True)
    )
    return arrays if len(results) > 1 else arrays[0]


def _wide(part: Array) -> Array:
    """The array, of a dtype that holds LARGEST."""
    holds = part.dtype.kind == "f" and part.dtype.itemsize >= 4
    return part if holds else part.astype(np.float64)
