"""The submissions of a class: whatever lies in a folder, each told whose it is or why that can't be told.

A folder, an archive or a file named after its student is a submission, and so is what Canvas and Moodle name in their
own way. Nobody knows what students hand in, so whatever is wrong with one of them is kept as its trouble and stops
nothing; and nothing is left out but what a file manager has made.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath

from course.base.errors import CourseError
from course.base.texts import clean_line
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reading import modules_defined
from course.school.grading.classes.choosing import choose, content_of, is_notebook
from course.school.grading.classes.engines import LARGEST_SPACE, apart
from course.school.grading.classes.entries import (
    LARGEST_ARCHIVE,
    Entry,
    archive_suffix,
    file_reader,
    folder_entries,
    too_large,
    unfolded,
)
from course.school.grading.classes.names import (
    read_name,
    safe_name,
    same_name,
    short_name,
)
from course.school.grading.classes.systems import Sent, sent, sent_together
from course.school.grading.submissions import SubmissionError

READING = 60.0
"""Seconds that reading one submission may take if there are archives or notebooks in it."""

_ENDLESS = (
    f"its archives and notebooks can't be read within {READING:g} s and {LARGEST_SPACE // 10**9} GB"
)

_IGNORED = ("__MACOSX", "__pycache__", "Thumbs.db", "desktop.ini")


@dataclass(frozen=True)
class Submission:
    """The submission of one student.

    Attributes
    ----------
    student : the name, safe as the name of a folder on every system
    paths : where it lies
    sources : module -> the student's file
    trouble : why it can't be graded; empty if it can
    remarks : what was guessed, and what was left out
    names : by which lists of a learning system or the instructor may know the student
    number, logins : that a learning system knows the student by; empty where it says none
    downloaded : whether it is a learning system's download
    """

    student: str
    paths: tuple[Path, ...]
    sources: dict[str, bytes] = field(default_factory=dict)
    trouble: str = ""
    remarks: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    number: str = ""
    logins: tuple[str, ...] = ()
    downloaded: bool = False

    @property
    def claims(self) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
        """What may be the student's number, login and name in a roster.

        In a download only what the system itself has given is certain: who may change the own name there could take
        another's login.
        """
        if not self.downloaded:
            return (self.names,) * 3
        return ((self.number,), self.logins, self.names)


@dataclass
class _Handed:
    """Files and folders of a class under one student's name, before they are read.

    Attributes
    ----------
    owner : the student, as the names say it
    parts : path, and the name of the file in the submission; "" for what is a submission as a whole
    names, number, logins, downloaded : as in `Submission`
    attempt : of a student's several the latest counts
    """

    owner: str
    parts: list[tuple[Path, str]] = field(default_factory=list)
    trouble: str = ""
    remarks: list[str] = field(default_factory=list)
    names: tuple[str, ...] = ()
    number: str = ""
    logins: tuple[str, ...] = ()
    downloaded: bool = False
    attempt: str = ""

    def join(self, other: "_Handed") -> None:
        """Take in another part of the same student's; of two tries only the later one counts."""
        if self.attempt == other.attempt:
            self.parts += other.parts
        else:
            later, earlier = (self, other) if self.attempt > other.attempt else (other, self)
            listed = ", ".join(path.name for path, _ in earlier.parts)
            self.remarks.append(f"an earlier try was not graded: {listed}")
            self.parts, self.attempt = later.parts, later.attempt
        self.remarks += other.remarks


def find_submissions(folder: Path, modules: Iterable[str] = tuple(COURSE)) -> list[Submission]:
    """Everything in a folder, in the order of the names, read.

    Raises CourseError: there is no such folder or nothing in it.
    ``modules``: of these; files of other modules are left alone
    """
    modules = tuple(modules)
    try:
        paths = sorted(path for path in folder.iterdir() if not _is_file_manager_s(path.name))
    except OSError as error:
        raise CourseError(f"{folder}: can't be read: {error.strerror}") from error
    found: dict[tuple[str, str], _Handed] = {}
    together = sent_together(folder, paths)
    for path in paths:
        by = together.get(path)
        parts = [_handed(path, modules)] if by is None else [_sent(path, one) for one in by]
        for key, handed in parts:
            if key in found:
                found[key].join(handed)
            else:
                found[key] = handed
    if not found:
        raise CourseError(f"{folder}: holds no submissions (folders, archives or files)")
    _mark_clashes([*found.values()])
    taken: set[str] = set()
    named = {_own_name(one.owner, taken): one for one in found.values()}
    for student, one in named.items():
        if student != safe_name(one.owner):
            one.remarks.append(f"the name {one.owner} is shortened or numbered here")
    return sorted(_read_all(named, modules), key=lambda one: one.student)


def read_one(student: str, path: Path, modules: Iterable[str] = tuple(COURSE)) -> Submission:
    """One submission, a folder or an archive; whatever is wrong with it is its trouble."""
    (found,) = _read_all({student: _Handed(student, [(path, "")])}, tuple(modules))
    return found


def _is_file_manager_s(name: str) -> bool:
    # Its own files and folders are hidden ones. Archives and programs are never, nor is what begins with two dots.
    work = bool(archive_suffix(name)) or name.lower().endswith((".py", ".ipynb"))
    hidden = name.startswith(".") and not work and not name.startswith("..")
    return hidden or name.startswith("._") or name in _IGNORED


def _handed(path: Path, modules: tuple[str, ...]) -> tuple[tuple[str, str], _Handed]:
    """The submission at one path, and a key of its student: parts of one submission have the same."""
    if by := sent(path.name, path.is_dir()):
        if len(by) > 1:
            told = f"its name can be read as that of {' and of '.join(one.owner for one in by)}"
            return ("none", path.name), _Handed(path.name, [(path, "")], f"{told}: rename it")
        return _sent(path, by[0])
    if path.is_dir() or path.is_symlink():
        return ("whole", path.name), _Handed(path.name, [(path, "")], names=(path.name,))
    named = read_name(path.name, modules)
    if suffix := archive_suffix(path.name):
        stem = path.name[: -len(suffix)]
        owner = read_name(f"{stem}.py", modules).owner or stem
        return ("whole", path.name), _Handed(owner, [(path, "")], names=(owner,))
    if named.suffix and named.owner:
        module = named.module or _module_of(path, modules)
        inner = f"{module}{named.suffix}" if module else path.name
        handed = _Handed(named.owner, [(path, inner)], names=(named.owner,))
        if not named.module and module:
            handed.remarks.append(f"{path.name} was graded as {module}.py")
        return ("file", named.owner), handed
    told = (
        f"nothing in the name says whose it is: rename it STUDENT_{path.name}, "
        "or put it into a folder named after the student"
        if named.suffix
        else "is no folder, archive, .py file or notebook"
    )
    return ("none", path.name), _Handed(path.name, [(path, path.name)], trouble=told)


def _sent(path: Path, by: Sent) -> tuple[tuple[str, str], _Handed]:
    """The same for what a learning system says whose it is."""
    remarks = [f"{by.file or path.name}: {by.remark}"] if by.remark else []
    parts, known = [(path, by.file)], (by.names, by.number, by.logins)
    handed = _Handed(by.owner, parts, "", remarks, *known, downloaded=True, attempt=by.attempt)
    return ("sent", by.owner), handed


def _module_of(path: Path, modules: tuple[str, ...]) -> str:
    """The module of a file whose name is the student's: the only one that is graded, or by what it defines."""
    if len(modules) == 1:
        return modules[0]
    try:
        found = modules_defined(
            content_of(Entry(PurePosixPath(path.name), file_reader(path))), modules
        )
    except SubmissionError:
        return ""
    return found[0] if len(found) == 1 else ""


def _mark_clashes(found: list[_Handed]) -> None:
    """Tell of submissions that may be one student's or two students': who they are is not for the grader to guess."""
    by_name: dict[str, list[_Handed]] = {}
    for one in found:
        by_name.setdefault(same_name(safe_name(one.owner)), []).append(one)
    for group in by_name.values():
        if len(group) > 1:
            listed = " and ".join(one.parts[0][0].name for one in group)
            for one in group:
                one.trouble = f"{listed} go by one name: remove or rename one"
                one.owner = one.parts[0][0].name


def _own_name(owner: str, taken: set[str]) -> str:
    """A name for the student's folder that nobody has yet."""
    name = short_name(safe_name(owner))
    number = 2
    while same_name(name) in taken:
        name = f"{short_name(safe_name(owner))} ({number})"
        number += 1
    taken.add(same_name(name))
    return name


def _read_all(handed: dict[str, _Handed], modules: tuple[str, ...]) -> list[Submission]:
    """Submissions by their students' names, read; those with archives or notebooks in another process.

    What unpacks or parses can be made to take hours, or all memory.
    """
    packed, found = [], []
    for student, one in handed.items():
        if _is_packed(one):
            packed.append((student, one, modules))
        else:
            found.append(_read(student, one, modules))
    for i, read in apart(_read_packed, packed, seconds=READING).items():
        student, one, _ = packed[i]
        found.append(read or _read(student, replace(one, trouble=_ENDLESS), modules))
    return found


def _is_packed(handed: _Handed) -> bool:
    """Whether there are archives or notebooks among the files; what can't be read has none."""
    try:
        return any(
            archive_suffix(entry.path.name) or is_notebook(entry) for entry in _entries(handed)
        )
    except CourseError:
        return False


def _read_packed(work: tuple[str, _Handed, tuple[str, ...]]) -> Submission:
    return _read(*work)


def _read(student: str, handed: _Handed, modules: tuple[str, ...]) -> Submission:
    paths = tuple(path for path, _ in handed.parts)
    remarks: list[str] = []
    sources: dict[str, bytes] = {}
    trouble = handed.trouble
    try:
        if not trouble:
            sources = choose([*unfolded(_entries(handed), remarks)], modules, remarks)
    except CourseError as error:
        trouble, remarks = str(error), []
    # Whatever prints them: what a student may choose, such as names in an archive, is cleaned here.
    trouble, *told = (
        clean_line(_without_folders(text, handed)) for text in (trouble, *handed.remarks, *remarks)
    )
    names = (student, *handed.names)
    known = handed.number, handed.logins, handed.downloaded
    return Submission(student, paths, sources, trouble, tuple(told), names, *known)


def _entries(handed: _Handed) -> Iterator[Entry]:
    """Files of all parts of a submission."""
    for path, inner in handed.parts:
        if path.is_symlink():
            raise SubmissionError("it is a link; submit the files themselves")
        if path.is_dir():
            yield from folder_entries(path)
        else:
            if archive_suffix(path.name) and path.stat().st_size > LARGEST_ARCHIVE:
                raise too_large(path.name)
            yield Entry(PurePosixPath(inner or path.name), file_reader(path))


def _without_folders(text: str, handed: _Handed) -> str:
    """The folders above are the grader's business, not the student's."""
    for path, _ in handed.parts:
        text = text.replace(f"{path}: ", "").replace(f"{path}/", "").replace(f"{path.parent}/", "")
    return text
