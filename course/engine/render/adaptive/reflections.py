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
from course.engine.render.adaptive.bright import EVEN, Bright
from course.engine.render.adaptive.glimpses import Chances, important, is_found
from course.engine.render.adaptive.lobes_ahead import Onward, Surfaces, facets_density
from course.engine.render.adaptive.seen_ahead import CameraAxes, nearest
from course.engine.terms.world import FullWorld

BLOCKS = 8192
"""Rays that are sent through a picture at most."""

SMALLEST = 4
"""Pixels along an edge of a block at least."""

DEEPEST = 3
"""Surfaces after which a ray is followed no further."""

POINTS, EACH = 64, 4
"""Points on all things together, about, and on one of them at most."""

PASSES = 2
"""Places on the lens and times, where there are such."""

ASKED = 64
"""Cells of an image, about, from which rays are sent to see whether something hides it."""

FAINT = 0.02
"""Of the variance that is aimed at, what a sample of a pixel may have for which nothing is looked at."""

SHARP = 0.01
"""Variance of the angle from which on what mirrors shows nothing that is followed further [rad^2]."""

FINEST, FEWEST = 0.25, 2048
"""Rays of the second look, four through each pixel of blocks in which an image may be: at most so many for each pixel
of the picture, or so many in all."""

BESIDE = 1 / 64
"""A pixel may see of a thing so much of what the pixels next to it see: images are known to a tenth of one."""

_ALL, _LOW, _HIGH = slice(None), slice(None, -1), slice(1, None)
NEXT = ((_ALL, _LOW, _ALL), (_ALL, _HIGH, _ALL)), ((_ALL, _ALL, _LOW), (_ALL, _ALL, _HIGH))
"""Cells of a grid and those that are next to them, along both axes."""

UNKNOWN = 2.0
"""Where no next block sends its ray the same way, the ways change by so many times the angle of a block."""


@dataclass(frozen=True)
class _Grid:
    """Square cells of the picture, in blocks of rows and columns.

    Attributes
    ----------
    corners : (2, *shape), row and column of each cell's upper left corner [pixels]
    side : of a cell [pixels]
    """

    corners: Floats64
    side: float
    shape: tuple[int, int, int]

    @property
    def size(self) -> int:
        """Number of cells."""
        return int(np.prod(self.shape))

    @property
    def coarse(self) -> bool:
        """Whether cells are larger than pixels."""
        return self.side > 1

    def add(self, picture: Floats64, cells: Indices, values: Floats64) -> None:
        """Add values (n,) of some cells to the pixels (H, W) that they are or that they lie in."""
        rows, columns = np.floor(self.corners.reshape(2, -1)[:, cells]).astype(np.intp)
        share = min(self.side, 1) ** 2
        for down in range(max(int(self.side), 1)):
            for right in range(max(int(self.side), 1)):
                y, x = rows + down, columns + right
                inside = (y < picture.shape[0]) & (x < picture.shape[1])
                np.add.at(picture, (y[inside], x[inside]), share * values[inside])


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


@dataclass(frozen=True)
class _Front:
    """Rays of all blocks at one depth, n of them in rows of the picture's blocks.

    Attributes
    ----------
    origin, way : (3, n)
    square : (n,) mean square of what they bring; 0 for rays that are no more
    blur : (n,) variance of their angle
    key : (n,) by which surfaces they have come
    depth : (n,) length of the way so far
    """

    origin: Floats64
    way: Floats64
    square: Floats64
    blur: Floats64
    key: Indices
    length: Floats64


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
        self._things = [(thing, *thing.points(world, u)) for thing in things]
        self._wanted = set(range(len(things)))
        self._rays = 0
        moves = any(thing.velocity.any() for thing in things) or view.velocity.any()
        self._passes = PASSES if view.aperture or moves else 1
        self._step = 1 / self._passes if moves else 0.0
        self.cut_short: set[int] = set()
        """Materials at which rays weren't followed further."""

    def chances(self) -> Chances:
        """Of all pixels."""
        height, width = self._view.height, self._view.width
        if not (self._surfaces.sends_on.any() and self._things and self._deepest):
            return Chances.none(height, width)
        corners = np.indices((self._rows, self._columns)).reshape(2, -1, 1, 1) * self._side
        shape = 1, self._rows, self._columns
        grid = _Grid(corners.reshape(2, *shape).astype(np.float64), self._side, shape)
        images = self._send(grid)
        pixels = self._side**2 / self._passes
        left = np.array([pixels * image.square.sum() for image in images])
        kept = [images[number] for number in important(left, self._target * height * width)]
        kept = [image.part(self._is_seen(image)) for image in kept]
        left = np.array([pixels * image.square.sum() for image in kept])
        if not len(important(left, self._target * height * width)):
            return replace(Chances.none(height, width), rays=self._rays)
        blurred = self._added(grid, [image.part(~image.sharp) for image in kept])
        sharp = np.zeros(grid.size)
        for image in kept:
            np.maximum.at(sharp, image.cells[image.sharp], image.square[image.sharp])
        chosen, cells = np.flatnonzero(sharp), 2 * self._side
        most = max(int(FINEST * height * width), FEWEST) // cells**2
        if len(chosen) > most:
            chosen = np.sort(chosen[np.argsort(-sharp[chosen], kind="stable")][:most])
        if not len(chosen):
            return replace(blurred, rays=self._rays)
        within = np.indices((cells, cells)) / 2
        places = corners.reshape(2, -1)[:, chosen, None, None] + within[:, None]
        grid = _Grid(places, 0.5, (len(chosen), cells, cells))
        self._wanted = {image.thing for image in kept if image.sharp.any()}
        images = [image.part(image.sharp) for image in self._send(grid) if image.sharp.any()]
        close = self._added(grid, [image.part(self._is_seen(image)) for image in images])
        return blurred + Chances(_spread(close.mean), _spread(close.square), self._rays)

    def _send(self, grid: "_Grid") -> "list[_Image]":
        """Send rays through all cells; returns the images that they find."""
        self._grid, self._images = grid, list[_Image]()
        self._angle = grid.side * np.sqrt(self._view.pixel)
        for number in range(self._passes):
            u = (np.array([(number + 0.5) * EVEN[0], (number + 0.5) * EVEN[1]]) % 1)[:, None]
            time = np.array([(number + 0.5) / self._passes])
            self._follow(self._first(u, time), float(time[0]), self._deepest)
        return self._images

    def _added(self, grid: "_Grid", images: "list[_Image]") -> Chances:
        """What images tell of all pixels."""
        chances = Chances.none(self._view.height, self._view.width)
        for image in images:
            mean = np.sqrt(image.square * image.chance)
            grid.add(chances.mean, image.cells, mean / self._passes)
            grid.add(chances.square, image.cells, image.square / self._passes)
        return chances

    def _first(self, u: Floats64, time: Floats64) -> _Front:
        grid = self._grid
        y, x = (grid.corners + grid.side / 2).reshape(2, -1)
        eye, on_lens = self._view.eyes(u, time)
        way = self._view.through(x, y, on_lens[:, 0])
        way /= np.sqrt((way * way).sum(axis=0))
        n = grid.size
        origin = np.repeat(eye, n, axis=1)
        return _Front(origin, way, np.ones(n), np.zeros(n), np.zeros(n, np.intp), np.zeros(n))

    def _follow(self, front: _Front, time: float, left: int) -> None:
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
        leaving = self._surfaces.onward(
            material[sent], front.way[:, which], normal, hits.entering[sent]
        )
        for number, on in enumerate(leaving):
            side = 1 if number == 0 else -1
            offset = side * geometric * hits.offset[sent]
            new = _scattered(
                front, which, at + offset, on, part * 2 + number, hits.t[sent].astype(np.float64)
            )
            self._look(front, new, which, on, normal, material[sent], time)
            blunt = on.blur + on.alpha**2 > SHARP
            new.square[which[blunt]] = 0
            if blunt.any() and np.count_nonzero(self._surfaces.sends_on) > 1:
                self.cut_short.update(np.unique(material[sent][blunt]).tolist())
            self._follow(new, time, left - 1)

    def _look(
        self,
        before: _Front,
        new: _Front,
        which: Indices,
        on: Onward,
        normal: Floats64,
        material: Indices,
        time: float,
    ) -> None:
        """Add the chances that rays, of which those of blocks ``which`` are there, meet things next."""
        for number, (thing, points, normals, _) in enumerate(self._things):
            if number not in self._wanted:
                continue
            looked_for = self._looked_for(material, thing)
            chance = np.zeros((points.shape[1], len(which)))
            sharp = np.zeros(len(which), np.bool_)
            for row in range(points.shape[1]):
                place = points[:, row : row + 1] + thing.velocity[:, None] * time
                chance[row], narrow = self._chance(
                    before, new, which, on, normal, place, normals[:, row : row + 1], thing
                )
                sharp |= narrow
            total = np.minimum(chance.sum(axis=0) * thing.area / points.shape[1], 1)
            square = total * new.square[which] * thing.square
            some = np.flatnonzero((square > FAINT * self._target) & ~looked_for)
            for image in _images(new.key[which[some]]):
                mine = some[image]
                if self._grid.coarse and is_found(np.repeat(total[mine], self._side**2)):
                    continue
                arrays = total[mine], square[mine], sharp[mine], new.origin[:, which[mine]]
                self._images.append(_Image(which[mine], *arrays, number, time))

    def _chance(
        self,
        before: _Front,
        new: _Front,
        which: Indices,
        on: Onward,
        normal: Floats64,
        place: Floats64,
        facing: Floats64,
        thing: Bright,
    ) -> tuple[Floats64, Mask]:
        """Of a unit of area around a place (3, 1) on a thing, of each ray (n,), and where a block blurs most."""
        way = place - new.origin
        far = np.maximum(np.sqrt((way * way).sum(axis=0)), 1e-12)
        way /= far
        cos = -(way * facing).sum(axis=0)
        cos = np.maximum(cos, 0) if thing.fronts else np.abs(cos)
        apart = new.way - way
        steps = self._steps(apart, new)
        length = new.length + far
        defocus = 0.0
        if self._view.camera.lens is not None:
            blur = self._view.aperture * np.abs(
                1 / self._view.camera.lens.focus_distance - 1 / length
            )
            defocus = (blur / self._angle) ** 2 * steps / (4 * self._passes)
        moved = float((thing.velocity**2).sum()) * self._step**2 / (12 * far**2)
        size = thing.area / (4 * np.pi * EACH * far**2)
        others = (defocus + moved + size + new.blur)[which]
        others[on.alpha > 0] += on.alpha[on.alpha > 0] ** 2
        block = steps[which] / 4
        # As it would be in the blocks of the first rays, so that both tell the same.
        sharp = block * (self._side / self._grid.side) ** 2 > others
        width = block + (defocus + moved + size + new.blur)[which]
        away = (apart[:, which] ** 2).sum(axis=0)
        dense = np.exp(-away / (2 * width)) / (2 * np.pi * width)
        rough = np.flatnonzero(on.alpha > 0)
        if len(rough):
            alpha = np.sqrt(on.alpha[rough] ** 2 + (width - new.blur[which])[rough] / 2)
            ways = before.way[:, which[rough]], way[:, which[rough]], normal[:, rough]
            dense[rough] = facets_density(*ways, np.minimum(alpha, 1))
        result: Floats64 = dense * (cos / far**2)[which]
        return result, sharp

    def _steps(self, apart: Floats64, new: _Front) -> Floats64:
        """The larger of the squared changes (n,) of what is apart (3, n) from block to block, along either axis."""
        shape = self._grid.shape
        field, key = apart.reshape(3, *shape), new.key.reshape(shape)
        result = np.full(shape, -1.0)
        for first, second in NEXT:
            step = ((field[:, *first] - field[:, *second]) ** 2).sum(axis=0)
            step[key[first] != key[second]] = np.inf
            # Of the two neighbours along an axis the nearer one: beyond the other may lie another face.
            near = np.full(shape, np.inf)
            for part in (first, second):
                near[part] = np.minimum(near[part], step)
            result = np.maximum(result, np.where(np.isinf(near), -1, near))
        return np.where(result >= 0, result, (UNKNOWN * self._angle) ** 2).ravel()

    def _looked_for(self, material: Indices, thing: Bright) -> Mask:
        """(n,) at which of the hits lamps and lobes are sampled together, so that a thing is found by its points."""
        both = self._world.combining
        if both is None or all(lamp.material != thing.material for lamp in both.lamps):
            return np.zeros(len(material), np.bool_)
        return np.asarray(both.is_glossy.take(material))

    def _is_seen(self, image: "_Image") -> Mask:
        """(n,) from where a point of the thing is seen: asked of some cells, which speak for those after them."""
        thing, points, _, _ = self._things[image.thing]
        step = -(-len(image.cells) // ASKED)
        origin, cells = image.origin[:, ::step], image.cells[::step]
        self._rays += len(cells)
        place = points[:, cells % points.shape[1]] + thing.velocity[:, None] * image.time
        found = nearest(self._world, origin, place - origin, np.full(len(cells), image.time))
        seen = (found.triangle >= 0) & (self._parts.take(found.triangle) == thing.part)
        return np.repeat(seen, step)[: len(image.cells)]


def _images(key: Indices) -> list[Indices]:
    """Rays (n,) by the surfaces that they have come by."""
    order = np.argsort(key, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(key[order])) + 1) if len(key) else []


def _scattered(
    front: _Front, which: Indices, origin: Floats64, on: Onward, surface: Indices, far: Floats64
) -> _Front:
    """Rays that go on from surfaces; the others are no more."""
    n = len(front.square)
    new = _Front(
        np.zeros((3, n)), np.zeros((3, n)), np.zeros(n), np.zeros(n), np.full(n, -1), np.zeros(n)
    )
    new.origin[:, which], new.way[:, which] = origin, on.way
    new.square[which] = front.square[which] * on.square
    new.blur[which] = front.blur[which] + on.blur
    new.key[which] = front.key[which] * 1000003 + surface + 1
    new.length[which] = front.length[which] + far
    return new


def _spread(values: Floats64) -> Floats64:
    """Values (H, W), none below a BESIDE of the largest next to it."""
    height, width = values.shape
    padded = np.pad(values, 1)
    largest = np.max([padded[y : y + height, x : x + width] for y in range(3) for x in range(3)], 0)
    result: Floats64 = np.maximum(values, BESIDE * largest)
    return result
