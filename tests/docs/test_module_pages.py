"""Reports of grading send students to a heading of a page: both are there, and the pages' commands are real."""

from __future__ import annotations

import re
import shlex
import tomllib
from pathlib import Path

import click
import pytest

from course.cli.main import commands
from course.effects import COURSE, PROJECT
from course.grading.catalog import module_checks
from course.grading.release.archive import solution_lines

PAGES = PROJECT / "docs" / "modules"


@pytest.mark.parametrize("module", COURSE)
def test_every_function_has_its_heading(module: str) -> None:
    text = (PAGES / f"{module}.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (\w+)$", text, re.MULTILINE)
    assert set(COURSE[module]) <= set(headings)


@pytest.mark.parametrize("module", COURSE)
def test_a_page_gives_no_solution_away(module: str) -> None:
    lines = {
        line.strip() for line in (PAGES / f"{module}.md").read_text(encoding="utf-8").splitlines()
    }
    assert not lines & solution_lines(PROJECT / "solutions")


def _commands(path: Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    inline = re.findall(r"`(course [^`]+)`", text)
    blocks = re.findall(r"^ {4}(course [a-z].*)$", text, re.MULTILINE)
    return sorted({line.split("  #")[0].strip() for line in [*inline, *blocks]})


DOCUMENTS = [
    *sorted((PROJECT / "docs").rglob("*.md")),
    PROJECT / "README.md",
    PROJECT / "scenes" / "README.md",
]


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_every_command_is_one_that_the_program_takes(path: Path) -> None:
    for line in _commands(path):
        _, *words = shlex.split(line)
        context = click.Context(commands)
        command = commands.get_command(context, words[0])
        assert command is not None, line
        known = {
            name for option in command.params for name in (*option.opts, *option.secondary_opts)
        }
        for word in words[1:]:
            if word.startswith("-"):
                assert word.partition("=")[0] in known | {"--help", "-h"}, line
            elif word.startswith("scenes/") and "NAME" not in word and "schema" not in words:
                assert (PROJECT / word).exists(), line
        if "--only" in words and words[0] == "check" and "FUNCTION" not in line:
            function, _, name = words[words.index("--only") + 1].partition("/")
            checks = module_checks(words[1]).checks
            assert [
                check for check in checks if check.function == function and name in ("", check.name)
            ], line


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_what_make_and_python_are_asked_for_is_there(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    targets = re.findall(r"^([a-z-]+):", (PROJECT / "Makefile").read_text("utf-8"), re.MULTILINE)
    extras = tomllib.loads((PROJECT / "pyproject.toml").read_text("utf-8"))["project"]
    for target in re.findall(r"(?:^ {4}|`)make ([a-z-]+)", text, re.MULTILINE):
        assert target in targets
    for module in re.findall(r"python -m (benchmarks(?:\.\w+)*)", text):
        folder = PROJECT.joinpath(*module.split("."))
        assert folder.is_dir() or folder.with_suffix(".py").is_file(), module
    for extra in re.findall(r'"\.\[(\w+)\]"', text):
        assert extra in extras["optional-dependencies"]


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_every_file_that_is_named_is_there(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    folders = "assignments|benchmarks|course|docs|scenes|solutions|tests"
    for name in re.findall(rf"`((?:{folders})/[\w/.]*)`", text):
        if "NAME" not in name and name != "scenes/scene.schema.json":
            assert (PROJECT / name).exists(), name
