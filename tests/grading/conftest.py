"""References of all modules, which take longer to make than most tests: made once for all processes of a run."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from course.cli.main import commands
from course.grading.checks.check import References
from course.grading.references import make_references, read_references
from tests.once import Once

SEED = 0
"""The seed that the checks usually have."""


@pytest.fixture(scope="session")
def references_file(once: Once) -> Callable[..., Path]:
    """The file of references of one module, made with a seed."""

    def file(module: str, seed: int = SEED) -> Path:
        return once(f"{module}-{seed}.npz", partial(make_references, (module,), seed))

    return file


@pytest.fixture(scope="session")
def usual_references(references_file: Callable[..., Path]) -> References:
    """The references of all modules."""

    @cache
    def of(module: str) -> References:
        return read_references(references_file(module), SEED)

    return lambda module, check: of(module)(module, check) if check.prepare else {}


@contextmanager
def _at_hand(references_file: Callable[..., Path]) -> Iterator[None]:
    def collected(modules: Iterable[str], seed: int, out: Path) -> None:
        arrays: dict[str, np.ndarray] = {}  # type: ignore[type-arg]
        for module in modules:
            with np.load(references_file(module, seed)) as found:
                arrays |= {name: found[name] for name in found if name != "seed"}
        np.savez_compressed(out, **arrays, seed=np.array(seed))

    with pytest.MonkeyPatch.context() as patch:
        for place in ("classes.grading", "release.archive"):
            patch.setattr(f"course.grading.{place}.make_references", collected)
        yield


@pytest.fixture
def references_at_hand(references_file: Callable[..., Path]) -> Iterator[None]:
    """Give archives and classes the references that are made once: the same bytes as those made on the spot."""
    with _at_hand(references_file):
        yield


@pytest.fixture(scope="session")
def bundled(references_file: Callable[..., Path]) -> Callable[..., Result]:
    """`course bundle` with these arguments, and with references that are made once."""

    def run(*arguments: str) -> Result:
        with _at_hand(references_file):
            return CliRunner().invoke(commands, ["bundle", *arguments])

    return run
