"""Which scenes the fused loop can follow, and what it is handed for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from course.compiled import (
    fused_kernels,
    lamp_kernels,
    lanes,
    number_kernels,
    numpy_kernels,
    packet_kernels,
)
from course.compiled.accelerator import PacketAccelerator, in_packets
from course.compiled.own import courses_own
from course.compiled.packets import COHERENT
from course.core.camera import Camera
from course.core.counters import Counters
from course.core.direct import ROUNDING, DirectLight
from course.core.embree import EmbreeAccelerator
from course.core.environment import ConstantEnvironment
from course.core.integrator import CancelledError
from course.core.lights.point import DirectionalLight, PointLight
from course.core.lights.rectangle import RectangleLight
from course.core.lights.sample import Light
from course.core.lights.sphere import SphereLight
from course.core.materials import Lookup
from course.core.rays import Dimensions
from course.core.samplers import Block
from course.core.tiles import Area
from course.core.tracer import Tracer
from course.core.types import Floats32
from course.extras.direct import FullDirectLight
from course.extras.near_plane import NearPlaneCamera
from course.extras.plan import same_fields
from course.extras.samplers.sobol import SobolSampler
from course.extras.surface import FullSurface

_NO_COLUMNS, _NO_ROWS = np.empty((3, 0), np.float32), np.empty((0, 9), np.float32)
_NONE, _NO_MASK = np.empty(0, np.float32), np.empty((0, 0), np.bool_)
_NOWHERE = np.zeros(3, np.float32)

_KINDS = {
    "sphere": "point_on_sphere",
    "ball": "point_in_ball",
    "facing disk": "point_on_facing_disk",
}


def fits(tracer: Tracer) -> bool:
    """True if the fused loop has all that a compiled tracer's scene uses, and only the course's own functions."""
    integrator, surface, camera = (
        tracer.integrator,
        tracer.integrator.surface,
        tracer.integrator.camera,
    )
    direct = integrator.direct
    return (
        numpy_kernels.AVAILABLE
        # Not one that draws other numbers, as division by contrast has it.
        and type(tracer.sampler) is SobolSampler
        and integrator.scatter is None
        and integrator.motion is None
        and camera.lens is None
        and type(camera) in (Camera, NearPlaneCamera)
        and (
            integrator.environment is None
            or isinstance(integrator.environment, ConstantEnvironment)
        )
        and type(surface.accelerator) is EmbreeAccelerator
        and _plain(surface)
        and (direct is None or _known(direct))
    )


def fused(tracer: Tracer) -> FusedTracer:
    """The tracer with the fused loop, of a scene that ``fits``."""
    integrator, surface = tracer.integrator, tracer.integrator.surface
    surface = replace(surface, accelerator=in_packets(surface.accelerator))
    integrator = replace(integrator, surface=surface)
    return FusedTracer(**same_fields(tracer) | {"integrator": integrator})


def _plain(surface: Any) -> bool:
    extras = surface.painting, surface.turned, surface.kept, surface.through
    return isinstance(surface, FullSurface) and all(extra is None for extra in extras)


def _known(direct: DirectLight) -> bool:
    plain = not isinstance(direct, FullDirectLight) or (direct.plain is None and not direct.lifted)
    return direct.sky is None and plain and all(_lamp(light) is not None for light in direct.lights)


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
    if type(light) is not SphereLight or (light.emitter and light.samples != "sphere"):
        return None
    if not courses_own(getattr(light.soft_shadows, _KINDS[light.samples])):
        return None
    kind = (lamp_kernels.SPHERE, lamp_kernels.BALL, lamp_kernels.FACING_DISK)
    place = light.center, nowhere, nowhere, nowhere
    return _Lamp(kind[list(_KINDS).index(light.samples)], place, int(light.emitter), light.radius)


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
        radii = np.stack((radius, 2 * radius, -1 / radius), axis=1)
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


def _scratch() -> tuple[Any, ...]:
    """Memory for the loop: rows of lanes, at an address that 64 divides, as Embree wants it, and its arguments."""
    rows, line = lanes.ALL_ROWS, 4 * packet_kernels.WIDTH
    memory = np.zeros((rows + lanes.ALL_INTEGERS + 1) * line, np.uint8)
    memory = memory[-memory.ctypes.data % line :][: (rows + lanes.ALL_INTEGERS) * line]
    arguments = np.zeros(16, np.uint32)
    arguments[1] = 0xFFFFFFFF
    lane, integer = memory[: rows * line].view(np.float32), memory[rows * line :].view(np.int32)
    return lane, integer, arguments, numpy_kernels.call_of()


@dataclass(frozen=True)
class FusedTracer(Tracer):
    """Renders tiles by the fused loop."""

    @cached_property
    def _tables(self) -> tuple[Any, ...]:
        """What the loop is handed of the scene."""
        integrator, dimensions = self.integrator, self.dimensions
        triangles, direct = integrator.surface.triangles, integrator.direct
        accelerator = integrator.surface.accelerator
        assert isinstance(accelerator, PacketAccelerator)
        tables = accelerator.tables
        normals = triangles.corner_normals
        scene = fused_kernels.Scene(
            *(tables.scenes, tables.velocity, tables.boxes, np.zeros(1, np.int64)),
            *(triangles.planes, triangles.edges, triangles.inset),
            _NO_ROWS if normals is None else normals,
            np.empty((0, 3), np.float32) if triangles.bulge is None else triangles.bulge,
            triangles.material,
            np.float32(triangles.largest_sine + ROUNDING),
        )
        specular = None if direct is None else direct.specular
        shaded = None if direct is None else direct.shaded
        diffuse = np.zeros((3, 1 + int(triangles.material.max(initial=0))), np.float32)
        dark = integrator.dark_inside
        materials = fused_kernels.Reflectances(
            diffuse if direct is None else direct.diffuse.rows,
            _rows(specular),
            _NONE if direct is None or specular is None else direct.exponent.rows,
            _NO_MASK if shaded is None else shaded,
            _rows(integrator.ambient),
            np.empty(0, np.bool_) if dark is None else dark,
            _rows(integrator.glow),
            _rows(integrator.emission),
        )
        lights = _lights(() if direct is None else direct.lights, dimensions)
        sky = _NONE
        environment = integrator.environment
        if integrator.environment_depth >= 0 and isinstance(environment, ConstantEnvironment):
            sky = environment.color
        return scene, materials, lights, sky, COHERENT if integrator.coherent_depth >= 0 else 0

    @cached_property
    def _eye(self) -> number_kernels.Eye:
        camera = self.integrator.camera
        near = camera.near if isinstance(camera, NearPlaneCamera) else 0.0
        frame = np.stack(
            (
                *(camera.origin, camera.right, camera.up, camera.forward),
                *(camera.corner, camera.step_x, camera.step_y, _NOWHERE),
            )
        )
        return number_kernels.Eye(frame, np.array((0, 0, near), np.float32), -1, -1, 0)

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
        points, salts = sampler.tables(block, self._pairs)
        x, y = tile.corners()
        pixels = np.ascontiguousarray(block.pixels)
        radiance = np.empty((3, block.size), np.float32)
        weighted = self.reconstruction.sigma is not None
        offsets = np.empty((2, block.size if weighted else 0), np.float32)
        counts = np.zeros(lanes.COUNTS, np.int64)
        fused_kernels.follow(
            number_kernels.Numbers(pixels, x, y, samples, points, salts),
            *(self._eye, *self._tables, radiance, offsets),
            _NONE if costs is None else costs.row,
            np.array((0, 0, 0) if costs is None else costs.prices, np.float32),
            *(counts, *_scratch()),
        )
        self._count(block, counts, counters)
        counters.lap("trace")
        pieces = (-1, tile.size * parts, samples // parts)
        # A box filter doesn't look where samples lie.
        places = offsets.reshape(pieces) if weighted else offsets
        mean, weight = self.reconstruction.pixels(radiance.reshape(pieces), places)
        counters.lap("film")
        return mean if costs is None else costs.with_row(mean, parts), weight

    @cached_property
    def _pairs(self) -> int:
        """Number of pairs of dimensions that are drawn from, at least."""
        dimensions, depth = self.dimensions, self.integrator.max_depth
        ends = [dimensions.first(name, depth) + width for name, width in dimensions.width.items()]
        return (max(ends) + 1) // 2

    def _count(self, block: Block, counts: Any, counters: Counters) -> None:
        counters.embree.seconds += 1e-9 * lamp_kernels.TIMED * int(counts[lanes.NANOSECONDS])
        shadows = int(counts[lanes.SHADOW_RAYS] + counts[lanes.SECOND_RAYS])
        counters.rays.update({"camera": block.size, "shadow": shadows})
        counters.numbers["pixel"] += 2 * block.size
        direct = self.integrator.direct
        for light in () if direct is None else direct.lights:
            if light.width:
                counters.numbers[light.name] += light.width * int(counts[lanes.HITS])
