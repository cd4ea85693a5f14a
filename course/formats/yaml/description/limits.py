"""`limits`: how large the files may be that a scene names."""

from __future__ import annotations

from typing import Annotated

from course.formats.yaml.description.values import Map, about
from course.inputs import LARGEST_DATA, MOST_PIXELS


class LimitsDescription(Map, frozen=True, kw_only=True):
    """The largest meshes and pictures that are read; larger ones are refused before they take memory."""

    bytes: Annotated[int, about("Most bytes of a mesh or picture file.", ge=1, le=2**50)] = (
        LARGEST_DATA
    )
    pixels: Annotated[
        int,
        about(
            "Most pixels of a picture. Each takes 12 bytes as linear light, and up to 6 more while the file is read.",
            "pixel",
            ge=1,
            le=2**50,
        ),
    ] = MOST_PIXELS
