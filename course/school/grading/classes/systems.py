"""Names that learning systems give to what they hand out: whose file or folder it is, and which try.

Canvas, Moodle, Blackboard, Brightspace and ILIAS say it in each name, GitHub Classroom in names that all begin alike,
and Gradescope in a file beside them.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

import yaml

from course.base.errors import CourseError
from course.base.inputs import LARGEST_SCENE, InputLimit, read_input
from course.school.grading.classes.engines import apart

BY_GITHUB = "github:"
"""Before a login that is one of GitHub, where everybody chooses it: it is no other login."""

GRADESCOPE = "submission_metadata.yml"
"""The file that says whose Gradescope's folders are."""

_CANVAS = re.compile(r"(?P<name>[^_]+)(?P<late>_LATE)?_(?P<id>\d+)_\d+_(?P<file>.+)", re.DOTALL)
_MOODLE = re.compile(r"_(?P<id>\d+)_assignsubmission_(?P<kind>file|onlinetext)(?:_|$)")
_BLACKBOARD = re.compile(
    r"_attempt_(?P<try>\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d)(?:_(?P<file>.+)|\.txt)", re.DOTALL
)
_BRIGHTSPACE = re.compile(
    r"(?P<id>\d+-\d+) - (?P<name>.+?) - (?P<day>[A-Za-z]+\.? \d{1,2}, \d{4}) (?P<time>\d{3,4})"
    r"(?: (?P<half>[AP]M))?(?: - (?P<file>.+))?",
    re.DOTALL,
)
_ILIAS = re.compile(r"(?P<last>[^_]+)_(?P<first>[^_]+)_(?P<login>[^_].*)_\d+", re.DOTALL)


@dataclass(frozen=True)
class Sent:
    """What a system says of a file or folder.

    Attributes
    ----------
    owner : a name that tells this student from all others
    file : the file's own name; empty for a folder
    names : the student's, where the system shows it
    number : by which the system knows the student; empty where it doesn't say
    logins : likewise; more than one where the name doesn't say where the login begins
    attempt : of several of one student the latest is the last in the order of the alphabet
    remark : what the system says of it besides
    """

    owner: str
    file: str
    names: tuple[str, ...] = ()
    number: str = ""
    logins: tuple[str, ...] = ()
    attempt: str = ""
    remark: str = ""


def sent(name: str, is_folder: bool = False) -> tuple[Sent, ...]:
    """What a name says by itself: nothing if no system gave it.

    The end of the name is the student's own, with Moodle its beginning, too. So a name that can be read in more than
    one way says nothing that is certain.
    """
    found = []
    if by := _CANVAS.fullmatch(name):
        late = "Canvas says that it is late" if by["late"] else ""
        found.append(_numbered(by["name"], by["id"], by["file"], late))
    for by in _MOODLE.finditer(name):
        if by.start():
            text = "typed into Moodle" if by["kind"] == "onlinetext" else ""
            found.append(_numbered(name[: by.start()], by["id"], name[by.end() :], text))
    for by in _BLACKBOARD.finditer(name):
        # The assignment's name comes first, and both it and a login may hold the sign between them.
        owner, file = name[: by.start()], by["file"] or "comments.txt"
        if owner and (by["file"] or by.end() == len(name)):
            parts = owner.split("_")
            logins = tuple("_".join(parts[i:]) for i in range(1, len(parts)))
            found.append(Sent(owner, file, logins=logins, attempt=by["try"]))
    if by := _BRIGHTSPACE.fullmatch(name):
        owner = f"{by['name']}_{by['id']}"
        found.append(Sent(owner, by["file"] or "", (by["name"],), attempt=_time(by)))
    if is_folder and not found and (by := _ILIAS.fullmatch(name)):
        found.append(Sent(name, "", (f"{by['first']} {by['last']}",), logins=(by["login"],)))
    return tuple(found)


def _numbered(name: str, number: str, file: str, remark: str) -> Sent:
    # A name of digits alone could be another student's number.
    names = (number,) if name.isdecimal() else (name, number)
    return Sent(f"{name}_{number}", file, names, number, remark=remark)


def _time(by: re.Match[str]) -> str:
    """A time of Brightspace as a text whose order is that of time; empty in a language that isn't known."""
    written = f"{by['day'].replace('.', '')} {by['time'].zfill(4)} {by['half'] or ''}".strip()
    for month in ("%b", "%B"):
        for hour in ("%I%M %p", "%H%M"):
            try:
                return datetime.strptime(written, f"{month} %d, %Y {hour}").isoformat()
            except ValueError:
                continue
    return ""


def sent_together(folder: Path, paths: Sequence[Path]) -> dict[Path, tuple[Sent, ...]]:
    """What only all names of a download say together: those of GitHub Classroom and Gradescope."""
    metadata = folder / GRADESCOPE
    if metadata in paths:
        return _gradescope(metadata, paths)
    return {path: (one,) for path, one in _github(folder, paths)}


def _github(folder: Path, paths: Iterable[Path]) -> Iterable[tuple[Path, Sent]]:
    """Folders of GitHub Classroom: its command clones ASSIGNMENT-LOGIN below ASSIGNMENT-submissions."""
    clones = [path for path in paths if (path / ".git").exists()]
    task, _, rest = folder.resolve().name.rpartition("-")
    before = f"{task}-" if rest == "submissions" and task else ""
    if not before and len(clones) > 1:
        first, last = min(path.name for path in clones), max(path.name for path in clones)
        same = next((i for i, (a, b) in enumerate(zip(first, last, strict=False)) if a != b), 0)
        before = first[: first.rfind("-", 0, same) + 1]
    for path in clones if before else ():
        if path.name.startswith(before) and (login := path.name.removeprefix(before)):
            yield path, Sent(path.name, "", logins=(f"{BY_GITHUB}{login}",))


def _gradescope(metadata: Path, paths: Iterable[Path]) -> dict[Path, tuple[Sent, ...]]:
    """Folders of Gradescope's export, each of one student or of several who have handed it in together."""
    try:
        content = read_input(metadata, "metadata of Gradescope", InputLimit(LARGEST_SCENE))
    except CourseError:
        return {}
    (known,) = apart(_submitters, [content], seconds=60.0).values()
    found: dict[Path, tuple[Sent, ...]] = {metadata: ()}
    for path in paths:
        people = (known or {}).get(path.name, [])
        all_of_them = " and ".join(name for name, _, _ in people)
        remark = f"handed in together: {all_of_them}" if len(people) > 1 else ""
        if people:
            found[path] = tuple(
                Sent(
                    f"{name}_{number or mail or path.name}",
                    "",
                    (name,),
                    number,
                    (mail,),
                    remark=remark,
                )
                for name, number, mail in people
            )
    return found


def _submitters(content: bytes) -> dict[str, list[tuple[str, str, str]]]:
    """Folder -> name, number and address of each of its students."""
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        document: Any = yaml.load(content, Loader=loader)  # a safe one
        return {
            str(folder): [
                tuple(str(one.get(f":{key}") or "") for key in ("name", "sid", "email"))  # type: ignore[misc]
                for one in about[":submitters"]
            ]
            for folder, about in document.items()
        }
    except (yaml.YAMLError, ValueError, KeyError, TypeError, AttributeError):
        return {}
