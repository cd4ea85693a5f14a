"""The inside of glass shows nothing that lamps, the sky, ambient light or other surfaces send; its outside does."""

from typing import Any

import numpy as np
import pytest

from course import render
from tests.conftest import MakeScene
from tests.forms import in_both_forms

LIGHTS: dict[str, dict[str, Any]] = {
    "lamp": {"lights": [{"type": "point", "position": [0, 0, 3], "intensity": 40}]},
    "sky": {"environment": {"type": "constant", "radiance": 1, "lights": True}},
    "ambient": {"lights": [{"type": "ambient", "radiance": 1}]},
}
PANE = {"color": 0.5, "dielectric": {"refraction_index": 1.0, "shaded": True}}


def seen(make_scene: MakeScene, light: str, front: bool, **parts: Any) -> Any:
    """The middle of a pane, as lit as it is; light goes straight through it, and behind it is nothing."""
    description: dict[str, Any] = {
        "camera": {"eye": [0, 0, 2], "look_at": [0, 0, 0], "vertical_fov": 5},
        "film": {"width": 4, "height": 4},
        "sampler": {"samples": 16},
        "materials": {"pane": PANE},
        "objects": [
            {"shape": "quad", "material": "pane", "width": 4, "depth": 4}
            | {"transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90 if front else -90}}]}
        ],
    }
    parts = LIGHTS[light] | parts
    compiled = parts.pop("compiled", False)
    return render(make_scene(**(description | parts)), compiled=compiled)


@in_both_forms
@pytest.mark.parametrize("integrator", [{"max_depth": 2}, {"type": "path", "max_depth": 2}])
@pytest.mark.parametrize("light", LIGHTS)
def test_only_the_outside_shows_light(
    make_scene: MakeScene, light: str, integrator: dict[str, Any], compiled: bool
) -> None:
    outside, inside = (
        seen(make_scene, light, front, integrator=integrator, compiled=compiled)
        for front in (True, False)
    )
    # A pane of index 1 reflects nothing, so what is seen through it is the sky behind, or black.
    behind = 1.0 if light == "sky" else 0.0
    assert np.allclose(inside.linear, behind, atol=1e-6)
    assert outside.linear.min() > 0.2
    assert not np.allclose(outside.linear, behind, atol=0.1)
    if light != "ambient":
        # And none is looked for in vain.
        assert outside.receipt.rays["shadow"] > 0
        assert inside.receipt.rays["shadow"] == 0
