"""`film`: the picture's size and how samples become pixels."""

from __future__ import annotations

from typing import Annotated, Final, Literal, TypeAlias

import msgspec

from course.formats.yaml.description.values import Map, about

LARGEST_SIDE: Final = 65536
"""Pixels along one side of a picture."""

_Positive: TypeAlias = Annotated[float, msgspec.Meta(gt=0)]


class SubdivisionDescription(Map, frozen=True, kw_only=True):
    """Adaptive supersampling by contrast: rays through the corners of pixels, more where corners differ."""

    threshold: Annotated[
        float,
        about(
            "Cells with two corners that differ by more than this in some channel are divided into four.",
            "radiance",
            ge=0,
        ),
    ] = 0.1
    depth: Annotated[
        int,
        about(
            "How many times a pixel may be divided: its smallest cells are 1 / 2^depth wide.",
            ge=0,
            le=8,
        ),
    ] = 3


class FilmDescription(Map, frozen=True, kw_only=True):
    """Size of the picture and its reconstruction filter."""

    width: Annotated[int, about("Width of the picture.", "pixel", ge=1, le=LARGEST_SIDE)] = 640
    height: Annotated[int, about("Height of the picture.", "pixel", ge=1, le=LARGEST_SIDE)] = 480
    filter: Annotated[
        Literal["box", "gaussian"], about("How the samples of a pixel are weighted.")
    ] = "box"
    error: Annotated[
        _Positive | None,
        about(
            "Sample until the root-mean-square error of the whole picture is estimated to be this; a"
            " radiance of 1 is white. sampler.samples is the most that a pixel takes on average.",
            "radiance",
        ),
    ] = None
    subdivision: Annotated[
        SubdivisionDescription | None,
        about(
            "Rays through the corners of pixels instead of samples within them, and more where corners differ."
            " sampler.samples is the number of rays through each corner."
        ),
    ] = None
    white: Annotated[
        float, about("What a PNG shows as white, and anything brighter too.", "radiance", gt=0)
    ] = 1.0
    encoding: Annotated[
        Literal["srgb", "linear"],
        about(
            "Codes of a PNG: the nearest ones of the sRGB curve, or in proportion to the radiance and rounded down."
        ),
    ] = "srgb"
    sigma: Annotated[float, about("Standard deviation of the gaussian filter.", "pixel", gt=0)] = (
        1 / 6
    )
