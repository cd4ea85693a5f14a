"""What cells define, and which of them count, without a kernel."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.given import GivenEffects
from course.school.notebooks.session import Mine, Session, functions_in


@pytest.mark.parametrize(
    "text",
    [
        "def displacement(velocity, time):\n    return velocity",
        "if True:\n    def displacement(velocity, time):\n        return velocity",
        "try:\n    def displacement(velocity, time):\n        return velocity\nexcept ValueError:\n    pass",
        "displacement = lambda velocity, time: velocity",
        "%time x = 1\nfrom elsewhere import displacement",
    ],
)
def test_a_function_is_defined_however_its_name_is_bound(text: str) -> None:
    assert functions_in(text) == {"displacement"}


def session(*before: str) -> tuple[Session, Any]:
    """A session whose shell has run cells before, and what runs a cell."""
    shell = SimpleNamespace(
        history_manager=SimpleNamespace(input_hist_raw=["", *before]),
        events=SimpleNamespace(register=lambda *_: None, unregister=lambda *_: None),
    )
    found = Session(shell)

    def run(text: str) -> None:
        found._begun(SimpleNamespace(store_history=True, silent=False, raw_cell=text))
        # Kept after the event; what the counter says at that time differs from version to version.
        shell.history_manager.input_hist_raw.append(text)

    return found, run


def test_a_cell_without_a_key_that_imports_too_is_not_forgotten() -> None:
    found, run = session()
    run("import numpy as np\ndef displacement(velocity, time):\n    return velocity")
    run("def displacement(velocity, time):\n    return np.outer(velocity, time)")
    made = found.module("motion_blur")
    assert made.lacking == ()
    assert b"np.outer" in made.text
    run("def displacement(velocity, time):\n    return velocity[:, None] * time")
    # The cell before had nothing else, so this is the same one.
    assert len(found.cells) == 2


def test_a_name_that_cells_bind_anew_is_told_with_their_numbers() -> None:
    found, run = session("import numpy as np", "%load_ext course")
    run("TWICE = 2")
    run(
        "import numpy as np\ndef displacement(velocity, time):\n    return velocity * TWICE * np.pi"
    )
    # The same again is nothing new, and no function needs the other.
    run("import numpy as np\nbeside = 1")
    run("beside = 2")
    # What binds the same names is the same cell, edited: no key says more.
    run("TWICE = 4")
    assert found.module("motion_blur").rebound == ()
    run("TWICE = 3\nTHRICE = TWICE + 1")
    assert found.module("motion_blur").rebound == (("TWICE", (7, 8)),)
    assert found.number == 8
    # Last run counts, as in Python.
    assert found.module("motion_blur").text.index(b"TWICE = 3") > 0


def test_cells_that_failed_before_the_course_was_loaded_do_not_count() -> None:
    wrong = "%%check motion_blur\ndef displacement(velocity, time):\n    return 1"
    found, _ = session(wrong, "import numpy as np", "%load_ext course")
    assert found.module("motion_blur").text == b""


def test_functions_beside_a_notebook_are_not_the_notebooks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "assignments").mkdir()
    text = "def displacement(velocity, time):\n    return 7\n"
    (tmp_path / "assignments" / "motion_blur.py").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    effects = GivenEffects(Mine({}))
    assert not effects.written("motion_blur", "displacement")
    code = effects.function("motion_blur", "displacement").__code__
    assert Path(code.co_filename) == PROJECT / "solutions" / "motion_blur.py"
