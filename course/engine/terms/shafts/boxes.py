"""Boxes around boxes around triangles, for shafts: what may block rays between two regions.

Triangles are boxed eight at a time, in the order of their meshes, where neighbours follow each other. These boxes are
put in the order of a curve through space (Morton's), and boxed four at a time. So the hierarchy is a few arrays, made
by NumPy in a fraction of the time that a caster takes for its own. Movers have the boxes that they sweep while the
shutter is open.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from course.engine.core.accelerator import Accelerator, StaticAccelerator
from course.engine.core.motion import MovingAccelerator
from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats32, Indices, Numbers
from course.engine.terms.lights.own_lamp import LampAccelerator

LEAF, BRANCH = 8, 4
"""Triangles of a leaf, and boxes in a box."""

_CELLS = 1024
"""Of the curve along each axis."""


class Boxes(NamedTuple):
    """T triangles that may block rays.

    Attributes
    ----------
    corners : (T, 9) float32, at the time 0
    sweep : (T, 3) float32, how far each moves while the shutter is open; (0, 3) if none does
    room : (T,) float32, distance by which a caster's test of it may err
    number : (T,) int32, its number among all triangles of the scene
    leaf : (L,) int32, in the order of the leaves, of which eight triangles each is made
    boxes : (B, 6) float32, lowest and highest corners with that room: leaves first, the one around all last
    numbers : (B, 2) int32, the least and the largest number of a triangle in each
    level : (levels + 1,) at which box each level begins, and B
    """

    corners: Floats32
    sweep: Floats32
    room: Floats32
    number: Numbers
    leaf: Numbers
    boxes: Floats32
    numbers: Numbers
    level: Indices


@dataclass(frozen=True)
class _Some:
    """Triangles of an accelerator: their corners, numbers in the scene, and motion."""

    corners: Floats32
    number: Indices
    sweep: Floats32


def boxes_of(accelerator: Accelerator, triangles: Triangles) -> Boxes | None:
    """The triangles that may block shadow rays; None for an accelerator of another kind, or one without triangles."""
    static: Accelerator = accelerator
    groups: list[_Some] = []
    if isinstance(accelerator, MovingAccelerator):
        static = accelerator.static
        for mover in accelerator.movers:
            inner = mover.accelerator
            numbers = np.arange(mover.first, mover.last)
            groups.append(_some(inner.vertices, inner.triangles, numbers, mover.velocity))
    if not isinstance(static, StaticAccelerator):
        return None
    numbers, blocking = np.arange(len(static.triangles)), static
    if isinstance(static, LampAccelerator):
        numbers, blocking = static.kept, static.others
    still = np.zeros(3, np.float32)
    groups.insert(0, _some(blocking.vertices, blocking.triangles, numbers, still))
    corners = np.concatenate([group.corners for group in groups])
    if len(corners) == 0:
        return None
    number = np.concatenate([group.number for group in groups]).astype(np.int32)
    sweep = np.concatenate([group.sweep for group in groups])
    return _boxed(corners, number, sweep, triangles.planes[number, 6])


def _some(vertices: Floats32, triangles: Numbers, numbers: Indices, velocity: Floats32) -> _Some:
    corners = vertices[triangles].reshape(-1, 9)
    return _Some(corners, numbers, np.broadcast_to(velocity, (len(corners), 3)))


def _boxed(corners: Floats32, number: Numbers, sweep: Floats32, room: Floats32) -> Boxes:
    low = np.minimum(np.minimum(corners[:, :3], corners[:, 3:6]), corners[:, 6:])
    high = np.maximum(np.maximum(corners[:, :3], corners[:, 3:6]), corners[:, 6:])
    moves = bool(sweep.any())
    if moves:
        low, high = low + np.minimum(sweep, 0), high + np.maximum(sweep, 0)
    # A float32 sum may round inwards, by less than a tenth of this room.
    wide = np.float32(1.25) * room[:, None]
    begins = np.arange(0, len(corners), LEAF)
    rows = [np.minimum.reduceat(low - wide, begins), np.minimum.reduceat(-high - wide, begins)]
    spans = [ways.reduceat(number, begins) for ways in (np.minimum, np.maximum)]
    leaf = _along_curve(rows[0] - rows[1])
    boxes, level = _levels(np.concatenate(rows, axis=1)[leaf])
    numbers, _ = _levels(np.stack((spans[0], -spans[1]), axis=1)[leaf])
    boxes[:, 3:] *= -1
    numbers[:, 1] *= -1
    sweep = np.ascontiguousarray(sweep) if moves else np.empty((0, 3), np.float32)
    return Boxes(corners, sweep, room, number, leaf.astype(np.int32), boxes, numbers, level)


def _levels(rows: NDArray[Any]) -> tuple[NDArray[Any], Indices]:
    """The rows, and the least of those in each box, level by level; and where levels begin."""
    levels = [rows]
    while len(rows := levels[-1]) > 1:
        levels.append(np.minimum.reduceat(rows, np.arange(0, len(rows), BRANCH), axis=0))
    return np.concatenate(levels), np.cumsum([0, *map(len, levels)])


def _along_curve(middles: Floats32) -> Indices:
    """The order of points (T, 3) along Morton's curve."""
    low, high = middles.min(axis=0), middles.max(axis=0)
    size = np.maximum(high - low, np.float32(1e-30))
    cells = ((middles - low) * (np.float32(_CELLS - 1) / size)).astype(np.int64)
    # Bits of three numbers, spread so that two places are free between them.
    cells = (cells | cells << 16) & 0x030000FF
    cells = (cells | cells << 8) & 0x0300F00F
    cells = (cells | cells << 4) & 0x030C30C3
    cells = (cells | cells << 2) & 0x09249249
    return np.argsort(cells[:, 0] | cells[:, 1] << 1 | cells[:, 2] << 2, kind="stable")
