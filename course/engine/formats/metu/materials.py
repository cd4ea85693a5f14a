"""`Materials`: Blinn-Phong terms, mirrors, conductors and dielectrics."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from course.base.errors import SceneError
from course.engine.formats.metu.brdfs import FACETS, Brdf, brdf_of, refused_brdf
from course.engine.formats.metu.element import MetuElement, Notes

TYPES = ("mirror", "conductor", "dielectric")

COUNTS_WITH = {
    "MirrorReflectance": ("mirror", "conductor"),
    "RefractionIndex": ("conductor", "dielectric"),
    "AbsorptionIndex": ("conductor",),
    "AbsorptionCoefficient": ("dielectric",),
}
"""The types that an element is read for."""

INDICES = ("RefractionIndex", "AbsorptionIndex")
"""They are read for the facets of a BRDF, too."""

DEGAMMA = 2.2
"""The power of reflectances that are given as codes of a screen."""


@dataclass(frozen=True)
class Body:
    """What objects and textures need of a material.

    Attributes
    ----------
    diffuse : its diffuse reflectance
    by : what that is multiplied by
    highlight : the keys of its highlight where its specular reflectance is 1
    degamma : true if its own reflectances are codes of a screen
    refused : why no object can have it
    """

    diffuse: list[float]
    by: float
    highlight: dict[str, Any]
    degamma: bool
    refused: SceneError | None


def material_name(number: str) -> str:
    """Name of a material in the project's own scene files."""
    return f"material {number}"


def read_materials(
    scene: MetuElement, notes: Notes, brdfs: Mapping[str, Brdf], of_surfaces: bool
) -> tuple[dict[str, dict[str, Any]], dict[str, Body]]:
    """The materials of a scene by id, and what textures need of each.

    ``of_surfaces``: see ``brdfs.pi_is_of_surfaces``.
    """
    materials: dict[str, dict[str, Any]] = {}
    bodies: dict[str, Body] = {}
    elements = scene.child("Materials", "materials for the objects").all("Material")
    typed = any(element.attribute("type") for element in elements)
    for element in elements:
        number = element.id(materials)
        brdf = brdf_of(element, brdfs)
        _pass_over_opaque(element)
        kind = element.attribute("type") or ("" if typed else _old_type(element, notes))
        materials[number], bodies[number] = _material(element, kind, notes, brdf, of_surfaces)
    return materials, bodies


def _old_type(element: MetuElement, notes: Notes) -> str:
    """The type of a material in a file in which none has one, as in the homework of 2019."""
    mirror = element.maybe("MirrorReflectance")
    if mirror is None or not mirror.many("numbers, such as 0.5").any():
        return ""
    notes.add(mirror, "is that of type mirror, as no material of the file has a type")
    return "mirror"


def _pass_over_opaque(element: MetuElement) -> None:
    """Ask for a Transparency of 0, which is no loss; any other is refused, as nobody asks for it (``refusals``)."""
    given = [child.text.split() for child in element.children if child.tag == "Transparency"]
    if all(word.strip("0.") == "" for words in given for word in words):
        for opaque in element.all("Transparency"):
            opaque.words()


def _material(
    element: MetuElement, kind: str, notes: Notes, brdf: Brdf, of_surfaces: bool
) -> tuple[dict[str, Any], Body]:
    if kind and kind not in TYPES:
        raise element.error(f"type is {kind!r}: expected {', '.join(TYPES)} or none")
    degamma = element.flag("degamma")
    linear = DEGAMMA if degamma else 1.0
    ambient, diffuse, specular = (
        [value**linear for value in element.color_of(f"{name}Reflectance")]
        for name in ("Ambient", "Diffuse", "Specular")
    )
    # A normalized model divides by pi, as this course does.
    by = math.pi if of_surfaces and not brdf.normalized else 1.0
    material = _body(ambient, [by * value for value in diffuse])
    power = element.number_of("PhongExponent", 1.0)
    power = power if brdf.exponent is None else brdf.exponent
    factor = by * brdf.highlight_factor(power)
    shine = brdf.keys(element, power)
    if any(specular):
        material |= {"specular": [factor * value for value in specular]}
    if any(specular) or brdf.model == FACETS:
        material |= shine
    body = Body(diffuse, by, {"specular": factor} | shine, degamma, refused_brdf(brdf))
    if kind in ("mirror", "conductor"):
        material["mirror"] = list(
            element.child("MirrorReflectance", "such as 0.9 0.9 0.9").color(1)
        )
    if kind == "conductor":
        material["conductor"] = {
            "refraction_index": element.child("RefractionIndex", "such as 0.37").number(0),
            "absorption_index": element.child("AbsorptionIndex", "such as 2.82").number(0),
            "fresnel": "approximate",
        }
    if kind == "dielectric":
        index = element.child("RefractionIndex", "such as 1.5").number(0, above=True)
        material["dielectric"] = {
            "refraction_index": index,
            "absorption": element.color_of("AbsorptionCoefficient"),
        }
        if any(diffuse) or any(ambient):
            material["dielectric"]["shaded"] = True
    for tag, kinds in COUNTS_WITH.items():
        counts = kind in kinds or (brdf.model == FACETS and tag in INDICES)
        idle = None if counts else element.maybe(tag)
        if idle is not None and idle.many("numbers, such as 0.5").any():
            notes.add(idle, f"counts only with type {' or '.join(kinds)}, and was left out")
    edge = element.number_of("Roughness", 0.0)
    if edge and kind:
        material["gloss"] = {"lobe": "plane", "roughness": edge, "basis": "smallest"}
        if kind == "dielectric":
            material["dielectric"]["roughness"] = edge
    elif edge:
        roughness = element.child("Roughness", "a number")
        notes.add(roughness, "counts only with a type, and was left out")
    return material, body


def _body(ambient: list[float], diffuse: list[float]) -> dict[str, Any]:
    """Colours, which end at 1, and factors where a reflectance doesn't."""
    by, of = max(1.0, *diffuse), max(1.0, *ambient)
    material: dict[str, Any] = {"color": [value / by for value in diffuse]}
    if ambient != diffuse:
        material["ambient_color"] = [value / of for value in ambient]
    factors = {"diffuse": by, "ambient": of}
    return material | {key: factor for key, factor in factors.items() if factor > 1}
