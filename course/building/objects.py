"""From object descriptions to meshes in the units of the scene file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from course import shapes
from course.core.triangles import Mesh
from course.core.types import Floats64
from course.errors import GeometryError, SceneError
from course.formats.meshes import transforms
from course.formats.yaml import description as d
from course.formats.yaml.document import Document
from course.formats.yaml.loading import bytes_of_files
from course.inputs import Bound

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

    Parameters
    ----------
    files : mesh files that have been read already, by their normals and names in the scene; this one is added

    Raises
    ------
    SceneError
        When a mesh file can't be used, or a shape or a transform is impossible; names the object's line.
    """
    path = ("objects", number)
    try:
        mesh = _local_mesh(thing, folder, {} if files is None else files, bytes_of_files(document))
        if thing.transform:
            mesh = transforms.apply(
                mesh, transforms.compose([_matrix(step) for step in thing.transform])
            )
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
    match thing:
        case d.Quad():
            return shapes.quad(thing.width, thing.depth)
        case d.Box():
            return shapes.box(thing.size)
        case d.Sphere():
            return shapes.sphere(thing.radius, thing.segments)
        case d.Disk():
            return shapes.disk(thing.radius, thing.segments)
        case d.Cylinder():
            return shapes.cylinder(thing.radius, thing.height, thing.segments)
        case d.Cone():
            return shapes.cone(thing.radius, thing.height, thing.segments)
        case d.Torus():
            return shapes.torus(thing.radius, thing.tube, thing.segments, thing.sides)
        case d.TorusKnot():
            return shapes.torus_knot(
                thing.p, thing.q, thing.radius, thing.tube, thing.segments, thing.sides
            )
        case d.DisplacedSphere():
            return shapes.displaced_sphere(
                thing.radius, thing.amplitude, thing.frequency, thing.segments, thing.seed
            )
        case d.HeightField():
            return shapes.height_field(
                thing.size, thing.amplitude, thing.frequency, thing.segments, thing.seed
            )


def _matrix(step: d.Transform) -> Floats64:
    match step:
        case d.Translate():
            return transforms.translate(np.array(step.translate))
        case d.Scale():
            return transforms.scale(np.broadcast_to(np.array(step.scale, np.float64), (3,)))
        case d.Rotate():
            return transforms.rotate(np.array(step.rotate.axis), step.rotate.degrees)
        case d.Affine():
            return np.array(step.matrix, np.float64)
