"""Pictures keep their bits where rays that leave a ball are looked for among other objects alone."""

from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.engine.loops import embree_device, scene_tables
from tests.conftest import MakeScene

if not embree_device.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)


def balls(make_scene: MakeScene, **parts: Any) -> Scene:
    """Silver, glass and matt balls apart from each other, and a knot, in a bright sky."""
    places = {"silver": [-1, 0, 0], "glass": [0.9, 0.1, 0.6], "grey": [0.1, 1.1, -0.5]}
    return make_scene(
        film={"width": 96, "height": 72},
        materials={
            "silver": {"color": 0, "mirror": 0.9, "gloss": {"lobe": "plane", "roughness": 0.1}}
            if parts.pop("rough", False)
            else {"color": 0, "mirror": 0.9},
            "glass": {"color": 0, "dielectric": {"refraction_index": 1.5, "absorption": 0.1}},
            "grey": {"color": 0.7},
        },
        objects=[
            *(
                {"shape": "sphere", "material": name, "radius": 0.6, "segments": 64}
                | {"transform": [{"translate": place}]}
                for name, place in places.items()
            ),
            {"shape": "torus_knot", "material": "silver", "radius": 0.4, "tube": 0.12}
            | {"transform": [{"translate": [0, -1, 0]}]},
        ],
        environment={"type": "constant", "radiance": [0.5, 0.7, 1], "lights": True},
        lights=[{"type": "point", "position": [2, 3, 4], "intensity": 60}],
        **{"integrator": {"max_depth": 5}} | parts,
    )


@pytest.mark.parametrize(
    "parts",
    [{}, {"rough": True}, {"integrator": {"type": "path", "max_depth": 6}}],
    ids=["mirrors", "gloss", "paths"],
)
def test_pictures_keep_their_bits(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, parts: dict[str, Any]
) -> None:
    scene = balls(make_scene, **parts)
    surface = scene.compiled.world.surface
    convex = scene_tables.scene_tables(surface.accelerator, surface.triangles.parts).convex
    assert convex is not None
    assert convex.worth.tolist() == [True, True, True, False]
    some = render(scene, compiled=True, threads=1).linear
    monkeypatch.setattr(scene_tables, "convex_objects", lambda *_: None)
    everything = render(balls(make_scene, **parts), compiled=True, threads=1).linear
    assert np.array_equal(some, everything)
    assert np.array_equal(some, render(scene, compiled=False, threads=1).linear)
