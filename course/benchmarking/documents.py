"""The measured parts of docs/accuracy.md and docs/performance.md, between lines that mark them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from course.benchmarking.measuring import Effort, Measured
from course.benchmarking.tables import Table, error_table, reference_table, time_table
from course.errors import OutputError
from course.imaging.atomic import write_text

MARK = "course bench"
NAMES = ("accuracy.md", "performance.md")


def write_documents(
    results: Sequence[Measured], effort: Effort, machine: Mapping[str, str], folder: Path
) -> list[Path]:
    """Put tables and figures into the two documents.

    Parameters
    ----------
    machine : what it was measured with, name -> value
    folder : of accuracy.md and performance.md, with the figures in its folder `figures`

    Raises
    ------
    OutputError
        A document isn't there, has no marks, or can't be written.
    """
    blocks = (accuracy(results, effort, machine), performance(results, effort, machine))
    for name, block in zip(NAMES, blocks, strict=True):
        replace_marked(folder / name, MARK, block)
    return [folder / name for name in NAMES]


def accuracy(results: Sequence[Measured], effort: Effort, machine: Mapping[str, str]) -> str:
    """Errors and orders as Markdown."""
    parts = [_made_by(effort, machine)]
    for measured in results:
        parts.append(_heading(measured))
        parts += _figures(measured, "samples", "error over samples")
        parts.append(f"RMSE over samples for each pixel:\n\n{error_table(measured).markdown()}")
        parts.append(f"Measured against:\n\n{reference_table(measured).markdown()}")
    return "\n\n".join(parts)


def performance(results: Sequence[Measured], effort: Effort, machine: Mapping[str, str]) -> str:
    """Times and efficiencies as Markdown."""
    rows = tuple((name, value) for name, value in machine.items())
    parts = [_made_by(effort, machine), Table("", ("machine", ""), rows).markdown()]
    for measured in results:
        parts.append(_heading(measured))
        parts += _figures(measured, "seconds", "error over time")
        table = time_table(measured).markdown()
        parts.append(f"Median seconds over samples for each pixel:\n\n{table}")
    return "\n\n".join(parts)


def replace_marked(path: Path, mark: str, block: str) -> None:
    """Replace what stands between `<!-- MARK: begin -->` and `<!-- MARK: end -->` in a file.

    Raises
    ------
    OutputError
        The file isn't there, or doesn't hold each mark once and in this order.
    """
    before, after = _around(path, mark)
    write_text(path, f"{before}\n\n{block}\n\n{after}")


def check_documents(folder: Path) -> None:
    """Find out before the work whether `write_documents` finds its marks.

    Raises
    ------
    OutputError
        As `write_documents` would.
    """
    for name in NAMES:
        _around(folder / name, MARK)


def _around(path: Path, mark: str) -> tuple[str, str]:
    """What stands in a file up to the first mark and from the second one on, with the marks."""
    begin, end = f"<!-- {mark}: begin -->", f"<!-- {mark}: end -->"
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise OutputError(f"{path}: can't be read: {error.strerror}") from error
    before, found_begin, rest = text.partition(begin)
    _, found_end, after = rest.partition(end)
    if not (found_begin and found_end) or begin in rest or end in before + after:
        raise OutputError(f"{path}: expected the lines {begin} and {end}, once each")
    return before + begin, end + after


def _made_by(effort: Effort, machine: Mapping[str, str]) -> str:
    command = "course bench --write-docs" + (" --quick" if effort.name == "quick" else "")
    return (
        f"Made by `{command}` on {machine['processor']}, {machine['threads']}. "
        f"{effort.seeds} seeds, pictures {effort.height} pixels high."
    )


def _heading(measured: Measured) -> str:
    width, height = measured.size
    title = measured.module.title.capitalize()
    return f"### {title}\n\n`scenes/{measured.module.scene.name}`, {width} x {height} pixels."


def _figures(measured: Measured, kind: str, about: str) -> list[str]:
    title = measured.module.title
    return [
        f"![{title}, {caption}: {about}](figures/{measured.module.name}_{group}_{kind}.svg)"
        for group, caption in measured.module.groups.items()
    ]
