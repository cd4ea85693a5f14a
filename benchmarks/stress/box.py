"""The box: the camera stands in a closed box of mirrors, with bright light all around outside, none of which gets in.

Whatever a path does, each of its d + 1 hits adds the ambient c, and each mirror returns everything: every pixel shows
c (d + 1). A ray that gets out brings a thousand instead, and so does a shadow ray. The box may be skewed, so that its
walls meet at an acute angle.
"""

import math

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.axes import U
from benchmarks.stress.cells import Cell
from benchmarks.stress.files import SceneFiles, square
from benchmarks.stress.parts import gloss, hang_lamp, lamp, lens, near_plane, picture, placement

COLOR = 0.3
FOV = 70.0
"""Of the camera, from below to above [degrees]."""

OUTSIDE = 1e3
"""Radiance of the environment, and how much brighter than elsewhere the light is."""

Vector = NDArray[np.float64]


def box(cell: Cell) -> SceneFiles:
    """The scene of a cell."""
    place = placement(cell)
    x, y, z = edges(cell)
    eye, look_at, clearance = _view(cell, x, y, z)
    lights = [{"type": "ambient", "radiance": 1}, _grazing(cell, x, y)]
    light = lamp(cell, place)
    if light is not None:
        lights.append(_brighter(light))
    camera = {
        "eye": place.point(*eye),
        "look_at": place.point(*look_at),
        "up": place.vector(0.1, 1, 0.2),
        "vertical_fov": FOV,
    }
    camera |= lens(cell, place, clearance, 0.5)
    camera |= near_plane(cell, place, clearance, FOV)
    sky = light is None
    files = SceneFiles(
        {
            **picture(cell),
            "camera": camera,
            "environment": {"type": "constant", "radiance": OUTSIDE, "lights": sky},
            "materials": {
                "wall": {"color": COLOR, "specular": 0.5, "mirror": 1} | gloss(cell),
                "sky": {"color": 1, "diffuse": 0},
            },
            "objects": [],
            "lights": lights,
        }
    )
    # Each with the two edges that make its front look outwards.
    walls = {
        "left": (-x, -y, z),
        "right": (x, y, z),
        "floor": (-y, -z, x),
        "roof": (y, z, x),
        "back": (-z, -x, y),
        "front": (z, x, y),
    }
    for name, (middle, a, b) in walls.items():
        square(files, name, place, cell["triangles"], middle, a, b, "wall", closed=True)
    hang_lamp(files, cell, place, OUTSIDE, {})
    kind, size = cell["triangles"]
    if kind == "huge":
        below = (size / 2, -2.0, 0.0)
        square(files, "huge", place, ("two", None), below, (size, 0, 0), (0, 0, -size), "sky")
    return files


def edges(cell: Cell) -> tuple[Vector, Vector, Vector]:
    """From the middle of the box to the middles of its right wall, roof and front."""
    x, y, z = np.diag([1.0, 0.625, 0.75])
    # In steps that are exact in binary, so that walls meet in the very same corners.
    y[0] = round(0.625 / math.tan(math.radians(cell["corner"])) * 1024) / 1024
    return x, y, z


def _view(cell: Cell, x: Vector, y: Vector, z: Vector) -> tuple[Vector, Vector, float]:
    """Where the camera stands, where it looks, and how large its lens may be."""
    what, angle = cell["angle"]
    match what:
        case "camera":
            # Just above the floor, along it.
            eye = -y * (1 - angle / y[1]) + 0.25 * z
            return eye, eye - 0.5 * z + 0.2 * x, 0.5 * angle
        case "mirror":
            # Just inside the right wall, which may be askew.
            eye = x * (1 - angle) + 0.25 * z
            return eye, eye - 0.5 * z + 0.2 * y, 0.25 * angle
    eye = 0.125 * x - 0.0625 * y + 0.21 * z
    return eye, -0.7 * x + 0.1 * y - 0.4 * z, 0.2


def _grazing(cell: Cell, x: Vector, y: Vector) -> dict[str, object]:
    """A point light beside the box, in or near the plane of its roof."""
    what, angle = cell["angle"]
    above = angle if what == "light" else 0.5
    position = 1.5 * x + y + np.array([0, above, 0])
    place = placement(cell)
    intensity = place.intensity(OUTSIDE)
    return {"type": "point", "position": place.point(*position), "intensity": intensity}


def _brighter(light: dict[str, object]) -> dict[str, object]:
    powers = ("intensity", "radiance", "irradiance")
    return {k: v * OUTSIDE if k in powers else v for k, v in light.items()}  # type: ignore[operator]


def radiance(cell: Cell) -> NDArray[np.float64]:
    """What every pixel shows, (3,)."""
    return np.full(3, COLOR * (cell["depth"] + 1))


def brightest(cell: Cell) -> NDArray[np.float64]:
    """What no pixel exceeds, (3,)."""
    return radiance(cell)


def slips(_cell: Cell) -> float:
    """How many rays may get out between two triangles: none."""
    return 0.0


def tolerance(cell: Cell) -> NDArray[np.float64]:
    """By how much rounding may change that: one rounding for each hit, and some in the mean of the samples."""
    return np.asarray((cell["depth"] + 8) * U * radiance(cell))
