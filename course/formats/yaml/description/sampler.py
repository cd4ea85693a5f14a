"""`sampler`: how many samples a pixel takes, and in what pattern."""

from __future__ import annotations

from typing import Annotated, Final, Literal

from course.formats.yaml.description.values import Map, about

MOST_SAMPLES: Final = 65536
"""Samples of a pixel."""


class SamplerDescription(Map, frozen=True, kw_only=True):
    """The pattern of samples; `regular` and `jittered` need a square number of them."""

    type: Annotated[
        Literal[
            "sobol", "random", "jittered", "regular", "halton", "hammersley", "chained", "xorshift"
        ],
        about("Pattern of the samples."),
    ] = "sobol"
    samples: Annotated[int, about("Samples a pixel.", "1/pixel", ge=1, le=MOST_SAMPLES)] = 16
