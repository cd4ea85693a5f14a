"""The same figure with other random numbers: what it differs by then is noise."""

from collections.abc import Iterator
from contextlib import contextmanager
from unittest.mock import patch

import numpy as np

_usual = np.random.default_rng
_again = 0


@contextmanager
def other_numbers(again: int) -> Iterator[None]:
    """Draw with the numbers of another trial; those of trial 0 are the usual ones.

    What stands in a scene stays where it is: a scene is made by `scene_numbers`.
    """
    global _again  # noqa: PLW0603 - one figure is drawn at a time in a process
    before, _again = _again, again
    other = patch("numpy.random.default_rng", lambda seed=None: _usual((seed or 0, again)))
    try:
        if again:
            with other:
                yield
        else:
            yield
    finally:
        _again = before


def scene_numbers(seed: int) -> np.random.Generator:
    """Numbers that place what stands in a scene, the same in every trial."""
    return _usual(seed)


def trial() -> int:
    """Number of the trial, which seeds a render."""
    return _again
