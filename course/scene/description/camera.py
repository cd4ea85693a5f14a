"""`camera`: where the picture is taken from."""

from __future__ import annotations

from typing import Annotated

import msgspec

from course.scene.description.values import Vector, about


class CameraDescription(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A perspective camera."""

    eye: Annotated[Vector, about("Centre of projection.", "world unit")]
    look_at: Annotated[Vector, about("Point in the middle of the picture.", "world unit")]
    up: Annotated[Vector, about("Direction that points up in the picture; any length but 0.")] = (
        0.0,
        1.0,
        0.0,
    )
    vertical_fov: Annotated[
        float, about("Angle from the picture's lower to its upper edge.", "degree", gt=0, lt=180)
    ] = 40.0
