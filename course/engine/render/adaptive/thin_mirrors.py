"""Mirrors and glass that rays through blocks of pixels may miss: beads, wires, and whatever covers few pixels."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Indices
from course.engine.render.adaptive.bright import meshes_of
from course.engine.render.adaptive.glimpses import ALL, FEWEST, SKETCH, put
from course.engine.render.adaptive.seen_ahead import CameraAxes
from course.engine.terms.world import FullWorld


@dataclass(frozen=True)
class ThinMirrors:
    """Where they are.

    Attributes
    ----------
    blocks : block of pixels -> material
    too_small : materials of those that cover less than a pixel: four rays through each may miss them, too
    rays : that were sent to know it
    """

    blocks: dict[int, int]
    too_small: set[int]
    rays: int


def thin_mirrors(
    world: FullWorld,
    view: CameraAxes,
    parts: Indices,
    mirrors: Floats64,
    side: int,
    matters: Callable[[float, int], bool],
) -> ThinMirrors:
    """All meshes that cover less than half of the blocks in which they are.

    Parameters
    ----------
    parts : (T,) of the triangles
    mirrors : (M,) above 0 for materials that mirror or refract
    side : of a block [pixels]
    matters : whether an image on so many pixels, in a material, would leave as much as matters
    """
    blocks, too_small, rays = dict[int, int](), set[int](), 0
    columns = -(-view.width // side)
    meshes = [*meshes_of(world, parts, mirrors)]
    count = int(np.clip(ALL // max(len(meshes), 1), FEWEST, SKETCH))
    for mesh in meshes:
        for hiding in (None, parts):
            pixel, share = put(world, view, mesh, count, hiding)
            y, x = np.divmod(pixel, view.width)
            met = np.unique(y // side * columns + x // side)
            seen = float(share.sum())
            if not 0 < 2 * seen < len(met) * side**2 or not matters(seen, mesh.material):
                break
        else:
            rays += count
            blocks |= dict.fromkeys(met.tolist(), mesh.material)
            if seen < 1:
                too_small.add(mesh.material)
    return ThinMirrors(blocks, too_small, rays)
