"""`make quick` runs something of every room, `make stress` all of what tries a share; all that they name is there."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
LONG = (ROOT / "tests" / "long.txt").read_text(encoding="utf-8").splitlines()
SHARES = re.compile(r"^from tests\.lengths import .*\b(LONG|fewer|share)\b", re.MULTILINE)
LISTED = (ROOT / "tests" / "quick.txt").read_text(encoding="utf-8").splitlines()


def room(path: str) -> tuple[str, ...]:
    """The folder of a room, or of a wing without rooms: ("tests", "engine", "core"), ("tests", "cli")."""
    folders = Path(path).parent.parts
    return folders[: 3 if folders[1:2] in {("engine",), ("school",)} else 2]


def test_every_room_has_a_part_in_it() -> None:
    rooms = {
        room(path.relative_to(ROOT).as_posix()) for path in (ROOT / "tests").rglob("test_*.py")
    }
    assert rooms == {room(line.partition("::")[0]) for line in LISTED}


def test_all_that_it_names_is_there() -> None:
    assert len(set(LISTED)) == len(LISTED)
    for line in LISTED:
        file, _, function = line.partition("[")[0].partition("::")
        text = (ROOT / file).read_text(encoding="utf-8")
        assert f"def {function or 'test_'}" in text, line


def test_what_tries_a_share_tries_all_of_it_in_the_long_run() -> None:
    mine = Path(__file__).name
    sharing = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "tests").rglob("test_*.py")
        if path.name != mine and SHARES.search(path.read_text(encoding="utf-8"))
    }
    assert all((ROOT / each).exists() for each in LONG)
    assert {path for path in sharing if not path.startswith(tuple(LONG))} == set()
