"""Make the normal map of gallery/relief.yaml from a height over u and v.

Run from the project's folder: ``python scenes/textures/make_normals.py``. ``bricks.png`` has rows of rounded bricks,
each with a stud; it repeats. Its codes are (1 + n) / 2, with n along u, along v and along the surface's normal.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Array = NDArray[np.float64]
HERE = Path(__file__).parent
SIZE = 256


def height(u: Array, v: Array) -> Array:
    """Four rows of two bricks, each row half a brick further; in units of the picture's width."""
    row = np.floor(4 * v)
    x = np.mod(2 * u + row % 2 / 2, 1) - 0.5
    y = np.mod(4 * v, 1) - 0.5
    # From the nearest edge of the brick inwards, along u and along v in the same unit.
    edge = np.minimum((0.5 - np.abs(x)) / 2, (0.5 - np.abs(y)) / 4)
    brick = 0.02 * _step(edge, 0.008, 0.04)
    stud = np.sqrt(np.maximum(0.05**2 - (x / 2) ** 2 - (y / 4) ** 2, 0))
    return brick + stud * 0.8


def normals() -> NDArray[np.uint8]:
    """Codes (SIZE, SIZE, 3), row 0 on top."""
    place, near = (np.arange(SIZE) + 0.5) / SIZE, 0.5 / SIZE
    u, v = np.meshgrid(place, 1 - place)
    along_u = (height(u + near, v) - height(u - near, v)) / (2 * near)
    along_v = (height(u, v + near) - height(u, v - near)) / (2 * near)
    n = np.stack((-along_u, -along_v, np.ones_like(u)), axis=-1)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    return np.asarray(np.round(255 * (1 + n) / 2), np.uint8)


def _step(x: Array, low: float, high: float) -> Array:
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


if __name__ == "__main__":
    Image.fromarray(normals()).save(HERE / "bricks.png", optimize=True)
