"""From a METU scene file to scene files of the project's own format, one for each camera."""

import math
import os
import re
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any, Final

import numpy as np
import yaml

from course.base.atomic import write_text
from course.base.errors import SceneError
from course.engine.formats.metu.brdfs import pi_is_of_surfaces, read_brdfs
from course.engine.formats.metu.cameras import MetuCamera, read_cameras
from course.engine.formats.metu.element import MetuElement, Notes
from course.engine.formats.metu.lights import read_environment, read_images, read_lights
from course.engine.formats.metu.materials import material_name, read_materials
from course.engine.formats.metu.meshes import MeshTable, read_vertices
from course.engine.formats.metu.objects import Objects
from course.engine.formats.metu.reading import read_elements
from course.engine.formats.metu.textures import Textures, read_maps, read_places
from course.engine.formats.metu.transformations import read_steps
from course.engine.formats.yaml.description import DEEPEST
from course.engine.formats.yaml.loading import load_description

CUTOFF: Final = 1e-6
"""Bounced rays with less throughput are dropped; a METU scene drops none, but nobody sees these."""

DEPTH: Final = 6
"""Bounces that are followed where a scene doesn't say how many."""

OFFSET: Final = 1e-3
"""The distance from a surface at which rays leave it, where a scene doesn't say."""


@dataclass(frozen=True)
class Converted:
    """One camera's scene.

    Attributes
    ----------
    camera : its id
    image : the picture's name as the METU scene has it, .png or .exr
    path : the converted scene file
    """

    camera: str
    image: str
    path: Path


def convert(source: Path, target: Path) -> tuple[list[Converted], list[str]]:
    """Convert a METU scene.

    Parameters
    ----------
    source : XML or JSON
    target : the scene file to write, .yaml; where there are several cameras, each has a file of its own beside it,
        NAME.PICTURE.yaml. Meshes that the scene holds itself go to the folder NAME.meshes, other mesh files stay
        where they are.

    Returns
    -------
    scenes : in the order of the cameras
    warnings : what was left out or changed, each with its place in the file

    Raises
    ------
    SceneError
        For the first mistake; names file, line where there is one, and element.
    OutputError
        Something can't be written.
    """
    scene = read_elements(source)
    notes = Notes()
    steps = read_steps(scene)
    cameras = read_cameras(scene, steps, notes)
    eyes = [camera.camera["eye"] for camera in cameras]
    meshes = MeshTable(target.parent, f"{target.stem}.meshes", notes)
    common = _common(scene, source, steps, eyes, notes, meshes)
    for camera in cameras:
        camera.paths.check(scene, common, notes)
    notes.add_left_over(scene)
    meshes.write()
    names = _file_names(cameras, target)
    converted = []
    for camera, name in zip(cameras, names, strict=True):
        parts = {
            "title": f"{source.stem}, camera {camera.name}",
            "camera": camera.camera,
            "film": camera.film,
            "sampler": camera.sampler,
            **common,
            "integrator": common["integrator"] | camera.paths.keys(common["integrator"]),
        }
        path = target.with_name(name)
        text = yaml.dump(parts, Dumper=_Dumper, sort_keys=False, default_flow_style=None, width=110)
        write_text(
            path, f"# Converted from {ascii(source.name)[1:-1]} by `course convert`.\n{text}"
        )
        try:
            load_description(path)
        except SceneError as error:
            raise retold(error, source, path) from None
        converted.append(Converted(camera.name, camera.image, path))
    return converted, notes.texts()


def retold(error: SceneError, source: Path, path: Path) -> SceneError:
    """An error about a converted scene as one about the METU scene that it comes from."""
    told = re.sub(rf"^{re.escape(str(path))}(:\d+)?: ", "", str(error))
    return SceneError(f"{source}: as a scene of this course: {_with_name(told, path)}")


def _with_name(told: str, path: Path) -> str:
    """A message about an object of a converted scene with that object's name, such as `mesh 2`, and its file's."""
    found = re.match(r"objects\[(\d+)\]: ", told)
    if found is None:
        return told
    thing = yaml.safe_load(path.read_text(encoding="utf-8"))["objects"][int(found[1])]
    rest = told[found.end() :]
    if "file" in thing:
        # Named relative to a temporary folder, a file's path goes up and down again.
        file = path.parent / thing["file"]
        rest = rest.replace(str(file), os.path.normpath(file))
    return found[0] + (f"{thing['name']}: " if "name" in thing else "") + rest


def _common(
    scene: MetuElement,
    source: Path,
    steps: dict[str, dict[str, Any]],
    eyes: list[list[float]],
    notes: Notes,
    meshes: MeshTable,
) -> dict[str, Any]:
    """The scene that all cameras see."""
    _pass_over_empty(scene)
    # Hits are found by Embree, which has no tolerance to set.
    scene.number_of("IntersectionTestEpsilon", 0.0)
    of_surfaces = pi_is_of_surfaces(scene)
    materials, bodies = read_materials(scene, notes, read_brdfs(scene), of_surfaces)
    lights = read_lights(scene, steps, 1.0 if of_surfaces else math.pi)
    ambient = [light["radiance"] for light in lights if light["type"] == "ambient"]
    images = read_images(scene)
    textures = Textures(
        read_maps(scene, images, source.parent),
        read_places(scene),
        np.sum([[0.0, 0.0, 0.0], *ambient], axis=0),
        bodies,
        meshes,
    )
    objects = Objects(
        read_vertices(scene), materials, steps, source.parent, meshes, notes, eyes, textures
    )
    things = objects.read(scene)
    return {
        "integrator": {
            "max_depth": _depth(scene, notes),
            # METU's renderers ask every light at every hit.
            "light_sampling": "all",
            "cutoff": CUTOFF,
            # What is below a surface meets it again, and facets shade each other.
            "into_surface": "keep",
            "terminator": "facets",
            "shading_normals": "interpolated",
            "surface_offset": scene.number_of("ShadowRayEpsilon", OFFSET),
        },
        "environment": read_environment(
            scene, images, meshes.name_of, source.parent, textures.background
        ),
        "materials": {material_name(number): keys for number, keys in materials.items()}
        | objects.lamps
        | textures.made,
        "lights": [
            *lights,
            *({"type": "object", "object": name} for name in objects.lamps),
            *objects.balls,
        ],
        "objects": things,
    }


def _depth(scene: MetuElement, notes: Notes) -> int:
    element = scene.maybe("MaxRecursionDepth")
    depth = DEPTH if element is None else element.whole(0)
    if element is not None and depth > DEEPEST:
        notes.add(element, f"is {depth}: {DEEPEST} bounces are followed")
    return min(depth, DEEPEST)


def _pass_over_empty(scene: MetuElement) -> None:
    """A table that other scenes have, and that stands here without anything in it, is no loss."""
    tables = [each for each in scene.children if each.tag == "NormalData"]
    if not any(each.text.strip() or each.children for each in tables):
        scene.all("NormalData")


def _file_names(cameras: list[MetuCamera], target: Path) -> list[str]:
    if len(cameras) == 1:
        return [target.name]
    names: list[str] = []
    for camera in cameras:
        stem = f"{target.stem}.{PurePath(camera.image).stem}"
        name, more = f"{stem}{target.suffix}", len(names)
        while name in names:
            more += 1
            name = f"{stem}-{more}{target.suffix}"
        names.append(name)
    return names


class _Dumper(yaml.SafeDumper):
    """Writes everything out: no anchors."""

    def ignore_aliases(self, data: Any) -> bool:
        return True
