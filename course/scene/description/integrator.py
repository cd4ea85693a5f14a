"""`integrator`: how far light is followed."""

from __future__ import annotations

from typing import Annotated

import msgspec

from course.scene.description.values import about


class IntegratorDescription(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the recursion of reflected and refracted rays ends."""

    max_depth: Annotated[int, about("Bounces after the camera ray.", ge=0, le=64)] = 5
    cutoff: Annotated[
        float,
        about(
            "A bounced ray is dropped when the largest channel of its throughput is below this.",
            ge=0,
            lt=1,
        ),
    ] = 1 / 512
