"""Which scenes the fused loop can follow: those that are made of parts that it knows; reads no loop to say so.

``KNOWN`` and ``OF_KEYS`` are allow-lists. A part of another type doesn't fit, nor does one that has a field more than
what is listed here: the scene is then rendered by passes over arrays, and no picture is another.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from types import NoneType
from typing import Any

import numpy as np

from course.engine.core.accelerator import StaticAccelerator
from course.engine.core.blinn_phong import BlinnPhong
from course.engine.core.camera import Camera, Lens
from course.engine.core.direct import DirectLight
from course.engine.core.environment import ConstantEnvironment, CubeEnvironment
from course.engine.core.gloss import Gloss, Lobe
from course.engine.core.hits import Surface
from course.engine.core.integrator import Integrator
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.motion import Motion, Mover, MovingAccelerator
from course.engine.core.samplers import Sampler
from course.engine.core.scatter import Scatter
from course.engine.core.tracer import Tracer
from course.engine.core.types import Functions
from course.engine.functions.own import courses_own
from course.engine.terms.cameras.near_plane import NearPlaneCamera
from course.engine.terms.environments.sampling import ProductSampling
from course.engine.terms.environments.sky import Sky
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.own_lamp import LampAccelerator
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.paths.bounce import PathBounce
from course.engine.terms.paths.path_tracing import PathIntegrator
from course.engine.terms.samplers import FUNCTIONS
from course.engine.terms.samplers.sobol import SobolSampler
from course.engine.terms.scattering.absorption import Absorption
from course.engine.terms.scattering.scatter import FullScatter
from course.engine.terms.shafts.stage import Shafts
from course.engine.terms.surfaces.surface import FullSurface
from course.engine.terms.surfaces.swept_movers import SweptMovers

DEEPEST = 64
"""Most bounces: the loop keeps room for the rays of each depth."""

MOST_DRAWN = 96
"""Dimensions up to which numbers of a sampler are drawn before the paths are followed: those of all bounces."""

MOST_PLACED = 6
"""Points on lights, of all depths, that are placed for each sample before it is followed, be they needed or not."""

POINTS_ON_SPHERES = {
    "sphere": "point_on_sphere",
    "ball": "point_in_ball",
    "facing disk": "point_on_facing_disk",
}
DIRECTIONS_OF_LOBES = {
    "plane": "jitter_on_plane",
    "ball": "jitter_in_ball",
    "phong": "sample_phong_lobe",
}
"""The functions that the loop has forms of its own of."""


@dataclass(frozen=True)
class Known:
    """What the loop knows of a type of part.

    Attributes
    ----------
    parts : names of fields that are parts, or tuples of parts
    values : names of fields that the loop reads, or that change no picture
    absent : names of fields that must be None, empty or false: the loop has nothing in their place
    also : what must be true beside that
    """

    parts: str = ""
    values: str = ""
    absent: str = ""
    also: Callable[[Any], bool] = lambda _part: True


def _owned(functions: Functions | None, *names: str) -> bool:
    """Whether those of the functions that are there are the course's own."""
    there = {} if functions is None else vars(functions)
    return all(courses_own(there[name]) for name in names if name in there)


def _lies_in_rows(image: Any) -> bool:
    """Whether the loop can read a picture by its address."""
    return bool(image.dtype == np.float32 and image.flags.c_contiguous)


_INTEGRATOR = "surface camera motion environment direct absorption scatter"
_SHOWN = "environment_depth ambient dark_inside glow emission max_depth"
_SCATTER = "surface mirror index absorbs outside cutoff"
_CAMERA = "origin right up forward corner step_x step_y lens"
_LIGHT = "name color width velocity"
_TERMS = "course.engine.terms"

KNOWN: dict[type, Known] = {
    NoneType: Known(),
    Integrator: Known(_INTEGRATOR, _SHOWN, also=lambda i: bool(i.max_depth <= DEEPEST)),
    PathIntegrator: Known(
        f"{_INTEGRATOR} bounce",
        f"{_SHOWN} pieces unsought reflected lamps objects",
        "lamps_and_lobes",
        lambda i: bool(i.max_depth <= DEEPEST),
    ),
    PathBounce: Known(
        "",
        "surface scatter optical diffuse path_tracing roulette",
        also=lambda b: _owned(b.path_tracing, "diffuse_bounce", "throughput", "russian_roulette"),
    ),
    Camera: Known("", _CAMERA),
    NearPlaneCamera: Known("", f"{_CAMERA} near"),
    Motion: Known(
        "",
        "motion_blur camera_velocity",
        also=lambda m: _owned(m.motion_blur, "displacement", "to_object_space"),
    ),
    Surface: Known("accelerator", "triangles"),
    FullSurface: Known(
        "accelerator painting relief", "triangles spread", "shine turned kept through"
    ),
    StaticAccelerator: Known(),
    LampAccelerator: Known(),
    MovingAccelerator: Known("static movers motion"),
    SweptMovers: Known("static movers motion"),
    Mover: Known("accelerator", "velocity first last"),
    ConstantEnvironment: Known("", "color"),
    CubeEnvironment: Known(
        "",
        "faces cube_map seamless",
        also=lambda e: _owned(e.cube_map, "lookup_seamless" if e.seamless else "lookup"),
    ),
    DirectLight: Known("lights motion sky reflection spare", "surface shaded", "choice weigh"),
    Shafts: Known("", "surface camera lights pixels places lock"),
    BlinnPhong: Known("", "diffuse specular exponent"),
    Sky: Known("environment sampling", "surface diffuses refracts"),
    ProductSampling: Known("", "rows columns texel_rows texel_columns"),
    DirectionalLight: Known("", f"{_LIGHT} to_light limit"),
    PointLight: Known("", f"{_LIGHT} position normal two_sided visible blockable"),
    RectangleLight: Known(
        "",
        f"{_LIGHT} corner edge_u edge_v normal soft_shadows two_sided visible",
    ),
    SphereLight: Known(
        "",
        f"{_LIGHT} center radius emitter samples soft_shadows",
        also=lambda s: (
            s.samples in POINTS_ON_SPHERES
            and (s.samples == "sphere" or not s.emitter)
            and (s.samples != "facing disk" or _owned(s.soft_shadows, POINTS_ON_SPHERES[s.samples]))
        ),
    ),
    MeshLight: Known("", f"{_LIGHT} shares planes edges limit"),
    VisibleSphereLight: Known("", f"{_LIGHT} center radius limit"),
    Scatter: Known("gloss", _SCATTER),
    FullScatter: Known("gloss", f"{_SCATTER} max_depth", "conductors rough keeps microfacets"),
    Gloss: Known("lobes"),
    Lobe: Known(
        "",
        "material kind parameter glossy",
        also=lambda lobe: _owned(lobe.glossy, DIRECTIONS_OF_LOBES[lobe.kind], "keep_above"),
    ),
    Absorption: Known("", "coefficient dielectric outside camera"),
}
"""What the loop knows: to add a part, its type and its fields come here."""

OF_KEYS: dict[str, Known] = {
    f"{_TERMS}.surfaces.painting.Painting": Known("color_at", "row corners number"),
    f"{_TERMS}.surfaces.normal_maps.Relief": Known("maps"),
    f"{_TERMS}.surfaces.textures.Laid": Known("texture places"),
    f"{_TERMS}.surfaces.normal_maps.NormalMap": Known("color places", "wraps"),
    f"{_TERMS}.surfaces.bump_maps.BumpMap": Known("heights", "height"),
    f"{_TERMS}.surfaces.bump_maps.PictureHeights": Known("picture", "step"),
    f"{_TERMS}.surfaces.bump_maps.NoiseHeights": Known("noise"),
    f"{_TERMS}.surfaces.perlin.PerlinNoise": Known("", "conversion"),
    f"{_TERMS}.surfaces.textures.Texture": Known(
        "",
        "image repeat lookup nearest",
        also=lambda t: courses_own(t.lookup) and _lies_in_rows(t.image),
    ),
    f"{_TERMS}.surfaces.textures.OnRectangle": Known(
        "", "corner along across rectangle_uv", also=lambda p: courses_own(p.rectangle_uv)
    ),
    f"{_TERMS}.surfaces.textures.OnSphere": Known(
        "", "sphere_uv", also=lambda p: courses_own(p.sphere_uv)
    ),
    f"{_TERMS}.surfaces.textures.OnMesh": Known(
        "", "triangle_uv", also=lambda p: courses_own(p.triangle_uv)
    ),
    f"{_TERMS}.lights.spot_light.SpotLight": Known(
        "", f"{_LIGHT} position two_sided visible blockable axis inner outer", "normal"
    ),
}
"""The same of parts whose modules are imported for scenes alone that have them, by name."""


def fits(tracer: Tracer) -> bool:
    """True if the fused loop knows all that a scene uses, and the functions that it has forms of are the course's."""
    integrator = tracer.integrator
    placed = len(placed_before(integrator)) * depths_of_lights(integrator)
    return (
        _knows(integrator)
        and placed <= MOST_PLACED
        and (type(tracer.sampler) is SobolSampler or _fits_drawn(tracer))
    )


def placed_before(integrator: Integrator) -> tuple[RectangleLight | SphereLight, ...]:
    """The lights whose points are placed before paths are followed, by functions that are a student's."""
    lights = () if integrator.direct is None else integrator.direct.lights
    return tuple(
        light
        for light in lights
        if isinstance(light, RectangleLight | SphereLight)
        and not _owned(light.soft_shadows, *vars(light.soft_shadows))
    )


def depths_of_lights(integrator: Integrator) -> int:
    """Number of depths at which paths may be lit."""
    goes_on = integrator.scatter is not None or isinstance(integrator, PathIntegrator)
    return 1 + integrator.max_depth * goes_on


def makes_camera_rays(tracer: Tracer) -> bool:
    """True if the loop makes the camera rays; else they are made before, by functions that may be a student's."""
    lens, motion = tracer.integrator.camera.lens, tracer.integrator.motion
    known = lens is None or (
        type(lens) is Lens and _owned(lens.thin_lens, "point_on_disk", "lens_rays")
    )
    times = motion is None or _owned(motion.motion_blur, "shutter_times")
    return known and times and type(tracer.sampler) is SobolSampler


def _knows(part: Any) -> bool:
    kind: type = type(part)
    known = known_part(kind)
    if known is None or not lists_all_fields(kind):
        return False
    inner = [getattr(part, name) for name in known.parts.split()]
    flat = [each for one in inner for each in (one if isinstance(one, tuple) else (one,))]
    nothing = all(_is_nothing(getattr(part, name)) for name in known.absent.split())
    return nothing and all(map(_knows, flat)) and known.also(part)


def _is_nothing(value: Any) -> bool:
    return value is None or value is False or (isinstance(value, tuple) and not value)


def known_part(kind: type) -> Known | None:
    """What the loop knows of a type of part; None for nothing."""
    return KNOWN.get(kind) or OF_KEYS.get(f"{kind.__module__}.{kind.__qualname__}")


@cache
def lists_all_fields(kind: type) -> bool:
    """True if it is said of each field of a type what the loop does with it; false for types of which nothing is."""
    known = known_part(kind)
    if known is None:
        return False
    listed = f"{known.parts} {known.values} {known.absent}".split()
    return not is_dataclass(kind) or {f.name for f in fields(kind) if f.init} <= set(listed)


def _fits_drawn(tracer: Tracer) -> bool:
    """Whether numbers of another sampler than Sobol's can be drawn before paths are followed."""
    integrator, dimensions = tracer.integrator, tracer.dimensions
    if isinstance(integrator, PathIntegrator) and integrator.bounce.scatter is not None:
        # What a hit draws there hangs on what others of its batch have met.
        return False
    deepest = max(dimensions.first(name, integrator.max_depth) for name in dimensions.width)
    return _is_plain(tracer.sampler) and deepest < MOST_DRAWN


def _is_plain(sampler: Sampler) -> bool:
    """Not one that has its places from elsewhere, as division by contrast does."""
    return not isinstance(sampler, SobolSampler) and sampler.name in FUNCTIONS
