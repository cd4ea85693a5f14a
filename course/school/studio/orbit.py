"""A camera that goes around the point that it looks at."""

from math import atan2, cos, sin

import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.yaml.description import CameraDescription

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
    turn, tilt, zoom = within_limits(camera, turn, tilt, zoom)
    center = np.array(camera.look_at)
    out, distance, up = _ways(camera)
    flat = out - float(out @ up) * up
    east = _unit(flat if float(np.linalg.norm(flat)) > 1e-6 else _across(up))
    north = np.cross(up, east)
    angle = _tilt(camera) + tilt
    distance *= zoom
    way = cos(angle) * (cos(turn) * east + sin(turn) * north) + sin(angle) * up
    x, y, z = (float(f"{value:.6g}") for value in center + distance * way)
    return x, y, z


def within_limits(
    camera: CameraDescription, turn: float, tilt: float, zoom: float
) -> tuple[float, float, float]:
    """The turn, tilt and zoom that are left where the camera can go no further; see ``orbited``."""
    begin = _tilt(camera)
    tilt = max(-STEEPEST - begin, min(STEEPEST - begin, tilt))
    return turn, tilt, max(CLOSEST, min(FARTHEST, zoom))


def _tilt(camera: CameraDescription) -> float:
    """The file's."""
    out, _, up = _ways(camera)
    height = float(out @ up)
    return atan2(height, float(np.linalg.norm(out - height * up)))


def _ways(camera: CameraDescription) -> tuple[Floats64, float, Floats64]:
    """From the centre to the eye, as a unit vector and a distance, and the up direction."""
    out = np.array(camera.eye) - np.array(camera.look_at)
    distance = float(np.linalg.norm(out))
    return out / distance, distance, _unit(np.array(camera.up))


def _unit(vector: Floats64) -> Floats64:
    unit: Floats64 = vector / np.linalg.norm(vector)
    return unit


def _across(up: Floats64) -> Floats64:
    """Some direction at right angles to up."""
    axis = np.eye(3)[int(np.abs(up).argmin())]
    across: Floats64 = np.cross(up, axis)
    return across
