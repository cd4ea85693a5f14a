"""What the checks say of one's functions, and which of them are checked next.

Those of a file that was saved come first, and pictures wait for them. Then come those that the scene calls, and the
rest once nothing is left to render.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from time import monotonic
from typing import Any

from course.engine.functions.modules import COURSE
from course.engine.functions.sources import find_module, named
from course.school.grading.progress import FunctionProgress, next_one
from course.school.studio.checker import Checker

CHECKS_WAIT = 4.0
"""Seconds after which checks of the scene's functions no longer wait for the first picture."""

PICTURES_WAIT = 6.0
"""Seconds after a save after which pictures no longer wait for the checks."""


class Verdicts:
    """Checks modules in the background, and knows what was found.

    Parameters
    ----------
    folder : of the functions
    module : whose functions come first; None for those that the scene calls
    event : see ``Checker``
    changed : called when something is to be told anew

    Attributes
    ----------
    needs : the functions that the scene calls, "module.function"
    functions : module -> what the checks have said of it
    """

    def __init__(
        self,
        folder: Path,
        module: str | None,
        event: Callable[[dict[str, Any]], None],
        changed: Callable[[], None],
    ) -> None:
        self.folder, self.module, self._changed = folder, module, changed
        self.needs: list[str] = []
        self.functions: dict[str, dict[str, Any]] = {}
        self._waiting: list[str] = list(COURSE)
        self._running: list[str] = []
        self._saved: set[str] = set()
        self._checking = ""
        self._since = self._saved_at = monotonic()
        self._checker = Checker(folder, event)

    @property
    def here(self) -> set[str]:
        """Modules whose functions the scene calls, and that which was asked for."""
        called = {need.partition(".")[0] for need in self.needs}
        return called | ({self.module} if self.module else set())

    @property
    def first(self) -> bool:
        """Whether pictures wait: a file was saved, and what the scene calls of it isn't checked yet."""
        return bool(self._saved & self.here) and monotonic() - self._saved_at < PICTURES_WAIT

    def close(self) -> None:
        """End what is being checked."""
        self._checker.close()

    # ---------------------------------------------------------------- what is checked next

    def know(self, needs: list[str]) -> None:
        """These are the functions that the scene calls."""
        self.needs = needs

    def check(self, modules: Sequence[str]) -> None:
        """Have the modules of saved files checked at once, whatever is being checked."""
        for each in modules:
            self.functions.pop(each, None)
        if self._running:
            # It may have read the files as they were.
            self._checker.stop()
        self._checking = ""
        again = [*modules, *self._running, *self._waiting]
        self._waiting, self._running = list(dict.fromkeys(again)), []
        self._saved |= set(modules)
        self._since = self._saved_at = monotonic()
        self._changed()

    def soon(self) -> None:
        """There is a picture: checks needn't wait for one."""
        self._since = min(self._since, monotonic() - CHECKS_WAIT)

    def start(self, idle: bool) -> None:
        """Begin with what is to be checked next; ``idle`` where nothing is rendered."""
        if self._running or not self._waiting:
            return
        here, late = self.here, monotonic() - self._since > CHECKS_WAIT
        saved = [each for each in self._waiting if each in self._saved]
        called = [each for each in self._waiting if each in here]
        batch = saved or (called if late else []) or (self._waiting if idle and late else [])
        if batch:
            self._running = sorted(batch, key=lambda each: (each != self.module, each not in here))
            self._waiting = [each for each in self._waiting if each not in batch]
            self._checker.check(self._running, self.needs, nice=not saved)

    def on_check(self, told: dict[str, Any]) -> None:
        """Take what the checker says."""
        if told.pop("run") != self._checker.run:
            return
        if "checking" in told:
            self._checking = told["checking"]
        elif "part" in told:
            self.functions[told["module"]] = told
            self._saved.discard(told["module"])
        elif "module" in told:
            self.functions[told["module"]] = told
            self._saved.discard(told["module"])
            self._checking = ""
            if told["module"] in self._running:
                self._running.remove(told["module"])
        else:
            for module in self._running:
                self.functions[module] = {"trouble": "The checks ended before they came to it."}
            self._saved -= set(self._running)
            self._checking, self._running = "", []
            self._checker.prepare()
        self._changed()

    # ---------------------------------------------------------------- what is known

    def is_right(self, function: str) -> bool:
        """Whether "module.function" has passed all checks."""
        module, _, name = function.partition(".")
        known = self.functions.get(module, {}).get("functions", ())
        return any(each["name"] == name and each["state"] == "right" for each in known)

    def told(self) -> dict[str, Any]:
        """The modules with their functions, for the page."""
        here, waiting = self.here, {*self._waiting, *self._running}
        every: list[FunctionProgress] = []
        modules = []
        for module in sorted(COURSE, key=lambda each: (each != self.module, each not in here)):
            known = self.functions.get(module, {})
            found = known.get("functions", [])
            every += [FunctionProgress(**each) for each in found]
            checking = module == self._checking or (
                module in here and module in waiting and (not found or "part" in known)
            )
            left = "checking" if checking else "not checked yet"
            by_name = {each["name"]: each for each in found}
            modules.append(
                {
                    "name": module,
                    "here": module in here,
                    "checking": checking,
                    "trouble": known.get("trouble") or (self._hint(module, module in here)),
                    "functions": [
                        by_name.get(name) or _unknown(module, name, left) for name in COURSE[module]
                    ],
                }
            )
        coming = self._coming(every)
        return {
            "modules": modules,
            "needs": self.needs,
            "waiting": len(waiting),
            "points": sum(one.points for one in every),
            "of": sum(10 * len(names) for names in COURSE.values()),
            "next": None if coming is None else f"{coming.module}.{coming.name}",
            "where": None if coming is None else coming.place,
            "page": None if coming is None else coming.page,
        }

    def _coming(self, every: Iterable[FunctionProgress]) -> FunctionProgress | None:
        """What to write next: what this scene calls, then its modules' rest, then anything."""
        every = list(every)
        called = [one for one in every if f"{one.module}.{one.name}" in self.needs]
        asked = [one for one in every if one.module == self.module]
        near = [one for one in every if one.module in self.here]
        found = (next_one(some) for some in (asked, called, near, every))
        return next(filter(None, found), None)

    def _hint(self, module: str, here: bool) -> str:
        """What is said of a module whose file was deleted or renamed, or of which the picture shows nothing."""
        if not here:
            return ""
        if find_module(self.folder, module) is None:
            return f"There is no {named(self.folder, module)}: none of it is yours."
        if self.needs and not any(need.startswith(f"{module}.") for need in self.needs):
            return (
                "This picture calls none of them: what the checks say is all there is of them here."
            )
        return ""


def _unknown(module: str, name: str, state: str) -> dict[str, Any]:
    return {"module": module, "name": name, "state": state, "points": 0, "of": 10}
