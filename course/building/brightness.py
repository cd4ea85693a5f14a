"""Light as float32 can carry it."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Floats64
from course.formats.yaml.loading import Loaded

BRIGHTEST = 1e20
"""Above this, light close to a surface would overflow float32 on its way to the film."""


def in_range(color: Floats64, loaded: Loaded, path: tuple[str | int, ...], what: str) -> Floats32:
    """A compiled colour as float32; SceneError where float32 could not carry it."""
    if not (np.abs(color) < BRIGHTEST).all():
        raise loaded.document.error(
            path,
            f"{what} is {color.max():.3g} in units of the scene's size: expected less than {BRIGHTEST:g}",
        )
    return color.astype(np.float32)
