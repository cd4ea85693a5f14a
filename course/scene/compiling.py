"""Compile a checked description into what is rendered: meshes read, moved to the frame, rounded to float32."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from course.appearance.lobes import Lobe
from course.core.types import Floats64
from course.effects import Effects
from course.geometry.mesh import Mesh
from course.geometry.surface import Part, build_surface
from course.imaging.camera import Camera, make_camera, make_window_camera
from course.scene import description as d
from course.scene.acceleration_compiling import compile_acceleration
from course.scene.brightness import in_range
from course.scene.description.values import rgb
from course.scene.emitters import emitter_parts
from course.scene.environment_compiling import compile_environment
from course.scene.frame import Frame, bounds_of, frame_of
from course.scene.growth import check_growth
from course.scene.instancing import CONVEX, object_mesh
from course.scene.lens_compiling import compile_lens
from course.scene.light_compiling import Lit, compile_lights
from course.scene.loading import Loaded
from course.scene.lobe_compiling import compile_lobes
from course.scene.material_table import compile_materials
from course.scene.motion_compiling import check_sweeps, compile_motion
from course.scene.object_lights import material_columns
from course.scene.path_compiling import compile_paths
from course.scene.reach import in_reach
from course.scene.roughness_compiling import reflecting, with_rough_glass
from course.scene.shutter import shutter_of
from course.scene.texture_compiling import Painter, shows_texture
from course.scene.world import World


@dataclass(frozen=True)
class Compiled:
    """A world, and what its numbers were before they were compiled.

    Attributes
    ----------
    frame : where the scene file's origin and unit went
    triangles : of each object
    bounds : of each object its lowest and its highest corner, (2, 3) float64 in the units of the scene file, where the
        file puts it: what moves is there at time 0
    """

    world: World
    frame: Frame
    triangles: tuple[int, ...]
    bounds: tuple[Floats64, ...]


def compile_scene(loaded: Loaded, effects: Effects) -> Compiled:
    """Read the meshes and build everything that rays meet.

    Raises
    ------
    SceneError
        For what only shows when meshes are there; names file, line and key path.
    """
    scene, document = loaded.description, loaded.document
    shutter = shutter_of(loaded)
    meshes: list[Mesh] = []
    files: dict[str, Mesh] = {}
    bounds: list[Floats64] = []
    boxes: list[Floats64] = []
    for number, thing in enumerate(scene.objects):
        mesh = object_mesh(thing, number, document, loaded.path.parent, files)
        bounds.append(bounds_of(mesh))
        start = shutter.start(thing.motion)
        meshes.append(_moved(mesh, start))
        boxes += [bounds[-1] + start, bounds[-1] + start + shutter.sweep(thing.motion)]
    frame = frame_of(boxes)
    check_sweeps(loaded, frame, shutter)
    columns = material_columns(scene)
    used = {str(number): scene.materials[name] for number, name in enumerate(columns.names)}
    painter = _painter(used, loaded, effects, files)
    parts = [
        Part(
            frame.mesh(mesh),
            columns.of_objects[number],
            shutter.velocity(thing.motion, frame),
            None if painter is None else painter.paint(number, mesh),
            isinstance(thing, CONVEX),
        )
        for number, (mesh, thing) in enumerate(zip(meshes, scene.objects, strict=True))
    ]
    for name, material in zip(columns.names, used.values(), strict=True):
        in_range(rgb(material.emission), loaded, ("materials", name, "emission"), "the emission")
    emitters, emission = emitter_parts(loaded, frame, shutter, first_material=len(used))
    materials = compile_materials(used, emission, frame)
    motion = compile_motion(loaded, frame, shutter, effects, materials)
    surface = build_surface(
        parts + emitters,
        motion.functions if motion else None,
        bulges=scene.integrator.terminator == "round",
        # Refraction is not defined by a normal that looks away.
        bent=None if scene.integrator.shading_normals == "bent" else materials.refracts,
        hierarchy=compile_acceleration(loaded, shutter, effects),
    )
    objects = Lit(surface, columns.of_lights)
    lights, skipped = compile_lights(loaded, frame, shutter, effects, materials, objects)
    ambient = np.zeros(3)
    for light in scene.lights:
        if isinstance(light, d.AmbientLight):
            ambient += rgb(light.radiance)
    world = World(
        surface=surface,
        materials=materials,
        lights=lights,
        skipped_lights=skipped,
        ambient=in_range(ambient, loaded, ("lights",), "ambient radiance"),
        environment=compile_environment(loaded, effects),
        lobes=_lobes(used, effects, scene.integrator),
        lens=compile_lens(loaded, frame, effects),
        motion=motion,
        paths=compile_paths(scene, effects, materials, columns.of_lights.values()),
        backdrop=scene.environment.seen_by == "camera",
        keeps=scene.integrator.into_surface == "keep",
    )
    check_growth(loaded, columns.names, world)
    return Compiled(world, frame, tuple(len(mesh.triangles) for mesh in meshes), tuple(bounds))


def _painter(
    used: dict[str, d.MaterialDescription], loaded: Loaded, effects: Effects, files: dict[str, Mesh]
) -> Painter | None:
    """What paints the objects; None where no surface shows a texture."""
    if not any(shows_texture(material) for material in used.values()):
        return None
    return Painter(loaded, effects, files)


def _lobes(
    used: dict[str, d.MaterialDescription], effects: Effects, integrator: d.IntegratorDescription
) -> tuple[Lobe, ...]:
    """Of what is glossy, and of rough glass."""
    mirrors = {name: reflecting(material) for name, material in used.items()}
    lobes = compile_lobes(mirrors, effects, integrator)
    return with_rough_glass(lobes, used, effects, integrator)


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
    # What lies at x to the right is shown where -x would be; the lens, too, is mirrored.
    edges[:2] *= -1
    mirrored = make_window_camera(eye, view, up, edges, width, height, near)
    return replace(mirrored, right=-mirrored.right)
