"""`python -m benchmarks.caustic`: a caustic by progressive photons and by paths, to one error, on the same cores.

Errors are against a converged picture by paths, so that the blur of photons counts, too; what the reference's own noise
adds is taken off. Paths' squared error falls as 1 / n, whatever finds the lamp: how long they take to the error of the
photons follows from one run.
"""

from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter

import click
import numpy as np

from benchmarks.figures import Figure, summary, table
from benchmarks.mitsuba_agreement import Converged, converge
from course import Scene, render
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import print_tables
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant

SCENE = PROJECT / "benchmarks" / "scenes" / "caustic.yaml"
PHOTONS = {"count": 100_000, "radius": 0.02, "samples": 16}
REFERENCE = Path("out/references")


def reference(scene: Scene, samples: int, batches: int) -> Converged:
    """The mean of pictures by paths; kept in a folder."""
    key = scene_hash(scene.loaded, scene.effects, samples=samples, batches=batches)
    return converge(
        lambda seed: render(scene, spp=samples, seed=seed).linear,
        batches,
        REFERENCE / f"caustic_{key[:24]}.npz",
    )


def measure(
    paths_spp: int, photons_spp: int, rounds: int, reference_spp: int, batches: int
) -> list[Figure]:
    """How many times longer paths take than photons."""
    by_paths = load_variant(SCENE)
    by_photons = load_variant(SCENE, {("photons",): PHOTONS})
    truth = reference(by_paths, reference_spp, batches)
    ways: dict[str, Callable[[int], np.ndarray]] = {
        "paths": lambda seed: render(by_paths, spp=paths_spp, seed=seed).linear,
        "photons": lambda seed: render(by_photons, spp=photons_spp, seed=seed).linear,
    }
    seconds: dict[str, list[float]] = {name: [] for name in ways}
    errors: dict[str, list[float]] = {name: [] for name in ways}
    for seed in range(rounds + 1):
        for name, picture in ways.items():
            begun = perf_counter()
            made = picture(seed)
            seconds[name].append(perf_counter() - begun)
            errors[name].append(truth.mse(made))
    for name in ways:
        # The first compiles.
        errors[name], seconds[name] = errors[name][1:], seconds[name][1:]
        print(
            f"{name}: RMSE {np.mean(errors[name]) ** 0.5:.5f}, {median(seconds[name]):.3f} s"
            f" (the reference: {truth.noise**0.5:.5f})"
        )
    scale = float(np.mean(errors["paths"]) / np.mean(errors["photons"]))
    both = zip(seconds["paths"], seconds["photons"], strict=True)
    ratios = [a / b * scale for a, b in both]
    name = "photon_mapping: seconds to one error, paths / progressive photons"
    return [summary(name, ratios, 5, at_least=True)]


@click.command()
@click.option("--paths-spp", default=256, show_default=True, help="Samples a pixel by paths.")
@click.option("--photons-spp", default=64, show_default=True, help="Samples a pixel by photons.")
@click.option("--rounds", default=5, show_default=True, help="Times that each is timed, in turn.")
@click.option("--reference-spp", default=4096, show_default=True, help="Of each of its batches.")
@click.option("--batches", default=32, show_default=True, help="Of the reference.")
def main(paths_spp: int, photons_spp: int, rounds: int, reference_spp: int, batches: int) -> None:
    """Measure, and print what was found."""
    found = measure(paths_spp, photons_spp, rounds, reference_spp, batches)
    print_tables([table(found)])


if __name__ == "__main__":
    main()
