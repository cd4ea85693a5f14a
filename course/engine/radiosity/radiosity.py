"""From a scene to its radiosity solution."""

from typing import Literal

import numpy as np

from course.engine.core.types import Mask
from course.engine.radiosity.accepting import check_accepted
from course.engine.radiosity.corners import at_corners
from course.engine.radiosity.patches import Patches, RadiosityFunctions, make_patches
from course.engine.radiosity.solving import GATHERED, Report, Shooting, Solved, gathered
from course.engine.radiosity.viewing import Solution
from course.engine.scene.building.materials import base_color
from course.engine.scene.scene import Scene

FINEST = 1e-3
"""Steps of the contrast from which patches are divided, where not all can be."""

Method = Literal["auto", "gather", "shoot"]

PATCHES = 10_000
TOLERANCE = 0.01

ROUNDS = 4
"""Solutions that hierarchical subdivision makes at most before the last."""

ROUGH = 0.3
"""Largest distance from convergence of a solution that only decides where to divide."""


def solve(
    scene: Scene,
    patches: int = PATCHES,
    tolerance: float = TOLERANCE,
    iterations: int | None = None,
    method: Method = "auto",
    split: float | None = None,
    report: Report | None = None,
) -> Solution:
    """Work out the light on all surfaces of a scene.

    Parameters
    ----------
    patches : triangles to divide the surfaces into; those of the meshes where they are more
    tolerance : end where the radiosities are this near to their limit, as a share of all light
    iterations : end after so many iterations, or patches that have shot, whichever comes first
    method : "gather" keeps all form factors, "shoot" none; "auto" gathers up to GATHERED triangles
    split : begin with a fourth of the patches, and divide those over which the light's contrast is more than this,
        the most contrast first, until there are about ``patches``; None divides evenly
    report : called with the share done, for a progress bar

    Raises
    ------
    SceneError
        The scene is none for radiosity; names file, line, key path and the remedy.
    EffectError
        A function of the radiosity module is missing or returns what it must not.
    """
    check_accepted(scene.loaded)
    if iterations is None:
        _check_absorbs(scene)
    functions = RadiosityFunctions(scene.effects)
    divided = make_patches(scene, patches if split is None else max(patches // 4, 1))
    if split is not None:
        for left in range(ROUNDS, 0, -1):
            rough = solve_patches(divided, functions, ROUGH, None, method)
            # Half of those that are halved take a neighbour with them.
            room = (patches - divided.size) // (2 * left)
            chosen = chosen_patches(divided, rough, functions, split, room)
            if not chosen.any():
                break
            divided = divided.split(chosen)
    solved = solve_patches(divided, functions, tolerance, iterations, method, report)
    return as_solution(scene, divided, solved)


def _check_absorbs(scene: Scene) -> None:
    """Refuse surfaces that reflect everything: there is no telling how far their light is from its limit."""
    description = scene.loaded.description
    for thing in description.objects:
        material = description.materials[thing.material]
        if (base_color(material) * material.diffuse).max() >= 1:
            raise scene.loaded.document.error(
                ("materials", thing.material),
                "reflects all light of a channel, which never comes to an end: expected a color below 1, "
                "or a number of iterations",
            )


def solve_patches(
    patches: Patches,
    functions: RadiosityFunctions,
    tolerance: float,
    iterations: int | None,
    method: Method = "auto",
    report: Report | None = None,
) -> Solved:
    """The radiosities of given patches, by the method that is asked for or suits their number."""
    if method == "gather" or (method == "auto" and patches.size <= GATHERED):
        return gathered(patches, functions, tolerance, iterations, report)
    shooting = Shooting(patches, functions)
    shooting.run(tolerance, iterations, report)
    return shooting.solved


def as_solution(scene: Scene, patches: Patches, solved: Solved) -> Solution:
    """A solution: it can be saved, and viewed from anywhere."""
    description, frame = scene.loaded.description, scene.compiled.frame
    camera = description.camera
    return Solution(
        vertices=patches.triangles.vertices.astype(np.float32),
        triangles=patches.triangles.corners.astype(np.int32),
        corners=at_corners(patches, solved.radiosity),
        radiosity=solved.radiosity,
        center=np.asarray(frame.center, np.float64),
        scale=np.array([frame.scale]),
        camera=np.array([*camera.eye, *camera.look_at, *camera.up, camera.vertical_fov]),
        size=np.array([description.film.width, description.film.height]),
        steps=np.array([solved.steps]),
        left=np.array([solved.left]),
    )


def chosen_patches(
    patches: Patches, solved: Solved, functions: RadiosityFunctions, split: float, room: int
) -> Mask:
    """(T,) which triangles to divide, at most so many: where the light changes by more than split, or still more."""
    corners = at_corners(patches, solved.radiosity)

    def over(threshold: float) -> Mask:
        uneven: Mask = functions.needs_split(corners, threshold)
        return (uneven[: patches.size] | uneven[patches.size :]) & ~patches.lamps

    chosen = over(split)
    low, high = split, 1.0
    while chosen.sum() > room and high - low > FINEST:
        middle = (low + high) / 2
        chosen = over(middle)
        low, high = (middle, high) if chosen.sum() > room else (low, middle)
    return over(high) if chosen.sum() > room else chosen
