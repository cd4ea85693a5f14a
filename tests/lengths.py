"""How much of what takes minutes is tried: a share by `make test`, all of it by `make stress`."""

from collections.abc import Sequence
from typing import TypeVar

from hypothesis import settings

LONG = settings.get_current_profile_name() == "stress"
"""Whether all was asked for: `pytest FILE --hypothesis-profile=stress`."""

T = TypeVar("T")


def share(whole: Sequence[T], of: int) -> list[T]:
    """All of it, or every ``of``-th, from the first on."""
    return list(whole if LONG else whole[::of])
