"""Median seconds of several ways to the same, each with several numbers of samples."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from time import perf_counter

import numpy as np


def median_seconds(
    ways: Mapping[str, Callable[[int, int], object]], counts: Sequence[int], rounds: int
) -> dict[str, tuple[float, ...]]:
    """Time every way with every number of samples.

    In each round all ways take their turn, so that whatever else the machine does meets them alike. The rounds of one
    number of samples come before those of the next: a small batch would else begin with caches that a large one has
    left. Before the first round each way has been called once, for what it makes only then.

    Parameters
    ----------
    ways : name -> what takes a number of samples and a round's number, from 0 on
    rounds : how often each is timed; of the times the median counts
    """
    for way in ways.values():
        way(counts[0], 0)
    seconds = {name: np.empty((len(counts), rounds)) for name in ways}
    for row, count in enumerate(counts):
        for turn in range(rounds):
            for name, way in ways.items():
                started = perf_counter()
                way(count, turn)
                seconds[name][row, turn] = perf_counter() - started
    return {name: tuple(np.median(each, axis=1).tolist()) for name, each in seconds.items()}
