"""Fog beside Mitsuba's: a coloured cube of it, alone and over a floor, by paths and by `volpath`.

Differences of pixels are independent, and their mean is within 5.33 standard errors: a false-fail rate of 1e-7 for each
of six numbers.
"""

import numpy as np
import pytest

from benchmarks.volpath import ALBEDO, EYE, LAMP, POWER, SIGMA, G, of_mitsuba
from course import render
from tests.conftest import MakeScene

mi = pytest.importorskip("mitsuba")

SIZE = 32


def of_volpath(floor: bool) -> np.ndarray:
    mi.set_variant("scalar_rgb")
    scene = mi.load_dict(of_mitsuba(floor, SIZE, rr_depth=1000))
    return np.array(mi.render(scene, spp=128), np.float64).reshape(-1, 3)


@pytest.mark.parametrize("floor", [False, True], ids=["alone", "over a floor"])
def test_fog_is_as_bright_as_mitsubas(make_scene: MakeScene, floor: bool) -> None:
    quad = {"shape": "quad", "material": "w", "width": 4, "depth": 4}
    scene = make_scene(
        camera={"eye": EYE, "look_at": [0, 0, 0], "vertical_fov": 28},
        film={"width": SIZE, "height": SIZE},
        sampler={"type": "random", "samples": 128},
        integrator={"type": "path", "max_depth": 60, "roulette": None},
        materials={"w": {"color": 0.5}},
        objects=[quad | {"transform": [{"translate": [0, -1.2, 0]}]}] if floor else [],
        lights=[{"type": "point", "position": LAMP, "intensity": POWER}],
        media=[
            {
                "extinction": list(SIGMA),
                "albedo": list(ALBEDO),
                "g": G,
                "box": [[-1, -1, -1], [1, 1, 1]],
            }
        ],
    )
    ours, theirs = render(scene).linear.reshape(-1, 3), of_volpath(floor)
    apart = ours - theirs
    error = apart.std(axis=0) / len(apart) ** 0.5
    assert (np.abs(apart.mean(axis=0)) <= 5.33 * error).all()
    assert (error < 0.02 * theirs.mean(axis=0)).all()
