"""Where five samplers put a picture's error: RMSE, error seen from afar, spectra; at equal samples and in equal time.

All render the scene of `blue_noise` with one thread, and times are seconds of the processor. Errors are of the mean of
the three channels against one picture with many samples; spectra are divided by the mean square of the error, so white
noise has 1 at every frequency.
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import process_time

import numpy as np

from benchmarks.figures import Figure
from benchmarks.report import report
from course import load_scene, render
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import Columns, Table, digits, table_of
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT, Effects

SAMPLERS = {
    "independent": "random",
    "jittered": "jittered",
    "Sobol": "sobol",
    "dithered": "dithered",
    "blue noise": "blue_noise",
}
"""What each is called -> its name in scene files."""

COUNTS = (1, 4, 16)
SPECTRUM = 4
"""Samples a pixel at which spectra are measured."""

SEEDS = 8
SIZE = (300, 200)
CONVERGED = 8192
SIGMA = 1.5
"""Width of the blur [pixels]."""

BINS = 24

MODULE = Effects(PROJECT / "solutions")
perceptual_rmse = MODULE.function("blue_noise", "perceptual_rmse")
radial_spectrum = MODULE.function("blue_noise", "radial_spectrum")


@dataclass(frozen=True)
class Found:
    """What was measured of a sampler.

    Attributes
    ----------
    rmse, seen, seconds : (counts,)
    spectrum : (BINS,) at SPECTRUM samples
    """

    name: str
    rmse: Floats64
    seen: Floats64
    seconds: Floats64
    spectrum: Floats64


def measure_blue_noise() -> list[Figure]:
    """Measure, print and draw the curves; the ratios with the range of what single seeds give."""
    scene = load_scene(PROJECT / "scenes" / "blue_noise.yaml")

    def picture(sampler: str, samples: int, seed: int, threads: int = 1) -> Floats64:
        made = render(
            scene, spp=samples, size=SIZE, sampler=sampler, seed=seed, threads=threads
        ).linear
        return made.mean(axis=2, dtype=np.float64)

    converged = picture("sobol", CONVERGED, 1000, 2)
    squares = np.empty((len(SAMPLERS), len(COUNTS), SEEDS))
    seen, seconds = np.empty_like(squares), np.empty_like(squares)
    spectra = np.zeros((len(SAMPLERS), BINS))
    for row, sampler in enumerate(SAMPLERS.values()):
        picture(sampler, 1, 0)
        for column, samples in enumerate(COUNTS):
            for seed in range(SEEDS):
                started = process_time()
                made = picture(sampler, samples, seed)
                seconds[row, column, seed] = process_time() - started
                error = made - converged
                squares[row, column, seed] = (error**2).mean()
                seen[row, column, seed] = perceptual_rmse(error, SIGMA) ** 2
                if samples == SPECTRUM:
                    spectra[row] += radial_spectrum(error, BINS)
    found = [
        Found(
            name,
            np.sqrt(squares[row].mean(axis=1)),
            np.sqrt(seen[row].mean(axis=1)),
            np.median(seconds[row], axis=1),
            spectra[row] / squares[row, COUNTS.index(SPECTRUM)].sum(),
        )
        for row, name in enumerate(SAMPLERS)
    ]
    about = f"{SIZE[0]} x {SIZE[1]} pixels, {SEEDS} seeds, blur of {SIGMA} pixels"
    report("blue_noise", about, [table(found)], plots(found))
    return [figure for name in list(SAMPLERS)[:3] for figure in ratios(name, squares, seen, found)]


def ratios(other: str, squares: Floats64, seen: Floats64, found: list[Found]) -> list[Figure]:
    """Errors of another sampler over those of blue noise, at equal samples and at equal time."""
    rows = list(SAMPLERS)
    one, two = rows.index(other), rows.index("blue noise")
    at = COUNTS.index(SPECTRUM)
    figures = []
    for what, values, goal in (("RMSE", squares, 1.0), ("error seen from afar", seen, 1.5)):
        each = np.sqrt(values[one, at] / values[two, at])
        name = f"blue_noise: {what} at {SPECTRUM} samples, {other} / blue noise"
        figures.append(Figure(name, *_range(each), goal, at_least=True))
    # What the other one leaves in the time of blue noise, along its own line through counts.
    own, its = found[two], found[one]
    left = np.exp(np.interp(np.log(own.seconds[at]), np.log(its.seconds), np.log(its.seen)))
    each = left / np.sqrt(seen[two, at])
    name = f"blue_noise: error seen from afar in equal time, {other} / blue noise"
    return [*figures, Figure(name, *_range(each), 1.0, at_least=True)]


def _range(values: Floats64) -> tuple[float, float, float]:
    return float(np.median(values)), float(values.min()), float(values.max())


def table(found: list[Found]) -> Table:
    """Errors and times."""

    def at(values: Callable[[Found], Floats64], column: int) -> Callable[[Found], str]:
        return lambda one: digits(float(values(one)[column]))

    columns: Columns[Found] = (
        ("sampler", lambda one: one.name),
        *((f"RMSE, {n}", at(lambda one: one.rmse, k)) for k, n in enumerate(COUNTS)),
        *((f"seen, {n}", at(lambda one: one.seen, k)) for k, n in enumerate(COUNTS)),
        *((f"seconds, {n}", at(lambda one: one.seconds, k)) for k, n in enumerate(COUNTS)),
    )
    return table_of(f"Errors of the scene of blue_noise; {SEEDS} seeds", found, columns)


def plots(found: list[Found]) -> list[Plot]:
    """Errors over samples and seconds, and spectra."""
    axes = {"samples": "samples for each pixel", "seconds": "seconds"}
    errors = [
        Plot(
            name,
            title,
            axes,
            "error",
            tuple(
                Series(
                    one.name,
                    style,
                    {"samples": COUNTS, "seconds": tuple(one.seconds.tolist())},
                    tuple(values(one).tolist()),
                )
                for style, one in enumerate(found)
            ),
        )
        for name, title, values in (
            ("rmse", "root mean square of the error", lambda one: one.rmse),
            ("seen", "the same after a blur: the error seen from afar", lambda one: one.seen),
        )
    ]
    middles = tuple((k + 0.5) / (2 * BINS) for k in range(BINS))
    spectra = tuple(
        Series(one.name, style, {"frequency": middles}, tuple(one.spectrum.tolist()))
        for style, one in enumerate(found)
    )
    title = f"power of the error over frequency, {SPECTRUM} samples a pixel"
    frequency = {"frequency": "cycles per pixel"}
    return [*errors, Plot("spectrum", title, frequency, "power", spectra, slope=False)]
