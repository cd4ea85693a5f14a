"""Division by contrast beside rays that are spread evenly: equal errors on known curves, and a small run."""

import math
from pathlib import Path

import pytest

from benchmarks import adaptive_sampling
from benchmarks.adaptive_sampling import Effort, Point, rays_for
from course.benchmarking.plots import write_plots


def test_rays_for_an_error_on_a_power_law() -> None:
    curve = [Point(n, n**-0.75, 0.1 * n) for n in (1.0, 4.0, 16.0, 64.0)]
    for rays in (1.0, 3.0, 20.0, 64.0):
        assert rays_for(rays**-0.75, curve) == pytest.approx(rays)
    assert rays_for(2.0, curve) == pytest.approx(1.0)
    assert math.isnan(rays_for(0.001, curve))


def test_a_small_run_finds_that_division_saves_rays(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    effort = Effort((60, 45), 256, (0, 2), (0.1,), (1, 4, 16, 64), rounds=1)
    found = adaptive_sampling.measure(False, effort)
    assert [point.rays for point in found.regular] == [1, 4, 16, 64]
    coarse, fine = found.divisions
    assert coarse.point.rays == pytest.approx(61 * 46 / (60 * 45))
    assert coarse.saved == 0
    assert 0.5 < fine.saved < 1
    # An even grid needs more for the same error; at four times the width 5.8 times as many.
    assert fine.regular > 1.2 * fine.point.rays
    rows = adaptive_sampling.table(found, "small").rows
    assert len(rows) == 2
    plot = adaptive_sampling.plot("small", "small", found)
    for drawn in write_plots("divided", [plot], "1 round", tmp_path):
        assert "divided over 0.1" in drawn.read_text("utf-8")
