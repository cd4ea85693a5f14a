"""Rough glass: refracted directions, and those mirrored on its inside, are jittered by the lobe of their material.

The functions of the `blurred_transparency` module answer for hits on rough glass, and for no others.

Rough glass sends some rays beyond the critical angle of the next surface. Were they mirrored as they are, a ball would
keep them for ever, for each mirror image meets the surface at the same angle. Jittered, by their gloss where they have
some, they get out. What is still inside at the last bounce is let out, straight on where reflection is total, so that
no light is lost.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from course.appearance.lobes import Lobe
from course.appearance.rough_glass import RoughGlass
from course.core.types import Floats32, Indices, Mask, Materials
from course.core.vectors import dot
from course.transport.gloss import Blur
from course.transport.plan import Plan

WIDTH = 2
"""Numbers that one refracted direction takes."""


def bend(
    lobes: tuple[Lobe, ...],
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
    direction, ns : (3, n) of the rays that came in, and the shading normals
    cos_i, eta : (n,)
    ends : (n,) which hits are on the inside, where nothing that they reflect is followed; None where all of it is
    share : (n,) of the light that is reflected; the module's Fresnel reflectance is written into it
    """
    bent = None
    for glass, which in _hits_on(lobes, material):
        if bent is None:
            bent = np.zeros((3, len(material)), np.float32)
        ratio = eta.take(which)
        bent[:, which], total = glass.refract(
            direction.take(which, axis=1), ns.take(which, axis=1), ratio
        )
        # Nothing goes through where there is no refracted direction: rounding may see the critical angle otherwise.
        share[which] = np.where(total, 1, glass.fresnel(cos_i.take(which), ratio))
        if ends is not None:
            share[which[ends.take(which)]] = 0
            caught = which[total & ends.take(which)]
            bent[:, caught] = direction.take(caught, axis=1)
    return bent


def scatter(
    plan: Plan,
    blur: Blur,
    material: Materials,
    straight: Floats32,
    away: Floats32,
    path: Indices,
    direction: Floats32,
    glossy: bool = True,
) -> None:
    """Jitter the directions of rays that leave rough glass, to the side that they leave on unless they are kept.

    Parameters
    ----------
    material, path : (n,)
    straight, away : (3, n), the directions without jitter, and the geometric normals on the side that they leave
    direction : (3, n), into which those of rough glass are written
    glossy : whether rough glass that has gloss is among them
    """
    assert plan.refraction_dimension is not None
    # As far into this depth's dimensions as the gloss is.
    dimension = plan.refraction_dimension + blur.dimension - plan.gloss_dimension
    for glass, which in _hits_on(blur.lobes, material):
        if glass.width and not glossy:
            continue
        u = blur.draws("refraction", dimension, WIDTH, path.take(which))
        normal = away.take(which, axis=1)
        through = straight.take(which, axis=1)
        if blur.keeps:
            # Jitter never turns a direction back: seen from where it comes from, all of it is on the other side.
            normal = -through
        else:
            # An interpolated normal may send a ray to the wrong side; mirror it to the right one.
            through -= 2 * np.maximum(dot(through, normal), 0) * normal
        direction[:, which] = glass.jitter_refraction(through, normal, glass.roughness, u)


def _hits_on(lobes: tuple[Lobe, ...], material: Materials) -> Iterator[tuple[RoughGlass, Indices]]:
    """Each rough glass that is hit, and the hits on it."""
    for lobe in lobes:
        if isinstance(lobe, RoughGlass):
            which = np.flatnonzero(material == lobe.material)
            if len(which):
                yield lobe, which
