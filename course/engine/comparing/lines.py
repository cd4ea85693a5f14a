"""Movements of single rows and columns along themselves: what is wrong in one line is diluted in any square window.

Nothing else is summed over lines. Where an edge lies along a row, samples that are spread evenly meet what is behind it
equally often in nearly all of its pixels, and more samples a little more or less often: then all differences of a row
may have one sign.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from course.engine.comparing.fields import KINDS
from course.engine.comparing.windows import Field, Sum, Window, p_value, t_of
from course.engine.core.types import Floats64

ACROSS, DOWN = KINDS.index("moved across"), KINDS.index("moved down")


class Lines:
    """Sums of slopes times differences over all rows and columns."""

    def __init__(self) -> None:
        self._rows: list[Floats64] = []
        self._columns: Floats64 | float = 0.0

    def add(self, fields: Sequence[Field], own: slice) -> None:
        """Those of a strip, whose own rows are some of the fields'; strips come from above to below."""
        self._rows.append(fields[ACROSS].lines(own, 1))
        self._columns = self._columns + fields[DOWN].lines(own, 0)

    def largest(self, inflation: float) -> Iterator[Sum]:
        """The most significant row, and column; the p-values are corrected for their numbers."""
        rows, columns = np.concatenate(self._rows, axis=1), np.asarray(self._columns)
        height, width = rows.shape[1], columns.shape[1]
        for field, sums in ((ACROSS, rows), (DOWN, columns)):
            t = t_of(sums[None], sums[None, 1].sum(axis=1), inflation)[0]
            at = int(np.abs(t).argmax())
            place = Window(0, at, width, 1) if field == ACROSS else Window(at, 0, 1, height)
            yield Sum(field, float(t[at]), min(1.0, len(t) * p_value(float(t[at]))), place, False)
