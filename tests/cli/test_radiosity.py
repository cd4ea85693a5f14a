"""`course radiosity`: a solution worked out, kept and looked at."""

import json
from pathlib import Path

import numpy as np
import pytest

from course.engine.formats.pictures.reading import read_picture
from tests.cli.conftest import Run
from tests.engine.radiosity.rooms import plates


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "plates.yaml"
    path.write_text(json.dumps({**plates(0.5), "film": {"width": 24, "height": 16}}))
    return path


def test_a_scene_becomes_a_picture(run: Run, scene: Path, tmp_path: Path) -> None:
    result = run("radiosity", scene, "--patches", 20)
    assert result.exit_code == 0, result.output
    assert "20 patches" in result.stdout
    assert "of convergence" in result.stdout
    picture = read_picture(tmp_path / "plates.png")
    assert picture.shape[:2] == (16, 24)
    assert picture.max() > 0.5


def test_a_solution_is_kept_and_looked_at_from_anywhere(
    run: Run, scene: Path, tmp_path: Path
) -> None:
    result = run(
        "radiosity", scene, "--patches", 20, "--iterations", 2, "-o", "room.npz", "-o", "room.exr"
    )
    assert result.exit_code == 0, result.output
    assert "2 steps" in result.stdout
    cameras = ("--camera", "0,0.5,5:0,0.5,0", "--camera", "1,0.4,3:0,0.5,0")
    assert run("radiosity", "room.npz", *cameras, "-o", "see.exr").exit_code == 0
    first = read_picture(tmp_path / "room.exr")
    assert np.array_equal(first, read_picture(tmp_path / "see_000.exr"))
    assert not np.array_equal(first, read_picture(tmp_path / "see_001.exr"))
    result = run("radiosity", "room.npz", *cameras, "--frames", 3, "--size", "8x8", "-o", "fly.png")
    assert result.exit_code == 0
    assert result.stdout.split() == ["fly_000.png", "fly_001.png", "fly_002.png"]
    assert read_picture(tmp_path / "fly_002.png").shape[:2] == (8, 8)


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (("--camera", "1,2:3"), 2, "expected EYE:LOOK_AT"),
        (("--frames", "5"), 1, "--frames needs two or more --camera"),
        (("-o", "room.jpg"), 1, "must end in .png or .exr"),
        (("-o", "nowhere/room.npz"), 1, "there is no folder"),
        (("--camera", "0,0,0:0,1,0", "--patches", "4"), 1, "looks along its up"),
        (
            ("--camera", "0,1,4:0,1,0", "--camera", "0,4,0:0,1,0", "--patches", "4"),
            1,
            "camera 2 of 2: the camera at [0.0, 4.0, 0.0] looks along its up",
        ),
        (
            ("--camera", "0,1,4:0,1,0", "--camera=0,1,-4:0,1,0", "--frames", 3, "--patches", 4),
            1,
            "frame 1 of the flight, between the cameras at [0.0, 1.0, 4.0] and [0.0, 1.0, -4.0]",
        ),
    ],
)
def test_what_does_not_fit_is_refused(
    run: Run, scene: Path, arguments: tuple[str | int, ...], code: int, told: str
) -> None:
    result = run("radiosity", scene, *arguments)
    assert result.exit_code == code
    assert told in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    ("method", "told"),
    [("gather", "0 steps, how far from convergence is not known"), ("shoot", r"0 steps, within ")],
)
def test_of_no_step_at_all_only_what_is_known_is_said(
    run: Run, scene: Path, method: str, told: str
) -> None:
    options = ("--patches", 20, "--iterations", 0, "--method", method)
    result = run("radiosity", scene, *options)
    assert result.exit_code == 0
    assert told in result.stdout
    assert "inf" not in result.stdout


def test_a_solution_is_not_worked_out_again(run: Run, scene: Path) -> None:
    run("radiosity", scene, "--patches", 4, "-o", "room.npz")
    result = run("radiosity", "room.npz", "--patches", 4)
    assert result.exit_code == 1
    assert "--patches is for scene files" in result.stderr


def test_a_function_that_is_not_written_is_named(run: Run, scene: Path) -> None:
    result = run("radiosity", scene, "--patches", 4, "--effects", "assignments")
    assert result.exit_code == 1
    assert "radiosity.hemicube_form_factors: not written yet" in result.stderr
