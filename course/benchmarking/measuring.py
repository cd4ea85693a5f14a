"""Measure a module: render its references, then every estimator at every number of samples, in turn."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from course.benchmarking.curves import Converged, Curve
from course.benchmarking.errors import dissimilarity, relative_mse, rmse
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.references import FOLDER, Reference, reference
from course.engine.core.types import Floats64
from course.engine.functions.effects import Effects
from course.engine.loops.embree_device import available
from course.engine.render.render import render
from course.engine.scene.scene import Scene, load_variant

Tick = Callable[[float], None]
"""Called with the share of a module's work that is done."""


@dataclass(frozen=True)
class Effort:
    """The extent of a measurement.

    Attributes
    ----------
    name : for the reports
    height : pixels; the width follows from the scene's
    samples : a pixel, square numbers; an estimator that takes k points on a light with each takes at most 4 / k of
        the last
    seeds : how many
    reference : samples a pixel of the references
    """

    name: str
    height: int
    samples: tuple[int, ...]
    seeds: int
    reference: int


FULL = Effort("full", 80, (1, 4, 16, 64, 256, 1024), 4, 8192)
QUICK = Effort("quick", 48, (1, 4, 16, 64), 3, 2048)


@dataclass(frozen=True)
class Measured:
    """The measurements of one module.

    Attributes
    ----------
    size : (width, height) [pixels]
    curves : one for each estimator
    """

    module: Module
    size: tuple[int, int]
    curves: tuple[Curve, ...]

    @property
    def references(self) -> dict[str, Converged]:
        """Integral -> its reference."""
        return {curve.estimator.integral: curve.reference for curve in self.curves}

    def group(self, name: str) -> list[Curve]:
        """The curves of one comparison."""
        return [curve for curve in self.curves if name in curve.estimator.groups]

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "module": self.module.name,
            "scene": self.module.scene.name,
            "size": list(self.size),
            "references": {name: vars(r) for name, r in self.references.items()},
            "estimators": [curve.to_dict() for curve in self.curves],
        }


def measure(
    module: Module,
    estimators: tuple[Estimator, ...],
    effort: Effort,
    *,
    folder: Path = FOLDER,
    tick: Tick | None = None,
) -> Measured:
    """Measure some estimators of a module.

    For each seed and number of samples all estimators are rendered before the next, so that whatever else the machine
    does meets them alike. Times are of these same renders, with all threads, without loading the scene, and with the
    compiled loops if they are installed.

    Parameters
    ----------
    folder : of the references
    tick : called when a reference or a picture is done

    Raises
    ------
    CourseError
        As `course.load_scene` and `reference` do.
    KeyboardInterrupt
        Ctrl-C.
    """
    effects = Effects()
    scenes = {
        _key(each): load_variant(module.scene, each.overrides, effects) for each in estimators
    }
    film = next(iter(scenes.values())).loaded.description.film
    size = (max(round(effort.height * film.width / film.height), 1), effort.height)
    integrals = {each.integral: each.reference for each in estimators}
    steps = sum(sum(_samples(each, effort)) * each.points for each in estimators)
    everything = len(integrals) * effort.reference + steps * effort.seeds
    done = 0

    def work(samples: int) -> None:
        nonlocal done
        done += samples
        if tick is not None:
            tick(done / everything)

    references = {}
    for integral, overrides in integrals.items():
        references[integral] = reference(
            module.scene,
            samples=effort.reference,
            size=size,
            folder=folder,
            overrides=overrides,
            effects=effects,
        )
        work(effort.reference)
    for scene in scenes.values():
        # Embree's tree is built, tables are made, loops are compiled.
        render(scene, spp=1, size=size, compiled=available())
    records = [
        _Record(
            each,
            scenes[_key(each)],
            references[each.integral],
            _samples(each, effort),
            effort.seeds,
        )
        for each in estimators
    ]
    for seed in range(1, effort.seeds + 1):
        for samples in effort.samples:
            for record in records:
                if samples in record.samples:
                    record.add(samples, size, seed)
                    work(samples * record.estimator.points)
    return Measured(module, size, tuple(record.curve() for record in records))


def _samples(estimator: Estimator, effort: Effort) -> tuple[int, ...]:
    return tuple(n for n in effort.samples if n * estimator.points <= 4 * effort.samples[-1])


def _key(estimator: Estimator) -> str:
    """Estimators with the same overrides share a scene."""
    return repr(estimator.overrides)


class _Record:
    """The measurements of one estimator as they come in."""

    def __init__(
        self,
        estimator: Estimator,
        scene: Scene,
        ideal: Reference,
        samples: tuple[int, ...],
        seeds: int,
    ) -> None:
        self.estimator, self.samples = estimator, samples
        self._scene, self._ideal, self._seeds = scene, ideal, seeds
        self._values = {
            name: np.full((len(samples), seeds), np.nan)
            for name in ("mse", "relative_mse", "dissimilarity", "seconds")
        }
        self._sum: dict[int, Floats64] = {}
        self._squares: dict[int, Floats64] = {}

    def add(self, samples: int, size: tuple[int, int], seed: int) -> None:
        # Always or never: left to itself, a render decides by what was rendered before.
        picture = render(
            self._scene,
            spp=samples,
            size=size,
            sampler=self.estimator.sampler,
            seed=seed,
            compiled=available(),
        )
        if picture.interrupted:
            raise KeyboardInterrupt
        linear, ideal = picture.linear.astype(np.float64), self._ideal.linear
        at = self.samples.index(samples), seed - 1
        self._values["mse"][at] = rmse(linear, ideal) ** 2
        self._values["relative_mse"][at] = relative_mse(linear, ideal)
        self._values["dissimilarity"][at] = dissimilarity(linear, ideal)
        self._values["seconds"][at] = picture.receipt.wall_seconds
        self._sum[samples] = self._sum.get(samples, 0) + linear
        self._squares[samples] = self._squares.get(samples, 0) + linear**2

    def curve(self) -> Curve:
        ideal = self._ideal
        return Curve(
            self.estimator,
            Converged(ideal.key, ideal.error, ideal.samples),
            np.array(self.samples, np.float64),
            bias=np.array([self._bias(samples) for samples in self.samples]),
            **self._values,
        )

    def _bias(self, samples: int) -> float:
        """RMSE of the expected picture: the mean picture's, less the variance of the mean and of the reference."""
        if self._seeds < 2:
            return float("nan")
        mean = self._sum[samples] / self._seeds
        variance = np.maximum(self._squares[samples] / self._seeds - mean**2, 0)
        noise = float(np.mean(variance)) / (self._seeds - 1) + self._ideal.error**2
        squared = float(np.mean((mean - self._ideal.linear) ** 2)) - noise
        return math.sqrt(max(squared, 0.0))
