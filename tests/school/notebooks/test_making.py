"""Notebooks of the modules hold what the stubs hold, and are handed in as the programs are."""

import ast
import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from course.cli.main import commands
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reachable import reachable
from course.engine.functions.notebook.reading import read_notebook
from course.school.notebooks.making import notebook_of
from tests.school.grading.lent import ReferencesFile, at_hand

SCENE = PROJECT / "scenes" / "motion_blur.yaml"


def program(module: str, folder: str) -> str:
    return (PROJECT / folder / f"{module}.py").read_text(encoding="utf-8")


def made(module: str, folder: str) -> bytes:
    return notebook_of(module, program(module, folder), PROJECT)


def used(module: str, text: str | bytes) -> list[str]:
    """Whatever the module's functions come to use, in no order."""
    return sorted(ast.dump(node) for node in reachable(module, ast.parse(text), imports=True))


@pytest.mark.parametrize("folder", ["assignments", "solutions"])
@pytest.mark.parametrize("module", COURSE)
def test_what_is_handed_in_is_the_program(module: str, folder: str) -> None:
    # The same statements, so the same points.
    found = read_notebook(f"{module}.ipynb", made(module, folder), [module])
    assert found.told == ()
    assert used(module, found.sources[module]) == used(module, program(module, folder))


@pytest.mark.parametrize("module", COURSE)
def test_it_is_a_notebook_as_jupyter_has_them(module: str) -> None:
    nbformat = pytest.importorskip("nbformat", reason='needs: pip install -e ".[notebook]"')
    document = json.loads(made(module, "assignments"))
    nbformat.validate(document)
    codes = ["".join(c["source"]) for c in document["cells"] if c["cell_type"] == "code"]
    heads = [code.partition("\n")[0] for code in codes]
    assert heads[0] == "%load_ext course"
    # One cell to check a function.
    assert heads.count(f"%%check {module}") == len(COURSE[module])
    # No answer is in it, and every cell has a name of its own.
    assert sum("NotImplementedError" in code for code in codes) == len(COURSE[module])
    assert len({cell["id"] for cell in document["cells"]}) == len(document["cells"])


def run(*arguments: str) -> Any:
    return CliRunner().invoke(commands, [*arguments])


@pytest.fixture
def book(tmp_path: Path) -> Path:
    """A student's notebook: one function right, one wrong, one to do."""
    solved, stub = (json.loads(made("motion_blur", f)) for f in ("solutions", "assignments"))
    cells = [
        new if "def shutter_times" in "".join(new["source"]) else old
        for old, new in zip(stub["cells"], solved["cells"], strict=True)
    ]
    wrong = next(cell for cell in cells if "def displacement" in "".join(cell["source"]))
    text = "".join(wrong["source"]).partition("    # TODO")[0]
    wrong["source"] = f"{text}    return np.outer(velocity, time).astype(time.dtype) * 2\n"
    folder = tmp_path / "assignments"
    folder.mkdir()
    file = folder / "motion_blur.ipynb"
    file.write_text(json.dumps(stub | {"cells": cells}), encoding="utf-8")
    return file


def as_program(book: Path, folder: Path) -> Path:
    """The same work as a program."""
    source = read_notebook(book.name, book.read_bytes(), ["motion_blur"]).sources["motion_blur"]
    folder.mkdir()
    (folder / "motion_blur.py").write_bytes(source)
    return folder


@pytest.mark.usefixtures("lent_references")
def test_a_notebook_is_checked_as_its_program_is(book: Path, tmp_path: Path) -> None:
    program = as_program(book, tmp_path / "program")
    other = run("check", "motion_blur", "--folder", str(program))
    # Places are those of the notebook: the function begins below the line of its magic.
    number = 1 + next(
        n
        for n, cell in enumerate(json.loads(book.read_text())["cells"])
        if "def displacement" in "".join(cell["source"])
    )
    for arguments in (
        [str(book)],
        ["motion_blur", "--folder", str(book.parent)],
        ["motion_blur", "--folder", str(book)],
    ):
        own = run("check", *arguments)
        assert own.exit_code == other.exit_code == 3, arguments
        points = [text.stdout.splitlines()[-1].partition(" points")[0] for text in (own, other)]
        assert points[0] == points[1], arguments
        assert "right    shutter_times" in own.stdout, arguments
        assert "to do    to_object_space" in own.stdout, arguments
        assert f"motion_blur.ipynb, cell {number}, line 2" in own.stdout, arguments


@pytest.mark.usefixtures("lent_references")
def test_what_python_stopped_at_is_told_by_its_cell(book: Path) -> None:
    document = json.loads(book.read_text())
    for cell in document["cells"]:
        text = "".join(cell["source"])
        if "def displacement" in text:
            cell["source"] = f"{text.partition('    return')[0]}    return missing\n"
            line = cell["source"].count("\n")
    book.write_text(json.dumps(document), encoding="utf-8")
    shown = run("check", str(book), "--only", "displacement", "--lines")
    assert f'File "motion_blur.ipynb", cell 6, line {line}' in shown.stdout
    assert f"motion_blur.ipynb, cell 6, line {line}: error: displacement" in shown.stdout


@pytest.mark.usefixtures("lent_references")
def test_status_and_grades_are_those_of_the_program(
    book: Path, tmp_path: Path, references_file: ReferencesFile
) -> None:
    told = json.loads(run("status", "motion_blur", "--folder", str(book.parent), "--json").stdout)
    assert [one["state"] for one in told["functions"]] == ["right", "wrong", "to do"]
    assert {one["cell"] for one in told["functions"]} == {4, 6, 8}
    class_ = tmp_path / "class"
    for name, content in (("ada", book), ("ben", None)):
        (class_ / name).mkdir(parents=True)
        source = content or as_program(book, tmp_path / "program") / "motion_blur.py"
        (class_ / name / source.name).write_bytes(source.read_bytes())
    graded = tmp_path / "graded"
    options = "--modules", "motion_blur", "--jobs", "1"
    with at_hand(references_file):
        shown = run("grade", str(class_), "--out", str(graded), *options)
    assert shown.exit_code == 0, shown.output
    rows = (graded / "grades.csv").read_text().splitlines()
    ada, ben = (next(row for row in rows if name in row).split(",") for name in ("ada", "ben"))
    points = rows[0].split(",").index("points")
    assert ada[points] == ben[points]
    assert float(ada[points]) == pytest.approx(told["points"], abs=0.01)


def test_a_scene_calls_the_functions_of_a_notebook(book: Path) -> None:
    effects = Effects(book.parent, filled=True)
    assert effects.written("motion_blur", "shutter_times")
    assert not effects.written("motion_blur", "to_object_space")
    called = effects.function("motion_blur", "displacement")
    import numpy as np

    moved = called(np.array([1, 2, 3], np.float32), np.array([0.5], np.float32))
    np.testing.assert_allclose(moved[:, 0], [1, 2, 3])
    # The same from the notebook alone.
    assert Effects(book, filled=True).written("motion_blur", "shutter_times")


def test_a_wrong_result_is_told_by_cell_and_line(book: Path) -> None:
    import numpy as np

    from course.base.errors import FunctionError

    document = json.loads(book.read_text())
    for cell in document["cells"]:
        text = "".join(cell["source"])
        if "def displacement" in text:
            cell["source"] = f"{text.partition('    return')[0]}    return velocity[9]\n"
            line = cell["source"].count("\n")
    book.write_text(json.dumps(document), encoding="utf-8")
    function = Effects(book).function("motion_blur", "displacement")
    with pytest.raises(FunctionError) as caught:
        function(np.ones(3, np.float32), np.ones(2, np.float32))
    said = str(caught.value)
    assert "motion_blur.ipynb, cell 6, line 2)" in said
    assert f"in {book.name}, cell 6, line {line}: return velocity[9]" in said


@pytest.mark.usefixtures("lent_references")
def test_a_program_goes_before_a_notebook_and_that_is_told(book: Path) -> None:
    (book.parent / "motion_blur.py").write_text(program("motion_blur", "solutions"))
    shown = run("check", "motion_blur", "--folder", str(book.parent))
    assert "30 of 30 points" in shown.stdout
    assert "motion_blur.ipynb is left alone" in shown.stderr


@pytest.mark.usefixtures("lent_references")
def test_a_notebook_of_any_name_holds_what_it_defines(book: Path) -> None:
    book.rename(book.with_name("homework 3.ipynb"))
    shown = run("check", "motion_blur", "--folder", str(book.parent))
    assert "right    shutter_times" in shown.stdout
    (book.parent / "copy.ipynb").write_bytes((book.parent / "homework 3.ipynb").read_bytes())
    twice = run("check", "motion_blur", "--folder", str(book.parent))
    assert twice.exit_code == 1
    assert "copy.ipynb, homework 3.ipynb define functions of motion_blur" in twice.output


def test_a_notebook_without_the_module_says_so(book: Path) -> None:
    shown = run("check", "thin_lens", "--folder", str(book))
    assert "motion_blur.ipynb has no thin_lens" in shown.stdout


def test_a_folder_of_notebooks_is_started(tmp_path: Path) -> None:
    folder = tmp_path / "my course"
    shown = run("start", str(folder), "--notebooks")
    assert shown.exit_code == 0
    names = {path.name for path in (folder / "assignments").iterdir()}
    assert names == {f"{module}.ipynb" for module in COURSE}
    assert "assignments/sampling.ipynb" in shown.stdout
    assert "sampling.ipynb" in (folder / "README.md").read_text(encoding="utf-8")
    assert (folder / "docs" / "notebooks" / "first_look.ipynb").is_file()
