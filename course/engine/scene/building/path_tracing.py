"""Path tracing and the hierarchy of the bounding_volumes module, where the scene asks for them."""

from collections.abc import Iterable, Iterator

import numpy as np

from course.engine.core.materials import MaterialTable
from course.engine.core.types import Functions
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.document import KeyPath, spell
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.motion import Shutter
from course.engine.scene.building.sampled_points import takes_rejection
from course.engine.terms.world import Paths


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


FUNCTIONS = ("build", "traverse")
"""The functions of bounding_volumes that are called."""


def compile_acceleration(
    loaded: Loaded, shutter: Shutter, bound: Bound
) -> tuple[Functions, int] | None:
    """The module's functions and the size of a leaf; None where Embree answers, and then nothing of it is imported.

    Raises SceneError: something that rays meet moves while the shutter is open; names the key.
    """
    scene = loaded.description
    if scene.acceleration.type == "embree":
        return None
    for path, motion in _motions(scene):
        if shutter.moves(motion):
            raise loaded.document.error(
                ("acceleration", "type"),
                f"a hierarchy holds what stands still, and {spell(path)} moves while the shutter is open;"
                " leave its motion out, or take embree",
            )
    asked_by = ("acceleration", "type")
    functions = bound.functions("bounding_volumes", *FUNCTIONS, asked_by=asked_by)
    return functions, scene.acceleration.leaf_size


def _motions(scene: d.SceneDescription) -> Iterator[tuple[KeyPath, d.MotionDescription]]:
    """Motions of all surfaces: those of objects, and those of lights."""
    for number, thing in enumerate(scene.objects):
        yield ("objects", number), thing.motion
    for number, light in enumerate(scene.lights):
        if isinstance(light, d.RectangleLight | d.SphereLight) and light.radiance is not None:
            yield ("lights", number), light.motion
