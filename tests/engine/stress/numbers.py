"""The worst legal inputs of effect functions, as Hypothesis strategies for arrays of a few columns."""

import math
from typing import Any

import numpy as np
from hypothesis import strategies as st

from tests.school.solutions.contract import Array

Strategy = st.SearchStrategy[Any]

COLUMNS = st.integers(1, 5)


def dtypes() -> Strategy:
    """float32 and float64."""
    return st.sampled_from([np.float32, np.float64])


def _width(dtype: type) -> Any:
    return 32 if dtype is np.float32 else 64


def sizes(dtype: type, largest: float | None = None) -> Strategy:
    """Numbers >= 0 of any size: 0, subnormal, tiny, next to 1, huge."""
    limits = np.finfo(dtype)
    most = float(limits.max) if largest is None else float(dtype(largest))
    worst = [
        0.0,
        float(limits.smallest_subnormal),
        float(limits.tiny),
        float(limits.eps),
        1.0,
        most,
    ]
    worst += [float(limits.tiny) ** 0.5, float(np.nextafter(dtype(1), dtype(0))), most**0.5]
    anything = st.floats(0, most, width=_width(dtype))
    exponents = st.floats(math.log10(float(limits.tiny)), math.log10(most) - 1e-9)
    spread = exponents.map(lambda e: float(dtype(10.0**e)))
    return st.one_of(st.sampled_from([x for x in worst if x <= most]), spread, anything)


SHORTEST, LONGEST = 1e-6, 1e6
"""The engine hands over normalised scenes: a length that isn't 0 lies between these."""


def lengths(dtype: type) -> Strategy:
    """Numbers >= 0 that a length of a scene may have."""
    spread = st.floats(math.log10(SHORTEST), math.log10(LONGEST)).map(lambda e: 10.0**e)
    between = st.floats(SHORTEST, LONGEST)
    worst = st.sampled_from([0.0, SHORTEST, 1.0, LONGEST])
    return st.one_of(worst, spread, between).map(lambda x: float(dtype(x)))


def coordinates(dtype: type) -> Strategy:
    """The same of either sign."""
    both = st.tuples(lengths(dtype), st.sampled_from((1.0, -1.0)))
    return both.map(lambda pair: pair[0] * pair[1])


def signed(dtype: type, largest: float | None = None) -> Strategy:
    """Numbers of any size and sign."""
    both = st.tuples(sizes(dtype, largest), st.sampled_from((1.0, -1.0)))
    return both.map(lambda pair: pair[0] * pair[1])


def units(dtype: type) -> Strategy:
    """Numbers u in [0, 1): its ends, their neighbours, the middle, anything."""
    last = float(np.nextafter(dtype(1), dtype(0)))
    limits = np.finfo(dtype)
    ends = [0.0, float(limits.smallest_subnormal), float(limits.tiny), float(limits.eps), 2.0**-24]
    ends += [0.25, 0.5, 0.75, float(np.nextafter(dtype(0.5), dtype(1))), 1 - 2.0**-24, last]
    return st.one_of(
        st.sampled_from(ends), st.floats(0, last, width=_width(dtype), exclude_max=False)
    )


def single(dtype: type, largest: float | None = None) -> Strategy:
    """A point (3,) of numbers of any size."""
    return st.tuples(*3 * [signed(dtype, largest)])


@st.composite
def columns(draw: st.DrawFn, dtype: type, rows: int, numbers: Strategy, n: int) -> Array:
    """(rows, n) numbers."""
    values = [[draw(numbers) for _ in range(n)] for _ in range(rows)]
    return np.array(values, dtype).reshape(rows, n)


@st.composite
def unit_vectors(draw: st.DrawFn, dtype: type, n: int) -> Array:
    """(3, n) unit vectors: on the axes, within rounding of them, in the planes between them, anywhere."""
    small = st.one_of(
        st.just(0.0),
        st.sampled_from([5e-324, 1e-45, 1e-40, 1e-38, 1e-20, 1e-9, 1e-8, 3e-8, 1e-7, 1e-4]),
        st.floats(-20, 0).map(lambda e: 10.0**e),
    )
    sign = st.sampled_from((1.0, -1.0))
    vectors = []
    for _ in range(n):
        if draw(st.booleans()):
            # Next to an axis, both of its ends.
            x, y = draw(small) * draw(sign), draw(small) * draw(sign)
            vector = np.roll([x, y, draw(sign)], draw(st.integers(0, 2)))
        else:
            vector = np.array([draw(st.floats(-1, 1)) for _ in range(3)])
        length = np.linalg.norm(vector)
        vectors.append(vector / length if length > 1e-3 else np.array([0.0, -0.0, -1.0]))
    return np.array(vectors, dtype).T.copy()
