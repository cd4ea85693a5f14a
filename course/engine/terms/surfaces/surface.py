"""Triangles with textures, with special backs for camera rays, or in another BVH than Embree's."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course.engine.core.accelerator import Accelerator, Intersections, QueryStats, StaticAccelerator
from course.engine.core.camera import Camera
from course.engine.core.hits import Hits, Surface, turn_to_viewer
from course.engine.core.ray_offset import OFFSET
from course.engine.core.rays import Rays
from course.engine.core.types import Floats32, Floats64, Functions, Indices, Mask
from course.engine.core.vectors import dot, gather
from course.engine.terms.surfaces.behind import Behind, SeenThrough, keep_normals
from course.engine.terms.surfaces.hierarchy import HierarchyAccelerator
from course.engine.terms.surfaces.painting import Paint, Painting, make_painting
from course.engine.terms.surfaces.tables import (
    Part,
    PartTables,
    accelerate,
    join_tables,
    make_tables,
    vertices_and_triangles,
)


@dataclass(frozen=True)
class FullPart(Part):
    """One object's mesh with its texture, its normal map or bump map and the texture of its highlights, and how camera
    rays see it from behind (``course.engine.terms.surfaces.behind``).
    """

    paint: Paint | None = None
    relief: Paint | None = None
    shine: Paint | None = None
    behind: Behind = "turned"


@dataclass(frozen=True)
class ShinyHits(Hits):
    """Hits whose highlights have textures.

    ``shine``: (3, n) float32, colour factor of highlights, 1 where there is none; None if no hit has one.
    """

    shine: Floats32 | None = None


@dataclass(frozen=True)
class FullSurface(Surface):
    """All triangles, with the parts that only some scenes have.

    Attributes
    ----------
    painting : the textures; None if there are none
    relief : the normal maps; None if there are none
    shine : the textures of highlights; None if there are none
    turned : (M,) bool, materials whose shading normals are turned to the viewer (``turn_to_viewer``); None for all
    kept : (T,) bool, triangles whose normals are not turned where camera rays hit their backs; None if there are none
    through : accelerator for camera rays that pass through backs; None if they hit the same triangles as other rays
    spread : angle of a pixel of the picture [rad], if textures ask how large it is; 0 if none does
    """

    painting: Painting | None = None
    relief: Any = None
    shine: Painting | None = None
    turned: Mask | None = None
    kept: Mask | None = None
    through: SeenThrough | None = None
    spread: float = 0.0

    @property
    def turns_normals(self) -> bool:
        """See ``Surface``."""
        return self.turned is None

    @property
    def camera_accelerator(self) -> Any:
        """The accelerator of camera rays; its ``intersect`` is that of ``Accelerator``."""
        return self.accelerator if self.through is None else self.through

    def intersect(self, rays: Rays, stats: QueryStats, of_camera: bool) -> Intersections:
        """See ``Surface``; a camera that lies exactly on a surface sees what is in front of it."""
        if not of_camera:
            return super().intersect(rays, stats, of_camera)
        origin, direction, time = rays.origin, rays.direction, rays.time
        found: Intersections = self.camera_accelerator.intersect(origin, direction, stats, time)
        # A camera ray that starts on a surface hits it at distance 0. It starts again, one offset farther on.
        stuck = np.flatnonzero((found.t <= 0) & (found.triangle >= 0))
        if len(stuck) == 0:
            return found
        onward = direction.take(stuck, axis=1)
        start = origin if origin.shape[1] == 1 else origin.take(stuck, axis=1)
        when = None if time is None else time.take(stuck)
        step = self.triangles.planes[found.triangle.take(stuck), 6]
        start = start + onward * np.maximum(step, np.float32(OFFSET))
        again = self.camera_accelerator.intersect(start, onward, stats, when)
        found.triangle[stuck], found.t[stuck] = again.triangle, again.t
        found.u[stuck], found.v[stuck] = again.u, again.v
        return found

    def hits(
        self,
        found: Intersections,
        direction: Floats32,
        time: Floats32 | None = None,
        of_camera: bool = False,
    ) -> Hits:
        """See ``Surface``."""
        hits = super().hits(found, direction, time, of_camera)
        if self.relief is not None:
            normals = self.relief.normals(hits, self.triangles, self.turned is None)
            hits = replace(hits, ns=normals)
        if self.turned is not None and hits.ns is not hits.ng:
            some = np.flatnonzero(self.turned.take(hits.material))
            normals = hits.ns.take(some, axis=1)
            turn_to_viewer(normals, hits.direction.take(some, axis=1))
            hits.ns[:, some] = normals
        if of_camera and self.kept is not None:
            keep_normals(self.kept, hits)
        if self.shine is not None:
            shine = self.shine.tint(hits.triangle, hits.u, hits.v, self._seen(hits))
            hits = ShinyHits(**{**vars(hits), "shine": shine})
        if self.painting is None:
            return hits
        tint = self.painting.tint(hits.triangle, hits.u, hits.v, self._seen(hits))
        return replace(hits, tint=tint)

    def seen_by(self, camera: Camera) -> "FullSurface":
        """The same for one camera, whose pixels textures may ask for."""
        paintings = self.painting, self.shine
        if not any(painting is not None and painting.sized for painting in paintings):
            return self
        steps = camera.step_x.astype(np.float64), camera.step_y.astype(np.float64)
        return replace(self, spread=float(np.sqrt(np.linalg.norm(np.cross(*steps)))))

    def _seen(self, hits: Hits) -> Any:
        """See ``Painting.tint``."""
        if not self.spread:
            return None

        def seen(which: Indices) -> tuple[Floats32, Floats32]:
            normal, direction = hits.ng.take(which, axis=1), hits.direction.take(which, axis=1)
            cosine = np.maximum(np.abs(dot(normal, direction)), np.float32(1e-6))
            size = hits.t.take(which) * np.float32(self.spread) / np.sqrt(cosine)
            return size.astype(np.float32), gather(self.triangles.edges, hits.triangle.take(which))[
                0:6
            ]

        return seen


def build_surface(
    parts: Sequence[FullPart],
    motion_blur: Functions | None = None,
    bulges: bool = True,
    hierarchy: tuple[Functions, int] | None = None,
    turned: Mask | None = None,
    least_offset: float = 0.0,
    camera_position: Floats64 | None = None,
) -> FullSurface:
    """Gather the triangles of all parts, whose coordinates lie in about [-1, 1].

    Parameters
    ----------
    motion_blur : functions of the module; needed if a part has a velocity
    bulges : true if shadow rays start from the round surfaces that meshes stand for
    hierarchy : functions of the bounding_volumes module and the size of a leaf, to replace Embree; nothing may move
    turned : see ``FullSurface``
    least_offset : rays start at least this far from surfaces
    camera_position : (3,) common origin of all camera rays; None if they have several
    """
    tables, rows = make_tables(parts, least_offset)
    triangles = join_tables(tables, rows, bulges)
    accelerator: Accelerator
    if hierarchy is not None:
        accelerator = HierarchyAccelerator(*vertices_and_triangles(tables), *hierarchy)
    else:
        accelerator = accelerate(tables, motion_blur)
    unseen, through = _seen(tables, "unseen"), None
    if unseen is not None:
        hidden = np.concatenate([_hidden(table, camera_position) for table in tables])
        front = accelerator
        if isinstance(accelerator, StaticAccelerator) and hidden.any():
            # These triangles become points, which no ray hits.
            corners = accelerator.triangles
            corners = np.where(hidden[:, None], corners[:, :1], corners)
            front = StaticAccelerator(accelerator.vertices, corners, accelerator.make)
        through = SeenThrough(front, unseen, triangles.planes)
    return FullSurface(
        triangles=triangles,
        accelerator=accelerator,
        painting=make_painting([(len(table.triangles), _paint(table)) for table in tables]),
        relief=_relief(tables),
        shine=make_painting([(len(t.triangles), _paint(t, "shine")) for t in tables]),
        turned=turned,
        kept=_seen(tables, "kept"),
        through=through,
    )


def _paint(table: PartTables, key: str = "paint") -> Paint | None:
    """The paint of the triangles that have an area, or their normal map by its key."""
    paint: Paint | None = getattr(table.part, key, None)
    return None if paint is None else Paint(paint.corners[table.kept], paint.color_at)


def _relief(tables: Sequence[PartTables]) -> Any:
    """The normal maps of all triangles, None where there are none; their module is loaded with them alone."""
    maps = make_painting([(len(table.triangles), _paint(table, "relief")) for table in tables])
    if maps is None:
        return None
    from course.engine.terms.surfaces.normal_maps import Relief

    return Relief(maps)


def _behind(table: PartTables) -> Behind:
    return table.part.behind if isinstance(table.part, FullPart) else "turned"


def _seen(tables: Sequence[PartTables], behind: Behind) -> Mask | None:
    """(T,) bool, triangles whose backs are seen in that way; None if there are none."""
    kinds = [np.full(len(table.triangles), _behind(table) == behind) for table in tables]
    return np.concatenate(kinds) if any(kind.any() for kind in kinds) else None


def _hidden(table: PartTables, camera_position: Floats64 | None) -> Mask:
    """(T,) bool, triangles that are seen through from a camera's position (3,); none if it is None."""
    if camera_position is None or _behind(table) != "unseen":
        return np.zeros(len(table.triangles), np.bool_)
    planes = table.rows.planes
    corner, normal = planes[:, :3].T.astype(np.float64), planes[:, 3:6].T
    return np.asarray(dot(camera_position[:, None] - corner, normal.astype(np.float64)) <= 0)
