"""Cells on the surfaces of a scene: hits in one cell share their shafts to the lights.

A cell is a cube of space as far as one owner fills it. Owners are flat objects, convex ones, and large triangles of
others: what leaves an owner outwards can't meet it again. Cubes are as large as some pixels of the camera look there,
so a cell has enough hits to be worth looking at, wherever the rays come from that find them.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from course.engine.core.camera import Camera
from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats32, Floats64, Indices, Mask, Numbers
from course.engine.core.vectors import cross, dot
from course.engine.terms.shafts.boxes import Boxes

FINEST = 14
"""Cubes are at least 2^-14 of the scene's size wide: so many bits of a key has each coordinate."""

MOST_OWNERS = 1 << 15

ALIKE, FLAT = 0.999, 0.25
"""Cosine between normals of a flat object, at least; and height by which its corners may miss its plane, at most, as a
share of the distance by which rays leave it."""

SMALL = 4.0
"""Share of the area of a cube's side there that a triangle has at least to own cells."""

ROOM = 2.0**-20
"""Room for the rounding of rays, as a share of the scene's largest coordinate: several times what float32 needs."""

OUTSIDE = np.int64(-1)
"""The key of a hit that lies in no cell."""

Keys = NDArray[np.int64]


class Cells(NamedTuple):
    """Where cells are, and whose they are.

    Attributes
    ----------
    owner : (T, 2) int32, of the front and the back of each triangle, movers' too: twice its number, plus 1 on the side
        to which the normal of its plane doesn't point; -1 for none
    low, high : (K, 3) float64, corners of each owner's box, with room for where rays leave it
    plane : (K, 4) float64, unit normal and height of flat owners; 0 for solid ones
    leave : (K, 2) float64, least distance at which rays leave each, and room around where they do
    first, last : (K,) int64, its triangles if it is solid; 0 and 0 for flat ones
    eye : (3,) float32
    corner : (3,) float32, of the cube around the scene
    size : (2,) float32: 1 / its width, and the square of how many cells go along it at distance 1
    """

    owner: Numbers
    low: Floats64
    high: Floats64
    plane: Floats64
    leave: Floats64
    first: Indices
    last: Indices
    eye: Floats32
    corner: Floats32
    size: Floats32


def cells_of(
    boxes: Boxes, triangles: Triangles, still: int, camera: Camera, pixels: float
) -> Cells:
    """The cells of a scene.

    Parameters
    ----------
    still : triangles that don't move; they come first, and only they own cells
    pixels : width of a cell, as the camera sees it
    """
    pixel = float(np.linalg.norm(camera.step_x.astype(np.float64))) * pixels
    corners = _corners(triangles, slice(0, still))
    low, high = bounds(corners)
    around = np.concatenate((low, high, boxes.boxes[-1]))
    room = ROOM * max(float(np.abs(around).max()), 1e-30)
    # Float32 may round corners inwards, by less than the room.
    corner = (low - room).astype(np.float32)
    width = float((high - low).max()) + 3 * room
    owners = _Owners(triangles, room)
    begin, loose = 0, [np.empty(0, np.intp)]
    for _, count, convex in triangles.parts:
        if count > 0 and begin + count <= still and not owners.add_object(begin, count, convex):
            loose.append(np.arange(begin, begin + count))
        begin += count
    owners.add_large(np.concatenate(loose), camera.origin, SMALL * pixel * pixel)
    size = np.array((1 / width, min((width / pixel) ** 2, 1e30)), np.float32)
    columns: tuple[Any, ...] = (*owners.columns(), camera.origin.copy(), corner, size)
    return Cells(owners.number, *columns)


def bounds(corners: NDArray[Any]) -> Floats64:
    """The lowest and the highest corner (2, 3) of some (n, 3)."""
    # Column by column: along rows of three, NumPy takes several times as long.
    return np.array([[way(c) for c in corners.T] for way in (np.min, np.max)], np.float64)


def _corners(triangles: Triangles, which: slice | Indices) -> Floats32:
    """Corners (3 m, 3) of some triangles: all first ones, then the others."""
    p0, edges = triangles.planes[which, :3], triangles.edges[which]
    return np.concatenate((p0, p0 + edges[:, :3], p0 + edges[:, 3:6]))


class _Owners:
    """Owners, as they are found, with ``room`` around them.

    ``number``: see ``Cells.owner``
    """

    def __init__(self, triangles: Triangles, room: float) -> None:
        self._triangles, self._room = triangles, room
        self.number = np.full((len(triangles.planes), 2), -1, np.int32)
        self._count = 0
        self._blocks: list[tuple[NDArray[Any], ...]] = []

    def add_object(self, begin: int, count: int, convex: bool) -> bool:
        """An object owns its triangles if it is flat; it owns their fronts if it is convex. False for others."""
        if self._count == MOST_OWNERS:
            return True
        part = slice(begin, begin + count)
        corners = _corners(self._triangles, part)
        normals = self._triangles.planes[part, 3:6]
        offset = self._triangles.planes[part, 6].astype(np.float64)
        normal, height = normals[0], 0.0
        flat = bool((np.abs(normals @ normal) > ALIKE).all())
        if flat:
            exact = corners.astype(np.float64)
            # The plane through the largest triangle errs the least.
            largest = _twice_areas(exact.reshape(3, -1, 3)).argmax()
            (normal,), (height,) = _planes(exact.reshape(3, -1, 3)[:, [largest]])
            flat = bool(np.abs(exact @ normal - height).max() <= FLAT * offset.min())
        if not (flat or convex):
            return False
        room = 8 * offset.max() + self._room
        self._add(
            *(bounds(corners) + np.array([[-room], [room]])),
            *((*normal, height) if flat else np.zeros(4), (offset.min(), room)),
            (0, 0) if flat else (begin, begin + count),
        )
        if flat:
            self._own_both(part, normals @ normal > 0, self._count - 1)
        else:
            self.number[part, 0] = 2 * (self._count - 1)
        return True

    def add_large(self, loose: Indices, eye: Floats32, least: float) -> None:
        """Triangles that no object owns, and that are large enough, own themselves.

        ``least``: area of the smallest one, at distance 1 from the eye
        """
        p0, edges = self._triangles.planes[loose, :3], self._triangles.edges[loose]
        normal = cross(edges[:, :3].T, edges[:, 3:6].T)
        away = p0 + (edges[:, :3] + edges[:, 3:6]) / 3 - eye
        large = np.sqrt(dot(normal, normal)) / 2 > least * (away * away).sum(axis=1)
        loose = loose.compress(large)[: MOST_OWNERS - self._count]
        if len(loose) == 0:
            return
        corners = _corners(self._triangles, loose).astype(np.float64).reshape(3, -1, 3)
        normals, heights = _planes(corners)
        facing = (normals * self._triangles.planes[loose, 3:6]).sum(axis=1) > 0
        offset = self._triangles.planes[loose, 6].astype(np.float64)
        room = 8 * offset + self._room
        numbers = self._count + np.arange(len(loose))
        self._own_both(loose, facing, numbers)
        self._add(
            *(corners.min(axis=0) - room[:, None], corners.max(axis=0) + room[:, None]),
            np.column_stack((normals, heights)),
            *(np.column_stack((offset, room)), np.zeros((len(loose), 2), np.int64)),
        )

    def _own_both(self, which: slice | Indices, agrees: Mask, numbers: Any) -> None:
        self.number[which, 0] = 2 * numbers + ~agrees
        self.number[which, 1] = 2 * numbers + agrees

    def _add(self, *columns: Any) -> None:
        block = tuple(np.atleast_2d(column) for column in columns)
        self._blocks.append(block)
        self._count += len(block[0])

    def columns(self) -> tuple[Any, ...]:
        """Columns of ``Cells``, from ``low`` to ``last``."""
        if not self._blocks:
            self._add(*(np.zeros((0, wide)) for wide in (3, 3, 4, 2, 2)))
        *arrays, own = (np.concatenate(column) for column in zip(*self._blocks, strict=True))
        first, last = np.ascontiguousarray(own.T.astype(np.int64))
        return *(np.ascontiguousarray(array) for array in arrays), first, last


def _planes(corners: Floats64) -> tuple[Floats64, Floats64]:
    """Unit normals (m, 3) and heights (m,) of the planes through corners (3, m, 3)."""
    normal = cross((corners[1] - corners[0]).T, (corners[2] - corners[0]).T)
    normal = (normal / np.sqrt(np.maximum(dot(normal, normal), 1e-300))).T
    return normal, (normal * corners[0]).sum(axis=1)


def _twice_areas(corners: Floats64) -> Floats64:
    normal = cross((corners[1] - corners[0]).T, (corners[2] - corners[0]).T)
    return np.sqrt(dot(normal, normal))


def keys_of(cells: Cells, p: Floats32, triangle: Numbers, side: Floats32) -> Keys:
    """The cells of hits: keys (n,), OUTSIDE where a hit lies in none.

    Parameters
    ----------
    p : (3, n) float32
    side : (n,) float32, positive on the front
    """
    owner = cells.owner[triangle, np.where(side > 0, 0, 1)]
    x, y, z = (p[c] - cells.eye[c] for c in range(3))
    # Half the exponent of a float32 is the logarithm of a root, rounded down.
    ratio = cells.size[1] / (x * x + y * y + z * z)
    level = np.clip(((ratio.view(np.int32) >> 23) - 127) >> 1, 0, FINEST)
    fine = np.left_shift(1, level).astype(np.float32)
    key = owner.astype(np.int64) << 4 | level
    for c in range(3):
        at = ((p[c] - cells.corner[c]) * cells.size[0] * fine).astype(np.int32)
        key = key << FINEST | at & (1 << FINEST) - 1
    return np.where(owner >= 0, key, OUTSIDE)


def place_of(cells: Cells, key: Keys) -> tuple[Indices, Indices, Floats64, Floats64]:
    """Owner (n,), side (n,) 0 or 1, middle (3, n) and half the widths (3, n) of where rays leave cells."""
    code = key >> (4 + 3 * FINEST)
    owner, cubes = code >> 1, np.left_shift(1, key >> (3 * FINEST) & 15)
    width = 1 / (np.float64(cells.size[0]) * cubes)
    room = cells.leave[owner, 1]
    low, high = np.empty((3, len(key))), np.empty((3, len(key)))
    for c in range(3):
        at = key >> (FINEST * (2 - c)) & ((1 << FINEST) - 1)
        begin = np.float64(cells.corner[c]) + width * at
        low[c] = np.maximum(begin - room, cells.low[owner, c])
        high[c] = np.minimum(begin + width + room, cells.high[owner, c])
    return owner, code & 1, (low + high) / 2, (high - low) / 2
