"""Fog beside Mitsuba's: a coloured cube of it, alone and over a floor, by paths and by `volpath`.

Differences of pixels are independent, and their mean is within 5.33 standard errors: a false-fail rate of 1e-7 for each
of six numbers.
"""

from typing import Any

import numpy as np
import pytest

from course import render
from tests.conftest import MakeScene

mi = pytest.importorskip("mitsuba")

SIGMA, ALBEDO, G = (1.0, 1.5, 2.2), (0.9, 0.8, 0.6), 0.3
EYE, LAMP, SIZE = [0, 0.6, 4], [1.6, 2.0, 1.0], 32


def of_mitsuba(floor: bool) -> np.ndarray:
    mi.set_variant("scalar_rgb")

    def color(values: Any) -> dict[str, Any]:
        return {"type": "rgb", "value": list(values)}

    transform = mi.ScalarTransform4f
    fog = {
        "type": "homogeneous",
        # A colour of Mitsuba's is at most 1.
        "sigma_t": color(s / 3 for s in SIGMA),
        "scale": 3.0,
        "albedo": color(ALBEDO),
        "phase": {"type": "hg", "g": G},
    }
    scene: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": 61, "rr_depth": 1000},
        "sensor": {
            "type": "perspective",
            "fov": 28,
            "fov_axis": "y",
            "to_world": transform().look_at(EYE, [0, 0, 0], [0, 1, 0]),
            "film": {
                "type": "hdrfilm",
                "width": SIZE,
                "height": SIZE,
                "rfilter": {"type": "box"},
                "pixel_format": "rgb",
            },
            "sampler": {"type": "independent", "sample_count": 128},
        },
        "light": {"type": "point", "position": LAMP, "intensity": color((12, 12, 12))},
        "cube": {"type": "cube", "bsdf": {"type": "null"}, "interior": fog},
    }
    if floor:
        lies = transform().translate([0, -1.2, 0]).rotate([1, 0, 0], -90).scale(2)
        matt = {"type": "diffuse", "reflectance": color((0.5, 0.5, 0.5))}
        scene["floor"] = {"type": "rectangle", "to_world": lies, "bsdf": matt}
    return np.array(mi.render(mi.load_dict(scene)), np.float64).reshape(-1, 3)


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
        lights=[{"type": "point", "position": LAMP, "intensity": 12}],
        media=[
            {
                "extinction": list(SIGMA),
                "albedo": list(ALBEDO),
                "g": G,
                "box": [[-1, -1, -1], [1, 1, 1]],
            }
        ],
    )
    ours, theirs = render(scene).linear.reshape(-1, 3), of_mitsuba(floor)
    apart = ours - theirs
    error = apart.std(axis=0) / len(apart) ** 0.5
    assert (np.abs(apart.mean(axis=0)) <= 5.33 * error).all()
    assert (error < 0.02 * theirs.mean(axis=0)).all()
