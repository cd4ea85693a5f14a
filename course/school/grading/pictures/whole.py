"""The last check: one picture for which all of a student's own functions work together."""

from collections.abc import Callable, Mapping, Set
from typing import Any

import numpy as np

from course.engine.functions.modules import MODULES
from course.school.grading.checks.check import Array, Caller, Check, ModuleChecks, Trial
from course.school.grading.errors import StudentError
from course.school.grading.looked import Looked
from course.school.grading.pictures import scenes
from course.school.grading.pictures.judging import check_ssim
from course.school.grading.pictures.rendered import Find, loaded, rendered
from course.school.grading.pictures.stage import usable

NAME = "whole"


class Together:
    """A ``Caller`` of all modules; functions are called "MODULE.NAME".

    Parameters
    ----------
    callers : by module
    hung : functions that have run out of time by themselves, and aren't called again
    """

    def __init__(self, callers: Mapping[str, Caller], hung: Set[str] = frozenset()) -> None:
        self._callers, self._hung = callers, hung

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value."""
        caller, name = self._found(function)
        return caller.call(name, *arguments, **named)

    def call_and_look(self, function: str, *arguments: Any) -> Looked:
        """As a single module's caller does."""
        caller, name = self._found(function)
        return caller.call_and_look(name, *arguments)

    def _found(self, function: str) -> tuple[Caller, str]:
        if function in self._hung:
            raise StudentError("timeout", f"{function} ran out of time in its own checks")
        module, _, name = function.partition(".")
        return self._callers[module], name


def _all_of(caller: Caller) -> Find:
    """Every function is one caller's."""

    def find(module: str, name: str) -> Callable[..., Any]:
        path = f"{module}.{name}"
        return lambda *arguments: usable(path, caller.call(path, *arguments))

    return find


def _prepare(caller: Caller, rng: np.random.Generator) -> dict[str, Array]:
    return {"picture": rendered(loaded(scenes.everything(rng), _all_of(caller), rng))}


def _run(trial: Trial) -> None:
    yours = rendered(loaded(scenes.everything(trial.rng), _all_of(trial.caller), trial.rng))
    expected = trial.references["picture"]
    trial.show("pictures", "All effects at once", yours=yours, expected=expected)
    check_ssim(yours, expected, f"{NAME}.scene/picture")


WHOLE = ModuleChecks(
    NAME,
    (
        Check(
            "scene",
            "picture",
            "A picture with all of your functions looks like the reference",
            _run,
            kind="whole",
            points=3,
            prepare=_prepare,
        ),
    ),
)
"""Needs all of the modules in ``ALL``."""

ALL = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
assert set(ALL) <= set(MODULES)
