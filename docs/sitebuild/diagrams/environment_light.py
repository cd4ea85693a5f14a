"""Figures of environment light: weights as stairs and as columns, and the steps from picture to shadow ray."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import environment_light

WEIGHTS = np.array([4.0, 1, 0.5, 2.5])


def ways() -> Figure:
    """One number, by inversion and by an alias table."""
    u = 0.6
    rows, _ = environment_light.cumulate(WEIGHTS[:, None])
    stairs = Canvas(172, 150, (-0.9, 4.2, -0.14, 1.08), 6, stretch=True)
    stairs.line((0, 0), (4, 0))
    stairs.line((0, 0), (0, 1))
    low = 0.0
    for k, high in enumerate(rows):
        stairs.rectangle((k, low), (k + 1, high), "wash accent" if low <= u < high else "ink")
        low = float(high)
    stairs.arrow((0, u), (int(np.searchsorted(rows, u, "right")), u), "accent")
    stairs.label((0, u), "$u$", "w")
    probability, alias = environment_light.alias_table(WEIGHTS)
    columns = Canvas(172, 150, (-0.9, 4.2, -0.14, 1.08), 6, stretch=True)
    for k, (own, other) in enumerate(zip(probability, alias, strict=True)):
        columns.rectangle((k, 0), (k + 1, own), "ink")
        if own < 1:
            columns.rectangle((k, own), (k + 1, 1), "wash")
            columns.label((k + 0.5, (1 + own) / 2), f"${other}$", "c")
        columns.label((k + 0.5, own / 2), f"${k}$", "c")
    column = int(4 * u)
    columns.line((column, -0.06), (column + 1, -0.06), "accent thick")
    return Figure(
        "Four outcomes with the weights 4, 1, 0.5 and 2.5, and the number 0.6. The sums are searched for the first one "
        "above it. In the table it chooses the third column, whose fraction, 0.4, tells which outcome it is.",
        (
            Panel(
                stairs,
                "Inversion",
                "Stairs whose steps are as high as the weights; u meets one.",
                "Inversion",
            ),
            Panel(
                columns,
                "Alias table",
                "Four columns of equal width, cut into two outcomes each.",
                "An alias table",
            ),
        ),
    )


def steps() -> Figure:
    """From the picture to the shadow ray."""
    sky = np.array([[1, 1, 1, 1, 1, 1], [1, 2, 1, 9, 1, 1], [1, 1, 1, 1, 1, 1]], float)
    panels = []
    words = ("1. Weigh the texels.", "2. Add them up.", "3. Draw a texel, and a place in it.")
    titles = ("Step 1: weights", "Step 2: sums", "Step 3: a direction")
    told = (
        "A picture of three rows of six texels; one is bright.",
        "Bars of the three rows: the middle one has most of the weight.",
        "The bright texel is chosen, with a point in it.",
    )
    for number, (word, title, description) in enumerate(zip(words, titles, told, strict=True)):
        canvas = Canvas(172, 100, (-0.1, 6.1, 3.1, -0.1), 6)
        if number == 1:
            rows, _ = environment_light.cumulate(sky)
            for k, high in enumerate(rows):
                canvas.rectangle((0, k), (6 * high, k + 0.8), "wash accent" if k == 1 else "wash")
        else:
            canvas.rectangle((3, 1), (4, 2), "wash accent")
            canvas.grid((0, 0), (6, 3), 6, 3)
            canvas.rectangle((0, 0), (6, 3))
        if number == 2:
            canvas.dot((3.7, 1.4), "accent", 3.5)
        panels.append(Panel(canvas, title, description, word))
    ray = Canvas(172, 100, (0, 172, 100, 0))
    ray.surface((160, 84), (12, 84))
    ray.rectangle((104, 50), (128, 84), "shade")
    ray.arrow((60, 84), (124, 12), "accent")
    ray.dot((60, 84))
    ray.label((124, 12), "sun", "w", 10)
    panels.append(
        Panel(
            ray,
            "Step 4: a shadow ray",
            "A ray from a point of the floor towards the sun, past a box.",
            "4. Look whether anything is in the way.",
        )
    )
    return Figure(
        "The first two steps are done once for a picture, the others for each hit.", tuple(panels)
    )


FIGURES = {"ways": ways, "steps": steps}
