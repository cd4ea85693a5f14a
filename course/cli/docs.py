"""`course docs`: the pages of the course, in a browser where they are built."""

import webbrowser
from pathlib import Path

import click

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import meant

HOW = (
    "your instructor may have the site's address, or a copy that holds it (`course release --site`); in a clone of the "
    "course `make docs` builds it"
)
"""To get the figures."""


@click.command()
@click.argument("page", required=False)
@click.option("--no-browser", is_flag=True, help="Print where the page is, and open nothing.")
def docs(page: str | None, no_browser: bool) -> None:
    """Open the pages of the course: all of them, or PAGE, such as soft_shadows or guides/notebook.

    Opens the built site, with its figures, where there is one; else says where the same pages
    are without them, and how to get the site.
    """
    site = _first("site/index.html", "out/site/index.html")
    if site is not None:
        file = _page(site.parent, page or "index", ".html")
        click.echo(file)
        if not no_browser:
            webbrowser.open(file.resolve().as_uri())
        return
    text = _first("docs/index.md")
    if text is None:
        raise CourseError(f"no pages of the course are here or installed; {HOW}")
    click.echo(_page(text.parent, page or "index", ".md"))
    click.echo(
        f"These are pages of text, for an editor. For their figures and sliders: {HOW}.", err=True
    )


def _first(*names: str) -> Path | None:
    """The first of some files that is in the current folder, in one above, or in the installed course."""
    here = Path.cwd()
    near = [here, *here.parents[:3]]
    # A folder above a checkout may be anything.
    folders = [*(folder for folder in near if (folder / "scenes").is_dir()), PROJECT]
    found = (folder / name for name in names for folder in folders)
    return next((path for path in found if path.is_file()), None)


def _page(folder: Path, name: str, suffix: str) -> Path:
    """The file of a page, by its path or by its last part.

    Raises CourseError: there is none.
    """
    known = {
        path.relative_to(folder).with_suffix("").as_posix(): path
        for path in folder.rglob(f"*{suffix}")
    }
    asked = Path(name).with_suffix("").as_posix().removeprefix("docs/")
    for tried in (asked, f"modules/{asked}", f"guides/{asked}", f"reference/{asked}"):
        if tried in known:
            return known[tried]
    short = {one.rpartition("/")[2]: one for one in known if not one.startswith("_")}
    near = meant(asked.rpartition("/")[2], short)
    raise CourseError(f"{folder} has no page {name}" + (f"; did you mean {near}?" if near else ""))
