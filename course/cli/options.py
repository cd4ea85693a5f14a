"""Kinds of values that the command line takes besides click's own, and its exit code.

Each function is the `callback` of an option: it gets the text and returns the value, or fails with
what was expected. An option that was not given stays None; where no modules are given, all are meant.
"""

import math
import re
from collections.abc import Callable
from pathlib import Path

import click

from course.base.errors import CourseError
from course.engine.functions.effects import CHECKOUT, begin, own_assignments
from course.engine.functions.modules import COURSE, meant
from course.engine.functions.sources import NOTEBOOK, holds, is_notebook

INTERRUPTED = 130
"""Exit code after Ctrl-C: 128 + SIGINT, as shells have it."""

FAILED = 3
"""Exit code of a check that found something wrong; 1 is a command that was refused."""

LARGEST_SIDE = 65536
"""Pixels; the limit of `film.width` and `film.height` in a scene file."""


def size(_ctx: click.Context, _option: click.Parameter, text: str | None) -> tuple[int, int] | None:
    """Return (width, height) in pixels from WIDTHxHEIGHT."""
    if text is None:
        return None
    match = re.fullmatch(r"([0-9]{1,5})[xX×]([0-9]{1,5})", text)
    width, height = (int(match[1]), int(match[2])) if match else (0, 0)
    if not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise click.BadParameter(
            f"{text!r} is not a size: expected WIDTHxHEIGHT in pixels, such as 640x480, "
            f"each from 1 to {LARGEST_SIDE}"
        )
    return width, height


def seconds(_ctx: click.Context, _option: click.Parameter, text: str | None) -> float | None:
    """Return a length of time, finite and above 0."""
    return _positive(text, "a number of seconds > 0")


def radiance(_ctx: click.Context, _option: click.Parameter, text: str | None) -> float | None:
    """Return a radiance, finite and above 0."""
    return _positive(text, "a radiance > 0, such as 0.01")


def _positive(text: str | None, expected: str) -> float | None:
    if text is None:
        return None
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not (math.isfinite(number) and number > 0.0):
        raise click.BadParameter(f"{text!r} is not {expected}")
    return number


def json_path(_ctx: click.Context, _option: click.Parameter, text: str | None) -> Path | None:
    """Return a file to write as JSON; its suffix is asked for lest a scene be written over."""
    if text is None:
        return None
    path = Path(text)
    if path.suffix.lower() != ".json":
        raise click.BadParameter(f"{text!r} doesn't end in .json")
    return path


def modules_from(
    ctx: click.Context, _option: click.Parameter, names: tuple[str, ...]
) -> tuple[str, ...]:
    """Return modules in the order of the course from names, several in one separated by commas; or from their files."""
    files = [
        Path(text) for text in names if text.endswith((".py", NOTEBOOK)) and Path(text).is_file()
    ]
    given = [name for text in names for name in text.split(",") if Path(text) not in files]
    for name in given:
        module_from(ctx, _option, name)
    if files:
        if given or len({path.parent for path in files}) > 1:
            raise click.BadParameter("expected files of one folder, or names of modules")
        ctx.meta[_FILES] = files
        given = [module for path in files for module in _modules_of(path)]
    return tuple(name for name in COURSE if not given or name in given)


_FILES = "course files"
"""Where a command keeps the files that were given in the place of modules."""


def _modules_of(path: Path) -> tuple[str, ...]:
    found = holds(path) if is_notebook(path) else tuple({path.stem} & COURSE.keys())
    if not found:
        raise click.BadParameter(f"{path} has no module's name, nor functions of one")
    return found


def _instead(ctx: click.Context, name: str) -> str:
    """What may be meant by a name of no module: the file of one, its function, or a slip; else all that there are."""
    stem = Path(name).stem if name.endswith(".py") else name
    word = stem.lower()
    if near := meant(word, COURSE):
        return f"; did you mean {near}?"
    module, _, function = stem.replace("/", ".").rpartition(".")
    for other in [module] if module else COURSE:
        if function in COURSE.get(other, ()):
            way = f": course check {other} --only {function}" if ctx.info_name == "check" else ""
            return f" is a function of {other}{way}"
    # A part of a name, or one that goes wrong after its beginning.
    for part in (word, word[:3]):
        begun = [name for name in COURSE if len(part) > 2 and part in name]
        if len(begun) == 1:
            return f"; did you mean {begun[0]}?"
    return f"; the modules are {', '.join(COURSE)}"


def module_from(ctx: click.Context, _option: click.Parameter, name: str | None) -> str | None:
    """Return the name of one module, or None where none is given."""
    if name is not None and name not in COURSE:
        raise click.BadParameter(f"{name!r}{_instead(ctx, name)}")
    return name


PATH = click.Path(path_type=Path)
FOLDER = click.Path(path_type=Path, exists=True, file_okay=False)
OUT_FILE = click.Path(path_type=Path, dir_okay=False)
OUT_FOLDER = click.Path(path_type=Path, file_okay=False)
"""Kinds of paths; what is written may be there already."""

scene_argument = click.argument("scene", metavar="SCENE", type=PATH)

# Eager, for files given here say which folder is meant.
modules_argument = click.argument(
    "modules", nargs=-1, metavar="[MODULE]...", callback=modules_from, is_eager=True
)


def own_folder(ctx: click.Context, _option: click.Parameter, folder: Path) -> Path:
    """Return the folder of one's own modules, or a notebook that has them; it must be there."""
    if files := ctx.meta.get(_FILES):
        one: Path = files[0]
        folder = one if len(files) == 1 and is_notebook(one) else one.parent
    if not folder.is_dir() and not (is_notebook(folder) and folder.is_file()):
        remedy = "" if CHECKOUT and folder != Path("assignments") else f", {begin()}"
        raise CourseError(f"{folder}: no such folder; --folder says where your modules are{remedy}")
    return folder


folder_option = click.option(
    "--folder",
    type=click.Path(path_type=Path),
    default=own_assignments,
    show_default="assignments",
    callback=own_folder,
    help="Where the modules are: programs or notebooks, or a notebook that has them.",
)

effects_option = click.option(
    "--effects",
    help="Whose functions to call: solutions, assignments, a folder of modules, or mine: the assignments, with the"
    " solutions where a function is not written; in a copy without solutions its effect is switched off there."
    "  [default: mine in a folder of `course start` and in a student's copy, else solutions]",
)


def choice_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options that say what is graded: the seed and the modules."""
    for option in (
        click.option(
            "--modules",
            multiple=True,
            callback=modules_from,
            metavar="MODULE[,MODULE]...",
            help="Grade only these.",
        ),
        click.option(
            "--seed",
            type=click.IntRange(0),
            default=0,
            help="Chooses the parameters of scenes and checks; students needn't know it.",
        ),
    ):
        command = option(command)
    return command
