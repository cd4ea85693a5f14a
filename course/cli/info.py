"""`course info SCENE`: what a scene holds, and what rendering it will ask for."""

from pathlib import Path

import click

from course.cli import options
from course.cli.metu import check_camera, converted, told_of, without_place
from course.cli.tables import print_sections, summary_sections
from course.engine.formats.metu.suffixes import is_metu
from course.engine.render.sections import Section


@click.command()
@options.scene_argument
@options.effects_option
@click.option("--camera", metavar="ID", help="Of a METU scene with several cameras, only this one.")
def info(scene: Path, effects: str | None, camera: str | None) -> None:
    """Say what a scene holds and what rendering it will call.

    Nothing is rendered. Effects that the scene does not need are listed with the reason, objects
    with where they lie, in the units of the file, and hints tell what is probably not meant. Of a
    METU scene (.xml or .json) each camera is told by itself.
    """
    check_camera(scene, camera)
    if not is_metu(scene):
        print_sections(str(scene), _sections(scene, scene, effects))
        return
    with converted(scene, camera) as chosen:
        for one in chosen:
            title = f"{scene}, camera {one.camera}"
            print_sections(title, _sections(scene, one.path, effects))


def _sections(scene: Path, file: Path, effects: str | None) -> list[Section]:
    """The summary of a file, in which places are told of the scene that the user has given."""
    from course import load_scene
    from course.engine.render.summary import summarize

    with told_of(scene, file):
        sections = summary_sections(summarize(load_scene(file, effects=effects)))
    if file == scene:
        return sections
    return [
        (heading, [(label, without_place(text, scene, file)) for label, text in rows])
        for heading, rows in sections
    ]
