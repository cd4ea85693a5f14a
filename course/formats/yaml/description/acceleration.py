"""`acceleration`: what finds the triangle that a ray hits."""

from __future__ import annotations

from typing import Annotated, Literal

from course.formats.yaml.description.values import Map, about


class AccelerationDescription(Map, frozen=True, kw_only=True):
    """Who answers the rays: the picture is the same, the time is not."""

    type: Annotated[
        Literal["embree", "hierarchy"],
        about(
            "`embree`: the library; `hierarchy`: `build` and `traverse` of the module bounding_volumes,"
            " for small pictures of what stands still. `course radiosity` takes Embree anyway."
        ),
    ] = "embree"
    leaf_size: Annotated[
        int, about("Most triangles in a leaf of the hierarchy.", ge=1, le=1024)
    ] = 4
