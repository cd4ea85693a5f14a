"""Surroundings painted by a formula, as the pictures of each kind of environment, and closed forms of their light."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.engine.terms.environments.cube_faces import texel_directions
from tests.engine.formats.pictures import picture_files

Array = NDArray[np.float64]
Sky = Callable[[Array], Array]
"""Radiance (3, ...) by unit direction (3, ...)."""

# OpenGL's table of cube maps, backwards: where on the cube of side 2 each face has its middle, and which ways its
# columns and rows run.
TABLE = (
    ((1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, 0, 1), (0, -1, 0)),
    ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
    ((0, 0, 1), (1, 0, 0), (0, -1, 0)),
    ((0, 0, -1), (-1, 0, 0), (0, -1, 0)),
)


def gradient(direction: Array) -> Array:
    """1 + x, 1 + y, 1 + z: no two directions look the same."""
    return 1 + direction


def by_texel(size: int, subsamples: int = 1) -> Array:
    """The course's directions through samples of texels, (6, row, column, sample, 3)."""
    return np.moveaxis(texel_directions(size, subsamples), (1, 2), (-1, -2))


def cube_directions(size: int) -> Array:
    """Unit directions (3, 6, size, size) through the texels' centres."""
    along = (2 * np.arange(size) + 1) / size - 1
    faces = []
    for middle, right, down in np.array(TABLE, float):
        place = middle + along[:, None, None] * down + along[None, :, None] * right
        faces.append(np.moveaxis(place, -1, 0))
    every = np.stack(faces, axis=1)
    return np.asarray(every / np.linalg.norm(every, axis=0))


def paint_cube(sky: Sky, size: int) -> NDArray[np.float32]:
    """Faces (6, size, size, 3)."""
    return np.moveaxis(sky(cube_directions(size)), 0, -1).astype(np.float32)


def unfolded(faces: NDArray[np.float32], kind: str) -> NDArray[np.float32]:
    """A paper cube laid flat around its face +z; what isn't paper is 9."""
    size = faces.shape[1]
    px, nx, py, ny, pz, nz = faces
    cells = {(0, 1): py, (1, 0): nx, (1, 1): pz, (1, 2): px, (2, 1): ny}
    if kind == "horizontal":
        cells[1, 3] = nz
        flat = np.full((3 * size, 4 * size, 3), 9, np.float32)
    else:
        cells[3, 1] = nz[::-1, ::-1]
        flat = np.full((4 * size, 3 * size, 3), 9, np.float32)
    for (row, column), face in cells.items():
        flat[row * size : (row + 1) * size, column * size : (column + 1) * size] = face
    return flat


def paint_lat_long(sky: Sky, height: int) -> NDArray[np.float32]:
    """A picture (height, 2 height, 3): its middle is -z, a quarter to the right of it is +x, its top +y."""
    polar = (np.arange(height) + 0.5)[:, None] * math.pi / height
    azimuth = ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5) * 2 * math.pi
    x, y, z = np.broadcast_arrays(
        np.sin(polar) * np.sin(azimuth), np.cos(polar), -np.sin(polar) * np.cos(azimuth)
    )
    return np.moveaxis(sky(np.stack((x, y, z))), 0, -1).astype(np.float32)


def environment(
    folder: Path, kind: str, sky: Sky, size: int = 64, **options: Any
) -> dict[str, Any]:
    """Paint the pictures of an environment with faces of that size, and describe it."""

    def write(name: str, picture: NDArray[np.float32]) -> str:
        (folder / name).write_bytes(picture_files.exr_rgb(picture))
        return name

    if kind == "lat_long":
        image = write("lat_long.exr", paint_lat_long(sky, 2 * size))
        return {"type": "lat_long", "image": image} | options
    faces = paint_cube(sky, size)
    if kind == "faces":
        files = [write(f"face {number}.exr", face) for number, face in enumerate(faces)]
        return {"type": "cube", "faces": files} | options
    return {"type": "cube", "cross": write(f"{kind}.exr", unfolded(faces, kind))} | options


KINDS = ("faces", "horizontal", "vertical", "lat_long")


def assert_sees(shown: Array, direction: Array, sky: Sky, size: int, kind: str) -> None:
    """What is shown (H, W, 3) in directions (3, H, W) is the sky, as well as faces of that size can hold it.

    Bilinear interpolation of a sky whose second derivatives are at most 1, over texels of 2 / size, errs by up to
    1 / size^2; a picture of all directions, and the mean of four samples of it, by as much again. Where texels of two
    faces are mixed, or the last ones stand for what lies beyond, and around the poles of a picture of all directions,
    the error is of first order: half a texel times a slope of at most 1 along both axes.
    """
    off = np.abs(shown - np.moveaxis(sky(direction), 0, -1)).max(axis=-1)
    assert off.max() < 2 / size
    sizes = np.sort(np.abs(direction), axis=0)
    simple = sizes[1] / sizes[2] < 1 - 1 / size
    if kind == "lat_long":
        simple &= np.hypot(direction[0], direction[2]) > 2 / size
    assert simple.any()
    assert off[simple].max() < 3 / size**2


def clipped(corners: Array, normal: Array) -> Array:
    """What of a polygon lies on the normal's side of the plane through the origin (Sutherland and Hodgman 1974)."""
    kept = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        height_a, height_b = a @ normal, b @ normal
        if height_a >= 0:
            kept.append(a)
        if height_a * height_b < 0:
            kept.append(a + (b - a) * height_a / (height_a - height_b))
    return np.array(kept)


def form_factor(corners: Array, normal: Array) -> float:
    """The share of a plane element's cosine-weighted hemisphere that a polygon covers, seen from the origin.

    Lambert's sum over the edges, 1760: the angle under which each is seen, times the cosine between the normal and
    the edge's own plane.
    """
    inside = clipped(corners, normal)
    if len(inside) < 3:
        return 0.0
    r = inside / np.linalg.norm(inside, axis=1, keepdims=True)
    total = 0.0
    for a, b in zip(r, np.roll(r, -1, axis=0), strict=True):
        turn = np.cross(a, b)
        length = np.linalg.norm(turn)
        if length > 1e-12:
            total += math.atan2(length, a @ b) * (turn @ normal) / length
    return abs(total) / (2 * math.pi)


def face_corners(face: int) -> Array:
    """Corners (4, 3) of one face of the cube of side 2."""
    middle, right, down = np.array(TABLE[face], float)
    return np.stack(
        [middle + i * right + j * down for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    )
