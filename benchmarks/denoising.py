"""Where denoising helps and where it loses: errors against a converged picture, what the filter says of them itself,
and how often Welch's test separates pixels that are equal.

Two renders of a scene with other seeds have equal pixels: each pixel of the one is tested against itself in the other.
With independent samples that many channels are separated as the level says; with Sobol's points fewer.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from math import hypot
from typing import Any

import numpy as np

from benchmarks.figures import Figure
from benchmarks.report import report
from benchmarks.ways import REFERENCES
from course import Scene, render
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.references import reference
from course.benchmarking.tables import Table
from course.engine.core.types import Floats64, Functions
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT, Bound, Effects
from course.engine.scene.scene import load_variant
from course.engine.terms.denoising import MomentsFilm, functions

SCENE = PROJECT / "scenes" / "denoising.yaml"
SAMPLERS = {"random": "random", "sobol": "Sobol"}
FLOOR = 7 / 8
"""From this share of the rows on the picture shows nothing but tiles."""

WHOLE = {"as rendered": "rendered", "denoised": "denoised", "as the filter says": "after"}
TILES = {"as rendered": "floor_rendered", "denoised": "floor_denoised"}

COLUMNS = ("sampler, samples", "as rendered", "denoised", "says before", "says after", "worse")
COLUMNS += ("floor", "floor, denoised", "separated")


@dataclass(frozen=True)
class Effort:
    """Size of the pictures, samples of the converged one, those that are compared, and pairs of seeds."""

    size: tuple[int, int] = (160, 160)
    reference: int = 4096
    samples: tuple[int, ...] = (4, 16, 64, 256)
    pairs: int = 1


@dataclass(frozen=True)
class Measured:
    """Of one sampler and number of samples: root-mean-square errors [radiance], and shares.

    Attributes
    ----------
    rendered, denoised : of the whole picture
    noise, after : what the filter says of them: noise before, and noise and bias after
    worse : pixels that it moved away from the converged ones
    floor_rendered, floor_denoised : of the tiles
    separated : channels of equal pixels that the test separates
    """

    rendered: float
    denoised: float
    noise: float
    after: float
    worse: float
    floor_rendered: float
    floor_denoised: float
    separated: float


def measure_denoising() -> list[Figure]:
    """Measure, print and draw."""
    effort = Effort()
    parts: dict[str, Overrides] = {
        "scene": {},
        "direct": {("integrator", "type"): "distribution"},
    }
    titles = {"scene": "all light, as in the scene", "direct": "direct light alone"}
    found = {name: measure(changes, effort) for name, changes in parts.items()}
    width, height = effort.size
    report(
        "denoising",
        f"{width} x {height} pixels, {2 * effort.pairs} seeds",
        [table(measured, titles[name]) for name, measured in found.items()],
        [
            *(errors(name, measured, titles[name], WHOLE) for name, measured in found.items()),
            errors("floor", found["direct"], "the tiles of the floor, direct light alone", TILES),
            levels(found, titles),
        ],
    )
    return []


def measure(changes: Overrides, effort: Effort) -> dict[tuple[str, int], Measured]:
    """By sampler and samples."""
    plain = {**changes, ("film", "denoise"): None}
    ideal = reference(
        SCENE, samples=effort.reference, size=effort.size, folder=REFERENCES, overrides=plain
    )
    exact = np.moveaxis(ideal.linear.astype(np.float64), 2, 0)
    scene = load_variant(SCENE, changes)
    denoising = functions(Bound(Effects()))
    return {
        (sampler, samples): _measured(scene, sampler, samples, exact, denoising, effort)
        for sampler in SAMPLERS
        for samples in effort.samples
    }


def _measured(
    scene: Scene,
    sampler: str,
    samples: int,
    exact: Floats64,
    denoising: Functions,
    effort: Effort,
) -> Measured:
    rows, floor = [], slice(int(FLOOR * exact.shape[1]), None)
    for pair in range(effort.pairs):
        pictures = [
            render(scene, spp=samples, size=effort.size, sampler=sampler, seed=2 * pair + seed)
            for seed in range(2)
        ]
        apart = _separated([picture.film for picture in pictures], denoising, scene)
        for picture in pictures:
            told = picture.receipt.denoising
            assert told is not None
            before = picture.film.linear - exact
            after = picture.shown - exact
            moved_away = (after**2).sum(axis=0) > (before**2).sum(axis=0)
            rows.append(
                (
                    *(_rms(error) for error in (before, after)),
                    told["noise"],
                    hypot(told["left"], told["bias"]),
                    float(moved_away.mean()),
                    *(_rms(error[:, floor]) for error in (before, after)),
                    apart,
                )
            )
    return Measured(*np.mean(rows, axis=0).tolist())


def _rms(error: Any) -> float:
    return float(np.sqrt(np.mean(np.asarray(error, np.float64) ** 2)))


def _separated(films: list[Any], denoising: Functions, scene: Scene) -> float:
    """The share of channels that the test separates between equal pixels of two films."""
    rule = scene.settings.denoise
    assert rule is not None
    parts: list[Floats64] = []
    for film in films:
        assert isinstance(film, MomentsFilm)
        parts += [
            film.mean.reshape(3, -1),
            film.variance.reshape(3, -1),
            film.samples.ravel().astype(float),
        ]
    t = denoising.welch_t(*parts)
    degrees = denoising.degrees_of_freedom(*parts[1:3], *parts[4:])
    limits = denoising.critical_value(degrees.ravel(), rule.level).reshape(t.shape)
    return float((np.abs(t) > limits).mean())


def table(found: Mapping[tuple[str, int], Measured], title: str) -> Table:
    """A row for each sampler and number of samples."""
    rows = tuple(
        (
            f"{SAMPLERS[sampler]}, {samples}",
            f"{one.rendered:.4f}",
            f"{one.denoised:.4f}",
            f"{one.noise:.4f}",
            f"{one.after:.4f}",
            f"{one.worse:.0%}",
            f"{one.floor_rendered:.4f}",
            f"{one.floor_denoised:.4f}",
            f"{one.separated:.1%}",
        )
        for (sampler, samples), one in found.items()
    )
    return Table(f"{title}: RMSE", COLUMNS, rows)


def errors(
    name: str, found: Mapping[tuple[str, int], Measured], title: str, kinds: Mapping[str, str]
) -> Plot:
    """Errors over samples."""
    lines = [
        _line(f"{said}, {label}", number, found, sampler, kind)
        for number, ((sampler, said), (label, kind)) in enumerate(
            product(SAMPLERS.items(), kinds.items())
        )
    ]
    return Plot(name, title, {"samples": "samples for each pixel"}, "RMSE", tuple(lines))


def levels(
    found: Mapping[str, Mapping[tuple[str, int], Measured]], titles: Mapping[str, str]
) -> Plot:
    """Shares of equal pixels that are separated."""
    lines = [
        _line(f"{said}, {titles[name]}", 2 * k + j, measured, sampler, "separated")
        for k, (name, measured) in enumerate(found.items())
        for j, (sampler, said) in enumerate(SAMPLERS.items())
    ]
    axes = {"samples": "samples for each pixel"}
    title = "channels of equal pixels that the test separates"
    # A logarithmic axis has no place for none, and one point is no line.
    drawn = tuple(line for line in lines if sum(share > 0 for share in line.y) > 1)
    return Plot("separated", title, axes, "share", drawn, slope=False)


def _line(
    name: str, style: int, found: Mapping[tuple[str, int], Measured], sampler: str, kind: str
) -> Series:
    samples = tuple(each for by, each in found if by == sampler)
    values = tuple(float(getattr(found[sampler, each], kind)) for each in samples)
    return Series(name, style, {"samples": samples}, values)
