"""How a scene is to be rendered: everything of the scene file that isn't the world."""

from __future__ import annotations

from dataclasses import dataclass

from course.core import scene as core
from course.formats.pictures.exposure import SRGB, Display


@dataclass(frozen=True)
class Subdivision:
    """Where pixels are divided: ``threshold`` [radiance] between two corners, down to ``depth`` times."""

    threshold: float
    depth: int


@dataclass(frozen=True)
class Settings(core.Settings):
    """How a scene is to be rendered.

    Attributes
    ----------
    error : the root-mean-square error [radiance] at which sampling ends; None samples all pixels alike
    display : how a PNG shows the picture
    subdivision : rays through the corners of cells, which are divided by contrast; None takes samples in pixels
    """

    error: float | None = None
    display: Display = SRGB
    subdivision: Subdivision | None = None
