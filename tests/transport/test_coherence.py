"""Embree is told that neighbouring rays are coherent where they are, and nowhere else."""

from typing import Any

import pytest

from course import render
from course.compiled.accelerator import MovingPackets, PacketAccelerator
from course.core.accelerator import StaticAccelerator
from course.core.motion import MovingAccelerator
from course.extras.swept_movers import SweptMovers
from tests.conftest import MakeScene

LENS = {"lens": {"aperture_radius": 0.1, "focus_distance": 4}}
SHUTTER = {"shutter": {"open": 0, "close": 1}}
MOVER = {"shape": "sphere", "radius": 0.2, "segments": 8, "motion": {"velocity": [1, 0, 0]}}


@pytest.mark.parametrize(
    ("camera", "material", "integrator", "more", "expected"),
    [
        ({}, {}, {}, [], [True, True, False, False]),
        (LENS, {}, {}, [], [False] * 4),
        ({}, {"gloss": {"lobe": "phong", "exponent": 90}}, {}, [], [True, False, False, False]),
        (SHUTTER, {}, {}, [MOVER], [True, False, False, False]),
        ({}, {}, {"type": "path", "roulette": None}, [], [True, False, False, False]),
    ],
    ids=["mirrors", "lens", "lobe", "motion", "paths"],
)
def test_camera_rays_and_their_mirror_images(
    make_scene: MakeScene,
    monkeypatch: pytest.MonkeyPatch,
    each_form: bool,
    camera: Any,
    material: Any,
    integrator: Any,
    more: Any,
    expected: list[bool],
) -> None:
    if each_form:
        # The fused loop asks Embree itself.
        monkeypatch.setattr("course.compiled.engine.fits", lambda _tracer: False)
    told: list[bool] = []
    inside: list[bool] = []
    for kind in (
        *(StaticAccelerator, PacketAccelerator),
        *(MovingAccelerator, MovingPackets, SweptMovers),
    ):
        intersect = kind.intersect

        def noted(
            self: Any,
            *arguments: Any,
            intersect: Any = intersect,
            coherent: bool = False,
            **rest: Any,
        ) -> Any:
            # A query goes on to the things that stand still and to those that move.
            if inside:
                assert coherent == inside[0]
                return intersect(self, *arguments, coherent=coherent, **rest)
            told.append(coherent)
            inside.append(coherent)
            try:
                return intersect(self, *arguments, coherent=coherent, **rest)
            finally:
                inside.clear()

        monkeypatch.setattr(kind, "intersect", noted)
    mirror = {"color": 0, "mirror": 0.9} | material
    wall = {"shape": "quad", "material": "mirror", "width": 99, "depth": 99}
    scene = make_scene(
        camera={"eye": [0, 1, 3], "look_at": [0, 0.5, 0]} | camera,
        film={"width": 8, "height": 6},
        sampler={"samples": 4},
        integrator={"max_depth": 3} | integrator,
        materials={"mirror": mirror},
        objects=[
            wall,
            wall | {"transform": [{"translate": [0, 2, 0]}]},
            *(each | {"material": "mirror"} for each in more),
        ],
    )
    render(scene, threads=1)
    assert told == expected
