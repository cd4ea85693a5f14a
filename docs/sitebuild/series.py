"""A series of pictures on a page: side by side, or one at a time under sliders (_static/series.js)."""

import json
from html import escape

from sitebuild import series_pictures
from sitebuild.place import Place
from sitebuild.series_file import Series, series_named


def series(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a series of docs/series.yaml."""
    chosen = series_named(name)
    first = tuple(slider.start for slider in chosen.sliders)
    frames = "\n".join(_frame(place, name, chosen, step, first) for step in chosen.steps())
    sliders = [
        {
            "name": slider.name,
            "start": slider.start,
            "words": [slider.words(k) for k in range(len(slider.values))],
        }
        for slider in chosen.sliders
    ]
    width = chosen.size[0] * chosen.enlarge
    kind = "series enlarged" if chosen.enlarge > 1 else "series"
    columns = len(chosen.sliders[-1].values) if len(chosen.sliders) > 1 else 3
    return f"""<figure class="{kind}" id="series-{name}" data-sliders="{escape(json.dumps(sliders))}" \
style="--shown: {width}px; --columns: {columns}">
<div class="frames">
{frames}
</div>
<figcaption>{escape(chosen.title)}
<span class="same" data-same>{_same(chosen, first)}</span></figcaption>
</figure>
"""


def _frame(
    place: Place, name: str, chosen: Series, step: tuple[int, ...], first: tuple[int, ...]
) -> str:
    address = series_pictures.address(place, name, chosen, step)
    width, height = chosen.size
    kind = "frame first" if step == first else "frame"
    return (
        f'<div class="{kind}" data-same="{escape(_same(chosen, step))}">'
        f'<img src="{address}" alt="{escape(chosen.alternative(step))}" width="{width}" height="{height}"'
        f' loading="lazy"><span>{escape(series_pictures.caption(chosen, step))}</span></div>'
    )


def _same(chosen: Series, step: tuple[int, ...]) -> str:
    """How a reader renders the same picture, as HTML."""
    line = f"<code>{escape(series_pictures.command(chosen, step))}</code>"
    changed = series_pictures.change(chosen, step)
    if not changed:
        return f"The same picture: {line}"
    return (
        f"The same picture: write <code>{escape(changed)}</code> into a copy of"
        f" <code>scenes/{chosen.scene}.yaml</code>, then {line}"
    )
