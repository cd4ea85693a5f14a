"""Multiple importance sampling of lamps in glossy surfaces: by points on the lamp and by rays of the lobe at once.

A small lamp is seldom met by directions of a wide lobe, and a narrow lobe seldom shows a point of a large lamp. So both
are tried, and each counts by its weight (Veach and Guibas, "Optimally combining sampling techniques for Monte Carlo
rendering", 1995). A ray of a lobe carries the density of its direction; where it meets a lamp, the lamp's light counts
with the lobe's weight. The lamp's weight goes with a shadow ray from where the lobe is.

What only one strategy finds is left to it: mirrors, and lobes and lamps of other kinds. So is a lamp that is far wider
than a lobe (``ALONE``): both weights are decided there, and no point is looked for. Nor is one on a ball that the lobe
doesn't reach. Lights that no ray can meet shine on rough metals by their points alone, and are told from lamps by that.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from course.engine.core.direct import Candidates, DirectLight, Sums
from course.engine.core.hits import Hits, Surface
from course.engine.core.integrator import Integrator
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.materials import Lookup
from course.engine.core.motion import Motion
from course.engine.core.rays import Draws, Rays
from course.engine.core.scatter import Scatter, kept_above
from course.engine.core.types import Floats32, Functions, Indices, Mask, Materials
from course.engine.core.vectors import dot, reflect, repeated
from course.engine.terms.lights.light_choice import some_of
from course.engine.terms.scattering.microfacets import Microfacets
from course.engine.terms.surfaces.hits_on import hits_on

ONCE = np.array([1, 1])
"""Samples of each strategy at a hit: one point on a lamp, one direction of the lobe."""

DELTA = np.float32(np.inf)
"""Density of directions that lamps can't be sampled for: what they meet counts in full."""

ALONE = np.float32(8)
"""A lobe that is this many times denser in its middle than the lamp's points finds the lamp alone.

On Veach's plates the noise of both is up to an eighth above the lobe's own there, for the lobe's outermost directions
are left to points that hardly ever lie there.
"""

NOTHING = np.float32(-104)
"""The logarithm of a share that is 0 in float32."""


@dataclass(frozen=True)
class LobeRays(Rays):
    """Rays that know how dense the lobe is that they come from.

    Attributes
    ----------
    density : (n,) float32 [1/sr], DELTA where only the lobe finds lamps
    peak : (n,) float32 [1/sr], in the middle of the lobe
    """

    density: Floats32 | None = None
    peak: Floats32 | None = None


@dataclass(frozen=True)
class Lamp(ABC):
    """A lamp with a size.

    Attributes
    ----------
    light : samples points on it
    material : of its surface
    area : of it, in the unit of the compiled scene squared
    functions : of the module multiple_importance
    """

    light: Light
    material: int
    area: float
    functions: Functions

    @abstractmethod
    def density(self, points: Floats32, to_light: Floats32) -> Floats32:
        """How dense the lamp's points are over directions (n,) [1/sr], for vectors (3, n) from shading points to it."""

    def seen(self, points: Floats32) -> tuple[Floats32, Floats32, Floats32] | None:
        """Where a ball lies as seen from shading points (3, n); None of lamps whose density is not even.

        Density (n,) of its points [1/sr], unit vectors (3, n) to its middle, and sines (n,) of the cone that it fills.
        """
        return None


@dataclass(frozen=True)
class FlatLamp(Lamp):
    """A parallelogram, sampled uniformly by area."""

    light: RectangleLight

    def density(self, points: Floats32, to_light: Floats32) -> Floats32:
        """See ``Lamp``."""
        distance = np.sqrt(dot(to_light, to_light))
        height = self.light.height(points, self.light.corner[:, None])
        cosine = height / np.maximum(distance, np.float32(1e-30))
        found: Floats32 = self.functions.area_density(self.area, distance, cosine)
        return found


@dataclass(frozen=True)
class RoundLamp(Lamp):
    """A sphere, sampled uniformly over the cone that it fills; ``center`` (3,) float32."""

    center: Floats32
    radius: float

    def density(self, points: Floats32, to_light: Floats32) -> Floats32:
        """See ``Lamp``."""
        axis = self.center[:, None] - points
        found: Floats32 = self.functions.cone_density(self.radius, np.sqrt(dot(axis, axis)))
        return found

    def seen(self, points: Floats32) -> tuple[Floats32, Floats32, Floats32]:
        """See ``Lamp``; a sine above 1 is that of a point within the ball."""
        axis = self.center[:, None] - points
        distance = np.maximum(np.sqrt(dot(axis, axis)), np.float32(1e-30))
        inverse: Floats32 = np.reciprocal(distance)
        sine: Floats32 = np.float32(self.radius) * inverse
        return self.functions.cone_density(self.radius, distance), axis * inverse, sine


@dataclass(frozen=True)
class Combining:
    """What is combined in a scene, and how.

    Attributes
    ----------
    lamps : those that are looked for in both ways
    exponents : (M,) float32 of Phong's lobes, -1 for other materials
    power : exponent of the heuristic; None where lamps are looked for by their points alone
    functions : of the module multiple_importance
    metals : rough metals, whose lobes are not Phong's
    bare : lights that no ray can meet; only metals show them
    """

    lamps: tuple[Lamp, ...]
    exponents: Floats32
    power: float | None
    functions: Functions
    metals: tuple[Microfacets, ...] = ()
    bare: tuple[Light, ...] = ()

    @cached_property
    def is_metal(self) -> Mask:
        """(M,) bool."""
        found: Mask = np.isin(np.arange(len(self.exponents)), [one.material for one in self.metals])
        return found

    @cached_property
    def is_glossy(self) -> Mask:
        """(M,) bool, materials whose lamps aren't left to the lobe alone."""
        found: Mask = (self.exponents >= 0) | self.is_metal
        return found

    def lobe_density(
        self, material: Materials, incoming: Floats32, ns: Floats32, ng: Floats32, way: Floats32
    ) -> Floats32:
        """How dense a lobe's directions are (n,) [1/sr]; of Phong's, those mirrored that fell below the surface, too.

        Parameters
        ----------
        material : (n,) of the lobes
        incoming, ns, ng : (3, n), as in ``Hits``
        way : (3, n) unit vectors
        """
        axis = kept_above(reflect(incoming, ns), ng)
        exponent = self.exponents.take(material)
        off = way - axis
        height = dot(way, ng)
        # 1 - cos, without its cancellation: a narrow lobe hangs on the last digits.
        above = dot(off, off) / 2
        below = above + 2 * height * dot(axis, ng)
        dense = np.zeros(len(material), np.float32)
        for sunk in (above, below):
            cosine = np.log1p(-np.minimum(sunk, np.float32(1 - 1e-7)))
            dense += np.where(sunk < 1, np.exp(exponent * cosine), np.float32(0))
        dense *= (exponent + 1) / np.float32(2 * np.pi)
        for one, some in hits_on(self.metals, material):
            arrays = (each.take(some, axis=1) for each in (incoming, ns, way))
            dense[some] = one.density(*arrays)
        dense *= height > 0
        return dense

    @cached_property
    def _peaks(self) -> Floats32:
        peaks = (self.exponents + 1) / np.float32(2 * np.pi)
        for one in self.metals:
            peaks[one.material] = one.peak
        return peaks

    def peak(self, material: Materials) -> Floats32:
        """The density (n,) of lobes in their middle [1/sr]."""
        return self._peaks.take(material)

    def weights(self, lamp: Floats32, lobe: Floats32, peak: Floats32) -> Floats32:
        """Weights (2, n) of points on the lamp and of directions of the lobe, by their densities (n,)."""
        if self.power is None:
            return np.stack((lamp > 0, lamp <= 0)).astype(np.float32)
        densities = np.stack((lamp, lobe))
        found: Floats32 = self.functions.heuristic_weights(ONCE, densities, self.power)
        alone = peak >= ALONE * lamp
        return np.where(alone, np.array([[0], [1]], found.dtype), found)

    @cached_property
    def reach(self) -> Floats32:
        """(M,) cosines to a lobe's axis from which on it is 0 in float32; of metals it is 0 nowhere."""
        found: Floats32 = np.exp(NOTHING / np.maximum(self.exponents, np.float32(1e-3)))
        found[self.is_metal] = -2
        return found

    def asks(self, hits: Hits, axis: Floats32, lamp: Lamp) -> Indices | None:
        """Hits (k,) at which points on a lamp are looked for; None where no hit is left out.

        Weights know nothing of what is left out here: the lamp's own are 0 there, or its points send nothing.

        ``axis``: (3, n) of the lobes.
        """
        found = lamp.seen(hits.near_origin)
        if found is None:
            return None
        density, way, sine = found
        # The cosine of the angle between the lobe's axis and the ball: 1 where the axis meets the ball.
        between, cosine = dot(axis, way), np.sqrt(np.maximum(1 - sine * sine, 0))
        across = np.sqrt(np.maximum(1 - between * between, 0))
        asked = between * cosine + across * sine > self.reach.take(hits.material)
        asked |= between >= cosine
        if self.power is not None:
            asked &= self.peak(hits.material) < ALONE * density
        return np.flatnonzero(asked)


@dataclass(frozen=True)
class MetalReflection:
    """What rough metals reflect, before the surface's reflectance: a ``Reflection`` whose first sum is radiance."""

    combining: Combining

    def add(self, sums: Sums, hits: Hits, candidates: Candidates, color: Floats32) -> Sums:
        """See ``Reflection``; irradiance over pi, times pi and what metals reflect of it."""
        total = sums[0]
        added = candidates.irradiance * color[:, None]
        way = repeated(candidates.to_light * candidates.inverse_length, added.shape[1])
        arrays = [candidates.of(each) for each in (hits.direction, hits.ns, hits.ng)]
        for one, some in hits_on(self.combining.metals, candidates.of(hits.material)):
            direction, ns, ng, to_light = (each.take(some, axis=1) for each in (*arrays, way))
            above = dot(ng, to_light) > 0
            added[:, some] *= one.brdf(direction, ns, to_light) * (np.float32(np.pi) * above)
        if candidates.columns is not None:
            spread = np.zeros((3, hits.size), np.float32)
            spread[:, candidates.columns] = added
            added = spread
        return (added if total is None else np.add(total, added, out=total)), None

    def reflected(self, _hits: Hits, sums: Sums) -> Floats32:
        """See ``Reflection``."""
        assert sums[0] is not None
        return sums[0]


@dataclass(frozen=True)
class LobeLight:
    """What lobes reflect of the points of one lamp, before the surface's reflectance.

    Attributes
    ----------
    lamp : whose points are looked for
    direct : the stage that looks for them
    """

    combining: Combining
    lamp: Lamp
    direct: DirectLight

    def weigh(self, hits: Hits, found: Candidates) -> Candidates | None:
        """See ``Weigh``: light that lobes reflect, by the lamp's weight."""
        of, way = found.of, found.to_light * found.inverse_length
        lamp = self.lamp.density(of(hits.p), found.to_light)
        # Weighted as seen from where the lobe's rays begin, as what these meet is.
        seen = self.lamp.density(found.origin, self.direct.to_light(self.lamp.light, hits, found))
        arrays = of(hits.material), of(hits.direction), of(hits.ns), of(hits.ng)
        lobe = self.combining.lobe_density(*arrays, way)
        # The light's colour is its radiance times its area over pi.
        share = self.combining.weights(seen, lobe, self.combining.peak(arrays[0]))[0]
        sent = np.float32(np.pi / self.lamp.area) * lobe * share
        sent *= (found.irradiance > 0) & (lamp > 0)
        sent /= np.where(lamp > 0, lamp, np.float32(1))
        if self.combining.metals:
            # What these reflect is multiplied in when it is known what is visible.
            metal = self.combining.is_metal.take(arrays[0])
            sent = np.where(metal, found.irradiance * share * (lobe > 0), sent)
        # Outside of the lobe no shadow ray is needed.
        kept = np.flatnonzero(sent)
        if len(kept) == 0:
            return None
        which = found.hit(kept)
        return Candidates(
            index=which,
            columns=which,
            mask=None,
            irradiance=sent.take(kept),
            cosine=found.cosine.take(kept),
            origin=found.origin.take(kept, axis=1),
            to_light=found.to_light.take(kept, axis=1),
            inverse_length=found.inverse_length.take(kept),
        )

    @cached_property
    def _weighing(self) -> DirectLight:
        return replace(self.direct, weigh=self.weigh)

    def incident(
        self, hits: Hits, axis: Floats32, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Radiance (3, n), or None for 0; ``axis`` (3, n) of the lobes."""
        direct = self._weighing
        asked = self.combining.asks(hits, axis, self.lamp)
        if asked is None or len(asked) == hits.size:
            return direct.from_lights(hits, path, depth, draws)[0]
        if len(asked) == 0:
            return None
        of = asked if path is None else path.take(asked)
        found = direct.from_lights(some_of(hits, asked), of, depth, draws)[0]
        if found is None:
            return None
        radiance = np.zeros((3, hits.size), np.float32)
        radiance[:, asked] = found
        return radiance


@dataclass(frozen=True)
class LampsAndLobes:
    """The stage: light that lobes reflect from points on lamps, and the weights of what rays of lobes meet.

    Attributes
    ----------
    combining : what is combined
    scatter : casts the rays of the lobes
    by_points : a stage for each lamp
    on_metals : a stage for the lights that no ray can meet; None where there are none
    """

    combining: Combining
    scatter: Scatter
    by_points: tuple[LobeLight, ...]
    on_metals: DirectLight | None = None

    def light(
        self, hits: Hits, beta: Floats32 | None, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Radiance (3, n) that lobes reflect from points on lamps, or None for 0.

        Parameters
        ----------
        beta : (3, n) throughput of the rays that hit, or None for 1: where no ray follows, no point is looked for
        """
        glossy = np.flatnonzero(self.combining.is_glossy.take(hits.material))
        reflectance = repeated(self.scatter.reflectance(hits, glossy), len(glossy))
        arriving = reflectance if beta is None else reflectance * beta.take(glossy, axis=1)
        worth = arriving.max(axis=0, initial=0) > self.scatter.cutoff
        glossy, reflectance = glossy.compress(worth), reflectance.compress(worth, axis=1)
        if len(glossy) == 0:
            return None
        some = hits if len(glossy) == hits.size else some_of(hits, glossy)
        of = glossy if path is None else path.take(glossy)
        axis = kept_above(reflect(some.direction, some.ns), some.ng)
        total = None
        for stage in self.by_points:
            found = stage.incident(some, axis, of, depth, draws)
            if found is not None:
                total = found if total is None else np.add(total, found, out=total)
        if self.on_metals is not None:
            metal = np.flatnonzero(self.combining.is_metal.take(some.material))
            which = of.take(metal)
            found = self.on_metals.from_lights(some_of(some, metal), which, depth, draws)[0]
            if found is not None:
                total = np.zeros((3, some.size), np.float32) if total is None else total
                total[:, metal] += found
        if total is None:
            return None
        radiance = np.zeros((3, hits.size), np.float32)
        radiance[:, glossy] = total * reflectance
        return radiance

    def carried(self, hits: Hits, path: Indices | None, rays: Rays) -> Rays:
        """The rays that leave hits of paths (n,), each path at most once, with the densities of their lobes.

        Where there are no lamps they need none, and a path may come twice.
        """
        if not self.combining.lamps:
            return rays
        which = left_by(rays, path)
        density = np.full(rays.size, DELTA)
        mine = np.flatnonzero(self.combining.is_glossy.take(hits.material.take(which)))
        at = which.take(mine)
        ns, ng = hits.ns.take(at, axis=1), hits.ng.take(at, axis=1)
        way = rays.direction.take(mine, axis=1)
        arrays = hits.material.take(at), hits.direction.take(at, axis=1), ns, ng, way
        # Points on lamps are looked for above the shading normal's horizon alone.
        density[mine] = np.where(dot(way, ns) > 0, self.combining.lobe_density(*arrays), DELTA)
        known: dict[str, Any] = vars(rays)
        peak = self.combining.peak(hits.material.take(which))
        return LobeRays(**known, density=density, peak=peak)

    def share(self, rays: Rays, hits: Hits) -> Floats32 | None:
        """Weights (n,) of the light that rays meet at hits; None where all of it counts."""
        if not isinstance(rays, LobeRays) or rays.density is None or rays.peak is None:
            return None
        density = rays.density if hits.ray is None else rays.density.take(hits.ray)
        share = np.ones(hits.size, np.float32)
        for lamp in self.combining.lamps:
            met = (hits.material == lamp.material) & (density < DELTA) & hits.entering
            which = np.flatnonzero(met)
            if len(which) == 0:
                continue
            ray = which if hits.ray is None else hits.ray.take(which)
            origin = rays.origin.take(ray, axis=1)
            of_lamp = lamp.density(origin, hits.p.take(which, axis=1) - origin)
            peak = rays.peak.take(ray)
            share[which] = self.combining.weights(of_lamp, density.take(which), peak)[1]
        return share


@dataclass(frozen=True)
class CombiningIntegrator(Integrator):
    """The distribution ray tracer, where lamps in glossy surfaces are looked for in both ways.

    Attributes
    ----------
    lamps_and_lobes : the stage; None never stands in a plan
    lamps : (3, M) radiance emitted from the fronts of lights, in the place of ``emission``
    """

    lamps_and_lobes: LampsAndLobes | None = None
    lamps: Lookup | None = None

    def follow(self, rays: Rays, depth: int, path_radiance: Floats32, draws: Draws) -> Rays | None:
        """See ``Integrator``."""
        stage, counters = self.lamps_and_lobes, draws.counters
        assert stage is not None
        hits, throughput, path, medium = self.intersect(rays, True, depth, path_radiance, draws)
        if hits.size == 0:
            return None
        parts = [self.shade(hits, path, depth, draws)]
        if self.lamps is not None:
            seen, share = self.lamps(hits.material) * hits.entering, stage.share(rays, hits)
            parts.append(seen if share is None else seen * share)
        if depth < self.max_depth:
            parts.append(stage.light(hits, throughput, path, depth, draws))
        for radiance in parts:
            if radiance is not None:
                self.add_radiance(path_radiance, path, radiance, throughput)
        counters.lap("shade")
        if self.scatter is None or depth == self.max_depth:
            return None
        following = self.scatter(hits, throughput, path, medium, depth, draws)
        counters.lap("bounce")
        return None if following is None else stage.carried(hits, path, following)


def plan_lamps_and_lobes(
    combining: Combining, surface: Surface, scatter: Scatter, motion: Motion | None
) -> LampsAndLobes:
    """The stage of a scene."""
    direct = DirectLight(surface, (), motion, None, MetalReflection(combining))
    stages = tuple(
        LobeLight(combining, lamp, replace(direct, lights=(lamp.light,)))
        for lamp in combining.lamps
    )
    bare = replace(direct, lights=combining.bare) if combining.bare else None
    return LampsAndLobes(combining, scatter, stages, bare)


def left_by(rays: Rays, path: Indices | None) -> Indices:
    """The hits that rays leave, (r,), of paths (n,), each path at most once; None for one hit a path, in order."""
    which = rays.path
    assert which is not None
    if path is None or not len(path):
        return which
    place = np.empty(path.max() + 1, np.intp)
    place[path] = np.arange(len(path))
    return place.take(which)
