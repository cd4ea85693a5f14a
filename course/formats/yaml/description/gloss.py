"""`gloss`: how a mirror blurs its reflection; a union told apart by `lobe`."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from course.formats.yaml.description.values import Map, about


class GlossDescription(Map, frozen=True, kw_only=True, tag_field="lobe"):
    """What all lobes have in common: `lobe` tells them apart."""


class PlaneLobe(GlossDescription, frozen=True, kw_only=True, tag="plane"):
    """The mirrored direction is moved on a square at right angles to it."""

    roughness: Annotated[float, about("Edge of the square, at distance 1; 0 is a mirror.", ge=0)]
    basis: Annotated[
        Literal["module", "smallest"],
        about(
            "How the square is turned: as `jitter_on_plane` of the module glossy has it; or with one edge at right"
            " angles both to the direction and to what becomes of the direction if its smallest component is set to 1."
            " Then that function is not called."
        ),
    ] = "module"


class BallLobe(GlossDescription, frozen=True, kw_only=True, tag="ball"):
    """The mirrored direction's end is moved within a ball."""

    glossiness: Annotated[float, about("Radius of the ball; 0 is a mirror.", ge=0, lt=1)]


class PhongLobe(GlossDescription, frozen=True, kw_only=True, tag="phong"):
    """Directions with a density of cos(angle)^exponent about the mirrored one."""

    exponent: Annotated[float, about("The larger, the sharper.", ge=0)]


Gloss: TypeAlias = PlaneLobe | BallLobe | PhongLobe
