"""What `--error` takes beside an oracle that knows the variance of every pixel: the six effects, at three errors.

The oracle's variances come from uniform pictures by other seeds, against a converged one. How the variance falls with
the samples is one curve for all pixels; how large it is, is each pixel's own. Half of the seeds choose where the
oracle's samples go and the other half judges what that leaves, so it doesn't gain by chance.

What ours takes over what the oracle takes is a product of three: `audits`, all samples over those in the picture;
`placement`, these over what the oracle needs for the error that was reached; `stopping`, what it needs for that over
what it needs for the error that was asked for. Samples are counted, and what they cost
(`course.engine.render.adaptive.costs`): ours places them by cost.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.figures import Figure
from benchmarks.reached_error import CASES, error_of
from course import Picture, Scene, render
from course.benchmarking.references import Reference, reference
from course.benchmarking.tables import Table, print_tables
from course.engine.render.adaptive.allocation import FIRST_OF_NET
from course.engine.render.adaptive.film import AdaptiveFilm
from course.engine.scene.scene import load_variant

Array = NDArray[np.float64]
SCENES = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
ASKED = (24, 64, 128)
"""Uniform samples whose errors are asked for."""

STEPS = (4, 8, 16, 32, 64, 128)
"""Uniform samples by which the oracle learns; beyond them the error falls as it does in the last two doublings."""

GOAL = 1.25
OTHER_SEEDS = 100


@dataclass(frozen=True)
class Effort:
    """Height of the pictures [pixels], seeds of ours and of the oracle, samples of references."""

    height: int = 120
    seeds: int = 2
    others: int = 6
    reference: int = 4096


class Oracle:
    """Knows the variances of all pixels.

    Parameters
    ----------
    variance : (2, len(STEPS), P) squared errors of pixels, means over either half of the seeds
    own : squared error of the reference, which they have in them
    cost : (P,) of a sample
    """

    def __init__(self, variance: Array, own: float, cost: Array) -> None:
        mean = np.maximum(variance.mean(axis=(0, 2)) - own, 1e-30)
        self._steps, self._mean = np.log(STEPS), np.log(mean)
        self.order = float((self._mean[-3] - self._mean[-1]) / (2 * np.log(4)))
        self._level = (variance / mean[:, None])[:, 1:].mean(axis=1)
        self._cost = cost / cost.mean()

    def variance(self, samples: Array) -> Array:
        """Of the mean pixel, of any shape."""
        x = np.log(samples)
        beyond = np.maximum(x - self._steps[-1], 0)
        within: Array = np.interp(x, self._steps, self._mean) - 2 * self.order * beyond
        return np.exp(within)

    def uniform(self, error: float) -> float:
        """Samples that every pixel alike needs for an error."""
        samples = np.geomspace(STEPS[0], 1e5, 500)
        return _at(error**2, self.variance(samples), samples)

    def needs(self, error: float, by_cost: bool) -> float:
        """Mean samples of a pixel that the oracle needs for an error, or what they cost."""
        cost = self._cost if by_cost else np.ones_like(self._cost)
        points = np.array([self._point(k, cost) for k in np.geomspace(1, 4096, 80)])
        return _at(error**2, points[:, 0], points[:, 1])

    def spent(self, samples: Array) -> float:
        """What samples (P,) cost, a pixel."""
        return float((samples * self._cost).mean())

    def _point(self, k: float, cost: Array) -> tuple[float, float]:
        """Squared error left and what was spent, a pixel, with k (level / cost)^(1 / (2a + 1)) samples each."""
        left = spent = 0.0
        for chooses, judges in (self._level, self._level[::-1]):
            # What has never differed may still do so a little.
            level = np.maximum(chooses, 0.005 * chooses.mean())
            n = np.maximum(k * (level / cost) ** (1 / (2 * self.order + 1)), FIRST_OF_NET)
            left += float((judges * self.variance(n)).mean()) / 2
            spent += float((n * cost).mean()) / 2
        return left, spent


@dataclass(frozen=True)
class Beside:
    """Ours beside the oracle, geometric means over seeds, for a scene and the error of so many uniform samples.

    ``gain``, ``ours``: uniform samples over the oracle's for the error asked for, and over ours for the one reached.
    ``audits``, ``placement``, ``stopping``: see above; ``paid``, ``placement_paid`` by cost, the first in all.
    """

    scene: str
    samples: int
    gain: float
    ours: float
    audits: float
    placement: float
    stopping: float
    paid: float
    placement_paid: float
    reached: float

    @property
    def taken(self) -> float:
        """Samples that ours takes over the oracle's."""
        return self.audits * self.placement * self.stopping


def measure_oracle() -> list[Figure]:
    """Print a table; figures are what ours costs over what the oracle's samples cost."""
    found = [one for name in SCENES for one in measure(name, Effort())]
    print_tables([table(found)])
    return [
        Figure(f"{one.scene}, error of {one.samples}: cost, ours / oracle", *(one.paid,) * 3, GOAL)
        for one in found
    ]


def measure(name: str, effort: Effort) -> list[Beside]:
    """One scene at all errors."""
    path, overrides = CASES[name]
    scene = load_variant(path, overrides)
    settings = scene.settings
    size = max(effort.height * settings.width // settings.height, 1), effort.height
    ideal = reference(path, samples=effort.reference, size=size, overrides=overrides)
    squares = squared_errors(scene, ideal, size, effort.others)
    # Costs are the scene's, whatever the error.
    first = render(scene, size=size, error=1e9, seed=OTHER_SEEDS, sampler="sobol")
    oracle = Oracle(squares, ideal.error**2, _film(first).cost.reshape(-1).astype(np.float64))
    return [_beside(scene, size, oracle, ideal, samples, effort.seeds) for samples in ASKED]


def squared_errors(scene: Scene, ideal: Reference, size: tuple[int, int], seeds: int) -> Array:
    """(2, len(STEPS), P) squared errors of uniform pictures, by either half of the seeds."""
    found = np.zeros((2, len(STEPS), size[0] * size[1]))
    for seed in range(seeds):
        for step, samples in enumerate(STEPS):
            picture = render(
                scene, size=size, spp=samples, seed=OTHER_SEEDS + seed, sampler="sobol"
            )
            off = picture.linear.astype(np.float64) - ideal.linear
            found[seed % 2, step] += (off**2).mean(axis=2).ravel() / (seeds / 2)
    return found


def _beside(
    scene: Scene,
    size: tuple[int, int],
    oracle: Oracle,
    ideal: Reference,
    samples: int,
    seeds: int,
) -> Beside:
    asked = float(np.sqrt(oracle.variance(np.array(float(samples)))))
    rows = []
    for seed in range(1, seeds + 1):
        picture = render(scene, size=size, error=asked, spp=4096, seed=seed, sampler="sobol")
        film, reached = _film(picture), error_of(picture, ideal)
        have = film.samples.reshape(-1).astype(np.float64)
        audited = film.audited / len(have)
        needed, paid = (oracle.needs(reached, by_cost) for by_cost in (False, True))
        rows.append(
            (
                samples / oracle.needs(asked, False),
                oracle.uniform(reached) / (have.mean() + audited),
                1 + audited / have.mean(),
                have.mean() / needed,
                needed / oracle.needs(asked, False),
                (oracle.spent(have) + audited) / oracle.needs(asked, True),
                oracle.spent(have) / paid,
                reached / asked,
            )
        )
    means = np.exp(np.log(rows).mean(axis=0)).tolist()
    return Beside(scene.loaded.path.stem, samples, *means)


def _film(picture: Picture) -> AdaptiveFilm:
    assert isinstance(picture.film, AdaptiveFilm)
    return picture.film


def _at(value: float, falling: Array, rising: Array) -> float:
    """What of ``rising`` belongs to a value of ``falling``, by logarithms."""
    return float(np.exp(np.interp(-np.log(value), -np.log(falling), np.log(rising))))


def table(found: list[Beside]) -> Table:
    """A row for each scene and error."""
    columns = (
        *("scene", "error of", "uniform / oracle", "uniform / ours", "ours / oracle"),
        *("audits", "placement", "stopping", "by cost", "placement by cost", "reached / asked"),
    )
    rows = tuple(
        (
            one.scene,
            str(one.samples),
            *(f"{x:.2f}" for x in (one.gain, one.ours, one.taken, one.audits, one.placement)),
            *(f"{x:.2f}" for x in (one.stopping, one.paid, one.placement_paid, one.reached)),
        )
        for one in found
    )
    return Table("Samples of --error beside an oracle's", columns, rows)
