"""A whole scene file."""

from __future__ import annotations

from typing import Annotated

import msgspec

from course.formats.yaml.description.acceleration import AccelerationDescription
from course.formats.yaml.description.camera import CameraDescription
from course.formats.yaml.description.environment import ConstantEnvironment, Environment
from course.formats.yaml.description.film import FilmDescription
from course.formats.yaml.description.integrator import IntegratorDescription
from course.formats.yaml.description.lights import Light
from course.formats.yaml.description.limits import LimitsDescription
from course.formats.yaml.description.materials import MaterialDescription
from course.formats.yaml.description.objects import Object
from course.formats.yaml.description.sampler import SamplerDescription
from course.formats.yaml.description.values import Map, about


class SceneDescription(Map, frozen=True, kw_only=True):
    """A scene for the Penumbra ray tracer."""

    title: Annotated[str, about("What the picture shows.")] = ""
    seed: Annotated[int, about("Chooses the random numbers.", ge=0, le=2**32 - 1)] = 0
    camera: Annotated[CameraDescription, about("Where the picture is taken from.")]
    film: Annotated[FilmDescription, about("Size of the picture and its filter.")] = (
        FilmDescription()
    )
    sampler: Annotated[SamplerDescription, about("Number and pattern of samples.")] = (
        SamplerDescription()
    )
    integrator: Annotated[IntegratorDescription, about("How far light is followed.")] = (
        IntegratorDescription()
    )
    acceleration: Annotated[
        AccelerationDescription, about("What finds the triangles that rays hit.")
    ] = AccelerationDescription()
    limits: Annotated[
        LimitsDescription, about("How large the files may be that the scene names.")
    ] = LimitsDescription()
    environment: Annotated[Environment, about("What a ray sees that hits nothing.")] = (
        ConstantEnvironment()
    )
    materials: Annotated[
        dict[str, MaterialDescription], about("What objects are made of, by name.")
    ] = msgspec.field(default_factory=dict)
    lights: Annotated[tuple[Light, ...], about("The lights.")] = ()
    objects: Annotated[tuple[Object, ...], about("The objects.")] = ()
