"""`course start`: a folder to work in, beside an installed course."""

from pathlib import Path

import click

from course.cli.tables import count
from course.effects import PROJECT
from course.errors import CourseError


@click.command()
@click.argument("folder", type=click.Path(path_type=Path))
@click.option("--instructor", is_flag=True, help="Add the solutions, and how to grade a class.")
def start(folder: Path, instructor: bool) -> None:
    """Make FOLDER with all that a student works on: stubs, scenes, pages, and settings of VS Code.

    FOLDER must be new or empty.
    """
    from course.grading.release.archive import (
        LICENSES,
        PAGES,
        SCENES,
        project_files,
        write_folder,
    )
    from course.grading.release.folder import made_contents

    if not (PROJECT / "solutions").is_dir():
        raise CourseError("this is a student's copy: its stubs are in assignments/ already")
    solutions = PROJECT / "solutions"
    folders = SCENES | PAGES | ({"solutions": {".py", ".md"}} if instructor else {})
    made = made_contents(solutions, copy=False, instructor=instructor)
    files = write_folder(made | project_files(PROJECT, LICENSES, folders), folder)
    click.echo(f"{folder}: {count(files, 'file')}. Begin with README.md there:")
    click.echo(f"    cd {folder}")
    click.echo("    course check sampling")
