"""Lengths and light as float32 can carry them."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Floats64
from course.formats.yaml.document import KeyPath
from course.formats.yaml.loading import Loaded

FARTHEST = 1e18
"""Sizes of the scene; squares of longer distances would overflow float32."""

BRIGHTEST = 1e20
"""Above this, light close to a surface would overflow float32 on its way to the film."""


def in_reach(x: Floats64, loaded: Loaded, path: KeyPath, what: str) -> Floats32:
    """A compiled position or length as float32; SceneError where it is too far away or too large."""
    return _single(x, FARTHEST, "in sizes of the scene", loaded, path, what)


def in_range(color: Floats64, loaded: Loaded, path: KeyPath, what: str) -> Floats32:
    """A compiled colour as float32; SceneError where it is too bright."""
    return _single(color, BRIGHTEST, "in units of the scene's size", loaded, path, what)


def _single(
    x: Floats64, bound: float, unit: str, loaded: Loaded, path: KeyPath, what: str
) -> Floats32:
    if not (np.abs(x) < bound).all():
        largest = np.abs(x).max()
        raise loaded.document.error(
            path, f"{what} is {largest:.3g} {unit}: expected less than {bound:g}"
        )
    return x.astype(np.float32)
