"""Figures of supersampling: a pixel with an edge through it, patterns of samples, the mean, the Gaussian."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, columns
from sitebuild.diagrams.figure import Figure, Panel
from solutions import supersampling

EDGE = ((0.0, 0.2), (1.0, 0.72))
"""Where ink ends in the pixel: above the line through these two points there is paper, below it ink."""

SLOPE = EDGE[1][1] - EDGE[0][1]
INK = 1 - (EDGE[0][1] + EDGE[1][1]) / 2
"""The share of the pixel that is ink."""


def inked(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether places of the pixel are ink; y goes down."""
    return y > EDGE[0][1] + SLOPE * x


def pixel() -> Figure:
    """One sample, and sixteen, of a pixel that an edge crosses."""
    panels = []
    for k in (1, 4):
        canvas = _pixel()
        x, y = supersampling.regular(k, 1)[:, 0].astype(float)
        ink = inked(x, y)
        canvas.dot((x[ink], y[ink]), "accent", 4)
        canvas.dot((x[~ink], y[~ink]), "open", 4)
        count = int(ink.sum())
        says = "one sample says ink" if k == 1 else f"{count} of {k * k} samples say ink"
        panels.append(
            Panel(
                canvas,
                says,
                f"A square pixel, crossed by a slanting edge with ink below it. {says}: "
                "filled points lie on ink, rings on paper.",
                f"{k * k} sample{'s' * (k > 1)}: {count / k**2:.2f} ink",
            )
        )
    return Figure(
        f"A pixel on an edge. {INK:.2f} of it is ink. One sample can only say 0 or 1; sixteen come close.",
        tuple(panels),
    )


def patterns() -> Figure:
    """The three patterns, as the course's functions make them."""
    rng = np.random.default_rng(2)
    panels = []
    for name, points, words in (
        ("regular", supersampling.regular(4, 1), "in every pixel alike"),
        ("random", supersampling.random(4, 1, rng), "clumps and gaps"),
        ("jittered", supersampling.jittered(4, 1, rng), "one in each cell"),
    ):
        canvas = _pixel(edge=False)
        canvas.grid((0, 0), (1, 1), 4, 4, "faint" if name != "random" else "faint dashed")
        canvas.dot(points[:, 0], "accent", 3.2)
        panels.append(
            Panel(
                canvas,
                f"16 {name} samples",
                f"A pixel cut into 4 by 4 cells, with 16 samples: {words}.",
                f"{name}: {words}",
            )
        )
    return Figure("Sixteen samples of one pixel, in three patterns.", tuple(panels))


def steps() -> Figure:
    """The algorithm in one pixel."""
    k = 4
    points = supersampling.jittered(k, 1, np.random.default_rng(7))
    x, y = points[:, 0].astype(float)
    ink = inked(x, y)
    weights = supersampling.gaussian_weights(points)
    radiance = np.broadcast_to(np.where(ink, 0.0, 1.0), (3, 1, k * k)).astype(np.float32)
    mean = float(supersampling.resolve(radiance, weights)[0, 0])

    chosen = _pixel()
    chosen.grid((0, 0), (1, 1), k, k)
    chosen.dot((x, y), "ink", 3)

    asked = _pixel()
    asked.dot((x[ink], y[ink]), "accent", 3.6)
    asked.dot((x[~ink], y[~ink]), "open", 3.6)

    weighed = _pixel(edge=False)
    # A weight is an area: the radius grows with its square root.
    for a, b, w, on in zip(x, y, weights[0], ink, strict=True):
        weighed.dot((a, b), "accent" if on else "open", max(0.9, 8 * float(np.sqrt(w))))

    done = _pixel(edge=False)
    done.rectangle((0, 0), (1, 1), "solid", 1 - mean)
    done.rectangle((0, 0), (1, 1), "ink")
    done.label((0.5, 0.5), f"{1 - mean:.2f} ink", "c")
    return Figure(
        "The same pixel at each step. Ink is where the filled points lie; the weights of step 3 are those of the "
        "Gaussian, drawn as areas; the smallest are mere points.",
        (
            Panel(
                chosen,
                "Step 1: points",
                "A pixel with 4 by 4 cells and one point in each.",
                "1. Choose points: one in each cell.",
            ),
            Panel(
                asked,
                "Step 2: radiance",
                "Each point has met ink or paper.",
                "2. Each ray brings back ink or paper.",
            ),
            Panel(
                weighed,
                "Step 3: weights",
                "Points near the middle are large, points at the rim are tiny.",
                "3. Give each sample a weight $w_i$.",
            ),
            Panel(
                done,
                "Step 4: the mean",
                f"The whole pixel has one colour, {1 - mean:.2f} of ink.",
                "4. The weighted mean is the pixel's colour.",
            ),
        ),
    )


def gaussian() -> Figure:
    """The weight across the middle of a pixel."""
    canvas = Canvas(350, 150, (-0.2, 1.2, -0.1, 0.44), 4)
    x = np.linspace(0, 1, 81)
    offsets = np.stack((x, np.full_like(x, 0.5)))[:, :, None]
    tall = 0.36
    w = supersampling.gaussian_weights(offsets)[:, 0] * tall
    canvas.path(columns([(0, 0), *zip(x, w, strict=True), (1, 0)]), "wash", closed=True)
    canvas.path((x, w), "accent")
    canvas.line((-0.06, 0), (1.06, 0))
    for edge, words in ((0, "0"), (0.5, "½"), (1, "1")):
        canvas.line(canvas.away((edge, 0), 0, -4), canvas.away((edge, 0), 0, 4))
        canvas.label((edge, 0), f"${words}$", "s", 7)
    canvas.line((0.5, 0), (0.5, tall), "faint dashed")
    canvas.label((0.5, tall), "$1$", "n", 3)
    sixth = float(np.exp(-0.5)) * tall
    canvas.arrow((0.5, sixth), (0.5 + 1 / 6, sixth))
    canvas.label((0.5 + 1 / 12, sixth), "$σ$", "n", 3)
    canvas.label((0.5 + 1 / 6, sixth), "weight 0.61", "e", 8)
    canvas.label((1.06, 0), "$x$", "e", 5)
    return Figure(
        "The weight of a sample in the middle row of a pixel, for the default sigma of a sixth of a pixel. At the "
        f"pixel's edge it has fallen to {float(np.exp(-4.5)):.3f}.",
        (
            Panel(
                canvas,
                "The Gaussian across a pixel",
                "A bell from 0 to 1 with its peak of 1 in the middle. One sigma beside the middle it is 0.61; at the "
                "pixel's edges, three sigma away, next to nothing.",
            ),
        ),
    )


def _pixel(edge: bool = True) -> Canvas:
    canvas = Canvas(172, 172, (0, 1, 1, 0), 5)
    if edge:
        canvas.path(columns([*EDGE, (1, 1), (0, 1)]), "wash", closed=True)
        canvas.line(*EDGE, "accent")
    canvas.rectangle((0, 0), (1, 1))
    return canvas


FIGURES = {"pixel": pixel, "patterns": patterns, "steps": steps, "gaussian": gaussian}
