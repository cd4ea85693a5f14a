"""Shadow rays that leave out the lamp that they lead to, where it is the only one.

A spherical lamp that is seen has a mesh of thousands of triangles, and each of its shadow rays ends just before them:
on the way down the hierarchy it meets most of the boxes around its end. But the mesh lies inside the sphere, and light
comes from where the sphere faces the point, so the mesh can't block it. A hierarchy of the other triangles answers in
a fifth to a half of the time.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from course.engine.core.accelerator import Accelerator, StaticAccelerator
from course.engine.core.lights.sample import TO_A_SURFACE, Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.motion import MovingAccelerator
from course.engine.core.types import Indices, Mask
from course.engine.functions.own import courses_own
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.surfaces.surface import FullSurface

MOST = 200_000
"""Triangles beside the lamp, at most: a second hierarchy of more would take long to build, and memory."""


class LampAccelerator(StaticAccelerator):
    """Triangles of which some are the mesh of the only lamp.

    ``others``: the triangles that may block the lamp's light; ``kept``: their numbers among all
    """

    def __init__(self, whole: StaticAccelerator, of_lamp: Mask) -> None:
        super().__init__(whole.vertices, whole.triangles, whole.make)
        self.kept: Indices = np.flatnonzero(~of_lamp)
        self.others = StaticAccelerator(whole.vertices, whole.triangles[~of_lamp], whole.make)

    def unoccluded(self, *rays: Any, **options: Any) -> Mask:
        """See ``StaticAccelerator``; for shadow rays to the lamp."""
        return self.others.unoccluded(*rays, **options)


def without_own_lamp(surface: FullSurface, first_lamp: int, lights: Sequence[Light]) -> Accelerator:
    """The surface's accelerator, with shadow rays that leave the only lamp out if it is a sphere at rest.

    Parameters
    ----------
    first_lamp : materials from this number on are those of lamps
    lights : all that shadow rays lead to
    """
    accelerator = surface.accelerator
    static = accelerator.static if isinstance(accelerator, MovingAccelerator) else accelerator
    if type(static) is not StaticAccelerator or len(lights) != 1 or not _spares(lights[0]):
        return accelerator
    mine = surface.triangles.material[: len(static.triangles)] >= first_lamp
    if not 0 < np.count_nonzero(~mine) <= MOST or not mine.any():
        return accelerator
    lamp = LampAccelerator(static, mine)
    if isinstance(accelerator, MovingAccelerator):
        return replace(accelerator, static=lamp)
    return lamp


def _spares(light: Light) -> bool:
    """Whether light comes only from where the sphere faces the point; a student's points may lie anywhere."""
    if light.velocity is not None or light.limit != TO_A_SURFACE:
        return False
    if isinstance(light, VisibleSphereLight):
        return True
    return type(light) is SphereLight and courses_own(light.soft_shadows.point_on_sphere)
