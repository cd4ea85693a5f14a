"""`lights`: a union told apart by `type`."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from course.formats.yaml.description.motion import MotionDescription
from course.formats.yaml.description.values import Color, Map, Vector, about

_Intensity: TypeAlias = Annotated[
    Color | None,
    about("Every point of the light carries this whole intensity; or give radiance.", "W/sr"),
]
_Radiance: TypeAlias = Annotated[
    Color | None,
    about("Lambertian emission, which the camera sees; or give intensity.", "W/(m^2 sr)"),
]
_Motion: TypeAlias = Annotated[MotionDescription, about("How the light moves.")]


class LightDescription(Map, frozen=True, kw_only=True, tag_field="type"):
    """What all lights have in common: `type` tells them apart."""


class AmbientLight(LightDescription, frozen=True, kw_only=True, tag="ambient"):
    """Light that is everywhere and casts no shadow."""

    radiance: Annotated[Color, about("Radiance from every direction.", "W/(m^2 sr)")]


class PointLight(LightDescription, frozen=True, kw_only=True, tag="point"):
    """A light without extent."""

    position: Annotated[Vector, about("Where it is.", "world unit")]
    intensity: Annotated[Color, about("Radiant intensity.", "W/sr")]
    shadow_rays: Annotated[
        Literal["short", "whole"],
        about(
            "Whether shadow rays end just short of the light, or at the light itself: then a surface in which the light"
            " lies hides it."
        ),
    ] = "short"
    motion: _Motion = MotionDescription()


class DirectionalLight(LightDescription, frozen=True, kw_only=True, tag="directional"):
    """A light infinitely far away."""

    direction: Annotated[Vector, about("Direction the light travels in; any length but 0.")]
    irradiance: Annotated[Color, about("Irradiance of a surface that faces it.", "W/m^2")]


class RectangleLight(LightDescription, frozen=True, kw_only=True, tag="rectangle"):
    """A parallelogram; by radiance it emits towards cross(edge_u, edge_v), unless it is two-sided."""

    corner: Annotated[Vector, about("One corner.", "world unit")]
    edge_u: Annotated[Vector, about("Edge from the corner.", "world unit")]
    edge_v: Annotated[Vector, about("Other edge from the corner.", "world unit")]
    intensity: _Intensity = None
    radiance: _Radiance = None
    samples: Annotated[
        str,
        about(
            "`point`: one random point for each sample; `grid K`: the centres of K x K cells.",
            pattern=r"^(point|grid [1-9][0-9]?)$",
        ),
    ] = "point"
    two_sided: Annotated[
        bool, about("By radiance: whether it shines to both sides; then it can't be visible.")
    ] = False
    visible: Annotated[
        bool, about("By radiance: whether rays can see it, and whether it casts shadows.")
    ] = True
    motion: _Motion = MotionDescription()


class SphereLight(LightDescription, frozen=True, kw_only=True, tag="sphere"):
    """A ball; by radiance its radius must be over 0."""

    center: Annotated[Vector, about("Centre.", "world unit")]
    radius: Annotated[float, about("Radius.", "world unit", ge=0)]
    intensity: _Intensity = None
    radiance: _Radiance = None
    samples: Annotated[
        Literal[
            "sphere",
            "ball",
            "facing disk",
            "visible",
            "sphere by polar",
            "ball by polar",
            "ball by rejection",
        ],
        about(
            "Where its light comes from: the surface, the whole ball, or the disk that it shows;"
            " by radiance the surface, or only what is visible of it, which is less noisy."
            " What names a way takes points by `sphere_by_polar`, `ball_by_polar` or `ball_by_rejection` of the"
            " module sampling, the first three values by functions of soft_shadows. `ball by rejection` draws"
            " numbers of its own."
        ),
    ] = "sphere"
    motion: _Motion = MotionDescription()


class ObjectLight(LightDescription, frozen=True, kw_only=True, tag="object"):
    """An object whose material has emission, which then lights others: shadow rays look for it at every hit."""

    object: Annotated[
        str,
        about(
            "Name of one of the objects; its shape, its motion and its material's emission are the light's.",
            min_length=1,
        ),
    ]


Light: TypeAlias = (
    AmbientLight | PointLight | DirectionalLight | RectangleLight | SphereLight | ObjectLight
)
