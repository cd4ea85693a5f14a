"""Numbers for some paths of a block are those that a draw for the whole block has for them."""

from typing import Any

import numpy as np
import pytest

from course.engine.core.counters import Counters
from course.engine.core.rays import Dimensions, Draws
from course.engine.core.samplers import Block
from course.engine.terms.samplers import make_sampler
from course.engine.terms.samplers.sobol import SobolSampler

PIXELS = np.arange(100, 356, dtype=np.uint32)

ALL = 256 * 16


@pytest.mark.parametrize("count", [1, 5, 255, 257, ALL // 2, ALL // 2 + 1, ALL])
@pytest.mark.parametrize(("dimension", "width"), [(2, 2), (4, 2), (7, 1), (3, 1), (10, 3), (0, 4)])
def test_some_paths_draw_what_all_paths_would(count: int, dimension: int, width: int) -> None:
    _check(Block(PIXELS, 16, 16, 7), count, dimension, width)


@pytest.mark.parametrize("samples", [1, 5, 12, 64])
def test_any_number_of_samples(samples: int) -> None:
    for count in (3, 256 * samples // 3):
        _check(Block(PIXELS, 0, samples, 7), count, 4, 2)


def test_few_paths_leave_the_block_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any) -> Any:
        raise AssertionError("a whole block was drawn")

    monkeypatch.setattr(SobolSampler, "draw", refuse)
    block = Block(PIXELS, 16, 16, 7)
    found = _drawn(SobolSampler(3), block, Counters(), 4, 2, np.arange(ALL // 2))
    assert found.shape == (2, ALL // 2)


def test_samplers_that_know_no_parts_draw_the_whole() -> None:
    def place(k: int, n: int, rng: Any) -> Any:
        return rng.random((2, n, k * k), np.float32)

    sampler = make_sampler("random", 3, place)
    block = Block(PIXELS, 0, 16, 7)
    path = np.arange(0, ALL, 100)
    found = _drawn(sampler, block, Counters(), 4, 2, path)
    assert found.tobytes() == np.ascontiguousarray(sampler.draw(block, 4, 2)[:, path]).tobytes()


def _drawn(
    sampler: Any, block: Block, counters: Counters, dimension: int, width: int, path: Any
) -> Any:
    """Numbers of some paths from a dimension on; a name's own begin at even ones."""
    skip = dimension % 2
    dimensions = Dimensions([("before", dimension - skip), ("light", skip + width)], [])
    return Draws(sampler, dimensions, block, counters)("light", path, width=width, skip=skip)


def _check(block: Block, count: int, dimension: int, width: int) -> None:
    counters = Counters()
    path = np.sort(np.random.default_rng(count).choice(block.size, count, replace=False))
    found = _drawn(SobolSampler(3), block, counters, dimension, width, path)
    whole = SobolSampler(3).draw(block, dimension, width)
    assert found.dtype == np.float32
    assert found.tobytes() == np.ascontiguousarray(whole[:, path]).tobytes()
    assert counters.numbers == {"light": width * count}
