"""The cube map's lookups through the engine: without seams across all edges, and with the right mean over the sphere.

The functions themselves are judged in tests/school/solutions/test_cube_map.py; here it is pictures and light.
"""

import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from tests.conftest import MakeScene, PixelRays
from tests.engine.formats.pictures import picture_files
from tests.engine.terms.environments.skies import TABLE, cube_directions
from tests.estimates import estimate
from tests.lengths import fewer

Array = NDArray[np.float64]

ONE = {"type": "regular", "samples": 1}
EDGES = [
    np.insert(np.array(signs, float), axis, 0)
    for axis, signs in product(range(3), product((-1, 1), repeat=2))
]
"""The middles of the cube's 12 edges; the axis that is 0 runs along the edge."""
CORNERS = [np.array(signs, float) for signs in product((-1, 1), repeat=3)]

lookups = pytest.mark.parametrize("lookup", ["seamless", "clamped"])


def random_faces(size: int, seed: int = 0) -> NDArray[np.float32]:
    return np.random.default_rng(seed).random((6, size, size, 3), np.float32)


def cube(folder: Path, faces: NDArray[np.float32], **options: Any) -> dict[str, Any]:
    files = [f"face {number}.exr" for number in range(6)]
    for file, face in zip(files, faces, strict=True):
        (folder / file).write_bytes(picture_files.exr_rgb(face))
    return {"type": "cube", "faces": files} | options


def view(
    make_scene: MakeScene, sky: dict[str, Any], towards: Array, up: Any, degrees: float, n: int
) -> Scene:
    return make_scene(
        camera={"eye": [0, 0, 0], "look_at": towards.tolist(), "up": up, "vertical_fov": degrees},
        film={"width": n, "height": n},
        sampler=ONE,
        environment=sky,
    )


def jumps(picture: NDArray[np.float32]) -> float:
    """The largest difference of two pixels side by side or one above the other."""
    return float(max(np.abs(np.diff(picture, axis=axis)).max() for axis in (0, 1)))


# ---------------------------------------------------------------- continuity


@pytest.mark.parametrize("size", [1, 4])
def test_no_seam_is_seen_across_any_edge(make_scene: MakeScene, tmp_path: Path, size: int) -> None:
    faces = random_faces(size)
    pixels, degrees = 101, 2
    # A pixel is 2 degrees / 101 wide, at most sqrt(3)^2 as far on the face as on the unit sphere, and a texel of
    # 2 / size; from texel to texel there is a difference of at most 1, in both directions.
    slope = 2 * (size / 2) * 3 * math.radians(degrees) / pixels
    seams = []
    for middle in EDGES:
        along = [0, 0, 0]
        along[int(np.abs(middle).argmin())] = 1
        for place in (0, 0.7):
            towards = middle + place * np.array(along)
            shown = {
                lookup: render(
                    view(
                        make_scene,
                        cube(tmp_path, faces, lookup=lookup),
                        towards,
                        along,
                        degrees,
                        pixels,
                    )
                ).linear
                for lookup in ("seamless", "clamped")
            }
            assert jumps(shown["seamless"]) < slope
            # The edge runs upwards through the middle of the picture: on its two sides the other lookup shows the two
            # faces as they are.
            step = np.abs(np.diff(shown["clamped"], axis=1)).max(axis=(0, 2))
            assert step.argmax() in (pixels // 2 - 1, pixels // 2)
            seams.append(step.max())
    assert len(seams) == 24
    # On every edge some channel of these random faces differs by more.
    assert min(seams) > 5 * slope


@pytest.mark.parametrize("size", [1, 2, 5])
def test_no_seam_is_seen_around_any_corner(
    make_scene: MakeScene, tmp_path: Path, size: int
) -> None:
    faces = random_faces(size)
    sky = cube(tmp_path, faces)
    pixels, degrees = 101, 1
    # At the corner itself the weights of three texels are renormalised: there a weight of 3/4 or more is divided by,
    # and changes as fast as the weights, which at most doubles the slope.
    slope = 2 * 2 * (size / 2) * 3 * math.radians(degrees) / pixels
    for corner in CORNERS:
        scene = view(make_scene, sky, corner, [0, 1, 0], degrees, pixels)
        shown = render(scene).linear
        assert jumps(shown) < slope
        # And what is seen there is the mean of the three texels that meet.
        place = cube_directions(2)
        nearest = np.argsort(-np.tensordot(corner, place, 1), axis=None)[:3]
        met = [np.unravel_index(k, place.shape[1:]) for k in nearest]
        texels = [faces[f, i * (size - 1), j * (size - 1)] for f, i, j in met]
        assert np.abs(shown[50, 50] - np.mean(texels, axis=0)).max() < 2 * slope


# ---------------------------------------------------------------- faces and their coordinates


def test_each_pixel_shows_its_own_texel_of_the_opengl_table(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path
) -> None:
    """A texel is read off a picture: its face, column and row are in its three channels."""
    size = 8
    number, row, column = np.meshgrid(np.arange(6), np.arange(size), np.arange(size), indexing="ij")
    faces = np.stack((number, row, column), axis=-1).astype(np.float32)
    sky = cube(tmp_path, faces, lookup="clamped")
    for face, (middle, right, down) in enumerate(np.array(TABLE, float)):
        scene = view(make_scene, sky, middle, (-down).tolist(), 90, 80)
        _, d = pixel_rays(scene)
        shown = render(scene).linear
        # Its own face fills the picture exactly, as it is seen from inside: mirrored.
        assert np.abs(shown[..., 0] - face).max() < 1e-5
        depth = np.tensordot(middle, d, 1)
        s, t = (np.tensordot(way, d, 1) / depth for way in (right, down))
        for channel, place in ((1, t), (2, s)):
            expected = np.clip((place + 1) / 2 * size - 0.5, 0, size - 1)
            assert np.abs(shown[..., channel] - expected).max() < 1e-4
        assert shown[0, 0, 2] == pytest.approx(size - 1), (
            "the first column of the face is on the right"
        )


# ---------------------------------------------------------------- means


def bilinear_faces(faces: NDArray[np.float32], n: int) -> Array:
    """(6, n, n, 3) clamped bilinear values at the centres of n x n cells of each face: by two matrices."""
    size = faces.shape[1]
    place = np.clip((np.arange(n) + 0.5) / n * size - 0.5, 0, size - 1)
    weight = np.maximum(1 - np.abs(place[:, None] - np.arange(size)), 0)
    return np.einsum("ai,bj,fijc->fabc", weight, weight, faces.astype(float))


def solid_angles(n: int) -> Array:
    """(n, n) solid angle of each cell of a face: the integral of (1 + s^2 + t^2)^(-3/2), by its closed form."""
    s = 2 * np.arange(n + 1) / n - 1
    s, t = s[:, None], s[None, :]
    corner = np.arctan2(s * t, np.sqrt(1 + s**2 + t**2))
    return np.asarray(np.diff(np.diff(corner, axis=0), axis=1))


@lookups
def test_the_mean_of_six_pictures_is_the_mean_over_uniform_directions(
    make_scene: MakeScene, tmp_path: Path, lookup: str
) -> None:
    faces, n = random_faces(5, seed=3), 120
    sky = cube(tmp_path, faces, lookup=lookup)
    weight = solid_angles(n) / (4 * math.pi)
    assert 6 * weight.sum() == pytest.approx(1)
    mean = np.zeros(3)
    for middle, _, down in np.array(TABLE, float):
        scene = view(make_scene, sky, middle, (-down).tolist(), 90, n)
        mean += np.tensordot(weight, render(scene).linear.astype(float), 2)
    # The engine's own lookup of random directions, which has nothing to do with faces.
    rng = np.random.default_rng(4)
    d = rng.normal(size=(3, 1 << 20))
    d = (d / np.linalg.norm(d, axis=0)).astype(np.float32)
    found = scene.compiled.world.environment.radiance(d).astype(float)
    # 5 standard errors, 6e-7; and the midpoint rule over cells of 1 / 24 of a texel.
    error = 5 * found.std(axis=1) / math.sqrt(d.shape[1])
    assert (np.abs(found.mean(axis=1) - mean) < error + 1e-4).all()
    assert error.max() < 2e-3
    if lookup == "clamped":
        cells = bilinear_faces(faces, n)
        assert np.abs(np.einsum("ab,fabc->c", weight, cells) - mean).max() < 1e-5
        # The plain mean of all texels is another number: texels at the corners are seen less.
        assert np.abs(faces.mean(axis=(0, 1, 2)) - mean).max() > 5 * error.max()


@fewer
@lookups
@pytest.mark.parametrize("normal", [[0, 1, 0], [0, 0, -1]])
def test_a_plane_is_lit_by_the_solid_angles_of_the_texels_above_it(
    make_scene: MakeScene, tmp_path: Path, lookup: str, normal: list[int]
) -> None:
    faces = random_faces(4, seed=5) ** 8
    sky = cube(tmp_path, faces, lookup=lookup, lights=True)
    turn = [] if normal[1] else [{"rotate": {"axis": [1, 0, 0], "degrees": -90}}]
    eye = 0.3 * np.array(normal) + [0.05, 0, 0]
    scene = make_scene(
        camera={"eye": eye.tolist(), "look_at": [0, 0, 0], "up": [1, 0, 0], "vertical_fov": 1e-3},
        film={"width": 16, "height": 16},
        materials={"m": {"color": 1}},
        objects=[{"shape": "quad", "material": "m", "transform": turn}],
        environment=sky,
    )
    mean, tolerance = estimate(scene, 256)
    n = 200
    directions = cube_directions(n)
    cosine = np.maximum(np.tensordot(normal, directions, 1), 0)
    if lookup == "clamped":
        radiance = bilinear_faces(faces, n)
    else:
        found = scene.compiled.world.environment.radiance(
            directions.reshape(3, -1).astype(np.float32)
        )
        radiance = np.moveaxis(found.reshape(3, 6, n, n), 0, -1).astype(float)
    exact = np.einsum("fab,ab,fabc->c", cosine, solid_angles(n), radiance) / math.pi
    assert (np.abs(mean - exact) < tolerance + 1e-4).all()
    assert tolerance.max() < 0.01
