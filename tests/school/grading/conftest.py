"""References of all modules, which take longer to make than most tests: made once for all processes of a run."""

from collections.abc import Callable, Iterator

import pytest
from click.testing import CliRunner, Result

from course.cli.main import commands
from tests.school.grading.lent import (
    ReferencesFile,
    at_hand,
    references_file,
    usual_references,
)

__all__ = ["references_file", "usual_references"]


@pytest.fixture
def references_at_hand(references_file: ReferencesFile) -> Iterator[None]:
    """Give archives and classes the references that are made once: the same bytes as those made on the spot."""
    with at_hand(references_file):
        yield


@pytest.fixture(scope="session")
def bundled(references_file: ReferencesFile) -> Callable[..., Result]:
    """`course bundle` with these arguments, and with references that are made once."""

    def run(*arguments: str) -> Result:
        with at_hand(references_file):
            return CliRunner().invoke(commands, ["bundle", *arguments])

    return run
