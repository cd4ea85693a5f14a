"""`course start`: a folder to work in, beside an installed course."""

import re
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from shlex import quote

import click

from course.base.errors import CourseError
from course.base.texts import count
from course.cli.options import PATH
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import WARM_UP

TEACHING = "docs/guides/teaching.md"
"""The page for who plans a course; its tables are made, on the site and for instructors."""


@click.command()
@click.argument("folder", type=PATH)
@click.option("--instructor", is_flag=True, help="Add the solutions, and how to grade a class.")
@click.option(
    "--notebooks", is_flag=True, help="Make a notebook of each module, to be written in there."
)
def start(folder: Path, instructor: bool, notebooks: bool) -> None:
    """Make FOLDER with all that a student works on: stubs, scenes, pages, and settings of VS Code.

    FOLDER must be new or empty.
    """
    from course.school.grading.release.archive import (
        LICENSES,
        PAGES,
        SCENES,
        project_files,
        write_folder,
    )
    from course.school.grading.release.folder import made_contents
    from course.school.grading.release.pages import plain_pages

    if not (PROJECT / "solutions").is_dir():
        raise CourseError("this is a student's copy: its stubs are in assignments/ already")
    solutions = PROJECT / "solutions"
    folders = SCENES | PAGES | ({"solutions": {".py", ".md"}} if instructor else {})
    make: Callable[[str, str], bytes] | None = None
    if notebooks:
        from course.school.notebooks.making import notebook_of

        def make(module: str, text: str) -> bytes:
            return notebook_of(module, text, PROJECT)

    made = made_contents(solutions, copy=False, instructor=instructor, notebooks=make)
    contents = project_files(PROJECT, LICENSES, folders)
    if instructor:
        contents[TEACHING] = _with_tables(contents[TEACHING].decode()).encode()
    files = write_folder(made | plain_pages(contents), folder)
    click.echo(f"{folder}: {count(files, 'file')}. Begin with README.md there:")
    click.echo(f"    cd {quote(str(folder))}")
    if notebooks:
        click.echo(
            f"    jupyter lab     # and there assignments/{WARM_UP}.ipynb; or open the folder in an editor"
        )
    else:
        click.echo(f"    course check {WARM_UP}")
    if instructor:
        click.echo(f"To plan lectures and weeks, read {TEACHING}.")


def _with_tables(page: str) -> str:
    """The page with its tables of minutes, weeks and objectives, which the site's own program makes."""
    if str(PROJECT / "docs") not in sys.path:
        sys.path.append(str(PROJECT / "docs"))
    plans, objectives = map(import_module, ("sitebuild.plans", "sitebuild.objectives"))
    place = import_module("sitebuild.place").Place("", True, Path(), {})
    parts = {
        "minutes": plans.minutes_table,
        "plan": plans.plan,
        "objectives": objectives.objectives,
    }

    def table(found: re.Match[str]) -> str:
        name, _, words = found[2].partition(" ")
        return str(parts[found[1]](place, name, words))

    return re.sub(rf"<!-- site: ({'|'.join(parts)}) ?(.*?) -->", table, page)
