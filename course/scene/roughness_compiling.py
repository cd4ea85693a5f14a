"""From dielectrics with a roughness to lobes about the refracted direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

import msgspec

from course.appearance.lobes import Lobe
from course.appearance.rough_glass import RoughGlass
from course.effects import Bound
from course.scene import description as d
from course.scene.lobe_compiling import FLAT, as_it_is

FUNCTIONS = ("refract", "fresnel", "jitter_refraction")
"""What rough glass calls of the blurred_transparency module."""


def is_rough(material: d.MaterialDescription) -> bool:
    """Whether a material is rough glass."""
    return material.dielectric is not None and material.dielectric.roughness > 0


def reflecting(material: d.MaterialDescription) -> d.MaterialDescription:
    """The material as its gloss sees it: rough glass mirrors, whatever its ``mirror`` says."""
    return msgspec.structs.replace(material, mirror=1.0) if is_rough(material) else material


def with_rough_glass(
    lobes: tuple[Lobe, ...],
    materials: Sequence[tuple[str, d.MaterialDescription]],
    bound: Bound,
    integrator: d.IntegratorDescription,
) -> tuple[Lobe, ...]:
    """Lobes of glossy materials, with those of rough glass; none where the depth allows no refraction."""
    if integrator.max_depth == 0:
        return lobes
    found = {lobe.material: lobe for lobe in lobes}
    for number, (which, material) in enumerate(materials):
        if material.dielectric is None or not is_rough(material):
            continue
        refract, fresnel, jitter = (
            bound.function(
                "blurred_transparency", name, ("materials", which, "dielectric", "roughness")
            )
            for name in FUNCTIONS
        )
        mirrored = found.get(number, Lobe(number, 0, 0.0, as_it_is, as_it_is))
        found[number] = RoughGlass(
            **{field.name: getattr(mirrored, field.name) for field in fields(mirrored)},
            roughness=min(material.dielectric.roughness, FLAT),
            refract=refract,
            jitter_refraction=jitter,
            fresnel=fresnel,
        )
    return tuple(found[number] for number in sorted(found))
