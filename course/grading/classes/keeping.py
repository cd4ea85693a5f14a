"""Each student's folder of reports: written so that what is there is whole, and found again by a later run.

``results.json`` comes last and names what it was made from. Where it stands, all the other files stand too, and a run
with the same submission, seed, version and modules need not grade it again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

from course import __version__
from course.errors import OutputError
from course.grading.checks.result import Result, Status
from course.grading.classes.job import Graded, json_bytes
from course.grading.report import Report
from course.imaging.atomic import replacing

LAST = "results.json"

_REPORT = [field.name for field in fields(Report)]
_RESULT = [field.name for field in fields(Result) if field.name != "figures"]


def fingerprint(
    sources: Mapping[str, bytes], trouble: str, seed: int, modules: tuple[str, ...]
) -> str:
    """One line that changes whenever the result may: with submission, seed, version or modules."""
    parts = [__version__, seed, modules, trouble]
    files = [(name, hashlib.sha256(sources[name]).hexdigest()) for name in sorted(sources)]
    return hashlib.sha256(json.dumps([*parts, files]).encode()).hexdigest()


def keep(folder: Path, graded: Graded, mark: str) -> None:
    """Write a student's files, the one that says that all are there last.

    Parameters
    ----------
    folder : of this student
    mark : the fingerprint of what was graded; empty if the next run is to grade it again
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        # Until the new files are there, the folder is nobody's result.
        (folder / LAST).unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: can't be written: {error.strerror}") from error
    for name, content in graded.files.items():
        if name != LAST:
            _write(folder / name, content)
    if LAST in graded.files:
        results = json.loads(graded.files[LAST])
        _write(folder / LAST, json_bytes(results | {"fingerprint": mark}))


def kept(folder: Path, mark: str) -> Report | None:
    """The report of an earlier run on the very same; None if there is none."""
    try:
        found = json.loads((folder / LAST).read_bytes())
        if found["fingerprint"] != mark:
            return None
        results = tuple(
            Result(
                **{name: result[name] for name in _RESULT} | {"status": Status(result["status"])}
            )
            for result in found["results"]
        )
        return Report(**{name: found[name] for name in _REPORT} | {"results": results})
    except (OSError, ValueError, KeyError, TypeError):
        return None  # Not there, or not ours.


def _write(path: Path, content: bytes) -> None:
    with replacing(path) as temporary:
        temporary.write_bytes(content)
