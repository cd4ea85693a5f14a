"""The compiled scene (centred, scaled to unit size, in float32) and its render settings."""

from __future__ import annotations

from dataclasses import dataclass

from course.core.environment import Environment
from course.core.gloss import Lobe
from course.core.hits import Surface
from course.core.lights import Light
from course.core.materials import MaterialTable
from course.core.motion import Motion
from course.core.types import Floats32


@dataclass(frozen=True)
class World:
    """The compiled scene.

    Attributes
    ----------
    surface : all triangles
    lights : without those that light nothing
    ambient : (3,) float32, sum of the ambient lights
    environment : radiance of the rays that hit nothing
    lobes : of the glossy materials
    motion : None if nothing moves while the shutter is open
    """

    surface: Surface
    materials: MaterialTable
    lights: tuple[Light, ...]
    ambient: Floats32
    environment: Environment
    lobes: tuple[Lobe, ...] = ()
    motion: Motion | None = None


@dataclass(frozen=True)
class Settings:
    """Render settings.

    Attributes
    ----------
    width, height : of the picture [pixels]
    sampler : its name
    samples : per pixel
    max_depth : largest number of bounces after the camera ray
    cutoff : bounced rays are dropped unless their largest throughput channel is above this
    """

    width: int
    height: int
    sampler: str
    samples: int
    seed: int
    max_depth: int
    cutoff: float
