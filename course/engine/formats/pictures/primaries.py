"""Colours of other primaries than sRGB's, made linear Rec. 709: by way of XYZ, white staying white.

White is adapted by the Bradford transform (Lindbloom, "Chromatic adaptation"; ICC.1:2010, annex E).
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from course.engine.core.types import Floats64

REC709: Final = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
"""x and y of red, green, blue and white; sRGB has the same."""

NEAR: Final = 2e-3
"""Numbers that differ by less are those of Rec. 709, rounded."""

_BRADFORD: Final = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)


def to_rec709(chromaticities: Sequence[float]) -> Floats64 | None:
    """Return the matrix (3, 3) from linear colours of some primaries to those of Rec. 709; None where it is none.

    Raises ValueError where the numbers are no primaries.
    ``chromaticities``: x and y of red, green, blue and white
    """
    given = np.array(chromaticities, np.float64)
    if given.shape != (8,) or not np.isfinite(given).all():
        raise ValueError("expected eight numbers")
    if np.abs(given - REC709).max() < NEAR:
        return None
    source, target = _to_xyz(given), _to_xyz(np.array(REC709))
    cones = (_BRADFORD @ source).sum(axis=1), (_BRADFORD @ target).sum(axis=1)
    if not np.abs(cones[0]).min() > 0:
        raise ValueError("their white is none")
    adapted = np.linalg.inv(_BRADFORD) @ np.diag(cones[1] / cones[0]) @ _BRADFORD
    matrix: Floats64 = np.linalg.inv(target) @ adapted @ source
    if not np.abs(matrix).max() < 1e3:
        raise ValueError("they lie on a line, or nearly so")
    return matrix


def _to_xyz(chromaticities: Floats64) -> Floats64:
    """The matrix (3, 3) from a colour to XYZ, white having a luminance of 1 (SMPTE RP 177)."""
    x, y = chromaticities.reshape(4, 2).T
    if not np.abs(y).min() > 0:
        raise ValueError("one of them has no luminance")
    columns = np.stack([x / y, np.ones(4), (1 - x - y) / y])
    try:
        scale = np.linalg.solve(columns[:, :3], columns[:, 3])
    except np.linalg.LinAlgError:
        raise ValueError("they lie on a line") from None
    return np.asarray(columns[:, :3] * scale)
