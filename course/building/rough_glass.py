"""From dielectrics with a roughness to rough glass."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from course.building.gloss import FLAT
from course.core.gloss import Lobe
from course.effects import Bound
from course.extras.rough_glass import RoughGlass
from course.formats.yaml import description as d

FUNCTIONS = ("refract", "fresnel", "jitter_refraction")
"""What rough glass calls of the blurred_transparency module."""


def is_rough(material: d.MaterialDescription) -> bool:
    """Whether a material is rough glass."""
    return material.dielectric is not None and material.dielectric.roughness > 0


def reflecting(material: d.MaterialDescription) -> d.MaterialDescription:
    """The material as its gloss sees it: rough glass mirrors, whatever its ``mirror`` says."""
    return msgspec.structs.replace(material, mirror=1.0) if is_rough(material) else material


def compile_rough_glass(
    materials: Sequence[tuple[str, d.MaterialDescription]],
    lobes: Sequence[Lobe],
    bound: Bound,
    integrator: d.IntegratorDescription,
) -> tuple[RoughGlass, ...]:
    """The rough glasses; none where the depth allows no refraction.

    Parameters
    ----------
    lobes : of the glossy materials
    """
    if integrator.max_depth == 0:
        return ()
    glossy = {lobe.material for lobe in lobes}
    found = []
    for number, (which, material) in enumerate(materials):
        if material.dielectric is None or not is_rough(material):
            continue
        asked_by = ("materials", which, "dielectric", "roughness")
        functions = bound.functions("blurred_transparency", *FUNCTIONS, asked_by=asked_by)
        roughness = min(material.dielectric.roughness, FLAT)
        found.append(RoughGlass(number, roughness, number in glossy, functions))
    return tuple(found)
