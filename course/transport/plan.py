"""The plan: what a scene needs, decided once before the first ray.

A dimension that isn't in the plan is never drawn, a stage that isn't is never entered. The plan is also half of the
receipt: which effects are called, and why the others are not.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from course.appearance.conductors import Conductors
from course.appearance.materials import Lookup
from course.appearance.rough_glass import RoughGlass
from course.core.types import Media
from course.scene.world import Settings, World


@dataclass(frozen=True)
class Plan:
    """What one batch of rays goes through.

    Attributes
    ----------
    shades : any material shows light from the lights
    all_shade : every material does, from both sides
    has_ambient : some surface has a visible ambient term
    glows : some surface sends out light by itself, from both sides
    emits : some surface is a light that rays can see
    specular : some material has a highlight
    mirrors, refracts, absorbs : some reachable material does
    dark_insides : some dielectric has ambient or diffuse terms, which its inside does not show
    sees_environment : the environment isn't black
    max_depth : bounces that can happen in this scene
    light_dimensions : for each light, its first dimension at depth 0; None if it needs no numbers
    lens_dimension, time_dimension : None where the camera needs none
    sky_dimension : the same for light from the environment, None where it lights nothing
    gloss_dimension : the first dimension of glossy reflection at depth 0
    refraction_dimension : the same for refraction by rough glass, None where there is none
    bounce_stride : how many dimensions one depth takes
    bounce_dimension : where paths go after a diffuse hit at depth 0, None where none does
    choice_dimension : by which of its ways light leaves a surface, and whether the path survives
    """

    shades: bool
    all_shade: bool
    has_ambient: bool
    glows: bool
    emits: bool
    specular: bool
    mirrors: bool
    refracts: bool
    absorbs: bool
    dark_insides: bool
    sees_environment: bool
    max_depth: int
    lens_dimension: int | None
    time_dimension: int | None
    light_dimensions: tuple[int | None, ...]
    gloss_dimension: int
    sky_dimension: int | None
    bounce_stride: int
    bounce_dimension: int | None = None
    choice_dimension: int | None = None
    refraction_dimension: int | None = None


@dataclass(frozen=True)
class Lookups:
    """Gathers of the properties that the plan needs.

    Attributes
    ----------
    ambient : what surfaces reflect of ambient light
    glow : what they send out by themselves, from both sides; textures don't colour it
    emission : of the surfaces of lights
    outside : (M,) as ``MaterialTable`` has it
    """

    ambient: Lookup
    glow: Lookup
    diffuse: Lookup
    specular: Lookup
    exponent: Lookup
    mirror: Lookup
    refraction_index: Lookup
    absorption: Lookup
    emission: Lookup
    conductors: Conductors | None = field(default=None, kw_only=True)
    outside: Media | None = field(default=None, kw_only=True)


PIXEL_WIDTH = 2


def make_plan(world: World, settings: Settings) -> Plan:
    """Look at the compiled scene and leave out what can't contribute."""
    m = world.materials
    cutoff = settings.cutoff if world.paths is None else 0.0
    mirrors = bool((m.mirror.max(0) > cutoff).any()) and settings.max_depth > 0
    refracts = bool(m.refracts.any()) and settings.max_depth > 0
    dimensions = _Dimensions()
    dimensions.take(PIXEL_WIDTH)
    lens_dimension = dimensions.take(2) if world.lens else None
    time_dimension = dimensions.take(1) if world.motion else None
    first = dimensions.next
    # Where lens and time need none, gloss gets the pair that is joined to the pixel's: mirror images are sharper, so
    # worth more, than soft shadows.
    gloss_dimension = dimensions.take(max((lobe.width for lobe in world.lobes), default=0))
    rough = refracts and any(isinstance(lobe, RoughGlass) for lobe in world.lobes)
    refraction_dimension = dimensions.take(2) if rough else None
    light_dimensions = tuple(
        dimensions.take(light.width) if light.width else None for light in world.lights
    )
    sky = world.environment.lights and not world.environment.black and bool(m.diffuses.any())
    sky_dimension = dimensions.take(2) if sky else None
    scatters = world.paths is not None and bool(m.diffuses.any()) and settings.max_depth > 0
    bounce_dimension = dimensions.take(2) if scatters else None
    choice_dimension = None if world.paths is None else dimensions.take(2)
    return Plan(
        shades=sky or (bool(m.shaded.any()) and bool(world.lights)),
        all_shade=bool(m.shaded_sides.all()),
        has_ambient=bool((m.ambient * world.ambient[:, None]).any()),
        glows=bool(m.glowing.any()),
        emits=bool(m.shining.any()),
        specular=bool(m.specular.any()),
        mirrors=mirrors,
        refracts=refracts,
        absorbs=refracts and bool(m.absorption.any()),
        dark_insides=bool(
            (m.refracts & (m.diffuses | (m.ambient * world.ambient[:, None]).any(0))).any()
        ),
        sees_environment=not world.environment.black,
        max_depth=settings.max_depth if mirrors or refracts or scatters else 0,
        lens_dimension=lens_dimension,
        time_dimension=time_dimension,
        light_dimensions=light_dimensions,
        gloss_dimension=gloss_dimension,
        sky_dimension=sky_dimension,
        bounce_stride=dimensions.next - first,
        bounce_dimension=bounce_dimension,
        choice_dimension=choice_dimension,
        refraction_dimension=refraction_dimension,
    )


class _Dimensions:
    """Hands out dimensions in pairs: the sampler's pairs (0, 1), (2, 3), ... are its best."""

    def __init__(self) -> None:
        self.next = 0

    def take(self, width: int) -> int:
        """The first of ``width`` dimensions that nobody else has."""
        first = self.next
        self.next += width + width % 2
        return first


def make_lookups(world: World) -> Lookups:
    """One gather for each property."""
    m = world.materials
    return Lookups(
        *(
            Lookup(rows)
            for rows in (
                m.ambient * world.ambient[:, None],
                m.glowing,
                m.diffuse,
                m.specular,
                m.exponent,
                m.mirror,
                m.refraction_index,
                m.absorption,
                m.shining,
            )
        ),
        conductors=m.conductors,
        outside=m.outside,
    )
