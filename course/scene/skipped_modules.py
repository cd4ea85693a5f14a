"""Modules of the course that a scene doesn't use, each with the reason."""

from __future__ import annotations

from collections.abc import Iterable

from course.effects import Need
from course.formats.yaml import description as d

_REASONS = {
    "supersampling": "one sample a pixel needs no mean, and this sampler none of its patterns",
    "soft_shadows": "no light takes its points on a rectangle or in a ball",
    "glossy": "no mirror is glossy by its functions",
    "thin_lens": "the aperture is 0",
    "motion_blur": "nothing moves while the shutter is open",
    "cube_map": "the environment is no picture, or a black one",
    "blurred_transparency": "no glass is rough",
    "textures": "no surface shows a texture",
    "bounding_volumes": "Embree answers the rays",
    "importance_sampling": "no directions towards an environment are chosen by its functions",
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
