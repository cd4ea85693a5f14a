"""The numbers of a path through diffuse surfaces: dimensions of their own, and no two that go together in a pixel.

The measure is that of tests/engine/core/test_decorrelation.py: within each pixel, over 512 pixels, 1 for independent
points; the bound at 2 is 16 standard deviations away, false-fail rate below 1e-9.
"""

import numpy as np
import pytest

from tests.conftest import MakeScene
from tests.drawn import numbers_drawn, rows
from tests.engine.core.test_decorrelation import LOCKED, measures

DEPTH = 4


@pytest.fixture
def drawn(make_scene: MakeScene) -> list[tuple[int, int]]:
    """(dimension, width) of everything that paths draw in a box with a lamp, mirrors and gloss."""
    scene = make_scene(
        film={"width": 16, "height": 16},
        camera={"eye": [0.1, 0.2, 0.3], "look_at": [1, 0, 0], "vertical_fov": 90},
        materials={"m": {"color": 0.5, "mirror": 0.4, "gloss": {"lobe": "phong", "exponent": 9}}},
        objects=[{"shape": "box", "material": "m", "size": [2, 2, 2]}],
        lights=[{"type": "sphere", "center": [0, 0.5, 0], "radius": 0.2, "radiance": 1}],
        environment={"type": "constant", "radiance": 1, "lights": True},
        integrator={"type": "path", "max_depth": DEPTH, "roulette": 0},
    )
    return sorted(numbers_drawn(scene))


def test_every_decision_has_dimensions_of_its_own(drawn: list[tuple[int, int]]) -> None:
    assert len(rows(drawn)) == len(set(rows(drawn)))
    # The pixel; lamp and sky at each of the hits; gloss, bounce and choice where the path goes on.
    assert len(drawn) == 1 + 2 * (DEPTH + 1) + 3 * DEPTH
    assert len(rows(drawn)) == 2 + 4 * (DEPTH + 1) + (2 + 2 + 2) * DEPTH


@pytest.mark.parametrize("samples", [16, 64])
@pytest.mark.parametrize("name", ["sobol", "jittered", "random"])
def test_no_two_go_together(drawn: list[tuple[int, int]], name: str, samples: int) -> None:
    measure, _ = measures(drawn, name, samples, seed=3)
    assert np.isfinite(measure).all()
    assert measure.max() < LOCKED, f"{(measure >= LOCKED).sum()} of {len(measure)} pairs"
