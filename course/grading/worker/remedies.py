"""What to do about the exceptions that NumPy raises for the mistakes that everybody makes with batches once."""

from __future__ import annotations

import re
from collections.abc import Sequence

from course.modules import COURSE

_SHAPE = re.compile(r"\(([0-9, ]{1,80})\)")

ONE_EACH = "(a * b).sum(axis=0) gives the dot product of each column"

REMEDIES: tuple[tuple[str, str], ...] = (
    (
        rf"No module named '({'|'.join(COURSE)})'",
        (
            "Each module is checked by itself, without the files beside it: copy the helper into this file."
        ),
    ),
    (
        r"shapes? .* not aligned|mismatch in its core dimension",
        f"np.dot and @ multiply matrices, not the columns of two batches: {ONE_EACH}.",
    ),
    (
        r"truth value of an array",
        (
            "if, and, or, not, min and max take one number, and this is a batch: np.where chooses for each column, "
            "& and | join conditions, np.minimum and np.maximum compare."
        ),
    ),
    (
        r"only (length-1|size-1|0-dimensional) arrays can be converted",
        (
            "float() and the functions of math take one number, and this is a batch: those of NumPy (np.sqrt, np.cos) "
            "take all of it."
        ),
    ),
    (
        r"invalid index to scalar|array is 0-dimensional|object is not subscriptable",
        (
            "A number came where an array was meant: np.linalg.norm, sum, min and max without axis give one number for "
            "the whole batch; with axis=0 they give one for each column."
        ),
    ),
    (
        (
            r"index \d+ is out of bounds for axis 0|too many indices|not enough values to unpack"
            r"|too many values to unpack|cannot unpack non-iterable"
        ),
        (
            "The first axis has the coordinates and the last one the columns: u[0] and u[1] are the rows of (2, N), "
            "and u[:, 0] is its first column."
        ),
    ),
    (
        r"index -?\d+ is out of bounds for axis [1-9]",
        "The last axis has N columns, and N may be 0 or 1: no column can be counted on.",
    ),
    (
        r"zero-size array to reduction|attempt to get arg(max|min) of an empty",
        "N = 0 is a batch, too: the largest or smallest of no columns doesn't exist.",
    ),
    (
        r"Cannot cast ufunc",
        (
            "An operation in place (+=, *=, out=) keeps its array's dtype, and the result is of another: "
            "write a = a * b, and cast to the dtype of the batch in the end."
        ),
    ),
    (
        r"must have the same shape|must match exactly|inhomogeneous shape",
        (
            "np.stack and np.array take rows of one shape: a number beside batches has to become a batch first, "
            "as np.zeros_like or np.full make one."
        ),
    ),
)
"""(what the exception's text holds, what to do); the first that fits is told."""


def remedy(message: str) -> str:
    """What to do about an exception with this text; empty where that isn't known."""
    if "could not be broadcast" in message:
        return _broadcast([_sizes(shape) for shape in _SHAPE.findall(message)])
    return next((text for pattern, text in REMEDIES if re.search(pattern, message)), "")


def _sizes(shape: str) -> tuple[int, ...]:
    return tuple(int(size) for size in shape.split(",") if size.strip())


def _broadcast(shapes: Sequence[tuple[int, ...]]) -> str:
    """Of shapes that don't go together."""
    if len(shapes) < 2:
        return "NumPy lines shapes up at their ends: each pair of sizes has to be equal, or one of them 1."
    a, b = sorted(shapes[:2], key=len)
    if len(a) == len(b) == 2 and a == b[::-1]:
        turned, right = (b, a) if a[0] in (2, 3) else (a, b)
        return (
            f"{turned} is {right} turned over: a batch has its coordinates in the first axis and its N columns in "
            "the last, so (2, N) or (3, N)."
        )
    if len(a) == 1 and len(b) == 2 and a[0] == b[0]:
        return (
            f"{a} and {b}: NumPy lines shapes up at their ends. A single point needs a second axis to go with "
            "the columns of a batch: point[:, None]. If it is a length: np.linalg.norm with axis=0 gives one for "
            "each column, with axis=1 one for each row."
        )
    if len(a) == len(b) == 1:
        return f"{a} and {b}: a single point and a number for each column make a batch as point[:, None] * numbers."
    return (
        f"{a} and {b}: NumPy lines shapes up at their ends; each pair of sizes has to be equal, or one of them 1. "
        "Batches are (2, N) or (3, N), numbers of a batch (N,), single points (3,)."
    )
