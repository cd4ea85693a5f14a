"""A radiosity solution, the light on all surfaces, in memory and as an .npz file; and its pictures from any camera.

A picture takes one ray a sample, and no light is computed any more.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.base.atomic import replacing
from course.base.errors import CourseError
from course.base.inputs import read_arrays
from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import QueryStats, StaticAccelerator
from course.engine.core.camera import Camera
from course.engine.core.types import Floats32, Floats64, Numbers
from course.engine.scene.building.cameras import make_camera

FORMAT = 1
"""Of the file."""


@dataclass(frozen=True)
class Solution:
    """Light on T triangles, seen from the front or from the back.

    Attributes
    ----------
    vertices : (V, 3) float32, in a frame in which the scene fills [-1, 1]
    triangles : (T, 3) int32, counter-clockwise seen from the front
    corners : (3, 3, 2 T) float32 [W/m^2], radiosity in each channel at each corner of all fronts, then of all backs
    radiosity : (3, 2 T) float32 [W/m^2], of the patches themselves
    center : (3,) float64, scale : (1,) float64; a place in the scene file is center + scale times one in the frame
    camera : (10,) float64, the scene file's eye, look_at and up, and its vertical field of view [degrees]
    size : (2,) int, width and height of the scene file's picture [pixels]
    steps : (1,) int, iterations, or patches that have shot
    left : (1,) float64, bound of the distance to convergence as a share of all light
    """

    vertices: Floats32
    triangles: Numbers
    corners: Floats32
    radiosity: Floats32
    center: Floats64
    scale: Floats64
    camera: Floats64
    size: NDArray[np.int64]
    steps: NDArray[np.int64]
    left: Floats64

    @cached_property
    def accelerator(self) -> StaticAccelerator:
        """The triangles in Embree."""
        return static_accelerator(self.vertices, self.triangles)

    def save(self, path: Path) -> None:
        """Write an .npz file, whole or not at all.

        Raises OutputError: the file can't be written.
        """
        arrays = {field.name: getattr(self, field.name) for field in fields(self)}
        with replacing(path) as temporary, temporary.open("wb") as file:
            np.savez(file, format=np.array([FORMAT]), **arrays)


def load_solution(path: Path) -> Solution:
    """Read what ``Solution.save`` has written.

    Raises CourseError: the file can't be read or holds no solution.
    """
    remedy = f"{path}: no radiosity solution: expected a file that course radiosity has written"
    arrays = read_arrays(path, "solution that course radiosity has written")
    if "format" not in arrays or arrays["format"].tolist() != [FORMAT]:
        raise CourseError(remedy)
    try:
        solution = Solution(**{field.name: arrays[field.name] for field in fields(Solution)})
    except KeyError as error:
        raise CourseError(remedy) from error
    if not _usable(solution):
        raise CourseError(remedy)
    return solution


def _usable(solution: Solution) -> bool:
    """True if all arrays have the shapes and types of a solution, and valid numbers."""
    count, vertices = solution.triangles.size // 3, solution.vertices.size // 3
    shapes = {
        "vertices": ("f4", (vertices, 3)),
        "triangles": ("i4", (count, 3)),
        "corners": ("f4", (3, 3, 2 * count)),
        "radiosity": ("f4", (3, 2 * count)),
        "center": ("f8", (3,)),
        "scale": ("f8", (1,)),
        "camera": ("f8", (10,)),
        "size": ("i8", (2,)),
        "steps": ("i8", (1,)),
        "left": ("f8", (1,)),
    }
    arrays = {name: getattr(solution, name) for name in shapes}
    return (
        all((arrays[name].dtype, arrays[name].shape) == shapes[name] for name in shapes)
        and bool(((solution.triangles >= 0) & (solution.triangles < vertices)).all())
        and bool(((solution.size >= 1) & (solution.size <= 65536)).all())
        # How far it is from convergence may be unknown.
        and all(np.isfinite(array).all() for name, array in arrays.items() if name != "left")
    )


RAYS = 1 << 17
"""In a batch."""

SAMPLES = 3
"""Along each side of a pixel."""

PARALLEL = 1e-6
"""Sine of the angle between view and up below which a camera can't tell where up is."""


@dataclass(frozen=True)
class View:
    """A pinhole camera in the units of the scene file.

    Attributes
    ----------
    eye, look_at, up : (3,) float64
    vertical_fov : [degrees]
    """

    eye: Floats64
    look_at: Floats64
    up: Floats64
    vertical_fov: float

    def __post_init__(self) -> None:
        view = self.look_at - self.eye
        length = float(np.linalg.norm(view))
        if not (np.isfinite(length) and length > 0):
            raise CourseError(
                f"the camera at {self.eye.tolist()} looks at itself: give another point to look at"
            )
        sine = np.linalg.norm(np.cross(view / length, self.up / np.linalg.norm(self.up)))
        if sine < PARALLEL:
            raise CourseError(
                f"the camera at {self.eye.tolist()} looks along its up, {self.up.tolist()}: "
                "look a little to one side"
            )


def own_view(solution: Solution) -> View:
    """The scene file's camera."""
    c = solution.camera
    return View(c[0:3], c[3:6], c[6:9], float(c[9]))


def flight(views: Sequence[View], frames: int) -> list[View]:
    """Views from the first to the last, by all between, evenly along the straight lines between their eyes.

    Raises CourseError: there are fewer than two views or frames, or one on the way sees nothing; its frame, counted
    from 0 as files are, and the cameras before and after it are named.
    """
    if len(views) < 2 or frames < 2:
        raise CourseError(
            f"a flight needs two cameras and two frames at least, got {len(views)} and {frames}"
        )
    eyes = np.array([view.eye for view in views])
    targets = np.array([view.look_at for view in views])
    # Where only the view turns, it turns as evenly as the target goes.
    length = np.linalg.norm(np.diff(eyes, axis=0), axis=1)
    length += 1e-3 * np.linalg.norm(np.diff(targets, axis=0), axis=1)
    way = np.concatenate(([0.0], np.cumsum(length)))
    at = np.linspace(0, way[-1], frames)

    def along(points: Floats64) -> Floats64:
        return np.stack([np.interp(at, way, column) for column in points.T], axis=1)

    fov = np.interp(at, way, [view.vertical_fov for view in views])
    up = along(np.array([view.up for view in views]))
    rows = zip(along(eyes), along(targets), up, fov, strict=True)
    flown = []
    for frame, (eye, target, u, angle) in enumerate(rows):
        try:
            flown.append(View(eye, target, u, float(angle)))
        except CourseError as error:
            # Cameras that were given have been looked at before: it is one that nobody has named.
            last = min(int(np.searchsorted(way, at[frame], "right")), len(views) - 1)
            before, after = (views[k].eye.tolist() for k in (last - 1, last))
            raise CourseError(
                f"frame {frame} of the flight, between the cameras at {before} and {after}: {error}, or let a camera"
                " between these two lead around it"
            ) from None
    return flown


def look(
    solution: Solution, view: View, width: int, height: int, samples: int = SAMPLES
) -> Floats32:
    """The picture of a solution.

    ``samples``: along each side of a pixel.
    Returns (3, height, width) float32, radiance [W/(m^2 sr)], black where nothing is.
    """
    eye = (view.eye - solution.center) / solution.scale
    fov = math.radians(view.vertical_fov)
    camera = make_camera(eye, view.look_at - view.eye, view.up, fov, width, height)
    picture = np.zeros((3, height * width), np.float32)
    inside = (np.arange(samples, dtype=np.float32) + np.float32(0.5)) / np.float32(samples)
    for first in range(0, height * width, RAYS):
        pixel = np.arange(first, min(first + RAYS, height * width))
        for dy in inside:
            for dx in inside:
                x, y = (pixel % width + dx, pixel // width + dy)
                light = _light(solution, camera, x.astype(np.float32), y.astype(np.float32))
                picture[:, pixel] += light
    return (picture / np.float32(samples**2)).reshape(3, height, width)


def _light(solution: Solution, camera: Camera, x: Floats32, y: Floats32) -> Floats32:
    """(3, N) radiance that comes from points of the picture."""
    direction = camera.directions(x, y)
    found = solution.accelerator.intersect(camera.origin[:, None], direction, QueryStats())
    hit = np.flatnonzero(found.triangle >= 0)
    light = np.zeros_like(direction)
    triangle, u, v = found.triangle[hit], found.u[hit], found.v[hit]
    light[:, hit] = radiance(solution, triangle, u, v, direction[:, hit])
    return light


def radiance(
    solution: Solution, triangle: Numbers, u: Floats32, v: Floats32, direction: Floats32
) -> Floats32:
    """(3, n) radiance [W/(m^2 sr)] of points on triangles, the same in all directions of the side that is seen.

    Parameters
    ----------
    triangle : (n,) int32, u, v : (n,) float32, barycentrics of corners 1 and 2
    direction : (3, n) float32 in which the ray travels that came there
    """
    p0, p1, p2 = (solution.vertices[solution.triangles[triangle, k]].T for k in range(3))
    normal = np.cross(p1 - p0, p2 - p0, axis=0)
    behind = np.einsum("xn,xn->n", normal, direction) > 0
    corners = solution.corners[:, :, triangle + behind * len(solution.triangles)]
    weights = np.stack((1 - u - v, u, v))
    # A diffuse surface's radiance is its radiosity over pi.
    light: Floats32 = np.einsum("ckn,kn->cn", corners, weights) / np.float32(math.pi)
    return light


def views_of(solution: Solution, cameras: Sequence[tuple[Floats64, Floats64]]) -> Iterator[View]:
    """Views with the scene's own up and field of view, from (eye, look_at) each.

    Raises CourseError: one sees nothing; of several, it is told which.
    """
    own = own_view(solution)
    for number, (eye, look_at) in enumerate(cameras, start=1):
        try:
            yield View(eye, look_at, own.up, own.vertical_fov)
        except CourseError as error:
            if len(cameras) == 1:
                raise
            raise CourseError(f"camera {number} of {len(cameras)}: {error}") from None
