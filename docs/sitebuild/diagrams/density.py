"""One integrand, a density that can be changed, and what ten samples of it say."""

import math

import numpy as np

from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.movable import Handle, Model, Movable, Movement, Value, Values
from solutions import glossy, importance_sampling

POWER = 3
"""The integrand is the cosine to this power, and its integral over the hemisphere 2 pi / (POWER + 1)."""

COUNT = 10
NUMBERS = (np.arange(COUNT) + np.arange(COUNT) * 0.61803398875 % 1) / COUNT
"""Stratified; the golden ratio's multiples stand for the jitter."""

BOTTOM, UNIT = -1.35, 0.95 / (2 * math.pi)
"""The line below the quotients, and the height of a quotient of 1."""

SCALE = 1 / (POWER + 1)
"""Densities are drawn this high, so that the one that is proportional to the integrand covers it."""

HEIGHTS = np.linspace(0, 1, 61)


def model(values: Values) -> Model:
    """Directions of a lobe about the normal; z is their cosine."""
    exponent = values["exponent"]
    axis = np.repeat(np.array([[0.0], [0.0], [1.0]]), COUNT, axis=1)
    sampled = glossy.sample_phong_lobe(axis, exponent, np.stack((NUMBERS, np.zeros(COUNT))))
    z = np.sort(sampled[2])
    f, pdf = z**POWER, importance_sampling.phong_lobe_pdf(z, exponent)
    mean, variance = (float(v) for v in importance_sampling.estimate(f, pdf))
    # Over z a density per steradian is 2 pi times as large.
    density = 2 * math.pi * importance_sampling.phong_lobe_pdf(HEIGHTS, exponent) * SCALE
    left = 2 * POWER + 1 - exponent
    exact = (2 * math.pi) ** 2 / ((exponent + 1) * left) if left > 0 else math.inf
    quotient = f / pdf
    return Model(
        {
            "area": np.concatenate(
                (np.stack((HEIGHTS, density)), np.array([[1.0, 0.0], [0.0, 0.0]])), axis=1
            ),
            "density": np.stack((HEIGHTS, density)),
            "top": np.array([1.0, density[-1]]),
            "feet": np.stack((z, np.full(COUNT, BOTTOM))),
            "samples": np.stack((z, np.zeros(COUNT))),
            "said": np.stack((z, BOTTOM + UNIT * quotient)),
            "mean_left": np.array([0.0, BOTTOM + UNIT * mean]),
            "mean_right": np.array([1.05, BOTTOM + UNIT * mean]),
        },
        {
            "exponent": exponent,
            "mean": mean,
            "error": math.sqrt(variance),
            "variance": exact - (2 * math.pi / (POWER + 1)) ** 2,
        },
    )


MOVEMENT = Movement(
    "importance_sampling/lobe",
    model,
    {"exponent": Value(0, 7.5, 1, 0.1)},
    (Handle("Density", "top", ("exponent",), "exponent {exponent:.1f}; variance {variance:.3f}"),),
    f"Exponent {{exponent:.2f}}: the mean of {COUNT} samples is {{mean:.3f}}, with a standard error of {{error:.3f}}. "
    "The variance of one sample is {variance:.3f}.",
)


def lobe() -> Figure:
    """The integrand of the table, and lobes of any exponent."""
    rest = model(MOVEMENT.start)
    canvas = Movable(rest, 350, 230, (-0.07, 1.16, -1.45, 2.3), 4, stretch=True)
    canvas.path(np.stack((HEIGHTS, HEIGHTS**POWER)), "ink")
    canvas.path("area", "wash", closed=True)
    canvas.path("density", "accent")
    canvas.line((0, 0), (1.05, 0))
    canvas.dot("samples", "accent", 2.4)
    canvas.line((0, BOTTOM), (1.05, BOTTOM))
    integral = BOTTOM + UNIT * 2 * math.pi / (POWER + 1)
    canvas.line((0, integral), (1.05, integral), "faint dashed")
    canvas.line("mean_left", "mean_right", "accent thin")
    canvas.lines("feet", "said", "ink")
    canvas.dot("said", "ink", 2)
    canvas.label((0.8, 0.8**POWER), "$f$", "n", 7)
    canvas.label("top", "$p$", "ne", 8, "accent")
    canvas.label((0.05, BOTTOM + 0.86), "$f / p$", "e", 0)
    canvas.label((1.06, 0), "$z$", "e", 4)
    return Figure(
        "The integral of $cos^3$ again, over the height $z$ of a direction, with the density of a lobe. Above: "
        "integrand $f$ and, filled, density $p$, drawn a fourth as high: with exponent 3 it is the integrand's shape. "
        "Below: what each of ten samples says, $f / p$, and their mean; dashed the integral.",
        (
            Panel(
                canvas,
                "Sampling by a lobe of any exponent",
                "Above, the integrand rises with the cube of the height, and the density is filled; ten samples are "
                "marked on the line. Below, their quotients and the mean of these.",
            ),
        ),
        MOVEMENT,
    )
