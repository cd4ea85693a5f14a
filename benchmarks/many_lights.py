"""A thousand lamps, of which one is asked for each hit: errors of three choices, over samples and over seconds.

The samples of the converged picture are chosen by the tree. Beside it: what the tree gains over a choice that finds
each lamp as probable, and what a choice costs, with 10 to 10,000 candles on the same floor, of the same power together;
and whether a thousand by the tree are a thousand that are all asked, by Welch's t of blocks of pixels.
"""

from pathlib import Path
from time import process_time
from types import SimpleNamespace
from typing import Any

import numpy as np

from benchmarks.error_curves import median_seconds
from benchmarks.figures import Figure, summary
from benchmarks.mitsuba_agreement import Converged, compare, converge
from benchmarks.ways import compare_ways, gain
from course import Scene, render
from course.benchmarking.measuring import Effort
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import Table, digits
from course.engine.core.types import Floats64
from course.engine.formats.yaml.loading import load_description
from course.engine.functions.effects import PROJECT
from course.engine.loops.light_tree import compiled_choice
from course.engine.scene.scene import load_variant
from course.engine.terms.lights.light_tree import TOGETHER, TreeChoice

SCENE = PROJECT / "scenes" / "many_lights.yaml"
CURVES = Effort("curves", 40, (1, 4, 16, 64, 256), 4, 4096)
WAYS = {"each as probable": "uniform", "by power": "power", "by a light tree": "tree"}

COUNTS = (10, 100, 1000, 10000)
AT, GOAL = 64, 10.0
"""Samples at which the module's scene is compared, and how many times smaller the tree's error is to be."""

ENOUGH = 1000
"""Lamps from which on the goal is meant; with fewer, the tree only has to gain."""

SIZE, SAMPLES, CONVERGED, ROUNDS = (60, 40), 16, 64, 25
CHOICES = 41
"""Rounds in which the choices alone are timed."""

ALL_SIZE, ALL_SAMPLES, TREE_SAMPLES, BATCHES = (48, 32), 8, 256, 16
FOLDER = Path("out/references")
RADIUS, HEIGHT, POWER = 11.5, 0.18, 200.0
"""Of the floor that the candles stand on and of the candles; their intensities' sum [W/sr]."""


def measure_many_lights() -> list[Figure]:
    """Measure, print and draw the curves; gains, costs and the largest t."""
    key = ("integrator", "light_sampling")
    title = "three ways to choose one of a thousand lamps, random points"
    squares, seconds, choices = growth()
    measured = compare_ways(
        "many_lights",
        "random",
        key,
        WAYS,
        title,
        CURVES,
        [_table(squares, seconds, choices)],
        _plots(squares, seconds, choices),
    )
    return [
        gain(measured, "each as probable", "by a light tree", AT, GOAL),
        *gains(squares, seconds),
        summary(
            "many_lights: seconds of the tree's choice, 10,000 / 10 lamps",
            [float(choices[-1] / choices[0])],
            float(np.log(COUNTS[-1]) / np.log(COUNTS[0])),
        ),
        summary(
            "many_lights: largest |t| of a block, one by the tree against all of 1,000",
            [unbiased()],
            4.5,
        ),
    ]


def candles(count: int, way: str) -> Scene:
    """The scene with that many candles in its middle, and without flames."""
    k = np.arange(count) + 0.5
    angle, radius = np.pi * (3 - np.sqrt(5)) * k, RADIUS * np.sqrt(k / count)
    lamps = [
        {
            "type": "point",
            "position": [float(x), HEIGHT, float(z)],
            "intensity": [POWER / count, 0.7 * POWER / count, 0.5 * POWER / count],
        }
        for x, z in zip(radius * np.cos(angle), radius * np.sin(angle), strict=True)
    ]
    things = load_description(SCENE).document.data["objects"]
    return load_variant(
        SCENE,
        {
            ("lights",): lamps,
            ("objects",): [thing for thing in things if thing["name"] != "flames"],
            ("integrator", "light_sampling"): way,
        },
    )


def growth() -> tuple[Floats64, Floats64, Floats64]:
    """Squared errors and seconds of the processor (counts, 2, ROUNDS), each choice in turn, and of choices (counts,).

    The first choice finds each lamp as probable, the second is the tree's.
    """
    ways = WAYS["each as probable"], WAYS["by a light tree"]
    squares = np.empty((len(COUNTS), 2, ROUNDS))
    seconds = np.empty_like(squares)
    trees: list[TreeChoice] = []
    for row, count in enumerate(COUNTS):
        scenes = [candles(count, way) for way in ways]
        choice = scenes[1].compiled.world.choice
        assert isinstance(choice, TreeChoice)
        trees.append(choice)
        exact = _converged(scenes[1], SIZE, CONVERGED)
        for scene in scenes:
            render(scene, size=SIZE, spp=1, threads=1, compiled=True)
        for turn in range(ROUNDS):
            for column, scene in enumerate(scenes):
                began = process_time()
                made = render(
                    scene, size=SIZE, spp=SAMPLES, seed=turn, threads=1, compiled=True
                ).linear
                seconds[row, column, turn] = process_time() - began
                squares[row, column, turn] = exact.mse(made)
    return squares, seconds, _choices(trees)


def _choices(trees: list[TreeChoice]) -> Floats64:
    """Seconds (counts,) of a choice for TOGETHER points on the floor, medians of rounds in turn."""
    rng = np.random.default_rng(5)
    p = rng.uniform(-0.5, 0.5, (3, TOGETHER)).astype(np.float32)
    p[1] = 0
    n = np.repeat(np.array([[0], [1], [0]], np.float32), TOGETHER, axis=1)
    u = rng.random(TOGETHER, dtype=np.float32)
    hits: Any = SimpleNamespace(near_origin=p, ns=n)
    ways = {
        str(k): lambda _n, _turn, choose=choice.choose: choose(hits, u)
        for k, choice in enumerate(map(compiled_choice, trees))
        if choice is not None
    }
    return np.array([time for (time,) in median_seconds(ways, [1], CHOICES).values()])


def gains(squares: Floats64, seconds: Floats64) -> list[Figure]:
    """How many times the tree's error the other choice has in equal time, by the number of lamps."""
    found = []
    for row, count in enumerate(COUNTS):
        one, tree = np.sqrt(squares[row] * np.median(seconds[row], axis=1)[:, None])
        # The mean square counts: a picture of the first choice without its rare white dots looks better than it is.
        ratio = float(np.sqrt((one**2).mean() / (tree**2).mean()))
        each = one / tree
        name = f"many_lights: error in equal time, one of {count:,} as probable / by the tree"
        goal = GOAL if count >= ENOUGH else 1.0
        found.append(Figure(name, ratio, float(each.min()), float(each.max()), goal, at_least=True))
    return found


def unbiased() -> float:
    """The largest |t| of a block of pixels between all of a thousand lamps and one by the tree."""
    ways = (("all", ALL_SAMPLES), ("tree", TREE_SAMPLES))
    return compare(*(_converged(candles(1000, way), ALL_SIZE, n) for way, n in ways)).largest


def _converged(scene: Scene, size: tuple[int, int], samples: int) -> Converged:
    """The mean of BATCHES pictures with seeds of their own, kept in a file."""
    key = scene_hash(scene.loaded, scene.effects, samples=samples, batches=BATCHES, of=size)

    def picture(seed: int) -> np.ndarray:
        return render(scene, size=size, spp=samples, seed=seed).linear

    return converge(picture, BATCHES, FOLDER / f"many_lights_{key[:24]}.npz")


def _table(squares: Floats64, seconds: Floats64, choices: Floats64) -> Table:
    rmse, times = np.sqrt(squares.mean(axis=2)), np.median(seconds, axis=2)
    rows = [
        (
            f"{count:,}",
            *map(digits, rmse[row]),
            *map(digits, times[row]),
            f"{1e9 * choices[row] / TOGETHER:.0f}",
        )
        for row, count in enumerate(COUNTS)
    ]
    columns = ("lamps", "RMSE, each as probable", "RMSE, tree", "seconds", "seconds, tree")
    title = f"{SIZE[0]} x {SIZE[1]} pixels, {SAMPLES} samples, one thread, {ROUNDS} rounds in turn"
    return Table(title, (*columns, "tree's choice for a hit [ns]"), tuple(rows))


def _plots(squares: Floats64, seconds: Floats64, choices: Floats64) -> list[Plot]:
    """Errors at equal samples and seconds, over lamps."""
    axes = {"lamps": "lamps"}
    names = (("each as probable", 0), ("by a light tree", 2))

    def lines(values: Floats64) -> list[Series]:
        return [
            Series(name, style, {"lamps": COUNTS}, tuple(values[:, column].tolist()))
            for column, (name, style) in enumerate(names)
        ]

    errors = lines(np.sqrt(squares.mean(axis=2)))
    times = lines(np.median(seconds, axis=2))
    walk = Series(
        f"the tree's choice for {TOGETHER:,} hits", 3, {"lamps": COUNTS}, tuple(choices.tolist())
    )
    title = f"{SAMPLES} samples a pixel, 10 to 10,000 lamps of the same power together"
    return [
        Plot("lamps", title, axes, "RMSE", tuple(errors), slope=False),
        Plot("cost", title, axes, "seconds", (*times, walk), slope=False),
    ]
