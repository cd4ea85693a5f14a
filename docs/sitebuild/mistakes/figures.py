"""Figures drawn once, in processes of their own, and kept under a hash of all that decides them."""

import atexit
import json
import signal
import sys
import threading
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from importlib.metadata import version
from multiprocessing import TimeoutError as Late
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import click
import numpy as np
from PIL import Image, ImageDraw

from course.base.atomic import replacing
from course.base.errors import CourseError
from course.benchmarking.references import engine_hash
from course.engine.functions.effects import PACKAGE, PROJECT
from sitebuild import webp
from sitebuild.mistakes.catalog import look
from sitebuild.mistakes.look import SIZE
from sitebuild.mistakes.numbers import other_numbers
from sitebuild.mistakes.submissions import functions, solution, submission

KEPT = PROJECT / "out" / "docs" / "mistakes"
HERE = Path(__file__).parent
GRADING = PACKAGE / "school" / "grading"

DRAWN_WITHIN = 120.0
"""Seconds after which a function is taken never to end."""

PROCESSES = 2

TOLD = 25
"""Figures after which it is told how many are drawn."""

QUALITY = 88


@dataclass(frozen=True)
class Figure:
    """A function and how it is looked at.

    Attributes
    ----------
    function : MODULE.FUNCTION
    name : of the wrong submission, or empty for the right function
    seen : number of the look, of those that the function has
    trial : 0 for the usual random numbers; others show what is noise
    """

    function: str
    name: str
    seen: int
    trial: int = 0

    @property
    def file(self) -> str:
        """Name of the picture on the site."""
        return f"{self.function}-{self.name or f'right-{self.seen}'}.webp"

    @property
    def key(self) -> str:
        """Hash of all that decides the picture."""
        module = self.function.partition(".")[0]
        known = submission(self.function, self.name).source if self.name else ""
        chosen = look(self.function, self.seen)
        parts = [
            self.function,
            str(self.seen),
            str(self.trial),
            known,
            solution(module),
            _sources(module),
        ]
        parts += [sha256(path.read_bytes()).hexdigest() for path in chosen.files]
        if chosen.renders:
            parts.append(engine_hash(PROJECT / "solutions"))
        return sha256(json.dumps(parts).encode()).hexdigest()


@lru_cache
def _sources(module: str) -> str:
    """All that draws the figures of a module."""
    names = ("figures", "look", "numbers", "plots", "rendered", "submissions", "swatches")
    files = [
        *(HERE / f"{name}.py" for name in (*names, "tick_numbers")),
        HERE / "looks" / f"{module}.py",
    ]
    files += [
        GRADING / f"{name}.py"
        for name in ("pictures/rendered", "pictures/scenes", "reports/drawing")
    ]
    libraries = [version(name) for name in ("matplotlib", "numpy", "pillow")]
    return "\n".join([*libraries, *(path.read_text(encoding="utf-8") for path in files)])


def draw(figure: Figure) -> Image.Image:
    """Draw it, in this process; whatever the function raises is raised."""
    module = figure.function.partition(".")[0]
    with np.errstate(all="ignore"), warnings.catch_warnings(), other_numbers(figure.trial):
        warnings.simplefilter("ignore")
        return look(figure.function, figure.seen).draw(
            functions(module, figure.name), functions(module)
        )


class Studio:
    """The processes that draw, as many as ``processes`` says; started when the first figure is asked for."""

    def __init__(self) -> None:
        self.processes = PROCESSES
        self._pool: Any = None

    def files(self, figures: Iterable[Figure], kept: Path = KEPT) -> dict[Figure, tuple[Path, str]]:
        """Have figures drawn that aren't kept.

        Returns
        -------
        figure -> file, note
            The WebP file, and what there is to say if the function came to nothing.

        Raises
        ------
        CourseError
            A figure names a submission that isn't there, or takes a right function too long.
        """
        found = {
            figure: (kept / f"{figure.key}.webp", kept / f"{figure.key}.txt") for figure in figures
        }
        while missing := [f for f, paths in found.items() if not all(p.is_file() for p in paths)]:
            click.echo(f"drawing {missing[0].function}: {len(missing)} figures", err=True)
            kept.mkdir(parents=True, exist_ok=True)
            self._draw({figure: found[figure] for figure in missing})
        return {
            figure: (image, note.read_text(encoding="utf-8"))
            for figure, (image, note) in found.items()
        }

    def _draw(self, paths: Mapping[Figure, tuple[Path, Path]]) -> None:
        """Draw them, up to the first that does not end."""
        if self._pool is None:
            self._pool = get_context("spawn").Pool(self.processes)
            atexit.register(
                self.close
            )  # a pool that Python ends while it takes itself apart complains
            if threading.current_thread() is threading.main_thread():
                # So does one whose program is ended from outside.
                signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
        waiting = [(f, self._pool.apply_async(_drawn, (f, *paths[f]))) for f in paths]
        for number, (figure, outcome) in enumerate(waiting):
            if number and number % TOLD == 0:
                click.echo(f"{number} of {len(waiting)} figures are drawn", err=True)
            try:
                outcome.get(DRAWN_WITHIN)
            except Late:
                self.close()
                if not figure.name:
                    late = f"{figure.function}: no picture in {DRAWN_WITHIN:g} s"
                    raise CourseError(late) from None
                _write(_lost("does not end"), "It does not end.", *paths[figure])
                return

    def close(self) -> None:
        """End the processes, whatever they are at."""
        if self._pool is not None:
            self._pool.terminate()
            self._pool.join()
        self._pool = None


STUDIO = Studio()


def _drawn(figure: Figure, image: Path, note: Path) -> None:
    """Draw a figure to a file, in a process of the pool."""
    try:
        drawn, said = draw(figure), ""
    except Exception as error:  # a wrong function may raise anything
        if not figure.name:
            raise
        drawn, said = _lost(type(error).__name__), f"It ends with {type(error).__name__}: {error}"
    _write(drawn, said, image, note)


def _write(drawn: Image.Image, said: str, image: Path, note: Path) -> None:
    plotted = drawn.size != SIZE
    webp.save(drawn.convert("RGB"), image, QUALITY, lossless=plotted)
    with replacing(note) as temporary:
        temporary.write_text(said, encoding="utf-8")


def _lost(why: str) -> Image.Image:
    """A picture that says why there is none."""
    image = Image.new("RGB", (SIZE[0] * 2, SIZE[1] * 2), "white")
    ImageDraw.Draw(image).text((SIZE[0], SIZE[1]), why, fill="#a1440b", anchor="mm", font_size=40)
    return image


def blank(figure: Figure, folder: Path) -> Path:
    """Make a grey picture of the same size, for builds that must not wait."""
    return webp.save_blank(folder / figure.file, SIZE)
