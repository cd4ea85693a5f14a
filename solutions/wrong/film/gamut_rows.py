"""Rows scaled, not columns."""

import numpy as np

FUNCTION = "convert_gamut"
CAUGHT_BY = "white"
MISTAKE = "scaled-by-rows"
SAYS = "You scale the rows X, Y and Z: each primary, a column, has its amount."


def convert_gamut(rgb, source, target):
    """With a mistake."""
    _check_batch("rgb", rgb)
    for name, gamut in (("source", source), ("target", target)):
        if np.shape(gamut) != (2, 4):
            raise ValueError(f"{name} must have shape (2, 4), got {np.shape(gamut)}")
    colors = [np.stack((x, y, 1 - x - y)) / y for x, y in np.array((source, target), float)]
    first, second = (c[:, :3] * np.linalg.solve(c[:, :3], c[:, 3])[:, None] for c in colors)
    return (np.linalg.solve(second, first)).astype(rgb.dtype) @ rgb
