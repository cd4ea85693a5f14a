"""`objects`: a union told apart by `shape`; y is up, and every shape is centred on the origin."""

from __future__ import annotations

from typing import Annotated, Final, Literal, TypeAlias

import msgspec

from course.formats.yaml.description.motion import MotionDescription
from course.formats.yaml.description.transforms import Transform
from course.formats.yaml.description.values import Map, about

MOST_KNOT_SEGMENTS: Final = 16384
"""Flat pieces along the tube of a knot."""

_Length: TypeAlias = Annotated[float, msgspec.Meta(gt=0)]
_Segments: TypeAlias = Annotated[int, about("Flat pieces around the axis.", ge=3, le=4096)]


class ObjectDescription(Map, frozen=True, kw_only=True, tag_field="shape"):
    """The keys that all shapes share."""

    material: Annotated[str, about("Name of one of the materials.", min_length=1)]
    name: Annotated[str, about("Name for messages, tables and lights of type object.")] = ""
    shading: Annotated[
        Literal["smooth", "flat"], about("Interpolated normals, or one for each triangle.")
    ] = "smooth"
    transform: Annotated[
        tuple[Transform, ...], about("Steps applied in order, the first one first.")
    ] = ()
    motion: Annotated[MotionDescription, about("How the object moves.")] = MotionDescription()
    from_behind: Annotated[
        Literal["turned", "kept", "unseen"],
        about(
            "What camera rays see that come upon a triangle from behind: it, with its normals turned to the viewer; it,"
            " with normals as they are, which needs integrator.shading_normals: interpolated; or what lies behind it."
            " Other rays see it in any case."
        ),
    ] = "turned"


class Quad(ObjectDescription, frozen=True, kw_only=True, tag="quad"):
    """A rectangle in the plane of x and z; its normal is +y."""

    width: Annotated[float, about("Extent along x.", "world unit", gt=0)] = 1.0
    depth: Annotated[float, about("Extent along z.", "world unit", gt=0)] = 1.0


class Box(ObjectDescription, frozen=True, kw_only=True, tag="box"):
    """A box along the axes."""

    size: Annotated[
        tuple[_Length, _Length, _Length], about("Extents along x, y and z.", "world unit")
    ] = (1.0, 1.0, 1.0)


class Sphere(ObjectDescription, frozen=True, kw_only=True, tag="sphere"):
    """A sphere of triangles with smooth normals."""

    radius: Annotated[float, about("Radius.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Disk(ObjectDescription, frozen=True, kw_only=True, tag="disk"):
    """A disk in the plane of x and z; its normal is +y."""

    radius: Annotated[float, about("Radius.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Cylinder(ObjectDescription, frozen=True, kw_only=True, tag="cylinder"):
    """A cylinder about y, with flat caps."""

    radius: Annotated[float, about("Radius.", "world unit", gt=0)] = 0.5
    height: Annotated[float, about("Extent along y.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Cone(ObjectDescription, frozen=True, kw_only=True, tag="cone"):
    """A cone about y, its tip up, with a flat base."""

    radius: Annotated[float, about("Radius of the base.", "world unit", gt=0)] = 0.5
    height: Annotated[float, about("Extent along y.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Torus(ObjectDescription, frozen=True, kw_only=True, tag="torus"):
    """A ring about y."""

    radius: Annotated[float, about("Radius of the ring's middle line.", "world unit", gt=0)] = 1.0
    tube: Annotated[float, about("Radius of the tube, less than radius.", "world unit", gt=0)] = (
        0.25
    )
    segments: _Segments = 96
    sides: Annotated[int, about("Flat pieces around the tube.", ge=3, le=4096)] = 48


class TorusKnot(ObjectDescription, frozen=True, kw_only=True, tag="torus_knot"):
    """A tube along the (p, q) knot on a torus; p and q have no common divisor."""

    p: Annotated[int, about("Turns about the axis.", ge=1, le=32)] = 2
    q: Annotated[int, about("Turns through the hole.", ge=1, le=32)] = 3
    radius: Annotated[float, about("Radius of the torus.", "world unit", gt=0)] = 1.0
    tube: Annotated[
        float,
        about("Radius of the tube, so thin that it meets itself nowhere.", "world unit", gt=0),
    ] = 0.2
    segments: Annotated[
        int, about("Flat pieces along the tube, at least 8 (p + q).", ge=16, le=MOST_KNOT_SEGMENTS)
    ] = 512
    sides: Annotated[int, about("Flat pieces around the tube.", ge=3, le=1024)] = 32


class DisplacedSphere(ObjectDescription, frozen=True, kw_only=True, tag="displaced_sphere"):
    """A bumpy ball: a sphere moved along its normal by a sum of smooth waves."""

    radius: Annotated[float, about("Radius without the bumps.", "world unit", gt=0)] = 1.0
    amplitude: Annotated[
        float, about("Height of the bumps, less than radius.", "world unit", ge=0)
    ] = 0.1
    frequency: Annotated[float, about("Bumps around the ball.", gt=0, le=1e6)] = 6.0
    segments: Annotated[int, about("Flat pieces around the axis.", ge=3, le=4096)] = 256
    seed: Annotated[int, about("Chooses the waves.", ge=0, le=2**32 - 1)] = 0


class HeightField(ObjectDescription, frozen=True, kw_only=True, tag="height_field"):
    """Hills over the plane of x and z: a sum of smooth waves."""

    size: Annotated[tuple[_Length, _Length], about("Extents along x and z.", "world unit")] = (
        1.0,
        1.0,
    )
    amplitude: Annotated[float, about("Height of the hills.", "world unit", ge=0)] = 0.1
    frequency: Annotated[float, about("Waves across the field.", gt=0, le=1e6)] = 4.0
    segments: Annotated[int, about("Cells along each side.", ge=1, le=4096)] = 128
    seed: Annotated[int, about("Chooses the waves.", ge=0, le=2**32 - 1)] = 0


class MeshFile(ObjectDescription, frozen=True, kw_only=True, tag="mesh"):
    """A mesh from a PLY, OBJ, STL or GLB file."""

    file: Annotated[str, about("Path of the file, relative to the scene file.", min_length=1)]
    normals: Annotated[
        Literal["angle", "area"],
        about(
            "By what the faces around a vertex count in its normal, where the file has none: `angle`, and vertices at"
            " one place are smooth up to 40 degrees; `area`, and only those that faces share are smooth."
        ),
    ] = "angle"


Object: TypeAlias = (
    Quad
    | Box
    | Sphere
    | Disk
    | Cylinder
    | Cone
    | Torus
    | TorusKnot
    | DisplacedSphere
    | HeightField
    | MeshFile
)
