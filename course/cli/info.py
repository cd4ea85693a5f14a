"""`course info SCENE`: what a scene holds, and what rendering it will ask for."""

from __future__ import annotations

from pathlib import Path

import click

from course.cli.tables import print_sections, summary_sections


@click.command()
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--effects",
    help="Whose functions would be called: solutions, assignments, or a folder of modules."
    "  [default: solutions, or assignments where there are none]",
)
def info(scene: Path, effects: str | None) -> None:
    """Say what a scene holds and what rendering it will call.

    Nothing is rendered. Effects that the scene does not need are listed with the reason, objects
    with where they lie, in the units of the file, and hints tell what is probably not meant.
    """
    from course import load_scene
    from course.rendering.summary import summarize

    print_sections(str(scene), summary_sections(summarize(load_scene(scene, effects=effects))))
