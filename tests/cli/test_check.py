"""`course check`: which modules are checked."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from course.cli.options import FAILED
from course.effects import COURSE

Run = Callable[..., Result]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Modules in which nothing is written yet."""
    made = tmp_path / "mine"
    made.mkdir()
    for module, functions in COURSE.items():
        lines = [f"def {name}(*_, **__):\n    raise NotImplementedError\n" for name in functions]
        (made / f"{module}.py").write_text("\n".join(lines), encoding="utf-8")
    return made


@pytest.mark.parametrize("names", ["bokeh", "thin_lens,bokeh", "thin_lens,", "THIN_LENS"])
def test_a_name_of_no_module_is_told_with_the_names_that_are(
    run: Run, folder: Path, names: str
) -> None:
    result = run("check", names, "--folder", folder)
    assert result.exit_code == 2
    wrong = names.rpartition(",")[2]
    assert f"{wrong!r}; the modules are {', '.join(COURSE)}" in result.stderr
    assert not result.stdout


@pytest.mark.parametrize(
    "names", [["motion_blur,thin_lens"], ["motion_blur", "thin_lens,motion_blur"]]
)
def test_modules_are_checked_once_and_in_the_order_of_the_course(
    run: Run, folder: Path, names: list[str]
) -> None:
    result = run("check", *names, "--folder", folder, "--json", "found.json")
    assert result.exit_code == FAILED, result.output
    shown = [line for line in result.stdout.splitlines() if line in COURSE]
    assert shown == ["thin_lens", "motion_blur"]
    found = json.loads(Path("found.json").read_text(encoding="utf-8"))
    checked = [(one["module"], one["function"]) for one in found["results"]]
    functions = [(module, name) for module in shown for name in COURSE[module]]
    assert list(dict.fromkeys(checked)) == functions


def test_without_names_all_modules_are_meant(run: Run, folder: Path) -> None:
    result = run("check", "--only", "bokeh", "--folder", folder)
    assert result.exit_code == 1
    assert f"no check of {', '.join(COURSE)} has that name" in result.stderr
