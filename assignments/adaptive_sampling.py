"""adaptive_sampling - more rays where the picture changes, and few where it does not.

A pixel starts as one cell with a ray through each of its four corners. Where the corners' colours differ too much,
the cell is divided into four, and each child is looked at in the same way. Corners are shared by neighbours, so that
most of a child's rays have been cast already; smooth pixels stay at four rays, and edges get many.
"""

import numpy as np


def needs_subdivision(corners, threshold):
    """Which cells to divide: those with two corners that differ in some channel by more than the threshold.

    Parameters
    ----------
    corners : (3, 4, n) floating
        Radiance of the cells' corners: channels, the four corners in any order, cells.
    threshold : float >= 0
        Largest difference that is left alone.

    Returns
    -------
    (n,) bool
        A difference that is the threshold exactly is left alone.

    Raises
    ------
    ValueError
        corners has another shape, or threshold is not >= 0.

    Task: adaptive_sampling.needs_subdivision. Source: Whitted, "An improved illumination model for shaded display",
    1980.
    """
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    # TODO adaptive_sampling.needs_subdivision: write your solution here
    raise NotImplementedError("adaptive_sampling.needs_subdivision: not written yet")


def subdivide(x0, y0, x1, y1):
    """Divide cells into four children each, at the middle of x and of y.

    The children cover the cell exactly: what lies on its outside is the cell's own x0, y0, x1 or y1, bit for bit, and
    so the corners that two cells or two children share are the same numbers, and need one ray only.

    Parameters
    ----------
    x0, y0, x1, y1 : (n,) floating
        The cells: x from x0 to x1, y from y0 to y1, x0 <= x1 and y0 <= y1.

    Returns
    -------
    x0, y0, x1, y1 : (4, n) each, of the dtype of the arguments, or NumPy's promotion of them
        Row by row, x fastest: child 0 has the lower halves of x and y, child 1 the upper half of x, child 2 the upper
        half of y, and child 3 both upper halves.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: adaptive_sampling.subdivide. Source: Whitted, "An improved illumination model for shaded display", 1980.
    """
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    # TODO adaptive_sampling.subdivide: write your solution here
    raise NotImplementedError("adaptive_sampling.subdivide: not written yet")


def _check_numbers(name, array, columns=None):
    shape = np.shape(array)
    if len(shape) != 1 or (columns is not None and shape[0] != columns):
        expected = f"({'N' if columns is None else columns},)"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")
