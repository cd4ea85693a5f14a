"""Lengths as float32 can carry them."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Floats64
from course.formats.yaml.loading import Loaded

FARTHEST = 1e18
"""Sizes of the scene; squares of longer distances would overflow float32."""


def in_reach(x: Floats64, loaded: Loaded, path: tuple[str | int, ...], what: str) -> Floats32:
    """A compiled position or length as float32.

    Raises
    ------
    SceneError
        It is too far away or too large; names the key ``path`` and says ``what`` it is.
    """
    if not (np.abs(x) < FARTHEST).all():
        raise loaded.document.error(
            path,
            f"{what} is {np.abs(x).max():.3g} in sizes of the scene: expected less than {FARTHEST:g}",
        )
    return x.astype(np.float32)
