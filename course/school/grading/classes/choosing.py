"""Which files of a submission are its modules: their names say it, and where no name tells, what they define."""

import json
import re
from collections.abc import Sequence

from course.engine.functions.notebook.reading import (
    LARGEST_FILE,
    LARGEST_NOTEBOOK,
    Notebook,
    NotebookError,
    converted,
    modules_defined,
    read_notebook,
)
from course.school.grading.classes.engines import apart
from course.school.grading.classes.entries import Entry, archive_suffix
from course.school.grading.classes.names import NOTEBOOK, PYTHON, NamedFile, read_name
from course.school.grading.submissions import SubmissionError

MOST_READ = 50
"""Files that are looked into where no name tells."""

MOST_LISTED = 4

_WRITES = re.compile(rb"%%(?:write)?file\b")
"""A cell that writes a file."""

_Sources = dict[str, bytes]
"""Module -> the file."""


def choose(entries: Sequence[Entry], modules: tuple[str, ...], remarks: list[str]) -> _Sources:
    """The modules among the files of a submission.

    Raises SubmissionError: there are two files for one module, none for any, or one that can't be read.
    ``remarks``: what is already known to be left out; gets what is guessed, and what else is left out
    """
    sources: _Sources = {}
    named = [(entry, read_name(entry.path.name, modules)) for entry in entries]
    for module in modules:
        candidates = [(entry, name) for entry, name in named if name.module == module]
        if candidates:
            sources[module] = _taken(module, candidates, remarks)
    # What cells write counts beside files of any name; what a file defines only where no name tells.
    missing = [module for module in modules if module not in sources]
    sources |= _taken_by_content(entries, missing, remarks, written=bool(sources))
    if not sources:
        raise SubmissionError(_nothing(entries, modules, remarks))
    return sources


def _taken(module: str, candidates: list[tuple[Entry, NamedFile]], remarks: list[str]) -> bytes:
    def rank(candidate: tuple[Entry, NamedFile]) -> tuple[bool, bool, int]:
        entry, name = candidate
        # A name that is exact goes before one that isn't, a file at the top before one that lies deeper.
        return name.suffix == NOTEBOOK, not name.exact, len(entry.path.parts)

    best = min(map(rank, candidates))
    first = [entry for entry, name in candidates if rank((entry, name)) == best]
    if len(first) > 1:
        raise SubmissionError(f"{module}.py is in it more than once: {_listed(first)}")
    entry = first[0]
    if is_notebook(entry):
        notebook = read_notebook(str(entry.path), content_of(entry), [module])
        found = _from_notebook(module, entry, notebook, remarks)
        if found is None:
            raise SubmissionError(
                "; ".join(
                    (
                        f"{entry.path}: defines none of its functions; hand in {module}.py",
                        *notebook.told,
                    )
                )
            )
        source = found
    else:
        source = _exported(entry, content_of(entry), [module], remarks)[module]
        if entry.path.name != f"{module}.py":
            remarks.append(f"{entry.path} was graded as {module}.py")
    others = [other for other, _ in candidates if other is not entry]
    if others:
        remarks.append(f"not graded, for {entry.path} was: {_listed(others)}")
    return source


def _from_notebook(
    module: str, entry: Entry, notebook: Notebook, remarks: list[str], why: str = ""
) -> bytes | None:
    """The module as a notebook holds it; None if it doesn't.

    ``why``: it is taken, if not for its name
    """
    written = notebook.files.get(module)
    source = written if written is not None else notebook.sources.get(module)
    if source is None:
        return None
    how = "as a cell writes it" if written is not None else "from its cells"
    remarks.append(f"{entry.path} was graded {how} as {module}.py{why}")
    if written is not None and module in notebook.sources:
        remarks.append(f"{entry.path}: functions of {module} that its cells define were not graded")
    remarks += [told for one in notebook.told if (told := f"{entry.path}: {one}") not in remarks]
    return source


def _taken_by_content(
    entries: Sequence[Entry], modules: Sequence[str], remarks: list[str], written: bool
) -> _Sources:
    """Modules by what files define; ``written``: only what a notebook's cells write into a file of the name."""
    sources: _Sources = {}
    # A program goes before a notebook; editors that hide suffixes save it as a text.
    for suffixes in ((NOTEBOOK,),) if written else ((PYTHON, ".txt"), (NOTEBOOK,)):
        files = [entry for entry in entries if entry.path.suffix.lower() in suffixes]
        # What lies at the top is what most likely is handed in.
        files.sort(key=lambda entry: len(entry.path.parts))
        by_module: dict[str, list[tuple[Entry, bytes | Notebook]]] = {}
        for entry in files[:MOST_READ]:
            wanted = [module for module in modules if module not in sources]
            try:
                for module, source in _defined(entry, wanted, written):
                    by_module.setdefault(module, []).append((entry, source))
            except (SubmissionError, NotebookError) as error:
                remarks.append(str(error))
        for module, found in by_module.items():
            if len(found) > 1:
                listed = _listed([entry for entry, _ in found])
                raise SubmissionError(
                    f"{listed} define functions of {module}; name one {module}.py"
                )
            ((entry, source),) = found
            if isinstance(source, Notebook):
                why = "" if module in source.files else ", whose functions it defines"
                taken = _from_notebook(module, entry, source, remarks, why)
                assert taken is not None
                sources[module] = taken
            else:
                sources |= _exported(entry, source, [module], remarks)
                remarks.append(
                    f"{entry.path} was graded as {module}.py, whose functions it defines"
                )
    return sources


def _exported(entry: Entry, content: bytes, modules: Sequence[str], remarks: list[str]) -> _Sources:
    """A program by its modules; where a notebook was saved as one, without what only a notebook can run."""
    sources = dict.fromkeys(modules, content)
    if b"get_ipython()" not in content:
        return sources
    cell = {"cell_type": "code", "source": content.decode("utf-8", "replace")}
    saved = json.dumps({"cells": [cell]}).encode()
    (notebook,) = apart(converted, [(saved, tuple(modules))]).values()
    if not isinstance(notebook, Notebook):
        return sources
    remarks += [f"{entry.path}, a notebook saved as a program: {told}" for told in notebook.told]
    return sources | notebook.sources


def _defined(
    entry: Entry, modules: Sequence[str], written: bool
) -> list[tuple[str, bytes | Notebook]]:
    """Modules that a file holds, by what it defines or, a notebook, by what its cells write."""
    content = content_of(entry)
    defined = [] if written else modules_defined(content, modules)
    if not is_notebook(entry):
        return [(module, content) for module in defined]
    if not modules or not (defined or _WRITES.search(content)):
        return []
    notebook = read_notebook(str(entry.path), content, modules)
    return [
        (module, notebook)
        for module in modules
        if module in notebook.files or (module in defined and module in notebook.sources)
    ]


def content_of(entry: Entry) -> bytes:
    """What is read of a file."""
    return entry.read(LARGEST_NOTEBOOK if is_notebook(entry) else LARGEST_FILE)


def is_notebook(entry: Entry) -> bool:
    """Whether its name says so."""
    return entry.path.name.lower().endswith(NOTEBOOK)


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
