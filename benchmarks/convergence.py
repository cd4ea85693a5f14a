"""How fast the error of a penumbra falls with the number of samples, for Sobol points and for random ones."""

import numpy as np

from benchmarks.engine import SCENES
from benchmarks.figures import Figure, summary
from course import load_scene, render
from course.benchmarking.curves import fit_order
from course.benchmarking.errors import rmse
from course.benchmarking.references import reference

SAMPLES = (4, 16, 64, 256)
REFERENCE = 16384
SEEDS = (1, 2, 3)


def measure_convergence() -> list[Figure]:
    """Slopes of RMSE over samples, on logarithmic scales, against a converged picture."""
    path = SCENES / "penumbra.yaml"
    ideal = reference(path, samples=REFERENCE)
    scene = load_scene(path)
    figures = []
    for sampler, goal in (("sobol", -0.75), ("random", -0.45)):
        slopes = []
        for seed in SEEDS:
            errors = [
                rmse(render(scene, spp=s, sampler=sampler, seed=seed).linear, ideal.linear)
                for s in SAMPLES
            ]
            order = fit_order(np.array(SAMPLES, float), np.array(errors)[:, None] ** 2)
            assert order is not None
            slopes.append(order.value)
        figures.append(
            summary(f"penumbra: slope of the error, {sampler}, 4 to 256 samples", slopes, goal)
        )
    return figures
