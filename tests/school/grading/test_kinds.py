"""The tables of modules say what each has: their lines are as `python -m benchmarks.module_tables` writes them."""

import re

import pytest

from benchmarks.module_tables import TABLES, kinds_of, said
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, FURTHER
from course.school.grading.catalog import module_checks


@pytest.mark.parametrize("mark", TABLES)
def test_a_table_is_in_step(mark: str) -> None:
    file, made = TABLES[mark]
    text = (PROJECT / file).read_text(encoding="utf-8")
    between = text.partition(f"<!-- {mark}: begin -->")[2].partition(f"<!-- {mark}: end -->")[0]
    assert between.strip() == made(), "python -m benchmarks.module_tables writes it anew"


def test_a_reason_stands_where_something_is_missing() -> None:
    for module, why in said("lacks").items():
        total, *counts = kinds_of(module)
        if module in FURTHER:
            assert why or all(count == total for count in counts), module
        else:
            assert not why
        # Functions that it names are the module's.
        assert set(re.findall(r"`(\w+)`", why)) <= set(COURSE[module])


def test_contracts_and_closed_forms_are_in_every_module() -> None:
    for module in FURTHER:
        assert {"contract", "property"} <= {check.kind for check in module_checks(module).checks}
