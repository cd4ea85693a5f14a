"""Rough glass: refracted directions, and those mirrored on its inside, are jittered by the lobe of their material.

The functions of the `blurred_transparency` module are called for hits on rough glass only.

Some rays in rough glass hit the next surface beyond the critical angle. If they were mirrored exactly, they would stay
in a ball for ever, for each reflection hits the surface at the same angle. So reflections are jittered, by the gloss of
the material if it has one, and the rays leave. Rays that are still inside at the last bounce are let out, straight on
if reflection is total, so that no light is lost.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.rays import Draws
from course.engine.core.types import Floats32, Functions, Indices, Mask, Materials
from course.engine.core.vectors import dot
from course.engine.terms.surfaces.hits_on import hits_on

REFRACTION = ("refraction", 2)
"""Name and width of the numbers that one refracted direction takes."""


@dataclass(frozen=True)
class RoughGlass:
    """One rough dielectric.

    Attributes
    ----------
    material : its number
    roughness : as ``jitter_refraction`` wants it, > 0
    glossy : whether its gloss jitters what it mirrors
    blurred_transparency : functions of the module
    """

    material: int
    roughness: float
    glossy: bool
    blurred_transparency: Functions

    def bend(
        self, direction: Floats32, ns: Floats32, cos_i: Floats32, eta: Floats32
    ) -> tuple[Floats32, Floats32, Mask]:
        """Refracted directions (3, n), the share (n,) that is reflected, and (n,) where that is all.

        Parameters
        ----------
        direction, ns : (3, n) of the rays that came in, and the shading normals
        cos_i, eta : (n,)
        """
        bent, total = self.blurred_transparency.refract(direction, ns, eta)
        # Nothing goes through where there is no refracted direction: rounding may see the critical angle otherwise.
        share = np.where(total, 1, self.blurred_transparency.fresnel(cos_i, eta))
        return bent, share, total

    def jitter(self, direction: Floats32, normal: Floats32, u: Floats32) -> Floats32:
        """Scattered directions (3, n), to the side that the normals (3, n) look to."""
        jitter_refraction = self.blurred_transparency.jitter_refraction
        scattered: Floats32 = jitter_refraction(direction, normal, self.roughness, u)
        return scattered


def bend(
    glasses: tuple[RoughGlass, ...],
    material: Materials,
    direction: Floats32,
    ns: Floats32,
    cos_i: Floats32,
    eta: Floats32,
    ends: Mask | None,
    share: Floats32,
) -> Floats32 | None:
    """Refracted directions (3, n) at hits on rough glass, of no meaning elsewhere; None where there are none.

    Parameters
    ----------
    direction, ns, cos_i, eta : see ``RoughGlass.bend``
    ends : (n,) which hits are on the inside, where nothing that they reflect is followed; None where all of it is
    share : (n,) of the light that is reflected; the module's Fresnel reflectance is written into it
    """
    bent = None
    for glass, which in hits_on(glasses, material):
        if bent is None:
            bent = np.zeros((3, len(material)), np.float32)
        arrays = direction.take(which, axis=1), ns.take(which, axis=1)
        bent[:, which], share[which], total = glass.bend(
            *arrays, cos_i.take(which), eta.take(which)
        )
        if ends is not None:
            share[which[ends.take(which)]] = 0
            caught = which[total & ends.take(which)]
            bent[:, caught] = direction.take(caught, axis=1)
    return bent


def scatter(
    glasses: tuple[RoughGlass, ...],
    keeps: bool,
    material: Materials,
    straight: Floats32,
    away: Floats32,
    path: Indices,
    depth: int,
    draws: Draws,
    direction: Floats32,
    glossy: bool = True,
) -> None:
    """Jitter the directions of rays that leave rough glass, to the side that they leave on unless they are kept.

    Parameters
    ----------
    keeps : whether they are kept
    material, path : (n,)
    straight, away : (3, n), the directions without jitter, and the geometric normals on the side that they leave
    direction : (3, n), into which those of rough glass are written
    glossy : whether rough glass that has gloss is among them
    """
    for glass, which in hits_on(glasses, material):
        if glass.glossy and not glossy:
            continue
        u = draws("refraction", path.take(which), depth)
        normal = away.take(which, axis=1)
        through = straight.take(which, axis=1)
        if keeps:
            # Jitter never turns a direction back: seen from where it comes from, all of it is on the other side.
            normal = -through
        else:
            # An interpolated normal may send a ray to the wrong side; mirror it to the right one.
            through -= 2 * np.maximum(dot(through, normal), 0) * normal
        direction[:, which] = glass.jitter(through, normal, u)
