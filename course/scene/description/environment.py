"""`environment`: what a ray sees that hits nothing; a union told apart by `type`."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import msgspec

from course.scene.description.values import Color, about


class ConstantEnvironment(
    msgspec.Struct,
    frozen=True,
    kw_only=True,
    forbid_unknown_fields=True,
    tag_field="type",
    tag="constant",
):
    """The same radiance from every direction."""

    radiance: Annotated[Color, about("Radiance of the background.", "W/(m^2 sr)")] = 0.0


Environment: TypeAlias = ConstantEnvironment
