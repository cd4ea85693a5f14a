"""A scene as rays meet it, with what only some scenes have."""

from dataclasses import dataclass, field

from course.core.camera import Lens
from course.core.scene import World
from course.core.types import Functions, Mask
from course.extras.rough_glass import RoughGlass
from course.extras.sky import SkySampling


@dataclass(frozen=True)
class Paths:
    """What path tracing needs.

    Attributes
    ----------
    roulette : bounces that a path makes before Russian roulette may end it, None for never
    lamps : (M,) which materials are surfaces of lights, which direct light samples at every diffuse hit
    objects : (M,) which materials are those of objects that are lights, sampled as well, which shine from both sides
    path_tracing : functions of the module; None where nothing scatters
    together : whether any paths may be followed together; else it makes a difference to the numbers that they draw
    """

    roulette: int | None
    lamps: Mask
    objects: Mask
    path_tracing: Functions | None
    together: bool


@dataclass(frozen=True)
class FullWorld(World):
    """What rays meet.

    Attributes
    ----------
    skipped_lights : name -> why it was left out
    sky : chooses the directions that the environment's light comes from; None where the environment lights nothing
    rough : the rough glasses
    lens : of the camera, None for a pinhole
    paths : None for the distribution ray tracer
    backdrop : whether only camera rays see the environment
    keeps : whether directions into the surface are kept
    lifted : whether rays leave surfaces so far off that light is worked out at the surface itself
    """

    skipped_lights: dict[str, str] = field(default_factory=dict)
    sky: SkySampling | None = None
    rough: tuple[RoughGlass, ...] = ()
    lens: Lens | None = None
    paths: Paths | None = None
    backdrop: bool = False
    keeps: bool = False
    lifted: bool = False
