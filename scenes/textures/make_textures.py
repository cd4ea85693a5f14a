"""Paint the three textures that textures.yaml uses, and the mesh that one of them is made for.

Run from the project's folder: ``python scenes/textures/make_textures.py``. A texture is a colour as a function of
u and v, so each is a function of both here, and one loop over pixels makes pictures of them:

- ``globe.png``: land and sea by longitude and latitude, for a sphere. Its left and right edges fit together.
- ``tiles.png``: four tiles of glazed clay, for a floor on which they repeat.
- ``weave.png``: a striped cloth, for ``vase.obj``.
- ``vase.obj``: a solid of revolution with texture coordinates, u around it and v up along its outline.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.engine.formats.pictures.files import save

Array = NDArray[np.float64]
HERE = Path(__file__).parent
AROUND, UPWARDS = 64, 40  # flat pieces of the vase


def globe(u: Array, v: Array) -> Array:
    """Continents from waves over the sphere, with ice at the poles and a grid of meridians and parallels."""
    longitude, latitude = 2 * np.pi * u, np.pi * (v - 0.5)
    x, y, z = (
        np.cos(latitude) * np.cos(longitude),
        np.sin(latitude),
        np.cos(latitude) * np.sin(longitude),
    )
    # Waves in space know nothing of the map's edges; waves that bend waves make coasts.
    height = np.sin(2.3 * x + 1.9 * y + 0.4) + np.sin(2.9 * z - 1.7 * x + 2.0)
    height += 0.6 * np.sin(5.1 * y + 3.7 * z + 1.6 * np.sin(3.1 * x + 0.7))
    height += 0.35 * np.sin(8.3 * x - 6.1 * z + 2.2 * np.sin(4.3 * y + 1.1))
    height += 0.18 * np.sin(17 * z + 13 * y + 2.5 * np.sin(9 * x))
    land = _step(height, 0.28, 0.36)
    sea = _rgb(0.02, 0.09, 0.24) + _rgb(0.02, 0.12, 0.16) * _step(height, -1.2, 0.3)
    green, dry = _rgb(0.10, 0.26, 0.06), _rgb(0.52, 0.36, 0.14)
    ground = green + (dry - green) * _step(np.cos(3 * latitude) + 0.3 * height, 0.2, 1.2)
    ground = ground + (_rgb(0.36, 0.30, 0.25) - ground) * _step(height, 1.3, 2.0)
    color = sea + (ground - sea) * land
    color = color + (_rgb(0.88, 0.92, 0.95) - color) * _step(np.abs(y) + 0.05 * height, 0.86, 0.93)
    degrees_east, degrees_north = 360 * u, 180 * (v - 0.5)
    grid = np.maximum(
        _line(degrees_east, 30, 0.5) * _step(np.cos(latitude), 0.1, 0.2),
        _line(degrees_north, 30, 0.5),
    )
    return color + (_rgb(0.85, 0.78, 0.55) - color) * 0.55 * grid


def tiles(u: Array, v: Array) -> Array:
    """Four tiles, blue ornaments on white and white on blue, with joints between them."""
    column, row = np.floor(2 * u), np.floor(2 * v)
    # From -1 to 1 across each tile.
    x, y = 2 * (2 * u - column) - 1, 2 * (2 * v - row) - 1
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    petals = 0.46 + 0.26 * np.cos(8 * angle)
    ornament = _step(petals - radius, -0.02, 0.02) * _step(radius, 0.14, 0.18)
    corner = np.hypot(1 - np.abs(x), 1 - np.abs(y))
    ornament = np.maximum(ornament, _step(-np.abs(corner - 0.62), -0.075, -0.045))
    ornament = np.maximum(ornament, _step(-corner, -0.34, -0.30))
    white, blue = _rgb(0.82, 0.80, 0.74), _rgb(0.03, 0.10, 0.34)
    swapped = (column + row) % 2
    share = swapped + (1 - 2 * swapped) * ornament
    color = white + (blue - white) * share
    joint = _step(np.maximum(np.abs(x), np.abs(y)), 0.955, 0.985)
    return color + (_rgb(0.30, 0.28, 0.25) - color) * joint


def weave(u: Array, v: Array) -> Array:
    """Bands of warm colours, zigzags between them, and threads that go over and under."""
    color = np.ones_like(u) * _rgb(0.80, 0.66, 0.42)
    zigzag = np.abs(2 * np.mod(12 * u, 1) - 1)
    for middle, width, band in (
        (0.20, 0.050, _rgb(0.55, 0.06, 0.05)),
        (0.36, 0.035, _rgb(0.06, 0.22, 0.26)),
        (0.54, 0.060, _rgb(0.60, 0.10, 0.05)),
        (0.72, 0.035, _rgb(0.06, 0.22, 0.26)),
        (0.86, 0.045, _rgb(0.55, 0.06, 0.05)),
    ):
        inside = _step(width - np.abs(v - middle - 0.05 * (zigzag - 0.5)), -0.003, 0.003)
        color = color + (band - color) * inside
        edge = _step(-np.abs(np.abs(v - middle) - 1.9 * width), -0.009, -0.005)
        color = color + (_rgb(0.10, 0.07, 0.05) - color) * edge
    thread = np.sin(2 * np.pi * 64 * u) * np.sin(2 * np.pi * 64 * v)
    return np.clip(color * (1 + 0.14 * thread), 0, 1)


def picture(color: Callable[[Array, Array], Array], width: int, height: int) -> NDArray[np.float32]:
    """Picture (3, height, width): u to the right, v upwards, each pixel the mean of nine points."""
    total = np.zeros((3, height, width))
    for dv in (1, 3, 5):
        for du in (1, 3, 5):
            u = (np.arange(width) + du / 6) / width
            v = 1 - (np.arange(height) + dv / 6) / height
            u, v = (a.ravel() for a in np.meshgrid(u, v))
            total += color(u, v).reshape(3, height, width)
    return np.asarray(total / 9, np.float32)


def vase() -> str:
    """An OBJ file; the line where it closes has two sets of texture coordinates, u = 0 and u = 1."""
    t = np.arange(UPWARDS + 1) / UPWARDS
    radius = 0.30 + 0.22 * np.sin(np.pi * (1.18 * t + 0.08)) ** 2 * (1.25 - 0.5 * t)
    radius += 0.10 * _step(t, 0.86, 1.0) - 0.06 * _step(-t, -0.12, 0.0)
    lines = ["# made by make_textures.py"]
    for y, r in zip(1.5 * t, radius, strict=True):
        for k in range(AROUND):
            angle = 2 * np.pi * k / AROUND
            lines.append(f"v {r * np.cos(angle):.4f} {y:.4f} {-r * np.sin(angle):.4f}")
    for v in t:
        lines += [f"vt {k / AROUND:.4f} {v:.4f}" for k in range(AROUND + 1)]
    for j in range(UPWARDS):
        for k in range(AROUND):
            corners = ((j, k), (j, k + 1), (j + 1, k + 1), (j + 1, k))
            words = [
                f"{row * AROUND + column % AROUND + 1}/{row * (AROUND + 1) + column + 1}"
                for row, column in corners
            ]
            lines.append("f " + " ".join(words))
    return "\n".join(lines) + "\n"


def _rgb(*color: float) -> Array:
    return np.array(color)[:, None]


def _step(x: Array, low: float, high: float) -> Array:
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def _line(x: Array, every: float, half_width: float) -> Array:
    """1 at the multiples of a number, 0 away from them."""
    away = np.abs(x - every * np.round(x / every))
    return 1 - _step(away, 0.5 * half_width, 1.5 * half_width)


if __name__ == "__main__":
    save(HERE / "globe.png", picture(globe, 720, 360))
    save(HERE / "tiles.png", picture(tiles, 256, 256))
    save(HERE / "weave.png", picture(weave, 768, 256))
    (HERE / "vase.obj").write_text(vase(), encoding="utf-8")
