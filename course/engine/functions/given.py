"""Functions that are given one by one, such as those of a notebook's cells, in the place of a folder's."""

from collections.abc import Callable, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from course.base.errors import EffectError
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE

Given = Mapping[str, Callable[..., Any]]
"""Functions by their names, "point_on_sphere" or "soft_shadows.point_on_sphere"."""


class GivenEffects(Effects):
    """Some functions of one's own; the others are those of ``Effects()``, or what ``functions.others`` names.

    Raises EffectError: the course has no function of a name, or what is given can't be called.
    """

    def __init__(self, functions: Given) -> None:
        others = PROJECT / getattr(functions, "others", "")
        # A student's copy has no solutions; there what isn't given has a stand-in.
        rest = Effects(others if others != PROJECT and others.is_dir() else None)
        super().__init__(rest.folder, trusted=False)
        self._rest = rest
        self._given = {_place(name): function for name, function in functions.items()}
        for (module, name), function in self._given.items():
            if not callable(function):
                raise EffectError(f"effects: {module}.{name} is {function!r}; expected a function")

    def written(self, module: str, name: str) -> bool:
        """See ``Effects``."""
        assert self._rest is not None
        # In a folder of one's own the others are one's own, too.
        return (module, name) in self._given or (
            self._rest.mixed and self._rest.written(module, name)
        )

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """See ``Effects``."""
        given = self._given.get((module, name))
        if given is None:
            assert self._rest is not None
            return self._rest.function(module, name)
        if (module, name) not in self._functions:
            from course.engine.functions.guard import guarded

            code = getattr(given, "__code__", None)
            file = Path(code.co_filename if code else f"{module}.py")
            self._functions[module, name] = guarded(f"{module}.{name}", given, file)
        return self._functions[module, name]


def _place(given: str) -> tuple[str, str]:
    """Module and name of a function."""
    module, _, name = given.rpartition(".")
    for each in COURSE:
        if name in COURSE[each] and module in ("", each):
            return each, name
    names = [other for each in COURSE for other in COURSE[each]]
    near = get_close_matches(name, names, 1)
    hint = f"; do you mean {near[0]}?" if near else ""
    raise EffectError(f"effects: the course has no function {given}{hint}")
