"""A mean over neighbours that Welch's test doesn't separate, whose functions are those of the module `denoising`.

Sakai et al., "A statistical approach to Monte Carlo denoising", 2024. The film keeps mean and variance of each pixel's
samples; when the picture is complete, all pixels within a disk of neighbours are tested against its centre.
"""

from dataclasses import dataclass
from math import ceil, sqrt
from typing import Any

import numpy as np

from course.engine.core.film import Film
from course.engine.core.tiles import Tile
from course.engine.core.types import Floats32, Floats64, Functions
from course.engine.functions.effects import Bound
from course.engine.functions.modules import COURSE

REACH = 2.0
"""Radius of the disk in standard deviations of its Gaussian."""

PAIRS = 1 << 18
"""Pairs of pixels that are tested at once: arrays of 3 MB."""

_INVERSE = np.linspace(1e-6, 1, 513, dtype=np.float32)
"""1 / degrees of freedom at which critical values are asked for; between them they are interpolated."""


def functions(bound: Bound) -> Functions:
    """The module's functions; they are noted down."""
    return bound.functions("denoising", *COURSE["denoising"], asked_by=("film", "denoise"))


class MomentsFilm(Film):
    """A film that has mean and variance of each pixel's samples, and may have a denoised preview.

    Attributes
    ----------
    preview : (3, H, W) float32 linear radiance that a PNG shows; None before it is made
    mean : (3, H, W) of all samples so far
    """

    def __init__(self, width: int, height: int) -> None:
        super().__init__(width, height)
        self.preview: Floats32 | None = None
        self.mean = np.zeros((3, height, width))
        self._squares = np.zeros((3, height, width))

    def add(
        self, tile: Tile, mean: Floats32, weight: Floats32 | float, samples: int, summed: bool
    ) -> None:
        """See ``Film``; ``mean`` (3, n * s) has each of a pass's samples, those of a pixel next to each other."""
        each = mean.reshape(3, tile.height, tile.width, -1).astype(np.float64)
        added, place = each.shape[3], (slice(None), tile.rows, tile.columns)
        own = each.mean(axis=3)
        super().add(tile, own.reshape(3, -1).astype(np.float32), float(added), samples, summed)
        # Two groups of samples together: Chan, Golub and LeVeque, 1983.
        apart = own - self.mean[place]
        self.mean[place] += apart * (added / samples)
        self._squares[place] += ((each - own[..., None]) ** 2).sum(axis=3)
        self._squares[place] += apart**2 * ((samples - added) * added / samples)

    @property
    def variance(self) -> Floats64:
        """(3, H, W) sample variance [radiance^2]; 0 where a pixel has less than two samples."""
        return self._squares / np.maximum(self.samples - 1, 1)

    def denoise(self, denoising: Functions, level: float, sigma: float) -> dict[str, float]:
        """Make the preview.

        Parameters
        ----------
        level : probability that equal pixels are separated in a channel
        sigma : of the Gaussian over the neighbours [pixels]

        Returns
        -------
        dict of str to float
            "neighbours" that a pixel is averaged with on average, and the estimated root-mean-square "noise" of the
            picture before, "left" after, and "bias" [radiance].
        """
        pictures = _Moments(
            self.mean.reshape(3, -1).astype(np.float32),
            self.variance.reshape(3, -1).astype(np.float32),
            np.maximum(self.samples, 2).ravel().astype(np.float32),
            (self.samples >= 2).ravel(),
        )
        x, y, distance = _disk(sigma)
        critical = denoising.critical_value(1 / _INVERSE, level)
        found, sums = np.empty_like(pictures.mean), np.zeros(4)
        v = pictures.variance / pictures.count
        band = max(PAIRS // len(x), 1)
        for first in range(0, self.width * self.height, band):
            pixels = np.arange(first, min(first + band, self.width * self.height))
            row, column = np.divmod(pixels[:, None], self.width)
            inside = (row + y >= 0) & (row + y < self.height)
            inside &= (column + x >= 0) & (column + x < self.width)
            others = np.where(inside, (row + y) * self.width + column + x, pixels[:, None])
            chosen = inside & (pictures.tested[others] & pictures.tested[pixels, None])
            # The pixel itself comes first.
            chosen[:, 0] = True
            weights = _weights(denoising, pictures, pixels, others, critical, distance, sigma)
            weights *= chosen
            mean, left = denoising.weighted_mean(pictures.mean[:, others], v[:, others], weights)
            share = weights[:, 0] / weights.sum(axis=1)
            own = pictures.mean[:, pixels], v[:, pixels]
            squared = denoising.squared_bias(mean, left, *own, share)
            found[:, pixels] = mean
            sums += (
                float((weights > 0).sum()) - len(pixels),
                *(float(each.mean(axis=0, dtype=np.float64).sum()) for each in (own[1], left)),
                float(squared.mean(axis=0, dtype=np.float64).sum()),
            )
        self.preview = found.reshape(3, self.height, self.width)
        joined, noise, left, bias = (sums / (self.width * self.height)).tolist()
        return {
            "neighbours": joined,
            "noise": sqrt(noise),
            # A student's variance may be negative.
            "left": sqrt(max(left, 0.0)),
            "bias": sqrt(max(bias, 0.0)),
        }


@dataclass(frozen=True)
class _Moments:
    """Of all pixels: mean and sample variance (3, n), number of samples (n,), and whether there are two or more."""

    mean: Floats32
    variance: Floats32
    count: Floats32
    tested: Any


def _disk(sigma: float) -> tuple[Any, Any, Floats32]:
    """Columns, rows and distances of the pixels within the disk from its centre, the nearest first."""
    reach = ceil(REACH * sigma)
    y, x = (each.ravel() for each in np.mgrid[-reach : reach + 1, -reach : reach + 1])
    distance = np.hypot(x, y).astype(np.float32)
    order = np.argsort(distance, kind="stable")
    order = order[distance[order] <= REACH * sigma]
    return x[order], y[order], distance[order]


def _weights(
    denoising: Functions,
    moments: _Moments,
    pixels: Any,
    others: Any,
    critical: Floats32,
    distance: Floats32,
    sigma: float,
) -> Floats32:
    """Weights (n, k) of n pixels and k neighbours of each."""
    shape = others.shape
    own, other = np.repeat(pixels, shape[1]), others.ravel()
    a, b = (
        (moments.mean[:, at], moments.variance[:, at], moments.count[at]) for at in (own, other)
    )
    t = denoising.welch_t(*a, *b)
    # Only their ratio counts, and squares of small ones would be 0.
    unit = np.maximum(a[1], b[1])
    unit[unit == 0] = 1
    degrees = denoising.degrees_of_freedom(a[1] / unit, a[2], b[1] / unit, b[2])
    limits = np.interp(1 / degrees, _INVERSE, critical).astype(np.float32)
    apart = np.tile(distance, shape[0])
    return np.array(denoising.pair_weights(t, limits, apart, sigma)).reshape(shape)
