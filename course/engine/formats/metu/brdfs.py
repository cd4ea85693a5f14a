"""`BRDFs`: which of METU's models a material has, as terms of Blinn and Phong's model of this course.

Of a light that sends the irradiance E to a surface that faces it, METU's models reflect, for kd, ks and exponent p, h
the angle between the normal and the half vector, r that between the mirrored light and the viewer, and t that between
the normal and the light:

- OriginalBlinnPhong: (kd cos t + ks cos^p h) E, the model of a material without a BRDF;
- ModifiedBlinnPhong: (kd + ks cos^p h) cos t E; normalized, (kd + ks (p + 8) / 8 cos^p h) cos t E / pi;
- OriginalPhong and ModifiedPhong: r in the place of h; normalized, (p + 2) / 2 in the place of (p + 8) / 8;
- TorranceSparrow: (kd / pi + ks D F G / (4 cos t cos v)) cos t E, v the angle between the normal and the viewer, with
  the D, F and G of this course's facets; with kdfresnel, kd (1 - F).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from course.base.errors import SceneError
from course.engine.formats.metu.element import MetuElement
from course.engine.formats.yaml.suggestions import suggest

HIGHLIGHTS = {
    "OriginalBlinnPhong": "plain",
    "ModifiedBlinnPhong": "cosine",
    "OriginalPhong": "plain_phong",
    "ModifiedPhong": "phong",
    "TorranceSparrow": "cosine",
}
"""The models, and what the key `highlight` of materials calls them."""

FACETS = "TorranceSparrow"


@dataclass(frozen=True)
class Brdf:
    """How the reflectances and the exponent of a material count.

    Attributes
    ----------
    exponent : of the highlight; None for that of the material
    model : one of METU's
    normalized : true if the diffuse term is divided by pi, and the highlight brought to its energy
    covers : true if the diffuse term gets what facets leave
    unknown : an element of `BRDFs` whose model is none of those known
    """

    exponent: float | None = None
    model: str = "OriginalBlinnPhong"
    normalized: bool = False
    covers: bool = False
    unknown: MetuElement | None = None

    def keys(self, material: MetuElement, exponent: float) -> dict[str, Any]:
        """The keys of a highlight but for its colour; SceneError for facets without an index of refraction."""
        keys: dict[str, Any] = {"exponent": exponent, "highlight": HIGHLIGHTS[self.model]}
        if self.model != FACETS:
            return keys
        facets: dict[str, Any] = {
            "refraction_index": material.child(
                "RefractionIndex", f"such as 1.5, for its BRDF is {FACETS}"
            ).number(0, above=True),
            "absorption_index": material.number_of("AbsorptionIndex", 0.0),
        }
        return keys | {"facets": facets | ({"covers": True} if self.covers else {})}

    def highlight_factor(self, exponent: float) -> float:
        """What the specular reflectance is multiplied by, relative to a diffuse term of the same kind."""
        if not self.normalized or self.model == FACETS:
            return 1.0
        return (exponent + 2) / 2 if self.model == "ModifiedPhong" else (exponent + 8) / 8


def read_brdfs(scene: MetuElement) -> dict[str, Brdf]:
    """The models by id; those that are not known stand for themselves, and are refused where they are used."""
    parent = scene.maybe("BRDFs")
    found: dict[str, Brdf] = {}
    for kind in HIGHLIGHTS if parent is not None else ():
        assert parent is not None
        for element in parent.all(kind):
            number = element.id(found)
            exponent = element.child("Exponent", "such as 50").number(0)
            normalized, covers = element.flag("normalized"), element.flag("kdfresnel")
            if normalized and not kind.startswith("Modified"):
                raise element.error("normalized is true: only a modified model has such a form")
            if covers and kind != FACETS:
                raise element.error(f"kdfresnel is true: only {FACETS} has such a form")
            found[number] = Brdf(exponent, kind, normalized or kind == FACETS, covers)
    for element in () if parent is None else parent.children:
        if element.tag not in HIGHLIGHTS:
            found.setdefault(element.attributes.get("id", "").strip(), Brdf(unknown=element))
    return found


def brdf_of(material: MetuElement, brdfs: Mapping[str, Brdf]) -> Brdf:
    """The model of a material; SceneError where there is none of that id."""
    name = material.attribute("BRDF")
    if not name:
        return Brdf()
    if name not in brdfs:
        raise material.error(f"BRDF is {name}: expected the id of one; {suggest(name, brdfs)}")
    return brdfs[name]


def refused_brdf(brdf: Brdf) -> SceneError | None:
    """The error of an object whose material has a model that is not known."""
    if brdf.unknown is None:
        return None
    known = ", ".join(HIGHLIGHTS)
    return brdf.unknown.refused(
        f"this course has no such model, only {known}; take the attribute BRDF from its materials to render without it"
    )


def pi_is_of_surfaces(scene: MetuElement) -> bool:
    """True if a scene's lights keep their strength, and its reflectances are pi times as large.

    This course divides reflectances by pi, METU's models don't, but for normalized ones. Where lights only send light
    to surfaces, they are pi times as strong; where cameras or paths see them, surfaces reflect pi times as much.
    """
    seen = {"SphericalDirectionalLight", "LightMesh", "LightSphere", FACETS}
    return any(
        each.tag in seen
        or each.attributes.get("normalized", "").strip().lower() in ("true", "1")
        or (each.tag == "Renderer" and each.text.split() == ["PathTracing"])
        for each in _all(scene)
    )


def _all(element: MetuElement) -> Iterator[MetuElement]:
    yield element
    for child in element.children:
        yield from _all(child)
