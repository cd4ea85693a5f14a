"""Direct light by next-event estimation: for each light one point on it, one shadow ray, and Blinn-Phong reflection."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.core.hits import Hits, Surface
from course.core.lights.sample import TO_THE_LIGHT, Light, Sample, towards
from course.core.materials import Lookup, blinn_phong_highlight
from course.core.motion import Motion
from course.core.ray_offset import bulge
from course.core.rays import Draws
from course.core.types import Floats32, Indices, Mask
from course.core.vectors import dot, repeated

DENSE = 0.5
"""If at least this fraction of the hits are candidates, all hits are computed. Otherwise the candidates are copied
first. Computing all saved 2 to 5% of the time outside Embree (medians, one thread). Values from .2 to .8 are equally
good."""

ROUNDING = 1e-4
"""Added to a float32 sine before it is compared with a float32 cosine."""


@dataclass(frozen=True)
class Candidates:
    """Hits that a light illuminates if nothing occludes it. A shadow ray decides whether the light illuminates them.

    Their arrays have k columns: either one for each of the m candidates, or one for each of the n hits.

    Attributes
    ----------
    index : (m,) int, the candidates among the hits
    columns : (k,) int, the hit of each column; None if column i is hit i
    mask : (n,) bool, true for candidates; None if every column is a candidate
    irradiance : (k,) float32, cosine times ``Sample.factor``: E / pi is this times the light's colour; 0 for others
    cosine : (k,) float32, between shading normal and direction to the light
    origin : (3, k) float32, of the shadow rays
    to_light : (3, k) or (3, 1) float32, from the hit, not normalised
    inverse_length : (k,) or (1,) float32, 1 / its length
    """

    index: Indices
    columns: Indices | None
    mask: Mask | None
    irradiance: Floats32
    cosine: Floats32
    origin: Floats32
    to_light: Floats32
    inverse_length: Floats32

    def of(self, values: NDArray[Any]) -> NDArray[Any]:
        """Take the candidates' columns, (k,) or (3, k), of an array with a column for each hit, (n,) or (3, n)."""
        return values if self.columns is None else values.take(self.columns, axis=-1)

    def hit(self, column: Indices) -> Indices:
        """Indices of the hits in some columns."""
        return column if self.columns is None else self.columns.take(column)


@dataclass(frozen=True)
class DirectLight:
    """Direct light reflected at hits.

    Attributes
    ----------
    shaded : ``MaterialTable.shaded_sides``; None if all materials reflect direct light on both sides
    diffuse : (3, M) reflectance
    specular, exponent : (3, M) and (M,) of the highlights; specular is None if no material has one
    sky : function that returns the environment's irradiance / pi, (3, n) or None for 0; None if it isn't sampled
    """

    surface: Surface
    lights: tuple[Light, ...]
    motion: Motion | None
    shaded: Mask | None
    diffuse: Lookup
    specular: Lookup | None
    exponent: Lookup
    sky: Callable[[Hits, Indices | None, int, Draws], Floats32 | None] | None = None

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Radiance (3, n) that hits of paths (n,) reflect; None if no light faces any of them."""
        diffuse, specular = self._from_lights(hits, path, depth, draws)
        sky = None if self.sky is None else self.sky(hits, path, depth, draws)
        if sky is not None:
            diffuse = sky if diffuse is None else np.add(diffuse, sky, out=diffuse)
        return None if diffuse is None else self._reflected(hits, diffuse, specular)

    def _from_lights(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> tuple[Floats32 | None, Floats32 | None]:
        """Sums (3, n) over all lights: E / pi, and (n . h)^exponent E / pi. None stands for 0."""
        diffuse: Floats32 | None = None
        specular: Floats32 | None = None
        for light in self.lights:
            # ---- one point on the light
            u = draws(light.name, path, depth) if light.width else None
            candidates = self._candidates(hits, self._sample(light, self._points(hits, light), u))
            if candidates is None:
                continue
            # ---- one shadow ray
            irradiance = candidates.irradiance
            irradiance *= self._visible(light, hits, candidates, draws)
            draws.cast("shadow", len(candidates.index), path, candidates.index)
            # ---- Blinn-Phong
            diffuse = self._accumulated(diffuse, hits, candidates, irradiance, light.color)
            if self.specular is not None:
                highlight = self._highlight(hits, candidates, irradiance)
                specular = self._accumulated(specular, hits, candidates, highlight, light.color)
        return diffuse, specular

    def _points(self, hits: Hits, light: Light) -> Floats32:
        """Shading points (3, n) for which the light is sampled: the hits, in a moving light's frame."""
        return self._as_if_still(hits.p, hits, light)

    def _as_if_still(self, points: Floats32, hits: Hits, light: Light) -> Floats32:
        """Points (3, n) in the frame of a moving light, where the light stands still: points minus its displacement."""
        if light.velocity is None or self.motion is None or hits.time is None:
            return points
        return points - self.motion.moved(light.velocity, hits.time)

    def _sample(self, light: Light, points: Floats32, u: Floats32 | None) -> Sample:
        return light.sample(points, u, towards)

    def _candidates(self, hits: Hits, sample: Sample) -> Candidates | None:
        """The hits that cast a shadow ray; None if there are none."""
        cosine = dot(hits.ns, sample.to_light)
        cosine *= sample.inverse_length
        irradiance = cosine * sample.factor
        if self.shaded is not None:
            sides = [row.take(hits.material) for row in self.shaded]
            irradiance *= sides[0] if len(sides) == 1 else np.where(hits.entering, *sides)
        mask = irradiance > 0
        index = np.flatnonzero(mask)
        if len(index) == 0:
            return None
        arrays = irradiance, cosine, hits.near_origin, sample.to_light, sample.inverse_length
        if len(index) == hits.size:
            return Candidates(index, None, None, *arrays)
        # A NaN is no candidate, but max(NaN, 0) is NaN: it would reach the picture.
        if len(index) >= DENSE * hits.size and np.isfinite(irradiance.min()):
            np.maximum(irradiance, 0, out=irradiance)
            return Candidates(index, None, mask, *arrays)
        # The vector to a directional light is one column for all hits.
        some = [a if a.shape[-1] == 1 else a.take(index, axis=-1) for a in arrays]
        return Candidates(index, index, None, *some)

    def _visible(self, light: Light, hits: Hits, candidates: Candidates, draws: Draws) -> Mask:
        """Visibility of the light, (k,); undefined for hits that aren't candidates.

        A facet of a smooth mesh may face away from a light that its shading normal faces. Its shadow ray starts at the
        round surface above the facet (``bulge``). A second ray, from the facet up to that point, must be
        unblocked too.
        """
        triangles, unoccluded = self.surface.triangles, self.surface.accelerator.unoccluded
        stats, mask = draws.counters.embree, candidates.mask
        time = None if hits.time is None else candidates.of(hits.time)
        origin = candidates.origin
        to_light = self._to_light(light, hits, candidates)
        if triangles.bulge is None:
            return unoccluded(origin, to_light, light.limit, stats, time, active=mask)
        # Let a be the angle between a facet's normal and its shading normal. If the facet faces away from the light,
        # the shading normal is at least (90 degrees - a) away from it. So the cosine to the light is at most sin a.
        most = np.float32(triangles.largest_sine + ROUNDING)
        column = self._turned_away(hits, candidates, to_light, most)
        height = bulge(triangles, hits, candidates.hit(column))
        raised = np.flatnonzero(height)
        if len(raised) == 0:
            return unoccluded(origin, to_light, light.limit, stats, time, active=mask)
        column = column.take(raised)
        up = hits.ns.take(candidates.hit(column), axis=1) * height.take(raised)
        foot = origin.take(column, axis=1)
        draws.counters.rays["shadow"] += len(column)
        when = None if time is None else time.take(column)
        free_above = unoccluded(foot, up, 1.0, stats, when)
        # Few origins are raised, so they are changed and restored: a copy of all would cost more.
        origin[:, column] = foot + up
        if light.limit <= TO_THE_LIGHT:
            to_light[:, column] -= up
        free = unoccluded(origin, to_light, light.limit, stats, time, active=mask)
        origin[:, column] = foot
        free[column] &= free_above
        return free

    def _to_light(self, light: Light, hits: Hits, candidates: Candidates) -> Floats32:
        """Vectors (3, k) of the shadow rays, which begin above the hits for which the light was sampled."""
        if light.limit > TO_THE_LIGHT:
            return repeated(candidates.to_light, candidates.origin.shape[1])
        return light.short_of(candidates.to_light + candidates.of(hits.p) - candidates.origin)

    def _turned_away(
        self, hits: Hits, candidates: Candidates, to_light: Floats32, most: np.float32
    ) -> Indices:
        """Columns (t,) of the candidates whose facets face away from the light. ``most`` bounds their cosines."""
        near = candidates.cosine <= most
        if candidates.mask is not None:
            near &= candidates.mask
        column = np.flatnonzero(near)
        ng = hits.ng.take(candidates.hit(column), axis=1)
        return column[dot(ng, to_light.take(column, axis=1)) <= 0]

    def _highlight(self, hits: Hits, candidates: Candidates, irradiance: Floats32) -> Floats32:
        """(n . h)^exponent times the irradiance, (k,)."""
        highlight = blinn_phong_highlight(
            candidates.to_light * candidates.inverse_length,
            candidates.of(hits.direction),
            candidates.of(hits.ns),
            self.exponent(candidates.of(hits.material)),
        )
        highlight *= irradiance
        return highlight

    def _accumulated(
        self,
        total: Floats32 | None,
        hits: Hits,
        candidates: Candidates,
        values: Floats32,
        color: Floats32,
    ) -> Floats32:
        """Add values (k,) times a colour to the total (3, n) of all hits."""
        if candidates.columns is not None:
            spread = np.zeros(hits.size, np.float32)
            spread[candidates.columns] = values
            values = spread
        added: Floats32 = values * color[:, None]
        if total is None:
            return added
        total += added
        return total

    def _reflected(self, hits: Hits, diffuse: Floats32, specular: Floats32 | None) -> Floats32:
        """Multiply both sums by their reflectances, in place, and add them."""
        diffuse *= self.diffuse(hits.material)
        if hits.tint is not None:
            diffuse *= hits.tint
        if specular is not None and self.specular is not None:
            specular *= self.specular(hits.material)
            diffuse += specular
        return diffuse
