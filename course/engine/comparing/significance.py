"""Are two pictures the same but for noise? Signed sums of their difference in windows of many sizes, and spots.

How noisy a pixel is nobody says, and its neighbour may be a hundred times as noisy. But if both pictures have the same
mean, noise makes a pixel of the first brighter as often as darker. So what is tested are signs: whether they agree in
a window more than chance allows (``course.engine.comparing.windows``), be they those of the difference itself, or of
its product with the picture's slopes, which a movement or a blur turns all one way
(``course.engine.comparing.fields``). Windows have all sizes from 8 pixels to the whole picture; for movements along
them, rows and columns are windows, too (``course.engine.comparing.lines``). What is smaller is found by how it stands
out (``course.engine.comparing.spots``).

p-values are corrected for the numbers of windows, sizes, fields and shapes of spots (Bonferroni).
"""

from dataclasses import dataclass

import numpy as np

from course.engine.comparing.fields import COLOURS, KINDS, fields_of
from course.engine.comparing.lines import Lines
from course.engine.comparing.noise import Level, level_of, noise_of
from course.engine.comparing.one_sign import of_one_sign
from course.engine.comparing.one_sign import p_value as p_of_signs
from course.engine.comparing.pair import Pair, pair_of
from course.engine.comparing.patches import Even, evenest, largest_t
from course.engine.comparing.spots import SHAPES, Spot, most_different_spot, standing_out, usual
from course.engine.comparing.windows import Grid, Window, alike, largest_sums
from course.engine.core.types import Floats32, Floats64, Mask

SIGNIFICANCE = 1e-4
"""Share of pairs of equal pictures that may be called different."""

SPOT, SIGNS = "spot", "one sign"
"""Kinds of a difference in a few pixels, and in many cells; the others are ``course.engine.comparing.fields.KINDS``."""


@dataclass(frozen=True)
class Finding:
    """One kind of difference where it is most significant among places of one size.

    Attributes
    ----------
    kind : of ``KINDS``, ``SPOT`` or ``SIGNS``
    p_value : how often noise alone would show as much, or more, in any place, kind and size
    t : sum over standard error, with its sign; 0 for the last two
    whole : whether the place is the whole picture
    """

    kind: str
    p_value: float
    t: float
    place: Window
    whole: bool


@dataclass(frozen=True)
class Comparison:
    """The result of a comparison of two pictures a and b.

    Attributes
    ----------
    found : every kind in every size, the most significant first
    mean_difference : of a - b, over usable pixels, for red, green and blue [radiance]
    mean : of both pictures there
    rmse : root-mean-square difference, over usable pixels and channels [radiance]
    differing : share of the usable pixels that are not equal
    largest : the largest difference a - b of one pixel and channel [radiance], and the pixel's column and row
    pair : the pictures, as they were compared
    level : of their noise
    """

    found: tuple[Finding, ...]
    mean_difference: tuple[float, float, float]
    mean: tuple[float, float, float]
    rmse: float
    differing: float
    largest: tuple[float, int, int]
    pair: Pair
    level: Level

    @property
    def p_value(self) -> float:
        """How often noise alone would show as much, or more."""
        return self.found[0].p_value

    @property
    def coded(self) -> bool:
        """Whether the pictures were compared as 8 bits show them."""
        return self.pair.coded

    @property
    def clipped(self) -> float:
        """Share of the pixels that were left out, for they or a neighbour are cut off at white."""
        return 1 - float(self.pair.usable.mean())

    def least(self, *kinds: str) -> Finding:
        """The most significant of some kinds."""
        return next(one for one in self.found if one.kind in kinds)


def compare(a: Floats32, b: Floats32, coded: tuple[bool, bool] = (False, False)) -> Comparison:
    """Test the hypothesis that two independent pictures have the same mean.

    Raises CourseError: the pictures differ in size, or too little of them is left to compare.

    Parameters
    ----------
    a, b : (H, W, 3) float32, linear
    coded : whether each comes from a file that is cut off at white. Where one does and has 8 bits, the other is encoded
        and decoded likewise.
    """
    pair = pair_of(a, b, coded)
    grid = Grid.over(*pair.usable.shape)
    some = pair.sample()
    level, normal = level_of(some), usual(some)
    z = np.zeros((len(SHAPES), *pair.usable.shape))
    cells, lines = list[Floats64](), Lines()
    patches: list[list[tuple[float, int, int]]] = []
    signs: list[Mask] = []
    for part, own, rows in pair.strips(grid):
        noise, rounding = noise_of(part, level), pair.rounding(part)
        fields = fields_of(part, noise, rounding, level.own_blur)
        strip = grid.strip(rows)
        cells.append(np.stack([field.cells(own, strip) for field in fields]))
        lines.add(fields, own)
        signs.append(of_one_sign(part.d, rounding, own, strip))
        upper = rows.start - own.start
        of_strip = largest_t(part, own, noise, rounding, level.least)
        patches.append([(t, row + upper, column) for t, row, column in of_strip])
        z[:, rows] = [one[own] for one in standing_out(part, normal)]
    summed = np.concatenate(cells, axis=2)
    summed = np.concatenate((summed, alike(summed[: len(COLOURS)], level.inflation)))
    # Noise that is spread evenly makes neighbours unlike.
    positive = [number for number, kind in enumerate(KINDS) if kind.startswith("alike")]
    sums = [
        *largest_sums(summed, grid, level.inflation, positive),
        *lines.largest(level.inflation),
    ]
    spots: list[Spot | Even] = [
        *(most_different_spot(of_shape, shape) for of_shape, shape in zip(z, SHAPES, strict=True)),
        *evenest(patches, 3 * pair.usable.size, level.inflation),
    ]
    height, width = pair.usable.shape
    whole = Window(0, 0, width, height)
    # What is rare in few samples is missing in many pixels, all of one sign.
    p_signs = 1.0 if level.ratio else p_of_signs(np.concatenate(signs), level.inflation)
    # A third of the false alarms may be due to windows, to spots, and to cells of one sign.
    found = [
        Finding(SIGNS, min(1.0, 3 * p_signs), 0.0, whole, True),
        *(
            Finding(
                KINDS[one.field], min(1.0, 3 * len(sums) * one.p_value), one.t, one.place, one.whole
            )
            for one in sums
        ),
        *(
            Finding(SPOT, min(1.0, 3 * len(spots) * one.p_value), 0.0, one.place, False)
            for one in spots
        ),
    ]
    found.sort(key=lambda one: (one.p_value, -abs(one.t)))
    return _told(tuple(found), pair, level)


def _told(found: tuple[Finding, ...], pair: Pair, level: Level) -> Comparison:
    """With what else is told of the difference."""
    a, b = (one[pair.usable] for one in (pair.a, pair.b))
    d = a - b
    means, both = (one.mean(axis=0, dtype=np.float64) for one in (d, 0.5 * a + 0.5 * b))
    worst, channel = np.unravel_index(int(np.abs(d).argmax()), d.shape)
    rows, columns = np.nonzero(pair.usable)
    return Comparison(
        found=found,
        mean_difference=tuple(means.tolist()),
        mean=tuple(both.tolist()),
        rmse=float(np.sqrt(np.square(d, dtype=np.float64).mean())),
        differing=float((d != 0).any(axis=1).mean()),
        largest=(float(d[worst, channel]), int(columns[worst]), int(rows[worst])),
        pair=pair,
        level=level,
    )
