"""Path tracing: the cost of a Cornell box, its agreement with Mitsuba 3, and the picture of depths and samples.

The picture has the samples a pixel in its rows and the depth in its columns: noise goes away downwards, and light is
added to the right. Mitsuba's is its own `path`, with light and reflection that it shares with nothing of ours; its
LLVM variant where there is an LLVM, else its scalar one. Errors over samples and over seconds are those of each sampler
and of Russian roulette from different depths on.
"""

from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from benchmarks.figures import Figure, summary
from benchmarks.mitsuba_agreement import Agreement, Converged, compare, converge, save_difference
from benchmarks.mitsuba_export import export
from benchmarks.mitsuba_scalar import NativeScene
from benchmarks.mitsuba_variants import start_fastest
from benchmarks.report import OUT, draw_sheet, report
from course import Scene, render
from course.benchmarking.estimators import SAMPLERS, Estimator, Module
from course.benchmarking.measuring import Effort as CurveEffort
from course.benchmarking.measuring import Measured, measure
from course.benchmarking.plot_data import comparisons
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import summary_table
from course.engine.functions.effects import PROJECT
from course.engine.loops.embree_device import available
from course.engine.scene.scene import load_variant

SCENE = PROJECT / "scenes" / "path_tracing.yaml"
ROUNDS = 5
THREADS = 2

CURVES = CurveEffort("curves", 64, (1, 4, 16, 64, 256), 4, 8192)
ROULETTE = {"never": None, "from bounce 5": 5, "from bounce 2": 2, "from the first": 0}
"""Bounces that a path makes before it may end by chance."""

SAMPLES = (1, 16, 64)
DEPTHS = (1, 3, 100)
SIDE = 200
"""Pixels along a picture's side in the figure."""


@dataclass(frozen=True)
class Effort:
    """Converged pictures for the agreement: their size, their batches, and the samples of each batch."""

    size: tuple[int, int] = (96, 96)
    batches: int = 32
    samples: int = 256


def measure_path_tracing() -> list[Figure]:
    """Draw the picture; the whole render over the time inside Embree, and how far Mitsuba's picture is."""
    print(f"written to {draw_figure(OUT / 'path_tracing.png')}")
    measured = curves(CURVES)
    width, height = measured.size
    about = f"{width} x {height} pixels, {CURVES.seeds} seeds"
    report("path_tracing", about, [summary_table(measured)], comparisons(measured))
    ways = (False, True) if available() else (False,)
    figures = [figure for compiled in ways for figure in _costs(compiled)]
    if find_spec("mitsuba") is None:
        print("without Mitsuba (pip install .[peers]) there is nothing to agree with")
        return figures
    found = agreement(load_scene_for_mitsuba(), Effort(), OUT / "peers")
    name = "path tracing, beside Mitsuba"
    return [
        *figures,
        # Of a right pair's 432 blocks and channels, one exceeds 6 (31 degrees of freedom) in at most 1 of 1,800 pairs.
        summary(f"{name}: largest |t| of a block", [found.largest], 6.0),
        summary(f"{name}: means differ by (percent)", [100 * abs(found.mean)], 0.5),
    ]


def _costs(compiled: bool) -> list[Figure]:
    """The whole render against the time inside Embree, by all threads and by one."""
    scene = load_variant(SCENE)
    ratios: dict[int, list[float]] = {THREADS: [], 1: []}
    for seed in range(ROUNDS + 1):
        for threads, found in ratios.items():
            receipt = render(scene, spp=16, seed=seed, threads=threads, compiled=compiled).receipt
            found.append(threads * receipt.wall_seconds / receipt.embree_seconds)
    name = "path tracing: whole render / inside Embree" + ", compiled" * compiled
    return [
        summary(name, ratios[THREADS][1:], 1.8),
        summary(f"{name}, one thread", ratios[1][1:], 1.8),
    ]


# ---------------------------------------------------------------- error over time


def curves(effort: CurveEffort, folder: Path = Path("out/references")) -> Measured:
    """The errors and times of every sampler, and of roulette from different depths on; references go into the folder.

    Roulette takes one from every depth to the same picture, so all share a reference.
    """
    samplers = [Estimator("", sampler, "as the scene", ("samplers",)) for sampler in SAMPLERS]
    players = [
        Estimator(
            name, "sobol", "as the scene", ("roulette",), {("integrator", "roulette"): bounces}
        )
        for name, bounces in ROULETTE.items()
    ]
    groups = {"samplers": "four ways to place samples", "roulette": "when paths may end by chance"}
    module = Module("path_tracing", SCENE, groups, (*samplers, *players))
    return measure(module, module.estimators, effort, folder=folder)


# ---------------------------------------------------------------- Mitsuba


def load_scene_for_mitsuba(path: Path = SCENE) -> Scene:
    """The scene with the filter that both programs have."""
    return load_variant(path, {("film", "filter"): "box"})


def agreement(scene: Scene, effort: Effort, folder: Path) -> Agreement:
    """How far the converged pictures of both are apart; kept in a folder, with both and their difference as a PNG."""
    ours, theirs = our_reference(scene, effort, folder), their_reference(scene, effort, folder)
    save_difference(theirs, ours, folder / "path_tracing.png")
    return compare(theirs, ours)


def our_reference(scene: Scene, effort: Effort, folder: Path) -> Converged:
    """Our converged picture."""

    def picture(seed: int) -> np.ndarray:
        return render(
            scene, size=effort.size, spp=effort.samples, seed=seed, threads=THREADS
        ).linear

    return converge(picture, effort.batches, folder / f"ours_{_key(scene, effort)}.npz")


def their_reference(scene: Scene, effort: Effort, folder: Path) -> Converged:
    """Mitsuba's converged picture."""
    start_fastest(THREADS)
    loaded = NativeScene(export(scene, *effort.size))

    def picture(seed: int) -> np.ndarray:
        return loaded.render("independent", effort.samples, seed)

    return converge(picture, effort.batches, folder / f"mitsuba_{_key(scene, effort)}.npz")


def _key(scene: Scene, effort: Effort) -> str:
    digest = scene_hash(
        scene.loaded, scene.effects, samples=effort.samples, batches=effort.batches, of=effort.size
    )
    return f"path_tracing_{digest[:24]}"


# ---------------------------------------------------------------- the figure


def draw_figure(path: Path) -> Path:
    """Draw the Cornell box with 1, 16 and 64 samples a pixel in rows, and depths of 1, 3 and 100 in columns."""
    scenes = {depth: load_variant(SCENE, {("integrator", "max_depth"): depth}) for depth in DEPTHS}
    rows = [
        [
            (
                f"{_counted(samples, 'sample')}, {_counted(depth, 'bounce')}",
                np.moveaxis(render(scene, size=(SIDE, SIDE), spp=samples).linear, -1, 0),
            )
            for depth, scene in scenes.items()
        ]
        for samples in SAMPLES
    ]
    return draw_sheet(rows, path)


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'s' * (number != 1)}"
