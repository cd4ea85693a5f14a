"""The page that compares with Mitsuba says first what its tables say."""

import re

from course.engine.functions.effects import PROJECT


def test_the_result_is_that_of_the_table() -> None:
    text = (PROJECT / "docs" / "peers.md").read_text(encoding="utf-8")
    result = text.partition("## The result")[2].partition("<!-- site")[0].replace("\n", " ")
    table = text.partition("### Ours / Mitsuba's: the worst")[2].partition("\n### ")[0]
    rows = [row.strip("| ").split(" | ") for row in table.splitlines() if row.startswith("| ")][2:]
    said = re.findall(r"([0-9.]+[0-9]) (?:to|and) ([0-9.]+[0-9])|([0-9.]+) to\s+([0-9.]+)", result)
    ranges = [tuple(float(each) for each in one if each) for one in said]
    # Columns: uniform, adaptive, uniform compiled, adaptive compiled.
    for (form, column), told in zip(
        (("llvm", 3), ("scalar", 3), ("llvm", 2), ("scalar", 2), ("llvm-robust", 3)),
        ranges,
        strict=True,
    ):
        found = [float(row[column].split(" ")[0]) for row in rows if row[0].endswith(form)]
        assert told == (min(found), max(found)), (form, column)
        if form == "llvm-robust":
            less = sum(ratio < 1 for ratio in found)
            assert f"in {less} of {len(found)} scenes less than 1" in result
