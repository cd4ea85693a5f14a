"""References that are made once, for checks, archives, bundles and classes: the same as those made on the spot."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest

from course.school.grading import progress
from course.school.grading import references as making
from course.school.grading.checks.check import References
from course.school.grading.references import make_references, read_references
from tests.once import Once

SEED = 0
"""The seed that the checks usually have."""

ReferencesFile = Callable[..., Path]
"""(module, seed) -> the file of its references, which is there."""


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
def lent_references(usual_references: References, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let commands that check in this process compare with them."""
    usual = making.references

    def lent(seed: int = SEED) -> References:
        return usual_references if seed == SEED else usual(seed)

    for place in (making, progress):
        monkeypatch.setattr(place, "references", lent)


@contextmanager
def at_hand(references_file: ReferencesFile) -> Iterator[None]:
    """Let nothing make references but by collecting them from these files."""

    def collected(modules: Iterable[str], seed: int, out: Path) -> None:
        arrays: dict[str, np.ndarray] = {}  # type: ignore[type-arg]
        for module in modules:
            with np.load(references_file(module, seed)) as found:
                arrays |= {name: found[name] for name in found if name != "seed"}
        np.savez_compressed(out, **arrays, seed=np.array(seed))

    with pytest.MonkeyPatch.context() as patch:
        for place in ("classes.grading", "release.archive"):
            patch.setattr(f"course.school.grading.{place}.make_references", collected)
        yield
