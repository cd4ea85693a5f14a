"""From material descriptions to the table that hits look things up in."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from course.appearance.materials import MaterialTable
from course.core.types import Floats64
from course.scene.description import MaterialDescription
from course.scene.description.values import rgb
from course.scene.frame import Frame


def compile_materials(
    materials: Mapping[str, MaterialDescription], emission: list[Floats64], frame: Frame
) -> MaterialTable:
    """One column for each material, then one for each emitting surface, which reflects nothing."""
    count = len(materials) + len(emission)
    ambient, diffuse, specular, mirror, absorption, emitted = np.zeros((6, 3, max(count, 1)))
    exponent, index = np.ones(max(count, 1)), np.zeros(max(count, 1))
    for column, material in enumerate(materials.values()):
        specular[:, column] = rgb(material.specular)
        mirror[:, column] = rgb(material.mirror)
        exponent[column] = material.exponent
        if material.dielectric is None:
            ambient[:, column] = rgb(material.color) * material.ambient
            diffuse[:, column] = rgb(material.color) * material.diffuse
        else:
            index[column] = material.dielectric.refraction_index
            absorption[:, column] = rgb(material.dielectric.absorption) * frame.scale
    for column, radiance in enumerate(emission, start=len(materials)):
        emitted[:, column] = radiance
    f = np.float32
    return MaterialTable(
        ambient.astype(f),
        diffuse.astype(f),
        specular.astype(f),
        exponent.astype(f),
        mirror.astype(f),
        index.astype(f),
        np.minimum(absorption, 1e30).astype(f),
        emitted.astype(f),
    )
