"""The student archive, which takes long to make: made once for all processes of a run."""

from functools import partial
from pathlib import Path

import pytest

from course.effects import PROJECT
from course.grading.release.archive import write_archive
from tests.once import Once


@pytest.fixture(scope="session")
def archive(once: Once) -> Path:
    """The zip file, with references made for it."""
    return once("student.zip", partial(write_archive, PROJECT))
