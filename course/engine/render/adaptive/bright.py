"""What shines by itself, as the scene has it before any ray: triangles, their radiance, and how they move."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from course.engine.core.motion import MovingAccelerator
from course.engine.core.types import Floats64, Indices
from course.engine.terms.scattering.materials import FullMaterials
from course.engine.terms.world import FullWorld

EVEN = np.array([0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101])
"""Inverse powers of the root of x^5 = x + 1, whose multiples are even in four dimensions (Roberts, "The unreasonable
effectiveness of quasirandom sequences", 2018)."""

CLOSED = 1e-3
"""A mesh is closed if its normals, weighted by area, add up to less than this share of the area."""


@dataclass(frozen=True)
class Bright:
    """One mesh that shines.

    Attributes
    ----------
    part : its number among the parts of ``Triangles``
    material : its number
    square : mean over the channels of its squared radiance
    triangles : (k,) intp, their numbers in the scene
    shares : (k,) float64, sums of their areas up to each, the last one 1
    area : of all of them [unit of the compiled scene, squared]
    velocity : (3,) float64 [unit of the compiled scene / exposure]
    fronts : whether it shines, or can be seen, from the fronts of its triangles alone
    closed : whether it has an inside
    """

    part: int
    material: int
    square: float
    triangles: Indices
    shares: Floats64
    area: float
    velocity: Floats64
    fronts: bool
    closed: bool

    def far(self, world: FullWorld) -> float:
        """Distance from the scene's middle [unit of the compiled scene]."""
        return float(np.linalg.norm(world.surface.triangles.planes[self.triangles[0], :3]))

    def points(self, world: FullWorld, u: Floats64) -> tuple[Floats64, Floats64, Indices]:
        """Places (3, n) at time 0, unit normals (3, n) and triangles (n,), evenly by area, from u (2, n) in [0, 1)."""
        low = np.concatenate(([0.0], self.shares[:-1]))
        place = np.minimum(np.searchsorted(self.shares, u[0], "right"), len(self.shares) - 1)
        along = np.clip((u[0] - low[place]) / np.maximum(self.shares - low, 1e-300)[place], 0, 1)
        which = self.triangles[place]
        planes, edges = (
            world.surface.triangles.planes[which].T,
            world.surface.triangles.edges[which].T,
        )
        root = np.sqrt(along)
        points = (
            planes[:3] + root * (1 - u[1]) * edges[:3] + root * u[1] * edges[3:6].astype(np.float64)
        )
        return points, planes[3:6].astype(np.float64), which


def parts_of(world: FullWorld) -> Indices:
    """(T,) the part that each triangle belongs to."""
    return np.repeat(
        np.arange(len(world.surface.triangles.parts)),
        [count for _, count, _ in world.surface.triangles.parts],
    )


def bright_things(world: FullWorld, parts: Indices) -> Iterator[Bright]:
    """All meshes that shine; ``parts`` (T,) as `parts_of` has them."""
    return meshes_of(world, parts, _squares(world))


def meshes_of(world: FullWorld, parts: Indices, square: Floats64) -> Iterator[Bright]:
    """All meshes whose material has a square (M,) above 0."""
    lamps = world.materials.lamps
    triangles = world.surface.triangles
    shining = np.flatnonzero(square.take(triangles.material) > 0)
    if not len(shining):
        return
    velocities = _velocities(world, shining)
    edges = triangles.edges[shining].astype(np.float64)
    areas = np.linalg.norm(np.cross(edges[:, :3], edges[:, 3:6]), axis=1) / 2
    first = np.flatnonzero(np.diff(parts[shining], prepend=-1))
    for rows in np.split(np.arange(len(shining)), first[1:]):
        area = float(areas[rows].sum())
        if area <= 0:
            continue
        material = int(triangles.material[shining[rows[0]]])
        normals = triangles.planes[shining[rows], 3:6]
        closed = bool(np.linalg.norm((areas[rows, None] * normals).sum(axis=0)) < CLOSED * area)
        yield Bright(
            int(parts[shining[rows[0]]]),
            material,
            float(square[material]),
            shining[rows],
            np.cumsum(areas[rows]) / area,
            area,
            velocities[rows[0]],
            closed or (lamps is not None and bool(lamps[material])),
            closed,
        )


def _squares(world: FullWorld) -> Floats64:
    """(M,) mean over the channels of the squared radiance that each material sends out by itself."""
    materials = world.materials
    radiance = materials.emission + materials.ambient * world.ambient[:, None].astype(np.float64)
    if isinstance(materials, FullMaterials) and materials.unlit is not None:
        radiance = radiance + materials.unlit
    squares: Floats64 = (radiance * radiance).mean(axis=0)
    return squares


def _velocities(world: FullWorld, triangles: Indices) -> Floats64:
    """(n, 3) of triangles (n,)."""
    result = np.zeros((len(triangles), 3))
    accelerator = world.surface.accelerator
    for mover in accelerator.movers if isinstance(accelerator, MovingAccelerator) else ():
        result[(triangles >= mover.first) & (triangles < mover.last)] = mover.velocity
    return result
