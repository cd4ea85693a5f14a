"""Glossy reflection: mirrored directions are jittered by the lobe of their material."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.appearance.lobes import Lobe
from course.core.types import Floats32, Indices, Materials
from course.transport.paths import Draws


@dataclass(frozen=True)
class Blur:
    """Jitters the mirrored directions of one bounce.

    Attributes
    ----------
    lobes : of the glossy materials, and of rough glass
    dimension : the first dimension of this bounce's gloss
    keeps : whether directions into the surface are kept
    lets_out : whether rough glass lets all light out that is inside: no later bounce can
    """

    lobes: tuple[Lobe, ...]
    dimension: int
    draws: Draws
    keeps: bool = False
    lets_out: bool = False

    def __call__(
        self, material: Materials, mirrored: Floats32, ng: Floats32, path: Indices
    ) -> Floats32:
        """Directions (3, n) of reflected rays, those of glossy materials jittered; above the surface, unless ``keeps``.

        Parameters
        ----------
        material : (n,) of the surface that reflects
        mirrored, ng : (3, n), the mirrored directions (may be overwritten) and the geometric normals
        path : (n,)
        """
        for lobe in self.lobes:
            if lobe.width == 0:
                continue
            which = np.flatnonzero(material == lobe.material)
            if len(which) == 0:
                continue
            u = self.draws("gloss", self.dimension, lobe.width, path.take(which))
            if len(which) == len(material):
                return lobe.keep_above(lobe.jitter(mirrored, lobe.parameter, u), ng)
            scattered = lobe.jitter(mirrored.take(which, axis=1), lobe.parameter, u)
            mirrored[:, which] = lobe.keep_above(scattered, ng.take(which, axis=1))
        return mirrored
