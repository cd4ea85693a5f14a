"""Mistakes that a failure shows by itself, in whatever function: no known submission has to be compared."""

from __future__ import annotations

SLIPS = {
    "writes-to-arguments": "An array that was handed in holds other numbers after the call: "
    "the function works in the caller's memory.",
    "global-random-state": "NumPy's global random state is another one after the call, "
    "and so are the numbers of everybody who uses it.",
    "other-dtype": "The values may be right; the result has another dtype than was agreed for these arguments.",
    "not-refused": "Arguments that can't be right give a result, and so a wrong picture that nobody is told of.",
    "not-by-its-column": "A column's result hangs on more than its own arguments: "
    "on other columns, on its place in the batch, or on numbers drawn elsewhere.",
    "remembers-calls": "The same call gives another result the second time: something of the first is kept.",
}
"""Names, and what the student is told."""
