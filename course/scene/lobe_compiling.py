"""From gloss descriptions to lobes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.appearance.lobes import Lobe
from course.appearance.turned_square import jitter_on_turned_square
from course.core.types import Floats32
from course.effects import Bound
from course.scene import description as d
from course.scene.description.values import rgb

FLAT = 1e6
"""A roughness from which a square's directions lie in its plane, to rounding; the functions are asked for no more."""


def lobe_function(material: d.MaterialDescription, cutoff: float) -> str | None:
    """Name of the glossy function that a material calls; None where its reflection is a mirror's, or too weak to see.

    Parameters
    ----------
    cutoff : throughputs up to this are dropped
    """
    # In float32, as the rays' throughputs are; a dielectric reflects more than its mirror.
    strongest = rgb(material.mirror).astype(np.float32).max()
    if strongest <= cutoff and (strongest == 0 or material.dielectric is None):
        return None
    match material.gloss:
        case d.PlaneLobe(roughness=roughness) if roughness > 0:
            return "jitter_on_plane"
        case d.BallLobe(glossiness=glossiness) if glossiness > 0:
            return "jitter_in_ball"
        case d.PhongLobe():
            return "sample_phong_lobe"
    return None


def calls_module(gloss: d.Gloss | None) -> bool:
    """Whether a gloss takes its directions from the module glossy."""
    return not (isinstance(gloss, d.PlaneLobe) and gloss.basis == "smallest")


def as_it_is(direction: Floats32, *_: object) -> Floats32:
    """A direction that stays what it is."""
    return direction


def compile_lobes(
    materials: Sequence[tuple[str, d.MaterialDescription]],
    bound: Bound,
    integrator: d.IntegratorDescription,
) -> tuple[Lobe, ...]:
    """One lobe for each glossy material; none where the depth allows no reflection."""
    lobes = []
    for number, (which, material) in enumerate(materials):
        name = lobe_function(material, integrator.cutoff)
        if name is None or integrator.max_depth == 0:
            continue
        match material.gloss:
            case d.PlaneLobe(roughness=roughness):
                width, parameter = 2, min(roughness, FLAT)
            case d.BallLobe(glossiness=parameter):
                width = 3
            case d.PhongLobe(exponent=parameter):
                width = 2
        asked_by = ("materials", which, "gloss")
        keep_above = as_it_is
        if integrator.into_surface == "mirror":
            keep_above = bound.function("glossy", "keep_above", asked_by)
        jitter = (
            bound.function("glossy", name, asked_by)
            if calls_module(material.gloss)
            else jitter_on_turned_square
        )
        lobes.append(Lobe(number, width, parameter, jitter, keep_above))
    return tuple(lobes)
