"""Compiled stages in the place of a tracer's, for scenes that the fused loop can't follow."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course.compiled import direct_kernels, draw_kernels
from course.compiled.accelerator import in_packets
from course.compiled.direct import CompiledDirectLight
from course.compiled.environment import compiled_environment
from course.compiled.lamps_and_lobes import compiled_lamps_and_lobes
from course.compiled.light_tree import compiled_choice
from course.compiled.surface import CompiledSurface
from course.core.hits import Surface
from course.core.integrator import Integrator
from course.core.samplers import Block, Sampler
from course.core.tracer import Tracer
from course.core.types import Floats32, Indices
from course.extras.direct import FullDirectLight
from course.extras.environment_sampling import ProductSampling
from course.extras.lamps_and_lobes import CombiningIntegrator
from course.extras.path_tracing import PathIntegrator
from course.extras.plan import same_fields
from course.extras.samplers.sobol import SobolSampler
from course.extras.sky import Sky
from course.extras.surface import FullSurface


def compiled(tracer: Tracer) -> Tracer:
    """The tracer with compiled stages, where there are any."""
    integrator = tracer.integrator
    surface = compiled_surface(integrator.surface)
    environment = compiled_environment(integrator.environment)
    changed: dict[str, Any] = {"surface": surface, "environment": environment}
    if (direct := integrator.direct) is not None:
        known = same_fields(direct) | {"surface": surface}
        if isinstance(direct.sky, Sky):
            seen = {"surface": surface, "environment": compiled_environment(direct.sky.environment)}
            known["sky"] = CompiledSky(**same_fields(direct.sky) | seen)
        if isinstance(direct, FullDirectLight):
            known["choice"] = compiled_choice(direct.choice)
        changed["direct"] = CompiledDirectLight(**known)
    # Loops are compiled when they are imported: a machine's first render waits for those of its scene alone.
    if (scatter := integrator.scatter) is not None:
        from course.compiled.scatter import CompiledScatter

        changed["scatter"] = CompiledScatter(**same_fields(scatter) | {"surface": surface})
    if isinstance(integrator, PathIntegrator):
        from course.compiled.scatter import CompiledPathBounce

        known = {"surface": surface, "scatter": changed.get("scatter")}
        changed["bounce"] = CompiledPathBounce(**same_fields(integrator.bounce) | known)
        cls: type[Integrator] = CompiledPathIntegrator
    elif isinstance(integrator, CombiningIntegrator):
        cls = CompiledCombiningIntegrator
    else:
        cls = CompiledIntegrator
    both = getattr(integrator, "lamps_and_lobes", None)
    if both is not None:
        both = both.seen_by(surface, changed["scatter"])
        changed["lamps_and_lobes"] = compiled_lamps_and_lobes(both)
    integrator = cls(**same_fields(integrator) | changed)
    return replace(tracer, integrator=integrator, sampler=_sampler(tracer.sampler))


def compiled_surface(surface: Surface) -> CompiledSurface:
    """The surface with compiled loops and packets of rays."""
    accelerator = in_packets(surface.accelerator, surface.triangles.parts)
    known = same_fields(surface) | {"accelerator": accelerator}
    if isinstance(surface, FullSurface) and surface.through is not None:
        front = surface.through.accelerator
        same = front is surface.accelerator
        front = accelerator if same else in_packets(front)
        known["through"] = replace(surface.through, accelerator=front)
    return CompiledSurface(**known)


def _sampler(sampler: Sampler) -> Sampler:
    return CompiledSobolSampler(sampler) if type(sampler) is SobolSampler else sampler


class CompiledSobolSampler(SobolSampler):
    """Sobol numbers of some paths by a loop."""

    def __init__(self, sampler: SobolSampler) -> None:
        vars(self).update(vars(sampler))

    def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Floats32:
        """See ``SobolSampler``."""
        if dimension % 2 + width > 2:
            return super().draw_some(block, dimension, width, path)
        points, salts = self.pair(block, dimension // 2)
        u = np.empty((width, len(path)), np.float32)
        draw_kernels.draw(
            *(np.ascontiguousarray(block.pixels), block.samples),
            *(np.ascontiguousarray(path), points, np.array(salts, np.uint64), dimension % 2, u),
        )
        return u


@dataclass(frozen=True)
class CompiledSky(Sky):
    """An environment that lights diffuse surfaces."""

    def directions(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32 | None]:
        """See ``Sky``."""
        from course.compiled import daylight_kernels, sky_kernels

        product = self.sampling
        if not isinstance(product, ProductSampling):
            return super().directions(normal, u)
        direction = np.empty(normal.shape, np.float32)
        weight = np.empty(normal.shape[1], np.float32)
        arrays = map(np.ascontiguousarray, (normal, u))
        sky_kernels.sample(*arrays, daylight_kernels.Product(*product.arrays), direction, weight)
        return direction, weight


class _Adding(Integrator):
    """Adds radiance by a loop."""

    def add_radiance(
        self,
        path_radiance: Floats32,
        path: Indices | None,
        radiance: Floats32,
        throughput: Floats32 | None,
    ) -> None:
        """See ``Integrator``."""
        if path is None or throughput is None:
            super().add_radiance(path_radiance, path, radiance, throughput)
        else:
            direct_kernels.add(
                path_radiance, *map(np.ascontiguousarray, (path, radiance, throughput))
            )


class CompiledIntegrator(_Adding):
    """Follows rays."""


class CompiledCombiningIntegrator(_Adding, CombiningIntegrator):
    """Follows rays, and looks for lamps in glossy surfaces in both ways."""


class CompiledPathIntegrator(_Adding, PathIntegrator):
    """Follows paths to their ends."""
