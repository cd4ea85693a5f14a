"""What all stages have in common: film and sampler, lens, gloss, and the light."""

import math
from typing import Any

from benchmarks.stress.axes import NOTHING, VISIBLE_TWIN
from benchmarks.stress.cells import Cell
from benchmarks.stress.files import Placement, SceneFiles

BACKGROUND = [0.3, 0.4, 0.5]
"""Radiance of the environment, where it is constant, and of the ambient light."""

LIGHT = (0.2, 1.6, 0.3)
"""The lowest point of the light, in the unit scene."""

IRRADIANCE = 3.0
"""What the light brings to the unit scene, about."""

VISIBLE_PART = "visible part"
"""The level of light that is a visible sphere, of which points are taken only where it can be seen from."""

LAMP = "lamp"
"""Name of the object that is a light, and of its material."""

CUTOFF = 1 / 512


def placement(cell: Cell) -> Placement:
    """Where the cell's unit scene is put."""
    return Placement(cell["scale"], cell["offset"], cell["orientation"])


def samples(cell: Cell) -> int:
    """Of each pixel: few, for the more samples a pixel has the surer it lies at an edge."""
    width, height = cell["resolution"]
    return 4 if 1 < width * height < 5000 else 1


def picture(cell: Cell) -> dict[str, Any]:
    """`film`, `sampler` and `integrator`."""
    width, height = cell["resolution"]
    return {
        "film": {"width": width, "height": height, "filter": cell["filter"]},
        "sampler": {"type": cell["sampler"], "samples": samples(cell)},
        "integrator": {
            "max_depth": cell["depth"],
            "cutoff": CUTOFF,
            "shading_normals": cell["normals"],
        },
    }


def lens(cell: Cell, place: Placement, clearance: float, focus: float) -> dict[str, Any]:
    """The camera's lens, in units of its clearance from the surfaces; nothing for a pinhole."""
    if cell["aperture"] == 0:
        return {}
    return {
        "lens": {
            "aperture_radius": place.length(cell["aperture"] * clearance),
            "focus_distance": place.length(focus),
            "shape": cell["lens"],
        }
    }


def near_plane(cell: Cell, place: Placement, clearance: float, fov: float) -> dict[str, Any]:
    """How deep the camera is blind, in units of the least depth that half its clearance has; nothing for not at all.

    ``fov``: vertical field of view [degrees].
    """
    if cell["near plane"] == 0:
        return {}
    width, height = cell["resolution"]
    # Along a ray through a corner of the picture depth grows least.
    corner = math.tan(math.radians(fov) / 2) * math.hypot(1, width / height)
    return {"near": place.length(cell["near plane"] * clearance / 2 / math.hypot(1, corner))}


def gloss(cell: Cell) -> dict[str, Any]:
    """The mirrors' lobe, about as wide as the roughness; nothing where that is 0."""
    roughness = cell["roughness"]
    if roughness == 0:
        return {}
    match cell["lobe"]:
        case "plane":
            return {"gloss": {"lobe": "plane", "roughness": roughness}}
        case "ball":
            return {"gloss": {"lobe": "ball", "glossiness": min(roughness, 1 - 1e-6)}}
    # cos(angle)^n falls to one half at angle^2 = 2 log 2 / n.
    exponent = 0.0 if roughness >= 1 else 2 / roughness**2
    return {"gloss": {"lobe": "phong", "exponent": exponent}}


def lamp(cell: Cell, place: Placement) -> dict[str, Any] | None:
    """The light, its lowest point at LIGHT; None where the sky is the light.

    Its power grows with its distance, so that it brings about the same irradiance at every size.
    """
    kind, size = cell["light"], cell["light size"]
    x, y, z = LIGHT
    if kind == "sky":
        return None
    if kind == "directional":
        towards = place.direction(-0.2, -1, -0.1)
        return {"type": "directional", "direction": towards, "irradiance": IRRADIANCE}
    visible = kind.startswith("visible")
    if kind == "object":
        return {"type": "object", "object": LAMP}
    if visible and size in (0.0, NOTHING):
        # A point of that power would be infinitely bright.
        size = VISIBLE_TWIN
    if size == 0:
        intensity = place.intensity(IRRADIANCE * y * y)
        return {"type": "point", "position": place.point(x, y, z), "intensity": intensity}
    if kind in ("rectangle", "grid", "visible rectangle"):
        light, power, area = _rectangle(place, size), y * y + size * size / 4, size * size
        light["samples"] = "grid 3" if kind == "grid" else "point"
    else:
        middle, radius = place.point(x, y + size, z), place.length(size)
        light = {"type": "sphere", "center": middle, "radius": radius}
        power, area = (y + size) ** 2, math.pi * size * size
        if kind == VISIBLE_PART:
            light["samples"] = "visible"
        elif not visible:
            light["samples"] = kind
    if visible:
        return light | {"radiance": IRRADIANCE * power / area}
    return light | {"intensity": place.intensity(IRRADIANCE * power)}


def lamp_object(cell: Cell, place: Placement) -> tuple[dict[str, Any], float] | None:
    """The object that a light is, within a ball on LIGHT, and its radiance; None where the light is none.

    No two of its 48 triangles are alike, and none stands on the border between two groups of them: of others rounding
    would decide into which group they come, and so which one is chosen by a number.
    """
    if cell["light"] != "object":
        return None
    size = cell["light size"]
    x, y, z = LIGHT
    thing = {
        "shape": "displaced_sphere",
        "name": LAMP,
        "material": LAMP,
        "radius": place.length(0.75 * size),
        "amplitude": place.length(0.25 * size),
        "segments": 8,
        "seed": 3,
        "transform": place.steps(x, y + size, z),
    }
    return thing, IRRADIANCE * (y + size) ** 2 / (math.pi * size * size)


def hang_lamp(
    files: SceneFiles, cell: Cell, place: Placement, brighter: float, motion: dict[str, Any]
) -> None:
    """Add the object that a light is to a scene, where there is one."""
    shining = lamp_object(cell, place)
    if shining is not None:
        thing, emission = shining
        files.description["materials"][LAMP] = {"color": 0, "emission": emission * brighter}
        files.description["objects"].append(thing | motion)


def _rectangle(place: Placement, size: float) -> dict[str, Any]:
    x, y, z = LIGHT
    return {
        "type": "rectangle",
        "corner": place.point(x - size / 2, y, z - size / 2),
        "edge_u": place.vector(size, 0, 0),
        "edge_v": place.vector(0, 0, size),
    }
