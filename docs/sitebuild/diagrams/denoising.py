"""Figures of denoising: means with their errors, critical values, and the steps from samples to a preview."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import denoising

SAMPLES = (
    np.array([0.30, 0.55, 0.42, 0.69]),
    np.array([0.62, 0.38, 0.80, 0.56]),
    np.array([1.06, 1.22, 1.10, 1.30]),
)
"""Of three pixels side by side."""

LEVEL = 0.05


def statistics(a: int, b: int) -> tuple[float, float]:
    """Welch's statistic of two of the pixels, and its critical value."""
    row = np.ones((3, 1))
    given = [
        (row * SAMPLES[k].mean(), row * SAMPLES[k].var(ddof=1), np.array([4.0])) for k in (a, b)
    ]
    t = denoising.welch_t(*given[0], *given[1])
    degrees = denoising.degrees_of_freedom(*given[0][1:], *given[1][1:])
    return float(t[0, 0]), float(denoising.critical_value(degrees[0], LEVEL)[0])


def _pixels(canvas: Canvas, chosen: tuple[int, ...] = ()) -> None:
    """Samples of the pixels as dots, their means with standard errors as bars."""
    canvas.line((0, 0), (3, 0))
    for k, samples in enumerate(SAMPLES):
        x, mean = k + 0.5, samples.mean()
        error = samples.std(ddof=1) / 2
        kind = "accent" if k in chosen else "ink"
        canvas.rectangle((x - 0.2, mean - error), (x + 0.2, mean + error), "wash")
        canvas.line((x - 0.2, mean), (x + 0.2, mean), kind)
        canvas.dot(np.stack((x + np.linspace(-0.15, 0.15, 4), samples)), kind, 2.2)


def _plane() -> Canvas:
    return Canvas(172, 120, (0, 3, -0.12, 1.4), 8, stretch=True)


def pairs() -> Figure:
    """Two pixels that may be equal, and two that are not."""
    panels = []
    for a, b, word in ((0, 1, "may be equal"), (1, 2, "are separated")):
        canvas = _plane()
        _pixels(canvas, (a, b))
        t, critical = statistics(a, b)
        panels.append(
            Panel(
                canvas,
                f"Pixels that {word}",
                f"Dots of four samples in each of three pixels, and bars of their standard errors: two {word}.",
                f"$|t| = {abs(t):.1f}$, critical value {critical:.1f}",
            )
        )
    return Figure(
        "Four samples of three pixels, their means, and bands of one standard error. The means of the first two differ "
        "by less than chance explains, at the level 0.05; those of the last two by more.",
        tuple(panels),
    )


def critical() -> Figure:
    """Critical values over the degrees of freedom."""
    degrees = np.linspace(1, 20, 200)
    canvas = Canvas(350, 150, (0, 20, -1.4, 13), 14, stretch=True)
    canvas.line((0, 0), (20, 0))
    canvas.line((0, 0), (0, 13))
    canvas.path(np.stack((degrees, denoising.critical_value(degrees, LEVEL))), "accent")
    canvas.line((0, 1.96), (20, 1.96), "faint dashed")
    canvas.label((10, 0), "degrees of freedom", "s", 2)
    return Figure(
        "Critical values at the level 0.05. Two samples a pixel leave one or two degrees of freedom, four leave three "
        "to six; with many, 1.96 standard errors are enough (dashed).",
        (Panel(canvas, "Critical values", "A curve that falls from 12.7 towards 1.96.", ""),),
    )


def steps() -> Figure:
    """Samples, tests, weights and the mean."""
    panels = []
    first = _plane()
    _pixels(first)
    panels.append(
        Panel(
            first,
            "Step 1: means",
            "Dots of samples, and bars of means and errors.",
            "1. Keep mean and variance.",
        )
    )
    shown = (True, True, False, True, True, True, False, False, True)
    places = [(x, y) for y in range(3) for x in range(3)]
    for word, title in (
        ("2. Test the neighbours.", "Step 2: tests"),
        ("3. Weigh them.", "Step 3: weights"),
    ):
        canvas = Canvas(172, 120, (-0.1, 3.1, -0.1, 3.1), 6)
        for (x, y), joined in zip(places, shown, strict=True):
            far = float(np.hypot(x - 1, y - 1))
            weight = float(denoising.pair_weights(*_agreeing(far))[0]) if joined else 0.0
            if title.startswith("Step 2"):
                canvas.rectangle((x, y), (x + 1, y + 1), "wash accent" if joined else "shade")
            elif weight:
                canvas.dot((x + 0.5, y + 0.5), "accent", 3 + 11 * weight)
        canvas.grid((0, 0), (3, 3), 3, 3)
        canvas.rectangle((0, 0), (3, 3))
        panels.append(
            Panel(canvas, title, f"Nine pixels around the middle one: {title.lower()}.", word)
        )
    last = Canvas(172, 120, (0, 3, -0.12, 1.4), 8, stretch=True)
    last.line((0, 0), (3, 0))
    both = float(np.mean(SAMPLES[:2]))
    for k, mean in enumerate((both, both, SAMPLES[2].mean())):
        last.rectangle((k + 0.3, 0), (k + 0.7, float(mean)), "wash accent" if k < 2 else "wash")
    panels.append(
        Panel(
            last,
            "Step 4: means of means",
            "Two pixels have a common mean, the third has its own.",
            "4. Average.",
        )
    )
    return Figure(
        "Neighbours that the test separates have no weight; the others have less the farther away they are.",
        tuple(panels),
    )


def _agreeing(distance: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    return np.zeros((3, 1)), np.ones((3, 1)), np.array([distance]), 1.0


FIGURES = {"pairs": pairs, "critical": critical, "steps": steps}
