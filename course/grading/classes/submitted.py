"""The submissions of a class: a folder of folders and zip files, each named after its student.

Nobody knows what students hand in, so whatever is wrong with one of them is kept as its trouble and stops nothing.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

from course.effects import COURSE
from course.errors import CourseError
from course.grading.submissions import read_submission

LARGEST_ZIP = 50_000_000
"""Bytes of a zip file, as it lies on the disk."""

LONGEST_NAME = 150
"""Characters of a student's name, quoted."""

_PLAIN = " -_@+,()'."
_DEVICES = {
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{n}" for port in ("com", "lpt") for n in "123456789"),
}
_OUTPUTS = ("grades.csv", "class.html", "references_")
_IGNORED = ("__MACOSX", "__pycache__")


@dataclass(frozen=True)
class Submission:
    """What one student has handed in.

    Attributes
    ----------
    student : the name, safe as the name of a folder on every system
    path : where it lies
    sources : module -> the student's file
    trouble : why it can't be read; empty if it could
    """

    student: str
    path: Path
    sources: dict[str, bytes] = field(default_factory=dict)
    trouble: str = ""


def find_submissions(folder: Path, modules: Iterable[str] = tuple(COURSE)) -> list[Submission]:
    """Every folder and zip file directly in a folder, in the order of the names, read.

    Parameters
    ----------
    modules : of these; whatever else a submission holds is left alone

    Raises
    ------
    CourseError
        There is no such folder or nothing in it, or two submissions have one name; names both.
    """
    try:
        entries = sorted(folder.iterdir())
    except OSError as error:
        raise CourseError(f"{folder}: can't be read: {error.strerror}") from error
    by_name: dict[str, Path] = {}
    found = []
    for path in entries:
        if not _is_submission(path):
            continue
        student = safe_name(path.name[:-4] if _is_zip(path) else path.name)
        if len(student) > LONGEST_NAME:
            raise CourseError(f"{folder}: the name {student[:40]}... is too long; rename it")
        # Some file systems take names for the same that differ in case or in how accents are written.
        same = unicodedata.normalize("NFC", path.stem if _is_zip(path) else path.name).casefold()
        if same in by_name:
            raise CourseError(
                f"{by_name[same]} and {path} are both submissions of {student}; remove one"
            )
        by_name[same] = path
        found.append(read_one(student, path, modules))
    if not found:
        raise CourseError(f"{folder}: holds no submissions (folders or .zip files)")
    return found


def safe_name(name: str) -> str:
    """A name that is safe as the name of a folder, different for different names.

    Letters, digits, spaces and some signs stay; all else becomes %XX, as it does in addresses of the web.
    """
    safe = "".join(
        sign if sign.isalnum() or sign in _PLAIN else quote(sign, safe="", errors="surrogateescape")
        for sign in name
    )
    start = safe[:1]
    stem = safe.partition(".")[0].rstrip().casefold()
    if start in ("", ".", " ", "-") or stem in _DEVICES or safe.casefold().startswith(_OUTPUTS):
        safe = "".join(f"%{byte:02X}" for byte in start.encode()) + safe[1:] or "%00"
    if safe[-1:] in (".", " "):
        safe = f"{safe[:-1]}%{ord(safe[-1]):02X}"
    return safe


def _is_zip(path: Path) -> bool:
    return path.name.lower().endswith(".zip") and not (path.is_dir() and not path.is_symlink())


def _is_submission(path: Path) -> bool:
    if path.name in _IGNORED:
        return False
    # A file manager's own folders are hidden ones; a zip file is never one of those.
    return _is_zip(path) or (path.is_dir() and not path.name.startswith("."))


def read_one(student: str, path: Path, modules: Iterable[str] = tuple(COURSE)) -> Submission:
    """One submission; whatever is wrong with it is its trouble."""
    try:
        if path.is_symlink():
            return Submission(student, path, trouble="it is a link; submit the files themselves")
        if path.is_file() and path.stat().st_size > LARGEST_ZIP:
            return Submission(student, path, trouble="it is too large to be a submission")
        return Submission(student, path, read_submission(path, modules))
    except CourseError as error:
        # The folders above are the grader's business, not the student's.
        told = str(error).replace(f"{path}: ", "").replace(f"{path}/", "")
        return Submission(student, path, trouble=told)
