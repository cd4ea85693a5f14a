"""Loops for lamps in lobes make the bits of the stage in NumPy, and step aside for students' functions."""

from functools import partial
from typing import Any

import pytest

from course import Scene, render
from course.compiled import library
from course.core.types import Functions
from course.effects import PROJECT
from course.extras.lamps_and_lobes import LampsAndLobes
from course.scene.scene import load_variant
from tests.conftest import MakeScene
from tests.effects.test_lamps_and_lobes import BALL, SHEET, plate

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled.lamps_and_lobes import CompiledLampsAndLobes, compiled_lamps_and_lobes

FORM = "course.compiled.stages.compiled_lamps_and_lobes"
WAYS = ("lamp", "balance", "power")


def assert_same_bits(scene: Scene, monkeypatch: pytest.MonkeyPatch, **settings: Any) -> None:
    """By compiled stages, with the loops for lamps in lobes and without."""
    made: list[Any] = []
    forms: tuple[tuple[Any, bool], ...] = (
        (compiled_lamps_and_lobes, True),
        (lambda stage: stage, False),
    )
    for form, loops in forms:
        used: list[LampsAndLobes] = []

        def chosen(stage: LampsAndLobes, form: Any = form, used: Any = used) -> LampsAndLobes:
            used.append(form(stage))
            return used[-1]

        with monkeypatch.context() as patch:
            patch.setattr(FORM, chosen)
            made.append(render(scene, compiled=True, **settings))
        assert isinstance(used[-1], CompiledLampsAndLobes) == loops
    assert made[0].linear.any()
    assert made[0].linear.tobytes() == made[1].linear.tobytes()
    assert made[0].receipt.rays == made[1].receipt.rays


@pytest.mark.parametrize("way", WAYS)
def test_veach_s_plates_keep_their_bits(monkeypatch: pytest.MonkeyPatch, way: str) -> None:
    scene = load_variant(
        PROJECT / "scenes" / "multiple_importance.yaml", {("integrator", "gloss_sampling"): way}
    )
    assert_same_bits(scene, monkeypatch, size=(96, 64), spp=16)


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("way", WAYS)
def test_bounces_and_other_lamps_keep_their_bits(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, way: str, kind: str
) -> None:
    """On a ball whose facets may turn away from the lamp, from within a lamp, and beside a lamp that is no ball's."""
    shiny = {"color": 0.5, "mirror": 0.4, "gloss": {"lobe": "phong", "exponent": 30}}
    point = {"type": "point", "position": [1, 2, 1], "intensity": 4}
    scene = plate(
        make_scene,
        way,
        BALL,
        camera={"eye": [4, 4, 0], "look_at": [0, 0, 0], "vertical_fov": 30},
        lights=[BALL, point, BALL | {"center": [0, 0.4, 0.3], "radius": 0.6}],
        materials={"glossy": shiny},
        objects=[
            {"shape": "quad", "material": "glossy", "width": 4, "depth": 4},
            {
                "shape": "sphere",
                "material": "glossy",
                "radius": 0.4,
                "transform": [{"translate": [0, 0.5, -1]}],
            },
        ],
        integrator={"type": kind, "max_depth": 3, "gloss_sampling": way},
        sampler={"type": "sobol", "samples": 16},
    )
    assert_same_bits(scene, monkeypatch)


def test_students_functions_and_flat_lamps_are_left_alone(make_scene: MakeScene) -> None:
    def stage_of(lamp: dict[str, Any], way: str = "power") -> LampsAndLobes:
        from course.rendering.binding import bind

        scene = plate(make_scene, way, lamp)
        integrator: Any = bind(scene, scene.settings).integrator
        stage: LampsAndLobes = integrator.lamps_and_lobes
        return stage

    stage = stage_of(BALL)
    assert isinstance(compiled_lamps_and_lobes(stage), CompiledLampsAndLobes)
    assert type(compiled_lamps_and_lobes(stage_of(SHEET))) is LampsAndLobes
    functions = stage.combining.functions
    for name in ("cone_density", "heuristic_weights"):
        known = {each: getattr(functions, each) for each in ("cone_density", "heuristic_weights")}
        own = Functions(**known | {name: partial(known[name])})
        vars(stage.combining)["functions"] = own
        assert compiled_lamps_and_lobes(stage) is stage
