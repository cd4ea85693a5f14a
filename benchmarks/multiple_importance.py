"""Veach's plates: errors of lamps and lobes and both, over samples, over seconds, and for each plate and lamp.

Of each plate under each lamp the variance of a sample is estimated from pictures of several seeds, with independent
numbers: no converged picture is needed, and the error at any number of samples follows. A sample of both is two: a
point on the lamp, and a direction of the lobe. So both are compared with the better strategy of twice as many samples.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.figures import Figure
from benchmarks.ways import compare_ways
from course import render
from course.atomic import write_text
from course.benchmarking.machine import machine
from course.benchmarking.measuring import Effort
from course.benchmarking.tables import Table, print_tables
from course.effects import PROJECT
from course.scene.scene import load_scene, load_variant

SCENE = PROJECT / "scenes" / "multiple_importance.yaml"
PLATES = PROJECT / "docs" / "data" / "plates" / "veach.json"
CURVES = Effort("curves", 64, (1, 4, 16, 64), 4, 4096)
WAYS = {
    "lobe": "directions of the lobe",
    "lamp": "points on lamps",
    "balance": "both, balance heuristic",
    "power": "both, power heuristic",
}
SIZE, SAMPLES, SEEDS = (180, 120), 16, 24


def measure_multiple_importance() -> list[Figure]:
    """Measure, print and write the curves and the plates."""
    key = ("integrator", "gloss_sampling")
    title = "four ways to find lamps in glossy plates, random numbers"
    ways = {name: way for way, name in WAYS.items()}
    compare_ways("multiple_importance", "random", key, ways, title, CURVES)
    write_plates()
    return []


def write_plates(samples: int = SAMPLES, seeds: int = SEEDS, path: Path = PLATES) -> None:
    """Measure every plate under every lamp, print it, and write it."""
    description = load_scene(SCENE).loaded.description
    plates = [thing.name for thing in description.objects if thing.name in description.materials]
    masks = [_mask(plate) for plate in plates]
    variances = {
        way: np.array(
            [
                _variances(way, lamp, masks, samples, seeds)
                for lamp in range(len(description.lights))
            ]
        ).T
        for way in WAYS
    }
    found: dict[str, Any] = {
        "command": "python -m benchmarks multiple_importance",
        "about": f"{SIZE[0]} x {SIZE[1]} pixels, {samples} samples, {seeds} seeds",
        "machine": machine(),
        "plates": plates,
        "exponents": [description.materials[plate].gloss.exponent for plate in plates],
        "radii": [lamp.radius for lamp in description.lights],
        "deviation of a sample": {
            way: [[float(f"{x:.4g}") for x in row] for row in np.sqrt(variance)]
            for way, variance in variances.items()
        },
    }
    better = np.sqrt(np.minimum(variances["lobe"], variances["lamp"]))
    tables = []
    for way in ("balance", "power"):
        # The better strategy has twice as many samples: its error is smaller by the root of 2.
        ratio = np.sqrt(2 * variances[way]) / better
        rows = [
            (plate, *(f"{x:.2f}" for x in row)) for plate, row in zip(plates, ratio, strict=True)
        ]
        columns = ("plate", *(f"lamp of radius {lamp.radius:g}" for lamp in description.lights))
        tables.append(
            Table(f"{WAYS[way]}: error over that of the better strategy", columns, tuple(rows))
        )
    print_tables(tables)
    path.parent.mkdir(exist_ok=True)
    write_text(path, json.dumps(found, indent=1) + "\n")


def _alone(lamp: int, changed: dict[Any, Any]) -> Any:
    """The scene with one lamp, its walls black."""
    lights = load_scene(SCENE).loaded.document.data["lights"]
    dark = {("materials", "wall", "color"): 0, ("lights",): [lights[lamp]]}
    return load_variant(SCENE, {**dark, **changed})


def _mask(plate: str) -> np.ndarray[Any, Any]:
    """Pixels (H, W) that show a plate and nothing else."""
    glowing = {("materials", plate, "emission"): 1, ("integrator", "max_depth"): 0}
    scene = _alone(0, {**glowing, ("lights",): []})
    picture = render(scene, size=SIZE, spp=16).linear
    return np.asarray(picture.min(axis=2) > 0.999)


def _variances(way: str, lamp: int, masks: Any, samples: int, seeds: int) -> list[float]:
    """Variance of one sample of a way, the mean of each plate's pixels and channels."""
    scene = _alone(lamp, {("integrator", "gloss_sampling"): way})
    pictures = np.stack(
        [render(scene, size=SIZE, spp=samples, seed=seed).linear for seed in range(seeds)]
    ).astype(np.float64)
    variance = samples * pictures.var(axis=0, ddof=1)
    return [float(variance[mask].mean()) for mask in masks]
