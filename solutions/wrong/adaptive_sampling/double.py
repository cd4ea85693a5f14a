"""Returns float64, whatever came."""

import numpy as np

FUNCTION = "subdivide"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def subdivide(x0, y0, x1, y1):
    """Four children of each cell."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    x0, y0, x1, y1 = (np.float64(side) for side in (x0, y0, x1, y1))
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    return (
        np.stack((x0, x, x0, x)),
        np.stack((y0, y0, y, y)),
        np.stack((x, x1, x, x1)),
        np.stack((y, y, y1, y1)),
    )
