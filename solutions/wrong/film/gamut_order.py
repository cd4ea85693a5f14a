"""The matrices in the other order."""

import numpy as np

FUNCTION = "convert_gamut"
CAUGHT_BY = "values"
MISTAKE = "other-order"
SAYS = "You multiply the matrices in the other order: first to XYZ, then from there."


def convert_gamut(rgb, source, target):
    """With a mistake."""
    _check_batch("rgb", rgb)
    for name, gamut in (("source", source), ("target", target)):
        if np.shape(gamut) != (2, 4):
            raise ValueError(f"{name} must have shape (2, 4), got {np.shape(gamut)}")
    colors = [np.stack((x, y, 1 - x - y)) / y for x, y in np.array((source, target), float)]
    first, second = (c[:, :3] * np.linalg.solve(c[:, :3], c[:, 3]) for c in colors)
    return (first @ np.linalg.inv(second)).astype(rgb.dtype) @ rgb
