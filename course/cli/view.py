"""`course view SCENE`: look around in a scene."""

from __future__ import annotations

from pathlib import Path

import click

from course.cli import options
from course.cli.metu import check_not_metu
from course.cli.serving import port_option, serve


@click.command()
@options.scene_argument
@click.option("--no-browser", is_flag=True, help="Only print the page's address.")
@port_option
def view(scene: Path, no_browser: bool, port: int | None) -> None:
    """Look around in a scene: orbit, change what matters, and ask pixels why they have their colour.

    Opens a page on this machine. The scene file stays as it is; the page shows its camera as YAML,
    and writes a new file beside it when you ask for one. Ctrl-C ends it.
    """
    from course.school.studio.studio import Studio

    check_not_metu(scene, "view")
    serve(Studio(scene, None), no_browser, port)
