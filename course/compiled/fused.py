"""Which scenes the fused loop can follow, and what it is handed for them."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from course.compiled import (
    bounce_kernels,
    daylight_kernels,
    fused_kernels,
    lamp_kernels,
    lanes,
    number_kernels,
    numpy_kernels,
    path_kernels,
)
from course.compiled.accelerator import MovingPackets, PacketAccelerator, in_packets
from course.compiled.packets import WIDTH, aligned
from course.core.accelerator import StaticAccelerator
from course.core.camera import Camera, Lens
from course.core.counters import Counters
from course.core.direct import ROUNDING, DirectLight
from course.core.environment import ConstantEnvironment, CubeEnvironment, Environment
from course.core.gloss import Gloss, Lobe
from course.core.integrator import CancelledError, Integrator
from course.core.lights.point import DirectionalLight, PointLight
from course.core.lights.rectangle import RectangleLight
from course.core.lights.sample import Light
from course.core.lights.sphere import SphereLight
from course.core.materials import Lookup
from course.core.motion import Motion, MovingAccelerator
from course.core.rays import Dimensions
from course.core.samplers import Block
from course.core.scatter import Scatter
from course.core.tiles import Area
from course.core.tracer import Tracer
from course.core.types import Floats32
from course.extras.absorption import Absorption
from course.extras.direct import FullDirectLight
from course.extras.environment_sampling import ProductSampling
from course.extras.near_plane import NearPlaneCamera
from course.extras.own import courses_own
from course.extras.own_lamp import LampAccelerator
from course.extras.path_tracing import Glow, PathIntegrator
from course.extras.plan import BOUNCE, CHOICE, same_fields
from course.extras.samplers.sobol import SobolSampler
from course.extras.scatter import FullScatter
from course.extras.sky import COST, NUMBERS, Sky
from course.extras.surface import FullSurface
from course.extras.swept_movers import SweptMovers
from course.extras.visible_sphere import VisibleSphereLight

_NO_COLUMNS, _NO_ROWS = np.empty((3, 0), np.float32), np.empty((0, 9), np.float32)
_NONE, _NO_MASK = np.empty(0, np.float32), np.empty((0, 0), np.bool_)
_NO_FACES = np.empty((6, 0, 0, 3), np.float32)
_NOWHERE, _NO_BOXES = np.zeros(3, np.float32), np.empty((0, 3), np.float32)

DEEPEST = 64
"""Most bounces: the loop keeps room for the rays of each depth."""

SMALLEST = 16384
"""Camera rays in a tile, at least: beside so many, its memory and its place in the film take little time."""

_SPHERES = {
    "sphere": (lamp_kernels.SPHERE, "point_on_sphere"),
    "ball": (lamp_kernels.BALL, "point_in_ball"),
    "facing disk": (lamp_kernels.FACING_DISK, "point_on_facing_disk"),
}
_LOBES = {
    "plane": (bounce_kernels.PLANE, "jitter_on_plane"),
    "ball": (bounce_kernels.IN_BALL, "jitter_in_ball"),
    "phong": (bounce_kernels.PHONG, "sample_phong_lobe"),
}


def fits(tracer: Tracer) -> bool:
    """True if the fused loop knows all that a scene uses, and the functions are the course's own."""
    integrator = tracer.integrator
    return (
        numpy_kernels.AVAILABLE
        and (type(integrator) is Integrator or _fits_paths(integrator))
        # Not one that draws other numbers, as division by contrast has it.
        and type(tracer.sampler) is SobolSampler
        and integrator.max_depth <= DEEPEST
        and _fits_camera(integrator.camera)
        and _fits_motion(integrator.motion)
        and _fits_surface(integrator.surface)
        and _fits_environment(integrator.environment)
        and _fits_direct_light(integrator.direct)
        and _fits_scatter(integrator.scatter)
        and isinstance(integrator.absorption, Absorption | None)
    )


def _fits_paths(integrator: Integrator) -> bool:
    if type(integrator) is not PathIntegrator:
        return False
    if integrator.lamps_and_lobes is not None or integrator.objects is not None:
        return False
    functions = integrator.bounce.path_tracing
    names = ("diffuse_bounce", "throughput", "russian_roulette")
    return functions is None or all(
        courses_own(getattr(functions, name)) for name in names if name in vars(functions)
    )


def _fits_camera(camera: Camera) -> bool:
    if type(camera) not in (Camera, NearPlaneCamera):
        return False
    lens = camera.lens
    if lens is None:
        return True
    functions = lens.thin_lens
    return type(lens) is Lens and all(
        map(courses_own, (functions.point_on_disk, functions.lens_rays))
    )


def _fits_motion(motion: Motion | None) -> bool:
    names = ("shutter_times", "displacement", "to_object_space")
    return motion is None or all(
        courses_own(getattr(motion.motion_blur, name))
        for name in names
        if name in vars(motion.motion_blur)
    )


def _fits_surface(surface: Any) -> bool:
    seen = surface.turned, surface.kept, surface.through
    extras = surface.painting, surface.relief, surface.shine, *seen
    static, moving = (StaticAccelerator, LampAccelerator), (MovingAccelerator, SweptMovers)
    known = type(surface.accelerator) in (*static, *moving)
    return isinstance(surface, FullSurface) and known and all(extra is None for extra in extras)


def _fits_environment(environment: Environment | None) -> bool:
    if isinstance(environment, CubeEnvironment):
        name = "lookup_seamless" if environment.seamless else "lookup"
        return courses_own(getattr(environment.cube_map, name))
    return environment is None or type(environment) is ConstantEnvironment


def _fits_direct_light(direct: DirectLight | None) -> bool:
    if direct is None:
        return True
    plain = not isinstance(direct, FullDirectLight) or (
        direct.highlights is None and not direct.lifted and direct.choice is None
    )
    lamps = all(_lamp(light) is not None for light in direct.lights)
    return plain and lamps and (direct.sky is None or _fits_sky(direct.sky))


def _fits_sky(sky: Any) -> bool:
    environment = sky.environment if type(sky) is Sky else None
    return (
        isinstance(environment, CubeEnvironment)
        and _fits_environment(environment)
        and isinstance(sky.sampling, ProductSampling)
    )


def _fits_scatter(scatter: Scatter | None) -> bool:
    if scatter is None:
        return True
    if isinstance(scatter, FullScatter) and (
        scatter.conductors is not None or scatter.rough or scatter.microfacets or scatter.keeps
    ):
        return False
    gloss = scatter.gloss
    return gloss is None or (type(gloss) is Gloss and all(map(_fits_lobe, gloss.lobes)))


def _fits_lobe(lobe: Lobe) -> bool:
    functions = getattr(lobe.glossy, _LOBES[lobe.kind][1]), lobe.glossy.keep_above
    return all(map(courses_own, functions))


def fused(tracer: Tracer) -> "FusedTracer":
    """The tracer with the fused loop, of a scene that ``fits``."""
    integrator, surface = tracer.integrator, tracer.integrator.surface
    packets = in_packets(surface.accelerator, surface.triangles.parts)
    integrator = replace(integrator, surface=replace(surface, accelerator=packets))
    return FusedTracer(**same_fields(tracer) | {"integrator": integrator, "smallest": SMALLEST})


@dataclass(frozen=True)
class _Lamp:
    """A row of ``Lights``."""

    kind: int
    place: tuple[Floats32, Floats32, Floats32, Floats32]
    emitter: int = 0
    radius: float = 0.0


def _lamp(light: Light) -> _Lamp | None:
    """A light as the loop knows it; None if it doesn't."""
    nowhere = _NOWHERE
    if type(light) is DirectionalLight:
        return _Lamp(lamp_kernels.FAR_AWAY, (light.to_light, nowhere, nowhere, nowhere))
    if type(light) is PointLight:
        place: Any = (light.position, nowhere, nowhere)
        return _Lamp(lamp_kernels.AT_A_POINT, *_emitting(light, place))
    if type(light) is RectangleLight:
        if not courses_own(light.soft_shadows.point_on_rectangle):
            return None
        place = light.corner, light.edge_u, light.edge_v
        return _Lamp(lamp_kernels.RECTANGLE, *_emitting(light, place))
    if type(light) is VisibleSphereLight:
        return _Lamp(
            lamp_kernels.VISIBLE, (light.center, nowhere, nowhere, nowhere), radius=light.radius
        )
    if type(light) is not SphereLight or (light.emitter and light.samples != "sphere"):
        return None
    kind, name = _SPHERES[light.samples]
    if not courses_own(getattr(light.soft_shadows, name)):
        return None
    place = light.center, nowhere, nowhere, nowhere
    return _Lamp(kind, place, int(light.emitter), light.radius)


def _emitting(light: PointLight | RectangleLight, place: Any) -> tuple[Any, int]:
    """The places with the normal, and the kind of emitter."""
    if light.normal is None:
        return (*place, _NOWHERE), 0
    return (*place, light.normal), 1 + light.two_sided


def _lights(lights: tuple[Light, ...], dimensions: Dimensions) -> lamp_kernels.Lights:
    lamps = [lamp for light in lights if (lamp := _lamp(light)) is not None]
    n = len(lamps)
    radius = np.array([lamp.radius for lamp in lamps])
    with np.errstate(divide="ignore"):
        radii = np.stack((radius, 2 * radius, -1 / radius, radius * radius), axis=1)
    return lamp_kernels.Lights(
        kind=np.array([lamp.kind for lamp in lamps], np.int64),
        emitter=np.array([lamp.emitter for lamp in lamps], np.int64),
        place=np.array([lamp.place for lamp in lamps], np.float32).reshape(n, 4, 3),
        radius=radii.astype(np.float32),
        color=np.array([light.color for light in lights], np.float32).reshape(n, 3),
        limit=np.array([light.limit for light in lights], np.float32),
        velocity=np.array(
            [_NOWHERE if light.velocity is None else light.velocity for light in lights], np.float32
        ).reshape(n, 3),
        moves=np.array([light.velocity is not None for light in lights], np.bool_),
        pair=np.array(
            [dimensions.first(light.name, 0) // 2 if light.width else 0 for light in lights],
            np.int64,
        ),
        width=np.array([light.width for light in lights], np.int64),
    )


def _rows(lookup: Lookup | None) -> Floats32:
    return _NO_COLUMNS if lookup is None else lookup.rows


def _parameter(lobe: Lobe) -> float:
    """The number that a function of ``glossy`` multiplies by."""
    if lobe.kind == "phong":
        return 1 / (float(lobe.parameter) + 1)
    if lobe.kind == "ball":
        # Rounding doesn't make the radius 1.
        return min(float(lobe.parameter), 1 - 4 * float(np.finfo(np.float32).eps))
    return float(lobe.parameter)


def _scattering(integrator: Integrator, dimensions: Dimensions) -> bounce_kernels.Scattering:
    scatter, accelerator = integrator.scatter, integrator.surface.accelerator
    lobes = scatter.gloss.lobes if scatter is not None and scatter.gloss is not None else ()
    first, worth = np.empty(0, np.int32), np.empty(0, np.bool_)
    if isinstance(accelerator, PacketAccelerator) and accelerator.convex is not None:
        first, worth = accelerator.convex.first, accelerator.convex.worth
    outside = np.empty(0, np.int16)
    if scatter is not None and scatter.outside is not None:
        outside = scatter.outside.astype(np.int16)
    return bounce_kernels.Scattering(
        mirror=_NO_COLUMNS if scatter is None else scatter.mirror.rows,
        refraction_index=_NONE if scatter is None or scatter.index is None else scatter.index.rows,
        outside=outside,
        lobe_material=np.array([lobe.material for lobe in lobes], np.int64),
        lobe_kind=np.array([_LOBES[lobe.kind][0] for lobe in lobes], np.int64),
        lobe_parameter=np.array([_parameter(lobe) for lobe in lobes], np.float32),
        lobe_width=np.array([lobe.width for lobe in lobes], np.int64),
        lobe_pair=dimensions.first("gloss", 0) // 2 if lobes else 0,
        first=first,
        worth=worth,
        cutoff=np.float32(0 if scatter is None else scatter.cutoff),
    )


def _sky(direct: DirectLight | None, dimensions: Dimensions) -> daylight_kernels.Sky:
    sky: Any = None if direct is None else direct.sky
    if sky is None:
        edges: Any = [np.zeros((1, 2), np.float32), np.zeros((1, 1), np.int32)] * 4
        product = daylight_kernels.Product(1, 1, np.zeros((6, 9), np.float32), *edges)
        nothing = _NO_MASK.ravel()
        return daylight_kernels.Sky(nothing, nothing, _NO_FACES, False, 0, product)
    environment = sky.environment
    return daylight_kernels.Sky(
        np.ascontiguousarray(sky.diffuses),
        np.ascontiguousarray(sky.refracts),
        np.ascontiguousarray(environment.faces),
        environment.seamless,
        dimensions.first(NUMBERS[0], 0) // 2,
        daylight_kernels.Product(*sky.sampling.arrays),
    )


def _surroundings(integrator: Integrator) -> fused_kernels.Surroundings:
    environment, faces, seamless = integrator.environment, _NO_FACES, False
    color = environment.color if isinstance(environment, ConstantEnvironment) else _NOWHERE
    if isinstance(environment, CubeEnvironment):
        faces, seamless = np.ascontiguousarray(environment.faces), environment.seamless
    depth = -1 if environment is None else integrator.environment_depth
    return fused_kernels.Surroundings(color, faces, seamless, depth)


def _scene(integrator: Integrator) -> fused_kernels.Scene:
    triangles, accelerator = integrator.surface.triangles, integrator.surface.accelerator
    assert isinstance(accelerator, PacketAccelerator | MovingPackets)
    tables, first, objects = accelerator.tables, np.zeros(1, np.int64), _NO_BOXES
    if isinstance(accelerator, MovingPackets):
        first = accelerator.numbers
    elif accelerator.convex is not None:
        objects = accelerator.convex.boxes
    normals, bulge = triangles.corner_normals, triangles.bulge
    return fused_kernels.Scene(
        *(tables.scenes, tables.blockers, tables.velocity, tables.boxes, first),
        *(triangles.planes, triangles.edges, triangles.inset),
        _NO_ROWS if normals is None else normals,
        _NO_BOXES if bulge is None else bulge,
        triangles.material,
        np.float32(triangles.largest_sine + ROUNDING),
        objects,
    )


def _paths(integrator: Integrator, dimensions: Dimensions) -> path_kernels.Paths | None:
    """How paths go on; None for rays that follow every way."""
    if not isinstance(integrator, PathIntegrator):
        return None
    bounce = integrator.bounce
    diffuses = bounce.path_tracing is not None
    first = [
        dimensions.first(name, 0) // 2 if name in dimensions.width else 0
        for name, _ in (BOUNCE, CHOICE)
    ]
    return path_kernels.Paths(
        bounce.diffuse.rows if diffuses else np.zeros_like(bounce.diffuse.rows),
        bounce.optical if bounce.scatter is not None else np.zeros_like(bounce.optical),
        # Without a diffuse surface every path with light goes on.
        -1 if bounce.roulette is None or not diffuses else bounce.roulette,
        *first,
    )


def _glows(glow: Glow | None) -> Floats32:
    return _NO_COLUMNS if glow is None else glow.radiance


def _reflectances(integrator: Integrator) -> fused_kernels.Reflectances:
    direct, absorption = integrator.direct, integrator.absorption
    materials = 1 + int(integrator.surface.triangles.material.max(initial=0))
    specular = None if direct is None else direct.specular
    shaded = None if direct is None else direct.shaded
    dark = integrator.dark_inside
    glow, emission = _rows(integrator.glow), _rows(integrator.emission)
    if isinstance(integrator, PathIntegrator):
        glow, emission = _glows(integrator.unsought), _glows(integrator.lamps)
    return fused_kernels.Reflectances(
        np.zeros((3, materials), np.float32) if direct is None else direct.diffuse.rows,
        _rows(specular),
        _NONE if direct is None or specular is None else direct.exponent.rows,
        _NO_MASK if shaded is None else shaded,
        _rows(integrator.ambient),
        np.empty(0, np.bool_) if dark is None else dark,
        glow,
        emission,
        absorption.coefficient.rows if isinstance(absorption, Absorption) else _NO_COLUMNS,
        absorption.dielectric if isinstance(absorption, Absorption) else np.empty(0, np.bool_),
    )


def _eye(integrator: Integrator, dimensions: Dimensions) -> number_kernels.Eye:
    camera, motion = integrator.camera, integrator.motion
    velocity = None if motion is None else motion.camera_velocity
    near = camera.near if isinstance(camera, NearPlaneCamera) else 0.0
    axes = camera.origin, camera.right, camera.up, camera.forward
    steps = camera.corner, camera.step_x, camera.step_y
    lens = camera.lens
    sizes = (0.0, 0.0) if lens is None else (lens.aperture_radius, lens.focus_distance)
    return number_kernels.Eye(
        np.stack((*axes, *steps, _NOWHERE if velocity is None else velocity)).astype(np.float32),
        np.array((*sizes, near), np.float32),
        -1 if lens is None else dimensions.first("lens", 0) // 2,
        -1 if motion is None else dimensions.first("time", 0) // 2,
        int(velocity is not None),
    )


@dataclass(frozen=True)
class FusedTracer(Tracer):
    """Renders tiles by the fused loop."""

    @cached_property
    def _tables(self) -> tuple[Any, ...]:
        """What the loop is handed of the scene."""
        integrator, dimensions = self.integrator, self.dimensions
        lights = () if integrator.direct is None else integrator.direct.lights
        stride = dimensions.first("pixel", 1) // 2
        return (
            _eye(integrator, dimensions),
            _scene(integrator),
            _reflectances(integrator),
            _lights(lights, dimensions),
            _sky(integrator.direct, dimensions),
            _scattering(integrator, dimensions),
            _paths(integrator, dimensions),
            _surroundings(integrator),
            fused_kernels.Depths(
                integrator.max_depth,
                integrator.coherent_depth,
                stride,
                self._pairs - integrator.max_depth * stride,
            ),
        )

    def _scratch(self) -> fused_kernels.Scratch:
        """Memory for the loop."""
        integrator, rows, width = self.integrator, lanes.ALL_ROWS, WIDTH
        memory = aligned(rows + lanes.ALL_INTEGERS)
        arguments = np.zeros(16, np.uint32)
        # Of Embree's features all.
        arguments[1] = 0xFFFFFFFF
        depth, scatter = integrator.max_depth, integrator.scatter
        stack, more = (fused_kernels.CHUNK, 0)
        if scatter is not None and scatter.index is not None:
            more = fused_kernels.LARGEST
            stack = (depth + 3) * more
        brought, follows = more, scatter is not None
        if isinstance(integrator, PathIntegrator):
            # Each hit sends one ray on.
            stack = more = fused_kernels.PATH_CHUNK
            brought, follows = 0, True
        return fused_kernels.Scratch(
            *(memory[: rows * width], memory[rows * width :].view(np.int32)),
            *(arguments, numpy_kernels.call_of()),
            np.empty((stack if follows else 0, bounce_kernels.RAY), np.float32),
            np.empty((more, bounce_kernels.RAY), np.float32),
            np.empty((brought, 5), np.float32),
            np.empty((2 * depth + 4, 4), np.int64),
            np.empty(3, np.float32),
            np.empty(4, np.float32),
            np.empty((4, 3), np.int64),
        )

    def render_tile(
        self,
        tile: Area,
        first: int,
        samples: int,
        counters: Counters,
        cancelled: Callable[[], bool] = lambda: False,
        parts: int = 1,
    ) -> tuple[Floats32, Floats32 | float]:
        """See ``Tracer``."""
        if cancelled():
            raise CancelledError
        counters.start()
        block = Block(tile.pixel_numbers(self.settings.width), first, samples, tile.number)
        costs = self.costs(block.size) if self.costs is not None and parts > 1 else None
        sampler = self.sampler
        assert isinstance(sampler, SobolSampler)
        tables = sampler.tables(block, self._pairs)
        x, y = tile.corners()
        pixels = np.ascontiguousarray(block.pixels)
        weighted = self.reconstruction.sigma is not None
        film = fused_kernels.Film(
            np.empty((3, block.size), np.float32),
            np.empty((2, block.size if weighted else 0), np.float32),
            _NONE if costs is None else costs.row,
            np.array((0, 0, 0, 0) if costs is None else (*costs.prices, COST), np.float32),
            np.zeros(lanes.COUNTS, np.int64),
        )
        numbers = number_kernels.Numbers(pixels, x, y, samples, *tables)
        fused_kernels.follow(numbers, *self._tables, film, self._scratch())
        self._count(block, film.counts, counters)
        counters.lap("trace")
        pieces = (-1, tile.size * parts, samples // parts)
        # A box filter doesn't look where samples lie.
        places = film.offsets.reshape(pieces) if weighted else film.offsets
        mean, weight = self.reconstruction.pixels(film.radiance.reshape(pieces), places)
        counters.lap("film")
        return mean if costs is None else costs.with_row(mean, parts), weight

    @cached_property
    def _pairs(self) -> int:
        """Number of pairs of dimensions that are drawn from, at least."""
        dimensions, depth = self.dimensions, self.integrator.max_depth
        ends = [dimensions.first(name, depth) + width for name, width in dimensions.width.items()]
        return (max(ends) + 1) // 2

    def _count(self, block: Block, counts: Any, counters: Counters) -> None:
        integrator = self.integrator
        counters.embree.seconds += 1e-9 * lamp_kernels.TIMED * int(counts[lanes.NANOSECONDS])
        counters.rays.update(
            {
                "camera": block.size,
                "shadow": int(counts[lanes.SHADOW_RAYS] + counts[lanes.SECOND_RAYS]),
                "reflection": int(counts[lanes.REFLECTIONS]),
                "refraction": int(counts[lanes.REFRACTIONS]),
            }
        )
        if counts[lanes.PATHS]:
            counters.rays["path"] += int(counts[lanes.PATHS])
        drawn = {"pixel": 2 * block.size, "gloss": int(counts[lanes.GLOSSY])}
        drawn[NUMBERS[0]] = NUMBERS[1] * int(counts[lanes.SKY])
        drawn[BOUNCE[0]] = BOUNCE[1] * int(counts[lanes.BOUNCES])
        drawn[CHOICE[0]] = int(counts[lanes.CHOICES])
        drawn["lens"] = 2 * block.size if integrator.camera.lens is not None else 0
        drawn["time"] = block.size if integrator.motion is not None else 0
        for light in () if integrator.direct is None else integrator.direct.lights:
            drawn[light.name] = light.width * int(counts[lanes.HITS])
        counters.numbers.update({name: number for name, number in drawn.items() if number})
