"""Modules in the order in which they are taught: the warm-up, then the order of the course."""

from course.engine.functions.modules import TAUGHT

_PLACES = {name: place for place, name in enumerate(TAUGHT)}


def place(module: str) -> int:
    """Of a module among all; what is none of them comes last."""
    return _PLACES.get(module, len(_PLACES))
