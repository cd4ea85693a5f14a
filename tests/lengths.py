"""How much of what takes minutes is tried: a share by `make test`, all of it by `make stress`."""

from collections.abc import Sequence
from typing import TypeVar

import pytest
from hypothesis import settings

LONG = settings.get_current_profile_name() == "stress"
"""Whether all was asked for: `pytest FILE --hypothesis-profile=stress`."""

T = TypeVar("T")

each_value = pytest.mark.each_value
"""Of all combinations of a test's parameters as few as have each value of each of them; all of them in the long run."""


def share(whole: Sequence[T], of: int) -> list[T]:
    """All of it, or every ``of``-th, from the first on."""
    return list(whole if LONG else whole[::of])


def covering(combinations: Sequence[frozenset[T]]) -> list[int]:
    """Which combinations are tried, by their places: after those before, each has most that is new, up to all there is."""
    missing = frozenset[T]().union(*combinations)
    chosen: list[int] = []
    while missing:
        best = max(range(len(combinations)), key=lambda place: len(combinations[place] & missing))
        chosen.append(best)
        missing -= combinations[best]
    return sorted(chosen)


def without_combinations(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Those of a run's tests that are tried, in their order."""
    groups: dict[str, list[pytest.Item]] = {}
    for item in items:
        if item.get_closest_marker("each_value") and hasattr(item, "callspec"):
            groups.setdefault(item.nodeid.partition("[")[0], []).append(item)
    left_out: set[pytest.Item] = set()
    for group in groups.values():
        values = [frozenset(item.callspec.indices.items()) for item in group]  # type: ignore[attr-defined]
        tried = {group[place] for place in covering(values)}
        left_out.update(item for item in group if item not in tried)
    return [item for item in items if item not in left_out]
