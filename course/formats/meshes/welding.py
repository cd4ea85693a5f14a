"""Which rows are the same: vertices at one place, or corners equal in all they carry."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def same(*columns: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Group the rows that are equal in every column, exactly; -0.0 equals 0.0.

    Parameters
    ----------
    columns : (N,) arrays of numbers, at least one, without NaN

    Returns
    -------
    first : (G,) intp
        The first row of each group, groups in the order in which they first appear.
    group : (N,) intp
        The group of each row.
    """
    rows = len(columns[0])
    order = np.lexsort(columns[::-1])
    starts = np.zeros(rows, bool)
    starts[:1] = True
    for column in columns:
        ranked = column[order]
        starts[1:] |= ranked[1:] != ranked[:-1]
    # The sort is stable, so that a group's first row in it is its first row of all.
    first = order[starts]
    appearance = np.argsort(first, kind="stable")
    rank = np.empty_like(appearance)
    rank[appearance] = np.arange(len(first))
    group = np.empty(rows, np.intp)
    group[order] = rank[np.cumsum(starts) - 1]
    return first[appearance], group
