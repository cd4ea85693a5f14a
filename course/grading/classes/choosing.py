"""Which files of a submission are its modules: by their names, and where no name tells, by what they define."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from course.grading.classes.entries import Entry, archive_suffix
from course.grading.classes.file_names import NOTEBOOK, PYTHON, Named, read_name
from course.grading.classes.notebooks import notebook_source
from course.grading.submissions import LARGEST_FILE, SubmissionError
from course.modules import COURSE

LARGEST_NOTEBOOK = 20_000_000
"""Bytes; pictures are part of a notebook."""

MOST_READ = 50
"""Files that are looked into where no name tells."""

MOST_LISTED = 4

_DEFINED = re.compile(rb"^(?:async\s+)?def\s+(\w+)", re.MULTILINE)


@dataclass
class Chosen:
    """What of a submission is graded.

    Attributes
    ----------
    sources : module -> the file
    remarks : what was guessed, and what was left out
    """

    sources: dict[str, bytes] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)


def choose(entries: Sequence[Entry], modules: Iterable[str], remarks: Sequence[str]) -> Chosen:
    """The modules among the files of a submission.

    Parameters
    ----------
    remarks : what is already known to be left out

    Raises
    ------
    SubmissionError
        There are two files for one module, none for any, or one that can't be read.
    """
    modules = tuple(modules)
    chosen = Chosen(remarks=[*remarks])
    named = [(entry, read_name(entry.path.name, modules)) for entry in entries]
    for module in modules:
        candidates = [(entry, name) for entry, name in named if name.module == module]
        if candidates:
            _take(module, candidates, chosen)
    if not chosen.sources:
        _take_by_content(entries, modules, chosen)
    if not chosen.sources:
        raise SubmissionError(_nothing(entries, modules, chosen.remarks))
    return chosen


def module_defined(source: bytes, modules: Iterable[str]) -> str:
    """The module whose functions a file defines most of; empty if there is none, or more than one."""
    defined = {name.decode() for name in _DEFINED.findall(source)}
    count = {module: len(defined & {*COURSE[module]}) for module in modules}
    most = max(count.values(), default=0)
    found = [module for module, number in count.items() if number == most > 0]
    return found[0] if len(found) == 1 else ""


def _take(module: str, candidates: list[tuple[Entry, Named]], chosen: Chosen) -> None:
    def rank(candidate: tuple[Entry, Named]) -> tuple[bool, bool, int]:
        entry, name = candidate
        # A name that is exact goes before one that isn't, a file at the top before one that lies deeper.
        return name.suffix == NOTEBOOK, not name.exact, len(entry.path.parts)

    best = min(map(rank, candidates))
    first = [entry for entry, name in candidates if rank((entry, name)) == best]
    if len(first) > 1:
        raise SubmissionError(f"{module}.py is in it more than once: {_listed(first)}")
    entry = first[0]
    chosen.sources[module] = _source(module, entry)
    if entry.path.name != f"{module}.py":
        how = " from its cells" if entry.path.name.lower().endswith(NOTEBOOK) else ""
        chosen.remarks.append(f"{entry.path} was graded{how} as {module}.py")
    others = [other for other, _ in candidates if other is not entry]
    if others:
        chosen.remarks.append(f"not graded, for {entry.path} was: {_listed(others)}")


def _take_by_content(entries: Sequence[Entry], modules: Sequence[str], chosen: Chosen) -> None:
    files = [entry for entry in entries if read_name(entry.path.name, ()).suffix == PYTHON]
    by_module: dict[str, list[tuple[Entry, bytes]]] = {}
    for entry in files[:MOST_READ]:
        try:
            source = entry.read(LARGEST_FILE)
        except SubmissionError as error:
            chosen.remarks.append(str(error))
            continue
        if module := module_defined(source, modules):
            by_module.setdefault(module, []).append((entry, source))
    for module, found in by_module.items():
        if len(found) > 1:
            listed = _listed([entry for entry, _ in found])
            raise SubmissionError(f"{listed} define functions of {module}; name one {module}.py")
        ((entry, source),) = found
        chosen.sources[module] = source
        chosen.remarks.append(f"{entry.path} was graded as {module}.py, whose functions it defines")


def _source(module: str, entry: Entry) -> bytes:
    if entry.path.name.lower().endswith(NOTEBOOK):
        return notebook_source(module, str(entry.path), entry.read(LARGEST_NOTEBOOK))
    return entry.read(LARGEST_FILE)


def _nothing(entries: Sequence[Entry], modules: Sequence[str], remarks: Sequence[str]) -> str:
    if remarks:
        return "nothing in it can be graded; " + "; ".join(remarks)
    files = [entry for entry in entries if not archive_suffix(entry.path.name)] or entries
    holds = f"it holds {_listed(files)}" if files else "it is empty"
    wanted = f"{modules[0]}.py" if len(modules) == 1 else f"a module, such as {modules[0]}.py"
    return f"there is no file for {wanted}: {holds}"


def _listed(entries: Sequence[Entry]) -> str:
    names = [str(entry.path) for entry in entries[:MOST_LISTED]]
    more = len(entries) - len(names)
    return ", ".join(names) + (f" and {more} more" if more > 0 else "")
