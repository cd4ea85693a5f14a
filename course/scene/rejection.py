"""Points by rejection, in a renderer that counts its numbers: their generator is chosen by the numbers of a path.

Nobody knows how many numbers rejection takes, so a path can't have them drawn for it. It has two, as for other points:
they choose the generator, and so a picture can be repeated, as long as the same paths are followed together.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.core.types import Floats32
from course.scene.description import SceneDescription

BALL, DISK = "ball by rejection", "rejection"
"""What ``samples`` of a spherical light and of a lens say for it."""

_CHOOSING = 64
"""Columns of u that choose the generator; more of them would only take more time."""


def takes_rejection(scene: SceneDescription) -> bool:
    """Whether a light or the lens takes points by rejection."""
    lens = scene.camera.lens
    if lens is not None and lens.shape == "disk" and lens.samples == DISK:
        return True
    return any(getattr(light, "samples", None) == BALL for light in scene.lights)


def by_rejection(function: Callable[[int, Any], Floats32]) -> Callable[[Floats32], Floats32]:
    """Of a function (n, rng) that places n points one that takes numbers u (any, n), as warps do."""

    def points(u: Floats32) -> Floats32:
        from numpy.random import PCG64, Generator, SeedSequence

        words = np.ascontiguousarray(u[:, :_CHOOSING]).view(np.uint32).ravel().tolist()
        return function(u.shape[1], Generator(PCG64(SeedSequence(words))))

    return points
