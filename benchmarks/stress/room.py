"""The room: a floor between two mirrors, a ball, a ball of glass, a box that may move, and one light.

In the unit scene the room fills [-1, 1] x [0, 1.2] x [-1, 1], y up; the camera looks in from +z.
"""

import math
from typing import Any

import numpy as np

from benchmarks.stress.cells import AROUND, Cell
from benchmarks.stress.files import Placement, SceneFiles, square
from benchmarks.stress.parts import (
    BACKGROUND,
    CUTOFF,
    LAMP,
    LIGHT,
    gloss,
    hang_lamp,
    lamp,
    lens,
    near_plane,
    picture,
    placement,
)

HEIGHT = 1.2
CLEARANCE = LIGHT[1] - HEIGHT
"""No light comes closer to a surface."""

SUN = 2.0
"""Irradiance of the light that grazes the floor."""

MIRROR = [0.7, 0.75, 0.8]
FURNACE_MIRROR = 0.9
FOV = 45.0
"""Of the camera, from below to above [degrees]."""

LATE = 1e6
"""When the shutter opens late, in units of the time that it is open."""

THERE = {"object": [1.0, 0.3, -0.2], "light": [0.6, 0.0, 0.8], "camera": [0.0, 0.0, -1.0]}
"""Directions of motion; the camera goes along floor and mirrors, however close it is to them."""


def room(cell: Cell) -> SceneFiles:
    """The scene of a cell."""
    place = placement(cell)
    files = SceneFiles(
        {
            **picture(cell),
            "camera": _camera(cell, place),
            "environment": {"type": "constant", "radiance": BACKGROUND},
            "materials": _materials(cell, place),
            "objects": [],
            "lights": _lights(cell, place),
        }
    )
    _surround(cell, files)
    _furnish(cell, place, files)
    return files


def furnace(cell: Cell) -> SceneFiles:
    """The same shapes in a uniform radiance of 1, where nothing may show more than 1."""
    files = room(cell)
    clear = {"dielectric": {"refraction_index": 1.5}}
    blurred = gloss(cell)
    materials = {
        "floor": {"color": 0.5, "diffuse": 0, "mirror": 0.5} | blurred,
        "mirror": {"color": 1 - FURNACE_MIRROR, "diffuse": 0, "mirror": FURNACE_MIRROR} | blurred,
        "ball": {"color": 1, "diffuse": 0},
        "glass": clear if cell["glass"] != "none" else {"color": 1, "diffuse": 0},
        "box": {"color": 1, "diffuse": 0},
        "sky": {"color": 1, "diffuse": 0},
        LAMP: {"color": 0, "emission": 1},
    }
    lights = [
        {k: v for k, v in light.items() if k != "intensity"} | {"radiance": 1}
        for light in files.description["lights"]
        if "radiance" in light and light["type"] != "ambient"
    ]
    lights += [light for light in files.description["lights"] if light["type"] == "object"]
    return files.with_(
        materials=materials,
        lights=[{"type": "ambient", "radiance": 1}, *lights],
        environment={"type": "constant", "radiance": 1},
    )


def least_in_furnace(cell: Cell) -> float:
    """What the furnace shows at least: all but what is left in the mirrors after the last bounce.

    Glass splits rays without end, and the back of a light is black: then nothing is promised.
    """
    if cell["glass"] != "none" or cell["light"].startswith("visible"):
        return 0.0
    lost = float(FURNACE_MIRROR ** (cell["depth"] + 1))
    # Paths end below the cutoff too.
    return 1 - max(lost, CUTOFF)


def brightest(cell: Cell) -> float:
    """A bound on the radiance of every pixel, from what the scene is made of.

    Each light brings at most its power over the squared clearance. A surface returns its share of that and of the
    brightest thing that it mirrors; each bounce may find the brightest of all surfaces again.
    """
    k2 = cell["scale"] ** 2
    irradiance, seen = 0.0, 1.0
    description = room(cell).description
    for light in description["lights"]:
        match light["type"]:
            case "object":
                radiance = description["materials"][LAMP]["emission"]
                seen = max(seen, radiance)
                area = 4 * math.pi * cell["light size"] ** 2
                irradiance += radiance * area / CLEARANCE**2
            case "directional":
                irradiance += light["irradiance"]
            case "sphere" | "rectangle" if "radiance" in light:
                seen = max(seen, light["radiance"])
                irradiance += light["radiance"] * _area(light) / k2 / CLEARANCE**2
            case "sphere" | "rectangle" | "point":
                irradiance += light["intensity"] / k2 / CLEARANCE**2
    arriving = irradiance / math.pi + (1.0 if cell["light"] == "sky" else 0.0)
    # No color and highlight are more than 1.2 together, no ambient or background more than 1.
    source = 1.0 + 1.2 * arriving
    bound = max(seen, source)
    for _ in range(cell["depth"]):
        # Mirrors return a tenth of what arrives and the larger part of what they mirror; glass returns all of it.
        through = bound if cell["glass"] != "none" else 0.0
        bound = max(seen, source, 0.1 * (0.3 + arriving) + max(MIRROR) * bound, through)
    return bound


def _area(light: dict[str, Any]) -> float:
    if light["type"] == "sphere":
        return 4 * math.pi * float(light["radius"]) ** 2
    return float(np.linalg.norm(np.cross(light["edge_u"], light["edge_v"])))


def clearance(cell: Cell) -> float:
    """How far the camera may move before it comes to a surface, of the unit scene."""
    what, angle = cell["angle"]
    if what in ("camera", "mirror"):
        return float(0.5 * angle)
    return 0.04 if cell["glass"] == AROUND else 0.5


def _camera(cell: Cell, place: Placement) -> dict[str, Any]:
    what, angle = cell["angle"]
    near = clearance(cell)
    match what:
        case "camera":
            # Just above the floor, and along it.
            eye, look_at = (0.1, angle, 0.95), (0.07, angle, -1.0)
        case "mirror":
            eye, look_at = (1 - angle, 0.5, 0.9), (0.6, 0.35, -1.0)
        case _ if cell["glass"] == AROUND:
            # About the middle of the ball, also when the camera moves: from there no ray is reflected totally.
            eye, look_at = (0.42, 0.36, 0.35), (-0.3, 0.3, -0.1)
        case _:
            eye, look_at = (0.5, 0.6, 1.9), (-0.3, 0.3, -0.1)
    camera = {
        "eye": place.point(*eye),
        "look_at": place.point(*look_at),
        "up": place.vector(0, 1, 0),
        "vertical_fov": FOV,
    }
    camera |= lens(cell, place, near, 2.0)
    camera |= near_plane(cell, place, near, FOV)
    seconds = cell["duration"]
    start = LATE if cell["motion"][0] == "late" else 0.0
    camera["shutter"] = {"open": start * seconds, "close": (start + 1) * seconds}
    return camera | _motion(cell, place, "camera")


def _motion(cell: Cell, place: Placement, mover: str) -> dict[str, Any]:
    """`motion` of camera, light or object; nothing where it stands still."""
    moving, way = cell["motion"]
    if mover != ("object" if moving == "late" else moving):
        return {}
    velocity = np.multiply(way / cell["duration"], THERE[mover])
    return {"motion": {"velocity": place.vector(*velocity)}}


def _materials(cell: Cell, place: Placement) -> dict[str, Any]:
    glass: dict[str, Any] = {"refraction_index": 1.5}
    if cell["glass"] in ("absorbing", AROUND):
        glass["absorption"] = [a / place.k for a in (0.5, 1.0, 2.0)]
    opaque = {"color": [0.8, 0.7, 0.3], "ambient": 0.3}
    return {
        "floor": {"color": [0.6, 0.5, 0.4], "ambient": 0.3, "specular": 0.2, "exponent": 30},
        "mirror": {"color": 0.1, "ambient": 0.3, "mirror": MIRROR} | gloss(cell),
        "ball": {"color": [0.3, 0.6, 0.8], "ambient": 0.3, "specular": 0.2, "exponent": 100},
        "glass": opaque if cell["glass"] == "none" else {"dielectric": glass},
        "box": {"color": [0.7, 0.3, 0.2], "ambient": 0.3},
        "sky": {"color": 1, "diffuse": 0},
    }


def _lights(cell: Cell, place: Placement) -> list[dict[str, Any]]:
    lights: list[dict[str, Any]] = [{"type": "ambient", "radiance": BACKGROUND}]
    what, angle = cell["angle"]
    if what == "light":
        lights.append(
            {
                "type": "directional",
                "direction": place.direction(0.1, -angle, -1.0),
                "irradiance": SUN,
            }
        )
    light = lamp(cell, place)
    if light is None or light["type"] in ("directional", "object"):
        return lights + ([] if light is None else [light])
    return [*lights, light | _motion(cell, place, "light")]


def _surround(cell: Cell, files: SceneFiles) -> None:
    """The background."""
    kind = cell["environment"]
    environment: dict[str, Any] = {"type": "constant", "radiance": BACKGROUND}
    if kind != "constant":
        names = [f"face{number}.exr" for number in range(6)]
        environment = {"type": "cube", "faces": names, "lookup": kind}
        for number, name in enumerate(names):
            files.pictures[name] = _face(number)
    files.description["environment"] = environment | {"lights": cell["light"] == "sky"}


def _face(number: int) -> np.ndarray[Any, np.dtype[np.float32]]:
    """Four by four texels between 0 and 1, other ones on each face."""
    x = np.arange(48, dtype=np.float32).reshape(4, 4, 3)
    return np.asarray(0.5 + 0.5 * np.sin(1.7 * x + number), np.float32)


def _furnish(cell: Cell, place: Placement, files: SceneFiles) -> None:
    """Floor, mirrors, balls and the box."""
    cut, h = cell["triangles"], HEIGHT / 2
    square(files, "floor", place, cut, (0, 0, 0), (1, 0, 0), (0, 0, -1), "floor")
    square(files, "left", place, cut, (-1, h, 0), (0, 0, -1), (0, h, 0), "mirror")
    square(files, "right", place, cut, (1, h, 0), (0, 0, 1), (0, h, 0), "mirror")
    if cut[0] == "huge":
        size = cut[1]
        # The room stands halfway to its edge, where coordinates are as coarse as they get.
        below = (size / 2, -0.5, 0.0)
        square(files, "huge", place, ("two", None), below, (size, 0, 0), (0, 0, -size), "sky")
    middle = np.array([-0.1, 0.7, -0.5])
    mover, way = cell["motion"]
    if mover == "late":
        middle -= LATE * np.multiply(way, THERE["object"])
    box = {
        "shape": "box",
        "material": "box",
        "size": [place.length(x) for x in (0.2, 0.25, 0.15)],
        "transform": place.steps(*middle),
    }
    box |= _motion(cell, place, "object")
    hang_lamp(files, cell, place, 1.0, _motion(cell, place, "light"))
    files.description["objects"] += [
        box,
        _ball("ball", 0.3, (-0.35, 0.31, -0.2), place),
        _ball("glass", 0.25, (0.4, 0.33, 0.25), place),
    ]


def _ball(
    material: str, radius: float, middle: tuple[float, float, float], place: Placement
) -> dict[str, Any]:
    return {
        "shape": "sphere",
        "material": material,
        "radius": place.length(radius),
        "segments": 48,
        "transform": place.steps(*middle),
    }
