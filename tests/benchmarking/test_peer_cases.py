"""What is kept of the comparison with another program: a run of one case loses no other."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.mitsuba_agreement import Agreement
from benchmarks.peer_cases import (
    EFFECTS,
    FORMS,
    QUICK,
    Effort,
    Measured,
    Reached,
    Result,
    keep_cases,
    read_cases,
)
from benchmarks.peer_document import MARK, write_document
from course.effects import PROJECT

HERE = {"processor": "An Example 3000", "peer": "Mitsuba 3"}
THERE = {"processor": "Another 4000", "peer": "Mitsuba 3"}


def _case(effect: str, form: str, seconds: float = 2.0, effort: Effort = QUICK) -> Measured:
    ours = [Reached("adaptive", 1.5, 0.01), Reached("uniform", 3.0, 64)]
    agreement = Agreement(4.0, 0.0, 1e-5, -2e-4, (12, 20))
    result = Result(
        *(effect, form, [], False, "multijitter", 64, 0.01, seconds, ours, 4.0, 5.0),
        agreement,
    )
    return Measured(effort, HERE, result)


@pytest.fixture
def document(tmp_path: Path) -> Path:
    path = tmp_path / "peers.md"
    path.write_text(f"before\n<!-- {MARK}: begin -->\n<!-- {MARK}: end -->\n", encoding="utf-8")
    return path


def test_one_more_case_leaves_the_others(tmp_path: Path, document: Path) -> None:
    path = tmp_path / "peers.json"
    first = [_case("glossy", "scalar"), _case("glossy", "llvm"), _case("thin_lens", "llvm")]
    keep_cases(first, path)
    cases = keep_cases([_case("supersampling", "llvm")], path)
    assert [case.case for case in cases] == [
        ("llvm", "supersampling"),
        ("llvm", "glossy"),
        ("llvm", "thin_lens"),
        ("scalar", "glossy"),
    ]
    assert cases[2] == first[2]
    write_document(cases, document)
    text = document.read_text(encoding="utf-8")
    for form in ("llvm", "scalar"):
        assert f"<!-- site: peer_times {form} -->" in text
        assert f"- glossy, {form}: as it is" in text
    assert text.count("Made by") == 1
    assert text.count("| thin_lens | 1.00e-02 | multijitter | 2.000 | 3.000 (1.50) |") == 1


def test_the_same_case_takes_the_place_of_the_older(tmp_path: Path) -> None:
    path = tmp_path / "peers.json"
    keep_cases([_case("glossy", "llvm"), _case("glossy", "scalar")], path)
    cases = keep_cases([_case("glossy", "llvm", seconds=7.0)], path)
    assert [(*case.case, case.result.seconds) for case in cases] == [
        ("llvm", "glossy", 7.0),
        ("scalar", "glossy", 2.0),
    ]
    assert read_cases(path) == cases


@pytest.mark.parametrize("other", [{"about": THERE}, {"effort": Effort()}])
def test_a_case_measured_otherwise_says_so(
    tmp_path: Path, document: Path, other: dict[str, object]
) -> None:
    path = tmp_path / "peers.json"
    case = replace(_case("cube_map", "llvm"), **other)
    write_document(keep_cases([_case("glossy", "llvm"), case], path), document)
    made = [
        line
        for line in document.read_text(encoding="utf-8").splitlines()
        if line.startswith("Made by")
    ]
    assert [line.rpartition(": ")[2] for line in made] == ["glossy llvm.", "cube_map llvm."]


def test_nothing_is_kept_at_first(tmp_path: Path) -> None:
    assert read_cases(tmp_path / "peers.json") == []


def test_every_case_stands_in_the_documentation() -> None:
    """In either form, but for path tracing, which is the same in both."""
    cases = {case.case for case in read_cases(PROJECT / "docs" / "data" / "peers.json")}
    assert cases >= {(form, e) for form in FORMS for e in EFFECTS} - {("scalar", "path_tracing")}
