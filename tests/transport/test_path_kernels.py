"""The compiled choice of a path's way is that of the passes over arrays, bit for bit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.geometry import packets
from course.transport.path_bounce import DIFFUSE, MIRRORED, REFRACTED, PathBounce

if not packets.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

MakeScene = Callable[..., Scene]
GLASS = {"color": 0, "dielectric": {"refraction_index": 1.5}}
MATERIALS = {
    "floor": {"color": [0.6, 0.3, 0.1], "mirror": [0.1, 0.2, 0.3]},
    "wall": {"color": 0.7},
    "mirror": {"color": 0, "mirror": [0.9, 0.5, 0.4]},
}


@pytest.mark.parametrize("glass", [True, False], ids=["glass", "no glass"])
def test_the_same_way_and_throughput(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, glass: bool
) -> None:
    taken: list[Any] = []
    passes = PathBounce._chosen

    def both(bounce: PathBounce, hits: Any, *arguments: Any) -> Any:
        mine = passes(bounce, replace(hits, compiled=False), *arguments)
        theirs = passes(bounce, replace(hits, compiled=True), *arguments)
        for one, other in zip(mine, theirs, strict=True):
            assert (one.shape, one.dtype) == (other.shape, other.dtype)
            assert one.tobytes() == other.tobytes()
        taken.append(mine[1].take(arguments[2]))
        return mine

    monkeypatch.setattr(PathBounce, "_chosen", both)
    materials = ["floor", "mirror", "glass" if glass else "wall"]
    scene = make_scene(
        camera={"eye": [0, 1, 4], "look_at": [0, 0, 0]},
        film={"width": 40, "height": 30},
        sampler={"samples": 16},
        integrator={"type": "path", "max_depth": 6, "roulette": 2},
        environment={"type": "constant", "radiance": [0.5, 0.6, 0.7]},
        materials=MATERIALS | ({"glass": GLASS} if glass else {}),
        lights=[{"type": "sphere", "center": [0, 3, 2], "radius": 0.3, "intensity": 9}],
        objects=[
            {"shape": "quad", "material": "floor", "width": 8, "depth": 8}
            | {"transform": [{"translate": [0, -0.6, 0]}]},
            *(
                {"shape": "sphere", "radius": 0.5, "segments": 24, "material": material}
                | {"transform": [{"translate": [number - 1.0, 0, 0]}]}
                for number, material in enumerate(materials)
            ),
        ],
    )
    render(scene, threads=1)
    ways = np.concatenate(taken)
    assert len(taken) > 4
    for way, some in ((DIFFUSE, True), (MIRRORED, True), (REFRACTED, glass)):
        assert (np.count_nonzero(ways == way) > 1000) == some
