"""Sums over single rows and columns of a picture: what is wrong in one of them is diluted in any square window."""

from collections.abc import Iterator, Sequence

import numpy as np

from course.engine.comparing.windows import Field, Sum, Window, p_value, t_of
from course.engine.core.types import Floats64


class Lines:
    """Sums of all fields over all rows and columns; ``height``, ``width``: of the picture [pixels]."""

    def __init__(self, height: int, width: int) -> None:
        self._height, self._width = height, width
        self._rows: list[Floats64] = []
        self._columns: Floats64 | float = 0.0

    def add(self, fields: Sequence[Field], own: slice) -> None:
        """Those of a strip, whose own rows are some of the fields'; strips come from above to below."""
        rows, columns = zip(*(field.lines(own) for field in fields), strict=True)
        self._rows.append(np.stack(rows))
        self._columns = self._columns + np.stack(columns)

    def largest(self, inflation: float) -> Iterator[Sum]:
        """The most significant line of each field; its p-value is corrected for the number of lines."""
        sums = np.concatenate((*self._rows, np.asarray(self._columns)), axis=2)
        squares = sums[:, 1, : self._height].sum(axis=1)
        for field, t in enumerate(t_of(sums, squares, inflation)):
            number = int(np.abs(t).argmax())
            p = min(1.0, len(t) * p_value(float(t[number])))
            yield Sum(field, float(t[number]), p, self._place(number), False)

    def _place(self, number: int) -> Window:
        if number < self._height:
            return Window(0, number, self._width, 1)
        return Window(number - self._height, 0, 1, self._height)
