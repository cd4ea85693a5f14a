"""Functions of one module of the course, called by their own names: ``glossy.keep_above``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any


class Functions:
    """Some functions of a module, by name."""

    def __init__(self, functions: Mapping[str, Callable[..., Any]]) -> None:
        self.__dict__.update(functions)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Raise AttributeError: a function that was not bound would be missing from the receipt."""
        raise AttributeError(f"{name} is called, but was not bound")
