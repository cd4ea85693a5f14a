"""Numbers as mesh files in text write them.

Python's own `float` and `int` read more: 1_0 as ten, and digits of other scripts. In a file these are slips, or it is
cut up wrongly; and NumPy, which reads the usual file in one go, takes neither.
"""

from __future__ import annotations

import numpy as np

from course.core.types import Floats64


def real(word: str) -> float:
    """Return the number that a word is, infinities and NaN among them; ValueError where it is none."""
    return float(_plain(word))


def whole(word: str) -> int:
    """Return the whole number that a word is, written without a point; ValueError where it is none."""
    return int(_plain(word))


def numbers(text: str) -> Floats64:
    """Return the numbers of a text in one go, (N,); fewer than it has words if one of these is none."""
    try:
        return np.fromstring(text, np.float64, sep=" ")
    except (ValueError, DeprecationWarning):
        return np.zeros(0)


def _plain(word: str) -> str:
    if "_" in word or not word.isascii():
        raise ValueError(f"{word[:40]!r} is no number")
    return word
