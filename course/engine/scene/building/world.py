"""Compile a checked description into what is rendered: meshes read, moved to the frame, rounded to float32."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.camera import Camera
from course.engine.core.ray_offset import OFFSET
from course.engine.core.types import Floats64
from course.engine.formats.meshes.named import Named
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.loading import Loaded
from course.engine.formats.yaml.surroundings import in_its_surroundings, outsides, warn_of_nested
from course.engine.functions.effects import Bound, Effects, Need
from course.engine.scene.building.cameras import compile_lens, make_camera, make_window_camera
from course.engine.scene.building.coplanar import lifts
from course.engine.scene.building.cutting import cut
from course.engine.scene.building.environment import compile_environment
from course.engine.scene.building.frame import Frame, bounds_of, in_range, in_reach
from course.engine.scene.building.glass_meshes import warn_of_glass
from course.engine.scene.building.gloss import (
    compile_lobes,
    compile_microfacets,
    compile_rough_glass,
    reflecting,
)
from course.engine.scene.building.lights import Lit, compile_choice, compile_lights, emitter_parts
from course.engine.scene.building.materials import check_growth, compile_materials, material_columns
from course.engine.scene.building.motion import Shutter, check_sweeps, compile_motion, shutter_of
from course.engine.scene.building.multiple_importance import compile_combining
from course.engine.scene.building.objects import CONVEX, object_mesh
from course.engine.scene.building.path_tracing import compile_acceleration, compile_paths
from course.engine.scene.building.small_objects import (
    CUT,
    extents_of_lamps,
    extents_of_objects,
    frame_for,
    warn_of_gaps,
    warn_of_small,
    warn_of_unfinished,
)
from course.engine.scene.building.textures import Painter, shows_specular_texture, shows_texture
from course.engine.scene.building.triangles import TOO_LARGE, SmallThings
from course.engine.shapes.mesh import Mesh
from course.engine.terms.lights.own_lamp import without_own_lamp
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface
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
    scene, document = loaded.description, loaded.document
    bound = Bound(effects)
    shutter = shutter_of(loaded)
    meshes: list[Mesh] = []
    files: dict[str, Named] = {}
    bounds: list[Floats64] = []
    starts: list[Floats64] = []
    for number, thing in enumerate(scene.objects):
        mesh = object_mesh(thing, number, document, loaded.path.parent, files)
        bounds.append(bounds_of(mesh))
        start = shutter.start(thing.motion)
        meshes.append(_moved(mesh, start))
        starts.append(bounds[-1] + start)
    shutter = shutter.with_camera(loaded, starts)
    boxes = [
        box
        for start, thing in zip(starts, scene.objects, strict=True)
        for box in (start, start + shutter.sweep(thing.motion))
    ]
    warn_of_glass(loaded, meshes)
    extents = extents_of_objects(bounds, boxes)
    lamps = extents_of_lamps(loaded, shutter, extents, meshes)
    frame, things, small = frame_for(extents + lamps, len(bounds))
    check_sweeps(loaded, frame, shutter)
    columns = material_columns(scene)
    used = {
        str(number): in_its_surroundings(scene.materials[name], scene.materials)
        for number, name in enumerate(columns.names)
    }
    painter = _painter(used, loaded, bound, files, frame.scale)
    # A direction that is kept may point out of an object into which the ray has gone, and meets it once more.
    leaves = CONVEX if scene.integrator.into_surface == "mirror" else ()
    parts = [
        FullPart(
            frame.mesh(mesh),
            columns.of_objects[number],
            shutter.velocity(thing.motion, frame),
            isinstance(thing, leaves),
            None if painter is None else painter.paint(number, mesh),
            None if painter is None else painter.relief(number, mesh),
            None if painter is None else painter.shine(number, mesh),
            thing.from_behind,
        )
        for number, (mesh, thing) in enumerate(zip(meshes, scene.objects, strict=True))
    ]
    for name, material in zip(columns.names, used.values(), strict=True):
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
        warn_of_nested(scene, document, bounds, meshes)
    motion = compile_motion(loaded, frame, shutter, bound, materials)
    parts += emitters
    offset = scene.integrator.surface_offset / frame.scale
    path = ("integrator", "surface_offset")
    in_reach(np.array(offset), loaded, path, "the distance by which rays leave surfaces")

    def build(parts: Sequence[FullPart]) -> FullSurface:
        return build_surface(
            parts,
            motion.motion_blur if motion else None,
            bulges=scene.integrator.terminator == "round",
            # Refraction is not defined by a normal that looks away.
            turned=None if scene.integrator.shading_normals == "bent" else materials.refracts,
            hierarchy=compile_acceleration(loaded, shutter, bound),
            least_offset=offset,
            camera_position=_still_eye(loaded, frame, shutter),
        )

    surface, whole, parts = _cut_and_built(parts, things, small, build)
    pieces = sum(len(part.mesh.triangles) for part in parts) - whole
    objects = Lit(surface.triangles, columns.of_lights)
    lights, skipped = compile_lights(loaded, frame, shutter, bound, materials, objects, raised)
    ambient = np.zeros(3)
    for light in scene.lights:
        if isinstance(light, d.AmbientLight):
            ambient += rgb(light.radiance)
    environment, sky = compile_environment(loaded, bound)
    choice = compile_choice(loaded, lights, bound)
    if sky is None and choice is None:
        surface = replace(surface, accelerator=without_own_lamp(surface, len(used), lights))
    named = list(zip(columns.names, used.values(), strict=True))
    mirrors = [(name, reflecting(material)) for name, material in named]
    lobes = compile_lobes(mirrors, bound, scene.integrator)
    microfacets = compile_microfacets(named, bound, scene.integrator)
    world = FullWorld(
        surface=surface,
        materials=materials,
        lights=lights,
        skipped_lights=skipped,
        ambient=in_range(ambient, loaded, ("lights",), "ambient radiance"),
        environment=environment,
        sky=sky,
        lobes=lobes,
        rough=compile_rough_glass(named, lobes, bound, scene.integrator),
        lens=compile_lens(loaded, frame, bound),
        motion=motion,
        paths=compile_paths(scene, bound, materials, columns.of_lights.values()),
        backdrop=scene.environment.seen_by == "camera",
        keeps=scene.integrator.into_surface == "keep",
        microfacets=microfacets,
        choice=choice,
        combining=compile_combining(
            scene,
            bound,
            materials,
            lobes,
            {columns.names[one.material]: one for one in microfacets},
            lights if choice is None else (),
        ),
    )
    check_growth(loaded, columns.names, world)
    if not warn_of_small(loaded, extents, boxes, frame):
        warn_of_unfinished(loaded, parts, things, pieces)
    largest = surface.triangles.largest_raised
    warn_of_gaps(loaded, extents, frame, meshes, [part.mesh for part in parts], largest)
    triangles = tuple(len(mesh.triangles) for mesh in meshes)
    return Compiled(world, frame, shutter, triangles, tuple(bounds), pieces, bound.needs)


def _cut_and_built(
    parts: list[FullPart],
    things: SmallThings,
    small: bool,
    build: Callable[[Sequence[FullPart]], FullSurface],
) -> tuple[FullSurface, int, list[FullPart]]:
    """The surface, how many triangles there were before any was cut, and the parts afterwards."""
    whole = sum(len(part.mesh.triangles) for part in parts)
    if small:
        parts = cut(parts, things, CUT)
    surface = build(parts)
    # How far thin triangles are left is only known then: to ask beforehand would slow the building of all scenes.
    if not small and surface.triangles.largest_raised > OFFSET * TOO_LARGE * things.least:
        finer = cut(parts, things, TOO_LARGE)
        if finer is not parts:
            surface, parts = build(finer), finer
    return surface, whole, parts


def _still_eye(loaded: Loaded, frame: Frame, shutter: Shutter) -> Floats64 | None:
    """Where all camera rays begin, (3,); None where they don't begin in one place."""
    camera = loaded.description.camera
    if shutter.moves(camera.motion) or (camera.lens and camera.lens.aperture_radius):
        return None
    return frame.position(np.array(camera.eye) + shutter.start(camera.motion))


def _painter(
    used: dict[str, d.MaterialDescription],
    loaded: Loaded,
    bound: Bound,
    files: dict[str, Named],
    scale: float,
) -> Painter | None:
    """What paints the objects; None where no surface shows a texture."""
    painted = (
        shows_texture(each) or shows_specular_texture(each) or each.normal_map or each.bump
        for each in used.values()
    )
    if not any(painted):
        return None
    return Painter(loaded, bound, files, scale)


def _moved(mesh: Mesh, by: Floats64) -> Mesh:
    if not by.any():
        return mesh
    return Mesh(mesh.vertices + by, mesh.triangles, mesh.normals, mesh.uv)


STEEPEST = 1e6
"""Sideways over forwards, of the widest ray: beyond it float32 forgets that rays go forwards at all."""


def _check_slopes(edges: Floats64, loaded: Loaded, key: str) -> None:
    steepest = float(np.abs(edges).max())
    if not steepest < STEEPEST:
        raise loaded.document.error(
            ("camera", key),
            f"the widest ray goes {steepest:.3g} times as far sideways as forwards: expected less than {STEEPEST:g}",
        )


def compile_camera(loaded: Loaded, frame: Frame, width: int, height: int) -> Camera:
    """The camera for a picture of that size."""
    camera = loaded.description.camera
    start = shutter_of(loaded).start(camera.motion)
    eye = frame.position(np.array(camera.eye) + start)
    in_reach(eye, loaded, ("camera", "eye"), "the camera's distance")
    near = camera.near / frame.scale
    in_reach(np.array(near), loaded, ("camera", "near"), "the distance from which the camera sees")
    # In the file's units: in a huge scene the two positions may round to one.
    view, up = np.array(camera.look_at) - np.array(camera.eye), np.array(camera.up)
    plane = camera.image_plane
    if plane is not None:
        edges = np.array((plane.left, plane.right, plane.bottom, plane.top)) / plane.distance
        _check_slopes(edges, loaded, "image_plane")
    else:
        fov = np.radians(camera.vertical_fov)
        edges = np.tan(fov / 2) * np.array((-width / height, width / height, -1, 1))
        _check_slopes(edges, loaded, "vertical_fov")
        if camera.handedness == "right":
            return make_camera(eye, view, up, fov, width, height, near)
    if camera.handedness == "right":
        return make_window_camera(eye, view, up, edges, width, height, near)
    # A point at x to the right is shown at -x. The lens is mirrored, too.
    edges[:2] *= -1
    mirrored = make_window_camera(eye, view, up, edges, width, height, near)
    return replace(mirrored, right=-mirrored.right)
