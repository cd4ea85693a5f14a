"""Ctrl-C: the picture so far comes back."""

import signal
from pathlib import Path

import numpy as np
import pytest

from course import EffectError, render
from course.base.errors import CourseError
from tests.engine.conftest import EveryStage


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
    assert 16 <= samples[0] <= picture.receipt.samples <= samples[-1] < 4096
    assert picture.receipt.rays["camera"] >= picture.receipt.samples * 96 * 64
    assert 0 < picture.linear.max(axis=2).min() < picture.linear.max() < 100
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
