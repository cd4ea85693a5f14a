"""Scenes with photons, and what tests look at in them."""

from typing import Any

import numpy as np

from course import render
from course.engine.core.counters import Counters
from course.engine.core.rays import Draws
from course.engine.core.samplers import Block
from course.engine.core.tracer import Tracer
from course.engine.core.types import Floats64
from course.engine.functions.effects import Bound
from course.engine.render.binding import bind
from course.engine.scene.scene import Scene
from course.engine.terms.photons.emission import WIDTH, Target, leaving
from course.engine.terms.photons.flight import Photons
from course.engine.terms.photons.maps import PhotonMap
from course.engine.terms.photons.numbers import spread
from course.engine.terms.photons.passes import Passes
from course.engine.terms.photons.stage import Caustics, PhotonStage
from tests.conftest import MakeScene

GLASS = {"color": 0, "dielectric": {"refraction_index": 1.5}}
WHITE = {"color": 0.7}
FLOOR = {"shape": "quad", "name": "floor", "material": "white", "width": 8, "depth": 8}


def ball(radius: float = 0.3, y: float = 0.8, **more: Any) -> dict[str, Any]:
    move = [{"translate": [0, y, 0]}]
    return {
        "shape": "sphere",
        "material": "m",
        "radius": radius,
        "segments": 256,
        "transform": move,
    } | more


def caustics(make_scene: MakeScene, material: Any = GLASS, **parts: Any) -> Scene:
    known: dict[str, Any] = {
        "camera": {"eye": [0, 5, 0.01], "look_at": [0, 0, 0], "vertical_fov": 40},
        "materials": {"white": WHITE, "m": material},
        "objects": [FLOOR, ball()],
        "photons": {"count": 20_000, "radius": 0.05},
    }
    return make_scene(**known | parts)


def stage_of(scene: Scene) -> PhotonStage:
    (stage,) = scene.compiled.world.wraps
    assert isinstance(stage, PhotonStage)
    return stage


def tracer_of(scene: Scene) -> Tracer:
    return bind(scene, scene.settings, Bound(scene.effects, scene.compiled.needs))


def sky_of(scene: Scene) -> Any:
    """What adds to direct light."""
    direct = tracer_of(scene).integrator.direct
    assert direct is not None
    return direct.sky


def photons_of(scene: Scene, number: int = 0) -> Photons:
    """The photons of a pass of caustics, in the units of the scene file."""
    sky = sky_of(scene)
    assert isinstance(sky, Caustics)
    return map_of(scene, sky.passes, number)


def map_of(scene: Scene, passes: Passes, number: int = 0) -> Photons:
    """The photons of a pass, in the units of the scene file."""
    tracer = tracer_of(scene)
    block = Block(np.zeros(1, np.uint32), 0, 1, 0)
    draws = Draws(tracer.sampler, tracer.dimensions, block, Counters())
    made: PhotonMap = passes.of(number, draws)
    frame, own = scene.compiled.frame, made.photons
    place = own.position.astype(np.float64) * frame.scale + frame.center[:, None]
    return Photons(place, own.direction, own.power * np.float32(frame.scale**2))  # type: ignore[arg-type]


def sent(
    scene: Scene, light: int = 0, n: int = 4096, everywhere: bool = True
) -> tuple[Floats64, ...]:
    """Origins, directions and powers of photons that leave a light, in the units of the scene file."""
    stage, frame = stage_of(scene), scene.compiled.frame
    target = stage.target
    assert target is not None
    if everywhere:
        # From within the ball photons leave in all directions.
        target = Target(target.center, 1e6, 1e6)
    u = spread(3, 1, 0, n, WIDTH)
    origin, way, power = (
        np.asarray(each, np.float64)
        for each in leaving(stage.lights[light], n, u, stage.module, target)
    )
    return origin * frame.scale + frame.center[:, None], way, power * frame.scale**2


def pictures(scene: Scene, spp: int, seeds: int) -> Floats64:
    """(seeds, 3) mean radiance of the whole picture."""
    made = [render(scene, spp=spp, seed=seed).linear for seed in range(seeds)]
    return np.array([np.asarray(one, np.float64).mean(axis=(0, 1)) for one in made])


GLOBE = {"type": "sphere", "center": [0.4, 2.2, 0.3], "radius": 0.4, "radiance": 4}
