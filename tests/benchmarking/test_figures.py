"""What the engine's benchmark prints."""

import re
import sys

import pytest

from benchmarks.figures import Figure, table
from course.benchmarking.tables import print_tables

FIGURES = [
    Figure("a class of 200 [min]", 20.0, 19.0, 21.0, 25.0),
    Figure("start [s], [bold] and [/]", 2.0, 1.0, 3.0, 1.0),
    Figure("one thread / two", 1.5, 1.0, 2.0, 1.25, at_least=True),
]


def test_names_are_printed_with_their_units(capsys: pytest.CaptureFixture[str]) -> None:
    print_tables([table(FIGURES)])
    told = {
        FIGURES[0].name: ["20.00", "19.00 .. 21.00", "≤ 25", "reached"],
        FIGURES[1].name: ["2.00", "1.00 .. 3.00", "≤ 1", "missed"],
        FIGURES[2].name: ["1.50", "1.00 .. 2.00", "≥ 1.25", "reached"],
    }
    _, _, *lines = capsys.readouterr().out.splitlines()
    rows = [re.split(r"  +", line.strip()) for line in lines]
    assert rows == [[name, *cells] for name, cells in told.items()]


def test_brackets_are_no_markup_on_a_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "120")
    print_tables([table(FIGURES)])
    printed = capsys.readouterr().out
    assert all(figure.name in printed for figure in FIGURES)


@pytest.mark.parametrize(
    ("value", "goal", "at_least", "shown"),
    [
        (1.84712, 1.85, True, "1.847"),
        (1.8499993, 1.85, True, "1.849999"),
        (1.5004, 1.5, False, "1.5004"),
        (1.8512, 1.85, True, "1.85"),
        (1.85, 1.85, True, "1.85"),
        (1.84, 1.85, True, "1.84"),
        (1.4996, 1.5, False, "1.50"),
    ],
)
def test_a_median_that_misses_its_goal_doesnt_look_as_if_it_didnt(
    value: float, goal: float, at_least: bool, shown: str
) -> None:
    *_, row = table([Figure("a", value, value, value, goal, at_least)]).markdown().splitlines()
    told = "reached" if shown in ("1.85", "1.50") else "missed"
    sign = "≥" if at_least else "≤"
    assert row == f"| a | {shown} | {shown} .. {shown} | {sign} {goal:g} | {told} |"


def test_a_bar_in_a_name_ends_no_cell_in_markdown() -> None:
    *_, row = table([Figure("largest |t|", 2.0, 1.0, 3.0, 6.0)]).markdown().splitlines()
    assert row == r"| largest \|t\| | 2.00 | 1.00 .. 3.00 | ≤ 6 | reached |"
