"""One batch of rays, in a straight line: camera, then for each depth intersect, shade, bounce."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.samplers import Block, Sampler
from course.core.types import Floats32, Indices, Mask, Media
from course.geometry.embree import Intersections
from course.geometry.hits import Hits, find_hits
from course.geometry.surface import OFFSET
from course.imaging.camera import Camera
from course.imaging.reconstruction import Reconstruction
from course.imaging.tiles import RAYS, Area
from course.scene.world import Settings, World
from course.transport import costs
from course.transport.bounce import bounced
from course.transport.counters import Counters
from course.transport.direct import direct_light
from course.transport.gloss import Blur
from course.transport.insides import insides
from course.transport.paths import OPEN, Draws, Rays, together
from course.transport.plan import PIXEL_WIDTH, Lookups, Plan, make_lookups, make_plan
from course.transport.travelled import way_between

LARGEST_BATCH = 4 * RAYS
"""Rays followed at once."""


class CancelledError(Exception):
    """Nobody waits for this tile any more."""


@dataclass(frozen=True)
class Tracer:
    """Everything that stays the same from batch to batch; shared by all threads, never written to."""

    world: World
    settings: Settings
    camera: Camera
    sampler: Sampler
    reconstruction: Reconstruction
    plan: Plan
    lookups: Lookups

    @property
    def batches(self) -> int:
        """Batches of RAYS camera rays that a tile should have where the picture has so many."""
        return 1

    def render_tile(
        self,
        tile: Area,
        first: int,
        samples: int,
        counters: Counters,
        cancelled: Callable[[], bool] = lambda: False,
        parts: int = 1,
    ) -> tuple[Floats32, Floats32 | float]:
        """Colours (3, n) and weights of a tile's n pixels from one stretch of their samples.

        With several ``parts`` the stretch is divided, and there are (4, n * parts) numbers, those of a pixel together:
        below the colours what a sample of the pixel cost, in camera rays that meet nothing.

        Raises
        ------
        CancelledError
            Soon after ``cancelled`` has begun to say so.
        """
        counters.start()
        block = Block(tile.pixel_numbers(self.settings.width), first, samples, tile.number)
        compiled = self.world.surface.accelerator.compiled
        cost = None if parts == 1 else np.ones(block.size, np.float32)
        draws = Draws(self.sampler, block, counters, cancelled, compiled, cost)
        offsets = draws("pixel", 0, PIXEL_WIDTH, None).reshape(2, tile.size, samples)
        counters.lap("sampler")
        x, y = tile.corners()
        rays = self._camera_rays(
            (x[:, None] + offsets[0]).ravel(), (y[:, None] + offsets[1]).ravel(), draws
        )
        counters.rays["camera"] += rays.size
        counters.lap("camera")
        radiance = self._trace(rays, block.size, draws)
        pieces = (-1, tile.size * parts, samples // parts)
        mean, weight = self.reconstruction.pixels(radiance.reshape(pieces), offsets.reshape(pieces))
        if cost is not None:
            # The same for all parts: sums of a few numbers each would take longer than what they are good for.
            cost = cost.reshape(tile.size, samples).mean(axis=1)
            mean = np.concatenate((mean, np.repeat(cost, parts)[None]))
        counters.lap("film")
        return mean, weight

    def _camera_rays(self, x: Floats32, y: Floats32, draws: Draws) -> Rays:
        """Rays through picture points (N,), from the lens if there is one, at times if anything moves."""
        camera, world, plan = self.camera, self.world, self.plan
        origin, direction = camera.origin[:, None], camera.directions(x, y)
        if world.lens is not None and plan.lens_dimension is not None:
            u = draws("lens", plan.lens_dimension, 2, None)
            origin, direction = world.lens.rays(camera, camera.origin, direction, u)
        time = None
        if world.motion is not None and plan.time_dimension is not None:
            u = draws("time", plan.time_dimension, 1, None)
            time = world.motion.functions.shutter_times(0.0, 1.0, u[0])
            if world.motion.camera_velocity is not None:
                moved = world.motion.functions.displacement(world.motion.camera_velocity, time)
                origin = origin + moved
        if camera.near:
            origin = camera.from_near_plane(origin, direction)
        return Rays(origin, direction, None, None, time=time)

    def _trace(self, camera_rays: Rays, paths: int, draws: Draws) -> Floats32:
        """Radiance (3, paths) that the camera rays and all that follow from them bring back."""
        film = np.zeros((3, paths), np.float32)
        # Glass may double the rays at each depth. Batches that outgrow the cache are split, and the last one put on
        # the pile is followed to its end first, so that memory grows with the depth and not with its power of two.
        pile = [(0, camera_rays)]
        while pile:
            if draws.cancelled():
                raise CancelledError
            depth, rays = pile.pop()
            if rays.size > LARGEST_BATCH:
                pile += [(depth, part) for part in rays.halves()]
                continue
            following = self._follow(rays, depth, film, draws)
            if following is not None:
                pile.append((depth + 1, following))
        return film

    def _follow(self, rays: Rays, depth: int, film: Floats32, draws: Draws) -> Rays | None:
        """One depth: what the rays bring is added to the film, and the rays that go on are returned."""
        counters = draws.counters
        hits, throughput, path, medium = self._met(rays, True, depth, film, draws)
        if hits.size == 0:
            return None
        radiance = self._shade(hits, path, depth, draws)
        if radiance is not None:
            add_radiance(film, path, radiance, throughput, hits.compiled)
        counters.lap("shade")
        if depth == self.plan.max_depth:
            return None
        reflected, refracted = bounced(
            self.plan,
            self.lookups,
            hits,
            throughput,
            path,
            medium,
            self.settings.cutoff,
            self._blur(depth, draws),
        )
        if reflected is not None:
            counters.rays["reflection"] += reflected.size
        if refracted is not None:
            counters.rays["refraction"] += refracted.size
        following = together(reflected, refracted)
        counters.lap("bounce")
        return following

    def _met(
        self, rays: Rays, sees: Mask | bool, depth: int, film: Floats32, draws: Draws
    ) -> tuple[Hits, Floats32 | None, Indices | None, Media | None]:
        """What the rays of one depth meet, and the throughput, path and medium of those that meet something.

        What the environment sends along the others is added to the film.

        Parameters
        ----------
        sees : (n,) or for all, which rays bring the environment's light
        """
        counters = draws.counters
        surface = self.world.surface
        found = (surface.accelerator if depth else surface.seen).intersect(
            rays.origin,
            rays.direction,
            counters.embree,
            rays.time,
            coherent=self._coherent(depth),
            left=rays.left,
        )
        if depth == 0:
            self._leave_eye_surface(rays, found, counters)
        counters.lap("trace")
        shown = depth == 0 or not self.world.backdrop
        if self.plan.sees_environment and shown and sees is not False:
            self._add_environment(film, rays, (found.triangle < 0) & sees)
        hits = find_hits(surface, found, rays.direction, rays.time, depth == 0)
        throughput, path, medium = _of_hits(rays, hits)
        if depth > 0:
            draws.spend(costs.FURTHER_RAY, rays.path)
        draws.spend(costs.HIT, path)
        if self.plan.absorbs:
            before = None
            if depth == 0 and self.camera.near:
                before = self.camera.way_to_near_plane(hits.direction)
            throughput = self._absorbed(rays, hits, throughput, medium, before)
        counters.lap("hits")
        return hits, throughput, path, medium

    def _coherent(self, depth: int) -> bool:
        """Whether rays that follow each other go much the same way, which Embree's packets are the faster for.

        Mirror images of neighbours are neighbours, as long as nothing spreads them at random. After a second mirror or
        glass it depends on the scene: told so, packets take from two thirds to one and a half times as long there.
        """
        world = self.world
        if depth == 0:
            return world.lens is None
        random = world.lens, world.motion, world.paths
        return depth == 1 and not world.lobes and all(each is None for each in random)

    def _leave_eye_surface(self, rays: Rays, found: Intersections, counters: Counters) -> None:
        """A camera that stands exactly on a surface would see nothing but that; its rays start a step further."""
        stuck = np.flatnonzero((found.t <= 0) & (found.triangle >= 0))
        if len(stuck) == 0:
            return
        direction = rays.direction.take(stuck, axis=1)
        origin = rays.origin if rays.origin.shape[1] == 1 else rays.origin.take(stuck, axis=1)
        time = None if rays.time is None else rays.time.take(stuck)
        surface = self.world.surface
        step = np.maximum(surface.planes[found.triangle.take(stuck), 6], np.float32(OFFSET))
        again = surface.seen.intersect(origin + direction * step, direction, counters.embree, time)
        for mine, theirs in (
            (found.triangle, again.triangle),
            (found.u, again.u),
            (found.v, again.v),
            (found.t, again.t),
        ):
            mine[stuck] = theirs

    def _blur(self, depth: int, draws: Draws) -> Blur | None:
        if not (self.world.lobes or self.world.keeps):
            return None
        dimension = self.plan.gloss_dimension + depth * self.plan.bounce_stride
        # What is kept as the functions made it is another renderer's picture, which loses that light.
        lets_out = depth + 1 == self.plan.max_depth and not self.world.keeps
        return Blur(self.world.lobes, dimension, draws, self.world.keeps, lets_out)

    def _shade(self, hits: Hits, path: Indices | None, depth: int, draws: Draws) -> Floats32 | None:
        """Radiance (3, n) that leaves the hits towards the viewer without another bounce."""
        radiance = None
        if self.plan.shades:
            radiance = direct_light(self.world, self.plan, self.lookups, hits, path, depth, draws)
        if self.plan.has_ambient:
            radiance = _sum(radiance, self._ambient_light(hits))
        if self.plan.glows:
            radiance = _sum(radiance, self.lookups.glow(hits.material))
        if self.plan.emits:
            radiance = _sum(radiance, self.lookups.emission(hits.material) * hits.entering)
        if radiance is not None and radiance.shape[1] == 1:
            radiance = np.repeat(radiance, hits.size, axis=1)
        return radiance

    def _ambient_light(self, hits: Hits) -> Floats32:
        """What the hits reflect of ambient light, (3, n) or (3, 1): nothing on the inside of glass."""
        term = self.lookups.ambient(hits.material)
        if hits.tint is not None:
            term = term * hits.tint
        inside = insides(self.plan, self.lookups, hits)
        if len(inside):
            term = np.array(np.broadcast_to(term, (3, hits.size)))
            term[:, inside] = 0
        return term

    def _add_environment(self, film: Floats32, rays: Rays, missed: Mask) -> None:
        which = np.flatnonzero(missed)
        if len(which) == 0:
            return
        radiance = self.world.environment.radiance(rays.direction.take(which, axis=1))
        if radiance.shape[1] == 1:
            radiance = np.repeat(radiance, len(which), axis=1)
        throughput = None if rays.throughput is None else rays.throughput.take(which, axis=1)
        compiled = self.world.surface.accelerator.compiled
        path = which if rays.path is None else rays.path.take(which)
        add_radiance(film, path, radiance, throughput, compiled)

    def _absorbed(
        self,
        rays: Rays,
        hits: Hits,
        throughput: Floats32 | None,
        medium: Media | None,
        before: Floats32 | None,
    ) -> Floats32 | None:
        """Beer's law along the way just travelled: exp(-absorption length) for what crossed a dielectric.

        A ray that hits the back of a dielectric came through it, whatever we believed (the camera may stand in
        glass), and one that hits its front through what surrounds it; one that hits anything else came through the
        medium it carries.

        Parameters
        ----------
        before : (n,) how far the rays had come where they began, None for no way: nothing that is nearer than the near
            plane is seen, but what the camera stands in absorbs from the eye on
        """
        dielectric = self.world.materials.refracts.take(hits.material)
        through = np.where(~hits.entering & dielectric, hits.material.astype(np.int16), OPEN)
        if self.lookups.outside is not None:
            around = self.lookups.outside.take(hits.material)
            through = np.where(hits.entering, around, through)
        if medium is not None:
            through = np.where(through < 0, medium, through)
        which = np.flatnonzero(through >= 0)
        if len(which) == 0:
            return throughput
        length = way_between(rays, hits, which)
        if before is not None:
            length = length + before.take(which)
        left = np.exp(-self.lookups.absorption(through.take(which)) * length)
        result = np.ones((3, hits.size), np.float32) if throughput is None else throughput.copy()
        result[:, which] *= left
        return result


def make_tracer(
    world: World,
    settings: Settings,
    camera: Camera,
    sampler: Sampler,
    reconstruction: Reconstruction,
    kind: type[Tracer] = Tracer,
) -> Tracer:
    """Bind a compiled scene to what renders it."""
    return kind(
        world,
        settings,
        camera,
        sampler,
        reconstruction,
        make_plan(world, settings),
        make_lookups(world),
    )


def _of_hits(rays: Rays, hits: Hits) -> tuple[Floats32 | None, Indices | None, Media | None]:
    """Throughput, path and medium of the rays that hit something."""
    throughput, path, medium = rays.throughput, rays.path, rays.medium
    if hits.ray is None:
        return throughput, path, medium
    return (
        None if throughput is None else throughput.take(hits.ray, axis=1),
        hits.ray if path is None else path.take(hits.ray),
        None if medium is None else medium.take(hits.ray),
    )


def _sum(radiance: Floats32 | None, term: Floats32) -> Floats32:
    """Of two terms, each (3, n) or (3, 1); in place where the first has room, for a single column may be shared."""
    if radiance is None:
        return term
    return np.add(radiance, term, out=radiance if radiance.shape[1] > 1 else None)


def add_radiance(
    film: Floats32,
    path: Indices | None,
    radiance: Floats32,
    throughput: Floats32 | None = None,
    compiled: bool = False,
) -> None:
    """Add radiance (3, n) to the paths that it belongs to; several rays may belong to one path.

    Parameters
    ----------
    throughput : (3, n), or None for 1
    compiled : by a compiled loop, to the same bits
    """
    if path is not None and throughput is not None and compiled:
        from course.transport import direct_kernels

        arrays = path, radiance, throughput
        direct_kernels.add(film, *map(np.ascontiguousarray, arrays))
        return
    if throughput is not None:
        radiance = radiance * throughput
    if path is None:
        film += radiance
        return
    for channel, values in zip(film, radiance, strict=True):
        # In the order of the rays, so the sum doesn't depend on what else is in the batch.
        np.add.at(channel, path, values)
