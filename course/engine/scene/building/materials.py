"""From material descriptions to the table that hits look things up in; and materials that make light."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from course.engine.core.environment import ConstantEnvironment, CubeEnvironment
from course.engine.core.types import Floats64
from course.engine.formats.yaml.description import (
    MaterialDescription,
    ObjectLight,
    SceneDescription,
    rgb,
)
from course.engine.formats.yaml.loading import Loaded
from course.engine.scene.building.frame import BRIGHTEST, Frame
from course.engine.scene.building.highlights import compile_highlights, plain_highlights
from course.engine.terms.scattering.conductors import Conductors
from course.engine.terms.scattering.materials import FullMaterials
from course.engine.terms.world import FullWorld

DEFAULT_COLOR = 0.8
"""Share of the light that the mirror leaves, if the file names no colour."""

LARGEST_INDEX = 1e8
"""An index of refraction beyond it is as good as infinite."""

SMALLEST_INDEX = 1e-8
"""An index of refraction below it is as good as none: its inverse, squared, is to stay a number of float32."""

LARGEST = 1e30
"""An exponent or absorption beyond it is as good as infinite, and float32 carries it."""


def base_color(material: MaterialDescription) -> Floats64:
    """(3,) float64 colour of the ambient and diffuse terms, as given or as the mirror leaves it."""
    if material.color is None:
        # The picture of a texture says itself how dark it is.
        share = DEFAULT_COLOR if material.texture is None else 1.0
        return share * (1.0 - rgb(material.mirror))
    return rgb(material.color)


def returned_share(material: MaterialDescription) -> Floats64:
    """(3,) float64 share of the light that diffuse reflection, mirror and glass return together.

    Above 1 the material makes light. Highlights are left out: how much they return depends on the
    directions.
    """
    return diffuse_share(material) + handed_on(material)


def diffuse_share(material: MaterialDescription) -> Floats64:
    """(3,) float64 share of the light that is reflected diffusely."""
    if not has_body(material) or rgb(material.unlit).any():
        return np.zeros(3)
    return base_color(material) * material.diffuse


def handed_on(material: MaterialDescription) -> Floats64:
    """(3,) float64 share of the light that mirror and glass return together."""
    # A dielectric reflects a part and lets the rest through, all in all 1.
    return rgb(material.mirror) + (1.0 if material.dielectric else 0.0)


def has_body(material: MaterialDescription) -> bool:
    """True if a material has ambient and diffuse terms."""
    return material.dielectric is None or material.dielectric.shaded


def ambient_color(material: MaterialDescription) -> Floats64:
    """(3,) float64 colour of the ambient term."""
    if material.ambient_color is None:
        return base_color(material)
    return rgb(material.ambient_color)


def _conductors(materials: Mapping[str, MaterialDescription], count: int) -> Conductors | None:
    metals = {
        column: material.conductor
        for column, material in enumerate(materials.values())
        if material.conductor is not None and not material.conductor.roughness
    }
    if not metals:
        return None
    metal, (n, k) = np.zeros(count, np.bool_), np.ones((2, 3, count), np.float32)
    for column, conductor in metals.items():
        metal[column] = True
        # Beyond it the metal is a perfect mirror to float32, and the square of a square overflows.
        n[:, column] = np.minimum(rgb(conductor.refraction_index), LARGEST_INDEX)
        k[:, column] = np.minimum(rgb(conductor.absorption_index), LARGEST_INDEX)
    approximate = np.zeros(count, np.bool_)
    approximate[[column for column in metals if metals[column].fresnel == "approximate"]] = True
    return Conductors(metal, n, k, approximate if approximate.any() else None)


def compile_materials(
    materials: Mapping[str, MaterialDescription], emission: list[Floats64], frame: Frame
) -> FullMaterials:
    """One column for each material, then one for each surface of a light, which reflects nothing.

    ``emission``: radiance of the lights that have a surface.
    """
    count = len(materials) + len(emission)
    ambient, diffuse, specular, mirror, absorption, emitted = np.zeros((6, 3, max(count, 1)))
    unlit, number = np.zeros((3, max(count, 1))), np.arange(max(count, 1))
    # Without any material there is a column that nothing has.
    lamps = (number >= len(materials)) & (number < count)
    exponent, index = np.ones(max(count, 1)), np.zeros(max(count, 1))
    for column, material in enumerate(materials.values()):
        color = base_color(material)
        specular[:, column] = rgb(material.specular)
        mirror[:, column] = rgb(material.mirror)
        emitted[:, column] = rgb(material.emission)
        exponent[column] = material.exponent
        if rgb(material.unlit).any():
            unlit[:, column] = color * rgb(material.unlit)
        elif has_body(material):
            ambient[:, column] = ambient_color(material) * material.ambient
            diffuse[:, column] = color * material.diffuse
        if material.dielectric is not None:
            refraction_index = material.dielectric.refraction_index
            index[column] = min(max(refraction_index, SMALLEST_INDEX), LARGEST_INDEX)
            per_unit = np.minimum(rgb(material.dielectric.absorption), LARGEST / frame.scale)
            absorption[:, column] = per_unit * frame.scale
    for column, radiance in enumerate(emission, start=len(materials)):
        emitted[:, column] = radiance
    f = np.float32
    return FullMaterials(
        ambient.astype(f),
        diffuse.astype(f),
        specular.astype(f),
        np.minimum(exponent, LARGEST).astype(f),
        mirror.astype(f),
        index.astype(f),
        absorption.astype(f),
        emitted.astype(f),
        lamps,
        conductors=_conductors(materials, max(count, 1)),
        highlights=compile_highlights(materials, max(count, 1)),
        plain=plain_highlights(materials, max(count, 1)),
        unlit=unlit.astype(f) if unlit.any() else None,
    )


def check_growth(loaded: Loaded, used: Iterable[str], world: FullWorld) -> None:
    """Check what a ray may carry after all its bounces.

    Raises SceneError: it is more than float32 holds; names the material that makes most light.
    ``used``: names of the objects' materials.
    """
    scene = loaded.description
    integrator = scene.integrator
    share = returned_share if integrator.type == "path" else handed_on
    shares = {name: float(share(scene.materials[name]).max()) for name in used}
    worst = max(shares, key=lambda name: shares[name], default=None)
    if worst is None or shares[worst] <= 1:
        return
    # By logarithms: the power itself may overflow even here.
    room = math.log(BRIGHTEST / max(1.0, _brightest(world)))
    growth = math.log(shares[worst])
    if integrator.max_depth * growth < room:
        return
    digits = integrator.max_depth * growth / math.log(10)
    raise loaded.document.error(
        ("materials", worst),
        f"returns {shares[worst]:.3g} times the light that it gets, 10^{digits:.0f} times after the"
        f" {integrator.max_depth} bounces of integrator.max_depth: expected a material that makes less light, or a"
        f" max_depth of at most {math.ceil(room / growth) - 1}",
    )


def _brightest(world: FullWorld) -> float:
    """The largest radiance, or irradiance at the size of the scene, of whatever shines."""
    colors = [world.ambient, world.materials.emission, *(light.color for light in world.lights)]
    if isinstance(world.materials, FullMaterials) and world.materials.unlit is not None:
        colors.append(world.materials.unlit)
    if isinstance(world.environment, CubeEnvironment):
        colors.append(world.environment.faces)
    elif isinstance(world.environment, ConstantEnvironment):
        colors.append(world.environment.color)
    return max(float(color.max()) for color in colors)


@dataclass(frozen=True)
class Columns:
    """Columns of the material table: one for each material that objects have, then one for each object that is a light.

    Attributes
    ----------
    names : of their materials
    of_objects : the column of each object
    of_lights : the column of each light that is an object, by the number of the light
    """

    names: tuple[str, ...]
    of_objects: tuple[int, ...]
    of_lights: dict[int, int]


def material_columns(description: SceneDescription) -> Columns:
    """The columns in use; materials without objects have none."""
    numbers = {thing.name: number for number, thing in enumerate(description.objects)}
    lit = {
        index: numbers[light.object]
        for index, light in enumerate(description.lights)
        if isinstance(light, ObjectLight)
    }
    columns = dict.fromkeys(lit.values(), -1)
    names: list[str] = []
    for number, thing in enumerate(description.objects):
        if number in columns:
            continue
        if thing.material not in names:
            names.append(thing.material)
        columns[number] = names.index(thing.material)
    for number in lit.values():
        columns[number] = len(names)
        names.append(description.objects[number].material)
    return Columns(
        tuple(names),
        tuple(columns[number] for number in range(len(description.objects))),
        {light: columns[number] for light, number in lit.items()},
    )
