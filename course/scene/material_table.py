"""From material descriptions to the table that hits look things up in."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from course.appearance.materials import MaterialTable
from course.core.types import Floats64
from course.scene.description import MaterialDescription
from course.scene.description.values import rgb
from course.scene.frame import Frame

DEFAULT_COLOR = 0.8
"""Of the light that the mirror leaves, where the file names no colour."""

LARGEST = 1e30
"""An exponent or absorption beyond it is as good as infinite, and float32 carries it."""


def base_color(material: MaterialDescription) -> Floats64:
    """(3,) float64 colour of the ambient and diffuse terms, as given or as the mirror leaves it."""
    if material.color is None:
        return DEFAULT_COLOR * (1.0 - rgb(material.mirror))
    return rgb(material.color)


def returned_share(material: MaterialDescription) -> Floats64:
    """(3,) float64 share of the light that diffuse reflection, mirror and glass return together.

    Above 1 the material makes light. Highlights are left out: how much they return depends on the
    directions.
    """
    # A dielectric reflects a part and lets the rest through, all in all 1.
    rest = 1.0 if material.dielectric else base_color(material) * material.diffuse
    return rest + rgb(material.mirror)


def compile_materials(
    materials: Mapping[str, MaterialDescription], emission: list[Floats64], frame: Frame
) -> MaterialTable:
    """One column for each material, then one for each emitting surface, which reflects nothing."""
    count = len(materials) + len(emission)
    ambient, diffuse, specular, mirror, absorption, emitted = np.zeros((6, 3, max(count, 1)))
    exponent, index = np.ones(max(count, 1)), np.zeros(max(count, 1))
    for column, material in enumerate(materials.values()):
        color = base_color(material)
        specular[:, column] = rgb(material.specular)
        mirror[:, column] = rgb(material.mirror)
        exponent[column] = material.exponent
        if material.dielectric is None:
            ambient[:, column] = color * material.ambient
            diffuse[:, column] = color * material.diffuse
        else:
            index[column] = material.dielectric.refraction_index
            per_unit = np.minimum(rgb(material.dielectric.absorption), LARGEST / frame.scale)
            absorption[:, column] = per_unit * frame.scale
    for column, radiance in enumerate(emission, start=len(materials)):
        emitted[:, column] = radiance
    f = np.float32
    return MaterialTable(
        ambient.astype(f),
        diffuse.astype(f),
        specular.astype(f),
        np.minimum(exponent, LARGEST).astype(f),
        mirror.astype(f),
        index.astype(f),
        absorption.astype(f),
        emitted.astype(f),
    )
