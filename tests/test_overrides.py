"""No class overrides what is private to a class of another room: rooms hand each other parts, and stay free inside."""

import importlib
import json
import pkgutil
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import course
from tests.processes import python

TESTS = Path(__file__).parent


def modules() -> Iterator[ModuleType]:
    """All modules of the package, but for loops and what needs an extra that isn't installed."""
    for found in pkgutil.walk_packages(course.__path__, "course."):
        if found.name.endswith(("_kernels", "__main__")):
            continue
        try:
            yield importlib.import_module(found.name)
        except ModuleNotFoundError as error:
            if str(error.name).startswith("course"):
                raise


def room(kind: type) -> str:
    """The rooms of wings, and wings that have none: "engine.core", "cli"."""
    parts = kind.__module__.split(".")[1:]
    return ".".join(parts[: 2 if parts[0] in {"engine", "school"} else 1])


def overridden(kinds: list[type]) -> list[str]:
    """Private methods that classes override across rooms."""
    found = []
    for kind in kinds:
        for base in kind.__mro__[1:]:
            if not base.__module__.startswith("course.") or room(base) == room(kind):
                continue
            for name in vars(kind).keys() & vars(base).keys():
                private = name.startswith("_") and not name.startswith("__") and name != "_abc_impl"
                if private and callable(vars(kind)[name]):
                    found.append(f"{kind.__qualname__}.{name} over {base.__qualname__}'s")
    return found


def told() -> str:
    """How many classes there are, and what they override."""
    kinds = [
        kind
        for module in modules()
        for kind in vars(module).values()
        if isinstance(kind, type) and kind.__module__ == module.__name__
    ]
    return json.dumps((len(kinds), overridden(kinds)))


def test_nothing_private_is_overridden_across_rooms() -> None:
    """In a process of its own: what it imports would change what other tests take."""
    done = python("-c", "from tests.test_overrides import told; print(told())", path=TESTS.parent)
    number, found = json.loads(done.stdout)
    assert number > 300
    assert found == []


def test_such_an_override_is_found() -> None:
    class Base:
        def _inner(self) -> None: ...

        def open(self) -> None: ...

    class Other(Base):
        def _inner(self) -> None: ...

        def open(self) -> None: ...

    Base.__module__, Other.__module__ = "course.engine.core.one", "course.engine.terms.other"
    (told,) = overridden([Base, Other])
    assert "Other._inner over" in told
    Other.__module__ = "course.engine.core.other"
    assert overridden([Base, Other]) == []
