"""Refraction by rough glass: refracted directions are jittered by the lobe of their material.

The functions of the `blurred_transparency` module answer for hits on rough glass, and for no others.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from course.appearance.lobes import Lobe
from course.appearance.rough_glass import RoughGlass
from course.core.types import Floats32, Indices, Materials
from course.core.vectors import dot
from course.transport.gloss import Blur

WIDTH = 2
"""Numbers that one refracted direction takes."""


def bend(
    lobes: tuple[Lobe, ...],
    material: Materials,
    direction: Floats32,
    ns: Floats32,
    cos_i: Floats32,
    eta: Floats32,
    share: Floats32,
) -> Floats32 | None:
    """Refracted directions (3, n) at hits on rough glass, of no meaning elsewhere; None where there are none.

    Parameters
    ----------
    direction, ns : (3, n) of the rays that came in, and the shading normals
    cos_i, eta : (n,)
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
    return bent


def scatter(
    blur: Blur,
    dimension: int,
    material: Materials,
    bent: Floats32,
    ng: Floats32,
    path: Indices,
    direction: Floats32,
) -> None:
    """Jitter the directions of rays that go on through rough glass, to the far side unless they are kept.

    Parameters
    ----------
    dimension : the first dimension of this bounce's refraction
    material, path : (n,)
    bent, ng : (3, n), the refracted directions and the geometric normals on the incoming side
    direction : (3, n), into which those of rough glass are written
    """
    for glass, which in _hits_on(blur.lobes, material):
        u = blur.draws("refraction", dimension, WIDTH, path.take(which))
        normal = ng.take(which, axis=1)
        through = bent.take(which, axis=1)
        if blur.keeps:
            # Jitter never turns a direction back: seen from where it comes from, all of it is on the far side.
            normal = -through
        else:
            # An interpolated normal may refract a ray back to where it came from; mirror it to the far side.
            through -= 2 * np.maximum(dot(through, normal), 0) * normal
        direction[:, which] = glass.jitter_refraction(through, normal, glass.roughness, u)


def _hits_on(lobes: tuple[Lobe, ...], material: Materials) -> Iterator[tuple[RoughGlass, Indices]]:
    """Each rough glass that is hit, and the hits on it."""
    for lobe in lobes:
        if isinstance(lobe, RoughGlass):
            which = np.flatnonzero(material == lobe.material)
            if len(which):
                yield lobe, which
