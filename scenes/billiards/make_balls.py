"""Paint the five numbered balls of ``gallery/1984.yaml``, each by longitude and latitude.

Run from the project's folder: ``python scenes/billiards/make_balls.py``. A numeral is a distance from strokes, and a
stroke is a line or an arc: no font is needed.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.engine.formats.pictures.files import save

Array = NDArray[np.float64]
HERE = Path(__file__).parent
HEIGHT = 512
"""Of a picture [pixels]."""

IVORY, INK = (0.80, 0.76, 0.66), (0.012, 0.012, 0.014)
SPOT = 0.45
"""Radius of the white spot, seen from the front, in radii of the ball."""

BALLS = {
    1: ((0.80, 0.46, 0.015), False),
    3: ((0.60, 0.025, 0.018), False),
    4: ((0.085, 0.022, 0.20), False),
    8: ((0.010, 0.010, 0.012), False),
    9: ((0.80, 0.46, 0.015), True),
}
"""Colour of each ball, linear, and whether it is a stripe around an ivory ball."""


def ball(number: int) -> Callable[[Array, Array], Array]:
    """A ball's colour; its number is read from +z, and from behind."""
    color, stripe = BALLS[number]

    def painted(u: Array, v: Array) -> Array:
        longitude, latitude = 2 * np.pi * u, np.pi * (v - 0.5)
        x = np.cos(latitude) * np.cos(longitude)
        y, z = np.sin(latitude), -np.cos(latitude) * np.sin(longitude)
        body = _rgb(*color) * np.ones_like(u)
        if stripe:
            body = _mixed(body, _rgb(*IVORY), _step(np.abs(y), 0.575, 0.585))
        # From behind, right is where left was.
        x = np.where(z < 0, -x, x)
        body = _mixed(body, _rgb(*IVORY), _step(SPOT - np.hypot(x, y), -0.005, 0.005))
        size = 0.55
        inked = _step(-numeral(number, x / size, y / size) * size, -0.005, 0.005)
        return _mixed(body, _rgb(*INK), inked)

    return painted


STROKE = 0.088
"""Half the width of a stroke, of numerals that are 1 high."""


def numeral(number: int, x: Array, y: Array) -> Array:
    """Distance from a numeral about the origin, negative within its strokes."""
    top = 0.5 - STROKE
    match number:
        case 1:
            strokes = [
                _line(x, y, (0.06, -top), (0.06, top)),
                _line(x, y, (0.06, top), (-0.16, 0.24)),
            ]
        case 3:
            strokes = [
                _arc(x, y, (0, 0.208), 0.204, -90, 165),
                _arc(x, y, (0, -0.190), 0.222, -165, 90),
            ]
        case 4:
            corner, heel = (0.12, top), (-0.29, -0.17)
            strokes = [
                _line(x, y, corner, heel),
                _line(x, y, heel, (0.31, -0.17)),
                _line(x, y, corner, (0.12, -top)),
            ]
        case 8:
            strokes = [_arc(x, y, (0, 0.215), 0.197), _arc(x, y, (0, -0.188), 0.224)]
        case 9:
            # A line below it tells it from a 6.
            strokes = [
                _arc(x, y, (0, 0.19), 0.222),
                _line(x, y, (0.203, 0.098), (-0.04, -top)),
                _line(x, y, (-0.17, -0.62), (0.17, -0.62)) + 0.035,
            ]
        case _:
            raise ValueError(f"no numeral {number}")
    return np.minimum.reduce(strokes) - STROKE


def picture(color: Callable[[Array, Array], Array], width: int, height: int) -> NDArray[np.float32]:
    """Picture (3, height, width): u to the right, v upwards, each pixel the mean of nine points."""
    total = np.zeros((3, height, width))
    for dv in (1, 3, 5):
        for du in (1, 3, 5):
            u, v = (np.arange(width) + du / 6) / width, 1 - (np.arange(height) + dv / 6) / height
            u, v = (a.ravel() for a in np.meshgrid(u, v))
            total += color(u, v).reshape(3, height, width)
    return np.asarray(total / 9, np.float32)


def _line(x: Array, y: Array, a: tuple[float, float], b: tuple[float, float]) -> Array:
    """Distance from a line between two points."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = np.clip(((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy), 0, 1)
    return np.hypot(x - a[0] - t * dx, y - a[1] - t * dy)


def _arc(
    x: Array,
    y: Array,
    center: tuple[float, float],
    radius: float,
    start: float = -180,
    end: float = 180,
) -> Array:
    """Distance from an arc, counter-clockwise from one angle to another [degrees]."""
    x, y = x - center[0], y - center[1]
    middle, half = np.radians((start + end) / 2), np.radians((end - start) / 2)
    angle = np.mod(np.arctan2(y, x) - middle + np.pi, 2 * np.pi) - np.pi
    angle = np.clip(angle, -half, half) + middle
    return np.hypot(x - radius * np.cos(angle), y - radius * np.sin(angle))


def _rgb(*color: float) -> Array:
    return np.array(color)[:, None]


def _mixed(a: Array, b: Array, share: Array) -> Array:
    """A where the share is 0, B where it is 1."""
    return a + (b - a) * share


def _step(x: Array, low: float, high: float) -> Array:
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


if __name__ == "__main__":
    for number in BALLS:
        save(HERE / f"ball_{number}.png", picture(ball(number), 2 * HEIGHT, HEIGHT))
