"""`course portfolio`: a page of what one's own functions have brought about."""

from __future__ import annotations

from pathlib import Path

import click

from course.base.atomic import write_text
from course.cli.options import FOLDER, PATH, folder_option, modules_argument, seconds
from course.cli.outputs import check_outputs
from course.engine.functions.effects import PROJECT


@click.command()
@modules_argument
@folder_option
@click.option("-o", "--output", type=PATH, default="portfolio.html", show_default=True)
@click.option(
    "--scenes", type=FOLDER, help="A folder with a scene for each module.  [default: scenes]"
)
@click.option(
    "--time-limit",
    callback=seconds,
    default="60",
    show_default=True,
    help="Seconds for all pictures.",
)
def portfolio(
    modules: tuple[str, ...], folder: Path, output: Path, scenes: Path | None, time_limit: float
) -> None:
    """Write a page of pictures by one's own functions: before and after, errors, receipts.

    Files that have changed since they were checked last are checked first, as by `course status`,
    which the time limit doesn't count, nor what is compiled. Functions that are not written have
    those of the course in their place, or none. The page is one file without a script, and needs
    no network.
    """
    check_outputs(files=[("-o", output)])
    from course.engine.functions.effects import Effects
    from course.school.grading.progress import progress
    from course.school.grading.reports.portfolio import portfolio as page

    def say(doing: str) -> None:
        click.echo(doing, err=True)

    found = list(progress(folder, modules, lambda module: say(f"checking {module}")))
    effects = Effects(folder, filled=True)
    where = scenes or next(p for p in (Path("scenes"), PROJECT / "scenes") if p.is_dir())
    made = page(found, effects, where, time_limit, lambda module: say(f"rendering {module}"))
    write_text(output, made.text)
    click.echo(f"{output} ({output.stat().st_size / 1000:.0f} kB)")
    if made.short:
        say(
            f"pictures of {', '.join(made.short)} got fewer samples for want of time: "
            f"a larger --time-limit than {time_limit:g} gives them more"
        )
