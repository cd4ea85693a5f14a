"""`lights`: a union told apart by `type`."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import msgspec

from course.scene.description.values import Color, Vector, about

_Intensity: TypeAlias = Annotated[
    Color | None,
    about("Every point of the light carries this whole intensity; or give radiance.", "W/sr"),
]
_Radiance: TypeAlias = Annotated[
    Color | None,
    about("Lambertian emission, which the camera sees; or give intensity.", "W/(m^2 sr)"),
]


class LightDescription(
    msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag_field="type"
):
    """What all lights have in common: `type` tells them apart."""


class AmbientLight(LightDescription, frozen=True, kw_only=True, tag="ambient"):
    """Light that is everywhere and casts no shadow."""

    radiance: Annotated[Color, about("Radiance from every direction.", "W/(m^2 sr)")]


class PointLight(LightDescription, frozen=True, kw_only=True, tag="point"):
    """A light without extent."""

    position: Annotated[Vector, about("Where it is.", "world unit")]
    intensity: Annotated[Color, about("Radiant intensity.", "W/sr")]


class DirectionalLight(LightDescription, frozen=True, kw_only=True, tag="directional"):
    """A light infinitely far away."""

    direction: Annotated[Vector, about("Direction the light travels in; any length but 0.")]
    irradiance: Annotated[Color, about("Irradiance of a surface that faces it.", "W/m^2")]


class RectangleLight(LightDescription, frozen=True, kw_only=True, tag="rectangle"):
    """A parallelogram; by radiance it emits towards cross(edge_u, edge_v) only."""

    corner: Annotated[Vector, about("One corner.", "world unit")]
    edge_u: Annotated[Vector, about("Edge from the corner.", "world unit")]
    edge_v: Annotated[Vector, about("Other edge from the corner.", "world unit")]
    intensity: _Intensity = None
    radiance: _Radiance = None


class SphereLight(LightDescription, frozen=True, kw_only=True, tag="sphere"):
    """A ball; by radiance its radius must be over 0."""

    center: Annotated[Vector, about("Centre.", "world unit")]
    radius: Annotated[float, about("Radius.", "world unit", ge=0)]
    intensity: _Intensity = None
    radiance: _Radiance = None


Light: TypeAlias = AmbientLight | PointLight | DirectionalLight | RectangleLight | SphereLight
