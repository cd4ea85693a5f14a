"""Modules of the course that say all of themselves in one file here: a new one touches no list.

A file is called as its module. It has

- ``AFTER``: the module that it is taught after, of ``course.engine.functions.modules``;
- ``FUNCTIONS``: names of its functions, in the order in which they are checked and shown;
- ``CONTRACTS``: of those that the renderer calls, by their names, as ``course.engine.functions.signatures`` has them;
- ``stand_ins()``: of these what stands in for them and what a picture then looks like, as ``stand_ins.py`` has them. A
  function, for command lines read names without NumPy.

The last two may be left out where the renderer calls none of them.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def further() -> dict[str, Any]:
    """The files by the names of their modules, in alphabetical order."""
    names = sorted(file.stem for file in Path(__file__).parent.glob("[!_]*.py"))
    return {name: import_module(f"{__name__}.{name}") for name in names}


def with_further(listed: dict[str, tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
    """Modules and their functions, with each module of this folder behind the one that it is taught after."""
    order = list(listed)
    found = further()
    for name, module in found.items():
        # What is taught after a core module comes first of the others.
        place = order.index(module.AFTER) + 1 if module.AFTER in order else 0
        order.insert(place, name)
    return {name: listed.get(name) or tuple(found[name].FUNCTIONS.split()) for name in order}


def further_contracts() -> dict[str, str]:
    """Contracts by "module.function"."""
    found = further().items()
    said = [(name, getattr(module, "CONTRACTS", {})) for name, module in found]
    return {f"{name}.{each}": text for name, texts in said for each, text in texts.items()}


def further_stand_ins() -> dict[str, tuple[Callable[..., Any], str]]:
    """Stand-ins by "module.function"."""
    found = further().items()
    said = [(name, module.stand_ins()) for name, module in found if hasattr(module, "stand_ins")]
    return {f"{name}.{each}": stand for name, stands in said for each, stand in stands.items()}
