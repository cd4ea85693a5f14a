"""The table of `docs/grading.md` says which kinds of checks the further modules have, and for how many functions."""

import re

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import FURTHER
from course.school.grading.catalog import module_checks

KINDS = ("order", "picture", "bias", "speed")


def rows() -> list[list[str]]:
    """The table's cells, without its head."""
    text = (PROJECT / "docs" / "grading.md").read_text(encoding="utf-8")
    found = re.search(r"^\| further module \|.*\n\|[ -:|]+\|\n((?:\|.*\|\n)+)", text, re.MULTILINE)
    assert found
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in found[1].splitlines()]


def test_the_table_counts_the_functions_that_each_kind_checks() -> None:
    told = {name: list(map(int, counts)) for name, *counts, _ in rows()}
    found = {
        module: [
            len(functions),
            *(
                len(
                    {check.function for check in module_checks(module).checks if check.kind == kind}
                )
                for kind in KINDS
            ),
        ]
        for module, functions in FURTHER.items()
    }
    assert told == found


def test_a_reason_stands_where_something_is_missing() -> None:
    for module, total, *counts, why in rows():
        assert why or all(count == total for count in counts), module
        # Functions that it names are the module's.
        assert set(re.findall(r"`(\w+)`", why)) <= set(FURTHER[module])


def test_contracts_and_closed_forms_are_in_every_module() -> None:
    for module in FURTHER:
        assert {"contract", "property"} <= {check.kind for check in module_checks(module).checks}
