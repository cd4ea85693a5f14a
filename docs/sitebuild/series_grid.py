"""All pictures of a series of two sliders at once: the first slider's values in rows, the second's in columns."""

from html import escape

from sitebuild import series_pictures
from sitebuild.picture_grid import Cell, grid
from sitebuild.place import Place
from sitebuild.series_file import Series, series_named


def series_grid(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a series of docs/series.yaml without its sliders."""
    chosen = series_named(name)
    cells = [_cell(place, name, chosen, step) for step in chosen.steps()]
    last = tuple(len(slider.values) - 1 for slider in chosen.sliders)
    line = f"<code>{escape(series_pictures.command(chosen, last))}</code>"
    changed = escape(series_pictures.change(chosen, last))
    same = (
        f"The last picture: write <code>{changed}</code> into a copy of"
        f" <code>scenes/{chosen.scene}.yaml</code>, then {line}"
    )
    return grid(f"series-{name}", chosen.title, len(chosen.sliders[-1].values), cells, same)


def _cell(place: Place, name: str, chosen: Series, step: tuple[int, ...]) -> Cell:
    address = series_pictures.address(place, name, chosen, step)
    values = ", ".join(slider.words(at) for slider, at in zip(chosen.sliders, step, strict=True))
    return Cell(address, values, chosen.alternative(step), chosen.size)
