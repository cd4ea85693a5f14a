"""The measured parts of the documentation: tables between lines that mark them, and the numbers of its plots.

docs/accuracy.md and docs/performance.md have the tables, module by module; building the site draws the plots from
docs/data/bench.json.
"""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from course.base.atomic import check_writable, make_folder, write_text
from course.base.errors import OutputError
from course.benchmarking.estimators import BENCHED, FURTHER_BENCHED
from course.benchmarking.measuring import Effort, Measured
from course.benchmarking.plot_data import about, command, read_records, record, write_records
from course.benchmarking.tables import error_table, reference_table, time_table

MARK = "course bench"
NAMES = ("accuracy.md", "performance.md")
DATA = Path("data", "bench.json")


def write_documents(
    results: Sequence[Measured], effort: Effort, machine: Mapping[str, str], folder: Path
) -> list[Path]:
    """Put tables into the two documents, and the plots' numbers beside them; modules not measured stay as they are.

    Raises OutputError: a document isn't there, has no marks, or can't be written.

    Parameters
    ----------
    machine : what it was measured with, name -> value
    folder : of accuracy.md, performance.md and data/bench.json
    """
    for name, section in zip(NAMES, (accuracy, performance), strict=True):
        path = folder / name
        sections = _sections(path) | {
            _title(measured.module.name): section(measured, effort, machine) for measured in results
        }
        replace_marked(path, MARK, "\n\n".join(_in_order(sections)))
    data = folder / DATA
    records = {measured.module.name: record(measured, effort, machine) for measured in results}
    write_records(data, records)
    return [*(folder / name for name in NAMES), data]


def accuracy(measured: Measured, effort: Effort, machine: Mapping[str, str]) -> str:
    """Errors and orders of a module as Markdown."""
    parts = _opening(measured, effort, machine, "samples")
    parts.append(f"RMSE over samples for each pixel:\n\n{error_table(measured).markdown()}")
    parts.append(f"Measured against:\n\n{reference_table(measured).markdown()}")
    return "\n\n".join(parts)


def performance(measured: Measured, effort: Effort, machine: Mapping[str, str]) -> str:
    """Times and efficiencies of a module as Markdown."""
    parts = _opening(measured, effort, machine, "seconds")
    table = time_table(measured).markdown()
    parts.append(f"Median seconds over samples for each pixel:\n\n{table}")
    return "\n\n".join(parts)


def replace_marked(path: Path, mark: str, block: str) -> None:
    """Replace what stands between `<!-- MARK: begin -->` and `<!-- MARK: end -->` in a file.

    Raises OutputError: the file isn't there, or doesn't hold each mark once and in this order.
    """
    before, _, after = _around(path, mark)
    write_text(path, f"{before}\n\n{block}\n\n{after}")


def check_documents(folder: Path) -> None:
    """Find out before the work whether `write_documents` finds its marks.

    Raises OutputError as `write_documents` would.
    """
    for name in NAMES:
        _around(folder / name, MARK)
    data = folder / DATA
    make_folder(data.parent)
    check_writable(data)
    if data.is_file():
        read_records(data)


def _around(path: Path, mark: str) -> tuple[str, str, str]:
    """What stands in a file up to the first mark, between the two, and from the second on; the marks are outside."""
    begin, end = f"<!-- {mark}: begin -->", f"<!-- {mark}: end -->"
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise OutputError(f"{path}: can't be read: {error.strerror}") from error
    before, found_begin, rest = text.partition(begin)
    block, found_end, after = rest.partition(end)
    if not (found_begin and found_end) or begin in rest or end in before + after:
        raise OutputError(f"{path}: expected the lines {begin} and {end}, once each")
    return before + begin, block, end + after


def marked(path: Path, mark: str) -> str:
    """What stands between the marks of a file.

    Raises OutputError as `replace_marked`.
    """
    return _around(path, mark)[1].strip()


def _sections(path: Path) -> dict[str, str]:
    """The modules that a document has, by their headings."""
    _, *parts = re.split(r"^### (.+)\n", marked(path, MARK), flags=re.MULTILINE)
    return {
        title: f"### {title}\n{text.rstrip()}"
        for title, text in zip(parts[::2], parts[1::2], strict=True)
    }


def _in_order(sections: Mapping[str, str]) -> list[str]:
    known = [_title(name) for name in (*BENCHED, *FURTHER_BENCHED)]
    return [sections[title] for title in known if title in sections]


def _title(module: str) -> str:
    return module.replace("_", " ").capitalize()


def _opening(
    measured: Measured, effort: Effort, machine: Mapping[str, str], axis: str
) -> list[str]:
    """A heading, what was measured by which command with what, and the plots, which the site draws there."""
    module = measured.module
    scene = f"`scenes/{module.scene.name}`, {about(measured, effort)}"
    made_by = f"made by\n`{command(module.name, effort)}` on {', '.join(machine.values())}."
    return [
        f"### {_title(module.name)}",
        f"{scene}; {made_by}",
        f"<!-- site: convergence {module.name} {axis} -->",
    ]
