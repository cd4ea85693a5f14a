"""Numbers for a few paths of a block are those that a draw for the whole block has for them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from course.core.samplers import Block
from course.core.samplers.sobol import SobolSampler
from course.transport.counters import Counters
from course.transport.paths import FEW, Draws

BLOCK = Block(np.arange(100, 356, dtype=np.uint32), 16, 16, 7)


@pytest.mark.parametrize("count", [1, 5, BLOCK.size // FEW - 1, BLOCK.size // FEW + 1])
@pytest.mark.parametrize(("dimension", "width"), [(4, 2), (7, 1), (10, 3), (0, 4)])
def test_few_paths_draw_what_all_paths_would(count: int, dimension: int, width: int) -> None:
    drawn: list[int] = []

    class Noted(SobolSampler):
        def draw(self, block: Block, dimension: int, width: int) -> Any:
            drawn.append(len(block.pixels))
            return super().draw(block, dimension, width)

    counters = Counters()
    draws = Draws(Noted(3), BLOCK, counters, lambda: False)
    path = np.sort(np.random.default_rng(count).choice(BLOCK.size, count, replace=False))
    found = draws("light", dimension, width, path)
    whole = SobolSampler(3).draw(BLOCK, dimension, width)
    assert found.tobytes() == np.ascontiguousarray(whole[:, path]).tobytes()
    assert counters.numbers == {"light": width * count}
    assert (drawn[0] < len(BLOCK.pixels)) == (count * FEW < BLOCK.size)
