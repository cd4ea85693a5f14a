"""The fused loop looks at shafts as the batches do: the same rays aren't sent, and the picture is the same."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import load_scene, render
from course.engine.core.direct import DirectLight
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import PROJECT
from course.engine.loops import embree_device
from tests.engine.terms.shafts.scenes import (
    FLAT,
    FLOOR,
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


def test_rays_are_spared_where_it_is_asked_for(make_scene: MakeScene) -> None:
    lamp = {"type": "sphere", "center": [0, 4, 0], "radius": 0.2, "intensity": 9}
    film = {"width": 512, "height": 512}
    scene = make_scene(**FLOOR | {"lights": [lamp], "film": film, "objects": [FLAT]})
    given = {"spp": 4, "compiled": True}
    asked, default = render(scene, **given, shafts=True), render(scene, **given)
    assert np.array_equal(default.linear, asked.linear)
    assert default.receipt.spared is None
    assert asked.receipt.spared is not None
    left_out = sum(asked.receipt.spared.values())
    assert left_out > 0
    assert asked.receipt.rays["shadow"] + left_out == default.receipt.rays["shadow"]


OUTSIDE = """
import numpy as np

def point_on_sphere(center, radius, u):
    place = np.add(center, [0, -1, 0] * np.asarray(radius) * 8).astype(np.float32)
    return np.repeat(place[:, None], u.shape[1], axis=1)
"""


def test_rays_to_points_that_others_have_placed_are_sent(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    (tmp_path / "soft_shadows.py").write_text(OUTSIDE, encoding="utf-8")
    lamp = {"type": "sphere", "center": [0, 4, 0], "radius": 0.2, "intensity": 9}
    roof = {"shape": "quad", "material": "floor", "width": 1, "depth": 1}
    roof |= {"transform": [{"translate": [0, 3, 0]}]}
    film = {"width": 512, "height": 512, "filter": "box"}
    plain = make_scene(**FLOOR | {"lights": [lamp], "film": film, "objects": [FLAT, roof]})
    (tmp_path / "supersampling.py").write_text(
        (PROJECT / "solutions" / "supersampling.py").read_text(encoding="utf-8"), encoding="utf-8"
    )
    scene = load_scene(plain.path, effects=tmp_path)
    spared = render(scene, spp=4, compiled=True, shafts=True)
    assert np.array_equal(spared.linear, render(scene, spp=4, compiled=False).linear)
