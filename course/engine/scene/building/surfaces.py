"""From objects and lamps to the triangles that rays meet."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.core.materials import MaterialTable
from course.engine.core.motion import Motion
from course.engine.core.ray_offset import OFFSET
from course.engine.core.types import Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.cutting import cut
from course.engine.scene.building.frame import Frame, in_reach
from course.engine.scene.building.materials import Columns
from course.engine.scene.building.motion import Shutter
from course.engine.scene.building.objects import CONVEX
from course.engine.scene.building.path_tracing import compile_acceleration
from course.engine.scene.building.small_objects import CUT
from course.engine.scene.building.textures import Painter, shows_specular_texture, shows_texture
from course.engine.scene.building.things import Things
from course.engine.scene.building.triangles import TOO_LARGE, SmallThings
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface


@dataclass(frozen=True)
class Built:
    """The surface of a scene, and what it is made of.

    Attributes
    ----------
    parts : objects, then lamps, after large triangles were cut beside small things
    pieces : how many triangles there are more because of that
    """

    surface: FullSurface
    parts: list[FullPart]
    pieces: int


def object_parts(
    loaded: Loaded,
    things: Things,
    columns: Columns,
    used: Mapping[str, d.MaterialDescription],
    frame: Frame,
    bound: Bound,
) -> list[FullPart]:
    """The objects in the frame, with their textures.

    ``used`` : the materials, as they are in what surrounds them; see ``in_its_surroundings``
    """
    painter = _painter(used, loaded, things, frame.scale, bound)
    # A direction that is kept may point out of an object into which the ray has gone, and meets it once more.
    leaves = CONVEX if loaded.description.integrator.into_surface == "mirror" else ()
    return [
        FullPart(
            frame.mesh(mesh),
            columns.of_objects[number],
            things.shutter.velocity(thing.motion, frame),
            isinstance(thing, leaves),
            None if painter is None else painter.paint(number, mesh),
            None if painter is None else painter.relief(number, mesh),
            None if painter is None else painter.shine(number, mesh),
            thing.from_behind,
        )
        for number, (mesh, thing) in enumerate(zip(things.meshes, things.described, strict=True))
    ]


def build(
    loaded: Loaded,
    parts: list[FullPart],
    small: SmallThings,
    cuts: bool,
    materials: MaterialTable,
    motion: Motion | None,
    frame: Frame,
    shutter: Shutter,
    bound: Bound,
) -> Built:
    """Cut what is large beside small things, and join all parts.

    ``cuts`` : whether anything is small
    """
    integrator = loaded.description.integrator
    offset = integrator.surface_offset / frame.scale
    path = ("integrator", "surface_offset")
    in_reach(np.array(offset), loaded, path, "the distance by which rays leave surfaces")

    def joined(parts: Sequence[FullPart]) -> FullSurface:
        return build_surface(
            parts,
            motion.motion_blur if motion else None,
            bulges=integrator.terminator == "round",
            # Refraction is not defined by a normal that looks away.
            turned=None if integrator.shading_normals == "bent" else materials.refracts,
            hierarchy=compile_acceleration(loaded, shutter, bound),
            least_offset=offset,
            camera_position=_still_eye(loaded, frame, shutter),
        )

    return _cut_and_joined(parts, small, cuts, joined)


def _cut_and_joined(
    parts: list[FullPart],
    small: SmallThings,
    cuts: bool,
    joined: Callable[[Sequence[FullPart]], FullSurface],
) -> Built:
    whole = _count(parts)
    if cuts:
        parts = cut(parts, small, CUT)
    surface = joined(parts)
    # How far thin triangles are left is only known then: to ask beforehand would slow the building of all scenes.
    if not cuts and surface.triangles.largest_raised > OFFSET * TOO_LARGE * small.least:
        finer = cut(parts, small, TOO_LARGE)
        if finer is not parts:
            surface, parts = joined(finer), finer
    return Built(surface, parts, _count(parts) - whole)


def _count(parts: Sequence[FullPart]) -> int:
    return sum(len(part.mesh.triangles) for part in parts)


def _still_eye(loaded: Loaded, frame: Frame, shutter: Shutter) -> Floats64 | None:
    """Where all camera rays begin, (3,); None where they don't begin in one place."""
    camera = loaded.description.camera
    if shutter.moves(camera.motion) or (camera.lens and camera.lens.aperture_radius):
        return None
    return frame.position(np.array(camera.eye) + shutter.start(camera.motion))


def _painter(
    used: Mapping[str, d.MaterialDescription],
    loaded: Loaded,
    things: Things,
    scale: float,
    bound: Bound,
) -> Painter | None:
    """What paints the objects; None where no surface shows a texture."""
    painted = (
        shows_texture(each) or shows_specular_texture(each) or each.normal_map or each.bump
        for each in used.values()
    )
    if not any(painted):
        return None
    return Painter(loaded, bound, things.files, scale)
