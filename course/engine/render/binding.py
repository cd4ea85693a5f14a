"""A tracer for a scene and the settings of one render; the functions that it needs, and modules that it skips."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from course.engine.core.film import Reconstruction
from course.engine.core.tracer import Tracer
from course.engine.core.types import Functions
from course.engine.formats.yaml import description as d
from course.engine.functions.effects import Bound, Need
from course.engine.render.adaptive.costs import RowOfCosts
from course.engine.scene.building.cameras import compile_camera
from course.engine.scene.scene import Scene, SceneSettings
from course.engine.terms.paths.path_tracing import PathIntegrator
from course.engine.terms.plan import plan
from course.engine.terms.samplers import FUNCTIONS, make_sampler
from course.engine.terms.surfaces.surface import FullSurface

NARROWEST = 1e-6
"""Deviation [pixels] of a Gaussian that sees no sample beside the centre; the function is asked for no less."""


def bind(
    scene: Scene, settings: SceneSettings, bound: Bound | None = None, compiled: bool = False
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
    size = settings.width, settings.height
    sampler = make_sampler(settings.sampler, settings.seed, *functions, size=size)
    if settings.subdivision is not None:
        from course.engine.render.adaptive.corners import CornerSampler

        sampler = CornerSampler(settings.seed)
    frame = scene.compiled.frame
    camera = compile_camera(scene.loaded, frame, settings.width, settings.height)
    camera = replace(camera, lens=world.lens)
    shown: Any = world.environment
    if hasattr(shown, "before"):
        shown = shown.before(camera, settings.width, settings.height)
        world = replace(world, environment=shown)
    if isinstance(world.surface, FullSurface):
        world = replace(world, surface=world.surface.seen_by(camera))
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
    from course.engine.loops import engine

    return engine.compiled(tracer, settings.shafts)


def _reconstruction(scene: Scene, settings: SceneSettings, bound: Bound) -> Reconstruction:
    film, functions = scene.loaded.description.film, {}
    for name, asked_by, called in (
        ("resolve", ("sampler", "samples"), settings.samples > 1),
        ("gaussian_weights", ("film", "filter"), film.filter == "gaussian"),
    ):
        if called:
            functions[name] = bound.function("supersampling", name, asked_by)
    sigma = max(film.sigma, NARROWEST) if film.filter == "gaussian" else None
    return Reconstruction(Functions(**functions), settings.samples == 1, sigma)


def developed_by(scene: Scene) -> dict[str, str]:
    """The functions of `film` that a scene asks for, and the key of its film that does; empty for most."""
    film = scene.loaded.description.film
    asked = {
        "expose": "exposure" if film.exposure else "",
        "convert_gamut": "gamut" if film.gamut != "srgb" else "",
        "photographic": "tone" if film.tone else "",
        "quantize": "dither" if film.dither else "",
    }
    found = {name: key for name, key in asked.items() if key}
    if found and film.encoding == "srgb" and not (film.tone and film.tone.gamma):
        found["encode_srgb"] = next(iter(found.values()))
    return found


def needs_of(scene: Scene, settings: SceneSettings) -> tuple[Need, ...]:
    """Every function that rendering with these settings calls, and what asks for it."""
    bound = Bound(scene.effects, scene.compiled.needs)
    bind(scene, settings, bound)
    if settings.subdivision is not None:
        from course.engine.render.adaptive import subdivision

        subdivision.SubdivisionFunctions(bound, settings.subdivision)
    if settings.denoise is not None:
        from course.engine.terms import denoising

        denoising.functions(bound)
    for name, key in developed_by(scene).items():
        bound.function("film", name, ("film", key))
    return bound.needs


_REASONS = {
    "supersampling": "one sample a pixel needs no mean, and this sampler none of its patterns",
    "soft_shadows": "no light takes its points on a rectangle or in a ball",
    "glossy": "no mirror is glossy by its functions",
    "thin_lens": "the aperture is 0",
    "motion_blur": "nothing moves while the shutter is open",
    "cube_map": "the environment is no picture, or a black one",
    "blurred_transparency": "no glass is rough",
    "microfacets": "no metal is rough, and no glass by microfacets",
    "textures": "no surface shows a texture",
    "bounding_volumes": "Embree answers the rays",
    "environment_light": "no directions towards an environment are chosen by its picture",
    "multiple_importance": "no lamp and no lobe are sampled together",
    "importance_sampling": "no directions towards an environment are chosen by its functions",
    "blue_noise": "samples of neighbouring pixels know nothing of each other",
    "many_lights": "no light is chosen by a tree",
    "denoising": "the film asks for no denoised preview",
    "film": "the film asks for no exposure, gamut, tone mapping or dithering",
}


def skipped_modules(needs: Iterable[Need], integrator: d.IntegratorDescription) -> dict[str, str]:
    """Modules that are never imported for this scene, each with the reason."""
    used = {need.function.partition(".")[0] for need in needs}
    reasons = {module: reason for module, reason in _REASONS.items() if module not in used}
    if "path_tracing" not in used:
        reasons["path_tracing"] = (
            "no path goes on from a diffuse surface"
            if integrator.type == "path"
            else "the integrator is the distribution ray tracer"
        )
    return reasons
