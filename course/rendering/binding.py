"""A tracer for a scene and the settings of one render, on whatever machine renders it."""

from __future__ import annotations

from dataclasses import replace

from course.adaptive.costs import RowOfCosts
from course.building.world import compile_camera
from course.core.film import Reconstruction
from course.core.functions import Functions
from course.core.tracer import Tracer
from course.effects import Bound, Need
from course.extras.path_tracing import PathIntegrator
from course.extras.plan import plan
from course.extras.samplers import FUNCTIONS, make_sampler
from course.scene.scene import Scene
from course.scene.settings import Settings

NARROWEST = 1e-6
"""Deviation [pixels] of a Gaussian that sees no sample beside the centre; the function is asked for no less."""


def bind(
    scene: Scene, settings: Settings, bound: Bound | None = None, compiled: bool = False
) -> Tracer:
    """Bind a scene to its settings and to the functions that place and weigh its samples.

    Parameters
    ----------
    bound : where those functions are noted down
    compiled : whether Numba's loops are used
    """
    world = scene.compiled.world
    bound = bound or Bound(scene.effects)
    functions = [
        bound.function(*function, ("sampler", "type")) for function in FUNCTIONS[settings.sampler]
    ]
    sampler = make_sampler(settings.sampler, settings.seed, *functions)
    if settings.subdivision is not None:
        from course.adaptive.corners import CornerSampler

        sampler = CornerSampler(settings.seed)
    frame = scene.compiled.frame
    camera = compile_camera(scene.loaded, frame, settings.width, settings.height)
    camera = replace(camera, lens=world.lens)
    arrays = settings.max_depth, settings.cutoff, sampler
    integrator, dimensions = plan(world, camera, *arrays)
    tracer = Tracer(
        settings,
        sampler,
        dimensions,
        integrator,
        _reconstruction(scene, settings, bound),
        integrator.pieces if isinstance(integrator, PathIntegrator) else 1,
        None if settings.error is None else RowOfCosts.of,
    )
    if not compiled:
        return tracer
    from course.compiled import stages

    return stages.compiled(tracer)


def _reconstruction(scene: Scene, settings: Settings, bound: Bound) -> Reconstruction:
    film, functions = scene.loaded.description.film, {}
    for name, asked_by, called in (
        ("resolve", ("sampler", "samples"), settings.samples > 1),
        ("gaussian_weights", ("film", "filter"), film.filter == "gaussian"),
    ):
        if called:
            functions[name] = bound.function("supersampling", name, asked_by)
    sigma = max(film.sigma, NARROWEST) if film.filter == "gaussian" else None
    return Reconstruction(Functions(functions), settings.samples == 1, sigma)


def needs_of(scene: Scene, settings: Settings) -> tuple[Need, ...]:
    """Every function that rendering with these settings calls, and what asks for it."""
    bound = Bound(scene.effects, scene.compiled.needs)
    bind(scene, settings, bound)
    if settings.subdivision is not None:
        from course.adaptive import subdivision

        subdivision.Functions(bound, settings.subdivision)
    return bound.needs
