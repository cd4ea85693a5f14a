"""`course pixel SCENE X,Y`: what the samples of a pixel met, and why it has its colour."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.atomic import write_text
from course.cli import options
from course.cli.metu import check_not_metu
from course.cli.outputs import check_outputs

if TYPE_CHECKING:
    from course.engine.recording.story import Line


_PLACE = r"([0-9]{1,5}),([0-9]{1,5})(?:,([1-9][0-9]{0,4})[xX]([1-9][0-9]{0,4}))?"


def _place(_ctx: click.Context, _option: click.Parameter, text: str) -> tuple[int, int, int, int]:
    """Return column, row, width and height in pixels from X,Y or X,Y,WIDTHxHEIGHT."""
    match = re.fullmatch(_PLACE, text)
    if match is None:
        raise click.BadParameter(
            f"{text!r} is not a pixel: expected X,Y, counted from the upper left corner, such as 120,80,"
            " or X,Y,WIDTHxHEIGHT for a rectangle"
        )
    x, y, width, height = (int(number or 1) for number in match.groups())
    return x, y, width, height


@click.command()
@options.scene_argument
@click.argument("place", metavar="X,Y", callback=_place)
@click.option("--spp", type=click.IntRange(1, 65536), help="Samples a pixel.")
@click.option(
    "--size", metavar="WxH", callback=options.size, help="Size of the picture, such as 640x480."
)
@click.option("--seed", type=click.IntRange(0, 2**32 - 1), help="Seed of every random choice.")
@options.effects_option
@click.option(
    "--html", type=options.PATH, help="Write a page that shows the rays in the scene, in one file."
)
@click.option("--json", "as_json", is_flag=True, help="Print every segment as JSON, for programs.")
def pixel(
    scene: Path,
    place: tuple[int, int, int, int],
    spp: int | None,
    size: tuple[int, int] | None,
    seed: int | None,
    effects: str | None,
    html: Path | None,
    as_json: bool,
) -> None:
    """Tell why a pixel of a scene's picture has its colour.

    The pixel is rendered once more, with the same samples to the last bit, and what each ray met
    is told: which objects block the lights, which functions were asked and what they returned.
    X,Y is counted from the upper left corner, and X,Y,WxH is a rectangle. What the options leave
    open is as the scene file says.
    """
    check_not_metu(scene, "pixel")
    check_outputs(files=[("--html", html)], source=scene)
    from course.engine.recording.pixel import pixel as tell

    story = tell(scene, *place, spp=spp, size=size, seed=seed, effects=effects)
    if html is not None:
        from course.engine.recording.view import page

        write_text(html, page(story))
    if as_json:
        click.echo(json.dumps(story.to_dict()))
    elif sys.stdout.isatty():
        from rich.console import Console
        from rich.text import Text
        from rich.tree import Tree

        def rich_tree(line: Line) -> Tree:
            tree = Tree(Text(line.text), guide_style="dim")
            tree.children = [rich_tree(below) for below in line.below]
            return tree

        Console().print(rich_tree(story.tree))
    else:
        click.echo("\n".join(_plain(story.tree)))


def _plain(line: Line, indent: str = "") -> list[str]:
    """Return the tree as lines of text."""
    return [indent + line.text, *(text for b in line.below for text in _plain(b, indent + "  "))]
