"""A scene compiled for rendering: moved to its own centre, scaled to unit size, in float32."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.appearance.cube_environment import CubeEnvironment
from course.appearance.environment import ConstantEnvironment
from course.appearance.lights import Light
from course.appearance.lobes import Lobe
from course.appearance.materials import MaterialTable
from course.core.types import Floats32, Mask
from course.geometry.motion_functions import MotionFunctions
from course.geometry.surface import Surface
from course.imaging.lens import Lens
from course.imaging.srgb import SRGB, Display


@dataclass(frozen=True)
class Motion:
    """What moving scenes need.

    Attributes
    ----------
    functions : of the motion_blur module
    camera_velocity : (3,) float32 in the unit of the compiled scene an exposure, or None
    """

    functions: MotionFunctions
    camera_velocity: Floats32 | None


@dataclass(frozen=True)
class Paths:
    """What path tracing needs.

    Attributes
    ----------
    roulette : bounces that a path makes before Russian roulette may end it, None for never
    lamps : (M,) which materials are surfaces of lights, which direct light samples at every diffuse hit
    objects : (M,) which materials are those of objects that are lights, sampled as well, which shine from both sides
    diffuse_bounce, throughput, russian_roulette : of the path_tracing module, None where they are not called
    together : whether any paths may be followed together; else it makes a difference to the numbers that they draw
    """

    roulette: int | None
    lamps: Mask
    objects: Mask
    diffuse_bounce: Callable[[Floats32, Floats32], Floats32] | None
    throughput: Callable[[Floats32, Floats32], Floats32] | None
    russian_roulette: Callable[[Floats32, Floats32], tuple[Mask, Floats32]] | None
    together: bool


@dataclass(frozen=True)
class World:
    """What one batch of rays meets.

    Attributes
    ----------
    surface : all triangles
    materials : their materials
    lights : those that can light something; lights without power are left out
    skipped_lights : name -> why it was left out
    ambient : (3,) float32, sum of the ambient lights
    environment : what rays see that hit nothing
    lobes : of the glossy materials
    lens : None for a pinhole
    motion : None where nothing moves while the shutter is open
    paths : None for the distribution ray tracer
    backdrop : whether only camera rays see the environment
    keeps : whether directions into the surface are kept
    lifted : whether rays leave surfaces so far off that light is worked out at the surface itself
    """

    surface: Surface
    materials: MaterialTable
    lights: tuple[Light, ...]
    skipped_lights: dict[str, str]
    ambient: Floats32
    environment: ConstantEnvironment | CubeEnvironment
    lobes: tuple[Lobe, ...] = ()
    lens: Lens | None = None
    motion: Motion | None = None
    paths: Paths | None = None
    backdrop: bool = False
    keeps: bool = False
    lifted: bool = False


@dataclass(frozen=True)
class Subdivision:
    """Where pixels are divided: ``threshold`` [radiance] between two corners, down to ``depth`` times."""

    threshold: float
    depth: int


@dataclass(frozen=True)
class Settings:
    """How a scene is to be rendered: everything of the scene file that isn't the world.

    Attributes
    ----------
    width, height : pixels
    sampler : name of the sampler
    samples : a pixel
    max_depth : bounces after the camera ray
    cutoff : bounced rays whose largest throughput channel is below this are dropped
    error : the root-mean-square error [radiance] at which sampling ends; None samples all pixels alike
    display : how a PNG shows the picture
    subdivision : rays through the corners of cells, which are divided by contrast; None takes samples in pixels
    """

    width: int
    height: int
    sampler: str
    samples: int
    seed: int
    max_depth: int
    cutoff: float
    error: float | None = None
    display: Display = SRGB
    subdivision: Subdivision | None = None
