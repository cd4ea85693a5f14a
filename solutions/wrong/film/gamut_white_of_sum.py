"""White of X + Y + Z = 1."""

import numpy as np

FUNCTION = "convert_gamut"
CAUGHT_BY = "white"
MISTAKE = "white-not-normalised"
SAYS = "Your white has X + Y + Z = 1: its Y is to be 1."


def convert_gamut(rgb, source, target):
    """With a mistake."""
    _check_batch("rgb", rgb)
    for name, gamut in (("source", source), ("target", target)):
        if np.shape(gamut) != (2, 4):
            raise ValueError(f"{name} must have shape (2, 4), got {np.shape(gamut)}")
    colors = [np.stack((x, y, 1 - x - y)) for x, y in np.array((source, target), float)]
    first, second = (
        c[:, :3] * np.linalg.solve(c[:, :3], c[:, 3] * (1 if c is colors[0] else 1 / c[1, 3]))
        for c in colors
    )
    return (np.linalg.solve(second, first)).astype(rgb.dtype) @ rgb
