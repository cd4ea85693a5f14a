"""`materials`: what surfaces are made of, by name."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from course.formats.yaml.description.gloss import Gloss
from course.formats.yaml.description.values import Color, Map, Reflectance, about


class Dielectric(Map, frozen=True, kw_only=True):
    """The clear inside of a material that refracts, such as glass."""

    refraction_index: Annotated[float, about("Index of refraction against vacuum.", gt=0)] = 1.5
    absorption: Annotated[
        Color,
        about("Absorption coefficient: light fades by exp(-absorption * length).", "1/world unit"),
    ] = 0.0
    shaded: Annotated[
        bool, about("Whether the ambient and diffuse terms are added to what it reflects.")
    ] = False
    roughness: Annotated[
        float,
        about(
            "Frosted glass: refracted directions are moved on a square of this edge, at distance 1;"
            " 0 is clear glass.",
            ge=0,
        ),
    ] = 0.0
    surrounded_by: Annotated[
        str | None,
        about(
            "Name of the dielectric that lies all around it, such as the water that a glass ball lies in; null for"
            " vacuum. Surfaces of the two must not touch or cross."
        ),
    ] = None


class Conductor(Map, frozen=True, kw_only=True):
    """A metal: by the Fresnel equations it mirrors more the more grazing the light, white at last."""

    refraction_index: Annotated[
        Color, about("Real part of the index of refraction, against vacuum.")
    ]
    absorption_index: Annotated[
        Color, about("Imaginary part of the index of refraction, the extinction coefficient.")
    ]
    fresnel: Annotated[
        Literal["exact", "approximate"],
        about(
            "The Fresnel equations, or their usual approximation, which holds where n^2 + k^2 is much larger than 1."
        ),
    ] = "exact"


_Times: TypeAlias = Annotated[float, msgspec.Meta(gt=0, le=1e4)]


class TextureDescription(Map, frozen=True, kw_only=True):
    """A picture on a surface: bilinear between its pixels, and repeated beyond its edges."""

    image: Annotated[
        str,
        about(
            "File of the picture, relative to the scene file: PNG, JPEG, EXR or HDR, nothing in it above 1.",
            min_length=1,
        ),
    ]
    repeat: Annotated[
        tuple[_Times, _Times],
        about(
            "How often the picture repeats along u and v: a quad's x and -z, a sphere's longitude and latitude,"
            " and the texture coordinates of a mesh."
        ),
    ] = (1.0, 1.0)


class MaterialDescription(Map, frozen=True, kw_only=True):
    """Blinn-Phong reflection, with a mirror, a metal or a dielectric on top."""

    color: Annotated[
        Reflectance | None,
        about(
            "Multiplies the ambient and diffuse terms; "
            "left out, it is 0.8 of what the mirror leaves: 0.8 (1 - mirror) in each channel."
        ),
    ] = None
    ambient: Annotated[
        float, about("Factor of the ambient term; above 1 it makes light.", ge=0, le=1e6)
    ] = 1.0
    diffuse: Annotated[
        float, about("Factor of the diffuse term; above 1 it may make light.", ge=0, le=1e6)
    ] = 1.0
    ambient_color: Annotated[
        Reflectance | None, about("Colour of the ambient term, where it is another than color.")
    ] = None
    specular: Annotated[Color, about("Colour of the highlight; a sharp one may exceed 1.")] = 0.0
    exponent: Annotated[float, about("Blinn-Phong exponent of the highlight.", ge=0)] = 32.0
    highlight: Annotated[
        Literal["cosine", "plain"],
        about(
            "Whether the highlight fades with the cosine between light and normal, as the diffuse term does;"
            " plain is Blinn's formula, without it."
        ),
    ] = "cosine"
    emission: Annotated[
        Color,
        about(
            "What the surface sends out by itself, the same from both sides and in all directions. It counts wherever"
            " a ray meets it. No shadow ray looks for it, so only path tracing and radiosity light others by it, unless"
            " the object is one of the lights, by type: object.",
            "W/(m^2 sr)",
        ),
    ] = 0.0
    mirror: Annotated[Reflectance, about("Share of the light that is mirrored.")] = 0.0
    gloss: Annotated[Gloss | None, about("Blurs what is mirrored; null for a perfect mirror.")] = (
        None
    )
    dielectric: Annotated[
        Dielectric | None, about("Makes the material refract; null where it is opaque.")
    ] = None
    conductor: Annotated[
        Conductor | None,
        about(
            "Makes the mirror a metal's: its Fresnel reflectance times mirror; null where it is none."
        ),
    ] = None
    texture: Annotated[
        TextureDescription | None,
        about(
            "A picture that multiplies color and ambient_color from place to place; with one, color left out is all"
            " that the mirror leaves."
        ),
    ] = None
