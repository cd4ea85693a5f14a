"""Figures of multiple importance sampling: two densities and their weights, the steps, and the measured plates."""

import json

import numpy as np

from course.engine.functions.effects import PROJECT
from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import multiple_importance

PLATES = PROJECT / "docs" / "data" / "plates" / "veach.json"


def weights() -> Figure:
    """A lamp and a lobe over one angle, and the weights of both heuristics."""
    x = np.linspace(-1, 1, 201)
    lamp = np.where(np.abs(x - 0.15) < 0.14, 3.2, 0.0)
    lobe = 1.1 * np.exp(-((x + 0.15) ** 2) / 0.09)
    panels = []
    above = Canvas(172, 150, (-1.05, 1.05, -0.5, 3.7), 5, stretch=True)
    above.path(np.stack((x, lobe)), "ink")
    above.path(np.stack((x, lamp)), "accent")
    above.line((-1, 0), (1, 0))
    above.label((-0.62, 1.1), "lobe", "n", 2)
    above.label((0.34, 3.0), "lamp", "e", 4, "accent")
    above.label((0, 0), "direction", "s", 4)
    panels.append(
        Panel(
            above,
            "Two densities",
            "A wide bell, the lobe, and a high narrow block beside its middle, the lamp.",
            "Densities of both strategies.",
        )
    )
    for exponent, name in ((1.0, "Balance"), (2.0, "Power")):
        found = multiple_importance.heuristic_weights(
            np.array([1, 1]), np.stack((lamp, lobe)), exponent
        )
        canvas = Canvas(172, 150, (-1.05, 1.05, -0.16, 1.16), 5, stretch=True)
        canvas.path(np.stack((x, found[1])), "ink")
        canvas.path(np.stack((x, found[0])), "accent")
        canvas.line((-1, 0), (1, 0), "faint")
        canvas.label((-0.5, 1), "lobe", "n", 2)
        share = found[0].max()
        canvas.label((-0.04, 0.6), f"lamp {share:.2f}", "w", 4, "accent")
        panels.append(
            Panel(
                canvas,
                f"{name} heuristic",
                f"The lobe's weight is 1 but for the lamp's directions, where the lamp has up to {share:.2f}.",
                f"{name} heuristic: weights.",
            )
        )
    return Figure(
        "Over the angle of a direction: where the lamp is, its points are denser than the lobe's directions, and count "
        "more. The power heuristic goes further than the balance heuristic. Everywhere the weights add up to 1.",
        tuple(panels),
    )


def steps() -> Figure:
    """A point on the lamp, a direction of the lobe, and what each asks of the other."""
    panels = []
    point, lamp = np.array([40.0, 100]), (np.array([112.0, 22]), np.array([150.0, 40]))
    words = (
        "1. A point on the lamp, and its density.",
        "2. How dense is the lobe there?",
        "3. A direction of the lobe, and its density.",
        "4. If it meets the lamp: how dense is the lamp there?",
    )
    told = (
        "A ray from a plate to a point on a lamp.",
        "The same ray, and the lobe around the mirrored direction, in which it lies at the side.",
        "A ray in the middle of the lobe.",
        "The ray of the lobe goes on to the lamp.",
    )
    turn = np.linspace(-np.pi / 2, np.pi / 2, 61)
    axis = np.array([0.78, -0.62])
    side = np.array([0.62, 0.78])
    reach = 52 * np.cos(turn) ** 6
    lobe = point[:, None] + reach * (axis[:, None] * np.cos(turn) + side[:, None] * np.sin(turn))
    on_lamp, within = np.array([121.0, 26.3]), np.array([138.0, 34.3])
    for k, word in enumerate(words):
        canvas = Canvas(172, 120, (0, 172, 120, 0))
        canvas.surface((166, 100), (8, 100))
        canvas.line(*lamp, "accent thick")
        if k:
            canvas.path(lobe, "faint" if k == 1 else "ink", closed=True)
        if k < 2:
            canvas.arrow(point, on_lamp, "accent")
            canvas.dot(on_lamp, "accent")
        else:
            canvas.arrow(
                point, point + 50 * (within - point) / np.linalg.norm(within - point), "ink"
            )
        if k == 3:
            canvas.line(point, within, "faint dashed")
            canvas.dot(within, "ink")
        canvas.dot(point)
        panels.append(Panel(canvas, f"Step {k + 1}", told[k], word))
    return Figure(
        "Each strategy asks the other for its density, in the same measure.", tuple(panels)
    )


def digits(number: float) -> str:
    """Two digits, and never a power of ten."""
    return f"{number:.1f}" if number < 10 else f"{number:,.0f}"


def plates() -> Figure:
    """What was measured of each plate under each lamp."""
    data = json.loads(PLATES.read_text(encoding="utf-8"))
    deviation = {way: np.array(rows) for way, rows in data["deviation of a sample"].items()}
    timed = {way: deviation[way] * np.sqrt(rows) for way, rows in data["seconds"].items()}
    ratio = deviation["power"] / np.minimum(deviation["lobe"], deviation["lamp"])
    saved = np.maximum(timed["lobe"], timed["lamp"]) / timed["power"]
    canvas = Canvas(350, 262, (-1.72, 4.06, 5.42, -0.86), 4, stretch=True)
    for column, radius in enumerate(data["radii"]):
        canvas.label((column + 0.5, 0), f"{radius:g}", "n", 5)
    canvas.label((2, -0.45), "radius of the lamp", "n", 3)
    for row, (name, exponent) in enumerate(zip(data["plates"], data["exponents"], strict=True)):
        canvas.label((0, row + 0.32), name, "w", 5)
        canvas.label((0, row + 0.72), f"{exponent:,g}", "w", 5, "faint")
        for column in range(ratio.shape[1]):
            low, high = (column, row), (column + 1, row + 1)
            lamps = deviation["lamp"][row, column] < deviation["lobe"][row, column]
            if lamps:
                canvas.rectangle(low, high, "wash")
            canvas.rectangle(low, high, "faint")
            canvas.label((column + 0.5, row + 0.34), f"{ratio[row, column]:.2f}", "c")
            canvas.label(
                (column + 0.5, row + 0.72), f"1/{digits(saved[row, column])}", "c", 6, "faint"
            )
    return Figure(
        "Error with both (power heuristic) for each plate and lamp: above, over that of the better strategy at equal "
        "samples a pixel; below, over that of the worse one in equal time. Coloured where points on the lamp are the "
        f"better strategy, white where the lobe is. Measured: {data['about']}.",
        (
            Panel(
                canvas,
                "Five plates by four lamps",
                "A table of five rows and four columns. Error over that of the better strategy lies between "
                f"{ratio.min():.2f} and {ratio.max():.2f}.",
            ),
        ),
    )


FIGURES = {"weights": weights, "steps": steps, "plates": plates}
