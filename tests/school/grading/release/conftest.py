"""The student archive, which takes long to make: made once for all processes of a run."""

from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from course.school.grading.release.archive import write_archive
from tests.once import Once
from tests.school.grading.lent import ReferencesFile, at_hand


@pytest.fixture(scope="session")
def archive(once: Once, references_file: ReferencesFile) -> Path:
    """The zip file."""

    def make(path: Path) -> None:
        with at_hand(references_file):
            write_archive(PROJECT, path)

    return once("student.zip", make)
