"""Glossy reflection: mirrored directions are jittered within the lobe of their material."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.rays import Draws
from course.engine.core.types import Floats32, Functions, Indices, Materials


@dataclass(frozen=True)
class Lobe:
    """The lobe of one glossy material around the mirrored direction.

    Attributes
    ----------
    material : its number
    kind, parameter : "plane" and roughness, "ball" and glossiness, or "phong" and exponent
    """

    material: int
    kind: str
    parameter: float
    glossy: Functions

    @property
    def width(self) -> int:
        """Random numbers per direction."""
        return 3 if self.kind == "ball" else 2

    def jitter(self, direction: Floats32, u: Floats32) -> Floats32:
        """Jitter mirrored directions (3, N) by u (width, N); the results have unit length."""
        scattered: Floats32
        match self.kind:
            case "plane":
                scattered = self.glossy.jitter_on_plane(direction, self.parameter, u)
            case "ball":
                scattered = self.glossy.jitter_in_ball(direction, self.parameter, u)
            case _:
                scattered = self.glossy.sample_phong_lobe(direction, self.parameter, u)
        return scattered

    def keep_above(self, direction: Floats32, ng: Floats32) -> Floats32:
        """Change directions (3, N) that point into the surface, so that they leave it; ng (3, N): geometric normals."""
        kept: Floats32 = self.glossy.keep_above(direction, ng)
        return kept


@dataclass(frozen=True)
class Gloss:
    """The lobes of all glossy materials."""

    lobes: tuple[Lobe, ...]

    def __call__(
        self,
        material: Materials,
        mirrored: Floats32,
        ng: Floats32,
        path: Indices,
        depth: int,
        draws: Draws,
    ) -> Floats32:
        """Reflected directions (3, n) of paths (n,), jittered where ``material`` (n,) is glossy.

        Mirrored directions (3, n) may be overwritten; ng (3, n) are the geometric normals.
        """
        for lobe in self.lobes:
            which = np.flatnonzero(material == lobe.material)
            if len(which) == 0:
                continue
            u = draws("gloss", path.take(which), depth, lobe.width)
            if len(which) == len(material):
                return lobe.keep_above(lobe.jitter(mirrored, u), ng)
            scattered = lobe.jitter(mirrored.take(which, axis=1), u)
            mirrored[:, which] = lobe.keep_above(scattered, ng.take(which, axis=1))
        return mirrored
