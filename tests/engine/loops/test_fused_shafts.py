"""The fused loop looks at shafts as the batches do: the same rays aren't sent, and the picture is the same."""

from typing import Any

import numpy as np
import pytest

from course.engine.core.direct import DirectLight
from course.engine.core.tracer import Tracer
from course.engine.loops import embree_device
from tests.engine.terms.shafts.scenes import (
    MakeScene,
    random_scene,
    rendered,
    with_shafts,
    without_shafts,
)

if not embree_device.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.engine.loops.engine import compiled
from course.engine.loops.fits import fits


def _shafts(tracer: Tracer) -> Any:
    direct = tracer.integrator.direct
    assert isinstance(direct, DirectLight)
    return direct.spare


@pytest.mark.parametrize("seed", range(4))
def test_the_loop_spares_the_rays_that_batches_spare(seed: int, make_scene: MakeScene) -> None:
    scene = random_scene(make_scene, seed)
    tracer = with_shafts(scene, pixels=2.0)
    assert fits(tracer)
    batches, expected = rendered(tracer)
    fused, counters = rendered(compiled(with_shafts(scene, pixels=2.0)))
    assert np.array_equal(fused, batches)
    assert counters.spared["clear"] == expected.spared["clear"] > 0
    # Where several triangles block a shaft, the loop asks the first few whether they cut it off.
    assert counters.spared["cut off"] <= expected.spared["cut off"]
    spared = counters.spared["clear"] + counters.spared["cut off"]
    every = rendered(compiled(without_shafts(tracer)))[1].rays["shadow"]
    assert counters.rays["shadow"] + spared == every


def test_what_one_form_has_found_the_other_reads(make_scene: MakeScene) -> None:
    tracer = with_shafts(random_scene(make_scene, 2), pixels=2.0)
    rendered(compiled(tracer))
    found = np.count_nonzero(_shafts(tracer).made.known)
    _, counters = rendered(tracer)
    assert counters.spared["probes"] == 0
    assert np.count_nonzero(_shafts(tracer).made.known) == found > 0
