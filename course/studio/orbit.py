"""A camera that goes around the point that it looks at."""

from math import atan2, cos, sin

import numpy as np

from course.core.types import Floats64
from course.formats.yaml.description import CameraDescription

STEEPEST = 1.5
"""Radians of tilt from which the camera would look along its own up direction."""

CLOSEST, FARTHEST = 0.02, 50.0
"""Of the file's distance."""


def orbited(
    camera: CameraDescription, turn: float, tilt: float, zoom: float
) -> tuple[float, float, float]:
    """The eye after a turn about the up direction, a tilt towards it, and a change of the distance.

    Parameters
    ----------
    camera : as the file has it
    turn, tilt : radians
    zoom : factor of the distance
    """
    center = np.array(camera.look_at)
    up = _unit(np.array(camera.up))
    out = np.array(camera.eye) - center
    distance = float(np.linalg.norm(out))
    height = float(out @ up) / distance
    flat = out / distance - height * up
    level = float(np.linalg.norm(flat))
    east = _unit(flat if level > 1e-6 else _across(up))
    north = np.cross(up, east)
    angle = max(-STEEPEST, min(STEEPEST, atan2(height, level) + tilt))
    distance *= max(CLOSEST, min(FARTHEST, zoom))
    way = cos(angle) * (cos(turn) * east + sin(turn) * north) + sin(angle) * up
    x, y, z = (float(f"{value:.6g}") for value in center + distance * way)
    return x, y, z


def _unit(vector: Floats64) -> Floats64:
    unit: Floats64 = vector / np.linalg.norm(vector)
    return unit


def _across(up: Floats64) -> Floats64:
    """Some direction at right angles to up."""
    axis = np.eye(3)[int(np.abs(up).argmin())]
    across: Floats64 = np.cross(up, axis)
    return across
