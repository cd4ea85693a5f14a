"""The page "Add a module" is complete: the module that it shows is built from it, and graded."""

import re
import shutil
from pathlib import Path

import pytest

from course.cli.options import FAILED
from course.engine.functions.effects import PROJECT
from tests.processes import python

PAGE = PROJECT / "docs" / "guides" / "new_module.md"

LONGEST = 200
"""Lines of all that it shows."""

needs_course = pytest.mark.skipif(not PAGE.is_file(), reason="a student's copy has no such page")


def shown() -> dict[str, str]:
    """Path -> the code that follows it on the page."""
    blocks = re.findall(
        r"^`([\w/]+\.(?:py|yaml))`[^\n]*:\n\n```\w+\n(.*?)^```$", PAGE.read_text(), re.M | re.S
    )
    return dict(blocks)


def run(folder: Path, *arguments: str) -> str:
    """What a command says in a copy of the project."""
    done = python("-m", *arguments, folder=folder, path=folder, may_fail=True)
    assert done.returncode in (0, FAILED), done.stdout + done.stderr
    return done.stdout + done.stderr


@needs_course
def test_a_module_is_complete_in_two_hundred_lines() -> None:
    assert sum(code.count("\n") for code in shown().values()) < LONGEST


@needs_course
def test_the_module_of_the_page_is_built_and_graded(tmp_path: Path) -> None:
    for name in ("course", "benchmarks", "solutions", "assignments"):
        shutil.copytree(
            PROJECT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__", "out")
        )
    # By it the package knows that it is a checkout.
    shutil.copy(PROJECT / "pyproject.toml", tmp_path)
    for path, code in shown().items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(code)

    assert "vignetting" in run(tmp_path, "course", "release")
    stub = (tmp_path / "assignments" / "vignetting.py").read_text()
    assert 'NotImplementedError("vignetting.falloff: not written yet")' in stub
    assert "cos**4" not in stub

    solved = run(tmp_path, "course", "check", "vignetting", "--folder", "solutions")
    assert "20 of 20 points" in solved, solved
    unwritten = run(tmp_path, "course", "check", "vignetting")
    assert unwritten.count("to do") == 2, unwritten
    assert "0 of 20 points" in unwritten

    graded = run(tmp_path, "benchmarks.mutants", "vignetting", "--jobs", "1")
    assert "0 faults of the grader" in graded, graded
    assert "told: crowded-inside" in graded
    # Two orders of u, its sense and the axes: three variants, all named as the original.
    assert "| vignetting | 3 | 3 | 3 | 3 | 0 |" in graded, graded
