"""Pairs of submissions that are too much alike, found in their syntax trees.

What a student may change without thinking counts for nothing: names, constants, comments, docstrings, the order of
functions, code that nothing calls. What everybody has counts for nothing either: the statements of the stub, the heads
of its functions, and guards that do nothing but raise. What remains is compared by its runs of SHINGLE neighbouring
nodes. A pair that is found is worth a look, never a verdict.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

ALIKE = 0.7
"""Share of the smaller submission's shingles that the larger one has too."""

FEWEST = 40
"""Shingles; short files are alike without anybody's having copied."""

Shingles = NDArray[np.int64]
"""What one submission is compared by: sorted, each once."""


@dataclass(frozen=True)
class Similar:
    """Two submissions of a module that are alike.

    Attributes
    ----------
    module : str
    first, second : the students, in the order of the alphabet
    share : of the smaller one's shingles that the other one has, 0 to 1
    shingles : of the smaller one
    """

    module: str
    first: str
    second: str
    share: float
    shingles: int


def as_shingles(found: Iterable[int]) -> Shingles:
    """Hashes as they are compared and kept."""
    return np.unique(np.fromiter(found, np.int64))


def find_similar(
    module: str, found: Mapping[str, Shingles], threshold: float = ALIKE
) -> list[Similar]:
    """Pairs of submissions of one module that are alike, the most alike first.

    Parameters
    ----------
    found : student -> what the submission is compared by
    threshold : least share that is told
    """
    students = sorted(student for student, own in found.items() if own.size >= FEWEST)
    if len(students) < 2:
        return []
    size = np.array([found[student].size for student in students])
    _, columns = np.unique(np.concatenate([found[one] for one in students]), return_inverse=True)
    starts = np.concatenate([[0], np.cumsum(size)])
    has = csr_array((np.ones(columns.size, np.int32), columns, starts))
    shared = (has @ has.T).toarray()
    smaller = np.minimum(size[:, None], size)
    share = np.triu(shared / smaller, 1)
    return sorted(
        (
            Similar(module, students[i], students[j], float(share[i, j]), int(smaller[i, j]))
            for i, j in zip(*np.nonzero(share >= threshold), strict=True)
        ),
        key=lambda pair: (-pair.share, pair.first, pair.second),
    )
