"""Ctrl-C: the picture so far comes back."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import EffectError, Scene, render
from course.errors import CourseError

EveryStage = Callable[..., Scene]
ROOT = Path(__file__).parents[2]

PROGRAM = """
import json, signal, sys
from course import load_scene, render

def progress(done, covered):
    # As soon as every pixel has something, somebody presses Ctrl-C.
    if covered:
        signal.raise_signal(signal.SIGINT)

picture = render(load_scene(sys.argv[1]), spp=65536, threads=2, progress=progress)
linear = picture.linear
json.dump(
    {
        "complete": picture.complete,
        "interrupted": picture.interrupted,
        "least": int(picture.film.samples.min()),
        "most": int(picture.film.samples.max()),
        "darkest": float(linear.max(axis=2).min()),
        "brightest": float(linear.max()),
        "mean": picture.receipt.samples,
        "camera": picture.receipt.rays["camera"],
    },
    sys.stdout,
)
"""


@pytest.fixture
def interrupted(every_stage: EveryStage) -> dict[str, Any]:
    """What a process has to say whose render was interrupted by SIGINT."""
    scene = every_stage()
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM, str(scene.path)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert (done.returncode, done.stderr) == (0, "")
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def test_a_process_that_is_interrupted_keeps_a_covered_picture(interrupted: dict[str, Any]) -> None:
    assert interrupted["interrupted"]
    assert not interrupted["complete"]
    assert 16 <= interrupted["least"] <= interrupted["most"] < 65536
    assert 0 < interrupted["darkest"] < interrupted["brightest"] < 100
    assert interrupted["least"] <= interrupted["mean"] <= interrupted["most"]
    assert interrupted["camera"] >= interrupted["mean"] * 1200


def test_every_pixel_of_an_interrupted_picture_is_right_for_its_samples(
    every_stage: EveryStage,
) -> None:
    scene = every_stage(film={"width": 96, "height": 64})

    def progress(_done: float, covered: bool) -> None:
        if covered:
            signal.raise_signal(signal.SIGINT)

    picture = render(scene, spp=4096, progress=progress, threads=2)
    assert picture.interrupted
    samples = np.unique(picture.film.samples)
    assert samples[0] >= 16
    for count in samples[:3]:
        these = picture.film.samples == count
        whole = render(scene, spp=int(count))
        assert np.array_equal(picture.linear[these], whole.linear[these])
    with pytest.raises(CourseError, match="complete"):
        render(scene, spp=8192, start=picture)


def test_an_error_in_a_thread_reaches_the_caller(every_stage: EveryStage, tmp_path: Path) -> None:
    (tmp_path / "supersampling.py").write_text(
        "def resolve(radiance, weights):\n    raise ZeroDivisionError('in a tile')\n"
    )
    from course import load_scene

    plain = every_stage(lights=[])
    scene = load_scene(plain.path, effects=tmp_path)
    with pytest.raises(
        EffectError, match=r"raised ZeroDivisionError: in a tile in line 2 of supersampling"
    ):
        render(scene, spp=64, threads=2)
