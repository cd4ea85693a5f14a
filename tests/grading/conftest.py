"""References of all modules, which take longer to make than most tests: made once for all processes of a run."""

from collections.abc import Callable, Iterable
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest

from course.grading.checks.check import References
from course.grading.references import make_references, read_references
from tests.once import Once

SEED = 0
"""The seed that the checks usually have."""


@pytest.fixture(scope="session")
def references_file(once: Once) -> Callable[[str], Path]:
    """The file of references of one module, made with the usual seed."""

    def file(module: str) -> Path:
        return once(f"{module}.npz", partial(make_references, (module,), SEED))

    return file


@pytest.fixture(scope="session")
def usual_references(references_file: Callable[[str], Path]) -> References:
    """The references of all modules."""

    @cache
    def of(module: str) -> References:
        return read_references(references_file(module), SEED)

    return lambda module, check: of(module)(module, check) if check.prepare else {}


@pytest.fixture
def references_at_hand(
    references_file: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Give archives and classes the references that are made once: the same bytes as those made on the spot."""

    def collected(modules: Iterable[str], seed: int, out: Path) -> None:
        assert seed == SEED
        arrays: dict[str, np.ndarray] = {}  # type: ignore[type-arg]
        for module in modules:
            with np.load(references_file(module)) as found:
                arrays |= {name: found[name] for name in found if name != "seed"}
        np.savez_compressed(out, **arrays, seed=np.array(seed))

    for place in ("classes.grading", "release.archive"):
        monkeypatch.setattr(f"course.grading.{place}.make_references", collected)
