"""Optics: plates of glass and sheets of metal against what physics says of them, worked out without the renderer.

A cell and its twin share the renderer's Fresnel reflectance, so that they agree on a wrong one. Here every pixel is
held against a closed form in float64. The plate has parallel faces, and shows the background La above it and the
radiance Lb of what lies below. With the reflectance r of one face, the share a that one crossing leaves of the light,
and rays of depth D at most,

    L = La (r + sum over k >= 1 of (1 - r)^2 r^(2k - 1) a^(2k), 2k + 1 <= D)
      + Lb (sum over k >= 0 of (1 - r)^2 r^(2k) a^(2k + 1), 2k + 2 <= D)

where Lb = La this is a furnace. A frosted plate is one that must not be seen there. A metal shows La times its
reflectance. r of glass is Fresnel's in the form by the two angles (Born and Wolf, 1.5.2), r of metals by a complex
index (14.2); the renderer has neither form.
"""

import cmath
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.axes import OFFSET, U
from benchmarks.stress.cells import Cell
from benchmarks.stress.files import SceneFiles, square
from benchmarks.stress.parts import BACKGROUND, near_plane, picture, placement

Array = NDArray[np.float64]

HALF = 2e-5
"""Half the picture's width and height at distance 1, at most: the angle is nearly the same in all pixels."""

DISTANCE, THICKNESS, GAP = 0.6, 0.01, 0.01
DARKER = 0.1
"""Lb / La."""


@dataclass(frozen=True)
class Substance:
    """What a surface is made of.

    Attributes
    ----------
    index : of refraction, of metals for each channel the real part
    extinction : the imaginary part for each channel, None for glass
    absorption : for each channel [1 / half extent]
    roughness : of frosted glass
    """

    index: float | tuple[float, float, float]
    extinction: tuple[float, float, float] | None = None
    absorption: tuple[float, float, float] = (0.0, 0.0, 0.0)
    roughness: float = 0.0


SUBSTANCES = {
    "glass": Substance(1.5),
    "thin": Substance(1 / 1.33),
    "diamond": Substance(2.42),
    "coloured glass": Substance(1.52, absorption=(3.0, 20.0, 60.0)),
    "frosted glass": Substance(1.5, roughness=0.5),
    "gold": Substance((0.18, 0.42, 1.47), (3.42, 2.35, 1.95)),
    "chromium": Substance((3.18, 3.18, 2.22), (3.31, 3.33, 2.89)),
}


def optics(cell: Cell) -> SceneFiles:
    """The scene of a cell."""
    place, substance = placement(cell), SUBSTANCES[cell["substance"]]
    width, height = cell["resolution"]
    angle = math.radians(cell["incidence"])
    half = HALF * min(1.0, height / width)
    across = (math.cos(0.3), 0.0, -math.sin(0.3))
    eye = [math.sin(angle) * math.sin(0.3), math.cos(angle), math.sin(angle) * math.cos(0.3)]
    camera: dict[str, Any] = {
        "eye": place.point(*(DISTANCE * x for x in eye)),
        "look_at": place.point(0, 0, 0),
        "up": place.vector(*across),
        "vertical_fov": 2 * math.degrees(math.atan(half)),
    }
    camera |= near_plane(cell, place, 0.25 * DISTANCE * eye[1], camera["vertical_fov"])
    parts = picture(cell)
    parts["integrator"] |= {"cutoff": 0}
    beyond = {"color": 1 if cell["beyond"] == "the same" else DARKER, "diffuse": 0}
    files = SceneFiles(
        {
            **parts,
            "camera": camera,
            "environment": {"type": "constant", "radiance": BACKGROUND},
            "materials": {"substance": _material(substance, cell["scale"]), "beyond": beyond},
            "objects": [],
            "lights": [{"type": "ambient", "radiance": BACKGROUND}],
        }
    )
    two, x, z = ("two", None), (1, 0, 0), (0, 0, 1)
    square(files, "front", place, two, (0, 0, 0), x, (0, 0, -1), "substance")
    if substance.extinction is None:
        square(files, "back", place, two, (0, -THICKNESS, 0), x, z, "substance")
    square(files, "beyond", place, two, (0, -THICKNESS - GAP, 0), x, (0, 0, -1), "beyond")
    return files


def _material(substance: Substance, unit: float) -> dict[str, Any]:
    if substance.extinction is not None:
        metal = {
            "refraction_index": substance.index,
            "absorption_index": list(substance.extinction),
        }
        return {"color": 0, "mirror": 1, "conductor": metal}
    glass = {"refraction_index": substance.index, "roughness": substance.roughness}
    return {
        "color": 0,
        "dielectric": glass | {"absorption": [each / unit for each in substance.absorption]},
    }


def reflectance(angle: float, index: float) -> float:
    """What the boundary of clear glass reflects of unpolarised light from outside."""
    if angle == 0:
        return ((index - 1) / (index + 1)) ** 2
    if math.sin(angle) >= index:
        return 1.0
    bent = math.asin(math.sin(angle) / index)
    across = math.sin(angle - bent) / math.sin(angle + bent)
    within = math.tan(angle - bent) / math.tan(angle + bent)
    return (across * across + within * within) / 2


def metal_reflectance(angle: float, index: complex) -> float:
    """What the surface of a metal reflects of unpolarised light."""
    bent = cmath.sqrt(1 - (math.sin(angle) / index) ** 2)
    across = (math.cos(angle) - index * bent) / (math.cos(angle) + index * bent)
    within = (index * math.cos(angle) - bent) / (index * math.cos(angle) + bent)
    return (abs(across) ** 2 + abs(within) ** 2) / 2


def _shown(cell: Cell, angle: float) -> Array:
    substance, depth = SUBSTANCES[cell["substance"]], cell["depth"]
    above = np.array(BACKGROUND)
    below = above * (1 if cell["beyond"] == "the same" else DARKER)
    if substance.extinction is not None:
        assert isinstance(substance.index, tuple)
        indices = [
            complex(*each) for each in zip(substance.index, substance.extinction, strict=True)
        ]
        return above * [metal_reflectance(angle, each) for each in indices] * (depth > 0)
    if substance.roughness:
        return above
    assert isinstance(substance.index, float)
    r = reflectance(angle, substance.index)
    length = 0.0
    if r < 1:
        length = THICKNESS / math.cos(math.asin(math.sin(angle) / substance.index))
    left = np.exp(-np.array(substance.absorption) * length)
    shown = above * (r if depth >= 1 else 0)
    for k in range(depth // 2 + 1):
        if k and 2 * k + 1 <= depth:
            shown = shown + above * (1 - r) ** 2 * r ** (2 * k - 1) * left ** (2 * k)
        if 2 * k + 2 <= depth:
            shown = shown + below * (1 - r) ** 2 * r ** (2 * k) * left ** (2 * k + 1)
    return shown


def radiance(cell: Cell) -> Array:
    """What every pixel shows, (3,)."""
    return _shown(cell, math.radians(cell["incidence"]))


def brightest(_cell: Cell) -> Array:
    """What no pixel exceeds, (3,): no substance makes light."""
    return np.array(BACKGROUND)


def slips(_cell: Cell) -> float:
    """How many rays may slip through between two triangles, on average."""
    return 0.0


def tolerance(cell: Cell) -> Array:
    """By how much the picture's width and rounding may change that, (3,).

    A ray meets the plate at another angle where it goes to another pixel, and where its direction, or the plate's, is
    rounded. Rays start above the faces, by up to OFFSET each, and what is absorbed on that way may be missing.
    """
    width, height = cell["resolution"]
    turn = HALF * min(1.0, height / width) * math.hypot(1, width / height) + 16 * U + 8 * cell.shift
    angle = math.radians(cell["incidence"])
    there = _shown(cell, angle)
    change = np.max([np.abs(_shown(cell, abs(angle + t)) - there) for t in (turn, -turn)], axis=0)
    absorbed = np.array(SUBSTANCES[cell["substance"]].absorption) * (4 * OFFSET + 4 * cell.shift)
    return np.asarray(1.5 * change + (64 * U + absorbed) * np.array(BACKGROUND))
