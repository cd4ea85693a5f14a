"""Gather table rows by number into (k, N) arrays.

Neighbouring rays hit neighbouring triangles, but in memory those are far apart: one row of k numbers is one cache
line, k separate columns are k of them. Gathering rows and transposing them takes a fifth of the time of gathering
columns (measured on 80,000 triangles: 6 against 28 ns a hit for 9 columns); wider rows than 12 transpose slowly.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats32


def gather(table: Floats32, number: NDArray[np.integer[Any]]) -> Floats32:
    """Rows of a table as columns.

    Parameters
    ----------
    table : (T, k) float32
    number : (N,) integer, rows of the table

    Returns
    -------
    (k, N) float32, C-contiguous and the caller's own
    """
    return np.ascontiguousarray(table.take(number, axis=0).T)
