"""Every module of the course, and the functions that students write in it."""

from collections.abc import Iterable
from difflib import get_close_matches

from course.engine.functions.further import with_further


def _named(functions: dict[str, str]) -> dict[str, tuple[str, ...]]:
    return {module: tuple(names.split()) for module, names in functions.items()}


MODULES = _named(
    {
        "supersampling": "regular random jittered gaussian_weights resolve",
        "soft_shadows": "light_grid point_on_rectangle point_on_sphere point_in_ball point_on_facing_disk",
        "glossy": "orthonormal_basis jitter_on_plane jitter_in_ball sample_phong_lobe keep_above",
        "thin_lens": "point_on_disk lens_rays image_distance circle_of_confusion",
        "motion_blur": "shutter_times displacement to_object_space",
        "cube_map": "face_and_uv lookup lookup_seamless",
    }
)
"""The six core modules and their functions, in the course's order."""

FURTHER = _named(
    {
        "sampling": "disk_by_rejection disk_by_polar ball_by_rejection ball_by_polar sphere_by_polar xorshift32",
        "importance_sampling": "uniform_hemisphere cosine_hemisphere cosine_hemisphere_pdf phong_lobe_pdf estimate"
        " power_heuristic",
        "multiple_importance": "area_density cone_density heuristic_weights delta_weights multi_sample one_sample",
        "environment_light": "texel_weights cumulate sample_direction density alias_table draw_alias",
        "microfacets": "ggx smith_g1 smith_g2 sample_visible_normal visible_normal_pdf fresnel_complex brdf",
        "blurred_transparency": "refract jitter_refraction fresnel",
        "adaptive_sampling": "needs_subdivision subdivide",
        "textures": "rectangle_uv sphere_uv triangle_uv texture_lookup",
        "bounding_volumes": "slab_test build traverse",
        "quasi_monte_carlo": "radical_inverse halton hammersley chain",
        "blue_noise": "z_order shuffled_z_order void_and_cluster dithered_points radial_spectrum perceptual_rmse",
        "many_lights": "power_choice merge_cones light_tree importance tree_choice tree_probability",
        "path_tracing": "diffuse_bounce throughput russian_roulette",
        "radiosity": "hemicube_form_factors gather shoot needs_split",
        "denoising": "welch_t degrees_of_freedom critical_value pair_weights weighted_mean squared_bias",
        "film": "expose luminance photographic encode_srgb convert_gamut quantize",
    }
)
FURTHER = with_further(FURTHER)
"""The other modules, those with a file of their own in ``further/`` among them. The renderer calls the functions of
both that are listed in ``signatures``."""

COURSE = MODULES | FURTHER
"""All modules of the course."""

WARM_UP = "sampling"
"""The module to begin with."""

TAUGHT = {WARM_UP: COURSE[WARM_UP]} | COURSE
"""The same in the order in which they are taught."""

ALIKE = 0.75
"""How alike two names must be for one to be meant by the other; from 0 to 1, by difflib."""


def meant(name: str, others: Iterable[str]) -> str:
    """Which of the other names may be meant by this one; empty for none."""
    return next(iter(get_close_matches(name, list(others), 1, ALIKE)), "")
