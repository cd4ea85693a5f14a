"""`make quick` runs something of every folder of tests, and all that it names is there."""

from pathlib import Path

ROOT = Path(__file__).parents[1]
LISTED = (ROOT / "tests" / "quick.txt").read_text(encoding="utf-8").splitlines()


def test_every_folder_of_tests_has_a_part_in_it() -> None:
    folders = {path.parent for path in (ROOT / "tests").rglob("test_*.py")}
    assert folders == {(ROOT / line.partition("::")[0]).parent for line in LISTED}


def test_all_that_it_names_is_there() -> None:
    assert len(set(LISTED)) == len(LISTED)
    for line in LISTED:
        file, _, function = line.partition("[")[0].partition("::")
        text = (ROOT / file).read_text(encoding="utf-8")
        assert f"def {function or 'test_'}" in text, line
