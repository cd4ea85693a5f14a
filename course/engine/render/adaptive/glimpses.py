"""Small bright things that are seen directly: how likely a sample of each pixel meets them.

Points are drawn on what shines, on the lens and in time, and each is put into the pixel through which it is seen. So a
lamp out of focus covers its circle of confusion, and a spark in flight its way. A pixel of which a thing covers much
finds it by its first samples; only what no pixel is sure to find is looked at any further, by rays that say where it is
hidden.
"""

import math
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Indices
from course.engine.render.adaptive.bright import EVEN, Bright
from course.engine.render.adaptive.seen_ahead import CameraAxes, nearest
from course.engine.terms.world import FullWorld

SKETCH, FEWEST, MOST, ALL = 1024, 64, 16384, 65536
"""Points of a thing that are put into pixels at first, of many things at least; then at most; and of all things."""

FOUND = ((0.25, 2.0), (0.02, 8.0))
"""A thing is found soon if it covers so much of each pixel that sees it, and so many pixels in all: then the first
samples meet it dozens of times, and those next to them tell the others."""

MOSTLY = 0.7
"""Of a thing that lies in such pixels."""

UNIMPORTANT = 0.5
"""Of the variance that is aimed at, what the first samples may leave of all things that aren't looked at."""

FIRST = 4
"""Samples that a pixel has at least before it is decided on."""

LARGE = 256.0
"""A picture of so many pixels is found wherever it is."""

EACH = 8
"""Points in a pixel, about; where there are fewer, chances are averaged over more pixels."""


@dataclass(frozen=True)
class Chances:
    """What samples of each pixel may find, and how much it matters.

    Attributes
    ----------
    mean, square : (H, W) float64: the chance of a sample to find something times its radiance, and times its square
    rays : that were sent to know it
    """

    mean: Floats64
    square: Floats64
    rays: int = 0

    def __add__(self, other: "Chances") -> "Chances":
        return Chances(self.mean + other.mean, self.square + other.square, self.rays + other.rays)

    @classmethod
    def none(cls, height: int, width: int) -> "Chances":
        """Of a picture in which there is nothing to be found."""
        return cls(np.zeros((height, width)), np.zeros((height, width)))


def glimpses(
    world: FullWorld, view: CameraAxes, things: list[Bright], parts: Indices, target: float
) -> Chances:
    """The chances of all things that are seen directly; those are left out that every sketch finds.

    ``target``: mean variance that the picture shall have
    """
    result = Chances.none(view.height, view.width)
    sketch = int(np.clip(ALL // max(len(things), 1), FEWEST, SKETCH))
    small = []
    for thing in things:
        pixel, chance = put(world, view, thing, sketch, None)
        seen = float(chance.sum())
        if 0 < seen < LARGE and not is_found(_sums(pixel, chance)):
            small.append((thing, len(np.unique(pixel)), seen * thing.square))
    kept = important(np.array([left for _, _, left in small]), target * view.height * view.width)
    small = [small[number] for number in kept]
    for thing, pixels, _ in small:
        count = int(np.clip(EACH * pixels, sketch, min(MOST, ALL // len(small) + FEWEST)))
        pixel, chance = put(world, view, thing, count, parts)
        share = np.minimum(averaged(pixel, chance, result.mean.shape), 1)
        root = float(np.sqrt(thing.square))
        result += Chances(share * root, share * thing.square, count)
    return result


def put(
    world: FullWorld, view: CameraAxes, thing: Bright, count: int, parts: Indices | None
) -> tuple[Indices, Floats64]:
    """Pixels (n,) that see points of a thing, and the share of each that a point stands for.

    ``parts`` (T,): rays are sent to see which points are hidden; None for none
    """
    u = (np.arange(1, count + 1).astype(np.float64) * EVEN[:, None] + 0.5) % 1
    # One number more than the sequence has; of another one, whose steps are the golden ratio's.
    time = np.arange(1, count + 1).astype(np.float64) * 0.6180339887498949 % 1
    points, normals, triangles = thing.points(world, u[:2])
    eyes, on_lens = view.eyes(u[2:], time)
    way = points + thing.velocity[:, None] * time - eyes
    places, forwards, seen = view.pixels(way, on_lens)
    far = np.sqrt((way * way).sum(axis=0))
    facing = -(way * normals).sum(axis=0) / np.maximum(far, 1e-300)
    lit = np.maximum(facing, 0) if thing.fronts else np.abs(facing)
    chance = thing.area / count * lit / (np.maximum(far, 1e-300) ** 2 * forwards**3 * view.pixel)
    which = np.flatnonzero(seen & (lit > 0))
    if parts is not None and len(which):
        found = nearest(world, eyes[:, which], way[:, which], time[which]).triangle
        same = (found == triangles[which]) | (
            (facing[which] > 0) & (found >= 0) & (parts.take(found) == thing.part)
        )
        which = which[same]
    x, y = np.floor(places[:, which]).astype(np.intp)
    return y * view.width + x, chance[which]


def important(variances: Floats64, target: float) -> Indices:
    """Which of some things, by the variances (n,) of a sample of each, are looked at, so that the rest is unimportant.

    ``target``: variance of all pixels together
    """
    order = np.argsort(variances, kind="stable")
    left = np.cumsum(variances[order]) / FIRST
    return np.sort(order[left > UNIMPORTANT * target])


def is_found(shares: Floats64) -> bool:
    """Whether the first samples are sure to find a thing, by the share of it in each pixel that it covers (n,)."""
    seen = float(shares.sum())
    return any(
        seen > pixels and float(shares[shares > covered].sum()) > MOSTLY * seen
        for covered, pixels in FOUND
    )


def _sums(pixel: Indices, chance: Floats64) -> Floats64:
    """Sums of chances (n,) in each pixel that has any."""
    _, place = np.unique(pixel, return_inverse=True)
    return _binned(place, chance)


def _binned(place: Indices, values: Floats64, least: int = 0) -> Floats64:
    return np.bincount(place, values, least).astype(np.float64)


def averaged(pixel: Indices, chance: Floats64, shape: tuple[int, ...]) -> Floats64:
    """Sums (H, W) of chances (n,) in pixels (n,), averaged over squares of pixels where a pixel has few points."""
    share: Floats64 = _binned(pixel, chance, math.prod(shape)).reshape(shape)
    side = int(np.ceil(np.sqrt(EACH * len(np.unique(pixel)) / max(len(pixel), 1)))) | 1
    for _ in range(2 if side > 1 else 0):
        padded = np.pad(share, ((side // 2, side // 2), (0, 0)))
        rows = [padded[row : row + len(share)] for row in range(side)]
        share = np.asarray(np.sum(rows, axis=0), np.float64).T / side
    return share
