"""`course schema`: the JSON schema of scene files, for editors that complete and check them."""

import json
from pathlib import Path

import click

from course.base.atomic import write_text
from course.cli import options


@click.command()
@click.option(
    "-o",
    "--out",
    metavar="FILE.json",
    callback=options.json_path,
    help="Write it here, instead of printing it.",
)
def schema(out: Path | None) -> None:
    """Print the JSON schema of scene files.

    With the YAML extension of an editor, the line `# yaml-language-server: $schema=FILE.json` at
    the top of a scene completes its keys and marks mistakes; FILE.json is relative to the scene.
    `course schema -o scenes/scene.schema.json` writes the one that scenes/still_life.yaml names.
    """
    from course.engine.formats.yaml.schema import json_schema

    text = json.dumps(json_schema(), indent=2) + "\n"
    if out is None:
        click.echo(text, nl=False)
    else:
        write_text(out, text)
