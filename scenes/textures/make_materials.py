"""Paint wood, boards and felt for tables, floors and walls of many scenes.

Run from the project's folder: ``python scenes/textures/make_materials.py``. The edges of each picture fit together.

- ``wood.webp``: figured mahogany, its grain along u.
- ``boards.webp``: a floor of pale boards along u, each with a grain and a tone of its own.
- ``felt.webp``: grey, the light and the height of felted threads.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Array = NDArray[np.float64]
HERE = Path(__file__).parent
FELT, WOOD, BOARDS = 512, (1024, 512), (1024, 768)
"""Edge, and widths and heights [pixels]."""

PLANKS = 6


def felt(size: int) -> Array:
    """Felted wool: short fibres in all directions, as shares of light and height (size, size)."""
    rng = np.random.default_rng(1984)
    frequency = np.fft.fftfreq(size) * size
    fx, fy = np.meshgrid(frequency, frequency)
    white = np.fft.fft2(rng.standard_normal((size, size)))
    total = np.zeros((size, size))
    # Streaks in six directions: noise that is smooth along each and rough across it.
    for k in range(6):
        angle = np.pi * (k + 0.3) / 6
        along = fx * np.cos(angle) + fy * np.sin(angle)
        across = fy * np.cos(angle) - fx * np.sin(angle)
        shape = np.exp(-((along / 40) ** 2) - (across / 160) ** 2)
        turned = np.roll(white, (37 * k, 91 * k), (0, 1))
        streaks = np.fft.ifft2(turned * shape).real
        total += streaks / streaks.std()
    soft = np.fft.ifft2(white * np.exp(-((np.hypot(fx, fy) / 14) ** 2))).real
    total = total / total.std() + 0.25 * soft / soft.std()
    return np.asarray(0.76 + 0.24 * np.tanh(0.7 * total))


def wood(width: int, height: int) -> Array:
    """Mahogany (3, height, width): growth rings cut lengthwise, and pores along them."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    a, b = 2 * np.pi * u, 2 * np.pi * v
    bend = 0.34 * np.sin(a + 0.5) + 0.16 * np.sin(2 * a - b + 2) + 0.08 * np.sin(3 * a + 2 * b)
    rings = 0.5 + 0.5 * np.sin(5 * b + 3.2 * np.sin(b + bend + 0.7) + 4 * bend)
    fine = 0.5 + 0.5 * np.sin(31 * b + 16 * np.sin(b + bend + 0.7) + 22 * bend)
    rng = np.random.default_rng(22)
    fx, fy = np.meshgrid(np.fft.fftfreq(width) * width, np.fft.fftfreq(height) * height)
    white = np.fft.fft2(rng.standard_normal((height, width)))

    def streaks(along: float, across: float) -> Array:
        smooth = np.fft.ifft2(white * np.exp(-((fx / along) ** 2) - (fy / across) ** 2)).real
        return np.asarray(smooth / smooth.std())

    dark, pale = _rgb(0.13, 0.038, 0.014)[..., None], _rgb(0.40, 0.155, 0.058)[..., None]
    share = np.clip(0.42 * rings + 0.20 * fine + 0.20 + 0.07 * streaks(6, 90), 0, 1)
    pores = _step(streaks(16, 220), 1.5, 2.6)
    return np.asarray((dark + (pale - dark) * share) * (1 - 0.5 * pores))


def boards(width: int, height: int) -> Array:
    """A floor (3, height, width) of boards, two along u in each row; a dark joint lies between any two."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    row = np.floor(PLANKS * v)
    along = np.mod(2 * u + 0.37 * row + 0.5 * (row % 2), 2)
    piece = 2 * row + np.floor(along)
    rng = np.random.default_rng(7)
    tone, shift, bend, tint = rng.random((4, 2 * PLANKS))[:, piece.astype(int)]
    # Each piece is cut from another place of one log, whose rings are long ellipses there.
    x, y = along % 1 - shift, PLANKS * v - row - 0.5 + 3 * (bend - 0.5)
    distance = np.hypot(0.9 * x, y + 0.25 * np.sin(2.2 * x + 6 * shift))
    rings = 0.5 + 0.5 * np.sin(2 * np.pi * 7 * distance + 1.5 * np.sin(5 * x + 9 * bend))
    fx, fy = np.meshgrid(np.fft.fftfreq(width) * width, np.fft.fftfreq(height) * height)
    white = np.fft.fft2(rng.standard_normal((height, width)))
    streaks = np.fft.ifft2(white * np.exp(-((fx / 14) ** 2) - (fy / 260) ** 2)).real
    share = np.clip(0.30 * rings + 0.45 * tone + 0.25 + 0.05 * streaks / streaks.std(), 0, 1)
    dark, pale = _rgb(0.40, 0.235, 0.115)[..., None], _rgb(0.72, 0.53, 0.33)[..., None]
    color = (dark + (pale - dark) * share) * (1 + 0.08 * (tint - 0.5))
    across = np.abs(PLANKS * v - np.round(PLANKS * v)) / PLANKS * height
    ends = np.abs(along - np.round(along)) / 2 * width
    joint = _step(-np.minimum(across, ends), -2.2, -0.8)
    return np.asarray(color * (1 - 0.8 * joint))


def _rgb(*color: float) -> Array:
    return np.array(color)[:, None]


def _step(x: Array, low: float, high: float) -> Array:
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def _save(name: str, codes: Array) -> None:
    """Write codes from 0 to 1, (height, width) or (height, width, 3)."""
    picture = Image.fromarray(np.round(255 * codes).astype(np.uint8))
    picture.save(HERE / f"{name}.webp", quality=88, method=6)


if __name__ == "__main__":
    _save("felt", felt(FELT))
    _save("wood", np.moveaxis(wood(*WOOD), 0, -1) ** (1 / 2.2))
    _save("boards", np.moveaxis(boards(*BOARDS), 0, -1) ** (1 / 2.2))
