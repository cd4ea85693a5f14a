"""A page that shows recorded rays in their scene: one HTML file, which asks for no other."""

import json
import re
from html import escape
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats32, Floats64
from course.recording.segments import Names, Segment
from course.recording.story import Line, Story

MOST_PATHS = 200
"""Samples whose rays are shown; of more, these are spread evenly."""

MOST_TRIANGLES = 400
"""Of an object; finer ones are made coarser."""

COARSEST = 6
"""Cells across an object that is made coarser; if it still has more triangles, it is shown as its box."""

LARGEST_PIECE = 0.2
"""Longest edge of a triangle as a share of the scene: pieces are drawn from the farthest to the nearest."""

KINDS = ("camera", "shadow", "mirrored", "refracted", "bounce", "environment")

FILM = 0.12
"""Distance at which the camera's film is drawn [unit of the compiled scene]."""

_BOX = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7],
                 [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])  # fmt: skip
"""Triangles of a box whose corners are numbered by their coordinates' bits, x first."""


def page(story: Story) -> str:
    """An HTML page with the story of a pixel and a view of its rays."""
    data = json.dumps(view_data(story), separators=(",", ":"), allow_nan=False)
    parts = {
        "title": escape(story.tree.text),
        "reason": escape(story.reason),
        "tree": _list(story.tree.below[1:]),
        "style": _file("rays.css"),
        "script": _file("rays.js"),
        # In a script "</" would end it, whatever it stands in.
        "data": data.replace("</", "<\\/"),
    }
    return re.sub(r"\[\[(\w+)\]\]", lambda found: parts[found[1]], _file("rays.html"))


def _file(name: str) -> str:
    return files("course.recording").joinpath(name).read_text(encoding="utf-8")


def _list(lines: list[Line]) -> str:
    items = (f"<li>{escape(line.text)}{_list(line.below)}</li>" for line in lines)
    return f"<ul>{''.join(items)}</ul>" if lines else ""


def view_data(story: Story) -> dict[str, Any]:
    """What the view draws: the scene's triangles, its camera, its lamps and the rays, in the units of the file."""
    recording = story.recording
    _, pixels, count = recording.radiance.shape
    shown = np.unique(
        np.linspace(0, pixels * count - 1, min(MOST_PATHS, pixels * count)).astype(int)
    )
    area = recording.area
    place = {
        ((area.x + n // count % area.width, area.y + n // count // area.width), n % count): number
        for number, n in enumerate(shown.tolist())
    }
    names: dict[str, int] = {}
    functions: dict[str, int] = {}
    rows: list[list[Any]] = []
    numbers: dict[int, int] = {}
    for one in story.segments:
        if (sample := place.get((one.pixel, one.sample))) is not None:
            numbers[one.number] = len(rows)
            rows.append(_row(one, sample, numbers, names, functions))
    radiance = recording.radiance.reshape(3, -1)
    samples = [
        {
            "offset": _rounded(recording.offsets.reshape(2, -1)[:, n]),
            "radiance": _rounded(radiance[:, n]),
            "share": _rounded(story.shares[n]),
            "number": n % count,
        }
        for n in shown.tolist()
    ]
    return {
        "kinds": KINDS,
        "objects": _objects(story),
        "lamps": _lamps(story),
        "camera": _camera(story),
        "samples": samples,
        "all": pixels * count,
        "names": list(names),
        "functions": list(functions),
        "segments": rows,
    }


def _row(
    one: Segment,
    sample: int,
    numbers: dict[int, int],
    names: dict[str, int],
    functions: dict[str, int],
) -> list[Any]:
    """Sample, parent, depth, kind, start, end, met, aim (0 unless blocked), light brought, calls: function, result."""
    calls = [
        [
            functions.setdefault(call.function, len(functions)),
            _rounded(next(iter(call.results.values()), None)),
        ]
        for call in one.calls
    ]
    return [
        sample,
        -1 if one.parent is None else numbers[one.parent],
        one.depth,
        KINDS.index(one.kind),
        _rounded(one.start),
        _rounded(one.end),
        names.setdefault(one.met, len(names)),
        _rounded(one.aim) if one.blocked else 0,
        _rounded(sum(one.radiance) / 3),
        calls,
    ]


def _rounded(value: Any) -> Any:
    """A number or numbers to five digits, as few characters as they need."""
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, tuple | list | np.ndarray):
        return [_rounded(each) for each in value]
    number = float(f"{float(value):.5g}")
    return (int(number) if number.is_integer() else number) if np.isfinite(number) else str(number)


def _objects(story: Story) -> list[dict[str, Any]]:
    """Every object with its name, colour and triangles, each of nine coordinates."""
    scene = story.recording.scene
    world, frame, names = scene.compiled.world, scene.compiled.frame, Names(scene)
    triangles, materials = world.surface.triangles, world.materials
    color = materials.diffuse + 0.7 * materials.mirror + materials.emission
    found = []
    first = 0
    for name, end in zip(names.parts, names.ends.tolist(), strict=True):
        if end > first:
            rows = slice(first, end)
            corners = _corners(triangles.planes[rows], triangles.edges[rows])
            corners = _cut(_coarser(corners)) * frame.scale + frame.center
            shade = np.clip(color[:, int(triangles.material[first])], 0.05, 1) ** (1 / 2.2)
            found.append(
                {
                    "name": name,
                    "color": (255 * shade).astype(int).tolist(),
                    "lamp": bool(materials.emission[:, int(triangles.material[first])].any()),
                    "triangles": [_rounded(each.ravel()) for each in corners],
                }
            )
        first = end
    return found


def _corners(planes: Floats32, edges: Floats32) -> Floats64:
    """(T, 3, 3) corners of triangles."""
    p0 = planes[:, None, :3].astype(np.float64)
    return np.concatenate((p0, p0 + edges[:, None, :3], p0 + edges[:, None, 3:6]), axis=1)


def _coarser(corners: Floats64) -> Floats64:
    """Fewer triangles (t, 3, 3): corners in one cell of a grid become one; a box if there are still too many."""
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    for cells in (32, 24, 16, 12, 9, COARSEST):
        if len(corners) <= MOST_TRIANGLES:
            return corners
        size = max(float((high - low).max()) / cells, 1e-12)
        cell = np.round((corners - low) / size).astype(np.int64)
        # One number for a cell, and one for three of them: numbers are sorted faster than rows.
        numbers = (cell[..., 0] * 64 + cell[..., 1]) * 64 + cell[..., 2]
        _, inverse = np.unique(numbers.ravel(), return_inverse=True)
        sums = [np.bincount(inverse, axis) for axis in corners.reshape(-1, 3).T]
        mean = np.stack(sums, axis=1) / np.bincount(inverse)[:, None]
        flat = inverse.reshape(-1, 3)
        a, b, c = np.sort(flat, axis=1).T
        distinct = flat[(a != b) & (b != c)]
        a, b, c = np.sort(distinct, axis=1).T
        _, first = np.unique((a * len(mean) + b) * len(mean) + c, return_index=True)
        coarse: Floats64 = mean[distinct[first]]
        if 0 < len(coarse) <= MOST_TRIANGLES:
            return coarse
    bits = np.arange(8)[:, None] >> np.arange(3) & 1
    box: Floats64 = np.where(bits, high, low)[_BOX]
    return box


def _cut(corners: Floats64) -> Floats64:
    """Triangles (t, 3, 3) halved at their longest edges until these are short."""
    while True:
        lengths: NDArray[np.float64] = np.linalg.norm(
            corners - np.roll(corners, -1, axis=1), axis=2
        )
        large = lengths.max(axis=1) > 2 * LARGEST_PIECE
        if not large.any() or len(corners) > 8 * MOST_TRIANGLES:
            return corners
        some, longest = corners[large], lengths[large].argmax(axis=1)
        which = np.arange(len(some))
        a, b, c = (some[which, (longest + k) % 3] for k in range(3))
        middle = (a + b) / 2
        halves = np.stack((a, middle, c), axis=1), np.stack((middle, b, c), axis=1)
        corners = np.concatenate((corners[~large], *halves))


def _lamps(story: Story) -> list[dict[str, Any]]:
    """Lights that have a place: points, spheres and parallelograms."""
    compiled = story.recording.scene.compiled
    frame = compiled.frame

    def placed(x: Floats32) -> Any:
        return _rounded(x.astype(np.float64) * frame.scale + frame.center)

    found = []
    lights: tuple[Any, ...] = compiled.world.lights
    for light in lights:
        if hasattr(light, "position"):
            found.append({"name": light.name, "at": placed(light.position)})
        elif hasattr(light, "center"):
            radius = _rounded(light.radius * frame.scale)
            found.append({"name": light.name, "at": placed(light.center), "radius": radius})
        elif hasattr(light, "corner"):
            u, v = light.edge_u, light.edge_v
            around = light.corner, light.corner + u, light.corner + u + v, light.corner + v
            found.append({"name": light.name, "around": [placed(corner) for corner in around]})
    return found


def _camera(story: Story) -> dict[str, Any]:
    """Where the camera stands, its film, the recorded pixels on it, and its lens."""
    recording = story.recording
    frame, settings, area = recording.scene.compiled.frame, recording.settings, recording.area
    camera = recording.camera

    def on_film(x: float, y: float) -> Any:
        way = camera.corner + camera.step_x * np.float32(x) + camera.step_y * np.float32(y)
        return _rounded(
            (camera.origin + np.float32(FILM) * way).astype(np.float64) * frame.scale + frame.center
        )

    def around(x: float, y: float, width: float, height: float) -> Any:
        return [
            on_film(x, y),
            on_film(x + width, y),
            on_film(x + width, y + height),
            on_film(x, y + height),
        ]

    lens = camera.lens
    return {
        "eye": _rounded(camera.origin * frame.scale + frame.center),
        "right": _rounded(camera.right),
        "up": _rounded(camera.up),
        "lens": 0 if lens is None else _rounded(lens.aperture_radius * frame.scale),
        "film": around(0, 0, settings.width, settings.height),
        "pixel": around(area.x, area.y, area.width, area.height),
    }
