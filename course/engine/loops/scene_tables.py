"""A scene's hierarchies as the fused loop asks them: addresses, movers, and the convex objects that rays leave."""

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from course.engine.core.accelerator import Accelerator, StaticAccelerator
from course.engine.core.motion import Mover, MovingAccelerator
from course.engine.core.types import Floats32, Indices
from course.engine.loops.convex import ConvexObjects, convex_objects
from course.engine.loops.packets import packets_of
from course.engine.terms.lights.own_lamp import LampAccelerator

_CONVEX: WeakKeyDictionary[StaticAccelerator, ConvexObjects | None] = WeakKeyDictionary()
"""What has been found: a scene is rendered more than once."""


@dataclass(frozen=True)
class SceneTables:
    """What stands still and K movers, as ``occlusion_kernels`` has them.

    Attributes
    ----------
    scenes : (1 + K,) uint64, Embree's; 0 where there are no triangles
    blockers : (1 + K,) uint64, those that shadow rays are asked of
    velocity, boxes : (K, 3) and (K, 2, 3) float32 of the movers
    first : (1 + K,) the first triangle of what stands still and of each mover
    convex : the objects that the triangles belong to, where looking at these spares queries
    """

    scenes: NDArray[np.uintp]
    blockers: NDArray[np.uintp]
    velocity: Floats32
    boxes: Floats32
    first: Indices
    convex: ConvexObjects | None


def scene_tables(
    accelerator: Accelerator, parts: tuple[tuple[int, int, bool], ...] = ()
) -> SceneTables:
    """Tables of an accelerator of Embree's, or of one with movers; their hierarchies live as long as it does.

    ``parts``: of the objects that the triangles belong to, where they stand still: see ``Triangles``
    """
    static: Accelerator = accelerator
    every: tuple[Mover, ...] = ()
    if isinstance(accelerator, MovingAccelerator):
        static, every = accelerator.static, accelerator.movers
    assert isinstance(static, StaticAccelerator)
    blocking = static.others if isinstance(static, LampAccelerator) else static
    # What has no triangle is never asked.
    movers = [mover for mover in every if len(mover.accelerator.triangles)]
    packets = [packets_of(mover.accelerator) for mover in movers]
    scenes, blockers = (
        np.array([_address(still), *(each.scene for each in packets)], np.uintp)
        for still in (static, blocking)
    )
    velocity = np.array([mover.velocity for mover in movers], np.float32).reshape(-1, 3)
    boxes = np.array([each.box for each in packets], np.float32).reshape(-1, 2, 3)
    first = np.array([0, *(mover.first for mover in movers)], np.int64)
    convex = _convex(static, parts) if static is accelerator else None
    return SceneTables(scenes, blockers, velocity, boxes, first, convex)


def _address(accelerator: StaticAccelerator) -> int:
    return packets_of(accelerator).scene if len(accelerator.triangles) else 0


def _convex(
    accelerator: StaticAccelerator, parts: tuple[tuple[int, int, bool], ...]
) -> ConvexObjects | None:
    if accelerator not in _CONVEX:
        _CONVEX[accelerator] = convex_objects(accelerator.vertices, accelerator.triangles, parts)
    return _CONVEX[accelerator]
