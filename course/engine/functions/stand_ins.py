"""What stands in for functions that nobody has written yet, where no solutions are: each switches its effect off.

A lamp is a point, what is glossy a mirror, the lens a pinhole. So a student's copy shows a picture from the first
function on, and holds nothing of the solutions: with each function that is written an effect comes in. Shapes are those
of ``course.engine.functions.signatures``.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.engine.functions.further import further_stand_ins

Array = NDArray[Any]


def _still(vectors: Array, *_: Any) -> Array:
    """The first argument, unchanged."""
    return vectors.copy()


def _all(point: Any, like: Array) -> Array:
    """A point (d,) for each column of an array (..., n)."""
    column = np.asarray(point, like.dtype)[:, None]
    return np.repeat(column, like.shape[-1], axis=1)


def _middle(corner: Any, edge_u: Any, edge_v: Any) -> Array:
    middle: Array = np.asarray(corner) + (np.asarray(edge_u) + np.asarray(edge_v)) / 2
    return middle


def _halves(*shape: int) -> Array:
    return np.full(shape, 0.5, np.float32)


def _mean_color(image: Array, like: Array) -> Array:
    """The mean of a picture or of pictures (..., 3), for each column."""
    return _all(image.reshape(-1, 3).mean(axis=0), like)


def _up(u: Array) -> Array:
    return _all((0, 0, 1), u)


def _everywhere(cosines: Array, *_: Any) -> Array:
    """Density of directions that are spread evenly over the hemisphere [1/sr]."""
    return np.full_like(cosines, 1 / (2 * np.pi))


def _evenly_shared(densities: Array) -> Array:
    """Weights (S, N), the same for each strategy that can draw a sample."""
    able = densities > 0
    shared: Array = able / np.maximum(able.sum(axis=0), 1).astype(densities.dtype)
    return shared


def _any_lamp(lamps: Array, u: Array) -> tuple[Array, Array]:
    """Lamps (n,) that are all as probable."""
    chosen = np.minimum((u * len(lamps)).astype(int), len(lamps) - 1)
    return chosen, np.full_like(u, 1 / len(lamps))


def _unsorted(*lamps: Array) -> tuple[Array, ...]:
    """Nodes that bound nothing, and lamps in their order."""
    count = len(lamps[-1])
    nodes = [part[..., :1].repeat(2 * count - 1, axis=-1) for part in lamps]
    return (*nodes, np.arange(count))


def _one_box(lo: Array, hi: Array, _leaf_size: int) -> tuple[Array, ...]:
    boxes = lo.min(axis=1, keepdims=True), hi.max(axis=1, keepdims=True)
    return *boxes, np.zeros(1, np.int64), np.array([lo.shape[1]]), np.arange(lo.shape[1])


_LAST: list[tuple[Array, Any]] = []
"""Triangles' first corners, and the accelerator of these triangles: all rays of a picture ask for the same."""


def _asked_caster(
    _hierarchy: Any, p0: Array, p1: Array, p2: Array, origins: Array, directions: Array
) -> tuple[Array, ...]:
    """What the ray caster finds; no box is tested, and no triangle."""
    from course.engine.casters.choice import static_accelerator
    from course.engine.core.accelerator import QueryStats

    known = next((each for each in _LAST if each[0] is p0), None)
    if known is None:
        corners = np.concatenate((p0, p1, p2), axis=1).T
        numbers = np.arange(len(corners), dtype=np.int32).reshape(3, -1).T
        known = p0, static_accelerator(corners, numbers)
        _LAST[:] = [known]
    rays = origins.astype(np.float32), directions.astype(np.float32)
    found = known[1].intersect(*rays, QueryStats())
    t = np.where(found.triangle < 0, np.inf, found.t).astype(np.result_type(origins, directions))
    none = np.zeros(len(t), np.int32)
    return found.triangle.astype(np.int32), t, none, none


def _kept_light(
    radiosity: Array, unshot: Array, _reflectance: Array, _areas: Array, _f: Array, shooter: int
) -> tuple[Array, Array]:
    """What is shot arrives nowhere."""
    rest = unshot.copy()
    rest[:, shooter] = 0
    return radiosity.copy(), rest


_CENTRE = "samples lie in the pixel's centre, so edges are jagged"
_POINT = "the lamp is a point, so shadows are hard"
_MIRROR = "what is glossy is a mirror"
_PINHOLE = "the lens is a pinhole, so all is in focus"
_FROZEN = "what moves stands still"
_FLAT_SKY = "the environment has its mean colour"
_FLAT = "textures have their mean colour"
_CLEAR = "glass is clear, and what is behind it isn't bent"
_OPEN = "no microfacet hides another"
_SKY = "the environment lights from straight above"
_WHOLE = "no cell is divided"
_ROWS = "pixels take their samples row by row, so errors cancel along rows alone"
_ALIKE = "each lamp is as probable, so the picture is noisy"
_DARK = "surfaces pass no light on, so only lamps are bright"
_UNTESTED = "all neighbours are averaged, whatever their difference"
_PATHS = "paths go on along the normal, and lose half their light"

STAND_INS: dict[str, tuple[Callable[..., Any], str]] = {
    "supersampling.regular": (lambda k, n: _halves(2, n, k * k), _CENTRE),
    "supersampling.random": (lambda k, n, _rng: _halves(2, n, k * k), _CENTRE),
    "supersampling.jittered": (lambda k, n, _rng: _halves(2, n, k * k), _CENTRE),
    "supersampling.gaussian_weights": (
        lambda offsets, _sigma: np.ones_like(offsets[0]),
        "all samples of a pixel count alike",
    ),
    "supersampling.resolve": (
        lambda radiance, _weights: radiance.mean(axis=-1, dtype=radiance.dtype),
        "all samples of a pixel count alike",
    ),
    "soft_shadows.light_grid": (
        lambda corner, edge_u, edge_v, k: np.repeat(
            _middle(corner, edge_u, edge_v)[:, None], k * k, axis=1
        ),
        _POINT,
    ),
    "soft_shadows.point_on_rectangle": (
        lambda corner, edge_u, edge_v, u: _all(_middle(corner, edge_u, edge_v), u),
        _POINT,
    ),
    "soft_shadows.point_on_sphere": (lambda center, _radius, u: _all(center, u), _POINT),
    "soft_shadows.point_in_ball": (lambda center, _radius, u: _all(center, u), _POINT),
    "soft_shadows.point_on_facing_disk": (
        lambda center, _radius, _point, u: _all(center, u),
        _POINT,
    ),
    "glossy.jitter_on_plane": (_still, _MIRROR),
    "glossy.jitter_in_ball": (_still, _MIRROR),
    "glossy.sample_phong_lobe": (_still, _MIRROR),
    "glossy.keep_above": (_still, "rays that fell below the surface are lost"),
    "thin_lens.point_on_disk": (np.zeros_like, _PINHOLE),
    "thin_lens.lens_rays": (
        lambda origin, _right, _up, _forward, directions, _lens_points, _focus_distance: (
            _all(origin, directions),
            directions.copy(),
        ),
        _PINHOLE,
    ),
    "motion_blur.shutter_times": (lambda opened, _close, u: np.full_like(u, opened), _FROZEN),
    "motion_blur.displacement": (
        lambda _velocity, time: np.zeros((3, len(time)), time.dtype),
        _FROZEN,
    ),
    "motion_blur.to_object_space": (_still, _FROZEN),
    "cube_map.lookup": (_mean_color, _FLAT_SKY),
    "cube_map.lookup_seamless": (_mean_color, _FLAT_SKY),
    "sampling.disk_by_rejection": (lambda n, _rng: np.zeros((2, n), np.float32), _PINHOLE),
    "sampling.disk_by_polar": (np.zeros_like, _PINHOLE),
    "sampling.ball_by_rejection": (lambda n, _rng: np.zeros((3, n), np.float32), _POINT),
    "sampling.ball_by_polar": (np.zeros_like, _POINT),
    "sampling.sphere_by_polar": (lambda u: _all((0, 0, 0), u), _POINT),
    "sampling.xorshift32": (lambda state: (state.copy(), _halves(*state.shape)), _CENTRE),
    "importance_sampling.uniform_hemisphere": (_up, _SKY),
    "importance_sampling.cosine_hemisphere": (_up, _SKY),
    "importance_sampling.cosine_hemisphere_pdf": (_everywhere, _SKY),
    "importance_sampling.phong_lobe_pdf": (_everywhere, "highlights weigh as if they were wide"),
    "importance_sampling.power_heuristic": (
        lambda a, _b: np.full_like(a, 0.5),
        "both ways of sampling count alike",
    ),
    "multiple_importance.area_density": (
        lambda _area, distance, _cos: np.zeros_like(distance),
        "glossy surfaces find lamps by their lobes alone",
    ),
    "multiple_importance.cone_density": (
        lambda _radius, distance: np.zeros_like(distance),
        "glossy surfaces find lamps by their lobes alone",
    ),
    "multiple_importance.heuristic_weights": (
        lambda _counts, densities, _exponent: _evenly_shared(densities),
        "points on lamps and rays of lobes count alike",
    ),
    "environment_light.texel_weights": (lambda image: np.ones_like(image[..., 0]), _SKY),
    "environment_light.cumulate": (
        lambda weights: (
            np.linspace(0, 1, len(weights) + 1)[1:],
            np.tile(np.linspace(0, 1, weights.shape[1] + 1)[1:], (len(weights), 1)),
        ),
        _SKY,
    ),
    "environment_light.sample_direction": (lambda _rows, _columns, u: _all((0, 1, 0), u), _SKY),
    "environment_light.density": (
        lambda _weights, direction: np.full(direction.shape[1], 1 / np.pi, direction.dtype),
        _SKY,
    ),
    "environment_light.alias_table": (
        lambda weights: (np.ones(len(weights)), np.arange(len(weights))),
        _SKY,
    ),
    "environment_light.draw_alias": (
        lambda _probability, _alias, u: (np.zeros(len(u), int), np.full_like(u, 0.5)),
        _SKY,
    ),
    "microfacets.sample_visible_normal": (
        lambda wo, _alpha, _u: _all((0, 0, 1), wo),
        "rough metals and glass are smooth",
    ),
    "microfacets.smith_g1": (lambda cos, _alpha: (cos > 0).astype(cos.dtype), _OPEN),
    "microfacets.smith_g2": (
        lambda cos_o, cos_i, _alpha: ((cos_o > 0) & (cos_i > 0)).astype(cos_o.dtype),
        _OPEN,
    ),
    "microfacets.fresnel_complex": (
        lambda cos, _n, _k: np.full((3, len(cos)), 0.5, cos.dtype),
        "rough metals and glass mirror half of the light",
    ),
    "microfacets.visible_normal_pdf": (
        lambda wo, _wm, _alpha: np.ones(wo.shape[1], wo.dtype),
        "rough metals find lamps by points on them alone",
    ),
    "microfacets.brdf": (
        lambda wo, _wi, _alpha, _n, _k: np.zeros_like(wo),
        "rough metals show no light of points on lamps",
    ),
    "blurred_transparency.refract": (
        lambda direction, _normal, _eta: (direction.copy(), np.zeros(direction.shape[1], bool)),
        _CLEAR,
    ),
    "blurred_transparency.jitter_refraction": (_still, _CLEAR),
    "blurred_transparency.fresnel": (
        lambda cos_i, _eta: np.zeros_like(cos_i),
        "glass mirrors nothing",
    ),
    "adaptive_sampling.needs_subdivision": (
        lambda corners, _threshold: np.zeros(corners.shape[2], bool),
        _WHOLE,
    ),
    "adaptive_sampling.subdivide": (
        lambda *sides: tuple(np.repeat(side[None], 4, axis=0) for side in sides),
        _WHOLE,
    ),
    "textures.rectangle_uv": (lambda p, _p1, _p2, _p3: _all((0.5, 0.5), p), _FLAT),
    "textures.sphere_uv": (lambda p, _center: _all((0.5, 0.5), p), _FLAT),
    "textures.triangle_uv": (lambda barycentric, *_uv: _all((0.5, 0.5), barycentric), _FLAT),
    "textures.texture_lookup": (_mean_color, _FLAT),
    "quasi_monte_carlo.halton": (lambda i, dims: _halves(dims, len(i)), _CENTRE),
    "quasi_monte_carlo.hammersley": (lambda n, dims: _halves(dims, n), _CENTRE),
    "quasi_monte_carlo.chain": (
        lambda patterns, ids, _rng: [p[:, ids % p.shape[1]] for p in patterns],
        "patterns are chained without a permutation",
    ),
    "blue_noise.shuffled_z_order": (
        lambda x, y, levels, _seed: np.bitwise_left_shift(y, levels) + x,
        _ROWS,
    ),
    "blue_noise.void_and_cluster": (
        lambda u, _sigma: np.arange(u.size).reshape(u.shape),
        "the mask is a ramp, row by row",
    ),
    "blue_noise.dithered_points": (
        lambda points, _masks, x, _y: np.repeat(points[:, None], len(x), axis=1),
        "all pixels have the same points",
    ),
    "many_lights.power_choice": (_any_lamp, _ALIKE),
    "many_lights.light_tree": (_unsorted, _ALIKE),
    "many_lights.tree_choice": (lambda tree, _p, _n, u: _any_lamp(tree[5], u), _ALIKE),
    "path_tracing.diffuse_bounce": (lambda normal, _u: normal.copy(), _PATHS),
    "path_tracing.throughput": (lambda beta, _albedo: beta / 2, _PATHS),
    "path_tracing.russian_roulette": (
        lambda beta, u: (np.ones(len(u), bool), beta.copy()),
        "all paths go on to the greatest depth",
    ),
    "bounding_volumes.build": (_one_box, "all triangles lie in one box, so rays take long"),
    "bounding_volumes.traverse": (_asked_caster, "Embree answers the rays, without your boxes"),
    "radiosity.hemicube_form_factors": (
        lambda k: tuple(
            np.full(shape, 1 / (3 * k * k), np.float32) for shape in ((k, k), (k // 2, k))
        ),
        "light leaves a patch evenly through all of its hemicube",
    ),
    "radiosity.gather": (lambda _radiosity, emission, *_: emission.copy(), _DARK),
    "radiosity.shoot": (_kept_light, _DARK),
    "radiosity.needs_split": (
        lambda patch_radiosity, _threshold: np.zeros(patch_radiosity.shape[2], bool),
        "no patch is divided",
    ),
    "denoising.welch_t": (lambda mean_a, *_: np.zeros_like(mean_a), _UNTESTED),
    "denoising.degrees_of_freedom": (lambda variance_a, *_: np.full_like(variance_a, 2), _UNTESTED),
    "denoising.critical_value": (lambda degrees, _level: np.full_like(degrees, 2), _UNTESTED),
    "denoising.pair_weights": (
        lambda _t, _critical, distance, _sigma: (distance == 0).astype(distance.dtype),
        "the preview is as noisy as the picture",
    ),
    "denoising.weighted_mean": (
        lambda means, variances, _weights: (means[..., 0].copy(), variances[..., 0].copy()),
        "the preview is as noisy as the picture",
    ),
    "denoising.squared_bias": (
        lambda filtered, *_: np.zeros_like(filtered),
        "no bias is estimated",
    ),
    "film.expose": (_still, "the exposure is left out"),
    "film.photographic": (_still, "what is brighter than white is cut off"),
    "film.convert_gamut": (_still, "colours of a wide gamut look pale"),
    "film.encode_srgb": (lambda linear: linear.clip(0, 1), "the picture is too dark"),
    "film.quantize": (
        lambda encoded, _u: np.round(255 * encoded.clip(0, 1)).astype(np.uint8),
        "codes are not dithered, so that smooth shades have steps",
    ),
}
STAND_INS |= further_stand_ins()
"""By "module.function": what stands in for it, and what a picture then looks like."""
