"""The table of figures in docs/performance.md, part by part: what was not measured now stays as it was.

docs/data/ratios.json holds every part's figures and the machine that they were measured on.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.figures import Figure, table
from course.atomic import write_text
from course.benchmarking.documents import replace_marked
from course.benchmarking.plot_data import rounded

MARK = "make bench"
DATA = Path("data", "ratios.json")


def write_ratios(
    found: Mapping[str, Sequence[Figure]],
    machine: Mapping[str, str],
    folder: Path,
    order: Iterable[str],
) -> None:
    """Put the figures into the documentation.

    Parameters
    ----------
    found : part -> its figures
    machine : what they were measured with, name -> value
    folder : of performance.md and data/ratios.json
    order : of the parts in the table
    """
    path = folder / DATA
    parts: dict[str, Any] = json.loads(path.read_text("utf-8")) if path.is_file() else {}
    for name, figures in found.items():
        parts[name] = {"machine": dict(machine), "figures": [_plain(figure) for figure in figures]}
    parts = {name: parts[name] for name in order if name in parts}
    path.parent.mkdir(exist_ok=True)
    write_text(path, json.dumps(parts, indent=1, ensure_ascii=False) + "\n")
    replace_marked(folder / "performance.md", MARK, block(parts))


def block(parts: Mapping[str, Any]) -> str:
    """The table as Markdown, below it what was measured where."""
    figures = [Figure(**figure) for part in parts.values() for figure in part["figures"]]
    machines: dict[str, list[str]] = {}
    for name, part in parts.items():
        machines.setdefault(", ".join(part["machine"].values()), []).append(name)
    made = [
        f"Made by `python -m benchmarks {' '.join(names)} --write-docs` on {machine}."
        for machine, names in machines.items()
    ]
    return "\n\n".join([*made, table(figures).markdown()])


def _plain(figure: Figure) -> dict[str, Any]:
    data = {name: value for name, value in figure.to_dict().items() if name != "reached"}
    return {
        name: rounded(value) if isinstance(value, float) else value for name, value in data.items()
    }
