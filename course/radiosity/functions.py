"""The student functions that radiosity calls."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from course.core.types import Floats32, Mask
from course.effects import Effects


class Functions:
    """The functions of the radiosity module; each is looked up when it is first called."""

    def __init__(self, effects: Effects) -> None:
        self._effects = effects

    def hemicube_form_factors(self, k: int) -> tuple[Floats32, Floats32]:
        """Top (k, k) and side (k / 2, k)."""
        found: tuple[Floats32, Floats32] = self._function("hemicube_form_factors")(k)
        return found

    def gather(
        self, radiosity: Floats32, emission: Floats32, reflectance: Floats32, factors: Floats32
    ) -> Floats32:
        """One iteration, (3, P)."""
        after: Floats32 = self._function("gather")(radiosity, emission, reflectance, factors)
        return after

    def shoot(
        self,
        radiosity: Floats32,
        unshot: Floats32,
        reflectance: Floats32,
        areas: Floats32,
        factors: Floats32,
        shooter: int,
    ) -> tuple[Floats32, Floats32]:
        """One step: radiosity and what is unshot, (3, P) each."""
        shoot = self._function("shoot")
        after: tuple[Floats32, Floats32] = shoot(
            radiosity, unshot, reflectance, areas, factors, shooter
        )
        return after

    def needs_split(self, corners: Floats32, threshold: float) -> Mask:
        """(n,) bool."""
        chosen: Mask = self._function("needs_split")(corners, threshold)
        return chosen

    def _function(self, name: str) -> Callable[..., Any]:
        return self._effects.function("radiosity", name)
