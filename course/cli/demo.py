"""`course demo`: render scenes one after the other, and make one HTML page that holds and shows all of them."""

from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import click

from course.base.atomic import make_folder, write_text
from course.base.errors import EffectError
from course.base.progress import progress_bar
from course.base.texts import count
from course.base.version import __version__
from course.cli.metu import check_not_metu
from course.cli.options import INTERRUPTED, PATH
from course.cli.outputs import check_distinct, check_outputs
from course.cli.tables import print_sections
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import MODULES
from course.engine.render.sections import Section, receipt_sections


@dataclass(frozen=True)
class Card:
    """A picture on the page.

    Attributes
    ----------
    title : what it shows
    file : name of the picture's file, relative to the page; the picture links to it
    png : bytes, the PNG itself, shown by the page
    receipt : as `course.engine.render.receipt.Receipt.to_dict` gives it
    size : (int, int), width and height [pixels]
    """

    title: str
    file: str
    png: bytes
    receipt: Mapping[str, Any]
    size: tuple[int, int]


def contact_sheet(cards: Sequence[Card]) -> str:
    """Return the page as HTML, with every text escaped and no reference to the network."""
    figures = "\n".join(_figure(card) for card in cards)
    rays = sum(sum(card.receipt["rays"].values()) for card in cards)
    seconds = sum(card.receipt["wall_seconds"] for card in cards)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Penumbra: {count(len(cards), "picture")}</title>
<style>{STYLE}</style>
</head>
<body>
<header>
<h1>Penumbra</h1>
<p>{count(len(cards), "picture")}, {rays / 1e6:,.1f} million rays, {seconds:,.1f} seconds</p>
</header>
<main>
{figures}
</main>
<footer>Rendered by course {escape(__version__)}. Choose a picture to see it at full size.</footer>
</body>
</html>
"""


def _figure(card: Card) -> str:
    receipt = card.receipt
    width, height = card.size
    facts = " · ".join(
        (
            f"{width} × {height}",
            f"{count(receipt['samples'], 'sample')} a pixel",
            f"{receipt['wall_seconds']:.2f} s on {count(receipt['threads'], 'thread')}",
        )
    )
    title, file = escape(card.title), escape(card.file)
    picture = f"data:image/png;base64,{b64encode(card.png).decode()}"
    return f"""<figure>
<a href="{file}"><img src="{picture}" alt="{title}" width="{width}" height="{height}"></a>
<figcaption>
<h2>{title}</h2>
<p>{escape(facts)}</p>
<details>
<summary>Receipt</summary>
<table>
{"".join(_rows(section) for section in receipt_sections(receipt))}</table>
</details>
</figcaption>
</figure>"""


def _rows(section: Section) -> str:
    heading, rows = section
    lines = [f'<tbody><tr><th colspan="2">{escape(heading)}</th></tr>\n']
    lines += [
        f"<tr><td>{escape(label)}</td><td>{escape(value.strip())}</td></tr>\n"
        for label, value in rows
    ]
    return "".join([*lines, "</tbody>\n"])


STYLE = """
:root {
  color-scheme: light dark;
  --page: #f4f2ee; --card: #fffefb; --ink: #24211c; --soft: #6d675d; --line: #ded9cf;
  --accent: #8a5a12; --shadow: 0 1px 2px #0001, 0 8px 24px #3b2f1a1a;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #131417; --card: #1c1e22; --ink: #ebe8e2; --soft: #a09b91; --line: #33363c;
    --accent: #e8b866; --shadow: 0 1px 2px #0006, 0 8px 24px #0006;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0; padding: clamp(1rem, 4vw, 3.5rem); background: var(--page); color: var(--ink);
  font: 1rem/1.5 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif;
}
header, main, footer { max-width: 86rem; margin: 0 auto; }
header { margin-bottom: clamp(1.25rem, 3vw, 2.5rem); }
h1 {
  margin: 0; font-size: clamp(2rem, 5vw, 3.25rem); font-weight: 650; letter-spacing: -0.03em;
  line-height: 1.1;
  text-shadow: 0.06em 0.08em 0.16em color-mix(in srgb, var(--ink) 35%, transparent);
}
header p, footer, figcaption p { color: var(--soft); font-variant-numeric: tabular-nums; }
header p { margin: 0.5rem 0 0; }
main {
  display: grid; gap: clamp(1rem, 2.5vw, 2rem); align-items: start;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 32rem), 1fr));
}
figure {
  margin: 0; overflow: hidden; background: var(--card); border: 1px solid var(--line);
  border-radius: 0.75rem; box-shadow: var(--shadow);
}
figure a { display: block; background: #000; }
figure a:focus-visible { outline: 3px solid var(--accent); outline-offset: -3px; }
img { display: block; width: 100%; height: auto; }
figcaption { padding: 1rem 1.25rem 1.1rem; }
h2 { margin: 0; font-size: 1.15rem; font-weight: 600; line-height: 1.3; overflow-wrap: anywhere; }
figcaption p { margin: 0.2rem 0 0.6rem; font-size: 0.9rem; }
summary { width: max-content; cursor: pointer; color: var(--accent); font-size: 0.9rem; }
table { width: 100%; margin-top: 0.5rem; border-collapse: collapse; font-size: 0.85rem; }
th { padding: 0.7rem 0 0.2rem; color: var(--soft); font-weight: 600; text-align: left; }
td { padding: 0.15rem 0; border-top: 1px solid var(--line); vertical-align: top; }
td + td { padding-left: 1rem; text-align: right; font-variant-numeric: tabular-nums; }
footer { margin-top: clamp(1.5rem, 3vw, 2.5rem); font-size: 0.85rem; }
"""


SCENES = PROJECT / "scenes"
"""The scenes that come with the course."""

SHOWN = ("still_life", "knots", "hills", "hall_of_mirrors")
"""The scenes that a demo renders."""

PAGE = "index.html"


@click.command()
@click.argument("scenes", metavar="[SCENE]...", nargs=-1, type=PATH)
@click.option(
    "-o",
    "--out",
    default=Path("out", "demo"),
    show_default=True,
    type=PATH,
    help="Folder for the pictures and the page; made if it isn't there.",
)
def demo(scenes: tuple[Path, ...], out: Path) -> None:
    """Render scenes, and a page that shows them.

    Without SCENE, four that come with the course. In a student's copy, those of the core modules, before and with each
    effect, as far as their functions are written.
    """
    from course import load_scene, render

    complete = bool(scenes) or (PROJECT / "solutions").is_dir()
    names = (
        SHOWN if complete else [name for module in MODULES for name in (f"before/{module}", module)]
    )
    scenes = scenes or tuple(SCENES / f"{name}.yaml" for name in names)
    for path in scenes:
        check_not_metu(path, "demo")
    files = {
        path: out / f"{'before_' * (path.parent.name == 'before')}{path.stem}.png"
        for path in scenes
    }
    pictures = [(f"the picture of {path},", file) for path, file in files.items()]
    check_distinct(pictures)
    make_folder(out)
    check_outputs(pictures, [("the page", out / PAGE)])

    cards = []
    for number, path in enumerate(scenes, start=1):
        click.echo(f"[{number}/{len(scenes)}] {path}", err=True)
        try:
            with progress_bar(path.stem) as progress:
                scene = load_scene(path)
                picture = render(scene, progress=progress)
        except EffectError as error:
            # Only a student's copy shows what there is of what nobody has written yet.
            if complete or not isinstance(error.__cause__, NotImplementedError):
                raise
            click.echo(str(error), err=True)
            continue
        if picture.interrupted:
            raise click.exceptions.Exit(INTERRUPTED)
        file = files[path]
        picture.save(file)
        receipt = picture.receipt.to_dict()
        print_sections(str(file), receipt_sections(receipt))
        height, width, _ = picture.linear.shape
        title = scene.title or path.stem
        cards.append(Card(title, file.name, file.read_bytes(), receipt, (width, height)))

    page = out / PAGE
    write_text(page, contact_sheet(cards))
    click.echo(f"\nAll of them on one page: {page}")
