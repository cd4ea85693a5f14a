"""What a module's benchmark shows: tables, figures and sheets for lectures, and data for the site's plots."""

from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from course.benchmarking.machine import machine
from course.benchmarking.plot_data import Plot, Record, read_records, write_records
from course.benchmarking.plots import write_plots
from course.benchmarking.tables import Table, print_tables
from course.engine.core.types import Floats32
from course.engine.formats.pictures.display import linear_to_srgb8

KEPT = Path("out/bench/data")


def keep(name: str, about: str, plots: Sequence[Plot], folder: Path = KEPT) -> Path:
    """Keep the curves of a benchmark.

    Parameters
    ----------
    name : of the benchmark and of the module whose page shows them
    about : with what effort they were measured
    """
    command = f"python -m benchmarks {name} --write-docs"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.json"
    path.unlink(missing_ok=True)
    write_records(path, {name: Record(command, about, machine(), tuple(plots))})
    print(f"written to {path}")
    return path


def publish(names: Sequence[str], to: Path, kept: Path = KEPT) -> list[Path]:
    """Put the curves of those benchmarks that have any into the documentation's folder of data."""
    to.mkdir(exist_ok=True)
    written = []
    for name in names:
        if (kept / f"{name}.json").is_file():
            write_records(to / f"{name}.json", read_records(kept / f"{name}.json"))
            written.append(to / f"{name}.json")
    return written


Cell = tuple[str, Floats32]
"""A picture's name, and the picture: (3, H, W) linear RGB."""

GAP = 8
CAPTION = 34
"""Pixels between pictures, and above a picture for its name."""


def draw_sheet(rows: Sequence[Sequence[Cell | None]], path: Path) -> Path:
    """Draw square pictures of one size in rows, as a PNG; None leaves a place empty."""
    (side,) = {picture.shape[-1] for row in rows for _, picture in filter(None, row)}
    width = max(map(len, rows)) * (side + GAP) + GAP
    page = Image.new("RGB", (width, len(rows) * (side + CAPTION) + GAP), "white")
    draw, font = ImageDraw.Draw(page), ImageFont.load_default(size=16)
    for y, row in enumerate(rows):
        for x, cell in enumerate(row):
            if cell is not None:
                name, picture = cell
                left, top = GAP + x * (side + GAP), y * (side + CAPTION)
                draw.text((left, top + 8), name, "black", font)
                page.paste(Image.fromarray(linear_to_srgb8(picture)), (left, top + CAPTION))
    path.parent.mkdir(parents=True, exist_ok=True)
    page.save(path)
    return path


OUT = Path("out/bench")


def report(name: str, about: str, tables: Iterable[Table], plots: Sequence[Plot]) -> None:
    """Print tables; draw plots as `out/bench/NAME_PLOT_AXIS.svg`; keep their numbers in `out/bench/data/NAME.json`.

    Without matplotlib, which is an extra, there are no figures.

    Parameters
    ----------
    name : of the benchmark and of the module whose page shows the plots
    about : with what effort they were measured
    """
    print_tables(tables)
    if find_spec("matplotlib"):
        OUT.mkdir(parents=True, exist_ok=True)
        for path in write_plots(name, plots, about, OUT):
            print(f"written to {path}")
    keep(name, about, plots)
