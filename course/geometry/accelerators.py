"""What may answer the rays of a scene: Embree, Embree with things that move, or the student's hierarchy."""

from __future__ import annotations

from typing import Protocol

from course.core.types import Floats32, Mask
from course.geometry.convex import ConvexObjects, Objects
from course.geometry.embree import Intersections, QueryTime


class AnyAccelerator(Protocol):
    """Triangles that batches of rays are cast at.

    ``course.geometry.embree.Accelerator``, ``course.geometry.moving.MovingAccelerator`` and
    ``course.geometry.hierarchy.HierarchyAccelerator`` have this interface; who takes either asks for no more.
    """

    @property
    def compiled(self) -> bool:
        """Whether compiled loops are used."""

    @property
    def convex(self) -> ConvexObjects | None:
        """The objects that triangles belong to, where looking at these spares queries."""

    def use_packets(self, wanted: bool) -> None:
        """Ask for compiled loops from now on, or no longer; what has none of its own does nothing."""

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        clock: QueryTime,
        time: Floats32 | None,
        *,
        coherent: bool = False,
        left: Objects | None = None,
    ) -> Intersections:
        """Nearest hit of each ray.

        Parameters
        ----------
        origin : (3, N) or (3, 1) float32
        direction : (3, N) float32, any length but 0
        clock : the time that it takes, or its tests, are added to it
        time : (N,) float32, when each ray is cast, as a share of the exposure; None where nothing moves
        coherent : whether rays that follow each other go much the same way
        left : (N,) the convex object that each ray leaves; None where that is not known
        """

    def unoccluded(
        self,
        origin: Floats32,
        direction: Floats32,
        limit: float,
        clock: QueryTime,
        time: Floats32 | None,
        *,
        asked: Mask | None = None,
    ) -> Mask:
        """Whether nothing lies between origin and origin + limit * direction.

        Parameters
        ----------
        origin : (3, N) or (3, 1) float32
        direction : (3, N) float32, any length but 0
        limit : in lengths of the direction
        clock : the time that it takes, or its tests, are added to it
        time : (N,) float32, when each ray is cast, as a share of the exposure; None where nothing moves
        asked : (N,) the rays whose answers matter, None for all: what comes back for others means nothing

        Returns
        -------
        (N,) bool
        """
