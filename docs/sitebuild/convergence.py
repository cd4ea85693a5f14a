"""Plots of what the benchmarks measured, from the data files that they wrote, with the same numbers as a table.

``<!-- site: convergence MODULE -->`` shows all comparisons of a module, each over samples and over seconds;
``convergence MODULE GROUP`` one of them; a last word ``samples`` or ``seconds`` one of the two plots of each.
"""

from html import escape

import msgspec

from course.base.errors import CourseError
from course.benchmarking.plot_data import Plot, Record, read_records
from course.benchmarking.tables import digits
from course.engine.functions.effects import PROJECT
from sitebuild.convergence_plot import amount, svg, swatch
from sitebuild.place import Place

DATA = PROJECT / "docs" / "data"
TIME = "seconds"
AXES = ("samples", TIME)
MACHINE = ("processor", "threads")
"""What of the machine is told beside a plot; the data file has the rest."""


def convergence(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show what was measured of a module as figures with plots.

    Raises
    ------
    CourseError
        There is no data file, or it has nothing of what was asked for.
    """
    wanted = words.split()
    axis = wanted.pop() if wanted and wanted[-1] in AXES else ""
    figures = [
        _figure(msgspec.structs.replace(plot, axes=axes), record)
        for record in records(name)
        for plot in record.plots
        if wanted in ([], [plot.name]) and (axes := _chosen(plot, axis))
    ]
    if not figures:
        raise CourseError(f"{name} has no such plot; measure it with --write-docs")
    return "\n\n".join(figures) + "\n"


def records(module: str) -> list[Record]:
    """Read what was measured of a module: by ``course bench``, and by a benchmark of its own.

    Raises
    ------
    CourseError
        Neither has measured it.
    """
    files = [DATA / "bench.json", DATA / f"{module}.json"]
    found = [read_records(file) for file in files if file.is_file()]
    chosen = [data[module] for data in found if module in data]
    if not chosen:
        raise CourseError(f"{DATA} has no measurement of {module}: make one with --write-docs")
    return chosen


def _chosen(plot: Plot, axis: str) -> dict[str, str]:
    """Return the axes that are asked for; "samples" is any that isn't time."""
    return {
        name: about
        for name, about in plot.axes.items()
        if not axis or (name == TIME) == (axis == TIME)
    }


def _figure(plot: Plot, record: Record) -> str:
    panels = "\n".join(f'<div class="plot">\n{svg(plot, axis)}\n</div>' for axis in plot.axes)
    return f"""<figure class="convergence">
<p class="title">{escape(plot.title[0].upper() + plot.title[1:])}</p>
<div class="panels">
{panels}
</div>
<ul class="legend">
{_legend(plot)}
</ul>
<figcaption>{_caption(plot, record)}</figcaption>
<details><summary>The numbers as a table</summary>
{_table(plot)}
</details>
</figure>"""


def _legend(plot: Plot) -> str:
    items = []
    for series in plot.series:
        if series.predicted:
            continue
        notes = [] if series.order is None else [f"order {series.order:.2f}"]
        notes += [f"dotted: bias {digits(series.limit)}"] if series.limit else []
        note = f" <span>{', '.join(notes)}</span>" if notes else ""
        items.append(f"<li>{swatch(series)} {escape(series.name)}{note}</li>")
    predicted = [series for series in plot.series if series.predicted]
    if predicted:
        items.append(f"<li>{swatch(msgspec.structs.replace(predicted[0], style=3))} predicted</li>")
    return "\n".join(items)


def _caption(plot: Plot, record: Record) -> str:
    floor = f"the reference's own error is {digits(plot.floor)}" if plot.floor else ""
    machine = [record.machine[name] for name in MACHINE if name in record.machine]
    parts = [record.about, floor, *machine]
    about = "; ".join(escape(part) for part in parts if part)
    return f"{about}. Made by <code>{escape(record.command)}</code>"


def _table(plot: Plot) -> str:
    columns = ["", *plot.axes.values(), plot.y]
    head = "".join(f'<th scope="col">{escape(column)}</th>' for column in columns)
    rows = []
    for series in plot.series:
        name = f"{series.name}, predicted" if series.predicted else series.name
        for number, value in enumerate(series.y):
            cells = [*(amount(series.x[axis][number]) for axis in plot.axes), digits(value)]
            data = "".join(f"<td>{cell}</td>" for cell in cells)
            rows.append(f'<tr><th scope="row">{escape(name)}</th>{data}</tr>')
    return (
        f'<div class="values"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n'
        + "\n".join(rows)
        + "\n</tbody></table></div>"
    )
