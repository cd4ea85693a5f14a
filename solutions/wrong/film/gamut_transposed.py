"""The matrix transposed."""

import numpy as np

FUNCTION = "convert_gamut"
CAUGHT_BY = "white"
MISTAKE = "transposed"
SAYS = "Your matrix is transposed: each primary is a column."


def convert_gamut(rgb, source, target):
    """With a mistake."""
    _check_batch("rgb", rgb)
    for name, gamut in (("source", source), ("target", target)):
        if np.shape(gamut) != (2, 4):
            raise ValueError(f"{name} must have shape (2, 4), got {np.shape(gamut)}")
    colors = [np.stack((x, y, 1 - x - y)) / y for x, y in np.array((source, target), float)]
    first, second = (c[:, :3] * np.linalg.solve(c[:, :3], c[:, 3]) for c in colors)
    return (np.linalg.solve(second, first).T).astype(rgb.dtype) @ rgb
