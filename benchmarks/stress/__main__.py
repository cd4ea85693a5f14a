"""`make stress`: judge all cells, print what was found, and fail if one is broken."""

import json
import sys
from pathlib import Path

import click
from rich.progress import Progress

from benchmarks.stress import room
from benchmarks.stress.axes import AXES, level
from benchmarks.stress.cells import STAGES, Cell, all_cells, cell_named, short_form
from benchmarks.stress.report import PAGE, print_report, print_verdict, rows_of, write_page
from benchmarks.stress.running import judge_all, judge_some, shrunk, wild_levels
from benchmarks.stress.verdict import SCENES, Verdict

KEPT = Path("out/stress")
LIGHTS = [each.name for each in AXES["light"]]


@click.command(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option("--cell", "name", metavar="ID", help="Judge this cell alone, and keep its scenes.")
@click.option("--stage", type=click.Choice(list(STAGES)), help="Only the cells of this stage.")
@click.option("--light", type=click.Choice(LIGHTS), help="Only the cells that have this light.")
@click.option("--short", is_flag=True, help="Few cells, in which every level occurs.")
@click.option("--cells", is_flag=True, help="Print every cell, not only every level.")
@click.option("--jobs", type=click.IntRange(1), help="Processes; one a core if not given.")
@click.option(
    "--compiled/--numpy", default=None, help="Numba's loops, or none; else as the renderer chooses."
)
@click.option("--json", "json_file", type=click.Path(path_type=Path), help="Write all verdicts.")
@click.option("--write", is_flag=True, help="Write the section of docs/accuracy.md.")
def main(
    name: str | None,
    stage: str | None,
    light: str | None,
    short: bool,
    cells: bool,
    jobs: int | None,
    compiled: bool | None,
    json_file: Path | None,
    write: bool,
) -> None:
    """Render ill-conditioned scenes and hold them against their well-conditioned twins.

    The exit code is 1 if a cell has a NaN, an infinity or created energy, or breaks its bound.
    """
    if name is not None:
        sys.exit(_judge_one(name, compiled))
    chosen = list(all_cells())
    if stage is not None:
        chosen = [cell for cell in chosen if cell.stage == stage]
    if light is not None:
        chosen = [cell for cell in chosen if cell.levels.get("light") == level("light", light)]
    if short:
        chosen = short_form(chosen)
    if write and len(chosen) < len(all_cells()):
        raise click.UsageError("--write takes all cells: leave out --short, --stage and --light")
    with Progress(transient=True) as progress:
        task = progress.add_task("cells", total=len(chosen))
        verdicts = judge_all(chosen, jobs, lambda count: progress.advance(task, count), compiled)
    print_report(verdicts, cells=cells)
    if json_file is not None:
        _write_json(verdicts, json_file)
    if write:
        write_page(verdicts)
        click.echo(f"written to {PAGE}")
    sys.exit(any(not verdict.passed for verdict in verdicts))


def _judge_one(name: str, compiled: bool | None) -> int:
    try:
        cell = cell_named(name)
    except KeyError as error:
        raise click.UsageError(str(error.args[0])) from error
    verdict = judge_some([cell], compiled)[0]
    print_verdict(verdict)
    for path in _keep(cell):
        click.echo(f"  course render {path}")
    if verdict.passed:
        return 0
    least = shrunk(cell, compiled)
    click.echo(f"  it also fails with nothing but {wild_levels(least)}")
    print_verdict(judge_some([least], compiled)[0])
    for path in _keep(Cell(f"{cell.name}-least", cell.stage, least.levels)):
        click.echo(f"  course render {path}")
    return 1


def _keep(cell: Cell) -> list[Path]:
    """Write the scenes of a cell where they can be looked at."""
    folder = KEPT / cell.name
    scenes = {"cell": SCENES[cell.stage](cell)}
    if cell.stage == "room":
        scenes |= {"twin": room.room(cell.twin()), "furnace": room.furnace(cell)}
    return [files.write(folder / kind) for kind, files in scenes.items()]


def _write_json(verdicts: list[Verdict], path: Path) -> None:
    failed = [verdict.cell for verdict in verdicts if not verdict.passed]
    content = {
        "cells": len(verdicts),
        "failed": failed,
        "rows": [row.to_dict() for row in rows_of(verdicts)],
        "verdicts": [verdict.to_dict() for verdict in verdicts],
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, indent=1), encoding="utf-8")
    click.echo(f"written to {path}")


if __name__ == "__main__":
    main()
