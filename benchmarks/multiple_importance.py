"""Veach's plates: errors of lamps and lobes and both, over samples, over seconds, and for each plate and lamp.

Each plate fills a picture of its own under each lamp, seen from where the scene's camera stands. The variance of a
sample is estimated from pictures of several seeds, with independent numbers: no converged picture is needed, and the
error at any number of samples follows, and with it that in any time. To be timed all ways are rendered in turn, by one
thread, and seconds are the processor's; variances are kept in a file.
"""

import json
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from benchmarks.figures import Figure
from benchmarks.ways import REFERENCES, compare_ways
from course import Scene, render
from course.base.atomic import write_text
from course.benchmarking.machine import machine
from course.benchmarking.measuring import Effort, Measured
from course.benchmarking.plot_data import rounded
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import Table, print_tables
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_scene, load_variant

SCENE = PROJECT / "scenes" / "multiple_importance.yaml"
PLATES = PROJECT / "docs" / "data" / "plates" / "veach.json"
CURVES = Effort("curves", 64, (1, 4, 16, 64), 4, 4096)
WAYS = {
    "lobe": "directions of the lobe",
    "lamp": "points on lamps",
    "balance": "both, balance heuristic",
    "power": "both, power heuristic",
}
ROWS, SAMPLES, SEEDS = 16, 64, 64
"""Of the picture of a plate: its height [pixels], samples a pixel, and pictures for its variance."""

TIMED = 12
"""Pictures of each way that are timed."""

WITHIN = 0.9
"""Share of a plate's height and width that its picture shows."""

FIFTH = 5.0


def measure_multiple_importance() -> list[Figure]:
    """Measure, print and write the curves and the plates."""
    key = ("integrator", "gloss_sampling")
    title = "four ways to find lamps in glossy plates, random numbers"
    ways = {name: way for way, name in WAYS.items()}
    measured = compare_ways("multiple_importance", "random", key, ways, title, CURVES)
    found = measure_plates()
    write_plates(found)
    return [*_whole(measured), *_cells(found)]


def _whole(measured: Measured) -> list[Figure]:
    """How many times the relative error of both each strategy has in equal time, at the most samples, seed by seed."""
    curves = {curve.estimator.variant: curve for curve in measured.curves}

    def error(way: str) -> Floats64:
        curve = curves[WAYS[way]]
        return np.sqrt(curve.relative_mse[-1] * np.median(curve.seconds[-1]))

    better, worse = sorted(("lobe", "lamp"), key=lambda way: float(np.median(error(way))))
    figures = []
    for what, way, goal in (("worse", worse, FIFTH), ("better", better, 1.0)):
        each = error(way) / error("power")
        name = f"multiple_importance: relative error in equal time, the {what} strategy / both"
        values = float(np.median(each)), float(each.min()), float(each.max())
        figures.append(Figure(name, *values, goal, at_least=True))
    return figures


def _cells(found: dict[str, Any]) -> list[Figure]:
    """Of all plates and lamps: both over the better strategy, and the share in which both are five times better."""
    deviation, seconds = (
        {way: np.array(found[name][way]) for way in WAYS}
        for name in ("deviation of a sample", "seconds")
    )
    timed = {way: deviation[way] * np.sqrt(seconds[way]) for way in WAYS}
    figures = []
    for what, errors in (("at equal samples", deviation), ("in equal time", timed)):
        ratio = errors["power"] / np.minimum(errors["lobe"], errors["lamp"])
        name = f"multiple_importance: error {what}, both / the better strategy, worst of 20"
        figures.append(
            Figure(name, float(ratio.max()), float(ratio.min()), float(ratio.max()), 1.0)
        )
    worse = np.maximum(timed["lobe"], timed["lamp"])
    share = float((worse >= FIFTH * timed["power"]).mean())
    name = (
        "multiple_importance: share of plates and lamps where both have a fifth of the worse error"
    )
    return [*figures, Figure(name, share, share, share, 0.75, at_least=True)]


def measure_plates(
    samples: int = SAMPLES,
    seeds: int = SEEDS,
    rows: int = ROWS,
    timed: int = TIMED,
    folder: Path = REFERENCES,
) -> dict[str, Any]:
    """Deviations of a sample and seconds of a picture, by way, plate and lamp."""
    description = load_scene(SCENE).loaded.description
    plates = [thing.name for thing in description.objects if thing.name in description.materials]
    shape = len(plates), len(description.lights)
    cells = [(plate, lamp) for plate in plates for lamp in range(shape[1])]

    def table_of(values: list[dict[str, float]]) -> dict[str, Floats64]:
        return {way: np.array([each[way] for each in values]).reshape(shape) for way in WAYS}

    whole = load_scene(SCENE)
    key = scene_hash(whole.loaded, whole.effects, samples=samples, batches=seeds, of=rows)
    path = folder / f"plates_{key[:24]}.npz"
    if path.is_file():
        with np.load(path) as kept:
            deviation = {way: kept[way] for way in WAYS}
    else:
        deviation = table_of([_deviations(*cell, samples, seeds, rows) for cell in cells])
        path.parent.mkdir(parents=True, exist_ok=True)
        np.savez(path, **deviation)
    seconds = table_of([_seconds(*cell, samples, timed, rows) for cell in cells])

    def plain(values: dict[str, Floats64]) -> dict[str, Any]:
        return {
            way: [[rounded(x) for x in line] for line in lines] for way, lines in values.items()
        }

    return {
        "command": "python -m benchmarks multiple_importance",
        "about": f"{rows} rows of pixels, {samples} samples, {seeds} seeds, one thread",
        "machine": machine(),
        "plates": plates,
        "exponents": [description.materials[plate].gloss.exponent for plate in plates],
        "radii": [lamp.radius for lamp in description.lights],
        "deviation of a sample": plain(deviation),
        "seconds": plain(seconds),
    }


def write_plates(found: dict[str, Any], path: Path = PLATES) -> None:
    """Print errors in equal time and write what was measured."""
    errors = {
        way: np.array(found["deviation of a sample"][way]) * np.sqrt(found["seconds"][way])
        for way in WAYS
    }
    better = np.minimum(errors["lobe"], errors["lamp"])
    columns = ("plate", *(f"lamp of radius {radius:g}" for radius in found["radii"]))
    print_tables(
        [
            Table(
                f"{WAYS[way]}: error in equal time over that of the better strategy",
                columns,
                tuple(
                    (plate, *(f"{x:.2f}" for x in line))
                    for plate, line in zip(found["plates"], errors[way] / better, strict=True)
                ),
            )
            for way in ("balance", "power")
        ]
    )
    path.parent.mkdir(exist_ok=True)
    write_text(path, json.dumps(found, indent=1) + "\n")


def _deviations(plate: str, lamp: int, samples: int, seeds: int, rows: int) -> dict[str, float]:
    """Standard deviation of one sample by way, over all pixels and channels."""
    found = {}
    for way in WAYS:
        scene = _alone(plate, lamp, way)
        total, squares = 0.0, 0.0
        for seed in range(seeds):
            made = _picture(scene, samples, rows, seed, threads=2)
            total, squares = total + made, squares + made**2
        variance = (squares - total**2 / seeds) / (seeds - 1)
        found[way] = float(np.sqrt(samples * np.mean(variance)))
    return found


def _seconds(plate: str, lamp: int, samples: int, timed: int, rows: int) -> dict[str, float]:
    """Median seconds of a picture by way, all in turn."""
    scenes = {way: _alone(plate, lamp, way) for way in WAYS}
    seconds = {way: np.empty(timed) for way in WAYS}
    for turn in range(-1, timed):
        for way, scene in scenes.items():
            began = process_time()
            _picture(scene, samples, rows, turn + 1, threads=1)
            # The first time tables are made.
            seconds[way][turn] = process_time() - began
    return {way: float(np.median(times)) for way, times in seconds.items()}


def _picture(scene: Scene, samples: int, rows: int, seed: int, threads: int) -> Floats64:
    film = scene.loaded.description.film
    size = max(round(rows * film.width / film.height), 1), rows
    made = render(scene, size=size, spp=samples, seed=seed, threads=threads, compiled=True)
    return made.linear.astype(np.float64)


def _alone(plate: str, lamp: int, way: str) -> Scene:
    """One plate under one lamp, which fills the picture."""
    whole = load_scene(SCENE).loaded
    data = whole.document.data
    things = [thing for thing in data["objects"] if thing["name"] == plate]
    eye = np.array(whole.description.camera.eye)
    fov, aspect, middle = _view(things[0], eye)
    return load_variant(
        SCENE,
        {
            ("objects",): things,
            ("lights",): [data["lights"][lamp]],
            ("camera", "look_at"): middle.tolist(),
            ("camera", "vertical_fov"): fov,
            ("film", "width"): round(100 * aspect),
            ("film", "height"): 100,
            ("integrator", "gloss_sampling"): way,
        },
    )


def _view(plate: dict[str, Any], eye: Floats64) -> tuple[float, float, Floats64]:
    """Vertical angle [degree] and width over height of a view within a plate, and its middle (3,)."""
    turn, moved = plate["transform"]
    tilt = np.radians(turn["rotate"]["degrees"])
    middle = np.array(moved["translate"], float)
    down = np.array([0, -np.sin(tilt), np.cos(tilt)]) * plate["depth"] / 2
    forward = middle - eye
    forward /= np.linalg.norm(forward)
    right = np.array([1.0, 0, 0])
    up = np.cross(right, forward)
    # Tangents of the nearer of both edges, above and below the middle, and of the corner that is farthest away.
    ends = [middle + down - eye, middle - down - eye]
    half = WITHIN * min(abs(end @ up / (end @ forward)) for end in ends)
    wide = WITHIN * plate["width"] / 2 / max(end @ forward for end in ends)
    return float(2 * np.degrees(np.arctan(half))), float(wide / half), middle
