"""The axes of the matrix, and the levels of each.

The scenes are described in units of half their extent. A level has a value for the cell and one for the cell's
well-conditioned twin, which looks the same; ``shift`` says how far apart [half extents] the two may lie: the size of
the smallest change of the scene that explains every difference between their pictures (a backward error). Thin
triangles add a ``thin_shift``, but only where they are, on a share of the surfaces.

Symbols: U = 2^-24, the rounding of float32; OFFSET, LONG, MOST as in ``course.engine.core.ray_offset``.
"""

from dataclasses import dataclass
from typing import Any

U = 2.0**-24
"""Rounding of float32, relative."""

OFFSET = 2.0**-19
"""How far above a surface rays leave it, as a share of its triangle's largest coordinate."""

LONG, MOST = 64.0, 1024.0
"""The length over the height from which on that grows in proportion, and what it is multiplied by at most."""

NOTHING = 1e-30
"""So small that in float32 it changes nothing it is added to: the limit of 0, but it draws its numbers."""

VISIBLE_TWIN = 1e-4
"""Size of the visible light that is the twin of smaller ones [half extents]: a point would be infinitely bright."""

ONE_POINT = 1e-5
"""Lights up to this size are as good as a point [half extents]."""

COARSE = {1e3: 1e3, 1e8: 8.0}
"""The size of what is huge, and in which unit numbers are rounded beside it [half extents].

That is its own size, in units of which the room is tiny; unless it is so much larger that the engine puts the origin
into the room, and cuts triangles there down to the room's size (``course.engine.scene.building.small_objects``).
"""

ANGLES = (1e-2, 1e-4, 1e-6)


@dataclass(frozen=True)
class Level:
    """One value of an axis.

    Attributes
    ----------
    name : as it stands in tables
    value : in the cell
    twin : in its well-conditioned twin
    shift : how far apart the two may lie [half extents]
    thin_shift, thin_share : how much farther, on which share of the surfaces
    """

    name: str
    value: Any
    twin: Any
    shift: float = 0.0
    thin_shift: float = 0.0
    thin_share: float = 0.0


def _same(name: str, value: Any) -> Level:
    """A level that the twin shares: what tells them apart are the other axes."""
    return Level(name, value, value)


def _scale(value: float, name: str = "") -> Level:
    return Level(name or f"{value:g}", value, 1.0)


def _offset(value: float) -> Level:
    # A coordinate of that many extents is rounded by 2^-53 of itself when it is written, moved and moved back.
    return Level(f"{value:g}", value, 0.0, 3 * 2 * value * 2.0**-53)


def _triangles(kind: str, size: float | None = None, shift: float = 0.0) -> Level:
    name = kind if size is None else f"{kind} {size:g}"
    return Level(name, (kind, size), ("two", None), shift)


def _thin(kind: str, size: float, ratio: float, share: float) -> Level:
    # Rays leave slivers from farther above; along needles the barycentrics of a hit err by the length over the width.
    along = ratio * U if kind == "needles" else 0.0
    above = OFFSET * max(min(ratio / LONG, MOST), 1)
    return Level(f"{kind} {size:g}", (kind, size), ("two", None), 0.0, above + along, min(share, 1))


def _small(value: float, reach: float = 1.0) -> Level:
    """So small that it can't be told from nothing, but for its reach."""
    return Level(f"{value:g}", value, NOTHING, value * reach)


AXES: dict[str, tuple[Level, ...]] = {
    "scale": (
        _scale(1e-60),
        _scale(1e-20),
        _scale(1e-9, "nanometre"),
        _scale(1e-3, "millimetre"),
        _scale(1.0, "metre"),
        _scale(7e3),
        _scale(3.0857e16, "parsec"),
        _scale(1e20),
        _scale(1e60),
    ),
    "offset": tuple(map(_offset, (0.0, 1.0, 1e3, 1e6, 1e8, 1e10))),
    "triangles": (
        _triangles("two"),
        *(_thin("strips", ratio, ratio, 32 / ratio) for ratio in (1e2, 1e4, 1e6)),
        *(_thin("needles", ratio, ratio, 16 / ratio) for ratio in (1e3, 1e5)),
        # All proportions up to a million: the longer, the rarer.
        _thin("graded", 1e-6, 1e6, 0.25),
        _triangles("no area"),
        _triangles("doubled"),
        _triangles("sheets", 1e-6),
        _triangles("fine", 24),
        *(_triangles("huge", size, coarse * (OFFSET + 2 * U)) for size, coarse in COARSE.items()),
    ),
    "angle": (
        _same("steep", ("steep", 1.0)),
        *(
            _same(f"{what} {a:g}", (what, a))
            for what in ("camera", "light", "mirror")
            for a in ANGLES
        ),
    ),
    "roughness": (
        _same("0", 0.0),
        # A square, a ball or a lobe of that size turns a ray by at most six times as much, and a lobe farther.
        _small(1e-6, 6),
        _small(1e-5, 6),
        _same("1e-3", 1e-3),
        _same("0.1", 0.1),
        _same("1", 1.0),
    ),
    "aperture": (
        _same("0", 0.0),
        _small(1e-7),
        _small(1e-5),
        _same("1e-3", 1e-3),
        _same("0.1", 0.1),
        _same("1", 1.0),
    ),
    "light size": (
        _same("0", 0.0),
        _small(1e-7),
        _small(1e-5),
        _same("1e-3", 1e-3),
        _same("0.1", 0.1),
        _same("1", 1.0),
        _same("30", 30.0),
    ),
    "depth": tuple(_same(str(depth), depth) for depth in (0, 1, 2, 5, 16, 64)),
    "resolution": tuple(
        _same(f"{w} x {h}", (w, h))
        for w, h in ((1, 1), (64, 1), (1, 64), (3, 2), (24, 18), (33, 17), (128, 96))
    ),
    "orientation": (_same("along the axes", 0.0), _same("turned", 33.0)),
    "lobe": tuple(_same(lobe, lobe) for lobe in ("plane", "ball", "phong")),
    "lens": tuple(_same(shape, shape) for shape in ("disk", "square", "polygon")),
    "light": tuple(
        _same(kind, kind)
        for kind in (
            "sphere",
            "ball",
            "facing disk",
            "sphere by polar",
            "ball by polar",
            "ball by rejection",
            "rectangle",
            "grid",
            "visible sphere",
            "visible part",
            "visible rectangle",
            "object",
            "directional",
            "sky",
        )
    ),
    "glass": tuple(
        _same(kind, kind) for kind in ("none", "clear", "absorbing", "around the camera")
    ),
    "environment": tuple(_same(kind, kind) for kind in ("constant", "seamless", "clamped")),
    "motion": (
        _same("none", ("none", 0.0)),
        Level("object 1e-7", ("object", 1e-7), ("object", NOTHING), 1e-7),
        _same("object 0.2", ("object", 0.2)),
        _same("camera 0.2", ("camera", 0.2)),
        _same("light 0.2", ("light", 0.2)),
        # The shutter opens after a million seconds: the motion until then is undone where things are placed.
        Level("late", ("late", 0.2), ("object", 0.2), 4 * 0.2e6 * 2.0**-53),
    ),
    # How long the shutter is open [s]; what moves is as much slower.
    "duration": tuple(Level(f"{t:g} s", t, 1.0) for t in (1.0, 1e-12, 1e12, 1e-60, 1e60)),
    "sampler": tuple(_same(kind, kind) for kind in ("sobol", "random", "jittered", "regular")),
    # As a share of a way that every ray has free before it: the plane hides nothing.
    "near plane": tuple(Level(f"{share:g}", share, 0.0) for share in (0.0, 1e-6, 1.0)),
    "normals": tuple(_same(kind, kind) for kind in ("bent", "interpolated")),
    "filter": tuple(_same(kind, kind) for kind in ("box", "gaussian")),
    "corner": tuple(_same(f"{degrees} degrees", degrees) for degrees in (90, 60, 35)),
    "substance": tuple(
        _same(kind, kind)
        for kind in (
            "glass",
            "thin",
            "diamond",
            "coloured glass",
            "frosted glass",
            "gold",
            "chromium",
        )
    ),
    "incidence": tuple(
        _same(f"{degrees:g} degrees", degrees) for degrees in (30.0, 0.0, 56.31, 75.0, 85.0)
    ),
    "beyond": tuple(_same(kind, kind) for kind in ("the same", "darker")),
}
"""Each axis and its levels."""


TAME = {axis: levels[0].name for axis, levels in AXES.items()} | {
    "scale": "metre",
    "light size": "0.1",
    "depth": "2",
    "resolution": "24 x 18",
}
"""On each axis a level that asks nothing of anybody."""


_BY_NAME = {(axis, each.name): each for axis, levels in AXES.items() for each in levels}


def level(axis: str, name: str) -> Level:
    """The level of an axis by its name; KeyError where there is none."""
    return _BY_NAME[axis, name]
