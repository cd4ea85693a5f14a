"""Compile a checked description into what is rendered: meshes read, moved to the frame, rounded to float32."""

from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.types import Floats32, Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.loading import Loaded
from course.engine.formats.yaml.surroundings import in_its_surroundings, outsides, warn_of_nested
from course.engine.functions.effects import Bound, Effects, Need
from course.engine.scene.building.cameras import compile_lens
from course.engine.scene.building.coplanar import lifts
from course.engine.scene.building.environment import compile_environment
from course.engine.scene.building.frame import Frame, in_range
from course.engine.scene.building.further import with_further
from course.engine.scene.building.glass_meshes import warn_of_glass
from course.engine.scene.building.gloss import compile_scattering
from course.engine.scene.building.lights import Lit, compile_choice, compile_lights, emitter_parts
from course.engine.scene.building.materials import check_growth, compile_materials, material_columns
from course.engine.scene.building.motion import Shutter, check_sweeps, compile_motion
from course.engine.scene.building.multiple_importance import compile_combining
from course.engine.scene.building.path_tracing import compile_paths
from course.engine.scene.building.small_objects import (
    extents_of_lamps,
    extents_of_objects,
    frame_for,
    warn_of_gaps,
    warn_of_small,
    warn_of_unfinished,
)
from course.engine.scene.building.surfaces import build, object_parts
from course.engine.scene.building.things import read_things
from course.engine.terms.lights.own_lamp import without_own_lamp
from course.engine.terms.world import FullWorld


@dataclass(frozen=True)
class Compiled:
    """A world, and what its numbers were before they were compiled.

    Attributes
    ----------
    frame : where the scene file's origin and unit went
    shutter : when light is let in, and which motion is left out
    triangles : of each object
    bounds : of each object its lowest and its highest corner, (2, 3) float64 in the units of the scene file, where the
        file puts it: what moves is there at time 0
    pieces : how many triangles there are more because large ones were cut beside small things
    needs : the functions of the course that rendering calls, whatever its settings
    """

    world: FullWorld
    frame: Frame
    shutter: Shutter
    triangles: tuple[int, ...]
    bounds: tuple[Floats64, ...]
    pieces: int = 0
    needs: tuple[Need, ...] = ()


def compile_scene(loaded: Loaded, effects: Effects) -> Compiled:
    """Read the meshes and build everything that rays meet.

    Raises SceneError for what only shows when meshes are there; names file, line and key path.
    """
    scene, bound = loaded.description, Bound(effects)
    things = read_things(loaded)
    shutter, meshes = things.shutter, things.meshes
    warn_of_glass(loaded, meshes)
    boxes = things.boxes
    extents = extents_of_objects(things.bounds, boxes)
    lamps = extents_of_lamps(loaded, shutter, extents, meshes)
    frame, small, cuts = frame_for(extents + lamps, len(meshes))
    check_sweeps(loaded, frame, shutter)

    columns = material_columns(scene)
    described = [
        in_its_surroundings(scene.materials[name], scene.materials) for name in columns.names
    ]
    used = {str(number): each for number, each in enumerate(described)}
    named = list(zip(columns.names, described, strict=True))
    parts = object_parts(loaded, things, columns, used, frame, bound)
    for name, material in named:
        in_range(rgb(material.emission), loaded, ("materials", name, "emission"), "the emission")
        in_range(rgb(material.unlit), loaded, ("materials", name, "unlit"), "the radiance")
    flat = any(isinstance(light, d.RectangleLight | d.ObjectLight) for light in scene.lights)
    raised = lifts(loaded, frame, shutter, parts) if flat else {}
    emitters, emission = emitter_parts(loaded, frame, shutter, len(used), raised)
    materials = compile_materials(used, emission, frame)
    around = outsides(columns.names, scene.materials, len(materials.exponent))
    materials = materials if around is None else replace(materials, outside=around)
    if scene.integrator.into_surface == "mirror":
        # Where directions are kept the picture is another renderer's, which knows of no media in each other.
        warn_of_nested(scene, loaded.document, things.bounds, meshes)

    motion = compile_motion(loaded, frame, shutter, bound, materials)
    arguments = materials, motion, frame, shutter, bound
    built = build(loaded, parts + emitters, small, cuts, *arguments)
    surface = built.surface
    objects = Lit(surface.triangles, columns.of_lights)
    lights, skipped = compile_lights(loaded, frame, shutter, bound, materials, objects, raised)
    environment, sky = compile_environment(loaded, bound)
    choice = compile_choice(loaded, lights, bound)
    if sky is None and choice is None:
        surface = replace(surface, accelerator=without_own_lamp(surface, len(used), lights))
    scattering = compile_scattering(named, bound, scene.integrator)
    world = FullWorld(
        surface=surface,
        materials=materials,
        lights=lights,
        skipped_lights=skipped,
        ambient=_ambient(loaded),
        environment=environment,
        sky=sky,
        lobes=scattering.lobes,
        rough=scattering.rough,
        lens=compile_lens(loaded, frame, bound),
        motion=motion,
        paths=compile_paths(scene, bound, materials, columns.of_lights.values()),
        backdrop=scene.environment.seen_by == "camera",
        keeps=scene.integrator.into_surface == "keep",
        microfacets=scattering.microfacets,
        choice=choice,
        combining=compile_combining(
            scene,
            bound,
            materials,
            scattering.lobes,
            {columns.names[one.material]: one for one in scattering.microfacets},
            lights if choice is None else (),
        ),
    )
    world = with_further(loaded, frame, bound, things, world)
    check_growth(loaded, columns.names, world)
    if not warn_of_small(loaded, extents, boxes, frame):
        warn_of_unfinished(loaded, built.parts, small, built.pieces)
    largest = surface.triangles.largest_raised
    warn_of_gaps(loaded, extents, frame, meshes, [part.mesh for part in built.parts], largest)
    triangles = tuple(len(mesh.triangles) for mesh in meshes)
    return Compiled(world, frame, shutter, triangles, things.bounds, built.pieces, bound.needs)


def _ambient(loaded: Loaded) -> Floats32:
    """(3,) radiance of all ambient lights."""
    ambient = np.zeros(3)
    for light in loaded.description.lights:
        if isinstance(light, d.AmbientLight):
            ambient += rgb(light.radiance)
    return in_range(ambient, loaded, ("lights",), "ambient radiance")
