"""`transform` of an object: a list of steps, each a map with one key.

In the file a step is told by its only key, `{translate: [0, 1, 0]}`. A union of Structs needs a
tag, so loading adds `STEP: translate` to each step before it is converted; it stands in no file.
"""

from __future__ import annotations

from typing import Annotated, Final, TypeAlias

from course.formats.yaml.description.values import Map, Vector, about

STEP: Final = "<step>"

Row: TypeAlias = tuple[float, float, float, float]


class TransformStep(Map, frozen=True, kw_only=True, tag_field=STEP):
    """What all steps have in common."""


class Rotation(Map, frozen=True, kw_only=True):
    """A turn about an axis through the origin; counter-clockwise seen from the axis' tip."""

    axis: Annotated[Vector, about("Direction of the axis; any length but 0.")]
    degrees: Annotated[float, about("Angle of the turn.", "degree")]


class Translate(TransformStep, frozen=True, kw_only=True, tag="translate"):
    """Move."""

    translate: Annotated[Vector, about("How far to move along x, y and z.", "world unit")]


class Scale(TransformStep, frozen=True, kw_only=True, tag="scale"):
    """Scale about the origin; negative factors mirror."""

    scale: Annotated[float | Vector, about("Factor, or one for each of x, y and z; none is 0.")]


class Rotate(TransformStep, frozen=True, kw_only=True, tag="rotate"):
    """Turn."""

    rotate: Annotated[Rotation, about("Axis and angle.")]


class Affine(TransformStep, frozen=True, kw_only=True, tag="matrix"):
    """Any affine map."""

    matrix: Annotated[
        tuple[Row, Row, Row, Row],
        about(
            "Rows of the matrix that takes a place, as the column (x, y, z, 1), to where it goes;"
            " the last one is 0 0 0 1, and nothing is flattened."
        ),
    ]


Transform: TypeAlias = Translate | Scale | Rotate | Affine
