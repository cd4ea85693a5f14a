"""Rough metal and rough glass under a lamp, in Mitsuba and here: the same pictures within the noise of both.

Mitsuba's masking is the product of two G1, which is that of the known wrong submission `g2_product`: it is rendered.
Pictures are compared by Welch's t of blocks of 8 x 8 pixels, from 12 batches each, with seeds of their own. With at
least 11 degrees of freedom a |t| of 15 has a two-sided probability of 1.1e-8, so one of the 72 blocks and channels of a
right pair exceeds it less than once in 10^6 times. Seeds are fixed; 1.9 at most was measured.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.mitsuba_variants import start_llvm
from benchmarks.peer_agreement import with_mitsubas_masking
from course import render
from course.engine.scene.scene import load_variant
from tests.conftest import MakeScene

WIDTH, HEIGHT, BATCHES, SAMPLES, LIMIT = 48, 32, 12, 64, 15.0
N, K, ALPHA = [0.18, 0.42, 1.37], [3.42, 2.35, 1.77], 0.3
EYE, TARGET, LAMP, SKY = [0.5, 1.5, 5.0], [0.0, 0.4, 0.0], [3.0, 2.5, 2.0], 0.3
BOUNCES = {"gold": 1, "glass": 8}


def ours(make_scene: MakeScene, kind: str, folder: Path) -> np.ndarray:
    gold = {"refraction_index": N, "absorption_index": K, "roughness": ALPHA}
    glass = {"refraction_index": 1.5, "roughness": ALPHA, "distribution": "ggx"}
    turn = {"rotate": {"axis": [0, 1, 0], "degrees": 20}}
    box = {"shape": "box", "size": [1.6, 0.8, 1.2]}
    box["transform"] = [turn, {"translate": [0, 0.4, 0]}]
    thing = {"shape": "quad", "width": 8, "depth": 8} if kind == "gold" else box
    lamp = {"corner": [-1.5, 1.2, -1.5], "edge_u": [1.5, 0, 0], "edge_v": [0, 1.2, 0]}
    scene = make_scene(
        camera={"eye": EYE, "look_at": TARGET, "vertical_fov": 35},
        film={"width": WIDTH, "height": HEIGHT},
        sampler={"type": "random", "samples": SAMPLES},
        integrator={"type": "path", "max_depth": BOUNCES[kind], "roulette": None},
        environment={"type": "constant", "radiance": SKY},
        materials={
            "m": {"color": 0, "mirror": 1, "conductor": gold}
            if kind == "gold"
            else {"dielectric": glass}
        },
        lights=[{"type": "rectangle", "radiance": LAMP} | lamp],
        objects=[thing | {"material": "m"}],
    )
    bound = load_variant(scene.path, None, folder)
    pictures = [render(bound, seed=seed, compiled=False).linear for seed in range(1, BATCHES + 1)]
    return np.stack(pictures).astype(np.float64)


def theirs(kind: str) -> np.ndarray:
    import mitsuba as mi

    start_llvm(2)
    to = mi.ScalarTransform4f()

    def rgb(value: Any) -> dict[str, Any]:
        return {"type": "rgb", "value": value}

    ggx = {"distribution": "ggx", "alpha": ALPHA}
    if kind == "gold":
        bsdf = ggx | {"type": "roughconductor", "eta": rgb(N), "k": rgb(K)}
        thing = {"type": "rectangle", "to_world": to.rotate([1, 0, 0], -90).scale([4, 4, 1])}
    else:
        bsdf = ggx | {"type": "roughdielectric", "int_ior": 1.5, "ext_ior": 1.0}
        placed = to.translate([0, 0.4, 0]).rotate([0, 1, 0], 20).scale([0.8, 0.4, 0.6])
        thing = {"type": "cube", "to_world": placed}
    film = {"type": "hdrfilm", "width": WIDTH, "height": HEIGHT, "rfilter": {"type": "box"}}
    described = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": BOUNCES[kind] + 1, "rr_depth": 1000},
        "sensor": {
            "type": "perspective",
            "fov": 35,
            "fov_axis": "y",
            "to_world": to.look_at(origin=EYE, target=TARGET, up=[0, 1, 0]),
            "film": film | {"pixel_format": "rgb", "component_format": "float32"},
            "sampler": {"type": "independent"},
        },
        "sky": {"type": "constant", "radiance": rgb(SKY)},
        "thing": thing | {"bsdf": bsdf},
        "lamp": {
            "type": "rectangle",
            "to_world": to.translate([-0.75, 1.8, -1.5]).scale([0.75, 0.6, 1]),
            "bsdf": {"type": "diffuse", "reflectance": rgb(0.0)},
            "emitter": {"type": "area", "radiance": rgb(LAMP)},
        },
    }
    scene = mi.load_dict(described)
    return np.stack(
        [np.array(mi.render(scene, seed=100 + batch, spp=SAMPLES)) for batch in range(BATCHES)]
    ).astype(np.float64)


def blocks(pictures: np.ndarray) -> np.ndarray:
    return pictures.reshape(BATCHES, HEIGHT // 8, 8, WIDTH // 8, 8, 3).mean(axis=(2, 4))


@pytest.mark.usefixtures("llvm")
@pytest.mark.parametrize("kind", ["gold", "glass"])
def test_rough_materials_are_mitsubas_within_noise(
    make_scene: MakeScene, tmp_path: Path, kind: str
) -> None:
    (tmp_path / "mine").mkdir()
    mine = with_mitsubas_masking(tmp_path / "mine")
    one, other = blocks(ours(make_scene, kind, mine)), blocks(theirs(kind))
    error = np.sqrt((one.var(axis=0, ddof=1) + other.var(axis=0, ddof=1)) / BATCHES)
    # Where both are the sky alone, nothing but rounding is left.
    t = (one.mean(axis=0) - other.mean(axis=0)) / np.maximum(error, 1e-5)
    assert np.abs(t).max() < LIMIT, t
