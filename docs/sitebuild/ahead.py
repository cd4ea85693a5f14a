"""Write pages with grey pictures, and draw meanwhile what they show: ``python -m sitebuild.ahead DOCTREES SITE``.

There is a process for each core. Pictures are kept where the next build finds them, and take the place of grey ones.
What can't be drawn is left to that build, which says why.
"""

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, wait
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

import click

from course.benchmarking.references import engine_hash
from course.engine.functions.effects import Effects
from course.engine.render.threads import default_threads
from sitebuild import kept, pictures
from sitebuild.mistakes.figures import STUDIO
from sitebuild.parts import MARK, PARTS, with_marks
from sitebuild.place import Place

DOCS = Path(__file__).parents[1]

DRAWN = (
    *("before_after", "picture", "rays", "series", "mistakes", "shot", "heat_map", "metu_shot"),
    *("series_grid", "radiosity_flight", "radiosity_shot", "radiosity_steps"),
    *("radiosity_scrubber", "cards", "quiz"),
)
"""Kinds of parts whose pictures are kept, in the order in which they are drawn: first screens before the rest."""

LONG = ("scene_keys", "notebook")
"""Those that take a process for themselves for long, so they begin first."""

Asked = tuple[str, str, str]
"""Kind, name and words of a part."""


def asked() -> Iterator[Asked]:
    """What all pages ask for, the longest and then the first to be seen in front."""
    found: dict[Asked, None] = {}
    for path in sorted(DOCS.rglob("*.md")):
        page = path.relative_to(DOCS).with_suffix("").as_posix()
        for match in MARK.finditer(with_marks(page, path.read_text(encoding="utf-8"))):
            found[match.groups()] = None
    for kind in (*LONG, *DRAWN):
        yield from (each for each in found if each[0] == kind)


def draw(each: Asked, site: Path) -> None:
    """Make the pictures of a part."""
    kind, name, said = each
    with TemporaryDirectory(prefix="course-") as made:
        PARTS[kind](Place("", False, Path(made), {}, site=site), name, said)


def _begin() -> None:
    """Set up a process that draws: pages that are written meanwhile go first."""
    pictures.THREADS = STUDIO.processes = 1
    if hasattr(os, "nice"):
        os.nice(5)


def main(trees: str, site: str) -> int:
    """Draw, unless all was drawn with this engine, and write the pages, unless they are there.

    Returns
    -------
    Sphinx's exit code, or 0.
    """
    options = ["-W", "--keep-going", "-q", "-b", "html", "-d", trees, "-D", "pictures=blank"]
    command = [sys.executable, "-m", "sphinx", *options, str(DOCS), site]
    stamp, engine = kept.ROOT / "drawn", engine_hash(Effects().folder.resolve())
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == engine:
        return 0
    pool = ProcessPoolExecutor(default_threads(), get_context("spawn"), _begin)
    writing = None
    if not Path(site, "index.html").is_file():
        click.echo("writing the pages; their pictures follow")
        writing = subprocess.Popen(command)
    try:
        drawn = [pool.submit(draw, each, Path(site).resolve()) for each in asked()]
        code = writing.wait() if writing else 0
        if code == 0:
            wait(drawn)
            stamp.parent.mkdir(parents=True, exist_ok=True)
            stamp.write_text(engine, encoding="utf-8")
    finally:
        pool.shutdown(cancel_futures=True)
    return code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
