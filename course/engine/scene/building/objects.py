"""From object descriptions to meshes in the units of the scene file."""

import warnings
from pathlib import Path

import msgspec
import numpy as np

from course.base.errors import CourseWarning, GeometryError, SceneError
from course.base.inputs import InputLimit
from course.engine import shapes
from course.engine.formats.meshes import transforms
from course.engine.formats.meshes.named import NamedMesh
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.document import Document, show
from course.engine.formats.yaml.loading import bytes_of_files
from course.engine.formats.yaml.parting import listed
from course.engine.formats.yaml.suggestions import suggest
from course.engine.shapes.mesh import Mesh

CONVEX = (d.Sphere, d.Box, d.Cylinder, d.Cone)
"""Shapes that are closed and convex, however they are transformed."""


def object_mesh(
    thing: d.Object,
    number: int,
    document: Document,
    folder: Path,
    files: dict[str, NamedMesh] | None = None,
) -> Mesh:
    """The mesh of one object, transformed.

    Raises SceneError when a mesh file can't be used, or a shape or a transform is impossible; names the object's line.
    ``files``: mesh files that have been read already, by their normals and names in the scene; this one is added.
    """
    path = ("objects", number)
    try:
        where = document.where((*path, "material"))
        mesh = _local_mesh(
            thing, where, folder, {} if files is None else files, bytes_of_files(document)
        )
        if thing.transform:
            steps = map(transforms.of_step, msgspec.to_builtins(thing.transform))
            mesh = transforms.apply(mesh, transforms.compose(steps))
    except (GeometryError, ValueError) as error:
        key = (*path, "file") if isinstance(thing, d.MeshFile) else path
        raise SceneError(f"{document.where(key)}: objects[{number}]: {error}") from error
    if thing.shading == "flat":
        mesh = Mesh(mesh.vertices, mesh.triangles, None, mesh.uv)
    return mesh


def _local_mesh(
    thing: d.Object, where: str, folder: Path, files: dict[str, NamedMesh], bound: InputLimit
) -> Mesh:
    if isinstance(thing, d.MeshFile):
        # The readers are many; a scene of named shapes never imports them.
        from course.engine.formats.meshes.files import read_named_mesh

        read = f"{thing.normals} {thing.file}"
        if read not in files:
            files[read] = read_named_mesh(folder / thing.file, thing.normals, bound)
            if len(files[read].names) > 1 and thing.only is None:
                warnings.warn(
                    f"{where}: {listed(list(files[read].names))} of {thing.file} all have material"
                    f" {show(thing.material)}; materials gives them others",
                    CourseWarning,
                    stacklevel=2,
                )
        return files[read].mesh if thing.only is None else _only(thing, files[read])
    # A shape's own keys are the parameters of the function of its name.
    own = [name for name in thing.__struct_fields__ if name not in d.SHARED]
    mesh: Mesh = getattr(shapes, str(thing.__struct_config__.tag))(
        **{name: getattr(thing, name) for name in own}
    )
    return mesh


def _only(thing: d.MeshFile, found: NamedMesh) -> Mesh:
    """The faces of some of a file's materials; GeometryError where it hasn't one of them."""
    assert thing.only is not None
    for name in thing.only:
        if name not in found.names:
            hint = suggest(name, found.names)
            raise GeometryError(
                f"only: no face of {thing.file} has a material {show(name)}; {hint}"
            )
    numbers = [found.names.index(name) for name in thing.only]
    mesh = found.mesh
    triangles = mesh.triangles[np.isin(found.name, numbers)]
    used, corners = np.unique(triangles, return_inverse=True)
    normals, uv = (None if rows is None else rows[used] for rows in (mesh.normals, mesh.uv))
    corners = corners.reshape(-1, 3).astype(triangles.dtype)
    return Mesh(mesh.vertices[used], corners, normals, uv)
