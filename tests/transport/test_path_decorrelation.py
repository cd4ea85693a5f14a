"""The numbers of a path through diffuse surfaces: dimensions of their own, and no two that go together in a pixel.

The measure is that of tests/effects/test_decorrelation.py: within each pixel, over 512 pixels, 1 for independent
points; the bound at 2 is 16 standard deviations away, false-fail rate below 1e-9.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course import Scene
from course.core.counters import Counters
from course.core.passes import passes
from course.core.samplers import Block
from course.core.samplers.sobol import SobolSampler
from course.core.types import Indices
from course.rendering.binding import bind
from tests.effects.test_decorrelation import LOCKED, measures

MakeScene = Callable[..., Scene]
DEPTH = 4


@pytest.fixture
def drawn(make_scene: MakeScene) -> list[tuple[int, int]]:
    """(dimension, width) of everything that paths draw in a box with a lamp, mirrors and gloss."""
    found: set[tuple[int, int]] = set()

    class Noted(SobolSampler):
        def draw(self, block: Block, dimension: int, width: int) -> Any:
            found.add((dimension, width))
            return super().draw(block, dimension, width)

        def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Any:
            found.add((dimension, width))
            return super().draw_some(block, dimension, width, path)

    scene = make_scene(
        film={"width": 16, "height": 16},
        camera={"eye": [0.1, 0.2, 0.3], "look_at": [1, 0, 0], "vertical_fov": 90},
        materials={
            "m": {"color": 0.5, "mirror": 0.4, "gloss": {"lobe": "phong", "exponent": 9}},
        },
        objects=[{"shape": "box", "material": "m", "size": [2, 2, 2]}],
        lights=[{"type": "sphere", "center": [0, 0.5, 0], "radius": 0.2, "radiance": 1}],
        environment={"type": "constant", "radiance": 1, "lights": True},
        integrator={"type": "path", "max_depth": DEPTH, "roulette": 0},
    )
    tracer = dataclasses.replace(bind(scene, scene.settings), sampler=Noted(0))
    for work in passes(scene.settings, tracer.sampler):
        tracer.render_tile(work.tile, work.first, work.samples, Counters())
    return sorted(found)


def test_every_decision_has_dimensions_of_its_own(drawn: list[tuple[int, int]]) -> None:
    rows = [dimension + k for dimension, width in drawn for k in range(width)]
    assert len(rows) == len(set(rows))
    # The pixel; lamp and sky at each of the hits; gloss, bounce and choice where the path goes on.
    assert len(drawn) == 1 + 2 * (DEPTH + 1) + 3 * DEPTH
    assert len(rows) == 2 + 4 * (DEPTH + 1) + (2 + 2 + 2) * DEPTH


@pytest.mark.parametrize("samples", [16, 64])
@pytest.mark.parametrize("name", ["sobol", "jittered", "random"])
def test_no_two_go_together(drawn: list[tuple[int, int]], name: str, samples: int) -> None:
    measure, _ = measures(drawn, name, samples, seed=3)
    assert np.isfinite(measure).all()
    assert measure.max() < LOCKED, f"{(measure >= LOCKED).sum()} of {len(measure)} pairs"
