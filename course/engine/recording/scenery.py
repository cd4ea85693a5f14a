"""The scene around recorded rays: its triangles, camera and lamps, as few numbers as show it."""

from typing import Any
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats32, Floats64, Indices
from course.engine.recording.recording import Recording
from course.engine.recording.segments import Names

MOST_TRIANGLES = 400
"""Of an object; finer ones are made coarser."""

FEWER = (MOST_TRIANGLES, 200, 100, 50, 25)
"""The same where there are many objects, so that all together have at most ``ALL_TRIANGLES``; after that, boxes."""

ALL_TRIANGLES = 6000
"""Of a scene, so that a page stays below a megabyte; of more boxes the largest are shown."""

COARSEST = 6
"""Cells across an object that is made coarser; if it still has more triangles, it is shown as its box."""

LARGEST_PIECE = 0.2
"""Longest edge of a triangle as a share of the scene: pieces are drawn from the farthest to the nearest."""

FILM = 0.12
"""Distance at which the camera's film is drawn [unit of the compiled scene]."""

_BOX = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7],
                 [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])  # fmt: skip
"""Triangles of a box whose corners are numbered by their coordinates' bits, x first."""


def rounded(value: Any) -> Any:
    """A number or numbers to five digits, as few characters as they need."""
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, np.ndarray):
        value = value.tolist()  # Python's own numbers are the faster ones.
    if isinstance(value, tuple | list):
        return [rounded(each) for each in value]
    number = float(f"{float(value):.5g}")
    return (int(number) if number.is_integer() else number) if np.isfinite(number) else str(number)


def _rounded_rows(rows: Floats64) -> list[list[float]]:
    """Finite numbers (n, m) to five digits, many at once."""
    digits = 4 - np.floor(np.log10(np.maximum(np.abs(rows), 1e-30))).astype(int)
    # Powers of ten up to the 22nd are exact, so a quotient is the number that its five digits say.
    up, down = 10.0 ** np.clip(digits, 0, 22), 10.0 ** np.clip(-digits, 0, 22)
    found: list[list[float]] = (np.round(rows * up / down) / up * down).tolist()
    return found


_latest: list[tuple[Any, list[dict[str, Any]]]] = []
"""The triangles that were asked for last, with what is drawn of them: a scene is clicked at more than once."""


def objects(recording: Recording) -> list[dict[str, Any]]:
    """Every object with its name, colour and triangles, each of nine coordinates."""
    of = recording.scene.compiled
    if not (_latest and _latest[0][0]() is of):
        _latest[:] = [(ref(of), _objects(recording))]
    return _latest[0][1]


def _objects(recording: Recording) -> list[dict[str, Any]]:
    scene = recording.scene
    world, frame, names = scene.compiled.world, scene.compiled.frame, Names(scene)
    triangles, materials = world.surface.triangles, world.materials
    color = materials.diffuse + 0.7 * materials.mirror + materials.emission
    found = []
    first = 0
    counts = np.diff(names.ends, prepend=0)
    most = next((n for n in FEWER if np.minimum(counts, n).sum() <= ALL_TRIANGLES), len(_BOX))
    shown = np.minimum(counts, most).astype(np.intp)
    least = _least_shown(triangles, names.ends.astype(np.intp), shown)
    for name, end in zip(names.parts, names.ends.tolist(), strict=True):
        corners = _corners(triangles.planes[first:end], triangles.edges[first:end])
        if end > first and _extent(corners) >= least:
            corners = _cut(_coarser(corners, most)) * frame.scale + frame.center
            shade = np.clip(color[:, int(triangles.material[first])], 0.05, 1) ** (1 / 2.2)
            found.append(
                {
                    "name": name,
                    "color": (255 * shade).astype(int).tolist(),
                    "lamp": bool(materials.emission[:, int(triangles.material[first])].any()),
                    "triangles": _rounded_rows(corners.reshape(-1, 9)),
                }
            )
        first = end
    return found


def _corners(planes: Floats32, edges: Floats32) -> Floats64:
    """(T, 3, 3) corners of triangles."""
    p0 = planes[:, None, :3].astype(np.float64)
    return np.concatenate((p0, p0 + edges[:, None, :3], p0 + edges[:, None, 3:6]), axis=1)


def _extent(corners: Floats64) -> float:
    """The longest side of the box around triangles."""
    return float(np.ptp(corners.reshape(-1, 3), axis=0).max())


def _least_shown(triangles: Any, ends: Indices, shown: Indices) -> float:
    """The extent from which on objects are shown: all, unless they have more triangles than a page holds."""
    if shown.sum() <= ALL_TRIANGLES:
        return 0.0
    starts = np.concatenate(([0], ends[:-1]))
    there = np.flatnonzero(ends > starts)
    corners = (
        _corners(triangles.planes[a:b], triangles.edges[a:b])
        for a, b in zip(starts[there], ends[there], strict=True)
    )
    extents = np.array([_extent(each) for each in corners])
    order = np.argsort(-extents, kind="stable")
    fitting = np.cumsum(shown[there][order]) <= ALL_TRIANGLES
    return float(extents[order][fitting].min())


def _coarser(corners: Floats64, most: int = MOST_TRIANGLES) -> Floats64:
    """Fewer triangles (t, 3, 3): corners in one cell of a grid become one; a box if there are still too many."""
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    for cells in (32, 24, 16, 12, 9, COARSEST):
        if len(corners) <= most:
            return corners
        size = max(float((high - low).max()) / cells, 1e-12)
        cell = np.round((corners - low) / size).astype(np.int64)
        # Cells that hold corners are numbered in order without sorting the corners, of which there may be millions.
        numbers = ((cell[..., 0] * 64 + cell[..., 1]) * 64 + cell[..., 2]).ravel()
        there = np.zeros(64**3, np.bool_)
        there[numbers] = True
        inverse = (np.cumsum(there) - 1)[numbers]
        sums = [np.bincount(inverse, axis) for axis in corners.reshape(-1, 3).T]
        mean = np.stack(sums, axis=1) / np.bincount(inverse)[:, None]
        flat = inverse.reshape(-1, 3)
        a, b, c = np.sort(flat, axis=1).T
        distinct = flat[(a != b) & (b != c)]
        a, b, c = np.sort(distinct, axis=1).T
        # One number for three cells: numbers are sorted faster than rows.
        _, first = np.unique((a * len(mean) + b) * len(mean) + c, return_index=True)
        coarse: Floats64 = mean[distinct[first]]
        if 0 < len(coarse) <= most:
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


def lamps(recording: Recording) -> list[dict[str, Any]]:
    """Lights that have a place: points, spheres and parallelograms."""
    compiled = recording.scene.compiled
    frame = compiled.frame

    def placed(x: Floats32) -> Any:
        return rounded(x.astype(np.float64) * frame.scale + frame.center)

    found = []
    lights: tuple[Any, ...] = compiled.world.lights
    for light in lights:
        if hasattr(light, "position"):
            found.append({"name": light.name, "at": placed(light.position)})
        elif hasattr(light, "center"):
            radius = rounded(light.radius * frame.scale)
            found.append({"name": light.name, "at": placed(light.center), "radius": radius})
        elif hasattr(light, "corner"):
            u, v = light.edge_u, light.edge_v
            around = light.corner, light.corner + u, light.corner + u + v, light.corner + v
            found.append({"name": light.name, "around": [placed(corner) for corner in around]})
    return found


def camera_of(recording: Recording) -> dict[str, Any]:
    """Where the camera stands, its film, the recorded pixels on it, and its lens."""
    frame, settings, area = recording.scene.compiled.frame, recording.settings, recording.area
    camera = recording.camera

    def on_film(x: float, y: float) -> Any:
        way = camera.corner + camera.step_x * np.float32(x) + camera.step_y * np.float32(y)
        return rounded(
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
        "eye": rounded(camera.origin * frame.scale + frame.center),
        "right": rounded(camera.right),
        "up": rounded(camera.up),
        "lens": 0 if lens is None else rounded(lens.aperture_radius * frame.scale),
        "film": around(0, 0, settings.width, settings.height),
        "pixel": around(area.x, area.y, area.width, area.height),
    }
