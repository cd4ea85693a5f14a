"""Fields in which noise leaves no trace but a difference of two pictures does: brightness, movement, sharpness.

A picture that is moved differs by its gradient, a blurred one by its Laplacian, and one that is brighter by itself. So
the difference of two pictures is multiplied by what their mean looks like, and divided by the noise around; sums of
that are 0 but for noise, if the pictures are the same. What a pixel's mean looks like is taken from its neighbours
alone: with its own value, noise would be multiplied by itself.

Beside an edge the four neighbours of a pixel have the same mean as it would have on either side. There the pixels along
the edge say on which side it lies: those across it less those along it are the Laplacian, too.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.engine.comparing.noise import DifferenceNoise, Strip
from course.engine.comparing.windows import Field
from course.engine.core.types import Floats64

COLOURS = ("red", "green", "blue")
KINDS = (
    *(*COLOURS, "moved across", "moved down", "blurred", "blurred"),
    *("alike across", "alike down"),
)
"""The last two are made of the first (`course.engine.comparing.windows.alike`)."""

SURE = 1.0
"""What a slope's square must exceed its variance by: slopes of noise are none of the picture."""

SLOPE_VARIANCE = 0.125
"""Of a slope of the pictures' mean, in parts of the difference's variance; by the weights below."""

NOWHERE = 1e-300
"""Squared slope of an edge that has no direction."""


@dataclass(frozen=True)
class Slopes:
    """Of the mean of two pictures, (H, W, 3) each, 0 where noise hides it.

    Attributes
    ----------
    across, down : to the right, and down
    edges : the Laplacian beside edges
    laplacian : the same by what is around, too
    """

    across: Floats64
    down: Floats64
    edges: Floats64
    laplacian: Floats64


def slopes_of(mean: Floats64, noise: DifferenceNoise) -> Slopes:
    """By the pixels around each, and not by itself; 0 where some of these lie beyond the border."""
    padded = np.pad(mean, ((2, 2), (2, 2), (0, 0)), constant_values=np.nan)

    def at(down: int, across: int) -> Floats64:
        height, width = mean.shape[:2]
        values: Floats64 = padded[2 + down :, 2 + across :][:height, :width]
        return values

    near = at(0, 1) + at(0, -1) + at(1, 0) + at(-1, 0)
    far = at(0, 2) + at(0, -2) + at(2, 0) + at(-2, 0)
    edges = _across_edges(at) / 2

    def sure(slope: Floats64, sums: int = 1) -> Floats64:
        variance = sums * SURE * SLOPE_VARIANCE * noise.size**2
        slope = np.where(np.isnan(slope), 0.0, slope)
        kept = np.maximum(slope**2 - variance, 0) / np.maximum(np.abs(slope), 1e-150)
        return np.copysign(kept, slope)

    return Slopes(
        across=sure((at(0, 1) - at(0, -1)) / 2),
        down=sure((at(1, 0) - at(-1, 0)) / 2),
        edges=sure(edges, 2),
        laplacian=sure((far - near) / 4 + edges, 2),
    )


def _across_edges(at: Callable[[int, int], Floats64]) -> Floats64:
    """Second difference across the edge at each pixel less that along it, by its eight neighbours.

    Of u(x)^2 / 2, a parabola along any direction, it is 1.
    """
    corners = at(1, 1), at(-1, -1), at(1, -1), at(-1, 1)
    falling, rising = corners[0] + corners[1], corners[2] + corners[3]
    across = at(0, 1) - at(0, -1) + (corners[0] - corners[1] + corners[3] - corners[2]) / 2
    down = at(1, 0) - at(-1, 0) + (corners[0] - corners[1] + corners[2] - corners[3]) / 2
    square = np.maximum(across**2 + down**2, NOWHERE)
    straight = at(0, 1) + at(0, -1) - at(1, 0) - at(-1, 0)
    # By the cosine and the sine of twice the angle of the slope.
    turned: Floats64 = (across**2 - down**2) * straight + across * down * (falling - rising)
    turned /= square
    return turned


def fields_of(
    part: Strip, noise: DifferenceNoise, rounding: Floats64, own_blur: float
) -> list[Field]:
    """Those of ``KINDS`` but the last two.

    ``rounding``: by what differences may be off (H, W, 3); ``own_blur``: as `course.engine.comparing.noise.Level`
    has it.
    """
    counted = part.usable[..., None] * ((np.abs(part.d) > rounding) | (rounding == 0))
    slopes = slopes_of((part.a + part.b) / 2, noise)
    squares = noise.size**2
    even = counted / noise.size
    fields = [
        _field(part.d, even, noise, rounding, slice(channel, channel + 1)) for channel in range(3)
    ]
    for slope, own in (
        (slopes.across, 0.0),
        (slopes.down, 0.0),
        (slopes.edges, own_blur),
        (slopes.laplacian, own_blur),
    ):
        field = _field(part.d, slope / squares * counted, noise, rounding, slice(3))
        field.off[:] += own * (counted * (slope != 0)).sum(axis=2)
        fields.append(field)
    return fields


def _field(
    d: Floats64, weight: Floats64, noise: DifferenceNoise, rounding: Floats64, channels: slice
) -> Field:
    weight = weight[..., channels]
    size = np.abs(weight)
    return Field(
        values=(weight * d[..., channels]).sum(axis=2),
        squares=(size * np.sqrt(noise.known[..., channels])).sum(axis=2) ** 2,
        off=(size * rounding[..., channels]).sum(axis=2),
    )
