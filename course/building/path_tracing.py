"""What path tracing needs, where the scene asks for it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from course.building.sampled_points import takes_rejection
from course.core.materials import MaterialTable
from course.effects import Bound
from course.extras.world import Paths
from course.formats.yaml import description as d


def path_functions(
    integrator: d.IntegratorDescription, max_depth: int, materials: MaterialTable
) -> list[str]:
    """Names of the path_tracing functions that are called."""
    if integrator.type != "path" or max_depth == 0 or not materials.diffuses.any():
        return []
    names = ["throughput", "diffuse_bounce"]
    if integrator.roulette is not None and integrator.roulette < max_depth:
        names.append("russian_roulette")
    return names


def compile_paths(
    scene: d.SceneDescription, bound: Bound, materials: MaterialTable, objects: Iterable[int]
) -> Paths | None:
    """The functions of the path_tracing module; None where the integrator is another.

    ``objects``: materials of the objects that are lights.
    """
    integrator = scene.integrator
    if integrator.type != "path":
        return None
    names = path_functions(integrator, integrator.max_depth, materials)
    path_tracing = None
    if names:
        path_tracing = bound.functions("path_tracing", *names, asked_by=("integrator", "type"))
    none = np.zeros(materials.emission.shape[1], np.bool_)
    lit = none.copy()
    lit[list(objects)] = True
    return Paths(
        integrator.roulette,
        none if materials.lamps is None else materials.lamps,
        lit,
        path_tracing,
        not takes_rejection(scene),
    )
