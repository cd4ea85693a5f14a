"""From gloss descriptions to lobes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from course.appearance.lobes import Lobe
from course.effects import Effects
from course.scene import description as d
from course.scene.description.values import rgb


def lobe_function(material: d.MaterialDescription) -> str | None:
    """Name of the glossy function that a material calls; None where its reflection is a mirror's."""
    if not np.any(rgb(material.mirror)):
        return None
    match material.gloss:
        case d.PlaneLobe(roughness=roughness) if roughness > 0:
            return "jitter_on_plane"
        case d.BallLobe(glossiness=glossiness) if glossiness > 0:
            return "jitter_in_ball"
        case d.PhongLobe():
            return "sample_phong_lobe"
    return None


def compile_lobes(
    materials: Mapping[str, d.MaterialDescription], effects: Effects, max_depth: int
) -> tuple[Lobe, ...]:
    """One lobe for each glossy material; none where the depth allows no reflection."""
    lobes = []
    for number, material in enumerate(materials.values()):
        name = lobe_function(material)
        if name is None or max_depth == 0:
            continue
        match material.gloss:
            case d.PlaneLobe(roughness=parameter):
                width = 2
            case d.BallLobe(glossiness=parameter):
                width = 3
            case d.PhongLobe(exponent=parameter):
                width = 2
        lobes.append(
            Lobe(
                number,
                width,
                parameter,
                effects.function("glossy", name),
                effects.function("glossy", "keep_above"),
            )
        )
    return tuple(lobes)
