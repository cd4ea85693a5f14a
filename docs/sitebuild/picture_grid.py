"""Pictures in rows and columns, each with a line of words below it; all of them are seen at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape


@dataclass(frozen=True)
class Cell:
    """One picture.

    Attributes
    ----------
    address : of its file, as the page sees it
    caption : what stands below it
    alternative : for those who don't see it
    size : width and height [pixels]
    """

    address: str
    caption: str
    alternative: str
    size: tuple[int, int]


def grid(name: str, title: str, columns: int, cells: Sequence[Cell | None], same: str) -> str:
    """Lay out pictures.

    Parameters
    ----------
    name : of the figure, for links to it
    title : plain text
    columns : how many pictures stand side by side where there is room
    cells : row by row; None leaves a place empty
    same : how a reader makes the same pictures, as HTML
    """
    frames = "\n".join(_frame(cell) for cell in cells)
    return f"""<figure class="picture-grid of-{columns}" id="{name}" style="--columns: {columns}">
<div class="frames">
{frames}
</div>
<figcaption>{escape(title)}
<span class="same">{same}</span></figcaption>
</figure>
"""


def _frame(cell: Cell | None) -> str:
    if cell is None:
        return '<div class="empty"></div>'
    width, height = cell.size
    return (
        f'<div class="frame"><img src="{cell.address}" alt="{escape(cell.alternative)}" width="{width}"'
        f' height="{height}" loading="lazy"><span>{escape(cell.caption)}</span></div>'
    )
