"""Sheets of pictures for lectures, and what is compared for them, in tiny sizes: each picture in its place."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from benchmarks import path_tracing, radiosity
from benchmarks.report import CAPTION, GAP, Cell, draw_sheet
from course import load_scene, render
from course.engine.core.types import Floats32
from course.engine.formats.pictures.display import linear_to_srgb8
from course.engine.radiosity.patches import Patches, make_patches
from course.engine.radiosity.radiosity import solve
from course.engine.radiosity.solving import Shooting, with_ambient
from course.engine.radiosity.viewing import Solution, look, own_view
from course.engine.scene.scene import Scene, load_variant
from tests.engine.radiosity.rooms import FUNCTIONS, hollow_sphere

SIDE = 24
FEW = 60
"""Patches."""


@pytest.fixture(scope="module")
def room() -> Scene:
    return load_scene(radiosity.SCENE)


@pytest.fixture(scope="module")
def patches(room: Scene) -> Patches:
    return make_patches(room, FEW)


# ---------------------------------------------------------------- path tracing


def test_rays_and_bounces_of_the_sheet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every cell is the scene's picture with its row's rays and its column's bounces."""
    monkeypatch.setattr(path_tracing, "SIDE", SIDE)
    with Image.open(path_tracing.draw_figure(tmp_path / "new" / "sheet.png")) as image:
        sheet = np.asarray(image)
    for column, bounces in enumerate((1, 3, 100)):
        scene = load_variant(path_tracing.SCENE, {("integrator", "max_depth"): bounces})
        for row, rays in enumerate((1, 16, 64)):
            picture = render(scene, size=(SIDE, SIDE), spp=rays).linear
            expected = linear_to_srgb8(np.moveaxis(picture, -1, 0))
            assert (seen(sheet, row, column) == expected).all(), (rays, bounces)
            assert named(sheet, row, column)


def place(row: int, column: int) -> tuple[int, int]:
    """Top and left of a picture on a sheet."""
    return row * (SIDE + CAPTION) + CAPTION, GAP + column * (SIDE + GAP)


def seen(sheet: np.ndarray, row: int, column: int) -> np.ndarray:
    top, left = place(row, column)
    return sheet[top : top + SIDE, left : left + SIDE]


def named(sheet: np.ndarray, row: int, column: int) -> bool:
    """Whether there is dark ink above a picture."""
    top, left = place(row, column)
    return bool((sheet[top - CAPTION : top, left : left + SIDE] < 128).any())


# ---------------------------------------------------------------- radiosity


@pytest.mark.parametrize("reflectance", [0.2, 0.5])
def test_an_iteration_adds_one_reflection(reflectance: float) -> None:
    """Inside an evenly glowing sphere the share rho^(n + 1) is missing after n iterations."""
    found = radiosity.iterate(hollow_sphere(12, 2.0, reflectance), FUNCTIONS, (0, 1, 2, 5), 32)
    assert list(found) == [0, 1, 2, 5]
    for steps, solved in found.items():
        assert solved.steps == steps
        assert solved.left == pytest.approx(reflectance ** (steps + 1), rel=1e-3), steps


def test_iterations_of_the_sheet(
    room: Scene, patches: Patches, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(radiosity, "SIDE", SIDE)
    iterations = radiosity.iterate(patches, FUNCTIONS, (0, 1, 32, 320), 32)
    cells = list(filter(None, radiosity.iteration_cells(room, patches, iterations)))
    assert [name for name, _ in cells] == [
        f"{steps}, {patches.size} patches"
        for steps in ("0 iterations", "1 iteration", "32 iterations", "320 iterations")
    ]
    alone, first, later, last = (picture for _, picture in cells)
    lamp = alone.max(axis=0) > 0
    assert 0 < lamp.mean() < 0.1
    assert (first.max(axis=0) > 0).mean() > 0.4
    assert (later >= first - 1e-6).all()
    assert later.sum() > 1.2 * first.sum()
    assert (linear_to_srgb8(later) == linear_to_srgb8(last)).all()


def test_shots_of_the_sheet(room: Scene, patches: Patches, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(radiosity, "SIDE", SIDE)
    shooting = Shooting(patches, FUNCTIONS, lamp_rays=500_000)
    shots = []
    for most in (1, 8):
        shooting.run(0.0, most)
        # Later shots change these arrays.
        solved = replace(shooting.solved, radiosity=shooting.radiosity.copy())
        guess = with_ambient(patches, solved.radiosity, shooting.unshot)
        shots.append((solved, guess))
    plain, ambient = radiosity.shot_cells(room, patches, shots)
    assert plain[0] is None
    assert ambient[0] is None
    for number, words in enumerate(("1 shot", "8 shots"), start=1):
        one, other = plain[number], ambient[number]
        assert one is not None
        assert other is not None
        assert one[0] == f"{words}, {patches.size} patches"
        assert other[0] == f"{one[0]}, ambient term"
        assert other[1].sum() > one[1].sum()
    assert plain[2] is not None
    assert plain[1] is not None
    assert plain[2][1].sum() > plain[1][1].sum()


def test_pictures_stand_in_their_places(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    pictures: list[Floats32] = [rng.random((3, SIDE, SIDE), np.float32) for _ in range(3)]
    rows: list[list[Cell | None]] = [
        [("a", pictures[0]), ("b", pictures[1])],
        [None, ("c", pictures[2])],
    ]
    with Image.open(draw_sheet(rows, tmp_path / "new" / "sheet.png")) as image:
        sheet = np.asarray(image)
    places = ((0, 0), (0, 1), (1, 1))
    for picture, at in zip(pictures, places, strict=True):
        assert (seen(sheet, *at) == linear_to_srgb8(picture)).all()
        assert named(sheet, *at)
    assert (seen(sheet, 1, 0) == 255).all()
    assert not named(sheet, 1, 0)


# ---------------------------------------------------------------- radiosity beside path tracing


@pytest.fixture(scope="module")
def solution(room: Scene) -> Solution:
    return solve(room, patches=FEW, tolerance=0.1)


@pytest.fixture(scope="module")
def own_picture(solution: Solution) -> Floats32:
    return look(solution, own_view(solution), radiosity.PIXELS, radiosity.PIXELS)


def test_a_solution_differs_by_nothing_from_itself(
    solution: Solution, own_picture: Floats32
) -> None:
    found = radiosity.beside_paths(solution, own_picture.astype(np.float64))
    assert (found.mean, found.rms) == pytest.approx((0, 0), abs=1e-6)


def test_the_worst_channel_counts_without_the_lamp(
    solution: Solution, own_picture: Floats32
) -> None:
    """A channel that is 4% brighter everywhere, and a lamp of any brightness."""
    paths = own_picture.astype(np.float64)
    lamp = paths.max(axis=0) >= radiosity.LAMP
    assert lamp.any()
    paths[1] *= 1.04
    paths[:, lamp] = 1000
    found = radiosity.beside_paths(solution, paths)
    assert found.mean == pytest.approx(1 - 1 / 1.04, rel=1e-4)
    assert 1 <= found.rms / found.mean < 2


def test_squares_tell_what_the_mean_does_not(solution: Solution, own_picture: Floats32) -> None:
    """Every second row of squares a little brighter, the others darker by as much."""
    paths = own_picture.astype(np.float64)
    level = np.where(np.arange(radiosity.PIXELS) // radiosity.SQUARE % 2, 0.05, -0.05)
    found = radiosity.beside_paths(solution, paths + level[:, None] * (paths < radiosity.LAMP))
    assert found.rms > 3 * found.mean
    # One pixel up and one down are the same square.
    fine = np.where(np.arange(radiosity.PIXELS) % 2, 0.05, -0.05)
    inside = paths + fine[:, None] * (paths.max(axis=0) < radiosity.LAMP)
    assert radiosity.beside_paths(solution, inside).rms < 1e-3


def test_paths_are_the_scene_s_picture(room: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(radiosity, "PIXELS", 16)
    picture = radiosity.trace(room, 16)
    assert picture.shape == (3, 16, 16)
    assert picture.max() > radiosity.LAMP
    # Red light from the left wall, green from the right.
    assert picture[0, 8, 0] > 2 * picture[1, 8, 0]
    assert picture[1, 8, -1] > 2 * picture[0, 8, -1]
