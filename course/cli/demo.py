"""`course demo`: render scenes one after the other, and make a page that shows them."""

from __future__ import annotations

from pathlib import Path

import click

from course.atomic import make_folder, write_text
from course.cli.metu import check_not_metu
from course.cli.options import INTERRUPTED
from course.cli.outputs import check_distinct, check_outputs
from course.cli.progress import progress_bar
from course.cli.tables import print_sections, receipt_sections
from course.errors import SceneError

SCENES = Path(__file__).parents[2] / "scenes"
"""The scenes that come with the course."""

PAGE = "index.html"


@click.command()
@click.argument("scenes", metavar="[SCENE]...", nargs=-1, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    default=Path("out", "demo"),
    show_default=True,
    type=click.Path(path_type=Path),
    help="Folder for the pictures and the page; made if it isn't there.",
)
def demo(scenes: tuple[Path, ...], out: Path) -> None:
    """Render scenes, and a page that shows them.

    Without SCENE, those that come with the course.
    """
    from course import load_scene, render
    from course.cli.contact_sheet import Card, contact_sheet

    scenes = scenes or tuple(sorted(SCENES.glob("*.yaml")))
    if not scenes:
        raise SceneError(f"{SCENES}: there are no scene files (*.yaml)")
    for path in scenes:
        check_not_metu(path, "demo")
    pictures = [(f"the picture of {path},", out / f"{path.stem}.png") for path in scenes]
    check_distinct(pictures)
    make_folder(out)
    check_outputs(pictures, [("the page", out / PAGE)])

    cards = []
    for number, path in enumerate(scenes, start=1):
        click.echo(f"[{number}/{len(scenes)}] {path}", err=True)
        scene = load_scene(path)
        with progress_bar(path.stem) as progress:
            picture = render(scene, progress=progress)
        if picture.interrupted:
            raise click.exceptions.Exit(INTERRUPTED)
        file = out / f"{path.stem}.png"
        picture.save(file)
        receipt = picture.receipt.to_dict()
        print_sections(str(file), receipt_sections(receipt))
        height, width, _ = picture.linear.shape
        title = scene.title or path.stem
        cards.append(Card(title, file.name, file.read_bytes(), receipt, (width, height)))

    page = out / PAGE
    write_text(page, contact_sheet(cards))
    click.echo(f"\nAll of them on one page: {page}")
