"""How a twin's picture answers to small changes of its scene: how steeply where it is smooth, and where its edges are.

A picture with fixed random numbers is a piecewise smooth function of where camera and lights are. The twin is rendered
again with its view turned by h to either side, up and down, and with its lights moved by h in three directions. From
f(+h), f(0), f(-h):

    steepness  |f(+h) - f(-h)| / 2 h, summed over the kinds of change
    an edge    where f(+h) - 2 f(0) + f(-h) is more than a smooth function's: a sample has met another thing

The camera is moved, too, in as many directions; next to a surface by less than h. That counts for the steepness alone.
"""

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.files import SceneFiles

Array = NDArray[np.float64]

H = 1e-3
"""Size of the changes at least [radians, half extents]: as far as a cell may lie from its twin."""

JUMP = 2e-5
"""Second differences of H above this, as a share of the brightest pixel, are edges: an H^2 of curvature 20."""

AWAY = np.array([[0.6, 0.48, -0.64], [0.8, -0.36, 0.48], [0.0, 0.8, 0.6]])
"""Directions in which lights and camera are moved, at right angles to each other: in one alone a picture may stand
still."""


@dataclass(frozen=True)
class Response:
    """What the probes found.

    Attributes
    ----------
    picture : (H, W, 3) of the twin
    steepness : (H, W) [radiance / half extent], the largest of each pixel and its neighbours
    edges : (H, W) bool, where a sample may see something else
    contrast : (H, W) difference of the brightest and the darkest that is seen there
    step : h
    """

    picture: Array
    steepness: Array
    edges: NDArray[np.bool_]
    contrast: Array
    step: float = H

    @property
    def brightest(self) -> float:
        """The brightest pixel."""
        return float(self.picture.max())


def probe(
    files: SceneFiles,
    folder: Path,
    compiled: bool | None = None,
    step: float = H,
    clearance: float = math.inf,
) -> Response:
    """Render a twin and its neighbours. The scene is that of a unit scene: scale 1, offset 0.

    Parameters
    ----------
    step : h
    clearance : how far the camera may move before it comes to a surface
    """
    picture = files.picture(folder, compiled)
    steepness = np.zeros(picture.shape[:2])
    bends = np.zeros(picture.shape[:2])
    lowest, highest = picture, picture
    lights = [partial(_lights_moved, way=way) for way in AWAY]
    for change in (_view_turned, _view_tilted, *lights):
        above, below = (change(files, sign * step).picture(folder, compiled) for sign in (1, -1))
        steepness += (np.abs(above - below) / (2 * step)).max(axis=2)
        bends = np.maximum(bends, np.abs(above - 2 * picture + below).max(axis=2))
        lowest = np.minimum(np.minimum(above, below), lowest)
        highest = np.maximum(np.maximum(above, below), highest)
    small = min(step, clearance / 8)
    for way in AWAY:
        above, below = (
            _camera_moved(files, sign * small, way).picture(folder, compiled) for sign in (1, -1)
        )
        steepness += (np.abs(above - below) / (2 * small)).max(axis=2)
    spread = _around(highest, np.max) - _around(lowest, np.min)
    return Response(
        picture,
        _around(steepness[..., None], np.max)[..., 0],
        bends > JUMP * (step / H) ** 2 * picture.max(),
        spread.max(axis=2),
        step,
    )


def _around(picture: Array, function: Any) -> Array:
    """A function of each pixel and its eight neighbours."""
    padded = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width = picture.shape[:2]
    near = [padded[i : i + height, j : j + width] for i in range(3) for j in range(3)]
    return np.asarray(function(np.stack(near), axis=0))


def _view_turned(files: SceneFiles, by: float) -> SceneFiles:
    return _looking(files, by, 0.0)


def _view_tilted(files: SceneFiles, by: float) -> SceneFiles:
    return _looking(files, 0.0, by)


def _looking(files: SceneFiles, right: float, up: float) -> SceneFiles:
    """The camera looks elsewhere by these angles."""
    camera = files.description["camera"]
    eye, look_at = np.array(camera["eye"]), np.array(camera["look_at"])
    view = look_at - eye
    side = np.cross(view, camera["up"])
    side /= np.linalg.norm(side)
    upwards = np.cross(side, view / np.linalg.norm(view))
    moved = look_at + np.linalg.norm(view) * (right * side + up * upwards)
    return files.with_(camera=camera | {"look_at": moved.tolist()})


def _camera_moved(files: SceneFiles, by: float, way: Array) -> SceneFiles:
    """The camera stands elsewhere and looks the same way."""
    camera = files.description["camera"]
    places = {key: (np.array(camera[key]) + by * way).tolist() for key in ("eye", "look_at")}
    return files.with_(camera=camera | places)


def _lights_moved(files: SceneFiles, by: float, way: Array) -> SceneFiles:
    lights = []
    for light in files.description["lights"]:
        moved = dict(light)
        for key in ("position", "center", "corner", "direction"):
            if key in light:
                length = np.linalg.norm(light[key]) if key == "direction" else 1.0
                moved[key] = (np.array(light[key]) + by * length * way).tolist()
        lights.append(moved)
    shining = {light["object"] for light in lights if light["type"] == "object"}
    objects = [
        _moved(thing, by * way) if thing.get("name") in shining else thing
        for thing in files.description["objects"]
    ]
    return files.with_(lights=lights, objects=objects)


def _moved(thing: dict[str, Any], way: Array) -> dict[str, Any]:
    return thing | {"transform": [*thing["transform"], {"translate": way.tolist()}]}
