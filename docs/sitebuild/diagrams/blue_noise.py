"""Figures of blue noise: two curves through all pixels, white and blue masks, and the steps to a pixel's points."""

import numpy as np

from course.engine.terms.samplers.sobol import owen_scrambled, sobol_words
from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import blue_noise

LEVELS, SEED = 3, 6
SIDE = 2**LEVELS


def numbers(side: int, shuffled: bool) -> np.ndarray:
    """The number (side, side) of each pixel on a curve."""
    y, x = np.divmod(np.arange(side * side), side)
    levels = side.bit_length() - 1
    curve = (
        blue_noise.shuffled_z_order(x, y, levels, SEED) if shuffled else blue_noise.z_order(x, y)
    )
    return curve.reshape(side, side)


def order() -> Figure:
    """Both curves, from pixel to pixel."""
    panels = []
    for shuffled, words in ((False, "The Z-order."), (True, "Shuffled, quadrant by quadrant.")):
        canvas = Canvas(172, 172, (0, SIDE, SIDE, 0), 4)
        canvas.grid((0, 0), (SIDE, SIDE), 4, 4)
        canvas.rectangle((0, 0), (SIDE, SIDE))
        y, x = np.divmod(np.argsort(numbers(SIDE, shuffled), axis=None), SIDE)
        places = np.stack((x, y)) + 0.5
        for quarter in range(4):
            part = places[:, 16 * quarter : 16 * (quarter + 1)]
            canvas.path(part, "accent" if quarter == 0 else "ink")
        canvas.dot(places[:, 0], "accent", 3.4)
        panels.append(
            Panel(
                canvas, words, f"A line from pixel to pixel of 8 by 8, 16 at a time. {words}", words
            )
        )
    return Figure(
        "Two curves through 8 by 8 pixels, drawn in four pieces of 16 pixels; the first piece is coloured, and "
        "begins at the dot. Both visit a quadrant as a whole, and within it each smaller one.",
        tuple(panels),
    )


def masks() -> Figure:
    """Places of low ranks of a white mask and of a blue one."""
    side, count = 20, 80
    u = np.random.default_rng(5).random((side, side))
    panels = []
    for ranks, words in (
        (np.argsort(np.argsort(u, axis=None)).reshape(u.shape), "Ranks at random: white noise."),
        (blue_noise.void_and_cluster(u, 1.5), "Void and cluster: blue noise."),
    ):
        canvas = Canvas(172, 172, (0, side, side, 0), 4)
        canvas.rectangle((0, 0), (side, side))
        y, x = np.nonzero(ranks < count)
        canvas.dot(np.stack((x, y)) + 0.5, "accent", 3)
        panels.append(Panel(canvas, words, f"{count} dots in a square. {words}", words))
    return Figure(
        f"Masks of {side} by {side} pixels: dots are the pixels with the {count} lowest ranks, a fifth of all. Any "
        "other share looks like that, too.",
        tuple(panels),
    )


def _table(shuffled: bool, chosen: tuple[int, int]) -> Canvas:
    canvas = Canvas(172, 130, (0, 4, 4, 0), 6)
    canvas.rectangle((chosen[1], chosen[0]), (chosen[1] + 1, chosen[0] + 1), "wash accent")
    canvas.grid((0, 0), (4, 4), 4, 4)
    canvas.grid((0, 0), (4, 4), 2, 2, "ink")
    canvas.rectangle((0, 0), (4, 4))
    for (row, column), number in np.ndenumerate(numbers(4, shuffled)):
        kind = "accent" if (row, column) == chosen else ""
        canvas.label((column + 0.5, row + 0.5), f"{number}", "c", 0, kind)
    return canvas


def steps() -> Figure:
    """From a pixel's place to its samples."""
    chosen = (1, 2)
    own = int(numbers(4, True)[chosen])
    quadrant = own // 4
    words = owen_scrambled(
        sobol_words(np.arange(64, dtype=np.uint32)), np.array([[3], [8]], np.uint32)
    )
    points = words / 2.0**32
    panels = [
        Panel(
            _table(False, chosen),
            "Step 1: the Z-order",
            f"Numbers 0 to 15 of 4 by 4 pixels; that of column 2, row 1 is {numbers(4, False)[chosen]}.",
            "1. Number the pixels.",
        ),
        Panel(
            _table(True, chosen),
            "Step 2: shuffled",
            f"The same pixels with other numbers; quadrants still have four in a row. The pixel has {own}.",
            "2. Shuffle the parts of each quadrant.",
        ),
    ]
    for first, count, cells, said in (
        (
            4 * own,
            4,
            2,
            f"3. Points {4 * own} to {4 * own + 3} are the pixel's: one in each quarter.",
        ),
        (16 * quadrant, 16, 4, "Its quadrant has 16 points: one in each cell."),
    ):
        canvas = Canvas(172, 130, (-0.02, 1.02, -0.02, 1.02), 6)
        canvas.grid((0, 0), (1, 1), cells, cells)
        canvas.rectangle((0, 0), (1, 1))
        canvas.dot(points[:, first : first + count], "ink" if count > 4 else "accent", 3)
        if count > 4:
            canvas.dot(points[:, 4 * own : 4 * own + 4], "accent", 3)
        title = "Step 3: the pixel's points" if count == 4 else "The quadrant's points"
        panels.append(Panel(canvas, title, f"{count} points in a square. {said}", said))
    return Figure(
        "One pixel of 4 by 4, coloured, with four samples, on its way to its points.", tuple(panels)
    )


FIGURES = {"order": order, "masks": masks, "steps": steps}
