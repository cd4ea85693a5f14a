"""A scene compiled for rendering: moved to its own centre, scaled to unit size, in float32."""

from __future__ import annotations

from dataclasses import dataclass

from course.appearance.cube_environment import CubeEnvironment
from course.appearance.environment import ConstantEnvironment
from course.appearance.lights import Light
from course.appearance.lobes import Lobe
from course.appearance.materials import MaterialTable
from course.core.types import Floats32
from course.geometry.motion_functions import MotionFunctions
from course.geometry.surface import Surface
from course.imaging.lens import Lens


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
    """

    width: int
    height: int
    sampler: str
    samples: int
    seed: int
    max_depth: int
    cutoff: float
    error: float | None = None
