"""Hits by the material that they are on, for what only some materials have."""

from collections.abc import Iterable, Iterator
from typing import Protocol, TypeVar

import numpy as np

from course.engine.core.types import Indices, Materials


class OfMaterial(Protocol):
    """What belongs to one material, whose number it has."""

    @property
    def material(self) -> int:
        """The number."""


T = TypeVar("T", bound=OfMaterial)


def hits_on(things: Iterable[T], material: Materials) -> Iterator[tuple[T, Indices]]:
    """Each thing whose material is hit, and the hits on it; ``material`` (n,) is that of all hits."""
    for thing in things:
        which = np.flatnonzero(material == thing.material)
        if len(which):
            yield thing, which
