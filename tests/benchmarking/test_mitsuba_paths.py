"""The Cornell box with its caustics in Mitsuba and here: the same picture, within the noise of both.

Pictures are compared by Welch's t of blocks of 8 x 8 pixels from 12 batches each, with seeds of their own. With at
least 11 degrees of freedom a |t| of 15 has a two-sided probability of 1.1e-8, so one of the 27 blocks and channels of
a right pair exceeds it less than once in 10^6 times. Seeds are fixed.
"""

from pathlib import Path

import pytest
from scipy.stats import t as students_t

from benchmarks.mitsuba_export import export, read, write
from benchmarks.path_tracing import Effort, agreement, load_scene_for_mitsuba

EFFORT = Effort(size=(24, 24), batches=12, samples=64)
LIMIT = 15.0


def test_a_right_pair_hardly_ever_exceeds_the_limit() -> None:
    values = 3 * (EFFORT.size[0] // 8) * (EFFORT.size[1] // 8)
    assert values * 2 * students_t.sf(LIMIT, EFFORT.batches - 1) < 1e-6


def test_the_cornell_box_is_mitsubas_within_noise(tmp_path: Path) -> None:
    pytest.importorskip("mitsuba", reason="needs Mitsuba: pip install .[peers]")
    found = agreement(load_scene_for_mitsuba(), EFFORT, tmp_path)
    assert found.largest < LIMIT, found
    assert abs(found.mean) < 0.02, found
    assert (tmp_path / "path_tracing.png").is_file()


def test_a_path_traced_scene_survives_a_file(tmp_path: Path) -> None:
    exported = export(load_scene_for_mitsuba(), 8, 8)
    write(exported, tmp_path)
    again = read(tmp_path)
    assert again.paths
    assert [light["type"] for light in again.lights] == ["rectangle"]
    assert again.max_depth == exported.max_depth
