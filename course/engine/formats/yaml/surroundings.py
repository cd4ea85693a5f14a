"""Dielectrics that lie in others, such as a glass ball in water: what surrounds each, as the scene file says.

A boundary bends light by the ratio of the two indices, and a ray that leaves the inner medium is in the outer one. A
material says itself what it lies in (``surrounded_by``), so that rays need not keep a list of what they have entered,
and scenes in which nothing lies in anything pay nothing.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.types import Floats64, Media
from course.engine.formats.meshes.parts import same
from course.engine.formats.yaml.description import MaterialDescription, SceneDescription
from course.engine.formats.yaml.document import Document

if TYPE_CHECKING:
    # A scene that is only read needs no shapes.
    from course.engine.shapes.mesh import Mesh

NOWHERE = np.int16(-1)
"""What surrounds a dielectric in vacuum, and the column of what no object is made of."""

MOST_LOOKED_AT = 256
"""Dielectric objects of which every two are compared, and pairs of them in which boxes are not enough to tell."""


def in_its_surroundings(
    material: MaterialDescription, materials: dict[str, MaterialDescription]
) -> MaterialDescription:
    """The material with its index of refraction against what surrounds it."""
    glass = material.dielectric
    if glass is None or glass.surrounded_by is None:
        return material
    outer = materials[glass.surrounded_by].dielectric
    assert outer is not None
    ratio = glass.refraction_index / outer.refraction_index
    return msgspec.structs.replace(
        material, dielectric=msgspec.structs.replace(glass, refraction_index=ratio)
    )


def outsides(
    names: Sequence[str], materials: dict[str, MaterialDescription], columns: int
) -> Media | None:
    """The column (columns,) of what surrounds each material, NOWHERE for vacuum; None where all lie in vacuum.

    ``names``: of the materials of the first columns.
    """
    found = np.full(columns, NOWHERE)
    for column, name in enumerate(names):
        glass = materials[name].dielectric
        if glass is not None and glass.surrounded_by in names:
            found[column] = names.index(glass.surrounded_by)
    return found if (found >= 0).any() else None


def warn_of_nested(
    description: SceneDescription,
    document: Document,
    bounds: Sequence[Floats64],
    meshes: Sequence[Mesh],
) -> None:
    """Warn, once, of a dielectric that lies in another and doesn't say so: it is bent as if it lay in vacuum.

    Parameters
    ----------
    bounds : (2, 3) each, the lowest and the highest corner of the objects
    meshes : of the objects
    """
    things = description.objects
    glasses = {
        name: m.dielectric for name, m in description.materials.items() if m.dielectric is not None
    }
    clear = [number for number, thing in enumerate(things) if thing.material in glasses]
    if len(clear) < 2:
        return
    clear = clear[:MOST_LOOKED_AT]
    low, high = np.moveaxis(np.array([bounds[number] for number in clear]), 1, 0)
    within = (low[:, None] > low).all(axis=2) & (high[:, None] < high).all(axis=2)
    for a, b in np.argwhere(within)[:MOST_LOOKED_AT]:
        inner, outer = clear[a], clear[b]
        mine, theirs = things[inner].material, things[outer].material
        glass = glasses[mine]
        if mine == theirs or glass.surrounded_by is not None or glass.refraction_index < 1:
            continue
        if _touch(meshes[outer], meshes[inner]):
            # Where two share vertices they are parts of one surface, such as that of water in a tumbler.
            continue
        if _contains(meshes[outer], meshes[inner].vertices[0]):
            warnings.warn(
                f"{document.where(('objects', inner))}: objects[{inner}] ({mine}) lies inside objects[{outer}] "
                f"({theirs}), but light is bent as if it lay in vacuum: give materials.{mine}.dielectric "
                f"`surrounded_by: {theirs}`",
                CourseWarning,
                stacklevel=2,
            )
            return


def _touch(first: Mesh, second: Mesh) -> bool:
    """Whether two meshes have a vertex at one place."""
    _, place = same(*np.concatenate((first.vertices, second.vertices)).T)
    return bool(np.isin(place[len(first.vertices) :], place[: len(first.vertices)]).any())


_ASKEW = np.array([0.5431, 0.6173, 0.5692])
"""A direction along which no edge of a made mesh lies."""


def _contains(mesh: Mesh, point: Floats64) -> bool:
    """True if a ray from the point crosses a mesh an odd number of times (Möller and Trumbore, 1997)."""
    p0, p1, p2 = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    e1, e2, s = p1 - p0, p2 - p0, point - p0
    h, q = np.cross(_ASKEW, e2), np.cross(s, e1)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = 1 / np.einsum("ij,ij->i", e1, h)
        u, v = inverse * np.einsum("ij,ij->i", s, h), inverse * (q @ _ASKEW)
        t = inverse * np.einsum("ij,ij->i", e2, q)
        met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return bool(met.sum() % 2)
