"""The children in one long row."""

import numpy as np

FUNCTION = "subdivide"
CAUGHT_BY = "contract"
MISTAKE = "children-in-a-row"
SAYS = "The children stand in another shape than was agreed."


def subdivide(x0, y0, x1, y1):
    """Four children of each cell."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    dtype = np.result_type(x0, y0, x1, y1)
    x0, y0, x1, y1 = (numbers.astype(dtype) for numbers in (x0, y0, x1, y1))
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    return (
        np.concatenate((x0, x, x0, x)),
        np.stack((y0, y0, y, y)),
        np.stack((x, x1, x, x1)),
        np.stack((y, y, y1, y1)),
    )
