"""`camera`: where the picture is taken from, through which lens, and for how long."""

from __future__ import annotations

from typing import Annotated, Literal

from course.formats.yaml.description.motion import MotionDescription
from course.formats.yaml.description.values import Map, Vector, about


class LensDescription(Map, frozen=True, kw_only=True):
    """A thin lens; exactly one of focus_distance and focus_point."""

    aperture_radius: Annotated[
        float, about("Radius of the lens; 0 is a pinhole.", "world unit", ge=0)
    ]
    shape: Annotated[
        Literal["disk", "square", "polygon"],
        about("Shape of the aperture: a disk, the square around it, or a regular polygon in it."),
    ] = "disk"
    blades: Annotated[int, about("Corners of the polygon.", ge=3, le=32)] = 6
    samples: Annotated[
        Literal["point", "polar", "rejection"],
        about(
            "What places points on a disk: `point_on_disk` of the module thin_lens, or `disk_by_polar` or "
            "`disk_by_rejection` of the module sampling. The last one draws numbers of its own."
        ),
    ] = "point"
    focus_distance: Annotated[
        float | None, about("Distance of the plane in focus, along the view.", "world unit")
    ] = None
    focus_point: Annotated[Vector | None, about("A point of the plane in focus.", "world unit")] = (
        None
    )


class ShutterDescription(Map, frozen=True, kw_only=True):
    """When the shutter opens and closes; it only matters where something moves."""

    open: Annotated[float, about("When it opens.", "second")] = 0.0
    close: Annotated[float, about("When it closes, not before it opens.", "second")] = 1.0


class ImagePlaneDescription(Map, frozen=True, kw_only=True):
    """The picture as a rectangle in front of the eye; it may lie off the view's axis, and stretch its pixels."""

    distance: Annotated[
        float, about("Its distance from the eye, along the view.", "world unit", gt=0)
    ] = 1.0
    left: Annotated[
        float, about("Where its left edge is, seen from the view's axis.", "world unit")
    ]
    right: Annotated[float, about("Its right edge, more than left.", "world unit")]
    bottom: Annotated[float, about("Its lower edge.", "world unit")]
    top: Annotated[float, about("Its upper edge, more than bottom.", "world unit")]


class CameraDescription(Map, frozen=True, kw_only=True):
    """A perspective camera."""

    eye: Annotated[Vector, about("Centre of projection.", "world unit")]
    look_at: Annotated[Vector, about("Point in the middle of the picture.", "world unit")]
    up: Annotated[Vector, about("Direction that points up in the picture; any length but 0.")] = (
        0.0,
        1.0,
        0.0,
    )
    vertical_fov: Annotated[
        float, about("Angle from the picture's lower to its upper edge.", "degree", gt=0, lt=180)
    ] = 40.0
    image_plane: Annotated[
        ImagePlaneDescription | None, about("The picture's edges; they replace vertical_fov.")
    ] = None
    handedness: Annotated[
        Literal["right", "left"],
        about("Whether the picture shows what is to the right on the right; left mirrors it."),
    ] = "right"
    near: Annotated[
        float,
        about(
            "The camera sees nothing that is nearer than this along the view.", "world unit", ge=0
        ),
    ] = 0.0
    lens: Annotated[LensDescription | None, about("A thin lens; null for a pinhole.")] = None
    shutter: Annotated[ShutterDescription, about("When light is let in.")] = ShutterDescription()
    motion: Annotated[MotionDescription, about("How the camera moves.")] = MotionDescription()
