"""`course convert SCENE.xml -o SCENE.yaml`: scenes of METU's ray tracing courses as scenes of this one."""

from pathlib import Path

import click

from course.base.errors import OutputError
from course.cli import options
from course.cli.outputs import check_outputs


@click.command()
@options.scene_argument
@click.option(
    "-o",
    "--out",
    metavar="FILE.yaml",
    type=options.PATH,
    help="Scene file to write.  [default: SCENE's name with .yaml]",
)
def convert(scene: Path, out: Path | None) -> None:
    """Convert a METU scene, XML or JSON, to a scene file.

    With several cameras there is a file for each, FILE.PICTURE.yaml. Meshes that stand in the
    scene are written to the folder FILE.meshes, mesh files stay where they are. What isn't known
    is named in a warning.
    """
    from course.engine.formats.metu.converting import convert as convert_scene

    out = Path(f"{scene.stem}.yaml") if out is None else out
    if out.suffix.lower() not in (".yaml", ".yml"):
        raise OutputError(f"{out}: the name of a scene file must end in .yaml")
    check_outputs(files=[("-o", out)], source=scene)
    converted, warnings = convert_scene(scene, out)
    for warning in warnings:
        click.echo(f"warning: {warning}", err=True)
    for one in converted:
        click.echo(f"{one.path}: camera {one.camera}, {one.image}")
