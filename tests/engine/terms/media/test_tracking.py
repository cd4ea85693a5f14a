"""Steps through grids of densities end, whatever a student's function returns."""

from types import SimpleNamespace

import numpy as np
import pytest

from course.base.errors import EffectError
from course.engine.terms.media import tracking
from course.engine.terms.media.tracking import DensityGrid


def stays(*arguments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Goes nowhere and stops nothing; of ratios, all comes through and nobody gets farther."""
    n = len(arguments[-2])
    return np.zeros(n, np.float32), np.zeros(n, np.bool_)


def passes(*arguments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    n = len(arguments[-2])
    return np.ones(n, np.float32), np.zeros(n, np.float32)


@pytest.mark.parametrize(
    ("method", "functions"),
    [("flights", {"delta_tracking": stays}), ("transmittance", {"ratio_tracking": passes})],
)
def test_a_function_that_gets_nowhere_is_named(
    monkeypatch: pytest.MonkeyPatch, method: str, functions: dict[str, object]
) -> None:
    monkeypatch.setattr(tracking, "MOST_NUMBERS", 100)
    grid = DensityGrid(np.ones((2, 2, 2), np.float32), 1.0, SimpleNamespace(**functions))
    origin, direction = np.zeros((3, 4), np.float32), np.ones((3, 4), np.float32)
    (name,) = functions
    with pytest.raises(EffectError, match=f"media.{name} comes to no end"):
        getattr(grid, method)(origin, direction, np.ones(4, np.float32))
