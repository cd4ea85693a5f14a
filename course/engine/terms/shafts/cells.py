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

FLAT = 2.0**-21
"""Height by which corners may miss the plane of a flat object, as a share of its largest coordinate: a rounding."""

SMALL = 0.25
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
    owner : (T, 2) int32, of the front and the back of each triangle, movers' too: twice its number, plus 1 on the side to which the
        normal of its plane doesn't point; -1 for none
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


def cells_of(boxes: Boxes, triangles: Triangles, still: int, camera: Camera, pixels: float) -> Cells:
    """The cells of a scene.

    Parameters
    ----------
    still : triangles that don't move; they come first, and only they own cells
    pixels : width of a cell, as the camera sees it
    """
    pixel = float(np.linalg.norm(camera.step_x.astype(np.float64))) * pixels
    planes = triangles.planes[:still]
    p0 = planes[:, :3].astype(np.float64)
    e1, e2 = (triangles.edges[:still, at : at + 3].astype(np.float64) for at in (0, 3))
    corners = np.stack((p0, p0 + e1, p0 + e2))
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    reach = float(np.abs((low, high)).max())
    room = ROOM * max(reach, float(np.abs(boxes.boxes[-1]).max()))
    low -= room
    width = float((high - low).max()) + room
    owners = _Owners(planes, corners, room)
    begin = 0
    for _, count, convex in triangles.parts:
        part = slice(begin, min(begin + count, still))
        if part.stop - part.start == count > 0:
            owners.add_object(part, convex)
        begin += count
    distance = np.linalg.norm(p0 + (e1 + e2) / 3 - camera.origin, axis=1)
    owners.add_large(SMALL * (pixel * distance) ** 2)
    most = np.float32(min((width / pixel) ** 2, 1e30))
    size = np.array((1 / width, most), np.float32)
    owner, *arrays = owners.arrays()
    every = np.full((len(triangles.planes), 2), -1, np.int32)
    every[:still] = owner
    return Cells(every, *arrays, camera.origin.copy(), low.astype(np.float32), size)


class _Owners:
    """Owners, as they are found; arrays of the triangles that stand still, and ``room`` around all owners."""

    def __init__(
        self, planes: Floats32, corners: Floats64, room: float
    ) -> None:
        self._offset, self._room = planes[:, 6].astype(np.float64), room
        self._corners = corners
        normal = cross((corners[1] - corners[0]).T, (corners[2] - corners[0]).T)
        self._twice_area = np.sqrt(dot(normal, normal))
        self._normal = (normal / np.maximum(self._twice_area, 1e-300)).T
        self._facing = (self._normal * planes[:, 3:6]).sum(axis=1) > 0
        self._owner = np.full((len(planes), 2), -1, np.int32)
        self._rows: list[tuple[NDArray[Any], ...]] = []

    def add_object(self, part: slice, convex: bool) -> None:
        """An object owns its triangles if it is flat; it owns their fronts if it is convex."""
        if len(self._rows) == MOST_OWNERS:
            return
        corners = self._corners[:, part].reshape(-1, 3)
        largest = part.start + int(self._twice_area[part].argmax())
        normal = self._normal[largest]
        heights = corners @ normal
        height = float(self._corners[0, largest] @ normal)
        if np.abs(heights - height).max() <= FLAT * np.abs(corners).max():
            agrees = (self._normal[part] @ normal > 0) == self._facing[part]
            self._add_flat(np.arange(part.start, part.stop), corners, normal, height, agrees)
        elif convex:
            self._owner[part, 0] = 2 * len(self._rows)
            self._add_row(corners, self._offset[part], np.zeros(4), (part.start, part.stop))

    def add_large(self, least_area: Floats64) -> None:
        """Triangles that no object owns, and that are large enough, own themselves."""
        alone = (self._owner < 0).any(axis=1) & (self._twice_area / 2 > least_area)
        for k in np.flatnonzero(alone)[: MOST_OWNERS - len(self._rows)].tolist():
            kept = self._owner[k, 0]
            normal = self._normal[k]
            height = float(self._corners[0, k] @ normal)
            numbers = np.array([k])
            self._add_flat(numbers, self._corners[:, k], normal, height, self._facing[numbers])
            if kept >= 0:
                self._owner[k, 0] = kept

    def _add_flat(
        self, numbers: Indices, corners: Floats64, normal: Floats64, height: float, agrees: Mask
    ) -> None:
        self._owner[numbers, 0] = 2 * len(self._rows) + ~agrees
        self._owner[numbers, 1] = 2 * len(self._rows) + agrees
        self._add_row(corners, self._offset[numbers], np.array((*normal, height)), (0, 0))

    def _add_row(
        self, corners: Floats64, offset: Floats64, plane: Floats64, own: tuple[int, int]
    ) -> None:
        # Near edges origins are pulled inwards: by two offsets from each of them at most.
        room = 8 * offset.max() + self._room
        low, high = corners.min(axis=0) - room, corners.max(axis=0) + room
        self._rows.append((low, high, plane, np.array((offset.min(), room)), np.array(own)))

    def arrays(self) -> tuple[Any, ...]:
        """Columns of ``Cells``, down to ``last``."""
        columns = zip(*self._rows, strict=True) if self._rows else [()] * 5
        low, high, plane, leave, own = (
            np.array(column).reshape(len(self._rows), wide)
            for column, wide in zip(columns, (3, 3, 4, 2, 2), strict=True)
        )
        first, last = np.ascontiguousarray(own.T.astype(np.int64))
        return self._owner, low, high, plane, leave, first, last


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
