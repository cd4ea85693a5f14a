"""`course references`: the arrays that a copy without solutions needs."""

from pathlib import Path

import click

from course.base.texts import count
from course.cli.options import OUT_FILE
from course.cli.outputs import check_outputs
from course.engine.functions.effects import PACKAGE
from course.engine.functions.modules import COURSE


@click.command()
@click.option(
    "--seed", type=click.IntRange(0), default=0, show_default=True, help="The seed of the checks."
)
@click.option(
    "--out",
    type=OUT_FILE,
    default=PACKAGE / "school" / "grading" / "data" / "references.npz",
    show_default="where `course check` reads them",
)
def references(seed: int, out: Path) -> None:
    """Make the reference pictures and arrays of all checks with the solutions, and write them as one file."""
    from course.school.grading.pictures.whole import NAME
    from course.school.grading.references import make_references

    check_outputs(files=[("--out", out)])
    arrays = make_references((*COURSE, NAME), seed, out)
    click.echo(f"{out}: {count(arrays, 'array')}, {out.stat().st_size / 1e6:.1f} MB")
