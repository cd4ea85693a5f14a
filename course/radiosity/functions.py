"""The student functions that radiosity calls, with a look at what they return."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.core.types import Floats32, Mask
from course.effects import Effects
from course.errors import EffectError


class Functions:
    """The functions of the radiosity module; each is looked up when it is first called."""

    def __init__(self, effects: Effects) -> None:
        self._effects = effects

    def hemicube_form_factors(self, k: int) -> tuple[Floats32, Floats32]:
        """Top (k, k) and side (k / 2, k)."""
        top, side = self._pair("hemicube_form_factors", k)
        return (
            _checked(top, (k, k), "hemicube_form_factors: top"),
            _checked(side, (k // 2, k), "hemicube_form_factors: side"),
        )

    def gather(
        self, radiosity: Floats32, emission: Floats32, reflectance: Floats32, factors: Floats32
    ) -> Floats32:
        """One iteration, (3, P)."""
        value = self._function("gather")(radiosity, emission, reflectance, factors)
        return _checked(value, radiosity.shape, "gather")

    def shoot(
        self,
        radiosity: Floats32,
        unshot: Floats32,
        reflectance: Floats32,
        areas: Floats32,
        factors: Floats32,
        shooter: int,
    ) -> tuple[Floats32, Floats32]:
        """One step, (3, P) each."""
        after, left = self._pair("shoot", radiosity, unshot, reflectance, areas, factors, shooter)
        shape = radiosity.shape
        return _checked(after, shape, "shoot: radiosity"), _checked(left, shape, "shoot: unshot")

    def needs_split(self, corners: Floats32, threshold: float) -> Mask:
        """(n,) bool."""
        value = np.asarray(self._function("needs_split")(corners, threshold))
        if value.shape != corners.shape[2:] or value.dtype != np.bool_:
            raise EffectError(
                f"radiosity.needs_split returned {value.dtype} {value.shape}, expected bool {corners.shape[2:]}"
            )
        return value

    def _function(self, name: str) -> Callable[..., Any]:
        return self._effects.function("radiosity", name)

    def _pair(self, name: str, *arguments: Any) -> tuple[Any, Any]:
        value = self._function(name)(*arguments)
        if not isinstance(value, tuple | list) or len(value) != 2:
            raise EffectError(f"radiosity.{name} returned {type(value).__name__}, expected a pair")
        return value[0], value[1]


def _checked(value: Any, shape: tuple[int, ...], what: str) -> Floats32:
    array = np.asarray(value)
    if array.shape != shape:
        raise EffectError(f"radiosity.{what} has shape {array.shape}, expected {shape}")
    # One sum finds what isn't finite anywhere.
    if not np.isfinite(array.sum(dtype=np.float64)):
        raise EffectError(f"radiosity.{what} holds numbers that are not finite")
    return np.ascontiguousarray(array, np.float32)
