"""References of all modules, which take longer to make than most tests: made once for all processes of a run."""

from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from course.cli.main import commands
from course.school.grading.checks.check import References
from course.school.grading.references import make_references, read_references
from tests.once import Once
from tests.school.grading.lent import ReferencesFile, at_hand

SEED = 0
"""The seed that the checks usually have."""


@pytest.fixture(scope="session")
def references_file(once: Once) -> ReferencesFile:
    """The file of references of one module, made with a seed."""

    def file(module: str, seed: int = SEED) -> Path:
        return once(f"{module}-{seed}.npz", partial(make_references, (module,), seed))

    return file


@pytest.fixture(scope="session")
def usual_references(references_file: ReferencesFile) -> References:
    """The references of all modules."""

    @cache
    def of(module: str) -> References:
        return read_references(references_file(module), SEED)

    return lambda module, check: of(module)(module, check) if check.prepare else {}


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
