"""The fused loop makes the pictures that the batches make, bit for bit, and counts what they count."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.compiled import library
from course.effects import PROJECT
from course.jobs.picture import Picture
from course.render_scene import render
from course.scene.scene import Scene, load_scene

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled import engine

SCENES = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
SIZES: dict[str, dict[str, Any]] = {
    "whole packets": {"spp": 16, "size": (24, 16)},
    "several pixels in a packet": {"spp": 4, "size": (60, 40)},
    "packets that aren't full": {"spp": 21, "size": (13, 7)},
    "one ray": {"spp": 1, "size": (1, 1)},
    "to an error": {"spp": 64, "size": (45, 30), "error": 0.03},
}


def both(scene: Scene, monkeypatch: pytest.MonkeyPatch, **options: Any) -> tuple[Picture, Picture]:
    """The picture of the fused loop, which must fit, and that of the batches."""
    fits, known = engine.fits, []
    monkeypatch.setattr(engine, "fits", lambda tracer: known.append(fits(tracer)) or known[-1])
    fused = render(scene, sampler="sobol", compiled=True, threads=2, **options)
    assert known == [True]
    monkeypatch.setattr(engine, "fits", lambda _tracer: False)
    batches = render(scene, sampler="sobol", compiled=True, threads=1, **options)
    monkeypatch.undo()
    return fused, batches


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", SCENES)
def test_the_loop_and_the_batches_make_the_same_picture(
    name: str, size: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = load_scene(Path(PROJECT) / "scenes" / f"{name}.yaml")
    fused, batches = both(scene, monkeypatch, **SIZES[size])
    assert np.array_equal(fused.linear, batches.linear)
    assert fused.receipt.rays == batches.receipt.rays
    assert fused.receipt.numbers == batches.receipt.numbers
    assert fused.receipt.embree_seconds > 0
