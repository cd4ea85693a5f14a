"""`Materials`: Blinn-Phong terms, mirrors, conductors and dielectrics."""

from __future__ import annotations

from typing import Any

from course.scene.metu.element import Element
from course.scene.metu.notes import Notes

TYPES = ("mirror", "conductor", "dielectric")


def material_name(number: str) -> str:
    """How a material is called in the project's own scene files."""
    return f"material {number}"


def read_materials(scene: Element, notes: Notes) -> dict[str, dict[str, Any]]:
    """The materials of a scene by id."""
    materials: dict[str, dict[str, Any]] = {}
    for element in scene.child("Materials", "materials for the objects").all("Material"):
        number = element.id()
        if number in materials:
            raise element.error(f"its id is given twice: expected another than {number}")
        materials[number] = _material(element, notes)
    return materials


def _material(element: Element, notes: Notes) -> dict[str, Any]:
    kind = element.attribute("type")
    if kind and kind not in TYPES:
        raise element.error(f"type is {kind!r}: expected {', '.join(TYPES)} or none")
    ambient, diffuse = (
        _color(element, "AmbientReflectance", 1),
        _color(element, "DiffuseReflectance", 1),
    )
    material: dict[str, Any] = {"color": diffuse}
    if ambient != diffuse:
        material["ambient_color"] = ambient
    specular = _color(element, "SpecularReflectance")
    exponent = element.maybe("PhongExponent")
    power = 1.0 if exponent is None else exponent.number(0)
    if any(specular):
        material |= {"specular": specular, "exponent": power, "highlight": "plain"}
    if kind in ("mirror", "conductor"):
        material["mirror"] = list(
            element.child("MirrorReflectance", "such as 0.9 0.9 0.9").color(1)
        )
    if kind == "conductor":
        material["conductor"] = {
            "refraction_index": element.child("RefractionIndex", "such as 0.37").number(0),
            "absorption_index": element.child("AbsorptionIndex", "such as 2.82").number(0),
        }
    if kind == "dielectric":
        index = element.child("RefractionIndex", "such as 1.5").number(0, above=True)
        material["dielectric"] = {
            "refraction_index": index,
            "absorption": _color(element, "AbsorptionCoefficient"),
        }
        if any(diffuse) or any(ambient):
            material["dielectric"]["shaded"] = True
    if kind not in ("mirror", "conductor"):
        mirror = element.maybe("MirrorReflectance")
        if mirror is not None and any(mirror.color()):
            notes.add(mirror, "counts only with type mirror or conductor, and was left out")
    roughness = element.maybe("Roughness")
    if roughness is not None and roughness.number(0):
        if kind:
            material["gloss"] = {"lobe": "plane", "roughness": roughness.number(0)}
            if kind == "dielectric":
                material["dielectric"]["roughness"] = roughness.number(0)
        else:
            notes.add(roughness, "counts only with a type, and was left out")
    return material


def _color(element: Element, tag: str, most: float = float("inf")) -> list[float]:
    found = element.maybe(tag)
    return [0.0, 0.0, 0.0] if found is None else list(found.color(most))
