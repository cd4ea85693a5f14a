"""`course studio [SCENE]`: one's functions, and what they do to a picture, on one page that follows every save."""

from __future__ import annotations

from pathlib import Path

import click

from course.base.errors import CourseError
from course.cli import options
from course.cli.metu import check_not_metu
from course.cli.serving import port_option, serve
from course.engine.functions.effects import PROJECT


@click.command()
@click.argument("scene", metavar="[SCENE]", type=options.PATH, required=False)
@click.option(
    "--module",
    callback=options.module_from,
    metavar="MODULE",
    help="Whose functions come first.  [default: those that the scene calls]",
)
@click.option("--effects", default="mine", show_default=True, help="Folder of your functions.")
@click.option("--no-browser", is_flag=True, help="Only print the page's address.")
@port_option
def studio(
    scene: Path | None, module: str | None, effects: str, no_browser: bool, port: int | None
) -> None:
    """See what your functions do to a picture, while you write them.

    Opens a page on this machine. Whenever you save a file, the picture is rendered again with your
    functions, beside the course's, and your functions are checked. Without SCENE it is that of the
    module, or soft_shadows. Ctrl-C ends it.
    """
    from course.school.studio.studio import Studio

    if scene is None:
        scene = _scene_of(module or "soft_shadows")
    check_not_metu(scene, "studio")
    serve(Studio(scene, effects, module), no_browser, port)


def _scene_of(module: str) -> Path:
    """The scene of a module, from this folder or the project's."""
    name = Path("scenes", f"{module}.yaml")
    for path in (name, PROJECT / name):
        if path.is_file():
            return path
    raise CourseError(f"there is no {name}: name a scene")
