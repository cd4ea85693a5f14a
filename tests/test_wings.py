"""The wings: every folder of tests belongs to one, and their code keeps to a budget."""

import re
from pathlib import Path

import pytest

from tests.code_lines import code_lines

TESTS = Path(__file__).parent


def test_each_folder_of_tests_belongs_to_one_wing() -> None:
    text = (TESTS.parent / "Makefile").read_text(encoding="utf-8")
    wings = {
        name: folders.split()
        for name, folders in re.findall(r"^WING_(\w+) := (.*)$", text, re.MULTILINE)
    }
    told = re.search(r"^WINGS := (.*)$", text, re.MULTILINE)
    assert told is not None
    assert told[1].split() == list(wings)
    folders = sorted(folder for some in wings.values() for folder in some)
    assert folders == sorted(
        path.name for path in TESTS.iterdir() if any(path.glob("**/test_*.py"))
    )


BUDGET = {"engine": 34_680, "school": 22_505}
"""Lines that carry code. To raise one, say in the commit what a user gets for it."""


@pytest.mark.parametrize("wing", BUDGET)
def test_a_wing_keeps_to_its_budget(wing: str) -> None:
    files = (TESTS.parent / "course" / wing).rglob("*.py")
    assert sum(code_lines(path.read_text(encoding="utf-8")) for path in files) <= BUDGET[wing]
