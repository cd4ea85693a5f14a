"""Several rays at once through Embree's own interface: an extra, several times as fast where neighbours go together.

embreex sends one ray after the other. The library that it brings along can also take packets of 4, 8 or 16 rays, which
share the way down the hierarchy and the width of the processor. Numba compiles the loop that fills the packets; the
answers are the same, bit for bit, but for rays that meet an edge between two triangles at one and the same distance.

The loops are in ``packet_kernels``. Like all files of that ending it imports Numba (``pip install .[fast]``). Where
Numba or Embree's library is missing, ``available`` says so. Where embreex is missing, the hierarchy that Numba compiles
(``course.engine.casters``) answers packets, bit for bit as it answers single rays.
"""

from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from course.engine.casters.choice import chosen
from course.engine.core.accelerator import NO_HIT, Intersections, StaticAccelerator, no_hits
from course.engine.core.types import Floats32, Numbers
from course.engine.loops.embree_device import device, library, queries, width
from course.engine.terms.surfaces.boxes import roomy_box

WIDTH = width()
"""Rays of a packet."""

ALL_ROWS = 24
"""Of a packet: hits end with the instances' numbers, one row or two by how Embree was built; more room does no harm.
Shadow rays have none, but where Embree's shadow queries don't take as many rays at once, they read and write
these rows, too."""

_TRIANGLES, _INDICES, _VERTICES = 0, 0, 1
_THREE_UINTS, _THREE_FLOATS = 0x5003, 0x9003
_ROBUST = 4
COHERENT = 1 << 16


def aligned(rows: int) -> Any:
    """Rows of WIDTH float32 in one array, at an address that 64 divides: Embree wants whole rows."""
    size = 4 * WIDTH * rows
    memory = np.zeros(size + 64, np.uint8)
    return memory[-memory.ctypes.data % 64 :][:size].view(np.float32)


class PacketScene:
    """Triangles in a hierarchy.

    Attributes
    ----------
    scene : address of the hierarchy
    box : (2, 3) float32 around all triangles, see ``roomy_box``
    """

    scene: int
    box: Floats32

    def few(self, origin: Floats32, direction: Floats32) -> Intersections:
        """Nearest hits of a few rays, (3, N) or (3, 1) and (3, N): none of our compiled loops is read for them."""
        raise NotImplementedError


class EmbreePackets(PacketScene):
    """Triangles in Embree's hierarchy.

    Raises RuntimeError: embree can't build it.

    Parameters
    ----------
    vertices : (V, 3) float32
    triangles : (T, 3) int32, T > 0
    """

    def __init__(self, vertices: Floats32, triangles: Numbers) -> None:
        embree = library()
        assert embree is not None
        self._library = embree
        # Embree reads 16 bytes of the last vertex, and reads the arrays for as long as the scene lives.
        self._vertices = np.zeros((len(vertices) + 2, 3), np.float32)
        self._vertices[: len(vertices)] = vertices
        # The same bits: no number is negative.
        self._triangles = np.ascontiguousarray(triangles, np.int32).view(np.uint32)
        geometry = embree.rtcNewGeometry(device(), _TRIANGLES)
        for kind, layout, array, count in (
            (_VERTICES, _THREE_FLOATS, self._vertices, len(vertices)),
            (_INDICES, _THREE_UINTS, self._triangles, len(triangles)),
        ):
            embree.rtcSetSharedGeometryBuffer(
                geometry, kind, 0, layout, array.ctypes.data, 0, 12, count
            )
        embree.rtcCommitGeometry(geometry)
        self.scene = embree.rtcNewScene(device())
        embree.rtcSetSceneFlags(self.scene, _ROBUST)
        embree.rtcAttachGeometry(self.scene, geometry)
        embree.rtcReleaseGeometry(geometry)
        embree.rtcCommitScene(self.scene)
        error = embree.rtcGetDeviceError(device())
        if error:
            raise RuntimeError(f"Embree's error {error}")
        self.box = roomy_box(vertices)

    def few(self, origin: Floats32, direction: Floats32) -> Intersections:
        """See ``PacketScene``."""
        found = no_hits(n := direction.shape[1])
        packet = aligned(ALL_ROWS).reshape(ALL_ROWS, WIDTH)
        whole, valid = packet.view(np.int32), aligned(1).view(np.int32)
        arguments, query = np.zeros(16, np.uint32), getattr(self._library, queries()[0])
        # Of Embree's features all.
        arguments[1] = 0xFFFFFFFF
        for first in range(0, n, WIDTH):
            # The last ray fills the last packet.
            some = np.minimum(np.arange(first, first + WIDTH), n - 1)
            packet[:3] = origin if origin.shape[1] == 1 else origin[:, some]
            packet[4:7], packet[8] = direction[:, some], NO_HIT
            whole[9] = whole[18] = valid[:] = -1
            addresses = [array.ctypes.data for array in (valid, packet, arguments)]
            query(addresses[0], self.scene, *addresses[1:])
            hit = whole[18] >= 0
            found.triangle[some] = np.where(hit, whole[17], -1)
            found.u[some], found.v[some] = np.where(hit, packet[15:17], 0)
            found.t[some] = packet[8]
        return found

    def __del__(self) -> None:
        """Give the hierarchy's memory back."""
        scene = getattr(self, "scene", None)
        if scene:
            self._library.rtcReleaseScene(scene)


class HierarchyPackets(PacketScene):
    """Triangles in the hierarchy that stands in for Embree's, of which single rays have the same."""

    def __init__(self, accelerator: StaticAccelerator) -> None:
        from course.engine.casters.compiled import CompiledCaster

        caster = accelerator.caster
        assert isinstance(caster, CompiledCaster)
        self._kept = caster
        self.scene = caster.scene
        self.box = roomy_box(accelerator.vertices)

    def few(self, origin: Floats32, direction: Floats32) -> Intersections:
        """See ``PacketScene``; a hierarchy's own loops have been read to build it."""
        return self._kept.nearest(origin, direction, np.full(1, NO_HIT, np.float32))


def packets_of(accelerator: StaticAccelerator) -> PacketScene:
    """The triangles of an accelerator, T > 0, in the caster that this process has chosen; built once."""
    if accelerator not in _BUILT:
        if chosen() == "numba":
            _BUILT[accelerator] = HierarchyPackets(accelerator)
        else:
            _BUILT[accelerator] = EmbreePackets(accelerator.vertices, accelerator.triangles)
    return _BUILT[accelerator]


_BUILT: WeakKeyDictionary[StaticAccelerator, PacketScene] = WeakKeyDictionary()
"""What has been built: a scene is rendered more than once."""
