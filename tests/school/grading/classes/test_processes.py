"""A pool of processes that outlives the death of one of them."""

import multiprocessing
import os
import signal
from collections import Counter
from pathlib import Path
from time import sleep

import pytest

from course.school.grading.classes import engines
from course.school.grading.classes.engines import DIED, _share, in_processes
from tests.school.grading.classes.work import work


def calls(folder: Path) -> Counter[str]:
    return Counter(path.name.rpartition(" ")[0] for path in folder.iterdir())


def test_the_one_that_kills_its_process_twice_loses_nobody_else(tmp_path: Path) -> None:
    items = ["a", "b", "die", "c", "die-once", "d", "raise", "e"]
    outcomes = {one.item: one for one in in_processes(work, items, tmp_path, 2)}

    assert outcomes.keys() == set(items)
    right = set(items) - {"die", "raise"}
    assert {item: outcomes[item].value for item in right} == {item: item.upper() for item in right}
    assert not any(outcomes[item].fault for item in right)
    assert outcomes["die"].fault == DIED
    assert outcomes["die"].value is None
    assert outcomes["raise"].fault == "ValueError: a fault of the grader"
    assert calls(tmp_path)["die"] == 2
    assert calls(tmp_path)["die-once"] == 2
    # What was done when the pool broke is not done again.
    assert calls(tmp_path)["a"] == 1


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this system has no such timer")
def test_who_keeps_the_grader_itself_busy_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(engines, "OWN_SECONDS", 0.2)
    items = ["match", "a", "rest", "b"]
    outcomes = {one.item: one for one in in_processes(work, items, tmp_path, 2)}
    assert outcomes["match"].fault == DIED
    assert calls(tmp_path)["match"] == 2
    # Waiting isn't counted: that is what students' functions are given their limits for.
    assert {outcomes[item].value for item in ("a", "rest", "b")} == {"A", "REST", "B"}


def test_who_fills_the_graders_memory_is_ended(tmp_path: Path) -> None:
    outcomes = {one.item: one for one in in_processes(work, ["hoard", "a", "b"], tmp_path, 2)}
    assert outcomes["hoard"].fault == DIED
    assert {outcomes[item].value for item in ("a", "b")} == {"A", "B"}


@pytest.mark.parametrize("processors", [1, 2, 5, 16])
@pytest.mark.parametrize("processes", [2, 3, 16])
def test_processes_share_no_processor_where_there_are_enough(
    monkeypatch: pytest.MonkeyPatch, processors: int, processes: int
) -> None:
    """Threads of one submission had taken the time of the one beside it."""
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(processors)), raising=False)
    shares = [_share(number, processes) for number in range(processes)]
    assert all(shares)
    assert set[int]().union(*shares) == set(range(processors))
    if processes <= processors:
        assert sum(map(len, shares)) == processors
    assert _share(0, 1) == set()


def test_closing_ends_work_that_is_under_way(tmp_path: Path) -> None:
    before = set(multiprocessing.active_children())
    outcomes = in_processes(work, ["a", "sleep 1", "sleep 2", "b"], tmp_path, 2)
    assert next(outcomes).value == "A"
    while not calls(tmp_path)["sleep 1"]:
        sleep(0.05)
    outcomes.close()
    assert not [*tmp_path.glob("* woke")]
    assert set(multiprocessing.active_children()) <= before
    assert calls(tmp_path)["b"] == 0
