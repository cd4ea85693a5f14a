"""`environment`: what a ray sees that hits nothing; a union told apart by `type`."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from course.formats.yaml.description.values import Color, Map, about

_Lights: TypeAlias = Annotated[
    bool, about("Whether it also lights diffuse surfaces, by one shadow ray for each sample.")
]
_Sampling: TypeAlias = Annotated[
    Literal["automatic", "uniform", "cosine", "power"],
    about(
        "How directions towards its light are chosen: `automatic`, by the cosine and the picture's brightness; or by"
        " the module importance_sampling, `uniform`, by the `cosine`, or half and half with the `power` heuristic."
    ),
]
_SeenBy: TypeAlias = Annotated[
    Literal["all", "camera"],
    about("Which rays see it: all of them, or only those from the camera, like a backdrop."),
]
_Scale: TypeAlias = Annotated[Color, about("Radiance of white.", "W/(m^2 sr)")]
_Lookup: TypeAlias = Annotated[
    Literal["seamless", "clamped"],
    about("Whether the interpolation goes on across the cube's edges."),
]


class EnvironmentDescription(Map, frozen=True, kw_only=True, tag_field="type"):
    """What all environments have in common: `type` tells them apart."""


class ConstantEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="constant"):
    """The same radiance from every direction."""

    radiance: Annotated[Color, about("Radiance of the background.", "W/(m^2 sr)")] = 0.0
    lights: _Lights = False
    sampling: _Sampling = "automatic"
    seen_by: _SeenBy = "all"


class CubeEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="cube"):
    """Six square pictures around the scene, PNG, JPEG, EXR or Radiance HDR; exactly one of faces and cross."""

    faces: Annotated[
        tuple[str, str, str, str, str, str] | None,
        about("Files of the faces +x, -x, +y, -y, +z, -z, in the OpenGL orientation."),
    ] = None
    cross: Annotated[str | None, about("File of a horizontal (4:3) or vertical (3:4) cross.")] = (
        None
    )
    scale: _Scale = 1.0
    lookup: _Lookup = "seamless"
    lights: _Lights = False
    sampling: _Sampling = "automatic"
    seen_by: _SeenBy = "all"


class LatLongEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="lat_long"):
    """A picture of all directions, longitude by latitude: -z in its middle, +x to the right of it, +y at its top."""

    image: Annotated[
        str,
        about("File of the picture, twice as wide as high: PNG, JPEG, EXR or HDR.", min_length=1),
    ]
    size: Annotated[
        Annotated[int, msgspec.Meta(ge=1, le=8192)] | None,
        about("Edge of the cube's faces; half the height if null.", "pixel"),
    ] = None
    scale: _Scale = 1.0
    lookup: _Lookup = "seamless"
    lights: _Lights = False
    sampling: _Sampling = "automatic"
    seen_by: _SeenBy = "all"


Environment: TypeAlias = ConstantEnvironment | CubeEnvironment | LatLongEnvironment
