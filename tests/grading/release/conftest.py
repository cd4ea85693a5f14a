"""The student archive, which takes long to make: made once for all processes of a run."""

from pathlib import Path

import pytest

from course.effects import PROJECT
from course.grading.release.archive import write_archive
from tests.grading.lent import ReferencesFile, at_hand
from tests.once import Once


@pytest.fixture(scope="session")
def archive(once: Once, references_file: ReferencesFile) -> Path:
    """The zip file."""

    def make(path: Path) -> None:
        with at_hand(references_file):
            write_archive(PROJECT, path)

    return once("student.zip", make)
