"""The files of one's own modules, as `course check` takes them from a folder.

Only files with the names of modules are taken; everything else is left alone, and no link is followed.
What others hand in is read by `course.school.grading.classes`.
"""

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from course.base.errors import CourseError
from course.base.inputs import InputLimit, opened
from course.engine.functions.effects import misnamed
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reading import LARGEST_FILE
from course.engine.functions.sources import NOTEBOOK, cells_of, find_module, is_notebook, named
from course.school.grading.errors import StudentError

ANY_SIZE = InputLimit(1 << 63)
"""Files of any size are opened, for only their beginning is read."""


class SubmissionError(CourseError):
    """A submission that can't be graded; the message names it and says why."""


def why_absent(
    module: str, source: bytes | None, folder: Path | None = None
) -> StudentError | None:
    """Why there is nothing to check in a module; None if there is.

    Parameters
    ----------
    source : the file; None where there is none
    folder : where it should be, which is told with it; None if that is nobody's business
    """
    path = Path(f"{module}.py") if folder is None else named(folder, module)
    if source is None:
        if folder is not None and is_notebook(folder):
            return StudentError("missing", f"{path} has no {module}", module_wide=True)
        near = None if folder is None else misnamed(path)
        hint = "" if folder is None or near is None else f" (is it {near.relative_to(folder)}?)"
        return StudentError("missing", f"{path} is missing{hint}", module_wide=True)
    if not source.strip():
        if folder is not None and (found := find_module(folder, module)) and is_notebook(found):
            why = f"{found} defines none of its functions"
            return StudentError("missing", why, module_wide=True)
        return StudentError("missing", f"{path} is empty", module_wide=True)
    return None


def find_modules(folder: Path, modules: Iterable[str] = tuple(COURSE)) -> dict[str, Path]:
    """Where the files of modules are: in a folder, or else below it; a module that isn't there is left out.

    Raises CourseError: one isn't in the folder, and more than once below it; or the folder can't be read.
    ``folder``: or a notebook alone
    """
    found: dict[str, Path] = {}
    for module in modules:
        top = folder / f"{module}.py"
        with readable(folder):
            # A file at the top is meant, whatever lies deeper, and a program before a notebook.
            here = top if os.path.lexists(top) else find_module(folder, module)
            paths = [here] if here else []
            for name in (top.name, f"{module}{NOTEBOOK}"):
                below = [] if paths or folder.is_file() else sorted(folder.rglob(name))
                paths += [path for path in below if "__MACOSX" not in path.parts]
        if len(paths) > 1:
            listed = ", ".join(map(str, paths[:3]))
            name = paths[0].name
            raise SubmissionError(f"{folder}: {name} is in it more than once: {listed}")
        if paths:
            found[module] = paths[0]
    return found


def read_found(folder: Path, paths: Mapping[str, Path]) -> dict[str, bytes]:
    """Modules that `find_modules` has found in a folder.

    Raises CourseError: one is a link, is no file, or can't be read.
    """
    found: dict[str, bytes] = {}
    with readable(folder):
        for module, path in paths.items():
            if path.is_symlink() or not path.resolve().is_relative_to(folder.resolve()):
                raise SubmissionError(f"{path}: is a link; submit the file itself")
            if is_notebook(path):
                found[module] = cells_of(path, module).text
                continue
            with opened(path, "file of a submission", ANY_SIZE, SubmissionError) as file:
                found[module] = file.read(LARGEST_FILE)
    return found


@contextmanager
def readable(folder: Path) -> Iterator[None]:
    """An error of the system in reading is told as a mistake of the submission."""
    try:
        yield
    except OSError as error:
        raise SubmissionError(
            f"{error.filename or folder}: can't be read: {error.strerror}"
        ) from error
