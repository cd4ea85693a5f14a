"""`integrator`: how far light is followed."""

from __future__ import annotations

from typing import Annotated, Final, Literal

import msgspec

from course.formats.yaml.description.values import Map, about

DEEPEST: Final = 1024
"""Bounces that can be followed."""

_Bounces = Annotated[int, msgspec.Meta(ge=0, le=DEEPEST)]


class IntegratorDescription(Map, frozen=True, kw_only=True):
    """Which light reaches the eye, and where the recursion ends."""

    type: Annotated[
        Literal["distribution", "path"],
        about(
            "`distribution`: direct light, seen through mirrors and glass; `path`: all light, that from"
            " wall to wall too."
        ),
    ] = "distribution"
    max_depth: Annotated[int, about("Bounces after the camera ray.", ge=0, le=DEEPEST)] = 5
    cutoff: Annotated[
        float,
        about(
            "A bounced ray is dropped when the largest channel of its throughput is below this;"
            " paths are not, they have the roulette.",
            ge=0,
            lt=1,
        ),
    ] = 1 / 512
    roulette: Annotated[
        _Bounces | None,
        about("Bounces that a path makes before Russian roulette may end it; null for never."),
    ] = 1
    into_surface: Annotated[
        Literal["mirror", "keep"],
        about(
            "What becomes of mirrored, glossy and refracted directions that point to the wrong side of their surface:"
            " mirrored to the right one, or kept, and the ray meets the surface again."
        ),
    ] = "mirror"
    terminator: Annotated[
        Literal["round", "facets"],
        about(
            "Where shadow rays of smooth meshes start: where the round surface would be, or at the flat triangle, whose"
            " neighbours cast shadows on it."
        ),
    ] = "round"
    shading_normals: Annotated[
        Literal["bent", "interpolated"],
        about(
            "What becomes of smooth meshes' normals that look away from the viewer: bent until they are at right angles"
            " to the ray, or left as they are, but for glass."
        ),
    ] = "bent"
    surface_offset: Annotated[
        float,
        about(
            "Least distance from a surface at which rays leave it. Above 0, what lights send is worked out at the"
            " surface itself, though shadow rays start at that distance; at 0 all is done at a distance of the engine's"
            " own, too small to be seen.",
            "world unit",
            ge=0,
        ),
    ] = 0.0
