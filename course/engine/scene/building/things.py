"""The objects of a scene as meshes, in the units of the scene file, and where they are while the shutter is open."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.meshes.named import NamedMesh
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.scene.building.frame import bounds_of
from course.engine.scene.building.motion import Shutter, shutter_of
from course.engine.scene.building.objects import object_mesh
from course.engine.shapes.mesh import Mesh


@dataclass(frozen=True)
class Things:
    """Objects, in the order of the file.

    Attributes
    ----------
    described : as the file has them
    meshes : where they are when the shutter opens
    bounds : lowest and highest corners (2, 3) float64, where the file puts them: what moves is there at time 0
    files : mesh files that were read, by their names
    """

    described: tuple[d.Object, ...]
    meshes: tuple[Mesh, ...]
    bounds: tuple[Floats64, ...]
    files: dict[str, NamedMesh]
    shutter: Shutter

    @property
    def boxes(self) -> list[Floats64]:
        """Boxes (2, 3) of each object when the shutter opens and when it closes, one after the other."""
        found = []
        for box, thing in zip(self.bounds, self.described, strict=True):
            start = box + self.shutter.start(thing.motion)
            found += [start, start + self.shutter.sweep(thing.motion)]
        return found


def read_things(loaded: Loaded) -> Things:
    """Read the meshes of all objects.

    Raises SceneError; names file, line and key path.
    """
    shutter = shutter_of(loaded)
    meshes: list[Mesh] = []
    bounds: list[Floats64] = []
    starts: list[Floats64] = []
    files: dict[str, NamedMesh] = {}
    objects = loaded.description.objects
    for number, thing in enumerate(objects):
        mesh = object_mesh(thing, number, loaded.document, loaded.path.parent, files)
        start = shutter.start(thing.motion)
        bounds.append(bounds_of(mesh))
        starts.append(bounds[-1] + start)
        meshes.append(_moved(mesh, start))
    shutter = shutter.with_camera(loaded, starts)
    return Things(tuple(objects), tuple(meshes), tuple(bounds), files, shutter)


def _moved(mesh: Mesh, by: Floats64) -> Mesh:
    if not by.any():
        return mesh
    return Mesh(np.add(mesh.vertices, by), mesh.triangles, mesh.normals, mesh.uv)
