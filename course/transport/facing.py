"""Which hits face a light and are faced by it: the others cast no shadow rays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from course.appearance.lights import Sample
from course.core.types import Floats32, Indices, Mask
from course.core.vectors import dot
from course.geometry.hits import Hits

NEARLY_ALL = 0.5
"""The share of the hits from which their arrays are used as they are: copies of those that face the light take longer
than to compute something for the others, too. Medians of pairs, one thread, the whole render without what Embree takes:
.95 with direct light, .96 with gloss, .97 with soft shadows, .98 with path tracing; any share from .2 to .8 will do."""

_Scalar = TypeVar("_Scalar", bound=np.generic)

_ALL_MATERIALS = np.empty((0, 0), np.bool_)


@dataclass(frozen=True)
class Facing:
    """Hits that show a light if nothing is in the way, and arrays of k hits: of these m, or of all n.

    Attributes
    ----------
    lit : (m,) int, the hits that face the light
    which : (m,) int, the hits that the arrays are of; None for all
    asked : (n,) which of all hits are lit, where the arrays are of more than these; else None
    strength : (k,) float32, irradiance without an occluder, in units of the light's colour; 0 where not lit
    cosine : (k,) float32, between the shading normal and the way to the light
    origin : (3, k) float32, where the shadow rays start
    to_light : (3, k) or (3, 1) float32, not normalised
    inverse_length : (k,) or (1,) float32, 1 over its length
    """

    lit: Indices
    which: Indices | None
    asked: Mask | None
    strength: Floats32
    cosine: Floats32
    origin: Floats32
    to_light: Floats32
    inverse_length: Floats32

    def chosen(self, values: NDArray[_Scalar]) -> NDArray[_Scalar]:
        """Those of all hits' values (n,) or (3, n) that belong to the arrays."""
        return values if self.which is None else values.take(self.which, axis=-1)

    def hit(self, place: Indices) -> Indices:
        """The hits at some places of the arrays."""
        return place if self.which is None else self.which.take(place)


def facing(hits: Hits, sample: Sample, shaded: Mask | None) -> Facing | None:
    """The hits that face the light and are faced by it; None if there are none.

    Parameters
    ----------
    shaded : (1 or 2, M) which materials show light, from the back too where there are two rows; None for all
    """
    return (_by_loop if hits.compiled else _by_passes)(hits, sample, shaded)


def _by_passes(hits: Hits, sample: Sample, shaded: Mask | None) -> Facing | None:
    cosine = dot(hits.ns, sample.to_light)
    cosine *= sample.inverse_length
    strength = cosine * sample.factor
    if shaded is not None:
        sides = [row.take(hits.material) for row in shaded]
        strength *= sides[0] if len(sides) == 1 else np.where(hits.entering, *sides)
    asked = strength > 0
    lit = np.flatnonzero(asked)
    if len(lit) == 0:
        return None
    origin, to_light, inverse_length = hits.above, sample.to_light, sample.inverse_length
    if len(lit) == hits.size:
        return Facing(lit, None, None, strength, cosine, origin, to_light, inverse_length)
    # No number is what a NaN leaves behind, and times 0 it would stay.
    if len(lit) >= NEARLY_ALL * hits.size and np.isfinite(strength.min()):
        np.maximum(strength, 0, out=strength)
        return Facing(lit, None, asked, strength, cosine, origin, to_light, inverse_length)
    if to_light.shape[1] > 1:
        to_light, inverse_length = to_light.take(lit, axis=1), inverse_length.take(lit)
    origin = origin.take(lit, axis=1)
    arrays = strength.take(lit), cosine.take(lit), origin, to_light, inverse_length
    return Facing(lit, lit, None, *arrays)


def _by_loop(hits: Hits, sample: Sample, shaded: Mask | None) -> Facing | None:
    """The same light, to the same bits, in two loops; these always gather."""
    from course.transport import direct_kernels

    n = hits.size
    lit = np.empty(n, np.int64)
    strength, cosine = np.empty(n, np.float32), np.empty(n, np.float32)
    to_light, inverse_length = map(np.ascontiguousarray, (sample.to_light, sample.inverse_length))
    found = direct_kernels.facing(
        *map(np.ascontiguousarray, (hits.ns, hits.material, hits.side)),
        *(to_light, inverse_length, np.ascontiguousarray(sample.factor)),
        *(_ALL_MATERIALS if shaded is None else shaded, lit, strength, cosine),
    )
    if found == 0:
        return None
    origin = hits.above
    if found == n:
        return Facing(lit, None, None, strength, cosine, origin, to_light, inverse_length)
    lit, strength, cosine = lit[:found], strength[:found], cosine[:found]
    origin = np.empty((3, found), np.float32)
    there, near = np.empty((3, 0), np.float32), inverse_length[:0]
    if to_light.shape[1] > 1:
        there, near = np.empty((3, found), np.float32), np.empty(found, np.float32)
    direct_kernels.gather(
        lit, np.ascontiguousarray(hits.above), to_light, inverse_length, origin, there, near
    )
    if to_light.shape[1] > 1:
        to_light, inverse_length = there, near
    return Facing(lit, lit, None, strength, cosine, origin, to_light, inverse_length)


def turned(hits: Hits, faced: Facing, to_light: Floats32, most: np.float32) -> Indices:
    """At which places of the arrays lit hits have facets that turn away from the light, (t,).

    Parameters
    ----------
    to_light : (3, k)
    most : the cosine up to which that may be
    """
    if hits.compiled:
        from course.transport import direct_kernels

        found = np.empty(len(faced.lit), np.int64)
        arrays = faced.lit, faced.cosine, hits.ng, to_light
        return found[: direct_kernels.turned(*map(np.ascontiguousarray, arrays), most, found)]
    near = faced.cosine <= most
    if faced.asked is not None:
        near &= faced.asked
    place = np.flatnonzero(near)
    ng = hits.ng.take(faced.hit(place), axis=1)
    return place[dot(ng, to_light.take(place, axis=1)) <= 0]
