"""What is made once is made by one of several that ask, and all of them have it whole."""

import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from tests.once import made_once


def test_of_several_that_ask_one_makes_it_and_all_have_it(tmp_path: Path) -> None:
    made: list[Path] = []

    def make(path: Path) -> None:
        made.append(path)
        time.sleep(0.2)
        path.write_text("whole", encoding="utf-8")

    def ask(_: int) -> str:
        return made_once(tmp_path, "text", make).read_text(encoding="utf-8")

    with ThreadPoolExecutor(4) as pool:
        assert [*pool.map(ask, range(4))] == ["whole"] * 4
    assert made == [tmp_path / "text"]


def test_what_could_not_be_made_is_nobodys(tmp_path: Path) -> None:
    def fail(_: Path) -> None:
        raise ValueError("nothing works")

    with pytest.raises(ValueError, match="nothing works"):
        made_once(tmp_path, "text", fail)
    with pytest.raises(RuntimeError, match="was not made"):
        made_once(tmp_path, "text", Path.touch)
