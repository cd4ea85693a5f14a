"""A film whose pixels have different numbers of samples, and which knows about how wrong each of them still is."""

import math

import numpy as np

from course.engine.core.tiles import Area
from course.engine.core.types import Floats32, Floats64, Indices
from course.engine.render.adaptive.pixel_groups import TwinGroup
from course.engine.render.adaptive.prior import Prior
from course.engine.render.adaptive.smoothing import Guide, smoothed
from course.engine.render.adaptive.unseen_edges import unseen_edges
from course.engine.render.adaptive.variance import INDEPENDENT, measured_order, variance_share

PARTS = 4
"""Parts into which the samples of a stretch are divided, to be compared with each other."""

NEARLY_NOTHING = np.float32(1e-30)
"""As in ``Film``: the weight of a mean whose own weights vanish."""

FARTHEST_APART = np.float32(1e28)
"""Squared differences beyond it count as this, so that sums of many, times their samples, stay within float32."""


class AdaptiveFilm:
    """A picture in the making, with an estimate of its error.

    A pixel's variance is the mean over the three channels of the squared standard error of its colour. It is estimated
    anew with each stretch of samples, from how far its quarters, its halves, and the stretch and the samples before it
    are apart, and mixed with what was estimated before.

    Parameters
    ----------
    width, height : pixels
    net : samples are points of a net, whose order of convergence is measured; that of independent ones is known
    prior : what is known of some pixels before they have samples; None where there is nothing to be known
    """

    def __init__(
        self, width: int, height: int, net: bool = True, prior: Prior | None = None
    ) -> None:
        self.width = width
        self.height = height
        self._net = net
        self._prior = prior
        pixels = width * height
        self.linear = np.zeros((3, height, width), np.float32)
        """(3, H, W) linear radiance, valid where samples have been added."""
        self.samples = np.zeros((height, width), np.int32)
        """(H, W) samples behind each pixel."""
        self.variance = np.zeros((height, width), np.float32)
        """(H, W) estimated variance of each pixel [radiance^2]."""
        self.cost = np.ones((height, width), np.float32)
        """(H, W) what a sample of each pixel has cost on average, in any unit."""
        self.order = INDEPENDENT
        """Order of convergence, as measured in the last round."""
        self._sums = np.zeros((pixels, 4))
        self._halves = np.zeros(pixels, np.float32)
        self._quarters = np.zeros(pixels, np.float32)
        self._begun = False
        self._spread = 1.0
        self.correction = 1.0
        """By what audits multiply the variance of the whole picture."""
        self.doubt = 0.0
        """Variance of the logarithm of ``correction`` after the last audit."""
        self.judged = 0.0
        """Mean variance that the last audit corrected [radiance^2]; 0 before the first."""
        self.audited = 0
        """Samples that audits have taken, which are not in the picture."""
        self._edges: tuple[Indices, Floats32] = np.empty(0, np.intp), np.empty(0, np.float32)
        self._twins: dict[int, tuple[Indices, Floats64, Floats32]] = {}

    def add(
        self, group: Area, mean: Floats32, weight: Floats32 | float, samples: int, summed: bool
    ) -> None:
        """Add one stretch of samples of some pixels.

        Groups that are added between two calls of ``end_round`` have no pixel in common.

        Parameters
        ----------
        mean : (4, n * PARTS) float32, the parts of each pixel next to each other: colours, and what a sample of the
            pixel cost
        weight : (n * PARTS,) float32 or one number
        samples : how many samples of each pixel the picture holds with this stretch
        summed : false for a preview without parts, (3, n), which later stretches replace
        """
        if isinstance(group, TwinGroup):
            self._add_twins(group, mean, weight, samples)
            return
        which = group.pixel_numbers(self.width).astype(np.intp)
        if not summed:
            self.linear.reshape(3, -1)[:, which] = mean
            return
        self._add_stretch(which, mean, weight, samples)

    def _add_stretch(
        self, which: Indices, mean: Floats32, weight: Floats32 | float, samples: int
    ) -> None:
        compared = _Compared(mean, weight, len(which))
        stretch = compared.stretch
        self._halves[which] = compared.of_halves
        self._quarters[which] = compared.of_quarters
        earlier = self._sums.take(which, axis=0)
        before = int(self.samples.reshape(-1)[which[0]])
        shares = shares_of(before, samples, self.order)
        estimate = compared.estimate(shares)
        if before:
            estimate += _apart(earlier.T.astype(np.float32), stretch) * shares[2]
            estimate += self.variance.reshape(-1).take(which) * shares[3]
        share = np.float32((samples - before) / samples)
        cost = self.cost.reshape(-1)
        cost[which] += share * (mean[3, ::PARTS] - cost.take(which))
        total = earlier + stretch.T
        self._sums[which] = total
        self.linear.reshape(3, -1)[:, which] = (total[:, :3] / total[:, 3:]).T
        self.variance.reshape(-1)[which] = estimate * shares[4]
        self.samples.reshape(-1)[which] = samples

    def _add_twins(
        self, group: TwinGroup, mean: Floats32, weight: Floats32 | float, samples: int
    ) -> None:
        compared = _Compared(mean, weight, group.size)
        shares = shares_of(0, samples, self.order)
        stretch, estimate = compared.stretch.astype(np.float64), compared.estimate(shares)
        self._twins[group.number] = group.pixels, stretch[:3] / stretch[3], estimate * shares[4]

    def twins_apart(self, pixels: Indices) -> tuple[Floats64, Floats64]:
        """Squared differences (n,) of pixels (n,) from their second pictures, and the estimated variances of these.

        All of them were added since the last call, in `course.engine.render.adaptive.pixel_groups.TwinGroup`, and are
        forgotten then.
        """
        twins = np.zeros((4, self.width * self.height))
        for which, colours, variance in self._twins.values():
            twins[:3, which] = colours
            twins[3, which] = variance
        self._twins.clear()
        difference = self.linear.reshape(3, -1)[:, pixels] - twins[:3, pixels]
        squared: Floats64 = (difference * difference).mean(axis=0)
        return np.minimum(squared, float(FARTHEST_APART)), twins[3, pixels]

    @property
    def error(self) -> float:
        """Estimated root-mean-square error of the whole picture [radiance]."""
        return math.sqrt(self.correction * self.told)

    @property
    def told(self) -> float:
        """Mean of the variances of all pixels, each with its neighbours, before what audits correct [radiance^2].

        Where rare light was found, pixels next to it have found nothing yet, and have more of the error than they tell.
        """
        believed = self.believed
        return self._surplus(believed) * self._spread * float(believed.mean(dtype=np.float64))

    @property
    def surplus(self) -> float:
        """What is told over the mean variance, 1 or more: some for chance, where few pixels have all of the error.

        The squared error of so few is often several times what is expected. If k pixels that have a prior have all of
        it, 1 + 2 / k: with one, the error is more than twice what is told once in 2000 times, and without it in 20.
        """
        return self._surplus(self.believed)

    def _surplus(self, believed: Floats32) -> float:
        if self._prior is None:
            return 1.0
        few = believed.reshape(-1)[self._prior.pixels].astype(np.float64)
        whole = float(believed.sum(dtype=np.float64))
        return 1 + 2 * float((few * few).sum()) / whole**2 if len(few) and whole else 1.0

    @property
    def told_by_samples(self) -> float:
        """As ``told``, without the pixels that have a prior."""
        return self._spread * float(self.unforeseen.mean(dtype=np.float64))

    @property
    def believed(self) -> Floats32:
        """(H, W) variance of each pixel, by what is known before it has samples and by edges it may have missed, too.

        These are divided by what others are multiplied with: audits judge those alone.
        """
        (foreseen, known), (pixels, lacking) = self._known(), self._lacking()
        if not len(foreseen) and not len(pixels):
            return self.variance
        result = self.variance.copy()
        by_all = self.correction * self._spread
        result.reshape(-1)[foreseen] = known / by_all
        result.reshape(-1)[pixels] += lacking / by_all
        return result

    def _known(self) -> tuple[Indices, Floats64]:
        """Pixels (m,) whose prior is in force, and their variances (m,) by it."""
        if self._prior is None:
            return np.empty(0, np.intp), np.empty(0)
        some = self._prior.in_force(self.samples)
        return self._prior.pixels[some], self._prior.believed(self.variance, self.samples)[some]

    def _lacking(self) -> tuple[Indices, Floats32]:
        """Pixels (m,) beside which an edge may be unseen, and what that adds to their variance (m,).

        Of no use to an audit: a second picture would hardly see it either.
        """
        pixels, unit = self._edges
        n = np.maximum(self.samples.reshape(-1)[pixels], 1).astype(np.float32)
        return pixels, unit / (n * n)

    @property
    def foreseen(self) -> Indices:
        """(m,) the pixels that have a prior in force: the others tell their error by themselves, and to audits."""
        if self._prior is None:
            return np.empty(0, np.intp)
        return self._prior.pixels[self._prior.in_force(self.samples)]

    @property
    def unforeseen(self) -> Floats32:
        """(H, W) estimated variance of the pixels that have no prior, 0 of the others."""
        if not len(self.foreseen):
            return self.variance
        result = self.variance.copy()
        result.reshape(-1)[self.foreseen] = 0
        return result

    @property
    def concentrated(self) -> float:
        """How many pixels have the error, effectively: sum(v)^2 / sum(v^2), and all of them where there is none.

        Pixels that have a prior don't count: it is known where they are.
        """
        v = self.unforeseen.astype(np.float64)
        squares = float((v * v).sum())
        return float(v.sum()) ** 2 / squares if squares else float(v.size)

    @property
    def uniform_samples(self) -> float:
        """Samples per pixel with which uniform sampling would have had the same error, by the same estimates."""
        if self.error == 0:
            return float(self.samples.max(initial=0))
        exponent = 2 * self.order
        unit = self.believed * self.samples.astype(np.float64) ** exponent
        return float((self.correction * unit.mean() / self.error**2) ** (1 / exponent))

    def end_round(self) -> tuple[Floats32, Floats32]:
        """Take stock of the stretches that were added since the last call: the order of convergence, and what is told.

        Only parts of one stretch are compared: which pixels got it was decided before, by other samples, so no
        selection makes these differences smaller or larger than they are.

        Returns
        -------
        tuple of array
            Variances and costs (H, W) of pixels that learn from their neighbours (``smoothing``).
        """
        order = INDEPENDENT
        if self._net:
            # Of all pixels in their order, so that the sums don't depend on how they were divided into groups.
            of_halves = float(self._halves.sum(dtype=np.float64))
            quarters = self._quarters.astype(np.float64)
            of_quarters, squares = float(quarters.sum()), float((quarters * quarters).sum())
            order = measured_order(of_halves, of_quarters, of_quarters**2 / (squares or 1.0))
        self._halves[:] = self._quarters[:] = 0
        if not self._begun:
            # The first estimates were made with the order of independent samples. With order a the quarters and the
            # halves both say V = D r^2 / (4 (1 - r)), r = 2^-2a, D the squared difference of the quarters.
            r = 2.0 ** (-2 * order)
            self.variance *= np.float32(r * r / (4 * (1 - r)) / (0.0625 + 0.125 * r))
            self._begun = True
        self.order = order
        variance, cost = self._smoothed(order, self._without_finds())
        if self._prior is not None:
            pixels = self._prior.pixels
            variance.reshape(-1)[pixels] = self.unforeseen.reshape(-1)[pixels]
        own = float(self.unforeseen.sum(dtype=np.float64))
        self._spread = float(variance.sum(dtype=np.float64)) / own if own else 1.0
        foreseen, known = self._known()
        variance.reshape(-1)[foreseen] = known / self.correction
        self._edges = unseen_edges(self.linear, self.variance, self.samples)
        pixels, lacking = self._lacking()
        variance.reshape(-1)[pixels] += lacking / self.correction
        return variance, cost

    def _without_finds(self) -> Floats32:
        """(H, W) variances of pixels as if none had found what it has a prior for: those around learn nothing of it."""
        if self._prior is None:
            return self.variance
        result = self.variance.copy()
        result.reshape(-1)[self._prior.pixels] = self._prior.others(self.variance, self.samples)
        return result

    def _smoothed(self, order: float, variance: Floats32) -> tuple[Floats32, Floats32]:
        """Variances and costs (H, W) that learn from their neighbours."""
        guide = Guide(self.linear, variance)
        variance = smoothed(variance, self.samples, order, guide)
        return variance, smoothed(self.cost, self.samples, 0, guide)


class _Compared:
    """A stretch of n pixels whose parts are held against each other.

    Attributes
    ----------
    stretch : (4, n) float32 r w, g w, b w and w
    of_halves, of_quarters : (n,) float32 squared differences
    """

    def __init__(self, mean: Floats32, weight: Floats32 | float, n: int) -> None:
        parts = np.empty((4, n, PARTS), np.float32)
        parts[:3] = mean[:3].reshape(3, n, PARTS)
        parts[3] = np.reshape(weight, (n, PARTS)) if np.ndim(weight) else weight
        np.maximum(parts[3], NEARLY_NOTHING, out=parts[3])
        parts[:3] *= parts[3]
        halves = parts[:, :, 0::2] + parts[:, :, 1::2]
        self.stretch: Floats32 = halves[:, :, 0] + halves[:, :, 1]
        self.of_quarters = _apart(parts[:, :, 0], parts[:, :, 1])
        self.of_quarters += _apart(parts[:, :, 2], parts[:, :, 3])
        self.of_quarters *= np.float32(0.5)
        self.of_halves = _apart(halves[:, :, 0], halves[:, :, 1])

    def estimate(self, shares: Floats32) -> Floats32:
        """By halves and quarters, (n,) float32; see ``shares_of``."""
        variance: Floats32 = self.of_quarters * shares[0] + self.of_halves * shares[1]
        return variance


def shares_of(before: int, samples: int, order: float) -> Floats32:
    """By what each thing that tells the variance of a mean is multiplied, and then their sum: (5,) float32.

    The things are the squared differences of the quarters and of the halves of the last stretch, that of the stretch
    and the samples before it, which counts twice, and the variance of these.

    Parameters
    ----------
    before : samples before the stretch; the third and fourth share are 0 where there are none
    """
    quarter = (samples - before) // PARTS
    shares = [variance_share(n, n, samples, order) for n in (quarter, 2 * quarter)]
    if not before:
        return np.array((*shares, 0, 0, 1 / 2), np.float32)
    since = variance_share(before, samples - before, samples, order)
    return np.array((*shares, 2 * since, (before / samples) ** (2 * order), 1 / 5), np.float32)


def _apart(a: Floats32, b: Floats32) -> Floats32:
    """Squared difference (n,) of two means, averaged over the channels; rows of a and b are r w, g w, b w and w."""
    difference = a[:3] / a[3] - b[:3] / b[3]
    squared: Floats32 = np.einsum("cn,cn->n", difference, difference)
    squared *= np.float32(1 / 3)
    # The squares of the brightest lights overflow float32.
    return np.minimum(squared, FARTHEST_APART, out=squared)
