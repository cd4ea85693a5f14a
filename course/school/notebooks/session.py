"""What a running notebook holds: the cells that were run, and the functions of the course that they define."""

import ast
import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from inspect import getsource
from types import FunctionType
from typing import Any

from course.engine.functions.effects import written_in
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.name_effects import is_builtin, scopes
from course.engine.functions.notebook.needed import Place
from course.engine.functions.notebook.reading import gathered

MODULE_OF = {name: module for module, names in COURSE.items() for name in names}
"""Of each function; no two have one name."""


@dataclass(frozen=True)
class RunCell:
    """A cell as it was run last.

    Attributes
    ----------
    number : that the notebook shows, as in In[5]
    key : which cell it is; None where the notebook doesn't say
    text : with its magics
    failed : whether it raised an error
    """

    number: int
    key: str | None
    text: str
    failed: bool = False

    @property
    def names(self) -> frozenset[str]:
        """All that it defines or imports."""
        return self._scopes[0]

    @property
    def reads(self) -> frozenset[str]:
        """All names that it uses."""
        return self._scopes[1]

    @cached_property
    def _scopes(self) -> tuple[frozenset[str], frozenset[str]]:
        return _scopes(self.text)

    def again(self, before: "RunCell") -> bool:
        """Whether it is that cell, run once more: where the notebook doesn't say, if it binds what the other did."""
        if self.key and before.key:
            return self.key == before.key
        common = self.names & before.names
        if common & MODULE_OF.keys() and (before.failed or before.names <= self.names):
            return True
        return bool(common) and before.names == self.names


@dataclass(frozen=True)
class SessionModule:
    """What the cells that were run make of a module.

    Attributes
    ----------
    text : as a program; empty where none of its functions is defined
    places : number of the cell, and line in it, for each line of the text
    lacking : names that it uses and no cell defines
    rebound : names that it uses and several cells bind, with the numbers of these; the last one counts
    """

    text: bytes
    places: tuple[Place, ...]
    lacking: tuple[str, ...]
    rebound: tuple[tuple[str, tuple[int, ...]], ...] = ()

    def place(self, line: int) -> str:
        """A line of the text, as a message has it."""
        if not self.places:
            return f"line {line}"
        number, own = self.places[min(line, len(self.places)) - 1]
        return f"cell In[{number}], line {own}"


class Session:
    """The cells that a shell has run, in that order; of one that was run again the last time counts, in its old place.

    Attributes
    ----------
    cells : in an order in which they make what the notebook holds
    number : of the cell that was begun last; 0 before any
    """

    def __init__(self, shell: Any) -> None:
        # Cells before the extension was loaded, with the one that loads it.
        texts = shell.history_manager.input_hist_raw[1:]
        self.cells = [
            RunCell(number, None, text)
            for number, text in enumerate(texts, 1)
            # Nobody knew that magic yet, so what is below it has not run.
            if not text.lstrip().startswith("%%check")
        ]
        self.number = len(self.cells) and self.cells[-1].number
        self._shell = shell
        shell.events.register("pre_run_cell", self._begun)
        shell.events.register("post_run_cell", self._ended)

    def close(self) -> None:
        """Listen no longer."""
        self._shell.events.unregister("pre_run_cell", self._begun)
        self._shell.events.unregister("post_run_cell", self._ended)

    def _begun(self, info: Any) -> None:
        if not info.store_history or info.silent:
            return
        # Before or after this event, as its version has it, IPython counts; what it keeps of a cell comes later in all.
        self.number = len(self._shell.history_manager.input_hist_raw)
        cell = RunCell(self.number, getattr(info, "cell_id", None), info.raw_cell)
        same = [cell.again(one) for one in self.cells]
        others = [one for one, again in zip(self.cells, same, strict=True) if not again]
        # It stays where others find its names when they are run, unless these bind what it binds or uses.
        place = same.index(True) if any(same) else len(others)
        if any((cell.names | cell.reads) & one.names for one in others[place:]):
            place = len(others)
        self.cells = [*others[:place], cell, *others[place:]]

    def _ended(self, result: Any) -> None:
        if not result.success:
            self.cells = [
                replace(one, failed=True) if one.number == self.number else one
                for one in self.cells
            ]

    def module(self, module: str) -> SessionModule:
        """What the cells make of a module, as it would be graded if the notebook had them in this order."""
        # Imported late, with IPython.
        from course.engine.functions.notebook.cells import read_cells

        cells = [{"cell_type": "code", "source": cell.text} for cell in self.cells]
        code = read_cells(json.dumps({"cells": cells}).encode())
        for one in code.statements:
            one.cell = self.cells[one.cell - 1].number
        made = gathered(code, (module,))
        if module not in made.sources:
            return SessionModule(b"", (), ())
        text = made.sources[module]
        binds, reads, _ = scopes(text.decode())
        lacking = sorted(n for n in reads - binds if not is_builtin(n) and not n.startswith("__"))
        rebound = tuple((name, tuple(cell for cell, _ in of)) for name, of in made.rebound[module])
        return SessionModule(text, tuple(made.places[module]), tuple(lacking), rebound)


def functions_in(text: str) -> frozenset[str]:
    """Functions of the course that a cell defines, by ``def`` or by any other binding."""
    return bound_in(text) & MODULE_OF.keys()


def bound_in(text: str) -> frozenset[str]:
    """All names that a cell defines or imports."""
    return _scopes(text)[0]


def _scopes(text: str) -> tuple[frozenset[str], frozenset[str]]:
    """All names that a cell binds, and all that it uses."""
    cells = [{"cell_type": "code", "source": text}]
    # Imported late, with IPython.
    from course.engine.functions.notebook.cells import read_cells

    found = read_cells(json.dumps({"cells": cells}).encode()).statements
    text = ast.unparse(ast.Module([one.node for one in found], []))
    binds, reads, _ = scopes(text)
    return frozenset(binds), frozenset(reads)


class Mine(Mapping[str, Callable[..., Any]]):
    """The functions of the course that a notebook has defined and written, as they are now; for ``load_scene``.

    The others are the course's own, whatever files lie beside the notebook.

    ``names``: of the notebook
    """

    others = "solutions"
    """Whose the others are; see ``GivenEffects``."""

    def __init__(self, names: Mapping[str, Any]) -> None:
        self._names = names

    def __iter__(self) -> Iterator[str]:
        return (name for name in MODULE_OF if self._written(name))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __getitem__(self, name: str) -> Callable[..., Any]:
        if not self._written(name):
            raise KeyError(name)
        function: Callable[..., Any] = self._names[name]
        return function

    def _written(self, name: str) -> bool:
        found = self._names.get(name) if name in MODULE_OF else None
        if not isinstance(found, FunctionType):
            return callable(found)
        try:
            return name in written_in(getsource(found), MODULE_OF[name])
        except (OSError, TypeError):
            # Not of a cell, so it is no stub.
            return True

    def __repr__(self) -> str:
        return f"<functions of this notebook: {', '.join(self) or 'none is written'}>"
