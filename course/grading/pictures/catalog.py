"""Which functions are judged by a picture, and in which scene."""

from __future__ import annotations

from course.grading.checks.check import Check
from course.grading.pictures import scenes
from course.grading.pictures.rendered import picture_checks

PICTURES: dict[str, tuple[Check, ...]] = {
    "supersampling": (
        *picture_checks("supersampling", "regular", scenes.edges, noisy=False),
        *picture_checks(
            "supersampling", "random", lambda rng: scenes.edges(rng, "random", 64), noisy=True
        ),
        *picture_checks(
            "supersampling", "jittered", lambda rng: scenes.edges(rng, "jittered", 64), noisy=True
        ),
        *picture_checks(
            "supersampling",
            "gaussian_weights",
            lambda rng: scenes.edges(
                rng, "sobol", 64, filter="gaussian", sigma=float(rng.uniform(0.15, 0.35))
            ),
            noisy=False,
        ),
        *picture_checks(
            "supersampling",
            "resolve",
            lambda rng: scenes.edges(
                rng, "sobol", 64, filter="gaussian", sigma=float(rng.uniform(0.15, 0.35))
            ),
            noisy=False,
        ),
    ),
    "soft_shadows": (
        *picture_checks(
            "soft_shadows",
            "light_grid",
            lambda rng: scenes.shadows(rng, scenes.area_light(rng, samples="grid 6"), samples=4),
            noisy=False,
        ),
        *picture_checks(
            "soft_shadows",
            "point_on_rectangle",
            lambda rng: scenes.shadows(rng, scenes.area_light(rng)),
            noisy=True,
        ),
        *(
            check
            for function, method in (
                ("point_on_sphere", "sphere"),
                ("point_in_ball", "ball"),
                ("point_on_facing_disk", "facing disk"),
            )
            for check in picture_checks(
                "soft_shadows",
                function,
                lambda rng, method=method: scenes.shadows(rng, scenes.ball_light(rng, method)),  # type: ignore[misc]
                noisy=True,
            )
        ),
    ),
    "glossy": (
        *picture_checks(
            "glossy",
            "jitter_on_plane",
            lambda rng: scenes.reflections(
                rng, {"lobe": "plane", "roughness": float(rng.uniform(0.3, 0.5))}
            ),
            noisy=True,
        ),
        *picture_checks(
            "glossy",
            "jitter_in_ball",
            lambda rng: scenes.reflections(
                rng, {"lobe": "ball", "glossiness": float(rng.uniform(0.2, 0.35))}
            ),
            noisy=True,
        ),
        *picture_checks(
            "glossy",
            "sample_phong_lobe",
            lambda rng: scenes.reflections(
                rng, {"lobe": "phong", "exponent": float(rng.uniform(40, 90))}
            ),
            noisy=True,
        ),
        *picture_checks(
            "glossy",
            "keep_above",
            lambda rng: scenes.reflections(
                rng, {"lobe": "plane", "roughness": float(rng.uniform(1.8, 2.4))}, samples=16
            ),
            noisy=False,
        ),
    ),
    "thin_lens": picture_checks("thin_lens", "lens_rays", scenes.out_of_focus, noisy=False),
    "motion_blur": (
        *picture_checks("motion_blur", "shutter_times", scenes.moving, noisy=True),
        *picture_checks(
            "motion_blur", "displacement", lambda rng: scenes.moving(rng, lit=True), noisy=False
        ),
        *picture_checks("motion_blur", "to_object_space", scenes.moving, noisy=False),
    ),
    "cube_map": (
        *picture_checks(
            "cube_map", "lookup", lambda rng: scenes.surroundings(rng, "clamped"), noisy=False
        ),
        *picture_checks(
            "cube_map",
            "lookup_seamless",
            lambda rng: scenes.surroundings(rng, "seamless"),
            noisy=False,
        ),
    ),
    "sampling": tuple(
        check
        for way in ("ball by rejection", "ball by polar", "sphere by polar")
        for check in picture_checks(
            "sampling",
            way.replace(" ", "_"),
            lambda rng, way=way: scenes.shadows(rng, scenes.large_ball_light(rng, way), 256),  # type: ignore[misc]
            noisy=True,
        )
    ),
    "adaptive_sampling": (
        *picture_checks("adaptive_sampling", "needs_subdivision", scenes.cells, noisy=False),
        *picture_checks("adaptive_sampling", "subdivide", scenes.cells, noisy=False),
    ),
    "textures": tuple(
        check
        for function, shape in (
            ("rectangle_uv", "quad"),
            ("sphere_uv", "sphere"),
            ("triangle_uv", "mesh"),
        )
        for check in picture_checks(
            "textures",
            function,
            lambda rng, shape=shape: scenes.painted(rng, shape),  # type: ignore[misc]
            noisy=False,
        )
    ),
    "path_tracing": picture_checks("path_tracing", "diffuse_bounce", scenes.glowing, noisy=True),
    "blurred_transparency": (
        *picture_checks(
            "blurred_transparency",
            "refract",
            lambda rng: scenes.under_water(rng, "below"),
            noisy=False,
        ),
        *picture_checks(
            "blurred_transparency",
            "jitter_refraction",
            lambda rng: scenes.under_water(rng, "above", 64),
            noisy=True,
        ),
        *picture_checks(
            "blurred_transparency",
            "fresnel",
            lambda rng: scenes.under_water(rng, "flat"),
            noisy=False,
        ),
    ),
}
"""By module, in the order in which they run after the module's other checks."""
