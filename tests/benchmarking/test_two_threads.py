"""The experiment with two threads of the bounding volumes' benchmark: all rays once, and both threads at once."""

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from benchmarks import bounding_volumes as benchmark

RAYS = 301
"""An odd number, so that two parts can't be equal."""


@pytest.fixture(autouse=True)
def _few(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benchmark, "RAYS", RAYS)
    monkeypatch.setattr(benchmark, "USUAL", (40, 8))


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_every_ray_is_walked_once_by_so_many_threads(threads: int) -> None:
    """The barrier opens when as many threads have come to it; else the walk breaks off."""
    counts = np.zeros(RAYS, int)
    together = threading.Barrier(threads, timeout=20)
    seen = set()

    def work(part: slice) -> None:
        counts[part] += 1
        seen.add(threading.get_ident())
        together.wait()

    assert benchmark._seconds(work, threads) > 0
    assert (counts == 1).all()
    assert len(seen) == threads


def test_what_goes_wrong_in_a_thread_is_told() -> None:
    def work(part: slice) -> None:
        if part.start:
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        benchmark._seconds(work, 2)


def test_figures_are_ratios_of_these_times(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the walk and of Embree, by one thread and by two, with times that are made up."""
    monkeypatch.setattr(benchmark, "REPETITIONS", 3)
    asked: list[tuple[str, int]] = []
    times = {
        ("ask_hierarchy", 1): 9.0,
        ("ask_hierarchy", 2): 6.0,
        ("ask_embree", 1): 2.0,
        ("ask_embree", 2): 0.5,
    }

    def seconds(work: Callable[[slice], Any], threads: int) -> float:
        work(slice(0, 5))
        asked.append((work.__name__, threads))
        return times[asked[-1]]

    monkeypatch.setattr(benchmark, "_seconds", seconds)
    figures = {figure.name: figure for figure in benchmark._times(*benchmark._rays())}
    # Embree is asked for the same ten times in each.
    assert {name: figure.value for name, figure in figures.items()} == {
        "hierarchy: walk in NumPy / Embree": pytest.approx(9 / (2 / 10)),
        "hierarchy in NumPy: one thread / two": pytest.approx(9 / 6),
        "the same in Embree: one thread / two": pytest.approx(2 / 0.5),
    }
    assert asked == [*times] * 3
    assert [figure.at_least for figure in figures.values()] == [False, True, True]


def test_parts_of_the_batch_find_what_the_whole_finds() -> None:
    o, d = benchmark._rays()
    assert o.shape == (3, RAYS)
    _, corners = benchmark._knot(benchmark.USUAL)
    hierarchy = benchmark.build(*benchmark._boxes(corners), benchmark.LEAF_SIZE)
    found: dict[int, Any] = {}

    def walk(part: slice) -> None:
        found[part.start] = benchmark.traverse(hierarchy, *corners, o[:, part], d[:, part])

    benchmark._seconds(walk, 2)
    whole = benchmark.traverse(hierarchy, *corners, o, d)
    for k, values in enumerate(whole):
        joined = np.concatenate([found[start][k] for start in sorted(found)], axis=-1)
        assert np.array_equal(joined, values), k
    # Rays that miss alone would agree, too.
    assert 0.3 < (whole[0] >= 0).mean() < 1
