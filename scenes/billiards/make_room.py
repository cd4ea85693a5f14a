"""Paint the saloon around the table of ``gallery/1984.yaml``, at dusk: ``room.exr``, by latitude and longitude, linear.

Run from the project's folder: ``python scenes/billiards/make_room.py``. The camera looks along -z, at lamps on tables
across the room. Behind it, where the balls mirror them, are three tall windows, a lit bar, and a player with a cue.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.engine.formats.pictures.files import save

Array = NDArray[np.float64]
HERE = Path(__file__).parent
HEIGHT = 240
"""Of the picture [pixels]."""

WARM, AMBER, ROSE, TEAL = (4.2, 2.3, 0.9), (3.6, 1.4, 0.3), (2.4, 0.45, 0.35), (0.35, 1.3, 1.5)
"""Radiances of small lamps."""

SCONCES = [(azimuth, 14, 0.032, WARM) for azimuth in (-64, -36, 38, 68, 92, 172)]
ON_TABLES = [
    (-19.2, -2.9, 0.015, WARM),
    (-13.4, -4.0, 0.012, AMBER),
    (-8.6, -2.4, 0.016, WARM),
    (-2.6, -3.9, 0.012, TEAL),
    (2.7, -2.6, 0.015, AMBER),
    (7.9, -3.9, 0.012, ROSE),
    (12.9, -2.5, 0.017, WARM),
    (18.3, -3.7, 0.013, AMBER),
]
"""Azimuth and elevation [degrees], radius [radians] and radiance of lamps."""


def room(direction: Array) -> Array:
    """Radiance (3, N) from directions (3, N). Azimuth 0 is -z, 90 degrees is +x."""
    x, y, z = direction
    azimuth, elevation = np.degrees(np.arctan2(x, -z)), np.degrees(np.arcsin(np.clip(y, -1, 1)))
    radiance = _mixed(walls(azimuth, elevation), ceiling(x, y), _step(elevation, 37, 38))
    radiance = _mixed(radiance, _rgb(0.030, 0.016, 0.010), _step(-elevation, 13, 15))
    for add in (windows, bar, lamps, player):
        radiance = add(radiance, azimuth, elevation)
    return radiance


def walls(azimuth: Array, elevation: Array) -> Array:
    """Panels, and plaster above them."""
    panels = 0.7 + 0.5 * _step(np.cos(np.radians(azimuth * 12)), 0.82, 0.95)
    plaster = _rgb(0.06, 0.038, 0.026) * np.ones_like(azimuth)
    return _mixed(_rgb(0.040, 0.020, 0.013) * panels, plaster, _step(elevation, 9.5, 10.5))


def ceiling(x: Array, y: Array) -> Array:
    """Beams across the room."""
    beams = _step(np.abs(np.mod(5 * x / np.maximum(y, 0.05), 2) - 1), 0.7, 0.8)
    return _rgb(0.055, 0.045, 0.038) * (1 - 0.5 * beams)


def windows(radiance: Array, azimuth: Array, elevation: Array) -> Array:
    """Three of six panes each; the sky is paler towards the horizon, and roofs stand before it."""
    low, high = _rgb(1.9, 1.25, 0.85) * np.ones_like(azimuth), _rgb(0.34, 0.62, 1.5)
    dusk = _mixed(low, high, _step(elevation, 2, 26))
    roofs = 4 + 3 * np.sign(np.sin(np.radians(azimuth * 9)))
    roofs += 2 * np.sign(np.sin(np.radians(azimuth * 23 + 40)))
    dusk = _mixed(dusk, _rgb(0.05, 0.06, 0.10), _step(roofs - elevation, -0.5, 0.5))
    for middle in (-158, -128, -98):
        pane = np.zeros_like(azimuth)
        for left in (middle - 9.4, middle + 0.6):
            for bottom, top in ((-4, 8), (9.2, 20), (21.2, 31)):
                one = _box(azimuth, elevation, left, left + 8.8, bottom, top, 0.35)
                pane = np.maximum(pane, one)
        frame = _box(azimuth, elevation, middle - 11, middle + 11, -5.5, 33, 0.6)
        radiance = _mixed(radiance, _rgb(0.16, 0.11, 0.07), frame)
        radiance = _mixed(radiance, 1.6 * dusk, pane)
    return radiance


def bar(radiance: Array, azimuth: Array, elevation: Array) -> Array:
    """Shelves of bottles before a lit wall."""
    shelf = _rgb(1.9, 1.05, 0.42) * (0.55 + 0.45 * _step(elevation, -4, 16))
    waves = [np.sin(np.radians(azimuth * frequency)) for frequency in (150, 97, 60, 71)]
    above = np.mod(elevation + 3, 6.6)
    bottles = _step(waves[0] + 0.6 * waves[1], 0.15, 0.35)
    bottles = bottles * _step(4.6 + 0.8 * waves[2] - above, -0.2, 0.2)
    glass = _rgb(0.30, 0.12, 0.03) + _rgb(-0.1, 0.12, 0.04) * _step(waves[3], 0, 0.1)
    shelf = _mixed(shelf, glass, bottles)
    shelf = _mixed(shelf, _rgb(0.06, 0.03, 0.015), _step(-above, -0.5, -0.3))
    return _mixed(radiance, shelf, _box(azimuth, elevation, 112, 160, -3, 17, 0.6))


def lamps(radiance: Array, azimuth: Array, elevation: Array) -> Array:
    """Each a bright shade, and a glow around it."""
    for middle, height, radius, color in [*SCONCES, *ON_TABLES]:
        off = np.radians(_away(azimuth, middle)) * np.cos(np.radians(elevation))
        up = np.radians(elevation - height)
        glow = np.exp(-np.hypot(off, 0.75 * np.maximum(up, -1.4 * up)) / (3 * radius))
        shade = _step(radius - np.hypot(off, 0.8 * up), -0.003, 0.003)
        radiance = _mixed(radiance + 0.04 * _rgb(*color) * glow, _rgb(*color), shade)
    return radiance


def player(radiance: Array, azimuth: Array, elevation: Array) -> Array:
    """Someone dark beside the windows, with a cue."""
    body = _box(azimuth, elevation, -182, -173, -25, 9, 0.8)
    head = _box(azimuth, elevation, -180.4, -174.6, 10, 17.5, 1.6)
    radiance = _mixed(radiance, _rgb(0.012, 0.011, 0.012), np.maximum(body, head))
    cue = _step(0.7 - _away(azimuth + 0.06 * elevation, -171.5), -0.2, 0.2)
    cue = cue * _step(24 - elevation, -0.3, 0.3) * _step(elevation, -25, -24)
    return _mixed(radiance, _rgb(0.35, 0.20, 0.09), cue)


def lat_long(height: int) -> NDArray[np.float32]:
    """Picture (3, height, 2 height): -z in the middle, +x to the right of it; each pixel the mean of nine points."""
    total = np.zeros((3, height, 2 * height))
    for dv in (1, 3, 5):
        for du in (1, 3, 5):
            phi = (np.arange(2 * height) + du / 6) * np.pi / height - np.pi
            theta = (np.arange(height) + dv / 6) * np.pi / height
            phi, theta = (angle.ravel() for angle in np.meshgrid(phi, theta))
            across = np.sin(theta)
            way = np.stack((across * np.sin(phi), np.cos(theta), -across * np.cos(phi)))
            total += room(way).reshape(total.shape)
    # 11 bits of precision are enough, and the zeros behind them compress well.
    return (total / 9).astype(np.float16).astype(np.float32)


def _away(azimuth: Array, middle: float) -> Array:
    """Degrees between two azimuths."""
    return np.abs(np.mod(azimuth - middle + 180, 360) - 180)


def _box(
    azimuth: Array,
    elevation: Array,
    left: float,
    right: float,
    low: float,
    high: float,
    soft: float,
) -> Array:
    """1 within a range of both angles, 0 outside, and soft between [degrees]."""
    across = _step((right - left) / 2 - _away(azimuth, (left + right) / 2), -soft, soft)
    return across * _step((high - low) / 2 - np.abs(elevation - (low + high) / 2), -soft, soft)


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
    save(HERE / "room.exr", lat_long(HEIGHT))
