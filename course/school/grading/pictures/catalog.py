"""Which functions are judged by a picture, and in which scene."""

from functools import partial

import numpy as np

from course.engine.functions.modules import COURSE
from course.school.grading.checks.check import Check
from course.school.grading.pictures import scenes
from course.school.grading.pictures.rays import rays_check
from course.school.grading.pictures.rendered import MakeScene, picture_checks


def _gaussian(rng: np.random.Generator) -> scenes.Scene:
    sigma = float(rng.uniform(0.15, 0.35))
    return scenes.edges(rng, "sobol", 64, filter="gaussian", sigma=sigma)


def _area_light(per_pixel: int = 64, **keys: str) -> MakeScene:
    return lambda rng: scenes.shadows(rng, scenes.area_light(rng, **keys), per_pixel)


def _ball_light(method: str) -> MakeScene:
    return lambda rng: scenes.shadows(rng, scenes.ball_light(rng, method))


def _large_ball(method: str) -> MakeScene:
    return lambda rng: scenes.shadows(rng, scenes.large_ball_light(rng, method), 256)


def _gloss(lobe: str, size: str, low: float, high: float, samples: int = 64) -> MakeScene:
    """A glossy floor; the lobe's size is drawn from that range."""
    return lambda rng: scenes.reflections(
        rng, {"lobe": lobe, size: float(rng.uniform(low, high))}, samples
    )


SCENES: dict[str, MakeScene] = {
    "supersampling.regular": scenes.edges,
    "supersampling.random": partial(scenes.edges, sampler="random", samples=64),
    "supersampling.jittered": partial(scenes.edges, sampler="jittered", samples=64),
    "supersampling.gaussian_weights": _gaussian,
    "supersampling.resolve": _gaussian,
    "soft_shadows.light_grid": _area_light(4, samples="grid 6"),
    "soft_shadows.point_on_rectangle": _area_light(),
    "soft_shadows.point_on_sphere": _ball_light("sphere"),
    "soft_shadows.point_in_ball": _ball_light("ball"),
    "soft_shadows.point_on_facing_disk": _ball_light("facing disk"),
    "glossy.jitter_on_plane": _gloss("plane", "roughness", 0.3, 0.5),
    "glossy.jitter_in_ball": _gloss("ball", "glossiness", 0.2, 0.35),
    "glossy.sample_phong_lobe": _gloss("phong", "exponent", 40, 90),
    "glossy.keep_above": _gloss("plane", "roughness", 1.8, 2.4, samples=16),
    "thin_lens.lens_rays": scenes.out_of_focus,
    "motion_blur.shutter_times": scenes.moving,
    "motion_blur.displacement": partial(scenes.moving, lit=True),
    "motion_blur.to_object_space": scenes.moving,
    "cube_map.lookup": partial(scenes.surroundings, lookup="clamped"),
    "cube_map.lookup_seamless": partial(scenes.surroundings, lookup="seamless"),
    "sampling.ball_by_rejection": _large_ball("ball by rejection"),
    "sampling.ball_by_polar": _large_ball("ball by polar"),
    "sampling.sphere_by_polar": _large_ball("sphere by polar"),
    "adaptive_sampling.needs_subdivision": scenes.cells,
    "adaptive_sampling.subdivide": scenes.cells,
    "textures.rectangle_uv": partial(scenes.painted, shape="quad"),
    "textures.sphere_uv": partial(scenes.painted, shape="sphere"),
    "textures.triangle_uv": partial(scenes.painted, shape="mesh"),
    "path_tracing.diffuse_bounce": scenes.glowing,
    "blurred_transparency.refract": partial(scenes.under_water, view="below"),
    "blurred_transparency.jitter_refraction": partial(scenes.under_water, view="above", samples=64),
    "blurred_transparency.fresnel": partial(scenes.under_water, view="flat"),
}
"""By function, "module.function"."""

PICTURES: dict[str, tuple[Check, ...]] = {
    module: tuple(
        check
        for path, make in SCENES.items()
        if path.startswith(f"{module}.")
        for check in picture_checks(path, make)
    )
    for module in COURSE
}
"""By module; each check's pictures run after the function's other checks."""

UNTOLD = ("adaptive_sampling",)
"""Modules whose pictures have pixels that share their samples, so that none has rays of its own."""

RAYS: dict[str, dict[str, Check]] = {
    module: {
        path.partition(".")[2]: rays_check(path, make)
        for path, make in SCENES.items()
        if path.startswith(f"{module}.") and module not in UNTOLD
    }
    for module in COURSE
}
"""By module and function; what shows the rays behind a wrong picture."""
