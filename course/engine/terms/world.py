"""The compiled scene, with the parts that only some scenes have."""

from dataclasses import dataclass, field
from typing import Protocol

from course.engine.core.camera import Lens
from course.engine.core.integrator import Integrator
from course.engine.core.scene import World
from course.engine.core.types import Functions, Mask
from course.engine.terms.environments.sky import SkySampling
from course.engine.terms.lights.light_choice import LightChoice
from course.engine.terms.lights.multiple_importance import Combining
from course.engine.terms.scattering.microfacets import Microfacets
from course.engine.terms.scattering.rough_glass import RoughGlass


@dataclass(frozen=True)
class Paths:
    """Settings and functions of path tracing.

    Attributes
    ----------
    roulette : number of bounces before Russian roulette starts; None without Russian roulette
    lamps : (M,) bool, materials of the surfaces of lights, which next-event estimation samples
    objects : (M,) bool, materials of objects that are sampled as lights and emit from both sides
    path_tracing : functions of the module; None if no surface is diffuse
    together : true if paths of several batches may be merged without changing their random numbers
    """

    roulette: int | None
    lamps: Mask
    objects: Mask
    path_tracing: Functions | None
    together: bool


class Wrap(Protocol):
    """A term around the whole integrator, such as fog between surfaces: plans know no more of it than this."""

    def numbers(self, paths: bool) -> list[tuple[str, int]]:
        """Names and widths of what it draws at each depth, in paths or in the distribution ray tracer."""

    def around(self, integrator: Integrator, max_depth: int) -> Integrator:
        """The integrator with the term; ``max_depth`` is the scene's, though its surfaces send no ray on."""


@dataclass(frozen=True)
class FullWorld(World):
    """The compiled scene, with the parts that only some scenes have.

    Attributes
    ----------
    skipped_lights : name of a light -> reason why it is left out
    sky : samples directions to the environment; None if the environment is not a light
    rough : the rough glasses
    microfacets : the metals and glasses whose microfacets are drawn
    lens : lens of the camera; None for a pinhole
    paths : None for the distribution ray tracer
    backdrop : true if only camera rays see the environment
    keeps : true if directions that point into the surface are kept
    choice : chooses one light for each hit; None if all lights send light to all hits
    combining : lamps and lobes that are sampled together; None where there are none
    wraps : terms around the integrator
    """

    skipped_lights: dict[str, str] = field(default_factory=dict)
    sky: SkySampling | None = None
    rough: tuple[RoughGlass, ...] = ()
    lens: Lens | None = None
    paths: Paths | None = None
    backdrop: bool = False
    keeps: bool = False
    choice: LightChoice | None = None
    microfacets: tuple[Microfacets, ...] = ()
    combining: Combining | None = None
    wraps: tuple[Wrap, ...] = ()
