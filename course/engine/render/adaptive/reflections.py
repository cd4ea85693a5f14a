"""Small bright things in what mirrors or refracts: how likely a sample of each pixel meets them on its way.

One ray is sent ahead through each block of pixels, and on from surface to surface as a smooth one would send it. At
each it is compared with the ways to points on what shines. How fast the difference changes from block to block says
how large the blocks' view of the thing is: so images in curved mirrors and behind glass are found, too, wherever they
lie between the rays. Rough surfaces widen it by their lobes, the lens and the shutter by what they blur.
"""

from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.hits import Surface
from course.engine.core.types import Floats64, Indices, Mask
from course.engine.render.adaptive.bare_lights import NO_PART, bare_lights
from course.engine.render.adaptive.bright import EVEN, Bright
from course.engine.render.adaptive.cell_grid import CellGrid, spread
from course.engine.render.adaptive.glimpses import Chances, important, is_found
from course.engine.render.adaptive.image_sizes import EACH, ImageSizes
from course.engine.render.adaptive.lobes_ahead import Surfaces
from course.engine.render.adaptive.rays_ahead import Arrival, Front, by_surfaces, scattered
from course.engine.render.adaptive.seen_ahead import CameraAxes, nearest
from course.engine.render.adaptive.thin_mirrors import thin_mirrors
from course.engine.terms.surfaces.painting import NOT_PAINTED
from course.engine.terms.surfaces.surface import FullSurface
from course.engine.terms.world import FullWorld

BLOCKS = 8192
"""Rays that are sent through a picture at most."""

SMALLEST = 4
"""Pixels along an edge of a block at least."""

DEEPEST = 3
"""Surfaces after which a ray is followed no further."""

POINTS = 64
"""On all things together, about."""

PASSES = 2
"""Places on the lens and times, where there are such."""

ASKED = 64
"""Cells of an image, about, from which rays are sent to see whether something hides it."""

MET = 0.5
"""Share of a pixel's places from which on a thing is met by the first samples, if they find it by points on it."""

TINY = 1e-300
"""Counts as the least that is looked at more closely."""

BESIDE = 1e-3
"""Part of the way to a point light in which what is met doesn't hide it: it may be what it hangs on."""

FAINT = 0.02
"""Of the variance that is aimed at, what a sample of a pixel may have for which nothing is looked at."""

SHARP = 0.01
"""Variance of the angle from which on what mirrors shows nothing that is followed further [rad^2]."""

FINEST, FEWEST = 0.25, 2048
"""Rays of the second look, four through each pixel of blocks in which an image may be: at most so many for each pixel
of the picture, or so many in all."""


@dataclass(frozen=True)
class _Image:
    """What cells (n,) see of a thing by the same surfaces.

    Attributes
    ----------
    chance, square : (n,) that a sample finds it; times the mean square of what it brings then
    sharp : (n,) where it is looked at more closely
    origin : (3, n) where the rays to it begin
    thing : its place among the things
    time : when it is seen
    """

    cells: Indices
    chance: Floats64
    square: Floats64
    sharp: Mask

    origin: Floats64
    thing: int
    time: float

    def part(self, which: Mask) -> "_Image":
        """What some of the cells see."""
        arrays = self.chance[which], self.square[which], self.sharp[which], self.origin[:, which]
        return _Image(self.cells[which], *arrays, self.thing, self.time)


class Reflections:
    """What samples of a picture may find in mirrors and behind glass.

    Parameters
    ----------
    parts : (T,) parts of the triangles
    target : mean variance that the picture shall have
    deepest : surfaces that rays of the render meet after the first
    """

    def __init__(
        self,
        world: FullWorld,
        view: CameraAxes,
        things: list[Bright],
        parts: Indices,
        target: float,
        deepest: int,
    ) -> None:
        self._world, self._view, self._parts, self._target = world, view, parts, target
        self._surfaces = Surfaces(world)
        self._deepest, self._deeper = min(deepest, DEEPEST), deepest > DEEPEST
        side = int(np.ceil(np.sqrt(view.width * view.height / BLOCKS)))
        self._side = max(side, SMALLEST)
        self._rows, self._columns = -(-view.height // self._side), -(-view.width // self._side)
        count = int(np.clip(POINTS // max(len(things), 1), 1, EACH))
        u = (np.arange(1, count + 1) * EVEN[:2, None]) % 1
        self._things: list[tuple[Bright, Floats64, Floats64 | None]] = [
            (thing, *thing.points(world, u)[:2]) for thing in things
        ]
        self._things += [(light, place, None) for light, place in bare_lights(world)]
        self._wanted = set(range(len(self._things)))
        self._rays = 0
        moves = any(one[0].velocity.any() for one in self._things) or view.velocity.any()
        self._passes = PASSES if view.aperture or moves else 1
        self._step = 1 / self._passes if moves else 0.0
        self.cut_short: set[int] = set()
        """Materials at which rays weren't followed rightly or further, or that they may have missed."""

    def chances(self) -> Chances:
        """Of all pixels."""
        height, width = self._view.height, self._view.width
        if not (self._surfaces.sends_on.any() and self._things and self._deepest):
            return Chances.none(height, width)
        corners = np.indices((self._rows, self._columns)).reshape(2, -1, 1, 1) * self._side
        shape = 1, self._rows, self._columns
        grid = CellGrid(corners.reshape(2, *shape).astype(np.float64), self._side, shape)
        images = self._send(grid)
        pixels = self._side**2 / self._passes
        left = np.array([pixels * image.square.sum() for image in images])
        kept = [images[number] for number in important(left, self._target * height * width)]
        kept = [image.part(self._is_seen(image)) for image in kept]
        left = np.array([pixels * image.square.sum() for image in kept])
        thin = self._thin()
        if not len(important(left, self._target * height * width)) and not thin:
            return replace(Chances.none(height, width), rays=self._rays)
        blurred = self._added(grid, [image.part(~image.sharp) for image in kept])
        sharp = np.zeros(grid.size)
        for image in kept:
            np.maximum.at(sharp, image.cells[image.sharp], image.square[image.sharp])
        sharp[list(thin)] = np.maximum(sharp[list(thin)], TINY)
        chosen, cells = np.flatnonzero(sharp), 2 * self._side
        most = max(int(FINEST * height * width), FEWEST) // cells**2
        if len(chosen) > most:
            chosen = np.sort(chosen[np.argsort(-sharp[chosen], kind="stable")][:most])
            self.cut_short.update(thin[block] for block in set(thin) - set(chosen.tolist()))
        if not len(chosen):
            return replace(blurred, rays=self._rays)
        within = np.indices((cells, cells)) / 2
        places = corners.reshape(2, -1)[:, chosen, None, None] + within[:, None]
        grid = CellGrid(places, 0.5, (len(chosen), cells, cells))
        if not thin:
            self._wanted = {image.thing for image in kept if image.sharp.any()}
        images = [image.part(image.sharp) for image in self._send(grid) if image.sharp.any()]
        close = self._added(grid, [image.part(self._is_seen(image)) for image in images])
        return blurred + Chances(spread(close.mean), spread(close.square), self._rays)

    def _thin(self) -> dict[int, int]:
        """Blocks with surfaces that their rays may have missed, and the materials of these."""
        mirrors = self._surfaces.sends_on.astype(np.float64)
        thin = thin_mirrors(
            *(self._world, self._view, self._parts, mirrors, self._side), self._matters
        )
        self._rays += thin.rays
        self.cut_short |= thin.too_small
        return thin.blocks

    def _matters(self, pixels: float, material: int) -> bool:
        """Whether an image on so many pixels would leave as much as matters, of any thing that a material shows."""
        both = self._world.combining
        metal = both is not None and bool(both.is_metal[material])
        left = self._target * self._view.height * self._view.width
        squares = [one.square for one, *_ in self._things if metal or one.part != NO_PART]
        most = min(pixels, 1) * max(squares, default=0.0)
        return len(important(np.array([most]), left)) > 0

    def _send(self, grid: CellGrid) -> list[_Image]:
        """Send rays through all cells; returns the images that they find."""
        self._grid, self._images = grid, list[_Image]()
        self._sizes = ImageSizes(self._view, grid, self._side, self._passes, self._step)
        for number in range(self._passes):
            u = (np.array([(number + 0.5) * EVEN[0], (number + 0.5) * EVEN[1]]) % 1)[:, None]
            time = np.array([(number + 0.5) / self._passes])
            self._follow(self._first(u, time), float(time[0]), self._deepest)
        return self._images

    def _added(self, grid: CellGrid, images: list[_Image]) -> Chances:
        """What images tell of all pixels."""
        chances = Chances.none(self._view.height, self._view.width)
        for image in images:
            mean = np.sqrt(image.square * image.chance)
            grid.add(chances.mean, image.cells, mean / self._passes)
            grid.add(chances.square, image.cells, image.square / self._passes)
        return chances

    def _first(self, u: Floats64, time: Floats64) -> Front:
        grid = self._grid
        y, x = (grid.corners + grid.side / 2).reshape(2, -1)
        eye, on_lens = self._view.eyes(u, time)
        way = self._view.through(x, y, on_lens[:, 0])
        way /= np.sqrt((way * way).sum(axis=0))
        n = grid.size
        origin = np.repeat(eye, n, axis=1)
        return Front(origin, way, np.ones(n), np.zeros(n), np.zeros(n, np.intp), np.zeros(n))

    def _follow(self, front: Front, time: float, left: int) -> None:
        """Follow rays to what they meet, and on from there."""
        alive = np.flatnonzero(front.square > 0)
        if not len(alive):
            return
        times = np.full(len(alive), time)
        found = nearest(self._world, front.origin[:, alive], front.way[:, alive], times)
        self._rays += len(alive)
        toward = front.way[:, alive].astype(np.float32)
        hits = Surface.hits(self._world.surface, found, toward)
        material = hits.material.astype(np.intp)
        sent = np.flatnonzero(self._surfaces.sends_on.take(material))
        if not len(sent):
            return
        ray = np.arange(len(alive)) if hits.ray is None else hits.ray
        which = alive[ray[sent]]
        if not left:
            if self._deeper:
                self.cut_short.update(np.unique(material[sent]).tolist())
            return
        at = front.origin[:, which] + front.way[:, which] * hits.t[sent]
        part = self._parts.take(hits.triangle[sent])
        normal = hits.ns[:, sent].astype(np.float64)
        geometric = hits.ng[:, sent].astype(np.float64)
        surface = self._world.surface
        if isinstance(surface, FullSurface) and surface.relief is not None:
            # Rays ahead see what is bumpy as smooth.
            bumpy = surface.relief.maps.row.take(hits.triangle[sent]) != NOT_PAINTED
            self.cut_short.update(np.unique(material[sent][bumpy]).tolist())
        leaving = self._surfaces.onward(
            material[sent], front.way[:, which], normal, hits.entering[sent]
        )
        for number, on in enumerate(leaving):
            side = 1 if number == 0 else -1
            offset = side * geometric * hits.offset[sent]
            new = scattered(
                front, which, at + offset, on, part * 2 + number, hits.t[sent].astype(np.float64)
            )
            self._look(Arrival(front, new, which, on, normal, material[sent], time))
            blunt = on.blur + on.alpha**2 > SHARP
            new.square[which[blunt]] = 0
            if self._deepest > 1 and blunt.any() and np.count_nonzero(self._surfaces.sends_on) > 1:
                self.cut_short.update(np.unique(material[sent][blunt]).tolist())
            self._follow(new, time, left - 1)

    def _look(self, arrival: Arrival) -> None:
        """Add the chances that rays which have come to a surface meet things next."""
        after, which = arrival.after, arrival.which
        for number, (thing, points, normals) in enumerate(self._things):
            if number not in self._wanted:
                continue
            both = self._both(arrival.material, thing)
            found = np.zeros((2, points.shape[1], len(which)))
            sharp = np.zeros(len(which), np.bool_)
            for row in range(points.shape[1]):
                place = points[:, row : row + 1] + thing.velocity[:, None] * arrival.time
                facing = None if normals is None else normals[:, row : row + 1]
                *found[:, row], narrow = self._sizes.chance(arrival, place, facing, thing, both)
                sharp |= narrow
            total, squared = np.minimum(found.sum(axis=1) * thing.area / points.shape[1], 1)
            squared = np.maximum(squared, total**2)
            chance = np.divide(total**2, squared, out=np.ones_like(total), where=squared > 0)
            square = squared * after.square[which] * thing.square
            some = (square > FAINT * self._target) & ~(both & (chance > MET))
            # No ray meets it.
            some = np.flatnonzero(some & both if normals is None else some)
            for image in by_surfaces(after.key[which[some]]):
                mine = some[image]
                if self._grid.coarse and is_found(np.repeat(chance[mine], self._side**2)):
                    continue
                arrays = chance[mine], square[mine], sharp[mine], after.origin[:, which[mine]]
                self._images.append(_Image(which[mine], *arrays, number, arrival.time))

    def _both(self, material: Indices, thing: Bright) -> Mask:
        """(n,) at which of the hits a thing is found by its points, too, for lamps and lobes are sampled together."""
        both = self._world.combining
        if both is not None and thing.part == NO_PART:
            return np.asarray(both.is_metal.take(material))
        if both is None or all(lamp.material != thing.material for lamp in both.lamps):
            return np.zeros(len(material), np.bool_)
        return np.asarray(both.is_glossy.take(material))

    def _is_seen(self, image: _Image) -> Mask:
        """(n,) from where a point of the thing is seen: asked of some cells, which speak for those after them."""
        thing, points, _ = self._things[image.thing]
        step = -(-len(image.cells) // ASKED)
        origin, cells = image.origin[:, ::step], image.cells[::step]
        self._rays += len(cells)
        place = points[:, cells % points.shape[1]] + thing.velocity[:, None] * image.time
        found = nearest(self._world, origin, place - origin, np.full(len(cells), image.time))
        seen = (found.triangle >= 0) & (self._parts.take(found.triangle) == thing.part)
        if thing.part == NO_PART:
            seen = (found.triangle < 0) | (found.t > 1 - BESIDE)
        return np.repeat(seen, step)[: len(image.cells)]
