"""What the fused loop is handed of a scene that ``fits`` it, tile by tile."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from course.engine.core.blinn_phong import BlinnPhong
from course.engine.core.camera import Lens
from course.engine.core.counters import Counters
from course.engine.core.direct import ROUNDING, DirectLight
from course.engine.core.environment import ConstantEnvironment, CubeEnvironment
from course.engine.core.gloss import Lobe
from course.engine.core.integrator import CancelledError, Integrator
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.materials import Lookup
from course.engine.core.rays import Dimensions, Draws
from course.engine.core.samplers import Block
from course.engine.core.tiles import Area
from course.engine.core.tracer import Tracer
from course.engine.core.types import Floats, Floats32, Indices
from course.engine.loops import (
    bounce_kernels,
    daylight_kernels,
    fused_kernels,
    lamp_kernels,
    lanes,
    mesh_kernels,
    number_kernels,
    numpy_kernels,
    path_kernels,
    shaft_kernels,
)
from course.engine.loops.fits import depths_of_lights, makes_camera_rays, placed_before
from course.engine.loops.packets import WIDTH, aligned
from course.engine.loops.paint_tables import paint_tables
from course.engine.loops.scene_tables import SceneTables, scene_tables
from course.engine.terms.cameras.near_plane import NearPlaneCamera
from course.engine.terms.environments.sky import COST, NUMBERS
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.spot_light import SpotLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.paths.path_tracing import Glow, PathIntegrator
from course.engine.terms.plan import BOUNCE, CHOICE, same_fields
from course.engine.terms.samplers.sobol import SobolSampler
from course.engine.terms.scattering.absorption import Absorption
from course.engine.terms.shafts.cells import Cells
from course.engine.terms.shafts.stage import MOST_LIGHTS, REASONS, ShaftTables

_NO_COLUMNS, _NO_ROWS = np.empty((3, 0), np.float32), np.empty((0, 9), np.float32)
_NONE, _NO_MASK = np.empty(0, np.float32), np.empty((0, 0), np.bool_)
_NO_NUMBERS = np.empty((0, 0), np.float32)
_NO_FACES = np.empty((6, 0, 0, 3), np.float32)
_NOWHERE, _NO_BOXES = np.zeros(3, np.float32), np.empty((0, 3), np.float32)
_NO_OWNERS, _NO_PLACES = np.empty((0, 2), np.int32), np.empty(0, np.int64)
_NO_CELLS = Cells(
    *(_NO_OWNERS, np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 4)), np.empty((0, 2))),
    *(_NO_PLACES, _NO_PLACES, _NOWHERE, _NOWHERE, _NOWHERE),
)
_NO_SHAFTS = shaft_kernels.FusedShafts(
    *(*_NO_CELLS, _NO_ROWS, _NO_BOXES, _NONE, np.empty(0, np.int32), np.empty(0, np.int32)),
    *(np.empty((0, 6), np.float32), _NO_OWNERS, _NO_PLACES, _NO_PLACES),
    *(np.empty((0, 15)), np.empty((0, 0), np.uint64), np.uint64(0), False),
)

SMALLEST = 16384
"""Camera rays in a tile, at least: beside so many, its memory and its place in the film take little time."""

_SPHERES = {
    "sphere": lamp_kernels.SPHERE,
    "ball": lamp_kernels.BALL,
    "facing disk": lamp_kernels.FACING_DISK,
}
_LOBES = {
    "plane": bounce_kernels.PLANE,
    "ball": bounce_kernels.IN_BALL,
    "phong": bounce_kernels.PHONG,
}


def fused(tracer: Tracer) -> "FusedTracer":
    """The tracer with the fused loop, of a scene that ``fits``."""
    known = same_fields(tracer)
    if type(tracer.sampler) is SobolSampler:
        # The numbers of other samplers belong to a tile.
        known["smallest"] = SMALLEST
    return FusedTracer(**known)


@dataclass(frozen=True)
class _Lamp:
    """A row of ``Lights``."""

    kind: int
    place: tuple[Floats32, Floats32, Floats32]
    emitter: int = 0
    normal: Floats | None = None
    radius: float = 0.0


def _lamp(light: Light) -> _Lamp:
    """A light as the loop knows it."""
    nowhere = _NOWHERE
    if type(light) is DirectionalLight:
        return _Lamp(lamp_kernels.FAR_AWAY, (light.to_light, nowhere, nowhere))
    if type(light) is PointLight:
        place: Any = (light.position, nowhere, nowhere)
        return _Lamp(lamp_kernels.AT_A_POINT, place, *_emitting(light))
    if type(light) is SpotLight:
        falloff = np.array((*light.falloff, 0), np.float32)
        return _Lamp(lamp_kernels.SPOT, (light.position, light.axis, falloff))
    if type(light) is RectangleLight:
        place = light.corner, light.edge_u, light.edge_v
        return _Lamp(lamp_kernels.RECTANGLE, place, *_emitting(light))
    if type(light) is VisibleSphereLight:
        return _Lamp(lamp_kernels.VISIBLE, (light.center, nowhere, nowhere), radius=light.radius)
    if type(light) is MeshLight:
        return _Lamp(lamp_kernels.TRIANGLES, (nowhere, nowhere, nowhere))
    assert isinstance(light, SphereLight)
    place = light.center, nowhere, nowhere
    return _Lamp(_SPHERES[light.samples], place, int(light.emitter), radius=light.radius)


def _emitting(light: PointLight | RectangleLight) -> tuple[int, Floats | None]:
    """The kind of emitter, and the normal."""
    return (0, None) if light.normal is None else (1 + light.two_sided, light.normal)


def _lights(integrator: Integrator, dimensions: Dimensions) -> lamp_kernels.Lights:
    lights = () if integrator.direct is None else integrator.direct.lights
    rows = 3 * depths_of_lights(integrator)
    placed = {light.name: rows * k for k, light in enumerate(placed_before(integrator))}
    lamps = [_lamp(light) for light in lights]
    n = len(lamps)
    radius = np.array([lamp.radius for lamp in lamps])
    with np.errstate(divide="ignore"):
        radii = np.stack((radius, 2 * radius, -1 / radius, radius * radius), axis=1)
    return lamp_kernels.Lights(
        kind=np.array([lamp.kind for lamp in lamps], np.int64),
        emitter=np.array([lamp.emitter for lamp in lamps], np.int64),
        place=np.array([lamp.place for lamp in lamps], np.float32).reshape(n, 3, 3),
        normal=np.array(
            [_NOWHERE if lamp.normal is None else lamp.normal for lamp in lamps], np.float64
        ).reshape(n, 3),
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
        placed=np.array([placed.get(light.name, -1) for light in lights], np.int64),
        meshes=_meshes(lights),
    )


def _meshes(lights: tuple[Light, ...]) -> mesh_kernels.Meshes:
    """Triangles of the lights that have some, light by light."""
    own = [light if isinstance(light, MeshLight) else None for light in lights]
    found = [light for light in own if light is not None]

    def starts(count: Callable[[MeshLight], int]) -> Indices:
        return np.cumsum([0, *(0 if light is None else count(light) for light in own)])

    def joined(arrays: Iterable[Any], empty: Any = _NONE) -> Any:
        return np.ascontiguousarray(np.concatenate([empty, *arrays]))

    table, groups = np.empty((0, 8), np.float32), [light.groups for light in found]
    return mesh_kernels.Meshes(
        group=starts(lambda light: len(light.groups.share)),
        place=starts(lambda light: len(light.shares)),
        triangle_of=starts(lambda light: len(light.planes)),
        trust=np.array([0 if light is None else light.groups.trust for light in own], np.float32),
        moments=joined((each.moments.T for each in groups), np.empty((0, 10), np.float32)),
        share=joined(each.share for each in groups),
        start=joined(each.start for each in groups),
        last=joined(each.last for each in groups),
        shares=joined(each.shares for each in groups),
        triangle=joined((each.triangle for each in groups), np.empty(0, np.int64)),
        planes=joined((light.planes for light in found), table),
        edges=joined((light.edges for light in found), table),
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


def _scattering(
    integrator: Integrator, dimensions: Dimensions, tables: SceneTables, narrow: int
) -> bounce_kernels.FusedScattering:
    scatter = integrator.scatter
    lobes = scatter.gloss.lobes if scatter is not None and scatter.gloss is not None else ()
    first, worth = np.empty(0, np.int32), np.empty(0, np.bool_)
    if tables.convex is not None:
        first, worth = tables.convex.first, tables.convex.worth
    widest = max((lobe.width for lobe in lobes), default=0)
    outside = np.empty(0, np.int16)
    if scatter is not None and scatter.outside is not None:
        outside = scatter.outside.astype(np.int16)
    return bounce_kernels.FusedScattering(
        mirror=_NO_COLUMNS if scatter is None else scatter.mirror.rows,
        refraction_index=_NONE if scatter is None or scatter.index is None else scatter.index.rows,
        outside=outside,
        lobe_material=np.array([lobe.material for lobe in lobes], np.int64),
        lobe_kind=np.array([_LOBES[lobe.kind] for lobe in lobes], np.int64),
        lobe_parameter=np.array([_parameter(lobe) for lobe in lobes], np.float32),
        lobe_width=np.array([lobe.width for lobe in lobes], np.int64),
        lobe_shift=np.array([narrow * (lobe.width < widest) for lobe in lobes], np.int64),
        lobe_pair=dimensions.first("gloss", 0) // 2 if lobes else 0,
        first=first,
        worth=worth,
        cutoff=np.float32(0 if scatter is None else scatter.cutoff),
    )


def _sky(direct: DirectLight | None, dimensions: Dimensions) -> daylight_kernels.FusedSky:
    sky: Any = None if direct is None else direct.sky
    if sky is None:
        edges: Any = [np.zeros((1, 2), np.float32), np.zeros((1, 1), np.int32)] * 4
        product = daylight_kernels.Product(1, 1, np.zeros((6, 9), np.float32), *edges)
        nothing = _NO_MASK.ravel()
        return daylight_kernels.FusedSky(nothing, nothing, _NO_FACES, False, 0, product)
    environment = sky.environment
    return daylight_kernels.FusedSky(
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


def _scene(integrator: Integrator, tables: SceneTables) -> fused_kernels.FusedScene:
    triangles = integrator.surface.triangles
    normals, bulge = triangles.corner_normals, triangles.bulge
    return fused_kernels.FusedScene(
        *(tables.scenes, tables.blockers, tables.velocity, tables.boxes, tables.first),
        *(triangles.planes, triangles.edges, triangles.inset),
        _NO_ROWS if normals is None else normals,
        _NO_BOXES if bulge is None else bulge,
        triangles.material,
        np.float32(triangles.largest_sine + ROUNDING),
        _NO_BOXES if tables.convex is None else tables.convex.boxes,
        *paint_tables(integrator.surface),
    )


def _shafts(integrator: Integrator) -> shaft_kernels.FusedShafts:
    """What is known of shafts; without a row for any light where there are none."""
    direct = integrator.direct
    shafts: Any = None if direct is None else direct.spare
    tables: ShaftTables | None = None if shafts is None else shafts.made
    if direct is None or tables is None:
        return _NO_SHAFTS
    lamps = [
        np.array((*lamp.middle, *lamp.half.ravel(), lamp.radius, lamp.limit, lamp.far), np.float64)
        for lamp in tables.lamps
    ]
    # A function of others may place points outside the light, of which its shafts tell nothing.
    placed = {id(light) for light in placed_before(integrator)}
    slots = [
        -1 if id(light) in placed else tables.slots.get(id(light), -1) for light in direct.lights
    ]
    moves = integrator.motion is not None
    return shaft_kernels.FusedShafts(
        *(*tables.cells, *tables.boxes, np.array(slots, np.int64)),
        *(np.array(lamps), tables.known, np.uint64(65 - tables.known.shape[1].bit_length()), moves),
    )


def _paths(integrator: Integrator, dimensions: Dimensions) -> path_kernels.FusedPaths | None:
    """How paths go on; None for rays that follow every way."""
    if not isinstance(integrator, PathIntegrator):
        return None
    bounce = integrator.bounce
    diffuses = bounce.path_tracing is not None
    first = [
        dimensions.first(name, 0) // 2 if name in dimensions.width else 0
        for name, _ in (BOUNCE, CHOICE)
    ]
    return path_kernels.FusedPaths(
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
    reflection = None if direct is None else direct.reflection
    assert isinstance(reflection, BlinnPhong | None)
    specular = None if reflection is None else reflection.specular
    shaded = None if direct is None else direct.shaded
    dark = integrator.dark_inside
    glow, emission, objects = _rows(integrator.glow), _rows(integrator.emission), _NO_COLUMNS
    if isinstance(integrator, PathIntegrator):
        glow, emission, objects = (
            _glows(each) for each in (integrator.unsought, integrator.lamps, integrator.objects)
        )
    return fused_kernels.Reflectances(
        np.zeros((3, materials), np.float32) if reflection is None else reflection.diffuse.rows,
        _rows(specular),
        _NONE if reflection is None or specular is None else _exponents(reflection, specular),
        _NO_MASK if shaded is None else shaded,
        _rows(integrator.ambient),
        np.empty(0, np.bool_) if dark is None else dark,
        glow,
        emission,
        objects,
        absorption.coefficient.rows if isinstance(absorption, Absorption) else _NO_COLUMNS,
        absorption.dielectric if isinstance(absorption, Absorption) else np.empty(0, np.bool_),
    )


def _exponents(reflection: BlinnPhong, specular: Lookup) -> Floats32:
    """Those of highlights; -1 for materials without one."""
    shiny = (specular.rows != 0).any(axis=0)
    return np.where(shiny, reflection.exponent.rows, np.float32(-1))


def _coherent_depth(integrator: Integrator) -> int:
    """Largest depth at which neighbouring rays have similar directions, -1 for none."""
    if integrator.camera.lens is not None:
        return -1
    scatter = integrator.scatter
    spread = scatter is not None and scatter.gloss is not None
    return 0 if integrator.motion or spread or isinstance(integrator, PathIntegrator) else 1


def _eye(integrator: Integrator, dimensions: Dimensions) -> number_kernels.Eye:
    """The camera; of no meaning but for its place and direction where rays are made before."""
    camera, motion = integrator.camera, integrator.motion
    velocity = None if motion is None else motion.camera_velocity
    near = camera.near if isinstance(camera, NearPlaneCamera) else 0.0
    axes = camera.origin, camera.right, camera.up, camera.forward
    steps = camera.corner, camera.step_x, camera.step_y
    lens = camera.lens
    sizes = (0.0, 0.0) if type(lens) is not Lens else (lens.aperture_radius, lens.focus_distance)
    return number_kernels.Eye(
        np.stack((*axes, *steps, _NOWHERE if velocity is None else velocity)).astype(np.float32),
        np.array((*sizes, near), np.float32),
        -1 if lens is None else dimensions.first("lens", 0) // 2,
        -1 if motion is None else dimensions.first("time", 0) // 2,
        int(velocity is not None),
    )


def _placed(
    before: tuple[RectangleLight | SphereLight, ...], depths: int, draws: Draws
) -> Floats32:
    """``Numbers.placed`` of a block."""
    if not before:
        return _NO_NUMBERS
    placed = np.empty((len(before), depths, 3, draws.block.size), np.float32)
    for rows, light in zip(placed, before, strict=True):
        for depth in range(depths):
            u = draws(light.name, None, depth)
            if isinstance(light, RectangleLight):
                rows[depth] = light.on_light(u)
            else:
                center = _NOWHERE if light.emitter else light.center
                rows[depth] = light.on_light(center, _NO_COLUMNS, u)
    return placed.reshape(-1, draws.block.size)


@dataclass(frozen=True)
class FusedTracer(Tracer):
    """Renders tiles by the fused loop."""

    @cached_property
    def _tables(self) -> tuple[Any, ...]:
        """What the loop is handed of the scene."""
        integrator, dimensions = self.integrator, self.dimensions
        stride = dimensions.first("pixel", 1) // 2
        surface = integrator.surface
        tables = scene_tables(surface.accelerator, surface.triangles.parts)
        return (
            _eye(integrator, dimensions),
            _scene(integrator, tables),
            _shafts(integrator),
            _reflectances(integrator),
            _lights(integrator, dimensions),
            _sky(integrator.direct, dimensions),
            _scattering(integrator, dimensions, tables, self._pairs * self._draws_before),
            _paths(integrator, dimensions),
            _surroundings(integrator),
            fused_kernels.Depths(
                integrator.max_depth,
                _coherent_depth(integrator),
                stride,
                self._pairs - integrator.max_depth * stride,
            ),
        )

    def _scratch(self) -> fused_kernels.Scratch:
        """Memory for the loop."""
        integrator, rows, width = self.integrator, lanes.ALL_ROWS, WIDTH
        lights = MOST_LIGHTS if integrator.direct and integrator.direct.spare else 0
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
            np.full((lights, 3), -1, np.int64),
            np.empty(shaft_kernels.WALK),
            np.empty(shaft_kernels.PILE, np.int64),
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
        x, y = tile.corners()
        weighted = self.reconstruction.sigma is not None
        film = fused_kernels.FusedFilm(
            np.empty((3, block.size), np.float32),
            np.empty((2, block.size if weighted else 0), np.float32),
            _NONE if costs is None else costs.row,
            np.array((0, 0, 0, 0) if costs is None else (*costs.prices, COST), np.float32),
            np.zeros(lanes.COUNTS, np.int64),
        )
        numbers = self._numbers(block, x, y)
        counters.lap("sampler")
        fused_kernels.follow(numbers, *self._tables, film, self._scratch())
        self._count(block, film.counts, counters)
        counters.lap("trace")
        pieces = (-1, tile.size * parts, samples // parts)
        # A box filter doesn't look where samples lie.
        places = film.offsets.reshape(pieces) if weighted else film.offsets
        mean, weight = self.reconstruction.pixels(film.radiance.reshape(pieces), places)
        counters.lap("film")
        return mean if costs is None else costs.with_row(mean, parts), weight

    def _numbers(self, block: Block, x: Floats32, y: Floats32) -> number_kernels.Numbers:
        """Numbers of a block whose pixels have corners (n,), and its camera rays where the loop doesn't make them."""
        sampler, integrator, dimensions = self.sampler, self.integrator, self.dimensions
        draws = Draws(sampler, dimensions, block, Counters())
        drawn, seen = _NO_NUMBERS, np.empty((9, 0), np.float32)
        if isinstance(sampler, SobolSampler):
            tables: Any = sampler.tables(block, self._pairs)
        else:
            tables = np.zeros((0, 0, 0), np.uint32), 0, np.zeros((0, 0), np.uint64)
            drawn = self._drawn(draws)
        if not self._makes_camera_rays:
            offsets = draws("pixel").reshape(2, -1, block.samples)
            across, down = (x[:, None] + offsets[0]).ravel(), (y[:, None] + offsets[1]).ravel()
            rays = integrator.camera_rays(across, down, draws)
            seen = np.empty((9, block.size), np.float32)
            seen[:3], seen[3:6] = rays.origin, rays.direction
            seen[6] = 0 if rays.time is None else rays.time
            seen[7:] = offsets.reshape(2, -1)
        pixels = np.ascontiguousarray(block.pixels)
        points, first, salts = tables
        placed = _placed(self._placed_before, depths_of_lights(integrator), draws)
        return number_kernels.Numbers(
            pixels, x, y, block.samples, points, first, salts, drawn, seen, placed
        )

    @cached_property
    def _placed_before(self) -> tuple[RectangleLight | SphereLight, ...]:
        # Whose a function is is told by its file: not once a tile.
        return placed_before(self.integrator)

    @cached_property
    def _makes_camera_rays(self) -> bool:
        return makes_camera_rays(self)

    @property
    def _draws_before(self) -> bool:
        return not isinstance(self.sampler, SobolSampler)

    def _drawn(self, draws: Draws) -> Floats32:
        """All numbers of a block; behind them those of lobes that take fewer, for a sampler has others for these."""
        dimensions, integrator, pairs = self.dimensions, self.integrator, self._pairs
        scatter = integrator.scatter
        lobes = () if scatter is None or scatter.gloss is None else scatter.gloss.lobes
        narrow = {lobe.width for lobe in lobes} - {dimensions.width.get("gloss")}
        drawn = np.empty((2 * pairs * (1 + len(narrow)), draws.block.size), np.float32)
        for name, width in dimensions.width.items():
            for depth in range(1 if name in dimensions.of_path else integrator.max_depth + 1):
                row = dimensions.first(name, depth)
                if name == CHOICE[0]:
                    # Nothing mirrors: roulette alone draws, the second number.
                    drawn[row + 1] = draws(name, None, depth, 1, skip=1)[0]
                    continue
                drawn[row : row + width] = draws(name, None, depth)
                if name == "gloss":
                    for few in narrow:
                        behind = row + 2 * pairs
                        drawn[behind : behind + few] = draws(name, None, depth, few)
        return drawn

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
        known = int(counts[lanes.CLEAR]), int(counts[lanes.CUT_OFF])
        if any(known):
            counters.spared.update(dict(zip(REASONS, known, strict=True)))
            counters.rays["shadow"] -= sum(known)
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
