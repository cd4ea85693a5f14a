"""A room on its way to its light under two sliders (_static/series.js): one of iterations and one of shots."""

import json
from html import escape

from sitebuild.picture_grid import Cell
from sitebuild.place import Place
from sitebuild.radiosity_pictures import Method, Room, command, step

ITERATIONS = (0, 1, 2, 3, 5, 10, 32)
SHOTS = (1, 10, 32, 100, 320, 1000)
"""Those of the grid are among them, so that their pictures are the same files."""


def radiosity_scrubber(place: Place, name: str, words: str = "") -> str:
    """Show a room after each of some steps, one at a time; ``words`` are the captions, with a bar between them."""
    room = Room(name)
    first, _, second = words.partition("|")
    return (
        '<div class="two-series">\n'
        + _series(place, room, "gather", ITERATIONS, first.strip())
        + _series(place, room, "shoot", SHOTS, second.strip())
        + "</div>\n"
    )


def _series(place: Place, room: Room, method: Method, counts: tuple[int, ...], words: str) -> str:
    unit = "iterations" if method == "gather" else "shots"
    frames = "\n".join(
        _frame(
            step(place, room, method, count), command(room.name, method, count), count == counts[0]
        )
        for count in counts
    )
    slider = {"name": unit, "start": 0, "words": [f"{count:,}" for count in counts]}
    same = escape(command(room.name, method, counts[0]))
    return f"""<figure class="series" id="{unit}-{room.name}" data-sliders="{escape(json.dumps([slider]))}" \
style="--shown: 280px; --columns: 3">
<div class="frames">
{frames}
</div>
<figcaption>{escape(words)}
<span class="same" data-same><code>{same}</code></span></figcaption>
</figure>
"""


def _frame(cell: Cell, line: str, first: bool) -> str:
    width, height = cell.size
    same = escape(f"<code>{escape(line)}</code>")
    return (
        f'<div class="frame{" first" if first else ""}" data-same="{same}"><img src="{cell.address}"'
        f' alt="{escape(cell.alternative)}" width="{width}" height="{height}" loading="lazy">'
        f"<span>{escape(cell.caption)}</span></div>"
    )
