"""A tracer for a scene and the settings of one render, on whatever machine renders it."""

from __future__ import annotations

from course.core.samplers import FUNCTIONS, make_sampler
from course.imaging.reconstruction import Reconstruction
from course.rendering.corners import CornerSampler
from course.scene.compiling import compile_camera
from course.scene.scene import Scene
from course.scene.world import Settings
from course.transport.tracing import Tracer, make_tracer

NARROWEST = 1e-6
"""Deviation [pixels] of a Gaussian that sees no sample beside the centre; the function is asked for no less."""


def bind(scene: Scene, settings: Settings) -> Tracer:
    """Bind a scene to its settings and to the functions that place and weigh its samples."""
    effects = scene.effects
    functions = [effects.function(*function) for function in FUNCTIONS[settings.sampler]]
    film = scene.loaded.description.film
    reconstruction = Reconstruction(
        effects.function("supersampling", "resolve") if settings.samples > 1 else None,
        effects.function("supersampling", "gaussian_weights")
        if film.filter == "gaussian"
        else None,
        max(film.sigma, NARROWEST),
    )
    compiled = scene.compiled
    sampler = make_sampler(settings.sampler, settings.seed, *functions)
    if settings.subdivision is not None:
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
