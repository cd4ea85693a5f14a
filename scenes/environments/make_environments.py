"""Paint the four environments that scenes use: two skies, a studio and a valley with a lake.

Run from the project's folder: ``python scenes/environments/make_environments.py``. An environment is nothing but
radiance as a function of direction, so each is a function of directions (3, N) here, y up, and two loops over pixels
make pictures of them:

- ``sky.exr``, ``studio.exr``: latitude and longitude, linear, brighter than 1 where light comes from. Their lights
  are large and soft, and so are the shadows in a scene with ``lights: true``.
- ``clear_sky.exr``: the same form, with a sun as small as its picture allows.
- ``valley.png``: the six faces of a cube as a cross, sRGB of 8 bits, so nothing in it is brighter than 1.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.engine.formats.pictures.files import save

Array = NDArray[np.float64]
HERE = Path(__file__).parent
SKY_HEIGHT, STUDIO_HEIGHT, CLEAR_SKY_HEIGHT, FACE = 176, 128, 128, 336  # pixels


def sky(direction: Array) -> Array:
    """A day with high clouds; the sun is a soft glow behind the left shoulder of a camera that looks along -z."""
    x, y, z = direction
    horizon, zenith = _rgb(0.62, 0.70, 0.80), _rgb(0.10, 0.24, 0.56)
    radiance = horizon + (zenith - horizon) * np.clip(y, 0, 1) ** 0.55
    # Clouds lie in a plane above: far ones crowd together towards the horizon. Waves that bend waves look torn.
    far = 1.0 / (np.maximum(y, 0) + 0.12)
    p, q = 1.6 * x * far, 1.6 * z * far
    p, q = p + 0.9 * np.sin(0.9 * q + 1.3), q + 0.7 * np.sin(1.1 * p + 0.4)
    waves = np.sin(1.3 * p + 0.6 * q) + 0.6 * np.sin(2.1 * q - 1.2 * p + 2)
    waves += 0.35 * np.sin(4.3 * p + 1.7 * q) + 0.25 * np.sin(3.1 * p - 6.2 * q + 1)
    cover = 0.75 * _step(waves, 0.25, 1.5) * _step(y, 0.02, 0.3)
    radiance += (_rgb(0.95, 0.94, 0.93) - radiance) * cover
    angle = np.arccos(np.clip(_unit(-0.75, 0.62, 0.45) @ direction, -1, 1))
    glow = 7.0 * np.exp(-((angle / 0.22) ** 2)) + 0.9 * np.exp(-angle / 0.3)
    radiance += _rgb(1.0, 0.86, 0.62) * glow
    ground = _rgb(0.20, 0.18, 0.15) * (1 + 0.5 * y)
    return radiance + (ground - radiance) * _step(-y, -0.01, 0.05)


def clear_sky(direction: Array) -> Array:
    """A blue sky, and a sun whose radius is 2 degrees: as bright as a lamp, and hardly ever met by chance."""
    y = direction[1]
    radiance = _rgb(0.55, 0.66, 0.80) + (_rgb(0.12, 0.28, 0.62) - _rgb(0.55, 0.66, 0.80)) * (
        np.clip(y, 0, 1) ** 0.5
    )
    angle = np.arccos(np.clip(_unit(-0.62, 0.60, 0.50) @ direction, -1, 1))
    radiance += _rgb(820.0, 700.0, 520.0) * _step(-angle, -0.040, -0.030)
    return radiance + (_rgb(0.20, 0.18, 0.15) - radiance) * _step(-y, -0.01, 0.05)


def studio(direction: Array) -> Array:
    """A dark room with a window to the left, a narrow lamp to the right and a pale ceiling."""
    y = direction[1]
    radiance = _rgb(0.05, 0.055, 0.065) + _rgb(0.30, 0.31, 0.34) * np.clip(y, 0, 1) ** 2

    def lamp(towards: Array, half_width: float, half_height: float, color: Array) -> Array:
        """Rectangle at distance 1 with soft edges, upright."""
        right = np.cross(towards, (0, 1, 0))
        right /= np.linalg.norm(right)
        forward = towards @ direction
        u = right @ direction / np.maximum(forward, 1e-6)
        v = np.cross(right, towards) @ direction / np.maximum(forward, 1e-6)
        inside = _step(half_width - np.abs(u), -0.04, 0.04) * _step(
            half_height - np.abs(v), -0.04, 0.04
        )
        # The window's bars, which make curved reflections readable.
        bars = _step(np.abs(u), 0.01, 0.05) * _step(np.abs(v), 0.01, 0.05)
        return color * inside * bars * (forward > 0)

    radiance += lamp(_unit(-1, 0.55, 0.25), 0.55, 0.6, _rgb(4.6, 4.4, 4.0))
    radiance += lamp(_unit(1, 0.35, -0.25), 0.20, 0.7, _rgb(2.4, 2.7, 3.2))
    return radiance


def valley(direction: Array) -> Array:
    """Sunset: ridge behind ridge, paler with distance, and a lake that mirrors them."""
    x, y, z = direction
    up = np.abs(y)  # the lake shows what is above it
    azimuth = np.arctan2(x, -z)
    horizon, zenith = _rgb(1.0, 0.62, 0.30), _rgb(0.10, 0.16, 0.36)
    radiance = horizon + (zenith - horizon) * np.clip(up * 1.5, 0, 1) ** 0.6
    sun = _unit(-0.45, 0.20, -1.0)
    cosine = np.clip(sun[0] * x + sun[1] * up + sun[2] * z, -1, 1)
    angle = np.arccos(cosine)
    radiance += _rgb(0.9, 0.5, 0.2) * np.exp(-angle / 0.35)
    radiance += _rgb(1.0, 0.9, 0.6) * _step(-angle, -0.085, -0.07)
    streaks = np.sin(34 * up + 2 * np.sin(2 * azimuth + 1) + 0.7 * np.sin(5 * azimuth))
    radiance *= 1 + 0.16 * streaks * _step(up, 0.16, 0.3) * _step(-up, -0.8, -0.4)
    elevation = np.arctan2(up, np.hypot(x, z))
    ridges = [
        (0.17, 0.085, 3, _rgb(0.55, 0.30, 0.26)),
        (0.10, 0.060, 5, _rgb(0.27, 0.15, 0.19)),
        (0.045, 0.040, 8, _rgb(0.08, 0.055, 0.09)),
    ]
    for base, height, folds, color in ridges:
        crest = base + height * (1 - 2 * np.abs(np.sin(folds * azimuth / 2 + folds)))
        crest += 0.35 * height * (1 - 2 * np.abs(np.sin(3 * folds * azimuth / 2 + 2)))
        crest += 0.15 * height * np.abs(np.sin(11 * folds * azimuth / 2))
        mist = _step(-elevation, -base, 0.0)[None] * _rgb(0.16, 0.10, 0.06)
        hidden = _step(crest - elevation, -0.007, 0.007)
        radiance += (color + mist - radiance) * hidden
    water = _rgb(0.62, 0.66, 0.74) * (1 + 0.07 * np.sin(26 / (up + 0.12)))
    depth = 0.35 + 0.65 * np.exp(-2.5 * up)
    return np.clip(np.where(y < 0, radiance * water * depth, radiance), 0, 1)


def lat_long(radiance: Callable[[Array], Array], height: int) -> NDArray[np.float32]:
    """Picture (3, height, 2 height): -z in the middle, +x to the right of it, +y at the top."""
    theta = (np.arange(height) + 0.5) * np.pi / height
    phi = (np.arange(2 * height) + 0.5) * np.pi / height - np.pi
    theta, phi = (angle.ravel() for angle in np.meshgrid(theta, phi, indexing="ij"))
    direction = np.stack((np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi)))
    picture = radiance(direction).reshape(3, height, 2 * height)
    # 11 bits of precision are more than enough for a sky, and the zeros behind them compress well.
    return picture.astype(np.float16).astype(np.float32)


def cross(radiance: Callable[[Array], Array], size: int) -> NDArray[np.float32]:
    """Horizontal cross (3, 3 size, 4 size): -x +z +x -z in a row, +y above +z, -y below it."""
    centre = (np.arange(size) + 0.5) * 2 / size - 1
    t, s = (a.ravel() for a in np.meshgrid(centre, centre, indexing="ij"))
    one = np.ones_like(s)
    # OpenGL's table of faces backwards: s to the right and t down on each, from -1 to 1.
    cells = {
        (0, 1): (s, one, t),
        (1, 0): (-one, -t, s),
        (1, 1): (s, -t, one),
        (1, 2): (one, -t, -s),
        (1, 3): (-s, -t, -one),
        (2, 1): (s, -one, -t),
    }
    picture = np.zeros((3, 3 * size, 4 * size), np.float32)
    for (row, column), face in cells.items():
        direction = np.stack(face)
        direction /= np.linalg.norm(direction, axis=0)
        cell = picture[:, row * size : (row + 1) * size, column * size : (column + 1) * size]
        cell[:] = radiance(direction).reshape(3, size, size)
    return picture


def _rgb(*color: float) -> Array:
    return np.array(color)[:, None]


def _unit(*v: float) -> Array:
    return np.array(v) / np.linalg.norm(v)


def _step(x: Array, low: float, high: float) -> Array:
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


if __name__ == "__main__":
    save(HERE / "sky.exr", lat_long(sky, SKY_HEIGHT))
    save(HERE / "clear_sky.exr", lat_long(clear_sky, CLEAR_SKY_HEIGHT))
    save(HERE / "studio.exr", lat_long(studio, STUDIO_HEIGHT))
    save(HERE / "valley.png", cross(valley, FACE))
