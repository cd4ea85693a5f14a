"""Figures of importance sampling: three densities for one integrand, the steps, Malley's method, seen from above."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.density import lobe
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.view import View, ring
from solutions import importance_sampling

WAYS = (
    ("uniform", 0.0, "uniform: much variance"),
    ("cosine", 1.0, "cosine: less"),
    ("lobe", 2.0, "lobe, exponent 2: little"),
)
"""Densities over the height z of a direction: (n + 1) z^n, for directions with the cosine's power n."""


def gain() -> Figure:
    """An integrand, three densities, and what each sample says."""
    u = (np.arange(10) + np.random.default_rng(1).random(10)) / 10
    panels = []
    z = np.linspace(0, 1, 61)
    for name, power, words in WAYS:
        canvas = Canvas(172, 190, (-0.05, 1.06, -1.42, 1.06), 4, stretch=True)
        canvas.path(np.stack((z, 1 * z**3)), "ink")
        density = (power + 1) * z**power
        canvas.path(
            np.concatenate(([z, density / 3], [[1, 0], [0, 0]]), axis=1), "wash", closed=True
        )
        canvas.path(np.stack((z, density / 3)), "accent")
        canvas.line((0, 0), (1.05, 0))
        places = u ** (1 / (power + 1))
        canvas.dot((places, np.zeros(10)), "accent", 2.4)
        quotient = 2 * np.pi * places**3 / ((power + 1) * places**power)
        bottom, unit = -1.35, 0.95 / (2 * np.pi)
        canvas.line((0, bottom), (1.05, bottom))
        canvas.line(
            (0, bottom + unit * np.pi / 2), (1.05, bottom + unit * np.pi / 2), "faint dashed"
        )
        for x, q in zip(places, quotient, strict=True):
            canvas.line((x, bottom), (x, bottom + unit * q), "ink")
            canvas.dot((x, bottom + unit * q), "ink", 2)
        canvas.label((0.05, 0.9), "$f$, $p$", "e", 0)
        canvas.label((0.05, bottom + 0.86), "$f / p$", "e", 0)
        panels.append(
            Panel(
                canvas,
                f"Sampling by {name} density",
                "Above, the integrand rises with the cube of the height, and the density is filled; ten samples are "
                f"marked. Below, the quotients of the samples about their mean, pi over 2: {words}.",
                words[0].upper() + words[1:] + ".",
            )
        )
    return Figure(
        "The integral of $cos^3$, over the height of a direction. Above: integrand $f$ and, filled, "
        "density $p$, not to "
        "one scale. Below: what each of ten samples says, $f / p$; dashed the integral. The closer "
        "$p$ follows $f$, the "
        "less it varies.",
        tuple(panels),
    )


def steps() -> Figure:
    """Directions, values, the mean, and two densities."""
    u = (np.arange(8) + np.random.default_rng(3).random(8)) / 8
    many = importance_sampling.cosine_hemisphere(np.stack((u, np.zeros(8))))
    height = many[2]
    f = height**3
    p = importance_sampling.cosine_hemisphere_pdf(height)
    mean, variance = (float(v) for v in importance_sampling.estimate(f, p))

    way = Canvas(172, 150, (-1.1, 1.1, -0.3, 1.35), 4)
    turn = np.linspace(0, np.pi, 61)
    way.path(np.stack((np.cos(turn), np.sin(turn))), "faint")
    way.surface((-1.08, 0), (1.08, 0))
    for k, (x, y) in enumerate(zip(many[0], height, strict=True)):
        way.arrow((0, 0), ((-1) ** k * x, y), "accent", 6)

    order = np.argsort(height)
    values = Canvas(172, 150, (-0.8, 7.8, -0.2, 1.2), 4, stretch=True)
    values.line((-0.7, 0), (7.7, 0))
    for k, i in enumerate(order):
        values.line((k - 0.13, 0), (k - 0.13, f[i]), "ink")
        values.dot((k - 0.13, f[i]), "ink", 2.2)
        values.line((k + 0.13, 0), (k + 0.13, p[i]), "accent")
        values.dot((k + 0.13, p[i]), "accent", 2.2)
    values.label((7.0, f[order[-1]]), "$f$", "nw", 5)
    values.label((7.1, p[order[-1]]), "$p$", "nw", 7, "accent")

    result = Canvas(172, 150, (-0.8, 7.8, -0.5, 3.8), 4, stretch=True)
    result.line((-0.7, 0), (7.7, 0))
    for k, i in enumerate(order):
        result.line((k, 0), (k, f[i] / p[i]), "ink")
        result.dot((k, f[i] / p[i]), "ink", 2.2)
    result.line((-0.7, mean), (7.7, mean), "accent")
    result.label((1.4, mean), f"mean {mean:.2f}", "n", 3, "accent")

    both = Canvas(172, 150, (-0.04, 1.04, -0.28, 1.28), 4, stretch=True)
    x = np.linspace(0, 1, 81)
    a, b = np.exp(-((x - 0.3) ** 2) / 0.03), np.exp(-((x - 0.68) ** 2) / 0.05)
    weight = importance_sampling.power_heuristic(a, b)
    for curve, kind in ((0.8 * a, "faint"), (0.8 * b, "faint dashed"), (weight, "accent")):
        both.path(np.stack((x, curve)), kind)
    both.line((0, 0), (1, 0))
    both.label((0.3, 0), "$a$", "s", 4)
    both.label((0.68, 0), "$b$", "s", 4)
    both.label((0.16, 1.0), "weight", "n", 8, "accent")
    return Figure(
        "The integral of $cos^3$ again, with eight directions of the cosine's density.",
        (
            Panel(
                way,
                "Step 1: directions",
                "Eight directions over a surface, more of them steep than flat.",
                "1. Choose directions with a density you know.",
            ),
            Panel(
                values,
                "Step 2: integrand and density",
                "For each direction two stems: the integrand and the density.",
                "2. Integrand $f$ and density $p$ of each.",
            ),
            Panel(
                result,
                "Step 3: the mean of the quotients",
                f"The quotients, and a line at their mean of {mean:.2f}.",
                f"3. The mean of $f / p$: {mean:.2f} with a standard error of {variance**0.5:.2f}.",
            ),
            Panel(
                both,
                "Step 4: two densities",
                "Two bells a and b side by side. The weight of a sample of a is 1 at a's bell and "
                "falls to 0 towards b's.",
                "4. Two densities: a sample's weight follows who is likelier.",
            ),
        ),
    )


def lifted() -> Figure:
    """Malley's method: points of the disk straight up to the hemisphere."""
    u = np.random.default_rng(14).random((2, 26))
    points = importance_sampling.cosine_hemisphere(u)
    view = View(-70, 20)
    canvas = Canvas(350, 190, (-1.7, 1.7, -0.42, 1.12), 4)
    ring(canvas, view, 0, 1, "ink", "faint dashed")
    turn = np.linspace(0, np.pi, 61)
    canvas.path(np.stack((np.cos(turn), np.sin(turn))), "ink")
    base = points * np.array([[1.0], [1], [0]])
    for low, high in zip(view(base).T, view(points).T, strict=True):
        canvas.line(low, high, "faint")
    canvas.dot(view(base), "ink", 2.2)
    canvas.dot(view(points), "accent", 3)
    return Figure(
        "Uniform points of the disk, lifted straight up to the hemisphere. Towards the rim a large part of the "
        "hemisphere stands over a small part of the disk, and gets few points.",
        (
            Panel(
                canvas,
                "Malley's method",
                "A disk with evenly spread points under a hemisphere. From each point a line goes straight up to the "
                "hemisphere.",
            ),
        ),
    )


def above() -> Figure:
    """The same numbers as uniform and as cosine-weighted directions, seen from above."""
    u = np.random.default_rng(15).random((2, 250))
    panels = []
    for warp, words in (
        (importance_sampling.uniform_hemisphere, "Uniform: crowds the rim."),
        (importance_sampling.cosine_hemisphere, "Cosine: fills the disk."),
    ):
        canvas = Canvas(172, 172, (-1, 1, -1, 1), 6)
        canvas.circle((0, 0), 1, "ink")
        canvas.dot(warp(u)[:2], "accent", 1.8)
        panels.append(
            Panel(
                canvas, words, f"250 directions of the hemisphere, seen from above. {words}", words
            )
        )
    return Figure("250 directions, seen from above.", tuple(panels))


FIGURES = {"gain": gain, "lobe": lobe, "steps": steps, "lifted": lifted, "above": above}
