"""Seconds to the same error beside another program, from what ``python -m benchmarks.peers --write`` keeps.

``<!-- site: peer_times llvm -->`` shows one of the two forms: a row for each scene and error, a mark for each program.
"""

import json
from collections.abc import Iterable
from html import escape
from typing import Any

from course.base.errors import CourseError
from course.benchmarking.labels import plain, ticks
from course.benchmarking.tables import digits
from course.engine.functions.effects import PROJECT
from sitebuild.convergence_plot import LETTER, MARKS, WIDTH, Scale
from sitebuild.place import Place

DATA = PROJECT / "docs" / "data" / "peers.json"
STYLES = {
    "Mitsuba": 3,
    "uniform": 0,
    "adaptive": 1,
    "uniform, compiled": 5,
    "adaptive, compiled": 2,
}
ROW = 26
TOP, BOTTOM = 8, 40


def peer_times(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show one form of the comparison.

    Raises
    ------
    CourseError
        It has not been measured.
    """
    kept = json.loads(DATA.read_text(encoding="utf-8")) if DATA.is_file() else []
    cases = [case for case in kept if case["result"]["form"] == name]
    rows = [row for case in cases for row in _seconds(case["result"])]
    if not rows:
        raise CourseError(f"{DATA} has no form {name!r}: python -m benchmarks.peers --write")
    found = {program for row in rows for program in row["seconds"]}
    programs = [program for program in STYLES if program in found]
    legend = "\n".join(
        f'<li><svg class="swatch s{STYLES[program]}" viewBox="-7 -7 14 14" width="14" height="14"'
        f' aria-hidden="true">{_mark(program)}</svg> {_named(program, name)}</li>'
        for program in programs
    )
    # Mostly one; a case may have been measured elsewhere than the others.
    machines = {", ".join(case["about"][key] for key in ("processor", "peer")) for case in cases}
    machine = "; ".join(sorted(machines))
    return f"""<figure class="convergence">
<p class="title">Seconds to the same error</p>
<div class="panels">
<div class="plot">
{svg(name, rows)}
</div>
</div>
<ul class="legend">
{legend}
</ul>
<figcaption>{escape(machine)}. Made by <code>python -m benchmarks.peers --write</code></figcaption>
</figure>
"""


def _seconds(result: dict[str, Any]) -> Iterable[dict[str, Any]]:
    """A scene's name with the samples that have the error, and seconds of each program."""
    for target in result["targets"]:
        ours = {way["name"]: way["seconds"] for way in target["ours"]}
        scene = f"{result['effect']}{' ≈' if result['alike'] else ''} {target['samples']}"
        yield {"scene": scene, "seconds": {"Mitsuba": target["theirs"]["seconds"], **ours}}


def svg(form: str, rows: list[dict[str, Any]]) -> str:
    """Draw the rows over logarithmic seconds; the result holds no empty line."""
    height = TOP + ROW * len(rows) + BOTTOM
    every = [seconds for row in rows for seconds in row["seconds"].values()]
    left = 12 + LETTER * max(len(row["scene"]) for row in rows)
    x = Scale(min(every) / 1.2, max(every) * 1.2, left, WIDTH - 14)
    parts = [*_axis(x, height), *(_row(form, row, x, number) for number, row in enumerate(rows))]
    about = escape(f"Seconds to the same error, {len(rows)} rows, Mitsuba {form} and this renderer")
    return (
        f'<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{about}">\n'
        + "\n".join(parts)
        + "\n</svg>"
    )


def _axis(x: Scale, height: int) -> Iterable[str]:
    bottom = height - BOTTOM
    for tick in ticks(x.low, x.high, 6):
        yield f'<path class="grid" d="M{x(tick)} {TOP}V{bottom}"/>'
        yield _text(x(tick), bottom + 16, plain(tick), "middle")
    yield f'<path class="axis" d="M{x.start:.1f} {bottom}H{x.end}"/>'
    yield _text((x.start + x.end) / 2, height - 6, "seconds", "middle")


def _row(form: str, row: dict[str, Any], x: Scale, number: int) -> str:
    y = TOP + ROW * (number + 0.5)
    marks = [
        _mark(
            program,
            f' transform="translate({x(seconds)} {y})" data-x="{x(seconds)}" data-y="{y}"'
            f' data-values="{escape(_values(form, row, program))}"',
        )
        for program, seconds in sorted(row["seconds"].items(), key=lambda item: item[1])
        if program in STYLES
    ]
    line = f'<path class="grid" d="M{x.start:.1f} {y}H{x.end}"/>'
    return f'{line}{_text(x.start - 6, y + 4, row["scene"], "end")}<g class="curve">{"".join(marks)}</g>'


def _values(form: str, row: dict[str, Any], program: str) -> str:
    seconds = row["seconds"]
    told = f"{row['scene']}, {_named(program, form)}: {digits(seconds[program])} seconds"
    if program == "Mitsuba":
        return told
    return f"{told}, {digits(seconds[program] / seconds['Mitsuba'])} times Mitsuba's"


def _named(program: str, form: str) -> str:
    return f"Mitsuba {form}" if program == "Mitsuba" else program


def _mark(program: str, more: str = "") -> str:
    style = STYLES[program]
    return f'<path class="mark s{style}" d="{MARKS[style]}"{more}/>'


def _text(x: float, y: float, words: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(words)}</text>'
