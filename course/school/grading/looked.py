"""What a call of a student's function has left behind, for those who look."""

from typing import Any

RANDOM_STATE, EARLIER_RESULT = "random state", "earlier result"
"""What a call may have changed besides its arguments: NumPy's global random state, and arrays that the call before it
has returned."""

Looked = tuple[Any, list[Any], frozenset[str]]
"""The value of a call, its arguments as they are afterwards, and what else it has changed."""
