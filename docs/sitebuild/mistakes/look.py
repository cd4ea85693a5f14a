"""One way to look at a function."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from PIL import Image

SIZE = (240, 160)
"""Pixels of a picture, across and down."""

Draw = Callable[[ModuleType, ModuleType], Image.Image]
"""Takes a module with a function that may be wrong, and the right one; the picture may be of any size."""


@dataclass(frozen=True)
class Look:
    """What is drawn with a function, so that mistakes show.

    Attributes
    ----------
    shows : what one sees, a sentence without its full stop
    draw : makes the picture
    names : of the wrong submissions that are looked at in this way; none means those that nobody else names
    renders : whether the engine has a say in it
    files : which it reads
    """

    shows: str
    draw: Draw
    names: tuple[str, ...] = ()
    renders: bool = False
    files: tuple[Path, ...] = ()
