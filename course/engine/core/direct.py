"""Direct light by next-event estimation: for each light one point on it, and one shadow ray."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from course.engine.core.hits import Hits, Surface
from course.engine.core.lights.sample import TO_THE_LIGHT, Light, Sample
from course.engine.core.motion import Motion
from course.engine.core.ray_offset import bulge
from course.engine.core.rays import Draws
from course.engine.core.types import Floats32, Indices, Mask
from course.engine.core.vectors import dot, repeated

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


Sums = tuple[Floats32 | None, Floats32 | None]
"""What arrives at n hits from all lights, (3, n) each: of the diffuse term, and of highlights. None stands for 0."""


class Reflection(Protocol):
    """What surfaces reflect of the light that arrives."""

    def add(self, sums: Sums, hits: Hits, candidates: Candidates, color: Floats32) -> Sums:
        """The sums with what arrives from a light of this colour; the sums may be overwritten."""

    def reflected(self, hits: Hits, sums: Sums) -> Floats32:
        """Radiance (3, n) towards the viewer; the first of the sums is not None, and may be overwritten."""


Ask = Callable[[Light, Sums, Hits, Indices | None, int, Draws], Sums]
"""``DirectLight.from_light``."""

LightChoice = Callable[[Ask, Hits, Indices | None, int, Draws], Sums]
"""Chooses among lights, so that hits ask some of them only: the sums by what ``Ask`` adds of those that are chosen."""

Weigh = Callable[[Hits, Candidates], Candidates | None]
"""Weighs the light of candidates, and leaves out those that need no shadow ray."""


Visible = Callable[[Light, Hits, Candidates, Draws], Mask]
"""``DirectLight.visible``."""

Spare = Callable[[Visible, Light, Hits, Candidates, Draws], Mask]
"""Asks for the visibility of those candidates only for which it isn't known; what it spares, it counts."""


@dataclass(frozen=True)
class DirectLight:
    """Direct light reflected at hits.

    Attributes
    ----------
    shaded : ``MaterialTable.shaded_sides``; None if all materials reflect direct light on both sides
    sky : function that returns the environment's irradiance / pi, (3, n) or None for 0; None if it isn't sampled
    choice : None if all hits ask all lights
    weigh : None if light counts in full
    spare : None if all candidates cast shadow rays
    """

    surface: Surface
    lights: tuple[Light, ...]
    motion: Motion | None
    shaded: Mask | None
    reflection: Reflection
    sky: Callable[[Hits, Indices | None, int, Draws], Floats32 | None] | None = None
    choice: LightChoice | None = None
    weigh: Weigh | None = None
    spare: Spare | None = None

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Radiance (3, n) that hits of paths (n,) reflect; None if no light faces any of them."""
        diffuse, specular = self.from_lights(hits, path, depth, draws)
        sky = None if self.sky is None else self.sky(hits, path, depth, draws)
        if sky is not None:
            diffuse = sky if diffuse is None else np.add(diffuse, sky, out=diffuse)
        return None if diffuse is None else self.reflection.reflected(hits, (diffuse, specular))

    def from_lights(self, hits: Hits, path: Indices | None, depth: int, draws: Draws) -> Sums:
        """What arrives from all lights."""
        if self.choice is not None:
            return self.choice(self.from_light, hits, path, depth, draws)
        sums: Sums = None, None
        for light in self.lights:
            sums = self.from_light(light, sums, hits, path, depth, draws)
        return sums

    def from_light(
        self,
        light: Light,
        sums: Sums,
        hits: Hits,
        path: Indices | None,
        depth: int,
        draws: Draws,
    ) -> Sums:
        """The sums with what arrives from one light."""
        watcher = draws.watcher
        if watcher is not None:
            watcher.asks(self, light, path)
        # ---- one point on the light
        u = draws(light.name, path, depth) if light.width else None
        sample = light.sample(self._points(hits, light), u)
        candidates = self._candidates(hits, sample)
        if candidates is not None and self.weigh is not None:
            candidates = self.weigh(hits, candidates)
        if watcher is not None:
            watcher.faced(self, hits, sample, candidates)
        if candidates is None:
            return sums
        # ---- one shadow ray
        rays = light, hits, candidates, draws
        free = self.visible(*rays) if self.spare is None else self.spare(self.visible, *rays)
        np.multiply(candidates.irradiance, free, out=candidates.irradiance)
        draws.cast("shadow", len(candidates.index), path, candidates.index)
        if watcher is not None:
            watcher.shadowed(self, light, hits, candidates, free)
        # ---- what is reflected
        return self.reflection.add(sums, hits, candidates, light.color)

    def _points(self, hits: Hits, light: Light) -> Floats32:
        """Shading points (3, n) for which the light is sampled: the hits, in a moving light's frame."""
        return self._as_if_still(hits.p, hits, light)

    def _as_if_still(self, points: Floats32, hits: Hits, light: Light) -> Floats32:
        """Points (3, n) in the frame of a moving light, where the light stands still: points minus its displacement."""
        if light.velocity is None or self.motion is None or hits.time is None:
            return points
        return points - self.motion.moved(light.velocity, hits.time)

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

    def visible(self, light: Light, hits: Hits, candidates: Candidates, draws: Draws) -> Mask:
        """Visibility of the light, (k,); undefined for hits that aren't candidates.

        A facet of a smooth mesh may face away from a light that its shading normal faces. Its shadow ray starts at the
        round surface above the facet (``bulge``). A second ray, from the facet up to that point, must be
        unblocked too.
        """
        triangles, unoccluded = self.surface.triangles, self.surface.accelerator.unoccluded
        stats, mask = draws.counters.embree, candidates.mask
        time = None if hits.time is None else candidates.of(hits.time)
        origin = candidates.origin
        to_light = self.to_light(light, hits, candidates)
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

    def to_light(self, light: Light, hits: Hits, candidates: Candidates) -> Floats32:
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
