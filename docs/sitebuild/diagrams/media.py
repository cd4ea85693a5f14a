"""Figures of media: flights through fog, the steps of a path, lobes, delta tracking, even angles."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import media

DENSE = np.array([0.3, 1.6, 0.6, 2.2, 0.2])
"""Densities along a ray."""


def flights() -> Figure:
    """Where twelve flights end, and the share that is left."""
    sigma, length, count = 0.8, 4.0, 12
    canvas = Canvas(350, 190, (-0.2, length + 0.2, -0.15, 1.25), 14, stretch=True)
    canvas.rectangle((0, 0), (length, 1.1), "wash")
    u = np.stack((np.zeros(count), (np.arange(count) * 0.618 + 0.1) % 1))
    ends = media.free_flight(np.full(3, sigma), np.array([1.0, 0, 0]), u)
    for number, end in enumerate(ends):
        height = 1.03 - number * 0.085
        canvas.line((0, height), (min(end, length), height), "faint thin")
        if end < length:
            canvas.dot((end, height), "accent", 2.6)
    t = np.linspace(0, length, 80)
    left = media.transmittance(np.full(3, sigma), t)[0]
    canvas.path(np.stack((t, left)), "accent")
    canvas.arrow((0, 0), (length + 0.15, 0))
    canvas.label((length / 2, 0), "distance", "s", 5)
    through = int((ends >= length).sum())
    return Figure(
        f"Twelve flights through {length:g} units of fog of extinction {sigma:g}. Dots are where they end; {through}"
        " come through. The curve is the transmittance, the share of flights that come farther.",
        (
            Panel(
                canvas,
                "Flights through fog",
                "Horizontal lines of different lengths end at dots, most of them early; a falling curve shows the share"
                " that is left.",
            ),
        ),
    )


def steps() -> Figure:
    """A path in fog."""
    eye, lamp = np.array([-0.2, 0.5]), np.array([2.3, 1.55])
    places = np.array([[1.1, 0.62], [1.7, 1.1], [2.5, 0.4]])
    panels = []
    words = (
        (
            "1. A flight from the eye ends in the fog.",
            "A ray from the eye stops at a dot within a box.",
        ),
        ("2. A shadow ray asks the lamp.", "A dashed line goes from the dot to a lamp above."),
        (
            "3. On by the phase function, and again.",
            "From the dot the path goes on to a second one.",
        ),
    )
    for number, (word, told) in enumerate(words, 1):
        canvas = Canvas(172, 120, (-0.3, 2.9, 0, 1.75), 4)
        canvas.rectangle((0.4, 0.1), (2.7, 1.4), "wash")
        canvas.arrow(eye, places[0], "accent" if number == 1 else "faint")
        canvas.dot(places[0], "ink", 3)
        canvas.dot(lamp, "accent", 4)
        if number >= 2:
            canvas.line(places[0], lamp, "accent dashed" if number == 2 else "faint dashed")
        if number == 3:
            canvas.arrow(places[0], places[1], "accent")
            canvas.dot(places[1], "ink", 3)
            canvas.line(places[1], lamp, "accent dashed")
            canvas.arrow(places[1], places[2], "accent")
        panels.append(Panel(canvas, f"Step {number}", told, word))
    return Figure(
        "The first steps of a path in fog: it ends where chance or a surface says.", tuple(panels)
    )


def lobes() -> Figure:
    """The phase function for three g."""
    panels = []
    turn = np.linspace(0, 2 * np.pi, 181)
    for g in (-0.4, 0.0, 0.4):
        canvas = Canvas(172, 112, (-1.6, 1.6, -1.2, 1.2), 2)
        value = 4 * np.pi * media.henyey_greenstein(np.cos(turn), g)
        size = 0.4 * value
        outline = np.stack((size * np.cos(turn), size * np.sin(turn)))
        canvas.path(outline, "wash", closed=True)
        canvas.path(outline, "accent")
        canvas.arrow((-1.5, 0), (0, 0))
        canvas.dot((0, 0), "ink", 3)
        panels.append(
            Panel(
                canvas,
                f"g = {g:g}",
                f"Light comes from the left; the shape around the place is for g = {g:g}.",
                f"$g$ = {g:g}",
            )
        )
    return Figure(
        "Henyey and Greenstein's phase function, as long in each direction as it is large. Light comes from the left.",
        tuple(panels),
    )


def tracking() -> Figure:
    """Steps of delta tracking along a ray."""
    most, length = float(DENSE.max()), 1.0
    canvas = Canvas(350, 170, (-0.04, 1.06, -0.4, 1.15 * most), 10, stretch=True)
    x = np.linspace(0, 1, 200)
    grid = DENSE.reshape(-1, 1, 1)
    density = np.interp(x * len(DENSE) - 0.5, np.arange(len(DENSE)), DENSE)
    canvas.path(np.stack((np.r_[0, x, 1], np.r_[0, density, 0])), "wash", closed=True)
    canvas.path(np.stack((x, density)), "ink")
    canvas.line((0, most), (1, most), "ink dashed")
    canvas.label((0.02, most), "majorant", "ne", 3)
    u = np.array([[[0.3], [0.25], [0.42], [0.3], [0.2]], [[0.8], [0.95], [0.65], [0.5], [0.1]]])
    rays = np.zeros((3, 1)), np.array([[1.0], [0], [0]]), np.array([length])
    (end,), (stopped,) = media.delta_tracking(grid, most, *rays, u)
    ways = np.cumsum(-np.log1p(-u[0, :, 0])) / most
    for way, real in zip(ways[ways <= end + 1e-9], u[1, :, 0], strict=False):
        canvas.line((way, 0), (way, most), "faint thin")
        if way < end - 1e-9 or not stopped:
            canvas.cross((way, real * most), "ink", 4)
        else:
            canvas.dot((way, real * most), "accent", 3.5)
    canvas.arrow((0, 0), (1.05, 0))
    canvas.label((0.5, 0), "distance", "s", 5)
    return Figure(
        "Delta tracking. Each step ends at a thin line, at a random height up to the majorant. Above the curve, at a"
        " cross, nothing was there, and the flight goes on; below it, at the dot, it ends.",
        (
            Panel(
                canvas,
                "Delta tracking",
                "A curve of densities below a dashed line, the majorant. Steps end at thin lines with crosses above the"
                " curve, until a dot lies below it.",
            ),
        ),
    )


def angles() -> Figure:
    """Places on a ray by even angles."""
    count, length, lamp = 12, 4.0, np.array([1.4, 0.7])
    canvas = Canvas(350, 130, (-0.3, length + 0.3, -0.3, 1.0), 4)
    u = (np.arange(count) + 0.5) / count
    one = np.ones(count)
    arrays = (
        np.zeros((3, count)),
        np.stack((one, 0 * one, 0 * one)),
        np.stack((lamp[0] * one, lamp[1] * one, 0 * one)),
        length * one,
    )
    distance, _ = media.equiangular(*arrays, u)
    canvas.arrow((0, 0), (length + 0.2, 0))
    for t in distance:
        canvas.line(lamp, (t, 0), "faint thin")
        canvas.dot((t, 0), "accent", 2.6)
    canvas.line(lamp, (lamp[0], 0), "ink dashed")
    canvas.label((lamp[0], lamp[1] / 2), "$D$", "e", 4)
    canvas.dot(lamp, "ink", 4)
    canvas.label(lamp, "lamp", "n", 6)
    return Figure(
        "Twelve places by the course's function for even numbers: the lamp sees equal angles between them, so they are"
        " dense where it is near.",
        (
            Panel(
                canvas,
                "Even angles",
                "A lamp above a ray. Lines from it at equal angles meet the ray at dots, dense below the lamp.",
            ),
        ),
    )


FIGURES = {
    "flights": flights,
    "steps": steps,
    "lobes": lobes,
    "tracking": tracking,
    "angles": angles,
}
