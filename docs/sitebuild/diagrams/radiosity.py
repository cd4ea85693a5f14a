"""Figures of radiosity: two patches, the hemicube, light spreading through a room."""

from itertools import pairwise

import numpy as np

from sitebuild.diagrams.canvas import Canvas, moved, turned, unit
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.view import View
from solutions import radiosity

SIDE = 12
"""Patches of each wall of the room in section."""


def patches() -> Figure:
    """What stands where in the form factor."""
    canvas = Canvas(350, 210, (-1.9, 2.7, -0.45, 2.3), 4)
    i, j = np.array([-0.9, 0.0]), np.array([1.35, 1.45])
    lean = turned(252)
    along = np.array([-lean[1], lean[0]])
    canvas.surface(moved(i, -0.6, 0), moved(i, 0.6, 0))
    canvas.surface(j - 0.55 * along, j + 0.55 * along)
    canvas.arrow(i, i + np.array([0, 1.1]))
    canvas.arrow(j, j + 1.0 * lean)
    canvas.line(i, j, "accent")
    canvas.angle(i, i + np.array([0, 1.0]), j, "$θ_i$", 34)
    canvas.angle(j, j + lean, i, "", 44)
    middle = unit(lean + unit(i - j))
    canvas.label(j + 0.92 * middle, "$θ_j$", "c")
    canvas.dot(i, "ink", 3)
    canvas.dot(j, "ink", 3)
    canvas.label(i, "patch $i$, area $A_i$", "s", 12)
    canvas.label(j - 0.3 * lean, "patch $j$, area $A_j$", "n", 4)
    canvas.label((i + j) / 2, "$r$", "se", 6, "accent")
    return Figure(
        "A point of patch $i$ and one of patch $j$. The more the line between them leans from either "
        "normal, and the longer "
        "it is, the less light they exchange.",
        (
            Panel(
                canvas,
                "Two patches",
                "Two patches with their normals and the line r between them; theta i and theta j are "
                "the angles of that "
                "line to the normals.",
            ),
        ),
    )


def hemicube() -> Figure:
    """The five faces over a patch, each cell with its share."""
    k = 8
    top, side = radiosity.hemicube_form_factors(k)
    view = View(-52, 28)
    canvas = Canvas(350, 240, (-2.0, 2.0, -0.82, 1.62), 4)
    largest = float(top.max())
    step = 2 / k

    def cell(corner: np.ndarray, a: np.ndarray, b: np.ndarray, share: float) -> None:
        spots = np.stack((corner, corner + a, corner + a + b, corner + b), axis=1)
        x = view(spots)
        canvas.path(x, "paper faint", closed=True)
        canvas.path(x, "solid", closed=True)
        canvas.elements[-1].set("fill-opacity", f"{0.9 * share / largest:.2f}")

    ex, ey, ez = np.eye(3) * step
    for row in range(k):
        for column in range(k):
            cell(
                np.array([-1 + step * column, -1 + step * row, 1.0]),
                ex,
                ey,
                float(top[row, column]),
            )
    for row in range(k // 2):
        for column in range(k):
            share = float(side[row, column])
            cell(np.array([1.0, -1 + step * column, step * row]), ey, ez, share)
            cell(np.array([-1 + step * column, -1.0, step * row]), ex, ez, share)
    canvas.label(view([-1.0, 1.0, 1.0]), "top", "n", 3)
    canvas.label(view([1.0, 0.3, 0.0]), "side", "s", 9)
    return Figure(
        f"Half a cube over a patch, {k} by {k} cells on top and {k // 2} by {k} on each side. The "
        "fuller a cell's colour, the larger "
        f"its share of the light: from {float(side.min()):.5f} to {largest:.4f}. The patch lies in "
        "the middle of the base.",
        (
            Panel(
                canvas,
                "A hemicube with its cells",
                "Half a cube seen from above. Cells in the middle of the top are filled most; those "
                "at the top's corners "
                "and low on the sides hardly at all.",
            ),
        ),
    )


def section() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A square room in section: ends (2, 2, P) of its patches, their reflectance, emission and form factors.

    In the plane the share that reaches a patch is exact: Hottel's crossed strings.
    """
    s = np.linspace(0, 1, SIDE + 1)
    corners = [np.array(c, float) for c in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))]
    points = np.concatenate(
        [a[:, None] + (b - a)[:, None] * s[None, :-1] for a, b in pairwise(corners)],
        axis=1,
    )
    ends = np.stack((points, np.roll(points, -1, axis=1)), axis=1)
    start, stop = ends[:, 0], ends[:, 1]

    def far(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.hypot(*(a[:, :, None] - b[:, None, :]))

    length = np.hypot(*(stop - start))
    strings = far(start, start) + far(stop, stop) - far(start, stop) - far(stop, start)
    factors = np.abs(strings) / (2 * length[:, None])
    wall = np.repeat(np.arange(4), SIDE)
    factors[wall[:, None] == wall[None, :]] = 0
    emission = np.zeros(4 * SIDE)
    # The lamp: the middle of the ceiling.
    emission[2 * SIDE + SIDE // 2 - 1 : 2 * SIDE + SIDE // 2 + 1] = 1
    reflectance = np.where(emission > 0, 0.0, 0.75)
    return ends, reflectance, emission, factors


def spreading() -> list[np.ndarray]:
    """The room's radiosity after 0, 1, 2 and 40 iterations of the course's `gather`."""
    _, reflectance, emission, factors = section()
    color = np.broadcast_to(emission, (3, emission.size))
    paint = np.broadcast_to(reflectance, color.shape)
    found, light = [], color
    for k in range(41):
        if k in (0, 1, 2, 40):
            found.append(light[0])
        light = radiosity.gather(light, color, paint, factors)
    return found


def steps() -> Figure:
    """The room after some iterations."""
    ends = section()[0]
    lights = spreading()
    brightest = float(np.delete(lights[-1], [2 * SIDE + SIDE // 2 - 1, 2 * SIDE + SIDE // 2]).max())
    words = (
        "At first only the lamp gives light.",
        "1 iteration: all that see the lamp.",
        "2: the ceiling too, from floor and walls.",
        "40: hardly anything changes.",
    )
    panels = []
    for light, word in zip(lights, words, strict=True):
        canvas = Canvas(172, 172, (-0.16, 1.16, -0.16, 1.16), 2)
        for k, value in enumerate(light):
            a, b = ends[:, 0, k], ends[:, 1, k]
            out = np.array([(b - a)[1], -(b - a)[0]])
            out *= 0.11 / np.hypot(*out)
            canvas.path(np.stack((a, b, b + out, a + out), axis=1), "solid", closed=True)
            canvas.elements[-1].set("fill-opacity", f"{min(1, 0.9 * value / brightest):.2f}")
            canvas.path(np.stack((a, b, b + out, a + out), axis=1), "faint", closed=True)
        dark = int((light < 1e-9).sum())
        panels.append(
            Panel(
                canvas,
                word.rstrip("."),
                f"A square room in section, each wall of {SIDE} patches, the lamp in the middle of the ceiling. {dark} "
                f"patches are without light.",
                word,
            )
        )
    return Figure(
        f"Gathering, in a room in section whose walls are cut into {SIDE} patches each. The fuller a "
        "patch, the more light "
        "leaves it; the lamp would be fuller than the scale goes.",
        tuple(panels),
    )


FIGURES = {"patches": patches, "hemicube": hemicube, "steps": steps}
