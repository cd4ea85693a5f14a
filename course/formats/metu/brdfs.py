"""`BRDFs`: which of METU's models a material has, as terms of Blinn and Phong's model of this course.

Of a light that sends the irradiance E to a surface that faces it, METU's models reflect, for kd, ks and exponent p, h
the angle between the normal and the half vector, and t that between the normal and the light:

- OriginalBlinnPhong: (kd cos t + ks cos^p h) E, the model of a material without a BRDF;
- ModifiedBlinnPhong: (kd + ks cos^p h) cos t E; normalized, (kd + ks (p + 8) / 8 cos^p h) cos t E / pi.

The others need a mirrored direction in the place of the half vector, or microfacets with a distribution by Blinn.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from course.formats.metu.element import Element
from course.formats.yaml.document import suggest

CONVERTED = ("OriginalBlinnPhong", "ModifiedBlinnPhong")

REFUSED = {
    "OriginalPhong": "its highlight lies about the mirrored direction; this course has that of the half vector,"
    " OriginalBlinnPhong",
    "ModifiedPhong": "its highlight lies about the mirrored direction; this course has that of the half vector,"
    " ModifiedBlinnPhong",
    "TorranceSparrow": "its microfacets have a distribution by Blinn, cos^Exponent; those of this course have one by"
    " GGX, which no Exponent makes the same",
}
"""Why a model can't be converted."""


@dataclass(frozen=True)
class Brdf:
    """How the reflectances and the exponent of a material count.

    Attributes
    ----------
    exponent : of the highlight; None for that of the material
    highlight : see the key of that name of materials
    normalized : true if the diffuse term is divided by pi, and the highlight brought to its energy
    """

    exponent: float | None = None
    highlight: str = "plain"
    normalized: bool = False

    def highlight_factor(self, exponent: float) -> float:
        """What the specular reflectance is multiplied by, relative to a diffuse term of the same kind."""
        return (exponent + 8) / 8 if self.normalized else 1.0


def read_brdfs(scene: Element) -> dict[str, Brdf | Element]:
    """The models by id; an element stands for one that can't be converted, which is refused where it is used."""
    parent = scene.maybe("BRDFs")
    found: dict[str, Brdf | Element] = {}
    for kind in (*CONVERTED, *REFUSED) if parent is not None else ():
        assert parent is not None
        for element in parent.all(kind):
            number = element.id(found)
            exponent = element.child("Exponent", "such as 50").number(0)
            normalized = element.flag("normalized")
            element.flag("kdfresnel")
            found[number] = element
            if kind in CONVERTED:
                modified = kind == "ModifiedBlinnPhong"
                if normalized and not modified:
                    raise element.error("normalized is true: only a modified model has such a form")
                found[number] = Brdf(exponent, "cosine" if modified else "plain", normalized)
    return found


def brdf_of(material: Element, brdfs: Mapping[str, Brdf | Element]) -> Brdf:
    """The model of a material.

    Raises SceneError: there is none of that id, or it is one that can't be converted.
    """
    name = material.attribute("BRDF")
    if not name:
        return Brdf()
    if name not in brdfs:
        raise material.error(f"BRDF is {name}: expected the id of one; {suggest(name, brdfs)}")
    brdf = brdfs[name]
    if isinstance(brdf, Element):
        raise brdf.refused(
            f"{REFUSED[brdf.tag]}; take the attribute BRDF from {material.path} to render it without"
        )
    return brdf


def pi_is_of_surfaces(scene: Element) -> bool:
    """True if a scene's lights keep their strength, and its reflectances are pi times as large.

    This course divides reflectances by pi, METU's models don't, but for normalized ones. Where lights only send light
    to surfaces, they are pi times as strong; where cameras or paths see them, surfaces reflect pi times as much.
    """
    seen = {"SphericalDirectionalLight", "LightMesh", "LightSphere"}
    return any(
        each.tag in seen
        or each.attributes.get("normalized", "").strip().lower() in ("true", "1")
        or (each.tag == "Renderer" and each.text.split() == ["PathTracing"])
        for each in _all(scene)
    )


def _all(element: Element) -> Iterator[Element]:
    yield element
    for child in element.children:
        yield from _all(child)
