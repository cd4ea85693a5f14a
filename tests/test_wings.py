"""Every folder of tests belongs to one wing, so that `make test WING=` of all wings leaves none out."""

import re
from pathlib import Path

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
