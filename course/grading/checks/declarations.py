"""Where the declarations of the course's functions are found."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from course.grading.checks.declare import Function, Module
from course.modules import COURSE


@cache
def declarations(module: str) -> tuple[Function, ...]:
    """Those of a module's functions; empty for what is no module of the course."""
    if module not in COURSE:
        return ()
    declared: Module = import_module(f"course.grading.modules.{module}").MODULE
    return declared.functions


def declaration(module: str, name: str) -> Function | None:
    """That of one function; None where there is none."""
    return next((function for function in declarations(module) if function.name == name), None)


def declared_function(module: str, name: str) -> Function:
    """That of a function of the course."""
    found = declaration(module, name)
    assert found is not None, f"{module}.{name}"
    return found
