"""Points on lights and lenses by the `sampling` module, in the place of those by `soft_shadows` and `thin_lens`.

Nobody knows how many numbers rejection takes, so a path can't have them drawn for it. It has two, as for other points:
they choose the generator, and so a picture can be repeated, as long as the same paths are followed together.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from course.engine.core.camera import Lens
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats32, Functions

if TYPE_CHECKING:
    from numpy.random import Generator

_CHOOSING = 64
"""Columns of u that choose the generator; more of them would only take more time."""


@dataclass(frozen=True)
class SampledSphereLight(SphereLight):
    """A sphere whose ``samples`` are "sphere by polar", "ball by polar" or "ball by rejection".

    ``sampling`` : functions of the module
    """

    sampling: Functions = field(default_factory=Functions)

    def on_light(self, center: Floats32, points: Floats32, u: Floats32) -> Floats32:
        """See ``SphereLight``."""
        match self.samples:
            case "sphere by polar":
                unit = self.sampling.sphere_by_polar(u)
            case "ball by polar":
                unit = self.sampling.ball_by_polar(u)
            case _:
                unit = self.sampling.ball_by_rejection(u.shape[1], generator_of(u))
        moved: Floats32 = np.float32(self.radius) * unit
        moved += center[:, None]
        return moved


@dataclass(frozen=True)
class SampledLens(Lens):
    """A round aperture with points by polar coordinates or by rejection; ``sampling`` : functions of the module."""

    sampling: Functions = field(default_factory=Functions)
    rejects: bool = False

    def points(self, u: Floats32) -> Floats32:
        """See ``Lens``."""
        on_disk: Floats32
        if self.rejects:
            on_disk = self.sampling.disk_by_rejection(u.shape[1], generator_of(u))
        else:
            on_disk = self.sampling.disk_by_polar(u)
        return on_disk


def generator_of(u: Floats32) -> Generator:
    """The generator that numbers (any, n) choose."""
    from numpy.random import PCG64, Generator, SeedSequence

    words = np.ascontiguousarray(u[:, :_CHOOSING]).view(np.uint32).ravel().tolist()
    return Generator(PCG64(SeedSequence(words)))
