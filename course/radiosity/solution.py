"""A radiosity solution: the light on all surfaces, for any camera; in memory and as an .npz file."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats32, Floats64, Numbers
from course.errors import CourseError
from course.geometry.embree import Accelerator
from course.imaging.atomic import replacing

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
    def accelerator(self) -> Accelerator:
        """The triangles in Embree."""
        return Accelerator(self.vertices, self.triangles)

    def save(self, path: Path) -> None:
        """Write an .npz file, whole or not at all.

        Raises
        ------
        OutputError
            The file can't be written.
        """
        arrays = {field.name: getattr(self, field.name) for field in fields(self)}
        with replacing(path) as temporary, temporary.open("wb") as file:
            np.savez(file, format=np.array([FORMAT]), **arrays)


def load_solution(path: Path) -> Solution:
    """Read what ``Solution.save`` has written.

    Raises
    ------
    CourseError
        The file can't be read or holds no solution.
    """
    remedy = f"{path}: no radiosity solution: expected a file that course radiosity has written"
    try:
        with np.load(path, allow_pickle=False) as file:
            if "format" not in file or file["format"].tolist() != [FORMAT]:
                raise CourseError(remedy)
            solution = Solution(**{field.name: file[field.name] for field in fields(Solution)})
    except OSError as error:
        raise CourseError(f"{path}: can't be read: {error.strerror or error}") from error
    except (ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise CourseError(remedy) from error
    count, vertices = len(solution.triangles), len(solution.vertices)
    if not (
        solution.vertices.shape == (vertices, 3)
        and solution.triangles.shape == (count, 3)
        and solution.corners.shape == (3, 3, 2 * count)
        and solution.camera.shape == (10,)
        and solution.size.shape == (2,)
        and ((solution.triangles >= 0) & (solution.triangles < vertices)).all()
        and all(np.isfinite(array).all() for array in (solution.vertices, solution.corners))
    ):
        raise CourseError(remedy)
    return solution
