"""The patch: one square that fills the picture, equally bright everywhere, however it is cut, lit and looked at.

Its twin, seen and lit head-on, has the same radiance: with the sun's irradiance 3 / sin(elevation), the background
and the ambient light La and the material's colour c and mirror m it is c (La + 3 / pi) + m La. A point that shadows
itself, and a ray that meets the patch again or misses it, shows something else.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.axes import U
from benchmarks.stress.cells import Cell
from benchmarks.stress.files import SceneFiles, square
from benchmarks.stress.parts import BACKGROUND, gloss, lens, near_plane, picture, placement, samples

COLOR, MIRROR = 0.2, 0.8
SUN = 3.0
"""Irradiance of the patch."""

STEEP = math.radians(55)
DISTANCE = 0.6
FLAT = 0.2
"""Half the picture's width and height are at most this, times the distance."""

AZIMUTHS = {"strips": math.pi / 2, "graded": math.pi / 2, "needles": 3 * math.pi / 4}
"""Rays run along thin triangles: across, one that is met again by mistake would be met beyond its edge."""


def patch(cell: Cell) -> SceneFiles:
    """The scene of a cell."""
    place = placement(cell)
    looking, shining = elevations(cell)
    width, height = cell["resolution"]
    kind, size = cell["triangles"]
    # Where the camera grazes, the picture is so low that all of it is on the patch.
    half = min(0.4 * math.tan(looking), FLAT * min(1.0, height / width))
    if kind in ("strips", "needles"):
        # Straight at the thin triangles, which lie the closer together the thinner they are.
        half = min(half, 25 / size / DISTANCE * min(1.0, height / width))
    eye = DISTANCE * _direction(looking, AZIMUTHS.get(kind, 0.3))
    camera: dict[str, Any] = {
        "eye": place.point(*eye),
        "look_at": place.point(0, 0, 0),
        "up": place.vector(0, 1, 0),
        "vertical_fov": 2 * math.degrees(math.atan(half)),
    }
    # Lens points stay so low above the patch that rays through the middle of the picture meet it.
    clearance = 0.25 * float(eye[1])
    camera |= lens(cell, place, clearance, DISTANCE)
    camera |= near_plane(cell, place, clearance, camera["vertical_fov"])
    sun = {
        "type": "directional",
        "direction": place.direction(*-_direction(shining, AZIMUTHS.get(kind, 4.0))),
        "irradiance": SUN / math.sin(shining),
    }
    files = SceneFiles(
        {
            **picture(cell),
            "camera": camera,
            "environment": {"type": "constant", "radiance": BACKGROUND},
            "materials": {
                "patch": {"color": COLOR, "mirror": MIRROR} | gloss(cell),
                "sky": {"color": 1, "diffuse": 0},
            },
            "objects": [],
            "lights": [{"type": "ambient", "radiance": BACKGROUND}, sun],
        }
    )
    square(files, "patch", place, cell["triangles"], (0, 0, 0), (1, 0, 0), (0, 0, -1), "patch")
    if kind == "huge":
        middle = (size / 2, -0.5, 0.0)
        square(files, "huge", place, ("two", None), middle, (size, 0, 0), (0, 0, -size), "sky")
    return files


def _direction(elevation: float, azimuth: float) -> NDArray[np.float64]:
    """Unit vector at an elevation above the patch, its azimuth counted from +z to +x [radians]."""
    flat = math.cos(elevation)
    return np.array([flat * math.sin(azimuth), math.sin(elevation), flat * math.cos(azimuth)])


def elevations(cell: Cell) -> tuple[float, float]:
    """Of the camera and of the sun above the patch [radians]; a mirror that is grazed is looked at and lit so."""
    what, angle = cell["angle"]
    return (
        angle if what in ("camera", "mirror") else STEEP,
        angle if what in ("light", "mirror") else STEEP,
    )


def radiance(cell: Cell) -> NDArray[np.float64]:
    """What every pixel shows, (3,)."""
    background = np.array(BACKGROUND)
    mirrored = MIRROR * background if cell["depth"] else 0.0
    return np.asarray(COLOR * (background + SUN / math.pi) + mirrored)


def brightest(cell: Cell) -> NDArray[np.float64]:
    """What no pixel exceeds, whether its rays miss the patch or meet it again and again, (3,)."""
    background = np.array(BACKGROUND)
    lit = COLOR * (background + SUN / math.pi)
    bound = np.maximum(background, lit)
    for _ in range(cell["depth"]):
        bound = np.maximum(background, lit + MIRROR * bound)
    return np.asarray(bound)


def slips(cell: Cell) -> float:
    """How many rays may slip through between two triangles, on average.

    Embree moves corners to the ray's origin, which rounds them by U. Where a ray meets a patch that lies askew at an
    angle a, that moves the place by U / a along it, and next to an edge the hierarchy may then look for the ray in the
    box of the one triangle while the other would have it. It takes many edges and a grazing view to see it: at 10^-4
    radians and edges a 12th apart, 1 to 5 rays of 12288 were lost; this allows three times that.
    """
    kind, size = cell["triangles"]
    if not cell["orientation"] or kind != "fine":
        return 0.0
    looking, _ = elevations(cell)
    width, height = cell["resolution"]
    rounding = 2 * U + cell.levels["offset"].shift
    # Three families of edges, size / 2 to a unit of length, with two sides each.
    near = 3 * size * rounding / math.sin(looking)
    return float(0.01 * width * height * samples(cell) * min(1.0, near))


def tolerance(cell: Cell) -> NDArray[np.float64]:
    """By how much rounding may change that, (3,).

    Some 16 roundings of the whole; and where the patch lies askew, the cosine of the sun's angle is a sum of three
    products of rounded numbers, each of which errs by as much as if the sun stood high.
    """
    _, shining = elevations(cell)
    askew = 4 * U / math.sin(shining) if cell["orientation"] else 0.0
    return np.asarray(16 * U * radiance(cell) + askew * COLOR * SUN / math.pi)
