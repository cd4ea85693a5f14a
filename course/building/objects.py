"""From object descriptions to meshes in the units of the scene file."""

from pathlib import Path

import msgspec

from course import shapes
from course.errors import GeometryError, SceneError
from course.formats.meshes import transforms
from course.formats.yaml import description as d
from course.formats.yaml.document import Document
from course.formats.yaml.loading import bytes_of_files
from course.inputs import Bound
from course.shapes.mesh import Mesh

CONVEX = (d.Sphere, d.Box, d.Cylinder, d.Cone)
"""Shapes that are closed and convex, however they are transformed."""


def object_mesh(
    thing: d.Object,
    number: int,
    document: Document,
    folder: Path,
    files: dict[str, Mesh] | None = None,
) -> Mesh:
    """The mesh of one object, transformed.

    Raises SceneError when a mesh file can't be used, or a shape or a transform is impossible; names the object's line.
    ``files``: mesh files that have been read already, by their normals and names in the scene; this one is added.
    """
    path = ("objects", number)
    try:
        mesh = _local_mesh(thing, folder, {} if files is None else files, bytes_of_files(document))
        if thing.transform:
            steps = map(transforms.of_step, msgspec.to_builtins(thing.transform))
            mesh = transforms.apply(mesh, transforms.compose(steps))
    except (GeometryError, ValueError) as error:
        key = (*path, "file") if isinstance(thing, d.MeshFile) else path
        raise SceneError(f"{document.where(key)}: objects[{number}]: {error}") from error
    if thing.shading == "flat":
        mesh = Mesh(mesh.vertices, mesh.triangles, None, mesh.uv)
    return mesh


def _local_mesh(thing: d.Object, folder: Path, files: dict[str, Mesh], bound: Bound) -> Mesh:
    if isinstance(thing, d.MeshFile):
        # trimesh behind it is heavy; a scene of named shapes never imports it.
        from course.formats.meshes.files import read_mesh

        read = f"{thing.normals} {thing.file}"
        if read not in files:
            files[read] = read_mesh(folder / thing.file, thing.normals, bound)
        return files[read]
    # A shape's own keys are the parameters of the function of its name.
    own = [name for name in thing.__struct_fields__ if name not in d.SHARED]
    mesh: Mesh = getattr(shapes, str(thing.__struct_config__.tag))(
        **{name: getattr(thing, name) for name in own}
    )
    return mesh
