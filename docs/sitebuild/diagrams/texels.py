"""A picture of few texels, and the four whose colours are mixed at a place: cube maps and textures look up alike."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, moved


def first_of_four(place: np.ndarray) -> np.ndarray:
    """Column and row of the upper left of the texels around a place."""
    return np.floor(place - 0.5)


def draw_texels(canvas: Canvas, size: int, place: np.ndarray) -> None:
    """Draw size by size texels with their centres, and the place."""
    canvas.rectangle((0, 0), (size, size))
    canvas.grid((0, 0), (size, size), size, size)
    centres = np.arange(size) + 0.5
    canvas.dot(np.stack(np.meshgrid(centres, centres)).reshape(2, -1), "ink", 1.8)
    canvas.dot(place, "accent", 3.6)


def draw_weights(canvas: Canvas, place: np.ndarray) -> None:
    """Draw the four around the place with their weights.

    The weights are areas: what of a square as large as a texel lies on each of the four.
    """
    low = first_of_four(place)
    share = place - 0.5 - low
    canvas.rectangle(place - 0.5, place + 0.5, "wash accent")
    canvas.rectangle(low, low + 2)
    canvas.grid(low, low + 2, 2, 2)
    canvas.dot(place, "accent", 3.6)
    for j in (0, 1):
        for i in (0, 1):
            weight = abs(1 - i - share[0]) * abs(1 - j - share[1])
            canvas.label(moved(low, 0.3 + 1.4 * i, 0.16 + 1.68 * j), f"{weight:.2f}", "c")
