"""`materials`: what surfaces are made of, by name."""

from __future__ import annotations

from typing import Annotated

import msgspec

from course.scene.description.gloss import Gloss
from course.scene.description.values import Color, Reflectance, about


class Dielectric(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The clear inside of a material that refracts, such as glass."""

    refraction_index: Annotated[float, about("Index of refraction against vacuum.", gt=0)] = 1.5
    absorption: Annotated[
        Color,
        about("Absorption coefficient: light fades by exp(-absorption * length).", "1/world unit"),
    ] = 0.0


class MaterialDescription(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Blinn-Phong reflection, with a mirror or a dielectric on top."""

    color: Annotated[
        Reflectance | None,
        about(
            "Multiplies the ambient and diffuse terms; "
            "left out, it is 0.8 of what the mirror leaves: 0.8 (1 - mirror) in each channel."
        ),
    ] = None
    ambient: Annotated[float, about("Factor of the ambient term.", ge=0, le=1)] = 1.0
    diffuse: Annotated[float, about("Factor of the diffuse term.", ge=0, le=1)] = 1.0
    specular: Annotated[Reflectance, about("Colour of the highlight.")] = 0.0
    exponent: Annotated[float, about("Blinn-Phong exponent of the highlight.", ge=0)] = 32.0
    mirror: Annotated[Reflectance, about("Share of the light that is mirrored.")] = 0.0
    gloss: Annotated[Gloss | None, about("Blurs what is mirrored; null for a perfect mirror.")] = (
        None
    )
    dielectric: Annotated[
        Dielectric | None, about("Makes the material refract; null where it is opaque.")
    ] = None
