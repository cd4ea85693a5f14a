"""A figure: panels side by side, and what it says to those who see it and to those who don't."""

import re
from dataclasses import dataclass
from html import escape
from xml.etree import ElementTree as ET

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.movable import Movable, Movement, shown


@dataclass(frozen=True)
class Panel:
    """A drawing.

    Attributes
    ----------
    canvas : what is drawn
    title : short, for screen readers
    description : what there is to see, for those who can't
    words : below the drawing; a panel of a sequence begins with its number
    """

    canvas: Canvas
    title: str
    description: str
    words: str = ""


@dataclass(frozen=True)
class Figure:
    """Panels and a caption.

    Attributes
    ----------
    caption : below all panels, one paragraph
    panels : drawings of one width, 350 units for one that fills a telephone's screen, 172 for two in a row
    movement : what readers can drag, in a figure of one panel
    """

    caption: str
    panels: tuple[Panel, ...]
    movement: Movement | None = None


def html(figure: Figure, name: str) -> str:
    """The figure as a block of HTML without a blank line; its ids begin with the name."""
    width = "wide" if figure.panels[0].canvas.width > 200 else "small"
    panels = "\n".join(drawing(panel, f"{name}-{k}") for k, panel in enumerate(figure.panels, 1))
    moves = figure.movement.attributes if figure.movement else ""
    readout = _readout(figure.movement) if figure.movement else ""
    return f"""<figure class="diagram" id="{name}"{moves}>
<div class="panels {width} of-{len(figure.panels)}">
{panels}
</div>
{readout}<figcaption>{symbols(figure.caption)}</figcaption>
</figure>
"""


def drawing(panel: Panel, name: str) -> str:
    """A drawing with its words, as one line of HTML; its ids begin with the name."""
    canvas = panel.canvas
    svg = ET.Element(
        "svg",
        {
            "viewBox": f"0 0 {canvas.width:g} {canvas.height:g}",
            "role": "img",
            "aria-labelledby": f"{name}-title {name}-description",
        },
    )
    if isinstance(canvas, Movable):
        svg.set("data-frame", canvas.frame)
    ET.SubElement(svg, "title", id=f"{name}-title").text = panel.title
    ET.SubElement(svg, "desc", id=f"{name}-description").text = panel.description
    # Words stand on top of all lines.
    svg.extend(sorted(canvas.elements, key=lambda element: element.tag == "text"))
    drawn = ET.tostring(svg, encoding="unicode")
    words = f"<p>{symbols(panel.words)}</p>" if panel.words else ""
    return f'<div class="panel">{drawn}{words}</div>'


def _readout(movement: Movement) -> str:
    """The movement's sentence with the numbers of the drawing at rest."""
    numbers = movement.model(movement.start).numbers

    def number(match: re.Match[str]) -> str:
        name, digits = match[1], int(match[2])
        return f'<b data-number="{name}" data-digits="{digits}">{shown(numbers[name], digits)}</b>'

    said = re.sub(r"\{(\w+):\.(\d)f\}", number, symbols(movement.sentence))
    return f'<p class="readout">{said}</p>\n'


def symbols(text: str) -> str:
    """A sentence as HTML, with its symbols between dollars slanted and their indices lowered."""
    pieces = escape(text, quote=False).split("$")
    for k in range(1, len(pieces), 2):
        piece = re.sub(r"([^\W\d_]+)", _slanted, pieces[k])
        piece = re.sub(
            r"_(\{.*?\}|<i>.*?</i>|.)", lambda m: f"<sub>{m[1].strip('{}')}</sub>", piece
        )
        pieces[k] = re.sub(
            r"\^(\{.*?\}|<i>.*?</i>|.)", lambda m: f"<sup>{m[1].strip('{}')}</sup>", piece
        )
    return "".join(pieces)


def _slanted(match: re.Match[str]) -> str:
    return match[1] if match[1] in ("cos", "sin", "max") else f"<i>{match[1]}</i>"
