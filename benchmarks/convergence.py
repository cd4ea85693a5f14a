"""How fast the error of a penumbra falls with the number of samples, for Sobol points and for random ones."""

from __future__ import annotations

import numpy as np

from benchmarks.engine import SCENES
from benchmarks.figures import Figure, summary
from course import load_scene, render

SAMPLES = (4, 16, 64, 256)
REFERENCE = 8192
SEEDS = (1, 2, 3)


def measure_convergence() -> list[Figure]:
    """Slopes of RMSE over samples, on logarithmic scales, against a converged picture."""
    scene = load_scene(SCENES / "penumbra.yaml")
    reference = render(scene, spp=REFERENCE, seed=99).linear
    figures = []
    for sampler, goal in (("sobol", -0.75), ("random", -0.45)):
        slopes = []
        for seed in SEEDS:
            errors = [
                float(
                    np.sqrt(
                        np.mean(
                            (render(scene, spp=s, sampler=sampler, seed=seed).linear - reference)
                            ** 2
                        )
                    )
                )
                for s in SAMPLES
            ]
            slopes.append(float(np.polyfit(np.log(SAMPLES), np.log(errors), 1)[0]))
        figures.append(
            summary(f"penumbra: slope of the error, {sampler}, 4 to 256 samples", slopes, goal)
        )
    return figures
