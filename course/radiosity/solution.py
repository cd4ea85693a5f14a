"""A radiosity solution: the light on all surfaces, for any camera; in memory and as an .npz file."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.atomic import replacing
from course.core.embree import EmbreeAccelerator
from course.core.types import Floats32, Floats64, Numbers
from course.errors import CourseError
from course.inputs import read_arrays

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
    def accelerator(self) -> EmbreeAccelerator:
        """The triangles in Embree."""
        return EmbreeAccelerator(self.vertices, self.triangles)

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
    """Whether all arrays have the shapes and types that a solution has, and numbers that a picture can be made of."""
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
