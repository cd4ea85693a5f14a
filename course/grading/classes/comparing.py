"""All submissions of a class compared: each file is parsed once, apart from the grader, and what came of it is kept."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from course.atomic import replacing
from course.effects import PROJECT
from course.grading.classes.apart import apart
from course.grading.classes.shingling import LARGEST, shingles, statements
from course.grading.classes.similarity import Shingles, Similar, as_shingles, find_similar
from course.grading.classes.submitted import Submission
from course.grading.references import SOLUTIONS
from course.grading.release.stubs import make_stub

_FORMAT = "1"
"""Goes up when what is kept would come out otherwise."""


@dataclass(frozen=True)
class Compared:
    """What came of comparing a class.

    Attributes
    ----------
    similar : pairs that are too much alike
    left_out : student and module of files that are too large or took too long to be compared
    """

    similar: tuple[Similar, ...] = ()
    left_out: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class _File:
    module: str
    source: bytes
    stub: str

    @property
    def key(self) -> str:
        """The same for the same text."""
        parts = (_FORMAT.encode(), self.module.encode(), self.stub.encode(), self.source)
        return hashlib.sha256(
            b"\0".join(hashlib.sha256(part).digest() for part in parts)
        ).hexdigest()


def compare(
    submissions: Sequence[Submission], modules: Sequence[str], kept: Path, jobs: int = 1
) -> Compared:
    """Compare the submissions of a class, module by module.

    Parameters
    ----------
    kept : file in which what came of each text is kept from run to run
    jobs : processes
    """
    stubs = {module: _stub(module) for module in modules}
    files = {
        (one.student, module): _File(module, source, stubs[module])
        for one in submissions
        for module, source in one.sources.items()
        if len(source) <= LARGEST
    }
    found = _of_texts({file.key: file for file in files.values()}, kept, jobs)
    similar: list[Similar] = []
    for module in modules:
        of_module = {
            student: found[file.key]
            for (student, name), file in files.items()
            if name == module and file.key in found
        }
        similar += find_similar(module, of_module)
    left_out = tuple(
        (one.student, module)
        for one in submissions
        for module in one.sources
        if (one.student, module) not in files or files[one.student, module].key not in found
    )
    return Compared(tuple(similar), left_out)


def _of_texts(files: Mapping[str, _File], kept: Path, jobs: int) -> dict[str, Shingles]:
    """What texts are compared by, from earlier runs or made now; those that took too long are left out."""
    found = {key: own for key, own in _read(kept).items() if key in files}
    new = [file for key, file in files.items() if key not in found]
    for place, own in apart(_compared_by, new, jobs).items():
        # One that took too long is tried again by the next run: it may have been the machine's doing.
        if own is not None:
            found[new[place].key] = own
    if new:
        with replacing(kept) as temporary, temporary.open("wb") as file:
            np.savez_compressed(file, **found)  # type: ignore[arg-type]
    return found


def _compared_by(file: _File) -> Shingles:
    return as_shingles(shingles(file.module, file.source, statements(file.stub)))


def _read(path: Path) -> dict[str, Shingles]:
    try:
        with np.load(path, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except (OSError, ValueError, EOFError, BadZipFile):
        return {}  # Not there, or not ours.


def _stub(module: str) -> str:
    path = SOLUTIONS / f"{module}.py"
    text = path.read_text(encoding="utf-8")
    return make_stub(text, module, str(path.relative_to(PROJECT))).text
