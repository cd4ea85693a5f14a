"""Tables: the numbers in them, on the terminal and as Markdown."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from course.benchmarking.tables import (
    Table,
    digits,
    error_table,
    reference_table,
    seconds_to,
    summary_table,
    target_error,
    time_table,
    time_text,
)
from tests.benchmarking.curves import curve, measured

BOTH = measured(
    curve("random", -0.5),
    curve("sobol", -1.0),
    curve("grid sobol", -0.5, samples=(1, 4), points=16, bias=0.03),
)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0012345, "0.00123"),
        (0.1, "0.100"),
        (1, "1.00"),
        (9.996, "10.00"),
        (12.34, "12.3"),
        (123.4, "123"),
        (98765.4, "98,800"),
        (0, "0"),
        (math.inf, "-"),
        (math.nan, "-"),
    ],
)
def test_three_digits_count(value: float, text: str) -> None:
    assert digits(value) == text


@given(st.floats(1e-12, 1e12))
def test_what_is_shown_is_within_half_of_its_last_digit(value: float) -> None:
    shown = float(digits(value).replace(",", ""))
    assert shown == pytest.approx(value, rel=0.5 * 10**-2 * (1 + 1e-9))
    assert "e" not in digits(value)


@given(order=st.floats(-1.5, -0.25), share=st.floats(0.01, 1))
def test_seconds_to_an_error_on_a_power_law(order: float, share: float) -> None:
    # RMSE = 0.1 n^order and t = 0.01 n, so t = 0.01 (0.1 / error)^(-1 / order).
    item = curve("sobol", order)
    last = float(item.rmse[-1])
    error = last * (0.1 / last) ** share
    assert seconds_to(item, error) == pytest.approx(0.01 * (0.1 / error) ** (-1 / order), rel=1e-6)


def test_what_is_not_reached_and_what_always_was() -> None:
    item = curve("sobol", -0.5)
    assert math.isnan(seconds_to(item, 0.99 * float(item.rmse[-1])))
    assert time_text(item, 0.99 * float(item.rmse[-1])) == "not reached"
    assert time_text(item, 0.2) == "≤ 0.0100"


def test_the_error_to_reach_is_that_of_random_samples_at_64() -> None:
    assert target_error(BOTH) == pytest.approx(0.1 / 8)
    assert target_error(measured(curve("sobol", -1.0))) == pytest.approx(0.1 / 64)
    few = measured(curve("random", -0.5, samples=(1, 4, 16)))
    assert target_error(few) == pytest.approx(0.1 / 4)


def rows(table: Table) -> dict[str, dict[str, str]]:
    return {row[0]: dict(zip(table.columns, row, strict=True)) for row in table.rows}


def test_errors_and_orders() -> None:
    table = rows(error_table(BOTH))
    assert (
        table["sobol"] | {"16": "0.00625", "order, 95% interval": "-1.00 (-1.00 .. -1.00)"}
        == (table["sobol"])
    )
    assert table["sobol"]["rel. MSE at 64"] == digits(2 * (0.1 / 64) ** 2)
    assert table["sobol"]["1 - SSIM at 64"] == digits(3 * (0.1 / 64) ** 2)
    assert table["sobol"]["bias"] == "-"
    assert (
        table["grid sobol"] | {"16": "-", "bias": "0.0300", "order, 95% interval": "-"}
        == (table["grid sobol"])
    )


def test_a_bias_below_the_reference_s_error_is_not_claimed() -> None:
    item = curve("regular", -0.5, bias=0.001, floor=0.002)
    assert rows(error_table(measured(item)))["regular"]["bias"] == "< 0.00200"


def test_times_and_efficiencies() -> None:
    table = rows(time_table(BOTH))
    assert table["random"]["64 [s]"] == "0.640"
    # 1 / (MSE t) = 1 / (0.01 / 64 * 0.64): the same at any number of random samples.
    assert table["random"]["efficiency at 64"] == "10,000"
    assert table["sobol"]["efficiency at 64"] == "640,000"
    assert table["sobol"]["s to RMSE 0.0125"] == "0.0800"


def test_the_reference_states_its_error() -> None:
    (row,) = reference_table(BOTH).rows
    assert row == ("it", "2,048", "0.0000100", "0123456789ab")


def test_the_summary_has_a_row_for_each_estimator() -> None:
    table = summary_table(BOTH)
    assert [row[0] for row in table.rows] == ["random", "sobol", "grid sobol"]
    assert rows(table)["sobol"]["s to 0.0125"] == "0.0800"
    assert rows(table)["sobol"]["order"] == "-1.00"


def test_a_bar_in_a_cell_ends_none_in_markdown() -> None:
    table = Table("a | b", ("|t|", "n"), (("largest |t|", "1"),))
    lines = table.markdown().splitlines()
    assert lines == [r"| \|t\| | n |", "| --- | ---: |", r"| largest \|t\| | 1 |"]
    assert "|t|" in table.plain()


def test_markdown_and_plain_text_hold_the_same_cells() -> None:
    table = time_table(BOTH)
    lines = table.markdown().splitlines()
    assert lines[1] == "| --- |" + " ---: |" * (len(table.columns) - 1)
    cells = [tuple(line.strip("| ").split(" | ")) for line in (lines[0], *lines[2:])]
    assert cells == [table.columns, *table.rows]
    plain = table.plain().splitlines()
    assert plain[0] == table.title
    assert len({len(line) for line in plain[1:]}) == 1
    assert [tuple(re.split(r"  +", line.strip())) for line in plain[1:]] == cells
