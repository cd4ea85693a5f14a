"""What the difference of two pictures says of their noise: its size around a pixel, whose it is, who shares it.

Nothing here looks at the pixel itself: a weight that hangs on the pixel's own noise would make a sum of differences
lean to one side wherever one picture is noisier and its noise skewed.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Mask

AROUND, OWN = 9, 3
"""Pixels along the side of the square around a pixel that tells its noise, and of its middle, left out."""

LEAST = 0.1
"""Noise that a pixel has at least, in parts of the median: a weight can't be arbitrarily large."""

FARTHER = 33
"""Pixels along the side of the square that tells it where one picture is noisier: rare light may be missing nearer."""

APART = 2.5
"""Ratio of two pictures' variances from which on they count as unequally noisy."""

MOST = 1e4
"""The same at most."""

DIRECT = 5
"""Largest side of squares whose pixels are added anew for each: beside what is bright, a running sum is rounded."""

ALIKE = 0.9
"""Correlation of neighbours at most."""

SQUARE = 8
"""Pixels along the side of the squares that tell the correlation."""


@dataclass(frozen=True)
class Strip:
    """Some rows of two pictures; (H, W, 3), and ``usable`` (H, W).

    ``d``: difference a - b of usable pixels, else 0
    """

    a: Floats64
    b: Floats64
    d: Floats64
    usable: Mask


@dataclass(frozen=True)
class Level:
    """Of the noise of two whole pictures.

    Attributes
    ----------
    least : noise that a pixel has at least
    quieter : 0 or 1, the picture with less noise
    ratio : of the other's variance to its; 0 if they are about equal
    shared : correlation of neighbours
    """

    least: float
    quieter: int
    ratio: float
    shared: float

    @property
    def inflation(self) -> float:
        """By what the variance of a sum over many pixels exceeds that of independent ones."""
        return float(np.sum(self.shared ** (np.arange(-8, 9.0) ** 2)) ** 2)

    @property
    def own_blur(self) -> float:
        """How blurred, or sharp, noise is by itself, in parts of its variance, where one picture has nearly all of it.

        Neighbours share a pixel's noise, and those farther off less: half of the difference of both is the covariance
        of a pixel with the Laplacian of the pictures' mean. Of Laplacians of normal noise only those that are large
        are kept, and they share twice as much at most.
        """
        return self.shared - self.shared**4


@dataclass(frozen=True)
class DifferenceNoise:
    """Of the difference of two pictures, (H, W, 3) each.

    Attributes
    ----------
    size : root-mean-square difference around each pixel; above 0
    known : variance that a pixel must have by the noise of the quieter picture there, and the ratio of both pictures'
        variances elsewhere; 0 where they are equally noisy. Light that is rare in few samples is missing in most pixels
        of a picture, whose differences then show no noise.
    """

    size: Floats64
    known: Floats64


def level_of(parts: Sequence[Strip]) -> Level:
    """By some parts of two pictures."""
    sizes = [_around(part)[part.usable] for part in parts]
    some = np.concatenate([size[size > 0] for size in sizes])
    least = LEAST * float(np.median(some)) if some.size else 1.0
    quieter, ratio = _unequal(parts)
    found = shared_by_neighbours([part.d.mean(axis=2) for part in parts])
    return Level(max(least, 1e-300), quieter, ratio, found)


def noise_of(part: Strip, level: Level) -> DifferenceNoise:
    """Around each pixel of a part; those at its border lack neighbours."""
    known = np.zeros_like(part.d)
    if level.ratio:
        by_quieter = _of_one(_energies(part), level.quieter) * (1 + level.ratio)
        known = np.maximum(by_quieter, box(part.d**2, FARTHER, "mirror"))
    return DifferenceNoise(np.sqrt(_around(part) ** 2 + level.least**2), known)


def box(values: Floats64, side: int, beyond: str = "constant") -> Floats64:
    """Mean over the square around each pixel of (H, W, ...); beyond the border is 0, or a mirror."""
    from scipy.ndimage import correlate1d, uniform_filter

    if side > DIRECT:
        mean: Floats64 = uniform_filter(values, side, mode=beyond, axes=(0, 1))
        return mean
    weights = np.full(side, 1 / side)
    for axis in (0, 1):
        values = correlate1d(values, weights, axis, mode=beyond)
    return values


def ring(values: Floats64, around: int = AROUND, own: int = OWN) -> Floats64:
    """Mean over the square around each pixel of (H, W, ...), without its middle."""
    total = box(values, around) * around**2 - box(values, own) * own**2
    mean: Floats64 = np.maximum(total, 0) / (around**2 - own**2)
    return mean


def _around(part: Strip) -> Floats64:
    """Root-mean-square difference around each pixel (H, W, 3)."""
    count = np.maximum(ring(part.usable.astype(np.float64)), 1e-9)[..., None]
    size: Floats64 = np.sqrt(ring(part.d**2) / count)
    return size


def _energies(part: Strip) -> tuple[Floats64, ...]:
    """Mean squares of what is fine in a, b and a - b around each pixel, (H, W, 3) each."""
    weight = part.usable[..., None]
    return tuple(box(_fine(one) ** 2 * weight, AROUND) for one in (part.a, part.b, part.d))


def _of_one(energies: tuple[Floats64, ...], picture: int) -> Floats64:
    """Variance of one picture's noise: half of the difference's, and of what it has more than the other.

    What both show alike is no noise, and left out so.
    """
    both = energies[2] + energies[picture] - energies[1 - picture]
    of_one: Floats64 = np.maximum(both, 0) / 2
    return of_one


def _unequal(parts: Sequence[Strip]) -> tuple[int, float]:
    """The quieter picture, and the ratio of the other's variance to its."""
    found = [_energies(part) for part in parts]
    energies = tuple(np.concatenate([one[k].ravel() for one in found]) for k in range(3))
    # Of a sum over the picture a few fireflies would be the most.
    kept = energies[2] <= np.quantile(energies[2], 0.95)
    sums = [float(_of_one(energies, k)[kept].sum()) for k in (0, 1)]
    quieter = int(np.argmin(sums))
    if sums[1 - quieter] <= APART * sums[quieter]:
        return quieter, 0.0
    return quieter, min(sums[1 - quieter] / max(sums[quieter], 1e-300), MOST)


def _fine(values: Floats64) -> Floats64:
    """What a pixel (H, W, 3) exceeds its four neighbours by; of independent noise it has the variance."""
    padded = np.pad(values, ((1, 1), (1, 1), (0, 0)), mode="reflect")
    four = padded[:-2, 1:-1] + padded[2:, 1:-1] + padded[1:-1, :-2] + padded[1:-1, 2:]
    fine: Floats64 = (values - four / 4) / np.sqrt(1.25)
    return fine


def shared_by_neighbours(differences: Sequence[Floats64]) -> float:
    """Correlation of the noise of pixels side by side, which share samples, by differences (H, W) each.

    A filter's correlation falls off as a Gaussian, r at a distance of one pixel and r^(h^2) at h. Second differences at
    distances of 1 and 2 have the variances 6 - 8 r + 2 r^4 and 6 - 8 r^4 + 2 r^16, and of what differs smoothly they
    know little. The median over squares isn't moved by a few that differ.
    """
    ratios = [_ratios(np.moveaxis(d, axis, 0)) for axis in (0, 1) for d in differences]
    of_all = np.concatenate(ratios)
    if not of_all.size:
        return 0.0
    r = np.linspace(0, ALIKE, 901)
    expected = (6 - 8 * r + 2 * r**4) / (6 - 8 * r**4 + 2 * r**16)
    return float(r[np.abs(expected - np.median(of_all)).argmin()])


def _ratios(d: Floats64) -> Floats64:
    """Squares of second differences at a distance of 1 over those at 2, down the rows, for each square of pixels."""
    near, far = ((d[: -2 * step] - 2 * d[step:-step] + d[2 * step :]) ** 2 for step in (1, 2))
    height, width = (size // SQUARE * SQUARE for size in far.shape)
    shape = height // SQUARE, SQUARE, width // SQUARE, SQUARE
    sums = [one[:height, :width].reshape(shape).sum((1, 3)) for one in (near[1:-1], far)]
    seen = (sums[0] > 0) & (sums[1] > 0)
    ratios: Floats64 = sums[0][seen] / sums[1][seen]
    return ratios
