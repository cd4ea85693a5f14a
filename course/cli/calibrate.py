"""`course calibrate`: SSIM tolerances from the known submissions."""

from pathlib import Path

import click

from course.cli.options import OUT_FILE, modules_argument
from course.cli.outputs import check_outputs
from course.engine.functions.effects import PACKAGE


@click.command()
@modules_argument
@click.option(
    "--seeds",
    type=click.IntRange(1),
    default=12,
    show_default=True,
    help="Pictures of each submission.",
)
@click.option(
    "--out",
    type=OUT_FILE,
    default=PACKAGE / "school" / "grading" / "data" / "tolerances.json",
    show_default="where the checks read them",
)
def calibrate(modules: tuple[str, ...], seeds: int, out: Path) -> None:
    """Put the tolerance of each picture between the known right and the known wrong submissions.

    Renders both with several seeds and writes the tolerances, with what they lie between.
    """
    from course.school.grading.calibration import calibrate as measured
    from course.school.grading.calibration import write_tolerances
    from course.school.grading.pictures.judging import tolerances

    check_outputs(files=[("--out", out)])
    found = dict(tolerances()) | measured(modules, seeds, click.echo)
    write_tolerances(found, seeds, out)
    click.echo(f"{out} written")
