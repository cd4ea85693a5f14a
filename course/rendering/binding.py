"""A tracer for a scene and the settings of one render, on whatever machine renders it."""

from __future__ import annotations

from course.core.samplers import FUNCTIONS, make_sampler
from course.effects import Bound, Need
from course.imaging.reconstruction import Reconstruction
from course.scene.compiling import compile_camera
from course.scene.scene import Scene
from course.scene.world import Settings
from course.transport.tracing import Tracer, make_tracer

NARROWEST = 1e-6
"""Deviation [pixels] of a Gaussian that sees no sample beside the centre; the function is asked for no less."""


def bind(scene: Scene, settings: Settings, bound: Bound | None = None) -> Tracer:
    """Bind a scene to its settings and to the functions that place and weigh its samples.

    Parameters
    ----------
    bound : where those functions are noted down
    """
    compiled = scene.compiled
    bound = bound or Bound(scene.effects)
    functions = [
        bound.function(*function, ("sampler", "type")) for function in FUNCTIONS[settings.sampler]
    ]
    film = scene.loaded.description.film
    resolve = weights = None
    if settings.samples > 1:
        resolve = bound.function("supersampling", "resolve", ("sampler", "samples"))
    if film.filter == "gaussian":
        weights = bound.function("supersampling", "gaussian_weights", ("film", "filter"))
    reconstruction = Reconstruction(resolve, weights, max(film.sigma, NARROWEST))
    sampler = make_sampler(settings.sampler, settings.seed, *functions)
    if settings.subdivision is not None:
        from course.rendering.corners import CornerSampler

        sampler = CornerSampler(settings.seed)
    kind = Tracer
    if compiled.world.paths is not None:
        from course.transport.path_tracing import PathTracer

        kind = PathTracer
    return make_tracer(
        compiled.world,
        settings,
        compile_camera(scene.loaded, compiled.frame, settings.width, settings.height),
        sampler,
        reconstruction,
        kind,
    )


def needs_of(scene: Scene, settings: Settings) -> tuple[Need, ...]:
    """Every function that rendering with these settings calls, and what asks for it."""
    bound = Bound(scene.effects, scene.compiled.needs)
    bind(scene, settings, bound)
    if settings.subdivision is not None:
        from course.rendering.subdivision import Functions

        Functions(bound, settings.subdivision)
    return bound.needs
