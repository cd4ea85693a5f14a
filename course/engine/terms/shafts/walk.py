"""What is in a shaft: the space of all ways from a cell to a light (Haines and Wallace, "Shaft culling for efficient
ray-cast radiosity", 1991).

A shaft has planes with all of it on one side: eight around its axis, one at each end, and that of the surface which
the ways leave. What lies beyond one of them is not in the shaft; nor is a triangle whose own plane has all of the shaft
on one side. If nothing is left, no way is blocked. Everything is computed in float64, with room for what float32 and a
caster err by.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats64, Indices, Mask
from course.engine.core.vectors import cross
from course.engine.terms.shafts.boxes import BRANCH, LEAF, Boxes
from course.engine.terms.shafts.cells import Cells, Keys, place_of
from course.engine.terms.shafts.lamps import LampRegion

CLEAR, MIXED, CUT_OFF = 1, 2, 3
"""No way is blocked; some may be; all are."""

AROUND = 8
PLANES = AROUND + 3
OWN = PLANES - 1
"""Planes around the axis, all of them, and the number of the surface's."""

ORDER = (0, 4, 2, 6, OWN, AROUND + 1, AROUND, 1, 3, 5, 7)
"""In which planes are tried: opposite ones first."""

TURNS = np.array(
    [(math.cos(math.tau * k / AROUND), math.sin(math.tau * k / AROUND)) for k in range(AROUND)]
)

CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
"""Of a box, in halves of its widths."""

LEAVE = 0.8
"""Share of the distance by which rays leave surfaces that is trusted."""

STEEPEST = 0.95
"""Of planes around the axis, the sine of their slope at most."""

MOST = 16
"""Boxes of a level that a shaft may meet before it is given up."""

TOGETHER = 2048
"""Cells whose shafts are looked at together: their arrays stay in the second-level cache."""


def shaft_states(cells: Cells, boxes: Boxes, lamp: LampRegion, keys: Keys) -> NDArray[np.int8]:
    """CLEAR, MIXED or CUT_OFF for the shafts of cells (n,) to a light."""
    states = np.empty(len(keys), np.int8)
    for first in range(0, len(keys), TOGETHER):
        some = slice(first, first + TOGETHER)
        states[some] = _states(_Shafts(cells, boxes, lamp, keys[some]), boxes)
    return states


def along(a: Floats64, b: Floats64) -> Floats64:
    """Products (n,) of vectors (3, n), or (3,)."""
    product: Floats64 = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


def reach_of(lamp: LampRegion, normal: Floats64) -> Floats64:
    """How far a lamp reaches from its middle along unit vectors (3, n)."""
    a, b, c = (np.abs(along(edge, normal)) for edge in lamp.half)
    reach: Floats64 = a + b + c + lamp.radius
    return reach


class _Shafts:
    """The shafts of n cells, whose ends are boxes around ``begin`` and shapes around ``end``, (3, n) each."""

    def __init__(self, cells: Cells, boxes: Boxes, lamp: LampRegion, keys: Keys) -> None:
        owner, back, self.begin, self.half = place_of(cells, keys)
        self.first, self.last = cells.first[owner], cells.last[owner]
        around = boxes.boxes[-1].astype(np.float64)
        self.lamp = lamp
        if lamp.far:
            # No two places are so far apart.
            self.end = self.begin + 6 * np.abs(around).max() * lamp.middle[:, None]
        else:
            self.end = np.repeat(lamp.middle[:, None], len(keys), axis=1)
        self.normal = np.empty((PLANES, 3, len(keys)))
        self.height = np.empty((PLANES, len(keys)))
        way = self.end - self.begin
        length = np.sqrt(along(way, way))
        axis = way / length
        sign = np.copysign(1.0, axis[2])
        q = -1 / (sign + axis[2])
        r = axis[0] * axis[1] * q
        across = np.stack((1 + sign * axis[0] * axis[0] * q, sign * r, -sign * axis[0]))
        down = np.stack((r, sign + axis[1] * axis[1] * q, -axis[1]))
        for k, (cosine, sine) in enumerate(TURNS):
            outwards = cosine * across + sine * down
            normal = outwards
            for _ in range(2):
                slope = (self.near(normal) - self.far(normal)) / length
                slope = np.minimum(np.maximum(slope, -STEEPEST), STEEPEST)
                normal = np.sqrt(1 - slope * slope) * outwards + slope * axis
            self._add(k, normal)
        self._add(AROUND, axis)
        self._add(AROUND + 1, -axis)
        plane = cells.plane[owner].T * np.where(back > 0, -1.0, 1.0)
        flat = along(plane, plane) > 0
        self.normal[OWN] = -plane[:3]
        self.height[OWN] = np.where(flat, -plane[3] - LEAVE * cells.leave[owner, 0], np.inf)

    def near(self, normal: Floats64) -> Floats64:
        """How far the beginnings reach from their middle along unit vectors (3, n)."""
        reach: Floats64 = along(self.half, np.abs(normal))
        return reach

    def far(self, normal: Floats64) -> Floats64:
        """The same of the ends."""
        return self.near(normal) if self.lamp.far else reach_of(self.lamp, normal)

    def _add(self, number: int, normal: Floats64) -> None:
        self.normal[number] = normal
        near = along(self.begin, normal) + self.near(normal)
        self.height[number] = np.maximum(near, along(self.end, normal) + self.far(normal))


def _states(shafts: _Shafts, boxes: Boxes) -> NDArray[np.int8]:
    cell, triangle, many = _met(shafts, boxes)
    cell, triangle = _inside(shafts, boxes, *_foreign(shafts, boxes, cell, triangle))
    corners, sweep, room = _of(boxes, triangle)
    beside, between = _beside(shafts, cell, corners, sweep, room)
    states = np.where(many, MIXED, CLEAR).astype(np.int8)
    states[cell.compress(~beside)] = MIXED
    some = np.flatnonzero(between)
    cell = cell.take(some)
    cut = _cut_off(shafts, cell, corners.take(some, axis=2), room.take(some))
    states[cell.compress(cut)] = CUT_OFF
    return states


def _foreign(
    shafts: _Shafts, boxes: Boxes, cell: Indices, triangle: Indices
) -> tuple[Indices, Indices]:
    """Pairs of cells and triangles that aren't those of the cell's solid owner."""
    number = boxes.number[triangle]
    some = np.flatnonzero((number < shafts.first[cell]) | (number >= shafts.last[cell]))
    return cell.take(some), triangle.take(some)


def _of(boxes: Boxes, triangle: Indices) -> tuple[Floats64, Floats64, Floats64]:
    """Corners (3, 3, m), sweep (3, m) and room (m,) of triangles."""
    corners = boxes.corners[triangle].astype(np.float64).T.reshape(3, 3, -1)
    sweep = np.zeros((3, len(triangle)))
    if len(boxes.sweep):
        sweep = boxes.sweep[triangle].astype(np.float64).T
    return corners, sweep, boxes.room[triangle].astype(np.float64)


def _inside(
    shafts: _Shafts, boxes: Boxes, cell: Indices, triangle: Indices
) -> tuple[Indices, Indices]:
    """Those of pairs of cells and triangles that no plane of the shaft parts."""
    corners, sweep, room = _of(boxes, triangle)
    for k in ORDER:
        normal = shafts.normal[k].take(cell, axis=1)
        heights = [along(corner, normal) for corner in corners]
        least = np.minimum(np.minimum(heights[0], heights[1]), heights[2])
        if len(boxes.sweep):
            least = least + np.minimum(along(sweep, normal), 0)
        beyond = least > shafts.height[k].take(cell) + (0.5 if k == OWN else 1.0) * room
        some = np.flatnonzero(~beyond)
        cell, triangle, room = cell.take(some), triangle.take(some), room.take(some)
        corners, sweep = corners.take(some, axis=2), sweep.take(some, axis=1)
    return cell, triangle


def _met(shafts: _Shafts, boxes: Boxes) -> tuple[Indices, Indices, Mask]:
    """Pairs of cells and triangles of leaves that their shafts may meet; and cells that meet too many boxes."""
    low, high = boxes.boxes[:, :3].astype(np.float64), boxes.boxes[:, 3:].astype(np.float64)
    cell = np.arange(shafts.begin.shape[1])
    number, many = np.zeros(len(cell), np.intp), np.zeros(len(cell), np.bool_)
    for level in range(len(boxes.level) - 2, -1, -1):
        # What a solid owner has by itself is no obstacle.
        least, most = boxes.numbers[number + boxes.level[level]].T
        some = np.flatnonzero((least < shafts.first[cell]) | (most >= shafts.last[cell]))
        cell, number = cell.take(some), number.take(some)
        box = number + boxes.level[level]
        middle, half = ((low + high) / 2)[box].T, ((high - low) / 2)[box].T
        for k in ORDER:
            normal = shafts.normal[k].take(cell, axis=1)
            least = along(middle, normal) - along(half, np.abs(normal))
            some = np.flatnonzero(~(least > shafts.height[k].take(cell)))
            cell, number = cell.take(some), number.take(some)
            middle, half = middle.take(some, axis=1), half.take(some, axis=1)
        many |= np.bincount(cell, minlength=len(many)) > MOST
        few = np.flatnonzero(~many.take(cell))
        cell, number = cell.take(few), number.take(few)
        width = BRANCH if level else LEAF
        end = boxes.level[level] - boxes.level[level - 1] if level else len(boxes.number)
        first = (number if level else boxes.leaf[number]) * width
        number = (first[:, None] + np.arange(width)).ravel()
        cell = np.repeat(cell, width)
        there = np.flatnonzero(number < end)
        cell, number = cell.take(there), number.take(there)
    return cell, number, many


def _beside(
    shafts: _Shafts, cell: Indices, corners: Floats64, sweep: Floats64, room: Floats64
) -> tuple[Mask, Mask]:
    """Triangles whose planes have all of a shaft on one side, and those whose planes lie between its ends."""
    normal: Any = cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = normal / np.sqrt(along(normal, normal))
    moved = along(sweep, normal)
    height = along(corners[0], normal)
    least, most = height + np.minimum(moved, 0) - room, height + np.maximum(moved, 0) + room
    begin = along(shafts.begin.take(cell, axis=1), normal)
    end = along(shafts.end.take(cell, axis=1), normal)
    half = shafts.half.take(cell, axis=1)
    near = along(half, np.abs(normal))
    far = near if shafts.lamp.far else reach_of(shafts.lamp, normal)
    # Rays end before they have gone all of the way.
    rest = 1 - shafts.lamp.limit
    low, high = begin - near, begin + near
    low_end = shafts.lamp.limit * (end - far) + rest * low
    high_end = shafts.lamp.limit * (end + far) + rest * high
    beside = (np.minimum(low, low_end) > most) | (np.maximum(high, high_end) < least)
    between = (low > most) & (high_end < least) | (high < least) & (low_end > most)
    return beside, between & (moved == 0)


def _volume(p: Floats64, q: Floats64, begin: Floats64, end: Floats64) -> tuple[Floats64, Floats64]:
    """Six times the volume (m,) of tetrahedra by an edge from p to q and a way, and how it grows (3, m) with its end.

    Its sign tells on which side the way passes the edge.
    """
    turn: Any = cross(p - begin, q - begin)
    return along(turn, end - begin), turn


def _cut_off(shafts: _Shafts, cell: Indices, corners: Floats64, room: Floats64) -> Mask:
    """Which triangles all ways of a shaft go through, where the shaft's ends lie on either side of their planes.

    Volumes are linear in each end of the way, so they are least and most where the ends are corners.
    """
    begin, half = shafts.begin.take(cell, axis=1), shafts.half.take(cell, axis=1)
    end, lamp = shafts.end.take(cell, axis=1), shafts.lamp
    way = end - begin
    longest = np.sqrt(along(way, way)) + half.sum(axis=0)
    longest = longest + (
        half.sum(axis=0) if lamp.far else float(np.abs(lamp.half).sum()) + lamp.radius
    )
    left = right = np.ones(len(cell), np.bool_)
    for k in range(3):
        edge = corners[k - 2] - corners[k]
        least = 2 * room * np.sqrt(along(edge, edge)) * longest
        for signs in CORNERS:
            volume, turn = _volume(corners[k], corners[k - 2], begin + half * signs[:, None], end)
            if lamp.far:
                reach = along(half, np.abs(turn))
            else:
                a, b, c = (np.abs(along(edge, turn)) for edge in lamp.half)
                reach = a + b + c + lamp.radius * np.sqrt(along(turn, turn))
            left = left & (volume - reach > least)
            right = right & (volume + reach < -least)
    return left | right
