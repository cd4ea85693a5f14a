"""Distribution ray tracing: follow a batch of camera rays from depth to depth and add up their radiance.

This is Whitted's ray tree (1980) with Cook's random sampling of lens, time, gloss and lights (1984). Each hit casts at
most one reflected ray, one refracted ray, and one shadow ray per light (two next to the terminator of smooth meshes).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.engine.core.camera import Camera
from course.engine.core.direct import DirectLight
from course.engine.core.environment import Environment
from course.engine.core.hits import Hits, Surface
from course.engine.core.materials import Lookup
from course.engine.core.motion import Motion
from course.engine.core.rays import RAYS, Draws, Rays
from course.engine.core.scatter import Scatter
from course.engine.core.types import Floats32, Indices, Mask, Media
from course.engine.core.vectors import repeated

LARGEST_BATCH = 4 * RAYS
"""Largest number of rays followed at once."""


Absorption = Callable[[Rays, Hits, Floats32 | None, Media | None, bool], Floats32 | None]
"""Reduces throughput along rays. Takes rays, hits, the hits' throughput and medium, and True for camera rays."""


class CancelledError(Exception):
    """The render was cancelled."""


@dataclass(frozen=True)
class Integrator:
    """Follows rays. All threads share it, and none writes to it. A stage that the scene doesn't need is None.

    Attributes
    ----------
    environment : radiance of the rays that hit nothing; None if it is black
    environment_depth : largest depth at which rays see the environment, -1 for none
    ambient : (3, M) reflected ambient radiance
    dark_inside : (M,) bool, true for dielectrics: their insides reflect no ambient and no diffuse light
    glow : (3, M) radiance emitted from both sides by surfaces that are not sampled as lights
    emission : (3, M) radiance emitted from the fronts of the surfaces of lights
    absorption : reduces the throughput along rays in dielectrics (``course.engine.terms.scattering.absorption``)
    max_depth : largest number of bounces in this scene
    """

    surface: Surface
    camera: Camera
    motion: Motion | None
    environment: Environment | None
    environment_depth: int
    direct: DirectLight | None
    ambient: Lookup | None
    dark_inside: Mask | None
    glow: Lookup | None
    emission: Lookup | None
    absorption: Absorption | None
    scatter: Scatter | None
    max_depth: int

    def camera_rays(self, x: Floats32, y: Floats32, draws: Draws) -> Rays:
        """Rays through picture points (N,) [pixels], with random points on the lens and random times."""
        u = draws("lens") if self.camera.lens is not None else None
        time = moved = None
        if self.motion is not None:
            time = self.motion.motion_blur.shutter_times(0.0, 1.0, draws("time")[0])
            if self.motion.camera_velocity is not None:
                moved = self.motion.moved(self.motion.camera_velocity, time)
        origin, direction = self.camera.rays(x, y, u, moved)
        return Rays(origin, direction, None, None, time=time)

    def radiance(self, camera_rays: Rays, draws: Draws) -> Floats32:
        """Radiance along the camera rays, (3, paths), summed over the ray tree of each.

        Raises CancelledError soon after ``draws.cancelled()`` becomes true.
        """
        path_radiance = np.zeros((3, draws.block.size), np.float32)
        # Glass may double the rays at each depth, so batches that outgrow the cache are split. The halves wait on a
        # stack, so memory grows linearly with the depth, not as 2^depth.
        pile = [(0, camera_rays)]
        while pile:
            if draws.cancelled():
                raise CancelledError
            depth, rays = pile.pop()
            if rays.size > LARGEST_BATCH:
                pile += [(depth, part) for part in rays.halves()]
                continue
            following = self.follow(rays, depth, path_radiance, draws)
            if following is not None:
                pile.append((depth + 1, following))
        return path_radiance

    def follow(self, rays: Rays, depth: int, path_radiance: Floats32, draws: Draws) -> Rays | None:
        """Follow rays for one depth: add their radiance, and return the rays of the next depth."""
        counters = draws.counters
        # ---- intersection, environment, absorption
        hits, throughput, path, medium = self.intersect(rays, True, depth, path_radiance, draws)
        if hits.size == 0:
            return None
        # ---- direct light, ambient light, emission
        radiance = self.shade(hits, path, depth, draws)
        if radiance is not None:
            self.add_radiance(path_radiance, path, radiance, throughput)
        counters.lap("shade")
        # ---- reflection, gloss, refraction
        if self.scatter is None or depth == self.max_depth:
            return None
        following = self.scatter(hits, throughput, path, medium, depth, draws)
        counters.lap("bounce")
        return following

    def intersect(
        self,
        rays: Rays,
        adds_lights: Mask | bool,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Hits, Floats32 | None, Indices | None, Media | None]:
        """Hits of the rays, with throughput, path and medium of the rays that hit.

        ``adds_lights``, (N,) or one bool, selects the rays that add the environment's radiance if they hit nothing: all
        of them here; in path tracing, those whose last hit hasn't sampled the environment directly.
        """
        counters, surface, of_camera = draws.counters, self.surface, depth == 0
        watcher = draws.watcher
        if watcher is not None:
            rays = watcher.begins(rays, depth)
        found = surface.intersect(rays, counters.embree, of_camera)
        counters.lap("trace")
        if depth <= self.environment_depth and adds_lights is not False:
            missed = (found.triangle < 0) & adds_lights
            if watcher is not None:
                watcher.missed(rays, missed)
            self._add_environment(path_radiance, rays, missed)
        if watcher is not None:
            watcher.found(rays, found.triangle >= 0)
        hits = surface.hits(found, rays.direction, rays.time, of_camera)
        throughput, path, medium = _carried(rays, hits.ray)
        if draws.costs is not None:
            draws.costs.add("hit", path)
        if self.absorption is not None:
            throughput = self.absorption(rays, hits, throughput, medium, of_camera)
        if watcher is not None and path is not None:
            watcher.met(path, hits, throughput)
        counters.lap("hits")
        return hits, throughput, path, medium

    def shade(self, hits: Hits, path: Indices | None, depth: int, draws: Draws) -> Floats32 | None:
        """Radiance (3, n) from the hits towards the viewer, without that of scattered rays."""
        radiance = None
        if self.direct is not None:
            radiance = self.direct(hits, path, depth, draws)
        if self.ambient is not None:
            radiance = _sum(radiance, self._ambient_light(hits, self.ambient))
        if self.glow is not None:
            radiance = _sum(radiance, self.glow(hits.material))
        if self.emission is not None:
            radiance = _sum(radiance, self.emission(hits.material) * hits.entering)
        return None if radiance is None else repeated(radiance, hits.size)

    def _ambient_light(self, hits: Hits, ambient: Lookup) -> Floats32:
        """Reflected ambient radiance, (3, n) or (3, 1)."""
        reflected = ambient(hits.material)
        if hits.tint is not None:
            reflected = reflected * hits.tint
        inside = self.insides(hits)
        if len(inside):
            reflected = np.array(np.broadcast_to(reflected, (3, hits.size)))
            reflected[:, inside] = 0
        return reflected

    def insides(self, hits: Hits) -> Indices:
        """Indices of the hits on the insides of the dielectrics in ``dark_inside``."""
        if self.dark_inside is None:
            return np.empty(0, np.intp)
        return np.flatnonzero(~hits.entering & self.dark_inside.take(hits.material))

    def _add_environment(self, path_radiance: Floats32, rays: Rays, missed: Mask) -> None:
        which = np.flatnonzero(missed)
        if len(which) == 0 or self.environment is None:
            return
        radiance = self.environment.radiance(rays.direction.take(which, axis=1))
        throughput, path, _ = _carried(rays, which)
        self.add_radiance(path_radiance, path, repeated(radiance, len(which)), throughput)

    def add_radiance(
        self,
        path_radiance: Floats32,
        path: Indices | None,
        radiance: Floats32,
        throughput: Floats32 | None,
    ) -> None:
        """Add radiance times throughput, (3, n) each, to the sums (3, paths). Rays may share a path."""
        if throughput is not None:
            radiance = radiance * throughput
        if path is None:
            path_radiance += radiance
            return
        for channel, values in zip(path_radiance, radiance, strict=True):
            # `add.at` adds in the order of the rays: other paths don't change the order and rounding of a path's sum.
            np.add.at(channel, path, values)


def _carried(
    rays: Rays, which: Indices | None
) -> tuple[Floats32 | None, Indices | None, Media | None]:
    """Throughput, path and medium of some rays, or of all."""
    if which is None:
        return rays.throughput, rays.path, rays.medium
    return (
        None if rays.throughput is None else rays.throughput.take(which, axis=1),
        which if rays.path is None else rays.path.take(which),
        None if rays.medium is None else rays.medium.take(which),
    )


def _sum(radiance: Floats32 | None, term: Floats32) -> Floats32:
    """Radiance plus a term, (3, n) or (3, 1) each; an array (3, 1) is not overwritten, because it may be a view of a
    Lookup.
    """
    if radiance is None:
        return term
    return np.add(radiance, term, out=radiance if radiance.shape[1] > 1 else None)
