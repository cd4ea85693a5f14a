"""Random scenes for shafts, and tracers that send the spared rays all the same."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import Scene
from course.engine.core.counters import Counters
from course.engine.core.direct import Candidates, Visible
from course.engine.core.hits import Hits
from course.engine.core.lights.sample import Light
from course.engine.core.rays import Draws
from course.engine.core.tiles import passes
from course.engine.core.tracer import Tracer
from course.engine.core.types import Mask
from course.engine.render.binding import bind
from course.engine.terms.shafts import stage
from course.engine.terms.shafts.stage import Shafts
from course.engine.terms.shafts.walk import CLEAR, CUT_OFF

MakeScene = Callable[..., Scene]

FLOOR: dict[str, Any] = {
    "camera": {"eye": [0, 3, 6], "look_at": [0, 0, 0], "vertical_fov": 30},
    "film": {"width": 40, "height": 30},
    "sampler": {"samples": 16},
    "materials": {"floor": {}},
}
FLAT = {"shape": "quad", "material": "floor", "width": 40, "depth": 40}


def with_shafts(scene: Scene, pixels: float | None = None) -> Tracer:
    """The batches' tracer, with shafts however small the picture is."""
    tracer = bind(scene, scene.settings)
    size = scene.settings.width * scene.settings.height
    wanted = stage.WORTH, stage.SAMPLES_A_TRIANGLE
    try:
        stage.WORTH = stage.SAMPLES_A_TRIANGLE = 0
        integrator = stage.with_shafts(tracer.integrator, size, 64)
    finally:
        stage.WORTH, stage.SAMPLES_A_TRIANGLE = wanted
    direct: Any = integrator.direct
    if pixels is not None and direct.spare is not None:
        direct = replace(direct, spare=replace(direct.spare, pixels=pixels))
    return replace(tracer, integrator=replace(integrator, direct=direct))


def without_shafts(tracer: Tracer) -> Tracer:
    """The same, which sends all rays."""
    direct: Any = tracer.integrator.direct
    direct = replace(direct, spare=None)
    return replace(tracer, integrator=replace(tracer.integrator, direct=direct))


def rendered(tracer: Tracer) -> tuple[Any, Counters]:
    """Colours of all tiles, one after the other, and what was counted."""
    counters, found = Counters(), []
    for work in passes(tracer.settings, tracer.sampler):
        colors, _ = tracer.render_tile(work.tile, work.first, work.samples, counters)
        found.append(colors.ravel())
    return np.concatenate(found), counters


@dataclass
class Sent:
    """Sends all rays, and counts those that shafts would have spared, and those of which they said what isn't so."""

    shafts: Shafts
    clear: int = 0
    cut: int = 0
    wrong: int = 0

    def __call__(
        self, ask: Visible, light: Light, hits: Hits, candidates: Candidates, draws: Draws
    ) -> Mask:
        """See ``DirectLight.spare``."""
        states = self.shafts.states(light, hits, candidates, draws.counters)
        free = ask(light, hits, candidates, draws)
        if states is not None:
            there = np.ones(len(free), np.bool_) if candidates.mask is None else candidates.mask
            clear, cut = (there & (states == state) for state in (CLEAR, CUT_OFF))
            self.clear += int(clear.sum())
            self.cut += int(cut.sum())
            self.wrong += int((clear & ~free).sum() + (cut & free).sum())
        return free


def sent(scene: Scene, pixels: float | None = None) -> Sent:
    """What a picture's rays say to its shafts."""
    tracer = with_shafts(scene, pixels)
    direct: Any = tracer.integrator.direct
    told = Sent(direct.spare)
    integrator = replace(tracer.integrator, direct=replace(direct, spare=told))
    rendered(replace(tracer, integrator=integrator))
    return told


def random_scene(make_scene: MakeScene, seed: int, **parts: Any) -> Scene:
    """Solids, planks, balls, open meshes and movers, on a floor or in a room, under lights of all kinds."""
    rng = np.random.default_rng(seed)

    def number(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def place(height: float = 2.5) -> list[float]:
        return [number(-2, 2), number(0, height), number(-2, 2)]

    def turned() -> list[dict[str, Any]]:
        axis = rng.normal(size=3).tolist()
        return [
            {"rotate": {"axis": axis, "degrees": number(0, 360)}},
            {"translate": place()},
        ]

    shapes: list[Callable[[], dict[str, Any]]] = [
        lambda: {"shape": "box", "size": [number(0.1, 1), number(0.1, 1), number(0.1, 1)]},
        lambda: {"shape": "box", "size": [number(3, 9), number(0.002, 0.05), number(0.002, 0.1)]},
        lambda: {
            "shape": "sphere",
            "radius": number(0.1, 0.7),
            "segments": int(rng.integers(4, 40)),
        },
        lambda: {"shape": "cylinder", "radius": number(0.02, 0.4), "height": number(0.2, 3)},
        lambda: {"shape": "cone", "radius": number(0.1, 0.5), "height": number(0.2, 1.5)},
        lambda: {"shape": "quad", "width": number(0.2, 3), "depth": number(0.2, 3)},
        lambda: {"shape": "torus", "radius": number(0.2, 0.6), "tube": number(0.03, 0.15)},
        lambda: {"shape": "torus_knot", "radius": 0.3, "tube": 0.08, "segments": 60, "sides": 8},
    ]
    lights: list[Callable[[], dict[str, Any]]] = [
        lambda: {"type": "point", "position": place(4), "intensity": 9},
        lambda: (
            {"type": "directional", "direction": [number(-1, 1), -1, number(-1, 1)]}
            | {"irradiance": 1}
        ),
        lambda: {"type": "sphere", "center": place(4), "radius": number(0.01, 0.6), "intensity": 9},
        lambda: {"type": "sphere", "center": place(4), "radius": number(0.05, 0.4), "radiance": 4},
        lambda: (
            {"type": "sphere", "center": place(4), "radius": 0.2, "radiance": 4}
            | {"samples": "visible"}
        ),
        lambda: (
            {"type": "sphere", "center": place(3), "radius": 0.3, "intensity": 9}
            | {"samples": str(rng.choice(["ball", "facing disk"]))}
        ),
        lambda: (
            {"type": "rectangle", "corner": place(3), "edge_u": [number(0.1, 1), 0, 0]}
            | {"edge_v": [number(-0.5, 0.5), number(-0.5, 0.5), number(0.1, 1)]}
            | {str(rng.choice(["intensity", "radiance"])): 9}
        ),
    ]
    things = []
    for index in rng.integers(len(shapes), size=rng.integers(3, 9)).tolist():
        thing = shapes[index]() | {"material": "some", "transform": turned()}
        if rng.random() < 0.2:
            thing["motion"] = {"velocity": rng.uniform(-0.5, 0.5, 3).tolist()}
        things.append(thing)
    chosen = [lights[index]() for index in rng.integers(len(lights), size=2).tolist()]
    for light in chosen:
        if light["type"] != "directional" and rng.random() < 0.2:
            light["motion"] = {"velocity": rng.uniform(-0.5, 0.5, 3).tolist()}
    things.append({"shape": "quad", "material": "some", "width": 9, "depth": 9})
    if rng.random() < 0.4:
        things.append({"shape": "box", "material": "some", "size": [10, 10, 10]})
    gloss = {"lobe": "phong", "exponent": 40}
    description: dict[str, Any] = {
        "camera": {"eye": [0.3, 2, 4.5], "look_at": [0, 0.8, 0], "vertical_fov": 50},
        "film": {"width": 48, "height": 32},
        "sampler": {"samples": 16},
        "integrator": {"max_depth": 2},
        "materials": {"some": {"color": 0.5, "mirror": 0.3, "gloss": gloss}},
        "lights": chosen,
        "objects": things,
    }
    return make_scene(**(description | parts))
