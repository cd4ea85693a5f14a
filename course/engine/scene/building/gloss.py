"""From gloss descriptions to lobes, and from what is rough to rough glass and to microfacets."""

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec
import numpy as np

from course.engine.core.gloss import Lobe
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.functions.effects import Bound
from course.engine.terms.scattering.lobes import ForeignLobe
from course.engine.terms.scattering.microfacets import Microfacets
from course.engine.terms.scattering.rough_glass import RoughGlass

FLAT = 1e6
"""A roughness from which a square's directions lie in its plane, to rounding; the functions are asked for no more."""


def lobe_of(material: d.MaterialDescription, cutoff: float) -> tuple[str, str, float] | None:
    """A lobe's kind, the glossy function that it calls, and its parameter.

    None where a material's reflection is a mirror's, or too weak to see: throughputs up to ``cutoff`` are dropped.
    """
    # In float32, as the rays' throughputs are; a dielectric reflects more than its mirror.
    strongest = rgb(material.mirror).astype(np.float32).max()
    if strongest > cutoff or (strongest > 0 and material.dielectric is not None):
        match material.gloss:
            case d.PlaneLobe(roughness=roughness) if roughness > 0:
                return "plane", "jitter_on_plane", min(roughness, FLAT)
            case d.BallLobe(glossiness=glossiness) if glossiness > 0:
                return "ball", "jitter_in_ball", glossiness
            case d.PhongLobe(exponent=exponent):
                return "phong", "sample_phong_lobe", exponent
    return None


def calls_module(gloss: d.Gloss | None) -> bool:
    """True if a gloss samples its directions by the module glossy."""
    return not (isinstance(gloss, d.PlaneLobe) and gloss.basis == "smallest")


@dataclass(frozen=True)
class CompiledScattering:
    """What mirrors and refracts otherwise than a smooth surface; see ``FullWorld``."""

    lobes: tuple[Lobe, ...]
    rough: tuple[RoughGlass, ...]
    microfacets: tuple[Microfacets, ...]


def compile_scattering(
    materials: Sequence[tuple[str, d.MaterialDescription]],
    bound: Bound,
    integrator: d.IntegratorDescription,
) -> CompiledScattering:
    """Glossy lobes, rough glass and microfacets of the materials, which have their names before them."""
    mirrors = [(name, reflecting(material)) for name, material in materials]
    lobes = compile_lobes(mirrors, bound, integrator)
    microfacets = compile_microfacets(materials, bound, integrator)
    rough = compile_rough_glass(materials, lobes, bound, integrator)
    return CompiledScattering(lobes, rough, microfacets)


def compile_lobes(
    materials: Sequence[tuple[str, d.MaterialDescription]],
    bound: Bound,
    integrator: d.IntegratorDescription,
) -> tuple[Lobe, ...]:
    """One lobe for each glossy material; none where the depth allows no reflection."""
    lobes: list[Lobe] = []
    for number, (which, material) in enumerate(materials):
        lobe = lobe_of(material, integrator.cutoff)
        if lobe is None or integrator.max_depth == 0:
            continue
        kind, name, parameter = lobe
        keeps = integrator.into_surface != "mirror"
        turned = not calls_module(material.gloss)
        called = [*([] if keeps else ["keep_above"]), *([] if turned else [name])]
        glossy = bound.functions("glossy", *called, asked_by=("materials", which, "gloss"))
        known = number, kind, parameter, glossy
        foreign = turned or keeps
        lobes.append(ForeignLobe(*known, turned, keeps) if foreign else Lobe(*known))
    return tuple(lobes)


FUNCTIONS = ("refract", "fresnel", "jitter_refraction")
"""The functions of the blurred_transparency module that rough glass calls."""


def is_rough(material: d.MaterialDescription) -> bool:
    """True if a material is rough glass, whose refracted directions are moved on a square."""
    glass = material.dielectric
    return glass is not None and glass.roughness > 0 and glass.distribution == "square"


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

    ``lobes``: of the glossy materials.
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


SMOOTHEST = 0.001
"""The least roughness that the functions of microfacets know."""

LARGEST_INDEX = 1e8
"""An index of refraction beyond it is as good as infinite."""


def compile_microfacets(
    materials: Sequence[tuple[str, d.MaterialDescription]],
    bound: Bound,
    integrator: d.IntegratorDescription,
) -> tuple[Microfacets, ...]:
    """The metals and glasses with a GGX distribution of microfacets; none where the depth allows no reflection."""
    found = []
    for number, (which, material) in enumerate(materials):
        metal, glass = material.conductor, material.dielectric
        if integrator.max_depth == 0:
            continue
        if metal is not None and metal.roughness:
            kind, roughness = "conductor", metal.roughness
            n, k = (
                np.minimum(rgb(part), LARGEST_INDEX)
                for part in (metal.refraction_index, metal.absorption_index)
            )
            k[(n == 0) & (k == 0)] = 1.0
        elif glass is not None and glass.roughness and glass.distribution == "ggx":
            kind, roughness = "dielectric", glass.roughness
            n, k = np.full(3, glass.refraction_index), None
        else:
            continue
        names = ["sample_visible_normal", "smith_g1", "smith_g2", "fresnel_complex"]
        asked_by = ("materials", which, kind, "roughness")
        functions = bound.functions("microfacets", *names, asked_by=asked_by)
        found.append(Microfacets(number, max(roughness, SMOOTHEST), n, k, functions))
    return tuple(found)
