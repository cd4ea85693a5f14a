"""`sampler`: how many samples a pixel takes, and in what pattern."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from course.scene.description.values import about


class SamplerDescription(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The pattern of samples; `regular` and `jittered` need a square number of them."""

    type: Annotated[
        Literal[
            "sobol", "random", "jittered", "regular", "halton", "hammersley", "chained", "xorshift"
        ],
        about("Pattern of the samples."),
    ] = "sobol"
    samples: Annotated[int, about("Samples a pixel.", "1/pixel", ge=1, le=65536)] = 16
