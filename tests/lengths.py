"""How much of what takes minutes is tried: a share by `make test`, all of it by `make stress`."""

from collections.abc import Sequence
from itertools import combinations
from typing import TypeVar

import pytest
from hypothesis import settings

LONG = settings.get_current_profile_name() == "stress"
"""Whether all was asked for: `pytest FILE --hypothesis-profile=stress`. Known when tests are collected, not before."""

T = TypeVar("T")

fewer = pytest.mark.fewer
"""Of all combinations of a test's lists of values as few as have each value, or of three and more lists each pair of
values; the long run tries them all."""


def share(whole: Sequence[T], of: int) -> list[T]:
    """All of it, or every ``of``-th, from the first on."""
    return list(whole if LONG else whole[::of])


def covering(wanted: Sequence[frozenset[T]]) -> list[int]:
    """Which of them are tried, by their places: each has most of what those before have not, until all is had."""
    missing = frozenset[T]().union(*wanted)
    chosen: list[int] = []
    while missing:
        best = max(range(len(wanted)), key=lambda place: len(wanted[place] & missing))
        chosen.append(best)
        missing -= wanted[best]
    return sorted(chosen)


def without_combinations(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Those of a run's tests that are tried, in their order."""
    groups: dict[str, list[pytest.Item]] = {}
    for item in items:
        if item.get_closest_marker("fewer") and hasattr(item, "callspec"):
            groups.setdefault(item.nodeid.partition("[")[0], []).append(item)
    left_out: set[pytest.Item] = set()
    for group in groups.values():
        tried = {group[place] for place in covering([*map(_wanted, group)])}
        left_out.update(item for item in group if item not in tried)
    return [item for item in items if item not in left_out]


def _wanted(item: pytest.Item) -> frozenset[object]:
    """What a combination has: its values, or pairs of them."""
    params: dict[str, object] = item.callspec.params  # type: ignore[attr-defined]
    named = [mark.args[0] for mark in item.iter_markers("parametrize")]
    lists = [[*names] if isinstance(names, tuple | list) else [names] for names in named]
    listed = {name for names in lists for name in names}
    lists += [[name] for name in params if name not in listed]
    # What stands once in a list is the same object in all combinations; it may have no hash.
    values = [(names[0], *(id(params[name]) for name in names)) for names in lists]
    return frozenset(combinations(values, 2) if len(values) > 2 else values)
